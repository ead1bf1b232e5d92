//! What the release profile costs in speed: it optimises all but the renderer for size. Frames per second of the release
//! build over those of a build with `opt-level = 3` throughout, timed in turn.

use super::{build, output, target};
use crate::options::Result;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use testkit::median;

/// How much is timed.
#[derive(clap::Args)]
pub struct Options {
    /// Number of rounds.
    #[arg(long, default_value_t = 5)]
    pub rounds: usize,
}

/// The benchmark's frames per second by scene and quality.
fn bench(program: &Path, quality: &str) -> Result<Vec<((String, String), f64)>> {
    let words = ["--bench", "--json", "--threads", "2", "--quality", quality, "--from", "2", "--to", "4"];
    let mut rows = Vec::new();
    for line in String::from_utf8(output(Command::new(program).args(words))?)?.lines() {
        let row: Value = serde_json::from_str(line)?;
        let text = |name: &str| row[name].as_str().map(String::from).ok_or(format!("a row without {name}"));
        rows.push(((text("scene")?, text("quality")?), row["fps_median"].as_f64().ok_or("a row without fps_median")?));
    }
    Ok(rows)
}

/// Prints the ratios of every scene.
pub fn run(options: &Options) -> Result {
    let release = build(&target(), &[])?;
    let three = build(&target().join("opt-level-3"), &[("CARGO_PROFILE_RELEASE_OPT_LEVEL", "3")])?;
    let mut ratios = BTreeMap::<_, Vec<f64>>::new();
    for _ in 0..options.rounds {
        for quality in ["fast", "default"] {
            for (ours, theirs) in bench(&release, quality)?.into_iter().zip(bench(&three, quality)?) {
                ratios.entry(ours.0).or_default().push(ours.1 / theirs.1);
            }
        }
    }
    for ((scene, quality), ratios) in ratios {
        let (least, most) =
            (ratios.iter().fold(f64::MAX, |a, b| a.min(*b)), ratios.iter().fold(0.0, |a: f64, b| a.max(*b)));
        println!("{scene:14} {quality:8} {:.3} of opt-level 3, {least:.3} to {most:.3}", median(ratios));
    }
    Ok(())
}
