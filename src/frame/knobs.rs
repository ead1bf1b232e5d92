//! Every field of the settings as a named number, which the command line and programs can set.

use super::parameter::Parameter;
use crate::settings::Quality;

/// A field of [`Quality`].
#[derive(Clone, Copy, Debug)]
pub struct Knob {
    /// Name, unit, range, the value of [`Quality::DEFAULT`], and what it does. A field of whole numbers has the unit
    /// `count`, and one that is on or off is 1 or 0.
    pub parameter: Parameter,
    /// The field's value; infinity for a field that has no limit.
    pub get: fn(&Quality) -> f64,
    /// Sets the field to a value of the range. Whole numbers are rounded, powers of two down.
    pub set: fn(&mut Quality, f64),
}

impl Knob {
    /// The knob of that name.
    pub fn named(name: &str) -> Option<&'static Knob> {
        KNOBS.iter().find(|knob| knob.parameter.name == name)
    }
}

/// The greatest power of two up to a value, from 1 on.
fn power(value: f64) -> usize {
    1 << (value.max(1.0) + 1e-9).log2() as u32
}

/// A knob: its field as a number, the assignment of a number to it, and its row of the table.
macro_rules! knob {
    ($q:ident, $get:expr, $v:ident, $set:expr; $name:literal, $unit:literal, $range:expr, $about:literal) => {
        Knob {
            parameter: {
                const DEFAULT: f64 = {
                    let $q = &Quality::DEFAULT;
                    $get
                };
                Parameter::new($name, $unit, $range, DEFAULT, $about)
            },
            get: |$q| $get,
            set: |$q, $v| $set,
        }
    };
}

