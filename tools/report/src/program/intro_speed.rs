//! What packing costs in speed: the time of the intro's frames, once it is unpacked, over that of the plain release build's
//! at the same SIMD level; and how long the packed file takes to unpack.
//!
//! Frames are timed in turn: each program is stopped while the other one draws, so that what else a machine does, and how
//! fast it runs just then, is the same for both.

use super::{build, pack, run as run_to_end, target};
use crate::options::Result;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;
use testkit::median;

/// How much is timed.
#[derive(clap::Args)]
pub struct Options {
    /// Number of frames of each program in each row.
    #[arg(long, default_value_t = 90, value_parser = clap::value_parser!(u32).range(2..))]
    pub frames: u32,
}

/// Seconds of the show that are timed: glass, a landscape, clouds, snow, fires.
const STARTS: [u32; 5] = [12, 24, 45, 95, 122];
/// How often the file is unpacked.
const UNPACKED: usize = 9;

/// A program that streams a stretch of the show. It is stopped, but while one of its frames is waited for.
struct Film {
    program: Child,
    frame: Vec<u8>,
}

impl Film {
    /// Starts a program, and waits for its first two frames, for which things are made that later ones keep.
    fn start(program: &Path, start: u32, quality: &str, frames: u32) -> Result<Film> {
        let (from, to) = (start.to_string(), (f64::from(start) + f64::from(frames + 4) / 30.0).to_string());
        let mut command = Command::new(program);
        command.args(["--threads", "2", "--quality", quality, "--size", "1280x720", "--fps", "30", "--capture", "-"]);
        command.args(["--from", &from, "--to", &to]).stdout(Stdio::piped()).stderr(Stdio::null());
        let head = "P6\n1280 720\n255\n".len();
        let mut film = Film { program: command.spawn()?, frame: vec![0; head + 3 * 1280 * 720] };
        film.next()?;
        film.next()?;
        Ok(film)
    }

    /// Seconds until the next frame is there.
    fn next(&mut self) -> Result<f64> {
        let began = Instant::now();
        self.send(Signal::SIGCONT)?;
        self.program.stdout.as_mut().expect("it is piped").read_exact(&mut self.frame)?;
        let took = began.elapsed().as_secs_f64();
        self.send(Signal::SIGSTOP)?;
        Ok(took)
    }

    fn send(&self, signal: Signal) -> Result {
        Ok(kill(Pid::from_raw(self.program.id() as i32), signal)?)
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// Seconds that a program takes to its end.
fn time(program: &Path, words: &[&str]) -> Result<f64> {
    let began = Instant::now();
    run_to_end(Command::new(program).args(words))?;
    Ok(began.elapsed().as_secs_f64())
}

/// Prints the ratios of every part and quality.
pub fn run(options: &Options) -> Result {
    let folder = pack()?;
    let (packed, intro) = (folder.join("paprsek"), folder.join("paprsek.elf"));
    let plain = build(&target().join("avx2"), &[("RUSTFLAGS", "--cfg disable_dispatch_avx512")])?;
    for (start, quality) in STARTS.into_iter().flat_map(|start| ["fast", "default"].map(|quality| (start, quality))) {
        let film = |program: &Path| Film::start(program, start, quality, options.frames);
        let mut films = [film(&plain)?, film(&intro)?];
        let mut times = [Vec::new(), Vec::new()];
        for round in 0..options.frames as usize {
            // Each first as often as the other.
            for k in [round % 2, 1 - round % 2] {
                times[k].push(films[k].next()?);
            }
        }
        let [plain, intro] = &times;
        // Of two frames in a row, since which is first may matter.
        let pairs = plain.chunks_exact(2).zip(intro.chunks_exact(2));
        let mut ratios: Vec<f64> =
            pairs.map(|(plain, intro)| (plain[0] * plain[1] / intro[0] / intro[1]).sqrt()).collect();
        ratios.sort_by(f64::total_cmp);
        // Where the median of so many lies in 95 of 100 cases: a number of ranks around the middle, by the binomial law.
        let (middle, ranks) = (ratios.len() / 2, 0.98 * (ratios.len() as f64).sqrt());
        let low = ratios[middle.saturating_sub(ranks.ceil() as usize)];
        let high = ratios[(middle + ranks.ceil() as usize).min(ratios.len() - 1)];
        println!(
            "{start:4} s {quality:8} {:.1} frames per second, {:.3} of the plain build's ({low:.3} to {high:.3})",
            1.0 / median(intro.clone()),
            median(ratios),
        );
    }
    let unpacking = (0..UNPACKED).map(|_| Ok(1e3 * time(&packed, &["--help"])?)).collect::<Result<Vec<_>>>()?;
    let [least, most] = [f64::min, f64::max].map(|f| unpacking.iter().copied().reduce(f).unwrap_or_default());
    println!("unpacked in {:.0} ms ({least:.0} to {most:.0})", median(unpacking));
    Ok(())
}
