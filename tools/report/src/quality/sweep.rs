//! Which knob goes through which values, and from which quality. The knobs of a new renderer are added here.

use fearless_simd::Level;
use paprsek::settings::{Quality, SkySettings};

/// The truth that a sweep is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Truth {
    /// One sample at each pixel centre.
    Exact,
    /// 64 samples per pixel.
    Reference,
    /// 64 samples per pixel, and everything else as in the point: the limit of coverage alone.
    Samples,
    /// All particles, and everything else as in the point: the limit of their level of detail alone.
    ParticleLayer,
    /// The dome at every pixel, from 100 points along each direction.
    Dome,
}

impl Truth {
    /// The setting that renders the truth of a point.
    pub fn of(self, point: &Point) -> Point {
        let (quality, dome) = match self {
            Truth::Exact => (Quality::EXACT, None),
            Truth::Reference => (Quality::REFERENCE, None),
            Truth::Samples => (with_grid(point.quality, Quality::REFERENCE.raster.grid), None),
            Truth::ParticleLayer => (Quality { particles: Quality::EXACT.particles, ..point.quality }, None),
            Truth::Dome => (Quality::EXACT, Some(Quality::EXACT.sky)),
        };
        Point { quality, dome, level: None, threads: None, ..point.clone() }
    }

    /// Its name, which is that of the command line if it has one.
    pub fn name(self) -> &'static str {
        match self {
            Truth::Exact => "exact",
            Truth::Reference => "reference",
            Truth::Samples => "64 samples per pixel",
            Truth::ParticleLayer => "all particles",
            Truth::Dome => "every pixel from 100 points",
        }
    }
}

/// Which scenes a sweep is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Scenes of the ray tracer.
    Tracer,
    /// Scenes of the rasterizer.
    Raster,
    /// `day` with long shadows, and with short ones.
    Shadows,
    /// The computed sky alone.
    Sky,
    /// Scenes with clouds.
    CloudLayer,
    /// Scenes with fires.
    Fires,
}

/// One setting.
#[derive(Clone, Debug)]
pub struct Point {
    /// The knob's value as printed.
    pub label: String,
    /// Everything else as the sweep's base has it.
    pub quality: Quality,
    /// How the sky alone is computed; in scenes the quality decides.
    pub dome: Option<SkySettings>,
    /// SIMD level; none is the machine's best.
    pub level: Option<Level>,
    /// Number of threads; none is that of the whole report.
    pub threads: Option<usize>,
    /// Whether the knob stands here in the base.
    pub default: bool,
}

/// One knob moved, all others where `base` has them.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// File name of its curve.
    pub file: &'static str,
    /// The knob, as the code calls it.
    pub knob: &'static str,
    /// Name of the quality that the other knobs have.
    pub base: &'static str,
    /// What the pictures are compared with.
    pub truth: Truth,
    /// The scenes that it matters in.
    pub group: Group,
    /// From slow to fast, or in the knob's order.
    pub points: Vec<Point>,
}

/// The same quality with a grid of samples in every pixel.
fn with_grid(mut quality: Quality, grid: usize) -> Quality {
    (quality.trace.grid, quality.raster.grid, quality.cloud.grid, quality.sky.grid) = (grid, grid, grid, grid);
    quality
}

