//! Speed against error: moves every knob of the quality, and writes tables and curves to `docs/report/`.
//!
//! `cargo run --release --example report -- [--quick] [--out DIR] [--threads N] [SCENE ...]`
//!
//! Figures of a renderer join by their knobs in `sweep.rs` and their scenes in the list below.

mod markdown;
mod measure;
mod metrics;
mod plot;
mod sweep;

#[path = "../../tests/common/mod.rs"]
mod common;

use lexopt::{Arg, Parser, ValueExt};
use markdown::Setting;
use measure::{Bench, Effort, Renderers};
use paprsek::scenes::{self, Scene};
use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

/// The scenes that show what the knobs do.
const SCENES: [&str; 3] = ["spheres", "spheres-glass", "lumen"];
/// Minutes.
const FULL: Effort = Effort { size: (1280, 720), instants: &[0.1, 0.4, 0.7], rounds: 9, threads: 2 };
/// Seconds: shows that the report works; its figures are rough.
const QUICK: Effort = Effort { size: (480, 270), instants: &[0.1], rounds: 3, threads: 2 };

fn main() -> Result<(), Box<dyn Error>> {
    let began = Instant::now();
    let (mut effort, mut out, mut names) = (FULL, None, Vec::new());
    let mut threads = None;
    let mut parser = Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Arg::Long("quick") => effort = QUICK,
            Arg::Long("out") => out = Some(PathBuf::from(parser.value()?)),
            Arg::Long("threads") => threads = Some(parser.value()?.parse::<usize>()?.max(1)),
            Arg::Value(name) => names.push(name.string()?),
            other => return Err(other.unexpected().into()),
        }
    }
    effort.threads = threads.unwrap_or(effort.threads);
    let words: Vec<_> = std::env::args().skip(1).collect();
    let words = if words.is_empty() { String::new() } else { format!(" -- {}", words.join(" ")) };
    let command = format!("cargo run --release --example report{words}");
    let out = out.unwrap_or_else(|| "docs/report".into());
    std::fs::create_dir_all(&out)?;

    let mut renderers = Renderers::default();
    let simd = renderers.with(effort.threads, None).simd();
    let mut sweeps = sweep::knobs();
    sweeps.push(sweep::levels(common::levels()));
    sweeps.push(sweep::threads(effort.threads));
    let mut results: Vec<_> = sweeps.into_iter().map(|sweep| (sweep, Vec::new())).collect();
    for scene in choose(&names)? {
        let mut bench = Bench::new(&effort, scene, &mut renderers);
        for (sweep, tables) in &mut results {
            tables.push((scene, bench.measure(sweep)));
            eprintln!("{:5.1} s  {}: {} from {}", began.elapsed().as_secs_f64(), scene.name, sweep.knob, sweep.base);
        }
    }
    for (sweep, tables) in &results {
        plot::draw(&out.join(format!("{}.svg", sweep.file)), sweep, tables)?;
    }
    let setting = Setting { machine: machine(), simd, command, effort: &effort };
    let file = out.join("report.md");
    std::fs::write(&file, markdown::report(&setting, &results))?;
    println!("{}: {} sweeps in {:.0} s", file.display(), results.len(), began.elapsed().as_secs_f64());
    Ok(())
}

/// The scenes of these names; without any the usual ones.
fn choose(names: &[String]) -> Result<Vec<Scene>, String> {
    if names.is_empty() {
        return Ok(SCENES.iter().filter_map(|name| scenes::named(name)).collect());
    }
    names.iter().map(|name| scenes::named(name).ok_or(format!("there is no scene '{name}'"))).collect()
}

/// The processor's name and number of threads.
fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| cpu.lines().find(|l| l.starts_with(name)).and_then(|l| l.split(": ").nth(1));
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let (family, model) = (field("cpu family").unwrap_or("?"), field("model\t").unwrap_or("?"));
    format!("{}, family {family} model {model}, {count} threads", field("model name").unwrap_or("unknown processor"))
}
