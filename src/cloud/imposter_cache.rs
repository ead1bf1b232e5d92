//! Which imposters a frame needs, and the making and keeping of them.
//!
//! The eye's place around a cloud is rounded to a lattice of distances and directions. The lattice is so fine that
//! nothing before or behind an imposter's plane is misplaced on the screen by more pixels than
//! [`CloudSettings::imposter`](crate::settings::CloudSettings::imposter). Between two points of the lattice their
//! imposters fade into each other, so nothing pops.
//!
//! An imposter depends on nothing but its [`ImposterPlan`]. So frames do not depend on which imposters are kept, and
//! clouds of one shape share them. The reference is the frame without imposters (`tests/cloud/imposters.rs`).

use super::cells;
use super::imposter::{Imposter, ImposterPlan, PLANE};
use super::seen::SeenClouds;
use super::world::{Cloud, CloudLight};
use crate::angle;
use crate::frame::cache::keep;
use crate::frame::{Tile, Workers};
use crate::settings::CloudSettings;
use crate::simd::math::smooth1;
use glam::Vec3A;
use std::f32::consts::{PI, TAU};
use std::sync::Arc;

/// The least angle, radians, that imposters may be off by: less is asked for by a telescope, whose clouds are looked at from
/// so near that they would need more imposters than pixels.
const FINEST: f32 = 1e-6;

/// An eye that is closer than this, in halves of the edge of the cube, sees the cloud itself. Within the share `FADE`
/// of that distance beyond it the cloud fades into its imposters.
const CLOSE: f32 = 2.5;
const FADE: f32 = 0.1;
/// The share of the way between two points of the lattice in which their imposters fade into each other.
const BAND: f32 = 0.25;
/// The largest edge of a texel, pixels. It is also at most the bound and half a pixel.
const TEXEL: f32 = 1.5;
/// Texels along an edge: an imposter with fewer than the first number is not worth its while, and none has more than
/// the second.
const TEXELS: [f32; 2] = [8.0, 512.0];
/// Frames after which an imposter that none has needed is dropped.
const KEPT: u32 = 120;

/// The imposters of a renderer.
pub(super) struct ImposterCache {
    /// The number of the frame.
    frame: u32,
    /// Imposters, each with the number of the last frame that needed it.
    kept: Vec<(u32, Arc<Imposter>)>,
}
keep!(ImposterCache, ImposterCache { frame: 0, kept: Vec::new() });

/// An imposter that a cloud needs: the cloud's number, and the weight.
struct Need {
    cloud: usize,
    plan: ImposterPlan,
    weight: f32,
}

impl ImposterCache {
    /// Gives clouds their imposters: those of earlier frames, or new ones.
    pub fn prepare(&mut self, clouds: &mut SeenClouds, workers: &Workers) {
        self.frame += 1;
        let needs = needs(clouds);
        let mut new: Vec<Imposter> = Vec::new();
        for Need { plan, .. } in &needs {
            match self.kept.iter_mut().find(|(_, old)| old.plan.is(plan)) {
                Some((used, _)) => *used = self.frame,
                None if new.iter().any(|new| new.plan.is(plan)) => {}
                None => new.push(Imposter::new(plan.clone())),
            }
        }
        draw(&mut new, workers);
        #[cfg(feature = "full")]
        {
            clouds.frame = self.frame;
            new.iter_mut().for_each(|new| new.born = self.frame);
        }
        self.kept.retain(|(used, _)| self.frame - used <= KEPT);
        self.kept.extend(new.into_iter().map(|new| (self.frame, Arc::new(new))));
        for Need { cloud, plan, weight } in needs {
            let imposter = self.kept.iter().find(|(_, old)| old.plan.is(&plan));
            clouds.clouds[cloud].imposters.extend(imposter.map(|(_, imposter)| (imposter.clone(), weight)));
        }
    }
}

/// The imposters that the clouds of a frame need. Also sets how much of each cloud is seen directly.
fn needs(clouds: &mut SeenClouds) -> Vec<Need> {
    let (camera, pixel, settings) = (*clouds.view.camera(), clouds.view.pixel(), clouds.settings);
    let sides = clouds.view.sides();
    let texel = (settings.imposter + 0.5).min(TEXEL);
    let mut needs = Vec::new();
    for (number, seen) in clouds.clouds.iter_mut().enumerate() {
        let cloud = &seen.cloud;
        let (q, reach) = ((camera.eye - cloud.centre) / cloud.size, cloud.voxels.reach());
        let beside = sides.iter().any(|side| side.dot(q) > reach);
        let way = q.length();
        let texels = 2.0 * reach / (way * pixel);
        let coarse = settings.imposter * pixel >= FINEST;
        if beside || way <= CLOSE || texels < TEXELS[0] || !coarse {
            continue;
        }
        seen.direct = 1.0 - ((way / CLOSE - 1.0) / FADE).min(1.0);
        for (eye, weight) in eyes(q, reach, settings.imposter * pixel) {
            let way = eye.length();
            let edge =
                (2.0 * reach / ((way * way - reach * reach).sqrt() * pixel * texel)).min(TEXELS[1]).ceil() as usize + 2;
            // Rounded, so that clouds which come out of nothing do not need an imposter for every frame.
            let (voxels, extinction) = (cloud.voxels.clone(), cloud.extinction.ceil());
            let settings = CloudSettings { imposter: 0.0, ..settings };
            let plan = ImposterPlan { voxels, extinction, settings, eye, edge };
            needs.push(Need { cloud: number, plan, weight: weight * (1.0 - seen.direct) });
        }
    }
    needs
}

