//! The work that is counted and timed: noise alone, and frames of scenes that are mostly one renderer's.

use crate::options::Result;
use fearless_simd::{Level, Simd, dispatch};
use paprsek::frame::{Frame, Renderer};
use paprsek::noise::{Scratch, noise_block};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::simd::block::BLOCK;
use std::hint::black_box;
use std::time::Instant;

/// One row of the table.
pub struct Work {
    pub name: &'static str,
    /// What most of its time goes to.
    pub kernel: &'static str,
    /// The scene, its quality and the time of its first frame; without one it is noise.
    pub frame: Option<(&'static str, Quality, f64)>,
}

/// What is counted: scenes of one kernel, then parts of the show. The flight is not among them, as its six shapes of clouds
/// take minutes to count.
pub const WORKS: [Work; 10] = [
    Work { name: "noise", kernel: "noise at 1280x720 points", frame: None },
    Work { name: "spheres-flat", kernel: "rays", frame: Some(("spheres-flat", Quality::EXACT, 2.0)) },
    Work { name: "spheres", kernel: "rays, textures", frame: Some(("spheres", Quality::EXACT, 2.0)) },
    Work { name: "shadow", kernel: "triangles, depth maps", frame: Some(("shadow", Quality::FAST, 2.0)) },
    Work { name: "sky-of-clouds", kernel: "clouds", frame: Some(("sky-of-clouds", Quality::FAST, 2.0)) },
    Work { name: "snow", kernel: "particles", frame: Some(("snow", Quality::FAST, 2.0)) },
    Work { name: "fire", kernel: "particles", frame: Some(("fire", Quality::FAST, 2.0)) },
    Work { name: "lumen", kernel: "rays, glass", frame: Some(("lumen", Quality::DEFAULT, 9.2)) },
    Work { name: "day", kernel: "triangles, sky", frame: Some(("day", Quality::DEFAULT, 24.0)) },
    Work { name: "torches", kernel: "triangles, lamps", frame: Some(("torches", Quality::DEFAULT, 10.9)) },
];

/// Time from one frame to the next, seconds.
const STEP: f64 = 1.0 / 30.0;
/// Distance of the points of noise, in cells.
const SPACE: f32 = 0.05;

impl Work {
    /// Does it for the first time, which also fills what is kept from frame to frame, and then `times` times more, on one
    /// thread. Seconds that those took.
    pub fn run(&self, level: Level, size: (usize, usize), times: usize) -> Result<f64> {
        let Some((scene, quality, at)) = &self.frame else {
            return Ok(timed(times, |_| dispatch!(level, simd => noise(simd, size))));
        };
        let scene = scenes::named(scene).ok_or_else(|| format!("no scene is called {scene}"))?;
        let mut renderer = Renderer::new(1)?.at_level(level);
        let mut frame = Frame::new(size.0, size.1);
        Ok(timed(times, |number| {
            renderer.render(&scene, at + number as f64 * STEP, quality, &mut frame);
        }))
    }
}

fn timed(times: usize, mut once: impl FnMut(usize)) -> f64 {
    once(0);
    let began = Instant::now();
    for number in 1..=times {
        once(number);
    }
    began.elapsed().as_secs_f64()
}

/// Noise at a grid of points, in blocks along x.
#[inline(always)]
fn noise<S: Simd>(simd: S, (width, height): (usize, usize)) {
    let (mut x, mut out, mut scratch) = ([0.0; BLOCK], [0.0; BLOCK], Scratch::default());
    for j in 0..height {
        let y = [j as f32 * SPACE; BLOCK];
        for start in (0..width).step_by(BLOCK) {
            for (k, x) in x.iter_mut().enumerate() {
                *x = (start + k) as f32 * SPACE;
            }
            noise_block(simd, &x, &y, &[0.5; BLOCK], 1.0, BLOCK, &mut scratch, &mut out);
            black_box(&out);
        }
    }
}