/// Every sweep of the knobs of [`Quality`], and of [`SkySettings`].
pub fn knobs() -> Vec<Sweep> {
    let threshold = [0.0, 0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16];
    let weight = [0.0, 1.0 / 256.0, 1.0 / 128.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0];
    let detail = [0.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0];
    let (fast, default) = (("fast", Truth::Exact), ("default", Truth::Reference));
    let min_weight: Knob = ("min_weight", |q| q.trace.min_weight, |q, value| q.trace.min_weight = value);
    let set_threshold: Knob = ("threshold", |q| q.trace.threshold, |q, value| q.trace.threshold = value);
    let map: Knob = ("shadow_map", |q| q.raster.shadow_map as f32, |q, value| q.raster.shadow_map = value as u32);
    let maps = [0.0, 256.0, 512.0, 1024.0, 2048.0, 4096.0];
    let mut sweeps = vec![
        sweep("threshold", fast, set_threshold, &threshold),
        sweep(
            "cell",
            fast,
            ("cell", |q| q.trace.cell as f32, |q, value| q.trace.cell = value as usize),
            &[1.0, 2.0, 4.0, 8.0, 16.0],
        ),
        sweep("min-weight", fast, min_weight, &weight),
        sweep("min-weight-default", default, min_weight, &weight),
        sweep(
            "min-detail",
            fast,
            ("min_detail", |q| q.trace.min_detail, |q, value| q.trace.min_detail = value),
            &detail,
        ),
        sweep(
            "antialias",
            default,
            ("antialias", |q| q.trace.antialias as u32 as f32, |q, value| q.trace.antialias = value > 0.0),
            &[0.0, 1.0],
        ),
        sweep(
            "contrast",
            default,
            ("contrast", |q| q.trace.contrast, |q, value| q.trace.contrast = value),
            &[0.0, 0.015, 0.03, 0.06, 0.12, 0.25, 0.5],
        ),
    ];
    let coverage: Knob = ("coverage", |q| q.raster.coverage as f32, |q, value| q.raster.coverage = value as usize);
    let coverage = sweep("coverage", ("default", Truth::Samples), coverage, &[1.0, 2.0, 4.0, 8.0, 16.0]);
    sweeps.push(Sweep { group: Group::Raster, ..coverage });
    for (file, base) in [("shadow-map", fast), ("shadow-map-default", default)] {
        sweeps.push(Sweep { group: Group::Shadows, ..sweep(file, base, map, &maps) });
    }
    let steps: Knob = ("cloud_steps", |q| q.cloud.steps as f32, |q, value| q.cloud.steps = value as u32);
    let detail: Knob = ("cloud_detail", |q| q.cloud.detail, |q, value| q.cloud.detail = value);
    let opaque: Knob = ("cloud_opaque", |q| q.cloud.opaque, |q, value| q.cloud.opaque = value);
    let cloud_threshold: Knob = ("cloud_threshold", |q| q.cloud.threshold, |q, value| q.cloud.threshold = value);
    let opaques = [0.0, 1.0 / 1024.0, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0];
    for clouds in [
        sweep("cloud-steps", fast, steps, &[12.0, 25.0, 50.0, 100.0, 200.0, 400.0]),
        sweep("cloud-detail", fast, detail, &[0.0625, 0.125, 0.25, 0.5, 1.0, f32::INFINITY]),
        sweep("cloud-opaque", fast, opaque, &opaques),
        sweep("cloud-threshold", fast, cloud_threshold, &threshold.map(|threshold| 0.5 * threshold)),
    ] {
        sweeps.push(Sweep { group: Group::CloudLayer, ..clouds });
    }
    let detail: Knob = ("particle_detail", |q| q.particles.detail, |q, value| q.particles.detail = value);
    let details = [1.0 / 1024.0, 1.0 / 512.0, 1.0 / 256.0, 1.0 / 128.0, f32::INFINITY];
    let fires = sweep("particle-detail", ("fast", Truth::ParticleLayer), detail, &details);
    sweeps.push(Sweep { group: Group::Fires, ..fires });
    sweeps.push(dome("dome-cell", "cell", [0.0, 0.0065, 0.013, 0.026, 0.052, 0.104].map(|cell| (cell, None))));
    sweeps.push(dome("dome-steps", "steps", [24, 16, 10, 8, 6, 4].map(|steps| (0.0, Some(steps)))));
    sweeps
}

/// A sweep of the dome's cell, or of its number of points at every pixel. The rest is as in `fast`.
fn dome<const N: usize>(file: &'static str, knob: &'static str, values: [(f32, Option<u32>); N]) -> Sweep {
    let from = Quality::FAST.sky;
    let point = |(cell, steps): (f32, Option<u32>)| {
        let dome = match steps {
            None => SkySettings { cell, ..from },
            // At every pixel: beside the error of interpolation, that of few points would not show.
            Some(steps) => SkySettings { steps, cell, ..from },
        };
        let default = steps.map_or(dome == from, |steps| steps == from.steps);
        let label = steps.map_or(cell.to_string(), |steps| steps.to_string());
        Point { label, quality: Quality::FAST, dome: Some(dome), level: None, threads: None, default }
    };
    let points = values.into_iter().map(point).collect();
    Sweep { file, knob, base: "fast", truth: Truth::Dome, group: Group::Sky, points }
}

/// The same picture on every SIMD level, slowest first.
pub fn levels(levels: &[(&'static str, Level)], group: Group) -> Sweep {
    let points = levels.iter().enumerate().rev().map(|(index, &(name, level))| Point {
        label: name.into(),
        quality: Quality::FAST,
        dome: None,
        level: Some(level),
        threads: None,
        default: index == 0,
    });
    let file = if group == Group::Tracer { "simd" } else { "simd-raster" };
    Sweep { file, knob: "SIMD level", base: "fast", truth: Truth::Exact, group, points: points.collect() }
}

/// The same picture on one thread and on all.
pub fn threads(all: usize, group: Group) -> Sweep {
    let points = (1..=all).map(|threads| Point {
        label: threads.to_string(),
        quality: Quality::FAST,
        dome: None,
        level: None,
        threads: Some(threads),
        default: threads == all,
    });
    let file = if group == Group::Tracer { "threads" } else { "threads-raster" };
    Sweep { file, knob: "threads", base: "fast", truth: Truth::Exact, group, points: points.collect() }
}

/// A field of [`Quality`]: its name, how it is read, how it is set.
type Knob = (&'static str, fn(&Quality) -> f32, fn(&mut Quality, f32));

/// A sweep of a knob in the tracer's scenes.
fn sweep(file: &'static str, (base, truth): (&'static str, Truth), (knob, get, set): Knob, values: &[f32]) -> Sweep {
    let from = Quality::named(base).expect("a quality of the command line");
    let mut values = values.to_vec();
    // The base's own value is a point of the curve, even if it is none of the values.
    values.push(get(&from));
    values.sort_by(f32::total_cmp);
    values.dedup();
    let point = |value| {
        let mut quality = from;
        set(&mut quality, value);
        Point { label: label(value), quality, dome: None, level: None, threads: None, default: quality == from }
    };
    let points = values.into_iter().map(point).collect();
    Sweep { file, knob, base, truth, group: Group::Tracer, points }
}

/// A value as the code writes it: small powers of two are fractions.
fn label(value: f32) -> String {
    let inverse = 1.0 / value;
    if value < 1.0 && inverse.fract() == 0.0 && (inverse as u64).is_power_of_two() {
        format!("1/{inverse}")
    } else {
        value.to_string()
    }
}
