//! Speed against error. One knob of the quality moves at a time; every point of its sweep is timed against `exact`, and its
//! pictures are compared with those of the truth.
//!
//! A new renderer joins with its knobs in `sweep.rs` and its scenes in `subject.rs`.

mod curves;
mod markdown;
mod measure;
mod subject;
mod sweep;

use crate::machine;
use crate::options::{Common, Result};
use markdown::Setting;
use measure::{Bench, Effort, Renderers};
use std::time::Instant;
use subject::Subject;
use sweep::Group;

/// The whole report, which takes minutes.
const FULL: Effort = Effort { size: (1280, 720), instants: 3, rounds: 9, threads: 2 };
/// A report that takes seconds, with rough figures.
const QUICK: Effort = Effort { size: (480, 270), instants: 1, rounds: 3, threads: 2 };

/// What the sweeps take.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// Number of threads of all but the sweep of threads [default: 2].
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Halve width and height, for a quarter of the time.
    #[arg(long)]
    pub half: bool,
    /// Scenes, or rows of the tables; `dome` is the sky alone. All if none is named.
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
}

impl Options {
    /// The command line that measures this again.
    fn command(&self) -> String {
        let threads = self.threads.map(|threads| format!(" --threads {threads}")).unwrap_or_default();
        let scenes = self.scenes.iter().map(|scene| format!(" '{scene}'"));
        let half = if self.half { " --half" } else { "" };
        self.common.command("quality") + half + &threads + &scenes.collect::<String>()
    }
}

/// Sweeps every knob, and writes `report.md` and a curve for each.
pub fn run(options: &Options) -> Result {
    let began = Instant::now();
    let (mut effort, names, out) =
        (if options.common.quick { QUICK } else { FULL }, &options.scenes, &options.common.out);
    effort.threads = options.threads.unwrap_or(effort.threads).max(1);
    if options.half {
        effort.size = (effort.size.0 / 2, effort.size.1 / 2);
    }
    let command = options.command();
    std::fs::create_dir_all(out)?;

    let mut renderers = Renderers::default();
    let simd = renderers.with(effort.threads, None).simd();
    let mut sweeps = sweep::knobs();
    for group in [Group::Tracer, Group::Raster] {
        sweeps.push(sweep::levels(&testkit::levels(), group));
        sweeps.push(sweep::threads(effort.threads, group));
    }
    let mut results: Vec<_> = sweeps.into_iter().map(|sweep| (sweep, Vec::new())).collect();
    let mut subjects = choose(names)?;
    if effort.instants == QUICK.instants && names.is_empty() {
        // One subject of each group of sweeps is enough.
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
        curves::draw(&out.join(format!("{}.svg", sweep.file)), sweep, tables)?;
    }
    let setting = Setting { machine: machine::machine(), simd, command, effort: &effort };
    let file = out.join("report.md");
    std::fs::write(&file, markdown::report(&setting, &results))?;
    println!("{}: {} sweeps in {:.0} s", file.display(), results.len(), began.elapsed().as_secs_f64());
    Ok(())
}

/// The subjects of these names, or all if there are no names.
fn choose(names: &[String]) -> Result<Vec<Subject>> {
    let all = subject::all();
    if let Some(name) = names.iter().find(|name| !all.iter().any(|subject| subject.answers_to(name))) {
        return Err(format!("there is nothing to draw by the name '{name}'").into());
    }
    let wanted = |subject: &Subject| names.is_empty() || names.iter().any(|name| subject.answers_to(name));
    Ok(all.into_iter().filter(wanted).collect())
}
