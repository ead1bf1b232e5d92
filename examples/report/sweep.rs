//! Which knob goes through which values, from which quality: a new renderer's knobs are added here.

use fearless_simd::Level;
use paprsek::quality::Quality;

/// What is right, where a sweep is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Truth {
    /// One sample at each pixel centre.
    Exact,
    /// 64 samples a pixel.
    Reference,
}

impl Truth {
    /// The quality that renders it.
    pub fn quality(self) -> Quality {
        match self {
            Truth::Exact => Quality::EXACT,
            Truth::Reference => Quality::REFERENCE,
        }
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Truth::Exact => "exact",
            Truth::Reference => "reference",
        }
    }
}

/// One setting.
#[derive(Clone, Debug)]
pub struct Point {
    /// The knob's value as printed.
    pub label: String,
    /// Everything else as the sweep's base has it.
    pub quality: Quality,
    /// SIMD level; the machine's best where none is named.
    pub level: Option<Level>,
    /// Threads; as many as the report runs on where none is named.
    pub threads: Option<usize>,
    /// Is this where the base stands?
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
    /// From slow to fast, or in the knob's order.
    pub points: Vec<Point>,
}

/// Every sweep of the knobs of [`Quality`].
pub fn knobs() -> Vec<Sweep> {
    let threshold = [0.0, 0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16];
    let weight = [0.0, 1.0 / 256.0, 1.0 / 128.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0];
    let detail = [0.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0];
    let (fast, default) = (("fast", Truth::Exact), ("default", Truth::Reference));
    let min_weight: Knob = ("min_weight", |q| q.min_weight, |q, value| q.min_weight = value);
    vec![
        sweep("threshold", fast, ("threshold", |q| q.threshold, |q, value| q.threshold = value), &threshold),
        sweep(
            "cell",
            fast,
            ("cell", |q| q.cell as f32, |q, value| q.cell = value as usize),
            &[1.0, 2.0, 4.0, 8.0, 16.0],
        ),
        sweep("min-weight", fast, min_weight, &weight),
        sweep("min-weight-default", default, min_weight, &weight),
        sweep("min-detail", fast, ("min_detail", |q| q.min_detail, |q, value| q.min_detail = value), &detail),
        sweep(
            "subpixel",
            default,
            ("subpixel", |q| q.subpixel as f32, |q, value| q.subpixel = value as u32),
            &[0.0, 1.0, 2.0],
        ),
    ]
}

/// The same picture on every SIMD level, slowest first.
pub fn levels(levels: Vec<(&'static str, Level)>) -> Sweep {
    let points = levels.into_iter().enumerate().rev().map(|(index, (name, level))| Point {
        label: name.into(),
        quality: Quality::FAST,
        level: Some(level),
        threads: None,
        default: index == 0,
    });
    let points = points.collect();
    Sweep { file: "simd", knob: "SIMD level", base: "fast", truth: Truth::Exact, points }
}

/// The same picture on one thread and on all.
pub fn threads(all: usize) -> Sweep {
    let points = (1..=all).map(|threads| Point {
        label: threads.to_string(),
        quality: Quality::FAST,
        level: None,
        threads: Some(threads),
        default: threads == all,
    });
    Sweep { file: "threads", knob: "threads", base: "fast", truth: Truth::Exact, points: points.collect() }
}

/// A field of [`Quality`]: its name, how it is read, how it is set.
type Knob = (&'static str, fn(&Quality) -> f32, fn(&mut Quality, f32));

fn sweep(file: &'static str, (base, truth): (&'static str, Truth), (knob, get, set): Knob, values: &[f32]) -> Sweep {
    let from = Quality::named(base).expect("a quality of the command line");
    let mut values = values.to_vec();
    // Wherever the base moves to, it is a point of its own curve.
    values.push(get(&from));
    values.sort_by(f32::total_cmp);
    values.dedup();
    let point = |value| {
        let mut quality = from;
        set(&mut quality, value);
        Point { label: label(value), quality, level: None, threads: None, default: quality == from }
    };
    Sweep { file, knob, base, truth, points: values.into_iter().map(point).collect() }
}

/// Small powers of two as fractions: that is how the code writes them.
fn label(value: f32) -> String {
    let inverse = 1.0 / value;
    if value < 1.0 && inverse.fract() == 0.0 && (inverse as u64).is_power_of_two() {
        format!("1/{inverse}")
    } else {
        value.to_string()
    }
}
