//! Speed against error: moves every knob of the quality, and writes tables and curves to `docs/report/`.
//!
//! `cargo run --release --example report -- [--quick] [--out DIR] [--threads N] [SCENE ...]`; `dome` is the sky alone.
//!
//! Figures of a renderer join by their knobs in `sweep.rs` and their scenes in `subject.rs`.

mod markdown;
mod measure;
mod metrics;
mod plot;
mod subject;
mod sweep;

#[path = "../common/machine.rs"]
mod machine;
#[path = "../common/maps.rs"]
mod maps;

use lexopt::{Arg, Parser, ValueExt};
use markdown::Setting;
use measure::{Bench, Effort, Renderers};
use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;
use subject::Subject;
use sweep::Group;

/// Minutes.
const FULL: Effort = Effort { size: (1280, 720), instants: 3, rounds: 9, threads: 2 };
/// Seconds: shows that the report works; its figures are rough.
const QUICK: Effort = Effort { size: (480, 270), instants: 1, rounds: 3, threads: 2 };

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
    for group in [Group::Tracer, Group::Raster] {
        sweeps.push(sweep::levels(&testkit::levels(), group));
        sweeps.push(sweep::threads(effort.threads, group));
    }
    let mut results: Vec<_> = sweeps.into_iter().map(|sweep| (sweep, Vec::new())).collect();
    let mut subjects = choose(&names)?;
    if effort.instants == QUICK.instants && names.is_empty() {
        // One of each kind of sweep.
        subjects.retain(|subject| {
            !["day, high sun", "cumulus", "clouds", "sky at sunset", "sky at dusk"].contains(&subject.name)
        });
    }
    for subject in subjects {
        let mut bench = Bench::new(&effort, &subject, &mut renderers);
        for (sweep, tables) in results.iter_mut().filter(|(sweep, _)| subject.groups.contains(&sweep.group)) {
            tables.push((subject.name, bench.measure(sweep)));
            eprintln!("{:5.1} s  {}: {} from {}", began.elapsed().as_secs_f64(), subject.name, sweep.knob, sweep.base);
        }
    }
    results.retain(|(_, tables)| !tables.is_empty());
    for (sweep, tables) in &results {
        plot::draw(&out.join(format!("{}.svg", sweep.file)), sweep, tables)?;
    }
    let setting = Setting { machine: machine::machine(), simd, command, effort: &effort };
    let file = out.join("report.md");
    std::fs::write(&file, markdown::report(&setting, &results))?;
    println!("{}: {} sweeps in {:.0} s", file.display(), results.len(), began.elapsed().as_secs_f64());
    Ok(())
}

/// The subjects of these names; without any all of them.
fn choose(names: &[String]) -> Result<Vec<Subject>, String> {
    let all = subject::all();
    if let Some(name) = names.iter().find(|name| !all.iter().any(|subject| subject.answers_to(name))) {
        return Err(format!("there is nothing to draw by the name '{name}'"));
    }
    let wanted = |subject: &Subject| names.is_empty() || names.iter().any(|name| subject.answers_to(name));
    Ok(all.into_iter().filter(wanted).collect())
}
