//! Pictures that stand for clouds: an eye's place around a cloud is rounded to a lattice so fine that what lies before or
//! behind a picture's plane moves on the screen by no more than a bound in pixels.
//!
//! A picture holds what rays meet, not its light's colours, and depends on nothing but its [`Plan`]. So frames do not
//! depend on which pictures are kept, clouds of one shape share them, and a sun that only changes its colour makes none.

use super::march::{Cloud, Look, Passage, march};
use super::voxels::{Voxels, square};
use super::{CloudLayer, Seen};
use crate::frame::{Layer, Tile, Workers};
use crate::settings::CloudSettings;
use crate::simd::lanes::{F, U, V3};
use crate::view::Camera;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::{PI, TAU};
use std::sync::{Arc, Mutex, PoisonError};

/// An eye closer than this sees the cloud itself, halves of its cube's edge; and the share of that in which it fades.
const CLOSE: f32 = 2.5;
const FADE: f32 = 0.1;
/// The share of the way between two points of the lattice in which their pictures fade into each other.
const BAND: f32 = 0.25;
/// Where a picture's plane is, of the way from the cloud's middle to the nearest that it may reach.
const PLANE: f32 = 0.5;
/// Pixels that a texel has at most, and half of one more than the bound.
const TEXEL: f32 = 1.5;
/// Texels along the edge of a picture: at most, and fewer than these are not worth one.
const TEXELS: [f32; 2] = [8.0, 512.0];
/// Frames after which a picture that none needs is forgotten.
const KEPT: u32 = 120;

/// All that a picture depends on.
#[derive(Clone)]
struct Plan {
    voxels: Arc<Voxels>,
    extinction: f32,
    quality: CloudSettings,
    /// From the cloud's middle, halves of the cube's edge.
    eye: Vec3,
    /// Texels along the edge.
    edge: usize,
}

impl Plan {
    fn is(&self, o: &Plan) -> bool {
        Arc::ptr_eq(&self.voxels, &o.voxels)
            && (self.extinction, self.quality, self.eye, self.edge) == (o.extinction, o.quality, o.eye, o.edge)
    }
}

/// A square picture of a cloud, seen from its plan's eye.
pub struct Imposter {
    plan: Plan,
    camera: Camera,
    /// Towards that eye; how far this way the plane is; and along rows and columns, a texel a unit.
    towards: Vec3,
    plane: f32,
    right: Vec3,
    down: Vec3,
    /// Transmittance, light from above and of the sun, of 255.
    texels: Vec<[u8; 4]>,
    /// The same of four texels, as in [`Voxels`].
    cells: Vec<[u32; 3]>,
}

impl Imposter {
    fn new(plan: Plan) -> Imposter {
        let (way, reach, edge) = (plan.eye.length(), plan.voxels.reach(), plan.edge);
        let towards = plan.eye / way;
        // A margin of a texel, in which nothing is.
        let wide = reach / (way * way - reach * reach).sqrt() * edge as u32 as f32 / (edge - 2) as u32 as f32;
        let camera = Camera::look_at(plan.eye, Vec3::ZERO, 2.0 * wide.atan(), 0.0);
        let plane = PLANE * reach;
        let texel = edge as u32 as f32 * 0.5 / (wide * wide * (way - plane));
        let [right, down] = [camera.right * texel, camera.up * -texel];
        let size = edge.next_multiple_of(Tile::SIZE);
        Imposter {
            plan,
            camera,
            towards,
            plane,
            right,
            down,
            texels: vec![[255, 0, 0, 0]; size * size],
            cells: Vec::new(),
        }
    }

    /// The picture, which is a layer like any other: what is lit from above is green, and what is lit by the sun blue.
    fn layer(&self) -> CloudLayer {
        let Plan { voxels, quality, extinction, edge, .. } = &self.plan;
        let cloud = Cloud { voxels: voxels.clone(), centre: Vec3::ZERO, size: 1.0, extinction: *extinction };
        let look = Look { ambient: [Vec3::ZERO, Vec3::Y], towards: Vec3::Y, sun: Vec3::Z, phase: [1.0, 0.0] };
        let view = View::new(self.camera, *edge, *edge);
        CloudLayer::new(vec![cloud], look, |_| Vec3::ZERO, f32::INFINITY, view, *quality)
    }

    /// Makes what lookups read.
    fn pack(&mut self) {
        let (n, size) = (self.plan.edge, self.plan.edge.next_multiple_of(Tile::SIZE));
        // A tile's texels come one after another.
        let texel = |x: usize, y: usize| {
            let tile = x / Tile::SIZE + y / Tile::SIZE * (size / Tile::SIZE);
            self.texels[tile * Tile::AREA + x % Tile::SIZE + y % Tile::SIZE * Tile::SIZE]
        };
        self.cells.resize(n * n, [0; 3]);
        for (index, cell) in self.cells.iter_mut().enumerate() {
            let (x, y) = (index % n, index / n);
            let (right, below) = ((x + 1).min(n - 1), (y + 1).min(n - 1));
            let at = [texel(x, y), texel(right, y), texel(x, below), texel(right, below)];
            *cell = [0, 1, 2].map(|k| u32::from_le_bytes(at.map(|texel| texel[k])));
        }
        self.texels = Vec::new();
    }
}

