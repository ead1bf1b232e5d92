//! The Whitted ray tracer: shapes, materials and lights; packets; and the adaptive corner grid.
//!
//! One flow: [`world`] (what is there) -> [`guard`] (what must not be missed) -> [`adaptive`] (which rays) ->
//! [`packet`] (what they see) -> [`deferred`] (what colour that is). [`scalar`] is the plain truth beside the packets.

pub mod adaptive;
pub mod deferred;
pub mod guard;
pub mod lanes;
pub mod packet;
pub mod scalar;
pub mod shape;
pub mod texture;
pub mod world;

use crate::camera::Camera;
use crate::quality::Quality;
use crate::tile::{Layer, Stats, Tile};
use adaptive::{Job, Scratch};
use fearless_simd::{Level, dispatch};
use guard::Guard;
use packet::{Limits, View};
use std::cell::RefCell;
use world::World;

/// A world seen by a camera, as a layer of a picture. It fills every pixel.
pub struct Traced {
    world: World,
    view: View,
    guard: Guard,
    quality: Quality,
}

impl Traced {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, camera: Camera, width: usize, height: usize, quality: Quality) -> Traced {
        let view = View::new(camera, width, height);
        let guard = Guard::new(&world, &view, width, height);
        Traced { world, view, guard, quality }
    }
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

impl Layer for Traced {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let Traced { world, view, guard, quality } = self;
        let limits = Limits { min_weight: quality.min_weight, light_samples: quality.light_samples };
        let job = Job { world, view, guard, quality, limits };
        let samples = SCRATCH.with_borrow_mut(|scratch| dispatch!(level, simd => adaptive::draw(simd, &job, tile, scratch)));
        Stats { samples }
    }
}
