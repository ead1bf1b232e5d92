//! The disc of the sun, and light between surfaces, over the triangles of the scene `shadow`: a path tracer that has either
//! or neither.

use super::triangles::{Hit, Triangles};
use super::{Random, Row, frame, told};
use crate::metrics::Error;
use glam::{DVec3, dvec3};
use paprsek::scenes::bench::shadow_set;
use std::f64::consts::TAU;
use std::time::Instant;

/// The sun's radius as seen from the earth, radians.
const SUN: f64 = 0.2666 * TAU / 360.0;
/// The light of the scene `shadow`: that of the sky, and that of the sun.
const SKY: DVec3 = dvec3(0.20, 0.27, 0.40);
const SUNLIGHT: DVec3 = dvec3(1.05, 0.92, 0.74);

struct Ground {
    triangles: Triangles,
    towards: DVec3,
}

impl Ground {
    /// The sun on a surface, as the mean of `rays` over its disc; one ray is to its middle.
    fn sun(&self, point: DVec3, hit: &Hit, rays: u32, random: &mut Random) -> DVec3 {
        let right = self.towards.any_orthonormal_vector();
        let up = self.towards.cross(right);
        let cosine = hit.normal.dot(self.towards).max(0.0);
        if cosine == 0.0 {
            return DVec3::ZERO;
        }
        let lit = (0..rays).filter(|_| {
            let (radius, angle) = (SUN * random.next().sqrt(), TAU * random.next());
            let aside = if rays == 1 { DVec3::ZERO } else { radius * (right * angle.cos() + up * angle.sin()) };
            self.triangles.hit(point, (self.towards + aside).normalize(), 1e4).is_none()
        });
        SUNLIGHT * cosine * lit.count() as f64 / f64::from(rays)
    }

    /// The light that is not the sun's: the model's formula if there are no rays, else what they gather of the sky and of
    /// surfaces, which have the model's light. The sky is such that the formula is exact where nothing stands before it.
    fn around(&self, point: DVec3, hit: &Hit, rays: u32, random: &mut Random) -> DVec3 {
        if rays == 0 {
            return SKY * (0.6 + 0.4 * hit.normal.y);
        }
        let right = hit.normal.any_orthonormal_vector();
        let up = hit.normal.cross(right);
        let mut sum = DVec3::ZERO;
        for _ in 0..rays {
            let (share, angle) = (random.next(), TAU * random.next());
            let d = (right * angle.cos() + up * angle.sin()) * share.sqrt() + hit.normal * (1.0 - share).sqrt();
            sum += match self.triangles.hit(point, d, 1e4) {
                // The mean over a hemisphere by the cosine adds two thirds of what goes with the height.
                None => SKY * (0.6 + 0.6 * d.y),
                Some(met) => {
                    let there = point + d * met.distance + met.normal * 1e-3;
                    met.albedo * (self.around(there, &met, 0, random) + self.sun(there, &met, 1, random))
                }
            };
        }
        sum / f64::from(rays)
    }

    /// A picture, and the seconds that it took.
    fn picture(&self, (width, height): (usize, usize), sun: u32, around: u32) -> (Vec<[f64; 3]>, f64) {
        let began = Instant::now();
        let eye = shadow_set::eye(2.0);
        let forward = (dvec3(0.0, 0.5, 0.0) - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let scale = (25f64.to_radians()).tan();
        let mut random = Random(1);
        let mut linear = vec![[0.0; 3]; width * height];
        for (index, to) in linear.iter_mut().enumerate() {
            let (x, y) = ((index % width) as f64 + 0.5, (index / width) as f64 + 0.5);
            let (x, y) = ((2.0 * x - width as f64) / height as f64, (height as f64 - 2.0 * y) / height as f64);
            let d = (forward + (right * x + up * y) * scale).normalize();
            let light = match self.triangles.hit(eye, d, 1e4) {
                None => dvec3(0.42, 0.55, 0.72),
                Some(hit) => {
                    let point = eye + d * hit.distance + hit.normal * 1e-3;
                    hit.albedo
                        * (self.around(point, &hit, around, &mut random) + self.sun(point, &hit, sun, &mut random))
                }
            };
            *to = light.to_array();
        }
        (linear, began.elapsed().as_secs_f64())
    }
}

/// The sun's disc at two heights, and light between surfaces.
pub fn rows(quick: bool) -> Vec<Row> {
    let (size, rays) = if quick { ((32, 18), 16) } else { ((256, 144), 64) };
    let scaled = (1280 * 720) as f64 / (size.0 * size.1) as f64;
    let triangles = || Triangles::new(&shadow_set::meshes());
    let mut rows = Vec::new();
    let picture = |ground: &Ground, sun, around| {
        let (linear, seconds) = ground.picture(size, sun, around);
        (frame(size.0, size.1, &linear), seconds)
    };
    for (name, slope) in [("32 degrees high", 0.62), ("6 degrees high", 0.105)] {
        let ground = Ground { triangles: triangles(), towards: dvec3(0.3f64.cos(), slope, 0.3f64.sin()).normalize() };
        let (hard, base) = picture(&ground, 1, 0);
        let (soft, seconds) = picture(&ground, rays, 0);
        // One more ray per pixel, times what a soft edge needs.
        let ray = 1e3 * (seconds - base) / f64::from(rays - 1) * scaled;
        rows.push(Row {
            what: "rasterizer: the sun's disc (soft shadows)",
            scene: format!("`shadow`, sun {name}"),
            reference: format!("{rays} rays per pixel over a disc of 0.53 degrees, f64"),
            error: told(&Error::between(&hard, &soft)),
            cost: format!("{:.0} for 16 traced rays per pixel; {ray:.0} each", 16.0 * ray),
            bytes: "300 (a search for blockers in the map)",
        });
    }
    let ground = Ground { triangles: triangles(), towards: dvec3(0.3f64.cos(), 0.62, 0.3f64.sin()).normalize() };
    let (without, base) = picture(&ground, 1, 0);
    let (with, seconds) = picture(&ground, 1, rays);
    let ray = 1e3 * (seconds - base) / f64::from(rays) * scaled;
    rows.push(Row {
        what: "all: light between matt surfaces, and the sky that they hide",
        scene: "`shadow`, sun 32 degrees high".into(),
        reference: format!("{rays} rays per pixel over the hemisphere, one bounce, f64"),
        error: told(&Error::between(&without, &with)),
        cost: format!("{:.0} for 16 rays per pixel; {ray:.0} each", 16.0 * ray),
        bytes: "1500 (rays that meet triangles, and their boxes)",
    });
    rows
}