/// What rays along unit directions `d` meet of a cloud that has pictures; nothing beyond `limit`.
#[simd]
pub fn look_up<S: Simd>(simd: S, seen: &Seen, eye: Vec3, d: V3<S>, limit: F<S>, opaque: f32) -> Passage<S> {
    let zero = F::<S>::splat(simd, 0.0);
    let q = (eye - seen.cloud.centre) / seen.cloud.size;
    let mut sums = [zero; 3];
    if seen.direct > 0.0 {
        let met = march(simd, &seen.cloud, eye, d, limit, [seen.steps, opaque]);
        sums = [met.transmittance * seen.direct, met.upper * seen.direct, met.lit * seen.direct];
    }
    let mut share = 1.0 - seen.direct;
    for (picture, weight) in &seen.imposters {
        let Imposter { towards, plane, right, down, .. } = picture.as_ref();
        let n = picture.plan.edge as u32 as f32;
        let way = F::<S>::splat(simd, plane - q.dot(*towards)) / d.dot1(*towards);
        let x = d.dot1(*right) * way + (q.dot(*right) + n * 0.5 - 0.5);
        let y = d.dot1(*down) * way + (q.dot(*down) + n * 0.5 - 0.5);
        let inside = (x.min(y)).simd_ge(zero) & (x.max(y)).simd_le(n - 1.0) & limit.simd_gt(seen.distance);
        if !inside.any_true() {
            continue;
        }
        let (x, y) = (x.max(0.0).min(n - 1.0), y.max(0.0).min(n - 1.0));
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - top);
        let lanes = F::<S>::LEN;
        let mut at = [0; 16];
        (left + top * n).to_int::<U<S>>().store_slice(&mut at[..lanes]);
        let mut words = [[0; 16]; 3];
        for (lane, at) in at[..lanes].iter().enumerate() {
            let cell = picture.cells[*at as usize];
            words[0][lane] = cell[0];
            words[1][lane] = cell[1];
            words[2][lane] = cell[2];
        }
        let mut k = 0;
        while k < 3 {
            let value = square::<S>(U::<S>::from_slice(simd, &words[k][..lanes]), fx, fy);
            let scale = weight * if k == 2 { 1.0 } else { 1.0 / 255.0 };
            sums[k] += inside.select(value * scale, if k == 0 { F::<S>::splat(simd, *weight) } else { zero });
            k += 1;
        }
        share -= weight;
    }
    // Where a ray passes by a picture, nothing is hidden.
    let transmittance = sums[0] + share;
    let met = Passage { light: -transmittance + 1.0, upper: sums[1], lit: sums[2], transmittance };
    let reach = seen.cloud.voxels.reach() * seen.cloud.size;
    let cut = limit.simd_gt(seen.distance - reach) & limit.simd_lt(seen.distance + reach);
    if !cut.any_true() {
        return met;
    }
    // Before what is in the cloud rays are cast.
    let cast = march(simd, &seen.cloud, eye, d, limit, [seen.steps, opaque]);
    Passage {
        light: cut.select(cast.light, met.light),
        upper: cut.select(cast.upper, met.upper),
        lit: cut.select(cast.lit, met.lit),
        transmittance: cut.select(cast.transmittance, met.transmittance),
    }
}

/// Weights of a point of a lattice and of the next, at a share of the way between them.
fn blend(share: f32) -> [f32; 2] {
    let u = ((share - 0.5) / BAND + 0.5).clamp(0.0, 1.0);
    let u = u * u * (3.0 - 2.0 * u);
    [1.0 - u, u]
}

