//! Default quality at instants that nobody tuned it on: a hash of the date draws them.
//!
//! A day's instants are the same on every machine. Every scene's error against 64 samples per pixel is held against the
//! targets at its worst instant, not in the mean.

use crate::machine;
use crate::metrics::Error;
use crate::options::{Common, Result};
use crate::{stills, worst};
use paprsek::frame::{Frame, Renderer, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::fmt::Write;
use std::fs;

/// Targets: decibels at least, and the 99th percentile of FLIP at most.
pub const PSNR: f64 = 40.0;
pub const FLIP99: f64 = 0.2;

/// Number of scenes whose worst instants are shown.
const SHOWN: usize = 6;

/// What the measurement takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// The day that draws the instants, as in 2026-11-22 [default: today in Greenwich].
    #[arg(long, value_name = "DAY")]
    pub date: Option<String>,
    /// Scenes; all if none is named.
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
}

/// How much is measured.
struct Effort {
    size: (usize, usize),
    instants: u64,
}

/// The size that the show has unless another is asked for.
const FULL: Effort = Effort { size: (1280, 720), instants: 3 };
const QUICK: Effort = Effort { size: (160, 90), instants: 1 };

/// An instant of a scene.
pub struct Instant {
    /// Seconds.
    pub time: f64,
    pub error: Error,
    /// By default quality, and with 64 samples per pixel.
    pub pictures: [Frame; 2],
}

/// A scene, measured.
pub struct Row {
    pub scene: Scene,
    /// In order of time.
    pub instants: Vec<Instant>,
}

/// All that was measured.
pub struct Unseen {
    /// The day that drew the instants.
    pub date: String,
    /// Width and height, pixels.
    pub size: (usize, usize),
    pub rows: Vec<Row>,
}

impl Instant {
    /// Whether both targets are met.
    pub fn meets(&self) -> bool {
        self.error.psnr() >= PSNR && self.error.flip99 <= FLIP99
    }
}

impl Row {
    /// The instant with the largest mean square.
    pub fn worst(&self) -> &Instant {
        self.instants.iter().max_by(|a, b| a.error.square.total_cmp(&b.error.square)).expect("a scene has an instant")
    }

    /// The mean over the instants.
    pub fn mean(&self) -> Error {
        Error::mean(&self.instants.iter().map(|instant| instant.error).collect::<Vec<_>>())
    }
}

/// Measures, prints the table, and writes it as `unseen.md`.
pub fn run(options: &Options) -> Result {
    let unseen = measure(options)?;
    let out = &options.common.out;
    fs::create_dir_all(out)?;
    let mut text = markdown(&unseen, &options.common.command("unseen"));
    text += &format!(
        "\n## The worst instants\n\nOf the {SHOWN} scenes that are farthest from the truth, from left to right: \
         `default`, `reference`, their difference {} times amplified around grey, and FLIP from black (0) to yellow (1).\n",
        worst::GAIN
    );
    let mut rows: Vec<_> = unseen.rows.iter().collect();
    rows.sort_by(|a, b| b.worst().error.square.total_cmp(&a.worst().error.square));
    for row in rows.into_iter().take(SHOWN) {
        let (name, Instant { time, error, pictures: [picture, truth] }) = (row.scene.name, row.worst());
        let file = format!("unseen-{name}.png");
        stills::save(&worst::sheet(picture, truth), &out.join(&file))?;
        let (psnr, flip99) = (error.psnr(), error.flip99);
        text += &format!(
            "\n`{name}` at {time} s: {psnr:.1} dB, 99th percentile of FLIP {flip99:.3}\n\n![{name}]({file})\n"
        );
    }
    fs::write(out.join("unseen.md"), &text)?;
    println!("{text}");
    Ok(())
}

