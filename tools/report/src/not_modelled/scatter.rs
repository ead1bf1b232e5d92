//! Light that is scattered many times in a cloud, by brute force: photons' paths backwards from the eye through the voxels,
//! by delta tracking (Woodcock, 1965), against baked light.

use super::{Random, Row};
use glam::{DVec3, dvec3};
use paprsek::cloud::Voxels;
use paprsek::scenes::bench::cumulus_set;
use std::f64::consts::TAU;
use std::time::Instant;

/// Extinction at the greatest density, per half of the cube's edge, as in `cumulus`.
const EXTINCTION: f64 = 30.0;
/// Mean cosine of the scattering of droplets, for Henyey's and Greenstein's phase function.
const MEAN_COSINE: f64 = 0.85;
/// After so many, a path has hardly any light left to find.
const MOST: u32 = 400;

struct Cloud<'a> {
    voxels: &'a Voxels,
    towards: DVec3,
}

impl Cloud<'_> {
    /// Trilinear lookup of one of the channels, 0 to 1; 0 outside of the cube.
    fn at(&self, channel: impl Fn(usize) -> u8, p: DVec3) -> f64 {
        if p.abs().max_element() >= 1.0 {
            return 0.0;
        }
        let edge = self.voxels.edge();
        let u = (p * 0.5 + 0.5) * edge as f64 - 0.5;
        let base = u.floor();
        let share = u - base;
        let mut sum = 0.0;
        for corner in 0..8usize {
            let bits = [corner & 1, corner >> 1 & 1, corner >> 2];
            let axis = |k: usize| (base[k] as i64 + bits[k] as i64).clamp(0, edge as i64 - 1) as usize;
            let weight: f64 = (0..3).map(|k| if bits[k] == 1 { share[k] } else { 1.0 - share[k] }).product();
            sum += weight * f64::from(channel((axis(2) * edge + axis(1)) * edge + axis(0)));
        }
        sum / 255.0
    }

    fn density(&self, p: DVec3) -> f64 {
        self.at(|point| self.voxels.density()[point], p)
    }

    /// Share of the light that passes from a point to the sun.
    fn passes(&self, p: DVec3) -> f64 {
        let step = 2.0 / 48.0;
        let depth: f64 = (0..80).map(|k| self.density(p + self.towards * (f64::from(k) + 0.5) * step)).sum();
        (-EXTINCTION * step * depth).exp()
    }

    /// Sunlight along a ray of parallel projection: by paths of at most `most` scatterings.
    fn path(&self, mut p: DVec3, mut d: DVec3, most: u32, random: &mut Random) -> f64 {
        let mut light = 0.0;
        for _ in 0..most {
            // To the next droplet, or out.
            loop {
                p -= d * ((1.0 - random.next()).ln() / EXTINCTION);
                if p.dot(d) > 2.0 || p.length_squared() > 12.0 {
                    return light;
                }
                if random.next() < self.density(p) {
                    break;
                }
            }
            light += phase(d.dot(self.towards)) * self.passes(p);
            d = scattered(d, random);
        }
        light
    }

    /// Sunlight along a ray as the library has it: what is baked, weakened on its way to the eye. The scale is free.
    fn baked(&self, p: DVec3, d: DVec3) -> f64 {
        let (mut light, mut left, step) = (0.0, 1.0, 0.02);
        for k in 0..180 {
            let at = p + d * (f64::from(k) + 0.5) * step;
            let opaque = 1.0 - (-EXTINCTION * step * self.density(at)).exp();
            light += left * opaque * self.at(|point| self.voxels.light(point), at);
            left *= 1.0 - opaque;
        }
        light
    }
}

/// Henyey's and Greenstein's, per steradian.
fn phase(cosine: f64) -> f64 {
    let g = MEAN_COSINE;
    (1.0 - g * g) / (2.0 * TAU * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))
}