/// The eyes of the pictures for an eye at `q` from a cloud that reaches that far, and their weights. Pixels are in radians.
fn eyes(q: Vec3, reach: f32, bound: f32) -> Vec<(Vec3, f32)> {
    let mut eyes = Vec::new();
    let way = q.length();
    // Perspective asks for less far away: what is `z` before the plane and `x` beside the middle moves by `x z / way^2`.
    let next = |way: f32| way * (1.0 + (8.0 * bound * way * way / (reach * reach)).min(0.5));
    let mut near = CLOSE;
    while next(near) < way {
        near = next(near);
    }
    let far = next(near);
    for (way, weight) in [near, far].into_iter().zip(blend((way - near) / (far - near))) {
        // What is `z` before the plane moves by `z` times the angle.
        let step = (2.0 * bound * way / (PLANE * reach)).min(0.5);
        let rows = (PI / step).ceil();
        let row = (q.y / q.length()).clamp(-1.0, 1.0).acos() / PI * rows;
        for (row, weight) in [row.floor(), row.floor() + 1.0].into_iter().zip(blend(row.fract()).map(|w| w * weight)) {
            let (sin, cos) = (row / rows * PI).sin_cos();
            let columns = (TAU * sin.abs() / step).ceil().max(1.0);
            let column = (q.z.atan2(q.x) / TAU + 0.5) * columns;
            for (column, share) in [column.floor(), column.floor() + 1.0].into_iter().zip(blend(column.fract())) {
                let around = column % columns / columns * TAU;
                let eye = Vec3::new(-sin * around.cos(), cos, -sin * around.sin()) * way;
                if weight * share > 0.0 {
                    eyes.push((eye, weight * share));
                }
            }
        }
    }
    eyes
}

/// Gives clouds their pictures: those of frames before, or new ones.
pub fn prepare(clouds: &mut CloudLayer, workers: &Workers) {
    /// The number of this frame; of the last that needed it, and a picture.
    type Keep = (u32, Vec<(u32, Arc<Imposter>)>);
    static KEEP: Mutex<Keep> = Mutex::new((0, Vec::new()));
    let mut keep = KEEP.lock().unwrap_or_else(PoisonError::into_inner);
    let (now, kept) = &mut *keep;
    *now += 1;
    let (camera, pixel) = (*clouds.view.camera(), clouds.view.pixel());
    let quality = clouds.quality;
    let sides = clouds.view.sides();
    let texel = (quality.imposter + 0.5).min(TEXEL);
    let mut wanted: Vec<(usize, Plan, f32)> = Vec::new();
    let mut new: Vec<Imposter> = Vec::new();
    for (number, seen) in clouds.clouds.iter_mut().enumerate() {
        let cloud = &seen.cloud;
        let (q, reach) = ((camera.eye - cloud.centre) / cloud.size, cloud.voxels.reach());
        let beside = sides.iter().any(|side| side.dot(q) > reach);
        let way = q.length();
        let texels = 2.0 * reach / (way * pixel);
        if beside || way <= CLOSE || texels < TEXELS[0] {
            continue;
        }
        seen.direct = 1.0 - ((way / CLOSE - 1.0) / FADE).min(1.0);
        for (eye, weight) in eyes(q, reach, quality.imposter * pixel) {
            let way = eye.length();
            let edge =
                (2.0 * reach / ((way * way - reach * reach).sqrt() * pixel * texel)).min(TEXELS[1]).ceil() as usize + 2;
            // Clouds that come out of nothing must not need a picture for every frame.
            let (voxels, extinction) = (cloud.voxels.clone(), cloud.extinction.ceil());
            let quality = CloudSettings { imposter: 0.0, ..quality };
            let plan = Plan { voxels, extinction, quality, eye, edge };
            let old = kept.iter_mut().find(|(_, old)| old.plan.is(&plan));
            match old {
                Some((used, _)) => *used = *now,
                None if new.iter().any(|new| new.plan.is(&plan)) => {}
                None => new.push(Imposter::new(plan.clone())),
            }
            wanted.push((number, plan, weight * (1.0 - seen.direct)));
        }
    }
    let level = workers.level();
    let mut texels: Vec<_> = new.iter_mut().map(|new| std::mem::take(&mut new.texels)).collect();
    let layers: Vec<_> = new.iter().map(|new| (new.layer(), new.plan.edge)).collect();
    let tiles = texels.iter_mut().zip(&layers).flat_map(|(texels, layer)| {
        texels.chunks_mut(Tile::AREA).enumerate().map(move |(number, texels)| (layer, number, texels))
    });
    workers.each(tiles, |((layer, edge), number, texels)| {
        let columns = edge.div_ceil(Tile::SIZE);
        let mut tile = Tile::at(number % columns, number / columns, *edge, *edge);
        layer.draw(level, &mut tile);
        for (at, texel) in texels.iter_mut().enumerate() {
            let values =
                [1.0 - tile.coverage[at], tile.green[at], tile.blue[at]].map(|value| (value * 255.0 + 0.5) as u8);
            *texel = [values[0], values[1], values[2], 0];
        }
    });
    for (new, texels) in new.iter_mut().zip(texels) {
        new.texels = texels;
    }
    workers.each(new.iter_mut(), Imposter::pack);
    kept.retain(|(used, _)| *now - used <= KEPT);
    kept.extend(new.into_iter().map(|new| (*now, Arc::new(new))));
    for (number, plan, weight) in wanted {
        let picture = kept.iter().find(|(_, old)| old.plan.is(&plan));
        clouds.clouds[number].imposters.extend(picture.map(|(_, picture)| (picture.clone(), weight)));
    }
}
