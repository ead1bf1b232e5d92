//! This commit beside another one, whose executable was kept: frames per second of the show, second by second, and of the
//! bench scenes, timed in turn, and the error of both, each against its own reference. Writes `beside.md`.

use super::{build, output, target};
use crate::likeness;
use crate::machine;
use crate::options::{Common, Result};
use crate::show::parts::{self, Part};
use paprsek::frame::{Frame, Scene};
use paprsek::scenes;
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use testkit::median;
use testkit::metrics::Difference;

/// What is compared.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// The release build of another commit, as `git worktree` and `cargo build --release` make it.
    #[arg(value_name = "EXECUTABLE")]
    pub other: PathBuf,
    /// What the other commit is called in the table.
    #[arg(long, default_value = "before")]
    pub name: String,
}

/// Both builds, and what is done with them.
struct Pair {
    /// The other one, then this commit's.
    programs: [PathBuf; 2],
    levels: Vec<&'static str>,
    /// Size of frames that are timed, and of those that are compared.
    timed: &'static str,
    compared: (usize, usize),
    /// Every how many seconds one is timed, and how often.
    every: usize,
    rounds: usize,
    /// The most seconds between frames of a shot that are compared.
    piece: f64,
}

/// Frames per second in the median and in the slowest hundredth, of each of two builds.
type Speeds = [Vec<[f64; 2]>; 2];

