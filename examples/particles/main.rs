//! Particles: frames a second against flakes and against fires, beside the tables of two theses; how many a second move,
//! beside what memory and arithmetic would allow; and what fewer particles of a small fire save and cost. Writes
//! `particles.md` and `particles-*.svg`.
//!
//! `cargo run --release --example particles -- [--quick] [--out DIR]`, DIR `docs/report`.

mod detail;
mod fire;
mod limits;
#[path = "../report/metrics.rs"]
mod metrics;
mod motion;
#[path = "../shadows/plot.rs"]
mod plot;
mod snow;

use lexopt::{Arg, Parser};
use paprsek::frame::FrameSpec;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

const SIZE: (usize, usize) = (1280, 720);
const THREADS: usize = 2;
/// Seconds of the first frame, and between frames: those of the bench scenes.
const START: f64 = 2.0;
const STEP: f64 = 0.05;

/// Who draws, and into what.
struct Stage {
    renderer: Renderer,
    frame: Frame,
    rounds: usize,
}

impl Stage {
    /// An instant of a scene at `fast`.
    fn shot(&self, time: f64) -> FrameSpec<'_> {
        self.renderer.spec(time, &Quality::FAST, SIZE)
    }

    /// Median frames a second of each case from time to finished picture; all take turns at each instant.
    fn fps<C>(&mut self, cases: &[C], picture: impl Fn(&C, &FrameSpec) -> Picture) -> Vec<f64> {
        let mut times = vec![Vec::new(); cases.len()];
        for round in 0..=self.rounds {
            for (case, times) in cases.iter().zip(&mut times) {
                let began = Instant::now();
                let picture = picture(case, &self.shot(START + round as f64 * STEP));
                self.renderer.draw(picture, &mut self.frame);
                // The first round fetches memory.
                if round > 0 {
                    times.push(began.elapsed().as_secs_f64());
                }
            }
        }
        times.into_iter().map(|times| 1.0 / median(times)).collect()
    }
}

/// A camera of the bench scenes.
fn camera(eye: glam::Vec3, target: glam::Vec3) -> Camera {
    Camera::look_at(eye, target, 50f32.to_radians(), 0.0)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut rounds, mut out) = (41, PathBuf::from("docs/report"));
    let mut parser = Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Arg::Long("quick") => rounds = 3,
            Arg::Long("out") => out = PathBuf::from(parser.value()?),
            other => return Err(other.unexpected().into()),
        }
    }
    std::fs::create_dir_all(&out)?;
    let mut stage = Stage { renderer: Renderer::new(THREADS)?, frame: Frame::new(SIZE.0, SIZE.1), rounds };
    let mut text = String::from(
        "# ParticleLayer\n\nWritten by `cargo run --release --example particles`; not edited by hand.\n\n",
    );
    writeln!(
        text,
        "{}x{}, {THREADS} threads and {} unless said otherwise; frames are medians of {rounds} rounds in which all of a table take turns. A frame is all from the time to the picture; nothing is kept from one to the next.",
        SIZE.0,
        SIZE.1,
        stage.renderer.simd()
    )?;
    snow::report(&mut text, &mut stage, &out)?;
    fire::report(&mut text, &mut stage)?;
    detail::report(&mut text, &mut stage, &out)?;
    motion::report(&mut text, &out, rounds)?;
    let file = out.join("particles.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}