/// All of them, in the order of `settings.rs`.
#[rustfmt::skip]
pub const KNOBS: &[Knob] = &[
    knob!(q, q.trace.cell as f64, v, q.trace.cell = power(v); "trace.cell", "count", (1.0, 16.0), "edge of the tracer's coarsest square, pixels, a power of two; at 1 every pixel is traced"),
    knob!(q, q.trace.threshold as f64, v, q.trace.threshold = v as f32; "trace.threshold", "1", (0.0, 1.0), "a square is interpolated where its centre is off by at most this, in linear light"),
    knob!(q, q.trace.min_weight as f64, v, q.trace.min_weight = v as f32; "trace.min_weight", "1", (0.0, 1.0), "a ray that weighs less is not traced"),
    knob!(q, q.trace.min_detail as f64, v, q.trace.min_detail = v as f32; "trace.min_detail", "1", (0.0, 1.0), "hits of a smaller share of the light have mean textures"),
    knob!(q, q.trace.antialias as u32 as f64, v, q.trace.antialias = v >= 0.5; "trace.antialias", "count", (0.0, 1.0), "1 where pixels that an edge crosses are anti-aliased"),
    knob!(q, q.trace.contrast as f64, v, q.trace.contrast = v as f32; "trace.contrast", "1", (0.0, 1.0), "an edge has samples within its pixels where their light differs by more"),
    knob!(q, q.trace.grid as f64, v, q.trace.grid = v.round() as _; "trace.grid", "count", (1.0, 8.0), "samples along each axis of every pixel"),
    knob!(q, q.trace.light_samples[0] as f64, v, q.trace.light_samples[0] = v.round() as _; "trace.light_samples.direct", "count", (1.0, 64.0), "shadow rays towards a light with a size, from what the eye sees directly"),
    knob!(q, q.trace.light_samples[1] as f64, v, q.trace.light_samples[1] = v.round() as _; "trace.light_samples.deeper", "count", (1.0, 64.0), "shadow rays towards a light with a size, from what is mirrored or refracted"),
    knob!(q, q.raster.coverage as f64, v, q.raster.coverage = power(v); "raster.coverage", "count", (1.0, 16.0), "coverage samples per pixel, a power of two"),
    knob!(q, q.raster.shadow_map as f64, v, q.raster.shadow_map = (v as u32).next_multiple_of(64); "raster.shadow_map", "count", (0.0, 4096.0), "texels along an edge of a shadow map, in sixty-fours; at 0 shadows are traced"),
    knob!(q, q.raster.grid as f64, v, q.raster.grid = v.round() as _; "raster.grid", "count", (1.0, 8.0), "samples along each axis of every pixel"),
    knob!(q, q.raster.threshold as f64, v, q.raster.threshold = v as f32; "raster.threshold", "1", (0.0, 1.0), "the light of many lights is interpolated along a triangle's row between pixels where it differs by less, of their sum"),
    knob!(q, q.cloud.steps as f64, v, q.cloud.steps = v.round() as _; "cloud.steps", "count", (1.0, 1000.0), "steps along an edge of a cloud's cube of voxels"),
    knob!(q, q.cloud.detail as f64, v, q.cloud.detail = v as f32; "cloud.detail", "1", (0.01, 1000.0), "steps per pixel of the cube's edge, where that makes fewer"),
    knob!(q, q.cloud.opaque as f64, v, q.cloud.opaque = v as f32; "cloud.opaque", "1", (0.0, 1.0), "a ray ends inside a cloud where less light passes"),
    knob!(q, q.cloud.hidden as f64, v, q.cloud.hidden = v as f32; "cloud.hidden", "1", (0.0, 1.0), "a ray ends between clouds where less light passes, and solids behind are not drawn"),
    knob!(q, q.cloud.cell as f64, v, q.cloud.cell = power(v); "cloud.cell", "count", (1.0, 16.0), "edge of the coarsest square of pixels with rays at its corners, a power of two"),
    knob!(q, q.cloud.threshold as f64, v, q.cloud.threshold = v as f32; "cloud.threshold", "1", (0.0, 1.0), "a square of 2 pixels is interpolated where its centre is off by at most this, in linear light, of 4 by half of it, and so on"),
    knob!(q, q.cloud.grid as f64, v, q.cloud.grid = v.round() as _; "cloud.grid", "count", (1.0, 8.0), "samples along each axis of every pixel, where the cell is 1"),
    knob!(q, q.cloud.imposter as f64, v, q.cloud.imposter = v as f32; "cloud.imposter", "pixels", (0.0, 64.0), "pixels by which an imposter may misplace what it shows; 0 for no imposters"),
    knob!(q, q.particles.detail as f64, v, q.particles.detail = v as f32; "particles.detail", "1", (0.0001, 1000.0), "share of a fire's particles that is drawn per pixel of its height"),
    knob!(q, q.sky.steps as f64, v, q.sky.steps = v.round() as _; "sky.steps", "count", (1.0, 400.0), "steps along a direction in which scattered light is summed"),
    knob!(q, q.sky.cell as f64, v, q.sky.cell = v as f32; "sky.cell", "radians", (0.0, 0.2), "angle between directions that are computed; at 0 every pixel has its own"),
    knob!(q, q.sky.grid as f64, v, q.sky.grid = v.round() as _; "sky.grid", "count", (1.0, 8.0), "samples along each axis of every pixel, where the cell is 0"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_knob_turns_its_own_field() {
        for (place, knob) in KNOBS.iter().enumerate() {
            let (least, most) = knob.parameter.range;
            for value in [least, most] {
                let mut quality = Quality::DEFAULT;
                (knob.set)(&mut quality, value);
                assert!(((knob.get)(&quality) - value).abs() <= 1e-7 * value, "{}", knob.parameter.name);
                for (other, same) in KNOBS.iter().enumerate().filter(|(other, _)| *other != place) {
                    assert_eq!((same.get)(&quality), (same.get)(&Quality::DEFAULT), "{} {other}", knob.parameter.name);
                }
            }
        }
    }

    /// Every field has a knob: those of two qualities that differ everywhere say how many there are.
    #[test]
    fn no_field_is_left_out() {
        let mut quality = Quality::DEFAULT;
        for knob in KNOBS {
            (knob.set)(&mut quality, (knob.get)(&Quality::EXACT).min(knob.parameter.range.1));
        }
        quality.cloud.detail = f32::INFINITY;
        quality.particles.detail = f32::INFINITY;
        assert_eq!(quality, Quality::EXACT);
    }
}
