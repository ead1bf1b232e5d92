//! What packing costs in speed: frames per second of the intro's captures, once it is unpacked, over those of the plain
//! release build at the same SIMD level, timed in turn; and how long the packed file takes to unpack.

use super::{build, pack, run as run_to_end, target};
use crate::options::Result;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use testkit::median;

/// How much is timed.
#[derive(clap::Args)]
pub struct Options {
    /// Number of rounds.
    #[arg(long, default_value_t = 9)]
    pub rounds: usize,
}

/// Seconds of the show that are timed: glass, a landscape, clouds, snow, fires.
const STARTS: [u32; 5] = [12, 24, 45, 95, 122];
/// Frames of the two seconds that a row captures, without the first.
const FRAMES: f64 = 59.0;

/// Seconds that a program takes to its end.
fn time(program: &Path, words: &[&str]) -> Result<f64> {
    let began = Instant::now();
    run_to_end(Command::new(program).args(words))?;
    Ok(began.elapsed().as_secs_f64())
}

/// Seconds per frame of a program's capture. What comes before the frames is taken off: the time of one frame alone.
fn frame(program: &Path, start: u32, quality: &str) -> Result<f64> {
    let capture = |end: f64| {
        let (from, to) = (start.to_string(), end.to_string());
        time(program, &["--threads", "2", "--quality", quality, "--capture", "-", "--from", &from, "--to", &to])
    };
    Ok((capture(f64::from(start) + 2.0)? - capture(f64::from(start) + 0.03)?) / FRAMES)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::MAX, f64::min)
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::MIN, f64::max)
}

/// Prints the ratios of every part and quality.
pub fn run(options: &Options) -> Result {
    let folder = pack()?;
    let (packed, intro) = (folder.join("paprsek"), folder.join("paprsek.elf"));
    let plain = build(&target().join("avx2"), &[("RUSTFLAGS", "--cfg disable_dispatch_avx512")])?;
    let rows: Vec<_> =
        STARTS.into_iter().flat_map(|start| ["fast", "default"].map(|quality| (start, quality))).collect();
    let mut times = vec![[Vec::new(), Vec::new()]; rows.len()];
    let mut unpacking = Vec::new();
    for round in 0..options.rounds {
        unpacking.push(1e3 * time(&packed, &["--help"])?);
        for ((start, quality), times) in rows.iter().zip(&mut times) {
            // In turn, and each first as often as the other.
            for k in [round % 2, 1 - round % 2] {
                times[k].push(frame([&plain, &intro][k], *start, quality)?);
            }
        }
    }
    for ((start, quality), [plain, intro]) in rows.into_iter().zip(times) {
        let ratios: Vec<_> = plain.iter().zip(&intro).map(|(plain, intro)| plain / intro).collect();
        println!(
            "{start:4} s {quality:8} {:.1} frames per second, {:.3} of the plain build's ({:.3} to {:.3}; best of each {:.3})",
            1.0 / median(intro.clone()),
            median(ratios.clone()),
            least(&ratios),
            most(&ratios),
            least(&plain) / least(&intro)
        );
    }
    let [least, most] = [least(&unpacking), most(&unpacking)];
    println!("unpacked in {:.0} ms ({least:.0} to {most:.0})", median(unpacking));
    Ok(())
}
