//! The bench scene `sky`, as specified for every renderer that is compared: an analytic day, the sun and stars.
//!
//! After thesis E, but the sun moves on a circle of its own, without a date or a place; the scene `day` has those. The
//! parameters' defaults are the specification.

use super::sky_grid::{self as grid, Cells, Field};
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Layer, Parameter, Picture, Scene, Stats, Tile};
use crate::simd::hash::pcg;
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math;
use crate::vector::unit;
use crate::view::Camera;
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use glam::{Vec3A, vec3a};
use std::f32::consts::LOG2_E;
use std::sync::OnceLock;

/// The scene.
pub const SKY: Scene = Scene {
    name: "sky",
    about: "bench: a sunrise, stars",
    duration: 20.0,
    parameters: &[START, SPEED, TILT, STARS],
    picture,
};

const START: Parameter =
    Parameter::new("start", "rad", (-3.2, 3.2), -0.53, "the sun's angle at the start, from where it rises");
const SPEED: Parameter = Parameter::new("speed", "rad/s", (-6.3, 6.3), 0.3, "how fast the sun goes round");
const TILT: Parameter =
    Parameter::new("tilt", "1", (-2.0, 2.0), 0.1, "how far the sun's circle leans to the east, tangent");
const STARS: Parameter = Parameter::new("stars", "1", (0.0, 4.0), 1.0, "light of the stars, times what it is");

fn picture(spec: &FrameSpec) -> Picture {
    let view = View::new(spec.camera(camera(spec.time)), spec.width, spec.height);
    let cells = Cells { size: if spec.quality.sky.cell > 0.0 { 8 } else { 1 }, grid: spec.quality.sky.grid };
    Picture { layers: vec![Box::new(Cycle::new(spec, view, cells))], transfer: Transfer::Gamma22 }
}

/// The camera at `time` seconds.
pub fn camera(time: f64) -> Camera {
    let (sin, cos) = (0.1 * time).sin_cos();
    Camera::look_at(Vec3A::ZERO, vec3a(sin as f32, 0.36, cos as f32), 50f32.to_radians(), 0.0)
}

/// Smoothstep from 0 at `a` to 1 at `b`.
fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    math::smooth1((x - a) / (b - a))
}

/// The sky's colours at an instant, without stars and the sun's disc.
struct Gradient {
    sun: Vec3A,
    zenith: Vec3A,
    horizon: Vec3A,
    /// Share of the dusk's colour in the horizon's towards the sun.
    dusk: f32,
}

impl Field for Gradient {
    const HORIZON: bool = true;

    #[inline(always)]
    fn light<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        let (zero, above) = (F::<S>::splat(simd, 0.0), d.y.simd_ge(0.0));
        let level = unit(vec3a(self.sun.x, 0.0, self.sun.z));
        let towards = d.dot1(level) / (d.x * d.x + d.z * d.z).sqrt() * 0.5 + 0.5;
        let dusk = towards * towards * self.dusk;
        let low = V3::splat(simd, self.horizon);
        let low = low + (V3::splat(simd, vec3a(0.95, 0.36, 0.10)) - low) * Lane(dusk);
        let fall = math::exp2(simd, above.select(d.y * (-5.0 * LOG2_E), d.y * (6.0 * LOG2_E)));
        let up = low + (V3::splat(simd, self.zenith) - low) * Lane(F::<S>::splat(simd, 1.0) - fall);
        let color = V3::select(above, up, low * Lane(fall));
        // 10 = 8 + 2 and 220 = 128 + 64 + 16 + 8 + 4.
        let c = above.select(d.dot1(self.sun).max(zero), zero);
        let c2 = c * c;
        let c4 = c2 * c2;
        let c8 = c4 * c4;
        let c16 = c8 * c8;
        let c32 = c16 * c16;
        let c64 = c32 * c32;
        let c220 = (c64 * c64 * c64) * (c16 * c8 * c4);
        color + V3::splat(simd, vec3a(1.0, 0.55, 0.22)) * Lane(c8 * c2 * 0.22 + c220 * 0.5)
    }
}

/// The scene at an instant, as a layer. It fills every pixel.
pub struct Cycle {
    view: View,
    cells: Cells,
    gradient: Gradient,
    /// Where the sun's disc appears and its radius there, pixels; none behind the eye.
    disc: Option<(f32, f32, f32)>,
    /// Stars in sight: the place in the picture and the radius, pixels, and the number in the [`catalogue`].
    stars: Vec<(f32, f32, f32, usize)>,
    /// Light of the stars that the day leaves, of all.
    night: f32,
}

