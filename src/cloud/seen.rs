//! Clouds as they are seen from an eye: sorted by distance, each with the steps that it is worth, and with the air and
//! the shadows of others between.

use super::imposter::Imposter;
use super::march::{Passage, march};
use super::shadow;
use super::voxels::Voxels;
use super::world::{Cloud, CloudLight};
use crate::cuts;
use crate::frame::Tile;
use crate::settings::CloudSettings;
use crate::simd::lanes::{F, V3};
use crate::simd::math::to_f32;
use crate::view::{Camera, Cone, View};
use fearless_simd::prelude::*;
use glam::Vec3A;
use std::sync::Arc;

/// Distance from the centre of a cube to a corner, halves of its edge: the root of 3.
const ROOT: f32 = 1.732_051;

/// The least number of steps along the edge of a cube, however small it is on the screen.
const LEAST_STEPS: f32 = 8.0;

/// Share of the sun's light that reaches a cloud in the deepest shadow of others: air and clouds scatter some to it.
const LEAST_SUN: f32 = 0.25;

/// A cloud as it is seen from an eye.
pub(super) struct SeenCloud {
    pub cloud: Cloud,
    /// Distance of its centre from the eye, metres.
    pub distance: f32,
    /// Steps along an edge of its cube.
    pub steps: f32,
    /// Its detail below a voxel.
    pub fine: Option<Arc<Voxels>>,
    /// The share of its light that comes through the air.
    pub fades: f32,
    /// The light of the air before it, where it hides all that is behind.
    pub veil: Vec3A,
    /// The share of the sun's light that reaches it past other clouds.
    pub sunlit: f32,
    /// Imposters that stand for it, with their weights.
    pub imposters: Vec<(Arc<Imposter>, f32)>,
    /// The weight of the cloud itself: 1 less those of its imposters.
    pub direct: f32,
}

/// The clouds of a picture.
pub(super) struct SeenClouds {
    /// Nearest first.
    pub clouds: Vec<SeenCloud>,
    pub light: CloudLight,
    pub view: View,
    pub settings: CloudSettings,
    /// The number of the frame, by which imposters have an age.
    #[cfg(feature = "full")]
    pub frame: u32,
}

impl SeenClouds {
    /// Clouds, in any order, as the view's eye sees them in clear air. Those behind it are left out.
    pub fn new(clouds: Vec<Cloud>, light: CloudLight, view: &View, settings: &CloudSettings) -> SeenClouds {
        let Camera { eye, forward, .. } = *view.camera();
        let mut seen: Vec<SeenCloud> = Vec::new();
        for cloud in clouds {
            let way = cloud.centre - eye;
            if way.dot(forward) < -ROOT * cloud.size {
                continue;
            }
            let distance = way.length();
            let pixels = 2.0 * cloud.size / (distance * view.pixel());
            let CloudSettings { steps, detail, .. } = settings.built();
            let steps = (steps as f32).min((pixels * detail).max(LEAST_STEPS).ceil());
            let at = seen.iter().position(|other| other.distance > distance).unwrap_or(seen.len());
            let (fades, veil, sunlit) = (1.0, Vec3A::ZERO, 1.0);
            let new = SeenCloud {
                cloud,
                distance,
                steps,
                fine: None,
                fades,
                veil,
                sunlit,
                imposters: Vec::new(),
                direct: 1.0,
            };
            seen.insert(at, new);
        }
        SeenClouds {
            clouds: seen,
            light,
            view: *view,
            settings: *settings,
            #[cfg(feature = "full")]
            frame: 0,
        }
    }

    /// Gives the clouds detail below a voxel: see [`CloudLayer::with_grain`](super::CloudLayer::with_grain).
    pub fn add_grain(&mut self, table: &Arc<Voxels>) {
        for seen in &mut self.clouds {
            seen.fine = Some(table.clone());
        }
    }

    /// Puts air between the eye and the clouds: see [`CloudLayer::in_air`](super::CloudLayer::in_air).
    pub fn add_air(&mut self, range: f32, light: impl Fn(Vec3A) -> Vec3A) {
        let eye = self.view.camera().eye;
        for seen in &mut self.clouds {
            seen.fades = f64::from(-seen.distance / range).exp() as f32;
            seen.veil = light((seen.cloud.centre - eye) / seen.distance.max(1e-3)) * (1.0 - seen.fades);
        }
    }

