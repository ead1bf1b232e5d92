//! The cloud renderer with any voxels, sun and settings, before and behind a ball.

use crate::input::Input;
use crate::{pixels, solid};
use fearless_simd::{Level, dispatch};
use glam::{Vec3A, vec3a};
use paprsek::cloud::{Cloud, CloudLayer, CloudLight, Voxels, sunlight};
use paprsek::frame::{Layer, Stats, Tile};
use paprsek::settings::{CloudSettings, Quality};
use paprsek::simd::level;
use paprsek::trace::{Background, Material, Object, Shape, TraceLayer, World};
use std::sync::Arc;

/// In a furnace light is what clouds hide: both are sums of up to 400 rounded numbers up to 1, in up to 3 clouds.
const ROUNDING: f32 = 1e-4;

pub fn run(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let view = solid::view(input);
    let settings = settings(input);
    // All light comes from everywhere, and is 1; so clouds send as much light as they hide.
    let is_furnace = input.flag();
    let light = CloudLight {
        ambient: if is_furnace { [Vec3A::ONE; 2] } else { [input.color(), input.color()] },
        towards: input.direction(),
        sun: if is_furnace { Vec3A::ZERO } else { input.color() * 10.0 },
        phase: [input.number(0.0, 1.0), input.number(0.0, 1.0)],
    };
    let air = (!is_furnace && input.flag()).then(|| (input.number(1.0, 100.0), input.color()));
    let is_shaded = input.flag();
    let ball = (!is_furnace && input.flag()).then(|| (input.vector(6.0), input.number(0.1, 6.0)));
    let count = 1 + input.below(3);
    let is_wild = input.is_wild;
    let clouds: Vec<Cloud> = (0..count).map(|_| cloud(input, light.towards)).collect();
    let layers = || {
        let mut seen = CloudLayer::new(clouds.clone(), light, &view, &settings);
        if let Some((range, color)) = air {
            seen = seen.in_air(range, |_| color);
        }
        if is_shaded {
            seen = seen.shaded_by(&clouds);
        }
        let mut layers: Vec<Box<dyn Layer>> = vec![Box::new(Blank)];
        if let Some((center, radius)) = ball {
            let ball = Object::new(Shape::Sphere { center, radius }, Material::plain(Vec3A::ONE));
            // The background is the layers' that follow.
            let world =
                World { background: Background::even(Vec3A::ZERO), ambient: Vec3A::ONE, ..World::new(vec![ball]) };
            layers.push(Box::new(TraceLayer::new(world, &view, &Quality::EXACT.trace)));
        }
        layers.push(Box::new(seen));
        // An imposter's colours are bytes.
        if is_furnace && !is_wild && settings.imposter == 0.0 {
            layers.push(Box::new(Furnace));
        }
        layers
    };
    pixels::check(layers, (view.width(), view.height()), is_wild);
}

fn settings(input: &mut Input) -> CloudSettings {
    let cell = input.one_of(&[1, 8, 2, 4, 16]);
    CloudSettings {
        steps: 1 + input.below(130) as u32,
        detail: input.one_of(&[f32::INFINITY, 0.5, 2.0]),
        opaque: input.one_of(&[0.0, 1.0 / 256.0, 0.5]),
        hidden: input.one_of(&[0.0, 1.0 / 256.0, 0.5]),
        cell,
        threshold: input.one_of(&[0.0, 0.015, 1.0]),
        grid: if cell == 1 { 1 + input.below(2) } else { 1 },
        imposter: input.one_of(&[0.0, 0.0, 0.5, 2.0]),
    }
}

/// Voxels of any bytes, a few repeated or one alone, in any light of a sun in the direction of `towards`.
fn cloud(input: &mut Input, towards: Vec3A) -> Cloud {
    let edge = input.one_of(&[4, 8, 16, 32]);
    let voxels = edge * edge * edge;
    let density = if input.flag() {
        let mut density = vec![0; voxels];
        density[input.below(voxels)] = input.byte();
        density
    } else {
        let pattern: Vec<u8> = (0..1 + input.below(64)).map(|_| input.byte()).collect();
        pattern.iter().copied().cycle().take(voxels).collect()
    };
    let (size, thickness) = (input.number(0.01, 10.0), input.number(0.0, 4.0));
    let extinction = if input.is_wild { thickness } else { thickness.powi(4) };
    let mut voxels = Voxels::new(edge, density);
    if input.flag() {
        voxels = baked(&voxels, towards, extinction, input.is_wild);
    }
    Cloud { voxels: Arc::new(voxels), centre: input.vector(8.0), size, extinction }
}

/// The voxels in sunlight, which has to be the same bytes at the best SIMD level and at the least.
fn baked(voxels: &Voxels, towards: Vec3A, extinction: f32, is_wild: bool) -> Voxels {
    let bake = |level: Level| {
        let mut voxels = voxels.clone();
        dispatch!(level, simd => sunlight::bake(simd, &mut voxels, towards, extinction));
        voxels
    };
    let [best, least] = [Level::new(), level::all().last().expect("a level").1].map(bake);
    let same = (0..voxels.density().len()).all(|point| best.light(point) == least.light(point));
    assert!(is_wild || same, "other sunlight at the least level");
    best
}

/// The first layer, which writes every pixel: black.
struct Blank;

impl Layer for Blank {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        tile.clear();
        Stats { samples: 0 }
    }
}

/// Holds the light of tiles against what is covered in them.
struct Furnace;

impl Layer for Furnace {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for y in 0..tile.height {
            for at in y * Tile::SIZE..y * Tile::SIZE + tile.width {
                let light = vec3a(tile.red[at], tile.green[at], tile.blue[at]);
                let off = (light - tile.coverage[at]).abs().max_element();
                assert!(off <= ROUNDING, "{light} where {} is covered", tile.coverage[at]);
            }
        }
        Stats { samples: 0 }
    }
}
