//! Every SIMD level, run somewhere: on this machine, under an emulator, or in node. The frames must be those that
//! `tests/frames/frames.txt` keeps; the page says how many were rendered where, and when.
//!
//! Whatever needs a tool or a Rust target that is not there is left out, in one line.

mod targets;

use crate::machine;
use crate::options::{Common, Result};
use std::collections::HashSet;
use std::fs;
use std::process::Command;
use targets::{CHECKS, Run};

/// The kept frames, from the root of the repository.
const KEPT: &str = "tests/frames/frames.txt";

/// What the levels take.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// Render every N-th frame of the table where an emulator takes seconds per frame [default: 7, quick: 151].
    #[arg(long, value_name = "N")]
    pub every: Option<usize>,
}

/// Runs every level, and writes `levels.md`. Fails where a frame differs or a check does.
pub fn run(options: &Options) -> Result {
    let Common { quick, out } = &options.common;
    let slow = options.every.unwrap_or(if *quick { 151 } else { 7 });
    let kept = fs::read_to_string(KEPT).map_err(|error| format!("{KEPT}: {error} (run from the repository's root)"))?;
    let kept: HashSet<_> = kept.lines().collect();
    let date = machine::date()?;
    let mut text = format!(
        "# Every SIMD level\n\n\
         Written by `{}`; not edited by hand.\n\n\
         The table of kept frames has {} rows: every scene at several times, qualities and sizes, one of them a stereo \
         pair. Equal means that the hash of all pixels is the kept one. Emulators take seconds per frame and render every \
         {slow}th row; qemu has no AVX-512. The emulated x86 processors choose their level themselves, as the program does, \
         and have the C library choose its functions for them. A row that \
         differs is an error.\n\n\
         | level | run on | frames | scenes | equal | date |\n|---|---|--:|--:|--:|---|\n",
        options.common.command("levels"),
        kept.len(),
    );
    let mut wrong = Vec::new();
    for run in targets::runs(*quick) {
        let Run { level, place, .. } = &run;
        let printed = match run.printed(slow) {
            Ok(printed) => printed,
            Err(missing) => {
                println!("left out: {level} on {place}: {missing}");
                text += &format!("| {level} | {place} | | | left out: {missing} | {date} |\n");
                continue;
            }
        };
        let mut lines = printed.lines();
        let ran = lines.next().unwrap_or("nothing");
        if ran != *level {
            wrong.push(format!("{place}: {ran} ran instead of {level}"));
        }
        let frames: Vec<_> = lines.collect();
        let scenes: HashSet<_> = frames.iter().filter_map(|line| line.split(' ').next()).collect();
        let equal = frames.iter().filter(|line| kept.contains(*line)).count();
        let differ = frames.iter().filter(|line| !kept.contains(*line));
        wrong.extend(differ.map(|line| format!("{level}, {place}: {line}")));
        if frames.is_empty() {
            wrong.push(format!("{level}, {place}: no frames"));
        }
        let row = format!("| {level} | {place} | {} | {} | {equal} | {date} |", frames.len(), scenes.len());
        println!("{row}");
        text += &(row + "\n");
    }
    if !quick {
        text += "\n## Builds that are only checked\n\n\
                 By `cargo check`: nothing was run.\n\n\
                 | target | built | result | date |\n|---|---|---|---|\n";
        for (target, what) in CHECKS {
            let result = match targets::check(target, what) {
                Ok(()) => "builds".into(),
                Err(error) => {
                    wrong.push(format!("{target}: {error}"));
                    error
                }
            };
            let row = format!("| {target} | `{what}` | {result} | {date} |");
            println!("{row}");
            text += &(row + "\n");
        }
    }
    fs::create_dir_all(out)?;
    fs::write(out.join("levels.md"), text)?;
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}

/// Runs a command to its end, and gives its stdout, or the last line that it said.
fn output(command: &mut Command) -> std::result::Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = said.lines().find(|line| line.starts_with("error")).or(said.lines().last()).unwrap_or("no word");
    Err(format!("{name}: {line}"))
}
