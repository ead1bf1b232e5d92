//! A walk of random frames: any scene, time, size, quality, parameters, eye and SIMD level. No pixel may be anything but a
//! finite number before it is encoded, nothing may panic, and no frame may be far more work than its neighbours. Times that
//! are not finite may have light that is none.
//!
//! Work is eye rays and shaded fragments, which are counted and the same in every run. With `--times` it is milliseconds
//! too: of three frames a sixtieth of a second apart, drawn one after the other by a renderer that has drawn one before
//! them, the middle one is suspected where it takes 2.5 times either neighbour, and found guilty where the least of seven
//! more rounds says so again.

use crate::probe::{Probe, Seen};
use paprsek::frame::{Frame, FrameSpec, Parameter, Renderer};
use paprsek::scenes;
use paprsek::settings::{CloudSettings, ParticleSettings, Quality, RasterSettings, SkySettings, TraceSettings};
use paprsek::view::Eye;
use paprsek::{Scene, frame::Values};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use std::time::Instant;
use testkit::levels;
use testkit::random::Random;

/// What is walked.
#[derive(Clone, Debug, clap::Args)]
pub struct Options {
    /// Frames to render.
    #[arg(long, default_value_t = 300)]
    pub frames: u64,
    /// Another seed is another walk.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Whether times are compared too, on a machine that does nothing else.
    #[arg(long)]
    pub times: bool,
}

/// How much more work than either neighbour a frame may be.
const SPIKE: f64 = 2.5;
/// Samples, and milliseconds, below which a frame is no spike.
const FEW: f64 = 200.0;
const SHORT: f64 = 0.5;
/// Seconds between neighbours.
const STEP: f64 = 1.0 / 60.0;

/// The request that is being rendered, for the message of a panic.
static CURRENT: Mutex<String> = Mutex::new(String::new());

/// What may be asked of a renderer.
struct Request {
    scene: Scene,
    time: f64,
    size: (usize, usize),
    quality: Quality,
    values: Vec<(&'static str, f64)>,
    eye: Eye,
    level: usize,
}

impl Request {
    fn text(&self) -> String {
        let Request { scene, time, size, quality, values, eye, level } = self;
        format!("{} at {time:e} s, {size:?}, {quality:?}, {values:?}, {eye:?}, {}", scene.name, levels()[*level].0)
    }
}

fn pick<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[(random.unit() * all.len() as f64) as usize]
}

/// A number from 0 to 1 by orders of magnitude, and sometimes one of its ends.
fn share(random: &mut Random) -> f32 {
    if random.unit() < 0.3 { pick(random, &[0.0, 1.0]) } else { random.log(1e-4, 1.0) as f32 }
}

/// Settings with every field anywhere within what it may be.
fn any_quality(random: &mut Random) -> Quality {
    let cells = [1usize, 2, 4, 8, 16];
    Quality {
        trace: TraceSettings {
            cell: pick(random, &cells),
            threshold: share(random),
            min_weight: share(random),
            min_detail: share(random),
            antialias: random.unit() < 0.5,
            contrast: share(random),
            grid: 1,
            light_samples: [pick(random, &[1, 4, 16, 64]), pick(random, &[1, 4, 16])],
        },
        raster: RasterSettings {
            coverage: pick(random, &cells),
            shadow_map: pick(random, &[0, 64, 192, 256, 1024]),
            grid: 1,
        },
        cloud: CloudSettings {
            steps: random.log(1.0, 800.0) as u32,
            detail: if random.unit() < 0.2 { f32::INFINITY } else { random.log(0.01, 4.0) as f32 },
            opaque: share(random).min(0.9),
            hidden: share(random).min(0.9),
            cell: pick(random, &cells),
            threshold: share(random),
            grid: 1,
            imposter: pick(random, &[0.0, 0.0, 0.5, 1.0, 4.0]),
        },
        particles: ParticleSettings {
            detail: if random.unit() < 0.3 { f32::INFINITY } else { random.log(1e-4, 1.0) as f32 },
        },
        sky: SkySettings {
            steps: random.log(1.0, 100.0) as u32,
            cell: if random.unit() < 0.3 { 0.0 } else { random.log(1e-3, 1.0) as f32 },
            grid: 1,
        },
    }
}

fn value(random: &mut Random, parameter: &Parameter) -> f64 {
    let (low, high) = parameter.range;
    match (random.unit() * 6.0) as u32 {
        0 => low,
        1 => high,
        _ => random.range(low, high),
    }
}

