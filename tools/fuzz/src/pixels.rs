//! Draws layers in several ways, and holds their pixels against each other.

use fearless_simd::Level;
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Layer, Picture, Renderer, Stats, Tile};
use paprsek::simd::level;
use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Brightest light that a bounded scene may give, linear.
const BRIGHTEST: f32 = 1e6;

thread_local! {
    /// One thread at the best level, and two at the least. They stay, so what they keep from frame to frame is tried too.
    static RENDERERS: RefCell<[Renderer; 2]> = RefCell::new([
        Renderer::new(1).expect("a thread"),
        Renderer::new(2).expect("two threads").at_level(level::all().last().expect("a level").1),
    ]);
}

/// Looks at the light of tiles that other layers have drawn.
struct Watch(Arc<AtomicBool>);

impl Layer for Watch {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        let light = [&tile.red, &tile.green, &tile.blue];
        let is_light = |value: &f32| value.is_finite() && value.abs() <= BRIGHTEST;
        let is_share = |value: &f32| (-1e-3..=1.001).contains(value);
        let fits = light.iter().all(|channel| channel.iter().all(is_light))
            && tile.coverage.iter().all(is_share)
            && tile.inv_depth.iter().all(|value| value.is_finite() && *value >= 0.0);
        if !fits {
            self.0.store(true, Ordering::Relaxed);
        }
        Stats { samples: 0 }
    }
}

/// Draws a picture of `width` x `height` pixels twice: with one thread at the best SIMD level, and with two at the least.
/// Of a picture that is not wild the light has to be finite, and both have to have the same bytes.
pub fn check(layers: impl Fn() -> Vec<Box<dyn Layer>>, (width, height): (usize, usize), is_wild: bool) {
    let bad = Arc::new(AtomicBool::new(false));
    let frames = RENDERERS.with_borrow_mut(|renderers| {
        renderers.each_mut().map(|renderer| {
            let mut frame = Frame::new(width, height);
            let mut layers = layers();
            layers.push(Box::new(Watch(bad.clone())));
            renderer.draw(Picture { layers, transfer: Transfer::Srgb }, &mut frame);
            frame.pixels
        })
    });
    if !is_wild {
        assert!(!bad.load(Ordering::Relaxed), "light that is none");
        assert!(frames[0] == frames[1], "other bytes with two threads at the least level");
    }
}
