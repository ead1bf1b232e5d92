//! Measures Paprsek: how fast it draws, how far its pictures are from the exact ones, and the pictures of its documentation.
//!
//! `cargo run --release -p report -- --help` lists the subcommands. Tables and curves go to `docs/report/`; each names the
//! command that writes it again.

mod cloud_light;
mod depth_maps;
mod dome;
mod figures;
mod films;
mod fronts;
mod html;
mod imposters;
mod levels;
mod lights;
mod likeness;
mod limits;
mod machine;
mod metrics;
mod not_modelled;
mod options;
mod particles;
mod picture;
mod plot;
mod program;
mod proof;
mod quality;
mod roofline;
mod samples;
mod shadows;
mod show;
mod sound;
mod stills;
mod unseen;
mod worst;

use clap::{Parser, Subcommand};
use options::{Common, Quick, Result};
use program::{beside, intro_speed, opt_level, pace, start};
use std::path::Path;
use std::process::ExitCode;

/// Measures Paprsek, and draws the pictures of its documentation.
#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    measurement: Measurement,
}

#[derive(Subcommand)]
enum Measurement {
    /// Speed against error: sweeps every knob of the quality, with tables and curves.
    Quality(quality::Options),
    /// Speed, samples and error of every scene: the README's table.
    Figures(Quick),
    /// The show, part by part: speed, error, and frames that pop.
    Show(Common),
    /// The sound of the show: levels, spectrum and loudness.
    Sound(Common),
    /// Shadow maps against traced shadows: by size, height of the sun, cascades and bias.
    Shadows(Common),
    /// Frames per second against objects and against lights.
    Lights(Common),
    /// Frames per second against flakes and fires, and the limits of memory and arithmetic.
    Particles(Common),
    /// What kernels and parts of the show reach of the machine's arithmetic and memory.
    Roofline(roofline::Options),
    /// Clouds as pictures that are kept, against rays in every frame.
    Imposters(imposters::Options),
    /// The computed sky: contact sheets, and error against milliseconds.
    #[command(subcommand)]
    Dome(dome::What),
    /// Light within a cloud: baked, or by the distance to its wall, against rays to the sun.
    CloudLight(Quick),
    /// What lights see: the depth maps of a scene as grey pictures.
    DepthMaps(depth_maps::Options),
    /// A frame with a white dot wherever an eye ray was traced.
    Samples(samples::Options),
    /// The stills of the README.
    Stills(stills::Options),
    /// What the release profile costs: speed beside a build at `opt-level = 3` throughout.
    OptLevel(opt_level::Options),
    /// This commit beside the executable of another one: speed and error of the show and of the bench scenes.
    Beside(beside::Options),
    /// What packing costs: the intro's speed beside the plain build's, and its time to unpack.
    IntroSpeed(intro_speed::Options),
    /// Frames per second of the packed intro as it plays in a window.
    Pace(pace::Options),
    /// Time and memory from the start to the first frame, to a pipe and in a window.
    Start(start::Options),
    /// Kept frames at every SIMD level, on this machine, under emulators and in node.
    Levels(levels::Options),
    /// Error of default quality at instants that a hash of the date draws.
    Unseen(unseen::Options),
    /// Fronts of speed against error, with other renderers beside.
    Fronts(fronts::Options),
    /// Films of the show against the reference, by ColorVideoVDP.
    Films(Common),
    /// What the renderers leave out, against references that have it.
    NotModelled(Common),
    /// One report: knobs, fronts, instants not tuned on, films and what is not modelled, and one HTML file of all pages.
    Proof(proof::Options),
    /// Everything that draws by itself: all but what builds, plays or counts programs.
    All(Common),
}

fn main() -> ExitCode {
    match run(Arguments::parse().measurement) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("report: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(measurement: Measurement) -> Result {
    match measurement {
        Measurement::Quality(options) => quality::run(&options),
        Measurement::Figures(options) => figures::run(&options),
        Measurement::Show(options) => show::run(&options),
        Measurement::Sound(options) => sound::run(&options),
        Measurement::Shadows(options) => shadows::run(&options),
        Measurement::Lights(options) => lights::run(&options),
        Measurement::Particles(options) => particles::run(&options),
        Measurement::Roofline(options) => roofline::run(&options),
        Measurement::Imposters(options) => imposters::run(&options),
        Measurement::Dome(what) => dome::run(&what),
        Measurement::CloudLight(options) => cloud_light::run(&options),
        Measurement::DepthMaps(options) => depth_maps::run(&options),
        Measurement::Samples(options) => samples::run(&options),
        Measurement::Stills(options) => stills::run(&options),
        Measurement::OptLevel(options) => opt_level::run(&options),
        Measurement::Beside(options) => beside::run(&options),
        Measurement::IntroSpeed(options) => intro_speed::run(&options),
        Measurement::Pace(options) => pace::run(&options),
        Measurement::Start(options) => start::run(&options),
        Measurement::Levels(options) => levels::run(&options),
        Measurement::Unseen(options) => unseen::run(&options),
        Measurement::Fronts(options) => fronts::run(&options),
        Measurement::Films(options) => films::run(&options),
        Measurement::NotModelled(options) => not_modelled::run(&options),
        Measurement::Proof(options) => proof::run(&options),
        Measurement::All(options) => all(&options),
    }
}

/// Every measurement that draws by itself, at its usual options.
fn all(common: &Common) -> Result {
    let Common { quick, out } = common.clone();
    let file = |name: &str| -> Box<Path> { out.join(name).into() };
    std::fs::create_dir_all(&out)?;
    for measurement in [
        Measurement::Quality(quality::Options {
            common: common.clone(),
            threads: None,
            half: false,
            scenes: Vec::new(),
        }),
        Measurement::Figures(Quick { quick }),
        Measurement::Show(common.clone()),
        Measurement::Sound(common.clone()),
        Measurement::Shadows(common.clone()),
        Measurement::Lights(common.clone()),
        Measurement::Particles(common.clone()),
        Measurement::Imposters(imposters::Options { common: common.clone(), frames: None }),
        Measurement::Dome(dome::What::Table(Quick { quick })),
        Measurement::Dome(dome::What::Sheet { out: file("dome.png").into(), haze: dome::HAZE, steps: None }),
        Measurement::CloudLight(Quick { quick }),
        Measurement::DepthMaps(depth_maps::Options { out: file("depth.png").into(), ..Default::default() }),
        Measurement::Samples(samples::Options { out: file("samples.png").into(), ..Default::default() }),
        Measurement::Stills(stills::Options { quick, out: out.clone() }),
    ] {
        run(measurement)?;
    }
    Ok(())
}
