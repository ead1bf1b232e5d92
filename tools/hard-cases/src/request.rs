//! Requests for frames, drawn by chance: any scene, time, size, quality, parameters, eye and SIMD level.

use paprsek::Scene;
use paprsek::frame::Parameter;
use paprsek::scenes;
use paprsek::settings::{CloudSettings, ParticleSettings, Quality, RasterSettings, SkySettings, TraceSettings};
use paprsek::view::Eye;
use testkit::levels;
use testkit::random::Random;

/// What may be asked of a renderer.
#[derive(Clone)]
pub struct Request {
    pub scene: Scene,
    /// Seconds, and sometimes none that are finite.
    pub time: f64,
    /// Width and height, pixels; either may be 0.
    pub size: (usize, usize),
    pub quality: Quality,
    /// What parameters are set to, each within its range.
    pub values: Vec<(&'static str, f64)>,
    pub eye: Eye,
    /// Which of [`levels`].
    pub level: usize,
}

impl Request {
    /// The request in words. Two that say the same are the same.
    pub fn text(&self) -> String {
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
            threshold: share(random),
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

/// The request of that number: the same in every walk of a seed, wherever the walk begins.
pub fn request(seed: u64, number: u64) -> Request {
    let random = &mut Random(seed.wrapping_add(1).wrapping_mul(0xD134_2543_DE82_EF95) ^ number.rotate_left(32));
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