/// Draws new imposters, with the clouds' own rays: light from above is made green, and light of the sun blue.
fn draw(new: &mut [Imposter], workers: &Workers) {
    let light = CloudLight { ambient: [Vec3A::ZERO, Vec3A::Y], towards: Vec3A::Y, sun: Vec3A::Z, phase: [1.0, 0.0] };
    let mut texels: Vec<_> = new.iter().map(|new| vec![[255, 0, 0, 0]; new.area()]).collect();
    let clouds: Vec<_> = new
        .iter()
        .map(|new| {
            let ImposterPlan { voxels, extinction, settings, .. } = &new.plan;
            let cloud = Cloud { voxels: voxels.clone(), centre: Vec3A::ZERO, size: 1.0, extinction: *extinction };
            SeenClouds::new(vec![cloud], light, &new.view(), settings)
        })
        .collect();
    let tiles = texels.iter_mut().zip(&clouds).flat_map(|(texels, clouds)| {
        texels.chunks_mut(Tile::AREA).enumerate().map(move |(number, texels)| (clouds, number, texels))
    });
    workers.each(tiles, |(clouds, number, texels)| {
        let edge = clouds.view.width();
        let columns = edge.div_ceil(Tile::SIZE);
        let mut tile = Tile::at(number % columns, number / columns, edge, edge);
        cells::draw(workers.level(), clouds, &mut tile);
        for (at, texel) in texels.iter_mut().enumerate() {
            let values =
                [1.0 - tile.coverage[at], tile.green[at], tile.blue[at]].map(|value| (value * 255.0 + 0.5) as u8);
            *texel = [values[0], values[1], values[2], 0];
        }
    });
    workers.each(new.iter_mut().zip(&texels), |(new, texels)| new.pack(texels));
}

/// Weights of a point of a lattice and of the next, at a share of the way between them.
fn blend(share: f32) -> [f32; 2] {
    let u = smooth1((share - 0.5) / BAND + 0.5);
    [1.0 - u, u]
}

/// The places that imposters are made for, with their weights, where the eye is at `q` from the centre of a cloud.
/// Lengths are in halves of the edge of the cube, `reach` is the cloud's, and `bound` is an angle in radians.
fn eyes(q: Vec3A, reach: f32, bound: f32) -> Vec<(Vec3A, f32)> {
    let mut eyes = Vec::new();
    let way = q.length();
    // As the eye comes nearer, what is `z` before the plane and `x` beside the centre moves by `x z / way^2` per
    // length: so the lattice of distances becomes coarser far away.
    let next = |way: f32| way * (1.0 + (8.0 * bound * way * way / (reach * reach)).min(0.5));
    let mut near = CLOSE;
    while next(near) < way {
        near = next(near);
    }
    let far = next(near);
    for (way, weight) in [near, far].into_iter().zip(blend((way - near) / (far - near))) {
        // As the eye goes around by an angle, what is `z` before the plane moves by `z` times that.
        let step = (2.0 * bound * way / (PLANE * reach)).min(0.5);
        let rows = (PI / step).ceil();
        let row = f64::from((q.y / q.length()).clamp(-1.0, 1.0)).acos() as f32 / PI * rows;
        for (row, weight) in [row.floor(), row.floor() + 1.0].into_iter().zip(blend(row.fract()).map(|w| w * weight)) {
            let (sin, cos) = angle::sin_cos(row / rows * PI);
            let columns = (TAU * sin.abs() / step).ceil().max(1.0);
            let column = (f64::from(q.z).atan2(q.x.into()) as f32 / TAU + 0.5) * columns;
            for (column, share) in [column.floor(), column.floor() + 1.0].into_iter().zip(blend(column.fract())) {
                let (across, along) = angle::sin_cos(column % columns / columns * TAU);
                let eye = Vec3A::new(-sin * along, cos, -sin * across) * way;
                if weight * share > 0.0 {
                    eyes.push((eye, weight * share));
                }
            }
        }
    }
    eyes
}