/// Measures every scene but the show, whose parts are scenes of their own.
pub fn measure(options: &Options) -> Result<Unseen> {
    let Effort { size, instants } = if options.common.quick { QUICK } else { FULL };
    let date = match &options.date {
        Some(date) => date.clone(),
        None => machine::date()?,
    };
    if let Some(name) = options.scenes.iter().find(|name| scenes::named(name).is_none()) {
        return Err(format!("there is no scene by the name '{name}'").into());
    }
    let mut renderer = Renderer::new(0)?;
    let mut rows = Vec::new();
    for scene in scenes::all().iter().filter(|scene| scene.name != scenes::INTRO.name) {
        if !options.scenes.is_empty() && !options.scenes.iter().any(|name| name == scene.name) {
            continue;
        }
        let mut times: Vec<_> = (0..instants).map(|number| instant(&date, scene, number)).collect();
        times.sort_by(f64::total_cmp);
        let mut measured = |time| {
            let pictures = [Quality::DEFAULT, Quality::REFERENCE].map(|quality| {
                let mut frame = Frame::new(size.0, size.1);
                renderer.render(scene, time, &quality, &mut frame);
                frame
            });
            Instant { time, error: Error::between(&pictures[0], &pictures[1]), pictures }
        };
        let row = Row { scene: *scene, instants: times.into_iter().map(&mut measured).collect() };
        eprintln!("{}: {:.1} dB at {:.2} s", scene.name, row.worst().error.psnr(), row.worst().time);
        rows.push(row);
    }
    Ok(Unseen { date, size, rows })
}

/// Seconds of the scene, by FNV-1a of the date, the scene and the instant's number; in steps of a hundredth, so that the
/// table's figure renders the same frame.
fn instant(date: &str, scene: &Scene, number: u64) -> f64 {
    let bytes = format!("{date} {} {number}", scene.name).into_bytes();
    let hash = bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325u64, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3));
    // FNV's high bits hardly depend on the last byte: the finaliser of MurmurHash3 spreads it.
    let mixed = [(33, 0xff51_afd7_ed55_8ccdu64), (33, 0xc4ce_b9fe_1a85_ec53), (33, 1)]
        .iter()
        .fold(hash, |hash, (shift, factor)| (hash ^ (hash >> shift)).wrapping_mul(*factor));
    let share = (mixed >> 11) as f64 / (1u64 << 53) as f64;
    (share * scene.duration * 100.0).floor() / 100.0
}

/// The page.
pub fn markdown(unseen: &Unseen, command: &str) -> String {
    let (width, height) = unseen.size;
    let mut text = format!(
        "# Default quality at instants that were not tuned on\n\n\
         Written by `{command} --date {date}`; not edited by hand.\n\n\
         A hash of {date} drew the instants. Each is rendered at `default` and at `reference` (64 samples per pixel), \
         {width}x{height}. **PSNR** is over all pixels of all instants; **worst** is the least of an instant, which comes \
         with its second. **FLIP** is the mean, **99 %** the largest 99th percentile of an instant, **bad** the share of \
         pixels off by more than 8 codes. Targets for every instant: {PSNR} dB, and {FLIP99} at the 99th percentile of FLIP.\n\n\
         | scene | instants, s | PSNR, dB | worst | at, s | SSIM | FLIP | 99 % | bad | targets |\n\
         |---|---|--:|--:|--:|--:|--:|--:|--:|---|\n",
        date = unseen.date,
    );
    for row in &unseen.rows {
        let (mean, worst) = (row.mean(), row.worst());
        let times: Vec<_> = row.instants.iter().map(|instant| format!("{}", instant.time)).collect();
        let flip99 = row.instants.iter().map(|instant| instant.error.flip99).fold(0.0, f64::max);
        let missed: Vec<_> = row.instants.iter().filter(|instant| !instant.meets()).collect();
        let met = if missed.is_empty() { "met".into() } else { format!("**missed {}x**", missed.len()) };
        let psnr = |error: &Error| if error.square > 0.0 { format!("{:.1}", error.psnr()) } else { "equal".into() };
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.4} | {:.4} | {flip99:.3} | {:.2} % | {met} |",
            row.scene.name,
            times.join(", "),
            psnr(&mean),
            psnr(&worst.error),
            worst.time,
            mean.ssim,
            mean.flip,
            100.0 * mean.bad,
        )
        .expect("memory");
    }
    text
}