    /// Takes from the clouds the sun's light that `others` keep from them.
    pub fn shade(&mut self, others: &[Cloud]) {
        let mut points = Vec::new();
        for seen in &self.clouds {
            points.push(seen.cloud.centre);
        }
        for (seen, share) in self.clouds.iter_mut().zip(shadow::shares(others, self.light.towards, &points)) {
            seen.sunlit = LEAST_SUN + (1.0 - LEAST_SUN) * share;
        }
    }

    /// The clouds that rays through a tile may meet, nearest first.
    pub fn near(&self, tile: &Tile) -> Vec<&SeenCloud> {
        const HALF: f32 = 0.5 * Tile::SIZE as f32;
        let cone = Cone::new(&self.view, (to_f32(tile.x) + HALF, to_f32(tile.y) + HALF), HALF);
        let eye = self.view.camera().eye;
        // Here and in the flight's shapes a loop: `collect` takes some 60 bytes more of the 64 kB build.
        let mut near = Vec::new();
        for seen in &self.clouds {
            if cone.may_meet(seen.cloud.centre - eye, seen.radius()) {
                near.push(seen);
            }
        }
        near
    }
}

impl SeenCloud {
    /// Distance from the eye beyond which it hides nothing more, metres.
    pub fn end(&self) -> f32 {
        self.distance + ROOT * self.cloud.size
    }

    /// Radius of the ball around all that rays may meet of it, metres.
    fn radius(&self) -> f32 {
        let whole = cuts::IMPOSTERS && !self.imposters.is_empty();
        self.cloud.size * if whole { ROOT } else { self.cloud.voxels.reach() }
    }

    /// What rays from `eye` along unit directions `d` meet of it, up to `limit` metres from the eye: of the cloud
    /// itself or of its imposters. A ray ends where its transmittance falls below `opaque`.
    #[inline(always)]
    pub fn meet<S: Simd>(&self, simd: S, eye: Vec3A, d: V3<S>, limit: F<S>, opaque: F<S>) -> Passage<S> {
        if cuts::IMPOSTERS && !self.imposters.is_empty() {
            self.meet_imposters(simd, eye, d, limit, opaque)
        } else {
            march(simd, (&self.cloud, self.fine.as_deref()), eye, d, limit, self.steps, opaque)
        }
    }

    /// [`Self::meet`] for a cloud with imposters: their weighted sum, with the cloud's own share where it has one.
    /// Where a solid stands in the cloud, rays are cast.
    #[inline(always)]
    fn meet_imposters<S: Simd>(&self, simd: S, eye: Vec3A, d: V3<S>, limit: F<S>, opaque: F<S>) -> Passage<S> {
        let zero = F::<S>::splat(simd, 0.0);
        let q = (eye - self.cloud.centre) / self.cloud.size;
        let mut sums = [zero; 3];
        if self.direct > 0.0 {
            let met = march(simd, (&self.cloud, self.fine.as_deref()), eye, d, limit, self.steps, opaque);
            sums = [met.transmittance * self.direct, met.upper * self.direct, met.lit * self.direct];
        }
        for (imposter, weight) in &self.imposters {
            let [x, y] = imposter.cross(simd, q, d);
            let most = imposter.most();
            let inside = x.min(y).simd_ge(zero) & x.max(y).simd_le(most) & limit.simd_gt(self.distance);
            // Where a ray passes by an imposter, nothing is hidden; and its sum is the same in any company.
            if !inside.any_true() {
                sums[0] += *weight;
                continue;
            }
            let values = imposter.look_up(simd, [x, y]);
            let mut k = 0;
            while k < 3 {
                let scale = weight * if k == 2 { 1.0 } else { 1.0 / 255.0 };
                let missed = if k == 0 { F::<S>::splat(simd, *weight) } else { zero };
                sums[k] += inside.select(values[k] * scale, missed);
                k += 1;
            }
        }
        let transmittance = sums[0];
        let end = F::<S>::splat(simd, f32::INFINITY);
        let met = Passage { hidden: -transmittance + 1.0, upper: sums[1], lit: sums[2], transmittance, end };
        let reach = self.cloud.voxels.reach() * self.cloud.size;
        let cut = limit.simd_gt(self.distance - reach) & limit.simd_lt(self.distance + reach);
        if !cut.any_true() {
            return met;
        }
        let cast = march(simd, (&self.cloud, self.fine.as_deref()), eye, d, limit, self.steps, opaque);
        Passage {
            hidden: cut.select(cast.hidden, met.hidden),
            upper: cut.select(cast.upper, met.upper),
            lit: cut.select(cast.lit, met.lit),
            transmittance: cut.select(cast.transmittance, met.transmittance),
            end,
        }
    }
}