/// Measures and writes the tables.
pub fn run(options: &Options) -> Result {
    let Common { quick, out } = &options.common;
    let programs = [options.other.clone(), build(&target(), &[])?];
    let levels = machine::levels().into_iter().map(|(name, _)| name).collect();
    let pair = if *quick {
        Pair { programs, levels, timed: "160x90", compared: (64, 36), every: 15, rounds: 1, piece: 60.0 }
    } else {
        Pair { programs, levels, timed: "1280x720", compared: (640, 360), every: 2, rounds: 3, piece: 10.0 }
    };
    let heads = pair.levels.iter().flat_map(|level| {
        [format!("fps at {level}, {}", options.name), "now".into(), "times as fast".into(), "slowest, times".into()]
    });
    let heads: Vec<_> = heads.collect();
    let head = |what: &str| {
        let dashes = "|--:".repeat(heads.len());
        let likeness = likeness::head();
        format!(
            "| {what} | {} | {}: {likeness} | now: {likeness} |\n|---{dashes}|--:|--:|--:|--:|\n",
            heads.join(" | "),
            options.name
        )
    };
    let mut text = format!(
        "# Beside {}\n\n\
         Written by `{} EXECUTABLE`; not edited by hand.\n\n\
         {}; {}, 2 threads. {} and this commit in turn, each by its own `--bench`.\n\n\
         ## The show\n\n\
         At `default`. Every {} s a second of a part is timed: medians of their medians of frames per second, and in \
         brackets the slowest hundredth of the slowest. Ratios are those of the medians, and of the slowest. Error: of \
         `default` to `reference`, each build's own, at {}x{}, in the middle of each shot; shots longer than {} s are cut \
         into equal pieces.\n\n{}",
        options.name,
        options.common.command("beside"),
        machine::machine(),
        pair.timed,
        options.name,
        pair.every,
        pair.compared.0,
        pair.compared.1,
        pair.piece,
        head("part"),
    );
    for part in parts::all()? {
        let speeds = pair.levels.iter().map(|level| pair.part(&part, level)).collect::<Result<Vec<_>>>()?;
        let instants: Vec<_> = part.instants(pair.piece).collect();
        let compare = |k: usize| {
            let at = |at: &f64| pair.differ(&pair.programs[k], "intro", *at, ["default", "reference"]);
            instants.iter().map(at).collect::<Result<Vec<_>>>()
        };
        row(&mut text, &part.name(), &speeds, [compare(0)?, compare(1)?])?;
    }
    writeln!(
        text,
        "\n## Bench scenes\n\n\
         Three stretches of each, from 2 s on. Error: of `fast` to `exact` and of `default` to `reference` at the middle \
         instant.\n\n{}",
        head("scene, quality").trim_end()
    )?;
    for scene in bench_scenes() {
        for [quality, truth] in [["fast", "exact"], ["default", "reference"]] {
            let speeds =
                pair.levels.iter().map(|level| pair.scene(scene, quality, level)).collect::<Result<Vec<_>>>()?;
            let at = 0.5 * scene.duration;
            let compare = |k: usize| pair.differ(&pair.programs[k], scene.name, at, [quality, truth]);
            row(&mut text, &format!("`{}`, {quality}", scene.name), &speeds, [vec![compare(0)?], vec![compare(1)?]])?;
        }
    }
    std::fs::create_dir_all(out)?;
    let file = out.join("beside.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}

/// The scenes that are not of the show.
fn bench_scenes() -> impl Iterator<Item = &'static Scene> {
    let shown = |scene: &&Scene| {
        scene.name != scenes::INTRO.name && !scenes::show::intro::PARTS.iter().any(|part| part.1.0.name == scene.name)
    };
    scenes::all().iter().filter(shown)
}

impl Pair {
    /// Seconds of a part, both builds in turn.
    fn part(&self, part: &Part, level: &str) -> Result<Speeds> {
        let mut speeds = Speeds::default();
        for second in (part.seconds.start as usize..part.seconds.end as usize).step_by(self.every) {
            self.turn(&mut speeds, second, "intro", "default", level, second as f64)?;
        }
        eprintln!("{}, {level}: timed", part.name());
        Ok(speeds)
    }

    /// Rounds of a bench scene, both builds in turn.
    fn scene(&self, scene: &Scene, quality: &str, level: &str) -> Result<Speeds> {
        let mut speeds = Speeds::default();
        for round in 0..self.rounds {
            self.turn(&mut speeds, round, scene.name, quality, level, 2.0)?;
        }
        Ok(speeds)
    }

    /// A second of each build; which is first changes with the number.
    fn turn(&self, speeds: &mut Speeds, number: usize, scene: &str, quality: &str, level: &str, from: f64) -> Result {
        for k in [number % 2, 1 - number % 2] {
            let (from, to) = (from.to_string(), (from + 1.0).to_string());
            let mut command = Command::new(&self.programs[k]);
            command.args([scene, "--bench", "--json", "--threads", "2", "--size", self.timed, "--simd", level]);
            command.args(["--quality", quality, "--from", &from, "--to", &to]);
            let row: Value = serde_json::from_slice(&output(&mut command)?)?;
            let number = |name: &str| row[name].as_f64().ok_or_else(|| format!("a row without {name}"));
            speeds[k].push([number("fps_median")?, number("fps_p1")?]);
        }
        Ok(())
    }

    /// How far a frame is from that of another quality.
    fn differ(&self, program: &Path, scene: &str, at: f64, qualities: [&str; 2]) -> Result<Difference> {
        let (width, height) = self.compared;
        let mut frames = Vec::new();
        for quality in qualities {
            let mut command = Command::new(program);
            let (at, size) = (at.to_string(), format!("{width}x{height}"));
            let bytes =
                output(command.args([scene, "--capture", "-", "--at", &at, "--size", &size, "--quality", quality]))?;
            let pixels =
                bytes.strip_prefix(format!("P6\n{width} {height}\n255\n").as_bytes()).ok_or("not a PPM file")?;
            let pixel = |rgb: &[u8]| u32::from_be_bytes([0, rgb[0], rgb[1], rgb[2]]);
            frames.push(Frame { width, height, pixels: pixels.chunks_exact(3).map(pixel).collect() });
        }
        Ok(Difference::between(&frames[0], &frames[1]))
    }
}

/// A row of a table: speeds at each level, then errors.
fn row(text: &mut String, name: &str, levels: &[Speeds], errors: [Vec<Difference>; 2]) -> Result {
    write!(text, "| {name}")?;
    for speeds in levels {
        let middle = |k: usize| median(speeds[k].iter().map(|speed| speed[0]).collect());
        let slowest = |k: usize| speeds[k].iter().map(|speed| speed[1]).fold(f64::MAX, f64::min);
        let (ratio, least) = (middle(1) / middle(0), slowest(1) / slowest(0));
        let [before, now] = [0, 1].map(|k| format!("{:.1} ({:.1})", middle(k), slowest(k)));
        write!(text, " | {before} | {now} | {ratio:.2} | {least:.2}")?;
    }
    for error in errors {
        write!(text, " | {}", likeness::columns(&error))?;
    }
    Ok(writeln!(text, " |")?)
}
