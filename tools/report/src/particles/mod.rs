//! Particles: frames per second against flakes and against fires, beside the tables of `[Snow07]` and `[Fire08]`; the number
//! of particles that move per second, beside what memory and arithmetic would allow; and what drawing fewer particles of a
//! small fire saves and costs. Writes `particles.md` and `particles-*.svg`.

mod detail;
mod fire;
mod motion;
mod snow;

use crate::options::{Common, Result};
use paprsek::frame::FrameSpec;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use std::fmt::Write;
use std::time::Instant;
use testkit::median;

const SIZE: (usize, usize) = (1280, 720);
const THREADS: usize = 2;
/// Time of the first frame and time between frames, seconds: those of the bench scenes.
const START: f64 = 2.0;
const STEP: f64 = 0.05;

/// What draws, and what it draws into.
struct Stage {
    renderer: Renderer,
    frame: Frame,
    rounds: usize,
}

impl Stage {
    /// The frame of an instant at `fast`.
    fn shot(&self, time: f64) -> FrameSpec<'_> {
        self.renderer.spec(time, &Quality::FAST, SIZE)
    }

    /// The median frames per second of each case, from the time to the finished picture. All cases take turns at each
    /// instant.
    fn fps<C>(&mut self, cases: &[C], picture: impl Fn(&C, &FrameSpec) -> Picture) -> Vec<f64> {
        let mut times = vec![Vec::new(); cases.len()];
        for round in 0..=self.rounds {
            for (case, times) in cases.iter().zip(&mut times) {
                let began = Instant::now();
                let picture = picture(case, &self.shot(START + round as f64 * STEP));
                self.renderer.draw(picture, &mut self.frame);
                // The first round warms up: memory is allocated and touched.
                if round > 0 {
                    times.push(began.elapsed().as_secs_f64());
                }
            }
        }
        times.into_iter().map(|times| 1.0 / median(times)).collect()
    }
}

/// A camera of the bench scenes.
fn camera(eye: glam::Vec3A, target: glam::Vec3A) -> Camera {
    Camera::look_at(eye, target, 50f32.to_radians(), 0.0)
}

/// Measures everything, and writes the tables and their curves.
pub fn run(options: &Common) -> Result {
    let (rounds, out) = (if options.quick { 3 } else { 41 }, &options.out);
    std::fs::create_dir_all(out)?;
    let mut stage = Stage { renderer: Renderer::new(THREADS)?, frame: Frame::new(SIZE.0, SIZE.1), rounds };
    let mut text = format!("# Particles\n\nWritten by `{}`; not edited by hand.\n\n", options.command("particles"));
    writeln!(
        text,
        "{}x{}, {THREADS} threads and {} unless said otherwise. Times are medians of {rounds} rounds in which all rows of a table take turns. A frame is everything from the time to the finished picture; nothing is kept from one frame to the next.",
        SIZE.0,
        SIZE.1,
        stage.renderer.simd()
    )?;
    snow::report(&mut text, &mut stage, out)?;
    fire::report(&mut text, &mut stage)?;
    detail::report(&mut text, &mut stage, out)?;
    motion::report(&mut text, out, rounds)?;
    let file = out.join("particles.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}