fn request(random: &mut Random) -> Request {
    let scene = pick(random, scenes::all());
    let special = [0.0, -0.0, -1.0, -1e9, 1e9, 86_400.0, 1e-300, 1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let time = if random.unit() < 0.1 { pick(random, &special) } else { random.range(0.0, scene.duration) };
    let size = match (random.unit() * 20.0) as u32 {
        0 => pick(random, &[(0, 9), (9, 0), (0, 0), (1, 200), (1, 65)]),
        1 => (random.log(1.0, 200.0) as usize, 1),
        2 => (random.range(60.0, 70.0) as usize, random.range(60.0, 70.0) as usize),
        3 => (random.log(60.0, 320.0) as usize, random.log(40.0, 180.0) as usize),
        _ => (random.log(1.0, 48.0) as usize, random.log(1.0, 32.0) as usize),
    };
    let quality = match (random.unit() * 8.0) as u32 {
        0 => Quality::FAST,
        1 | 2 => Quality::DEFAULT,
        3 => Quality::EXACT,
        4 if size.0 * size.1 < 100 => Quality::REFERENCE,
        _ => any_quality(random),
    };
    let set = random.unit() < 0.6;
    let values = scene.parameters.iter().filter(|_| set).map(|p| (p.name, value(random, p))).collect();
    let eye = if random.unit() < 0.2 {
        Eye { offset: random.range(-0.1, 0.1) as f32, convergence: random.log(0.1, 100.0) as f32 }
    } else {
        Eye::MIDDLE
    };
    let level = (random.unit() * levels().len() as f64) as usize;
    Request { scene, time, size, quality, values, eye, level }
}

/// What drawing a frame took: samples, milliseconds, and pixels that are no light.
struct Drawn {
    samples: f64,
    milliseconds: f64,
    bad: u64,
}

fn draw(renderer: &mut Renderer, request: &Request, time: f64) -> Drawn {
    let (width, height) = request.size;
    let values: Values = &request.values;
    let seen = Arc::new(Seen::default());
    let mut frame = Frame::new(width, height);
    let start = Instant::now();
    let mut picture = {
        let spec = renderer.spec(time, &request.quality, request.size);
        (request.scene.picture)(&FrameSpec { eye: request.eye, values, ..spec })
    };
    picture.layers.push(Box::new(Probe(seen.clone())));
    let stats = renderer.draw(picture, &mut frame);
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    // A probe that has not seen every pixel could not have seen a bad one.
    let missed = (width * height) as u64 - seen.pixels.load(Ordering::Relaxed);
    Drawn { samples: stats.samples as f64, milliseconds, bad: seen.bad.load(Ordering::Relaxed) + missed }
}

/// Whether the middle one of three is a spike.
fn spike(three: [f64; 3], least: f64) -> bool {
    three[1] > least && three[1] > SPIKE * three[0] && three[1] > SPIKE * three[2]
}

/// Walks, and says whether all went well.
pub fn walk(options: &Options) -> bool {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if let Ok(current) = CURRENT.try_lock() {
            eprintln!("while rendering {current}");
        }
        before(info);
    }));
    let mut random = Random(options.seed);
    let mut renderers: Vec<Renderer> = Vec::new();
    for (_, level) in levels() {
        match Renderer::new(1) {
            Ok(renderer) => renderers.push(renderer.at_level(level)),
            Err(error) => {
                eprintln!("{error}");
                return false;
            }
        }
    }
    let (mut frames, mut pixels, mut failures, mut suspects) = (0u64, 0u64, 0u64, 0u64);
    let mut worst = 0.0f64;
    let start = Instant::now();
    while frames < options.frames {
        let request = request(&mut random);
        if let Ok(mut current) = CURRENT.lock() {
            *current = request.text();
        }
        let renderer = &mut renderers[request.level];
        let times = [-STEP, 0.0, STEP].map(|step| request.time + step);
        if options.times {
            draw(renderer, &request, times[0] - STEP);
        }
        let three = times.map(|time| draw(renderer, &request, time));
        frames += 3;
        if frames.is_multiple_of(3000) {
            println!("{frames} frames, {failures} failures, {:.0} s", start.elapsed().as_secs_f64());
        }
        pixels += 3 * (request.size.0 * request.size.1) as u64;
        let bad: u64 = three.iter().map(|drawn| drawn.bad).sum();
        // At no time there is a picture of some bytes, which no light is behind.
        if bad > 0 && request.time.is_finite() {
            failures += 1;
            println!("{bad} pixels are no light: {}", request.text());
        }
        let samples = [0, 1, 2].map(|k| three[k].samples);
        worst = worst.max(if samples[1] > FEW { samples[1] / samples[0].max(samples[2]).max(1.0) } else { 0.0 });
        if spike(samples, FEW) {
            failures += 1;
            println!("samples {samples:?}: {}", request.text());
        }
        if options.times && spike([0, 1, 2].map(|k| three[k].milliseconds), SHORT) {
            suspects += 1;
            let mut least = [f64::INFINITY; 3];
            for _ in 0..7 {
                for (least, time) in least.iter_mut().zip(times) {
                    *least = least.min(draw(renderer, &request, time).milliseconds);
                }
            }
            if spike(least, SHORT) {
                failures += 1;
                println!("milliseconds {least:.2?}: {}", request.text());
            }
        }
    }
    println!(
        "{frames} frames, {pixels} pixels, seed {}, {:.0} s: {failures} failures; at most {worst:.2} times the samples of the \
         neighbours; {suspects} suspected by time",
        options.seed,
        start.elapsed().as_secs_f64()
    );
    // The hook as it was before anyone's.
    drop(std::panic::take_hook());
    failures == 0
}