impl Cycle {
    fn new(spec: &FrameSpec, view: View, cells: Cells) -> Cycle {
        let (sin, cos) = (spec.get(&SPEED) * spec.time + spec.get(&START)).sin_cos();
        let sun = unit(vec3a(spec.get(&TILT) as f32 * cos as f32, sin as f32, cos as f32));
        let day = smoothstep(-0.15, 0.25, sun.y);
        let dusk = 0.75 * f64::from(-18.0 * sun.y * sun.y).exp() as f32;
        let zenith = vec3a(0.003, 0.006, 0.022).lerp(vec3a(0.05, 0.16, 0.46), day);
        let horizon = vec3a(0.010, 0.016, 0.045).lerp(vec3a(0.48, 0.62, 0.82), day);
        // The cosine of the disc's edge is 0.99978. A circle on a flat screen is stretched away from the middle.
        let stretch = |d: Vec3A| 1.0 / d.dot(view.camera().forward).max(0.1);
        let disc = view.project(sun).map(|(x, y, scale)| (x, y, 0.021 * scale * stretch(sun) + 1.0));
        let mut stars = Vec::new();
        if day < 1.0 {
            for (number, (place, _)) in catalogue().iter().enumerate() {
                if let Some((x, y, scale)) = view.project(*place) {
                    stars.push((x, y, 0.22 * scale * stretch(*place / 120.0) + 1.0, number));
                }
            }
        }
        Cycle {
            view,
            cells,
            gradient: Gradient { sun, zenith, horizon, dusk },
            disc,
            stars,
            night: (1.0 - day) * spec.get(&STARS) as f32,
        }
    }

    /// Adds `light` of a direction to the pixels of a tile around a point of the picture, averaged over each pixel.
    fn add(&self, tile: &mut Tile, (x, y, radius): (f32, f32, f32), light: impl Fn(Vec3A) -> Vec3A) {
        let (left, top) = (tile.x as u32 as f32, tile.y as u32 as f32);
        let clip = |at: f32, size: usize| at.clamp(0.0, size as u32 as f32) as usize;
        let columns = clip((x - radius - left).floor(), tile.width)..clip((x + radius - left).ceil(), tile.width);
        let rows = clip((y - radius - top).floor(), tile.height)..clip((y + radius - top).ceil(), tile.height);
        let grid = self.cells.grid;
        let step = 1.0 / grid as u32 as f32;
        for row in rows {
            for column in columns.clone() {
                let mut sum = Vec3A::ZERO;
                for part in 0..grid * grid {
                    let dx = ((part % grid) as u32 as f32 + 0.5) * step;
                    let dy = ((part / grid) as u32 as f32 + 0.5) * step;
                    let d = self.view.direction(left + column as u32 as f32 + dx, top + row as u32 as f32 + dy);
                    sum += light(d) * if d.y >= 0.0 { step * step } else { 0.0 };
                }
                let at = row * Tile::SIZE + column;
                tile.red[at] += sum.x;
                tile.green[at] += sum.y;
                tile.blue[at] += sum.z;
            }
        }
    }
}

impl Layer for Cycle {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => grid::fill(simd, &self.gradient, &self.view, self.cells, tile));
        for &(x, y, radius, number) in &self.stars {
            let (left, top) = (tile.x as u32 as f32, tile.y as u32 as f32);
            if (x - left - 32.0).abs() < 32.0 + radius && (y - top - 32.0).abs() < 32.0 + radius {
                let (place, strength) = catalogue()[number];
                self.add(tile, (x, y, radius), |d| {
                    let q = (1.0 - (d * 120.0 - place).length() / 0.22).max(0.0);
                    let light = self.night * (8.0 * d.y).min(1.0) * strength * q * q;
                    vec3a(0.9, 0.95, 1.0) * light
                });
            }
        }
        if let Some(disc) = self.disc {
            self.add(tile, disc, |d| vec3a(3.0, 2.4, 1.6) * smoothstep(0.99978, 0.99990, d.dot(self.gradient.sun)));
        }
        Stats::default()
    }
}

/// The point and the strength of every star that the sphere of 120 cells meets. They do not depend on time and are made
/// once.
fn catalogue() -> &'static [(Vec3A, f32)] {
    static STARS: OnceLock<Vec<(Vec3A, f32)>> = OnceLock::new();
    STARS.get_or_init(|| {
        let mut stars = Vec::new();
        for n in 0..1u32 << 24 {
            let cell = [n & 255, n >> 8 & 255, n >> 16].map(|k| k as f32 - 128.0);
            let cell = Vec3A::from(cell);
            // Nearer to the sphere than half of a cell's diagonal and a little more.
            if cell.y < -1.0 || ((cell + 0.5).length() - 120.0).abs() > 1.1 {
                continue;
            }
            let draw = |j: u32| (pcg(pcg(n).wrapping_add(j)) >> 8) as f32 / 16_777_216.0;
            let place = cell + 0.3 + 0.4 * vec3a(draw(1), draw(2), draw(3));
            if draw(0) < 0.03 && (place.length() - 120.0).abs() < 0.23 {
                stars.push((place, 0.3 + 1.7 * draw(4) * draw(4)));
            }
        }
        stars
    })
}
