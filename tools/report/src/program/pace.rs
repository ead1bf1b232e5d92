//! Plays the packed intro from start to end in a window of an X server of its own, and prints the frames per second that
//! were shown in each part.
//!
//! Frames are counted by the bytes that go to the server, which costs the intro no time; the server itself shares the
//! cores.

use super::pack;
use super::xvfb::{SIZE, Xvfb};
use crate::options::Result;
use image::RgbImage;
use paprsek::scenes::INTRO;
use paprsek::scenes::show::intro::PARTS;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};
use testkit::median;

/// What is played.
#[derive(clap::Args)]
pub struct Options {
    /// Directory for a still every five seconds, which takes time of the intro's.
    #[arg(long, value_name = "DIR")]
    pub stills: Option<PathBuf>,
    /// Second of the show to stop at [default: its end].
    #[arg(long, value_name = "SECONDS")]
    pub to: Option<f64>,
}

/// Bytes of a frame on the way to the server.
const FRAME: f64 = (4 * SIZE.0 * SIZE.1) as f64;
/// The first seconds unpack and start.
const WARM: f64 = 2.0;
/// Seconds between stills.
const STILL: usize = 5;

/// Bytes that a process has written so far; none once it has ended.
fn written(process: u32) -> Option<f64> {
    let io = fs::read_to_string(format!("/proc/{process}/io")).ok()?;
    io.lines().find_map(|line| line.strip_prefix("wchar: "))?.parse().ok()
}

/// Seconds since the start and frames so far, every second until the intro ends.
fn play(server: &Xvfb, options: &Options, end: f64) -> Result<Vec<(f64, f64)>> {
    let intro = pack()?.join("paprsek");
    let mut player = Command::new(intro).args(["--to", &end.to_string()]).env("DISPLAY", &server.display).spawn()?;
    let (began, mut counts) = (Instant::now(), Vec::new());
    while player.try_wait()?.is_none() {
        let Some(bytes) = written(player.id()) else { break };
        counts.push((began.elapsed().as_secs_f64(), bytes / FRAME));
        if let Some(folder) = options.stills.as_ref().filter(|_| counts.len() % STILL == 0) {
            let pixels = server.pixels()?;
            let colours = pixels.as_chunks::<4>().0.iter().flat_map(|&[blue, green, red, _]| [red, green, blue]);
            let still = RgbImage::from_raw(SIZE.0 as u32, SIZE.1 as u32, colours.collect()).ok_or("a torn screen")?;
            still.save(folder.join(format!("{:03}.png", counts.len())))?;
        }
        sleep(Duration::from_secs(counts.len() as u64).saturating_sub(began.elapsed()));
    }
    let status = player.wait()?;
    if status.success() { Ok(counts) } else { Err(format!("the intro: {status}").into()) }
}

/// Prints the median second and the slowest second of each part.
pub fn run(options: &Options) -> Result {
    if let Some(folder) = &options.stills {
        fs::create_dir_all(folder)?;
    }
    let end = options.to.unwrap_or(INTRO.duration);
    let counts = play(&Xvfb::start()?, options, end)?;
    let rate = |pair: &[(f64, f64)]| (pair[0].0, (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0));
    let rates: Vec<_> = counts.windows(2).map(rate).collect();
    let ends = PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]);
    for (start, end) in PARTS.iter().map(|part| part.0).zip(ends) {
        let inside = rates.iter().filter(|(at, _)| *at >= start.max(WARM) && *at < end);
        let seconds: Vec<_> = inside.map(|(_, rate)| *rate).collect();
        if !seconds.is_empty() {
            let slowest = seconds.iter().copied().fold(f64::MAX, f64::min);
            let median = median(seconds);
            println!("{start:3} to {end:3} s: {median:.1} frames per second, slowest second {slowest:.1}");
        }
    }
    Ok(())
}
