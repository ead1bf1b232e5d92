//! From the start of the program to its first frame, and its memory: of one frame to a pipe, and of the window on a display
//! of its own. Targets are 150 ms and 64 MiB (65536 kB).

use super::xvfb::Xvfb;
use super::{build, status, target};
use crate::options::Result;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use testkit::median;

/// What is started.
#[derive(clap::Args)]
pub struct Options {
    /// Number of rounds.
    #[arg(long, default_value_t = 9)]
    pub rounds: usize,
    /// The scene [default: the show].
    pub scene: Option<String>,
}

/// How long a window may stay empty, and how long it plays before its memory is read.
const PATIENCE: Duration = Duration::from_secs(20);
const PLAYING: Duration = Duration::from_millis(300);
/// Between two looks at the screen.
const BLINK: Duration = Duration::from_millis(1);

/// Milliseconds to the end of one frame to a pipe, and the most memory, kB.
fn to_pipe(mut program: Command) -> Result<(f64, u64)> {
    let began = Instant::now();
    let mut player = program.args(["--capture", "-"]).stdout(Stdio::piped()).spawn()?;
    let mut pipe = player.stdout.take().ok_or("no pipe")?;
    // The frame is there with its first byte, and far larger than the pipe: the program waits for the rest to be read.
    pipe.read_exact(&mut [0])?;
    let memory = status(player.id(), "VmHWM:")?;
    std::io::copy(&mut pipe, &mut std::io::sink())?;
    player.wait()?;
    Ok((1e3 * began.elapsed().as_secs_f64(), memory))
}

/// Milliseconds to the first picture in a window, and the most memory, kB.
fn to_window(mut program: Command, server: &Xvfb) -> Result<(f64, u64)> {
    // The window of the round before.
    while server.shows_a_picture()? {
        sleep(BLINK);
    }
    let began = Instant::now();
    let mut player = program.env("DISPLAY", &server.display).spawn()?;
    while !server.shows_a_picture()? {
        if began.elapsed() > PATIENCE || player.try_wait()?.is_some() {
            let _ = player.kill();
            return Err("the window stayed empty".into());
        }
        sleep(BLINK);
    }
    let ms = 1e3 * began.elapsed().as_secs_f64();
    sleep(PLAYING);
    let memory = status(player.id(), "VmHWM:");
    player.kill()?;
    player.wait()?;
    Ok((ms, memory?))
}

/// Prints the median of both.
pub fn run(options: &Options) -> Result {
    let paprsek = build(&target(), &[])?;
    let program = |path: &Path| {
        let mut program = Command::new(path);
        program.args(&options.scene).args(["--at", "0", "--size", "1280x720"]);
        program
    };
    let server = Xvfb::start()?;
    for place in ["to a pipe", "in a window"] {
        let (mut times, mut memory) = (Vec::new(), 0);
        for _ in 0..options.rounds {
            let program = program(&paprsek);
            let (ms, kb) = if place == "to a pipe" { to_pipe(program)? } else { to_window(program, &server)? };
            times.push(ms);
            memory = memory.max(kb);
        }
        let [least, most] = [f64::min, f64::max].map(|of| times.iter().copied().reduce(of).unwrap_or(0.0));
        println!("1280x720 {place}: median {:.0} ms, {least:.0} to {most:.0}, memory {memory} kB", median(times));
    }
    Ok(())
}