/// A direction drawn by the phase function.
fn scattered(d: DVec3, random: &mut Random) -> DVec3 {
    let g = MEAN_COSINE;
    let s = (1.0 - g * g) / (1.0 - g + 2.0 * g * random.next());
    let cosine = ((1.0 + g * g - s * s) / (2.0 * g)).clamp(-1.0, 1.0);
    let (angle, sine) = (TAU * random.next(), (1.0 - cosine * cosine).sqrt());
    let right = d.any_orthonormal_vector();
    (d * cosine + (right * angle.cos() + d.cross(right) * angle.sin()) * sine).normalize()
}

/// Baked light, and light that is scattered once, against light that is scattered as often as it comes.
pub fn rows(quick: bool) -> Vec<Row> {
    let (side, paths) = if quick { (12, 8) } else { (40, 256) };
    let voxels = cumulus_set::shape(0);
    let towards = cumulus_set::sun().as_dvec3();
    let cloud = Cloud { voxels: &voxels, towards };
    // From the side: the sun is to the right, behind the eye.
    let d = dvec3(0.2, 0.1, -1.0).normalize();
    let right = d.cross(DVec3::Y).normalize();
    let up = right.cross(d);
    let mut random = Random(3);
    let (mut seconds, mut noise) = (0.0, 0.0f64);
    let (mut many, mut once, mut baked) = (Vec::new(), Vec::new(), Vec::new());
    for index in 0..side * side {
        let at = |n: usize| ((n as f64 + 0.5) / side as f64 - 0.5) * 1.8;
        let from = right * at(index % side) + up * at(index / side) - d * 1.8;
        let began = Instant::now();
        let halves = [(); 2].map(|()| mean(&cloud, (from, d), MOST, paths / 2, &mut random));
        seconds += began.elapsed().as_secs_f64();
        many.push(0.5 * (halves[0] + halves[1]));
        noise += (0.5 * (halves[0] - halves[1])).powi(2);
        once.push(mean(&cloud, (from, d), 1, paths, &mut random));
        baked.push(cloud.baked(from, d));
    }
    // Half of the difference of two halves has the standard deviation of their mean.
    let noise = (noise / many.len() as f64).sqrt() / (many.iter().sum::<f64>() / many.len() as f64);
    let full = 1e3 * seconds / (side * side) as f64 / f64::from(paths) * (1280.0 * 720.0 / 4.0);
    [("baked light, two terms (the model)", baked), ("light that is scattered once", once)]
        .into_iter()
        .map(|(name, model)| {
            let (rms, scale) = fitted(&model, &many);
            Row {
                what: "clouds: light scattered more than once",
                scene: format!("`cumulus`'s cloud from the side, drawn with {name}"),
                reference: format!("{paths} paths of up to {MOST} scatterings per pixel, g = {MEAN_COSINE}, f64"),
                error: format!(
                    "RMS of {:.2} of the picture's mean light, the reference's own noise of {noise:.2} taken off; brightness \
                     fitted (by {scale:.2}), since it is an artist's choice",
                    (rms * rms - noise * noise).max(0.0).sqrt()
                ),
                cost: format!("{full:.0} for one path per pixel, clouds on a quarter of them"),
                bytes: "400 (paths); the two terms cost 30",
            }
        })
        .collect()
}

/// The mean light of paths along a ray.
fn mean(cloud: &Cloud, (from, d): (DVec3, DVec3), most: u32, paths: u32, random: &mut Random) -> f64 {
    (0..paths).map(|_| cloud.path(from, d, most, random)).sum::<f64>() / f64::from(paths)
}

/// The root mean square of `scale model - truth` over the mean of the truth, at the best scale; and the scale.
fn fitted(model: &[f64], truth: &[f64]) -> (f64, f64) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scale = dot(model, truth) / dot(model, model);
    let square = model.iter().zip(truth).map(|(m, t)| (scale * m - t).powi(2)).sum::<f64>() / truth.len() as f64;
    (square.sqrt() / (truth.iter().sum::<f64>() / truth.len() as f64), scale)
}
