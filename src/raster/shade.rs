//! From what is visible in a tile to light: fragments wait until a block of one texture is full, and each is shaded once.

use super::bins::{Id, NOTHING, TEXTURE, parts};
use super::fill::{Sample, Visible};
use super::light::{Light, ShadowLookup, Source};
use super::snow_cover::settle;
use super::triangle::{SUB, Triangle};
use super::{Raster, World};
use crate::cuts::BENCH;
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{Bits, F, Lane, STEPS, U, V3, float};
use crate::simd::math;
use crate::texture::{self, Block3};
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;

/// What shading reads of the frame.
pub struct Context<'a> {
    /// Materials, lights, haze.
    pub world: &'a World,
    /// What each light sees; last, what snow falls on.
    pub sights: &'a [ShadowLookup],
    /// The camera's raster, and those of lights.
    pub rasters: &'a [Raster],
    /// The camera.
    pub view: &'a View,
    /// What a sample counts, of its pixel.
    pub share: f32,
}

/// Nearness of the farthest: beyond, squares of distances are infinite.
const FARTHEST: f32 = 1e-18;

/// Fragments that wait: parts of pixels that show one triangle each, all of one texture.
#[derive(Clone)]
pub struct Queue {
    /// How many; a block is shaded, the second has room for the rest of a vector.
    pub count: usize,
    /// The pixel's index in its tile; from bit 12 on where in the pixel it is looked at along x, steps of 1/256, from bit
    /// 20 on along y; from bit 28 on the number of its samples, less one.
    place: [[u32; BLOCK]; 2],
    id: [[Id; BLOCK]; 2],
    // What they show: here, and not on the stack, it need not be cleared.
    pub(super) point: Block3,
    pub(super) normal: Block3,
    pub(super) albedo: Block3,
    pub(super) light: Block3,
    /// The length of the pixel on the surface, metres.
    pub(super) footprint: [f32; BLOCK],
    pub(super) gloss: [f32; BLOCK],
    inv_depth: [f32; BLOCK],
    /// Share of the pixel.
    weight: [f32; BLOCK],
}

impl Queue {
    /// No fragments.
    pub const EMPTY: Queue = Queue {
        count: 0,
        place: [[0; BLOCK]; 2],
        id: [[0; BLOCK]; 2],
        point: [[0.0; BLOCK]; 3],
        normal: [[0.0; BLOCK]; 3],
        albedo: [[0.0; BLOCK]; 3],
        light: [[0.0; BLOCK]; 3],
        footprint: [0.0; BLOCK],
        gloss: [0.0; BLOCK],
        inv_depth: [0.0; BLOCK],
        weight: [0.0; BLOCK],
    };
}

/// A fragment of that many samples at the mean of `sum`, which is the sum of their places, in pixel 0.
fn fragment(samples: i32, [x, y]: Sample) -> u32 {
    ((samples - 1) << 28 | (y / samples) << 20 | (x / samples) << 12) as u32
}

/// Adds what the samples of a tile's pixels show, each sample at its place in a pixel, to the queues by the texture in
/// their [`Id`]s; returns the number of fragments.
#[inline(always)]
pub fn collect<S: Simd>(
    simd: S,
    context: &Context,
    planes: &[(Visible, Sample)],
    queues: &mut [Queue],
    tile: &mut Tile,
) -> u64 {
    let lanes = F::<S>::LEN;
    let mut sum = [0, 0];
    for (_, place) in planes {
        sum = [sum[0] + place[0], sum[1] + place[1]];
    }
    // Where all samples show the same.
    let whole = fragment(planes.len() as i32, sum);
    let wholes = S::u32s::from_slice(simd, &STEPS[..lanes]) + whole;
    let mut fragments = 0;
    for row in 0..tile.height {
        let mut column = 0;
        while column < tile.width {
            let at = row * Tile::SIZE + column;
            let first = &planes[0].0.id[at..at + lanes];
            let ids = U::<S>::from_slice(simd, first);
            let mut same = ids.simd_eq(ids);
            for (other, _) in &planes[1..] {
                same &= ids.simd_eq(U::<S>::from_slice(simd, &other.id[at..at + lanes]));
            }
            let empty = ids.simd_eq(NOTHING);
            let texture = first[0] >> TEXTURE;
            let alike = same & !empty & (ids >> TEXTURE).simd_eq(texture);
            let queue = &mut queues[texture as usize];
            let end = queue.count..queue.count + lanes;
            let left = tile.width - column;
            column += lanes;
            if lanes <= left && alike.all_true() {
                (wholes + at as u32).store_slice(&mut queue.place.as_flattened_mut()[end.clone()]);
                ids.store_slice(&mut queue.id.as_flattened_mut()[end.clone()]);
                queue.count = end.end;
                fragments += lanes as u64;
                if queue.count >= BLOCK {
                    flush(simd, context, texture as usize, queue, tile);
                }
                continue;
            }
            let in_use = (1 << lanes.min(left)) - 1;
            for lane in Bits(!(same & empty).to_bitmask() & in_use) {
                if same.to_bitmask() >> lane & 1 == 0 {
                    fragments += several(simd, context, planes, at + lane, queues, tile);
                } else {
                    push(simd, context, whole + (at + lane) as u32, planes[0].0.id[at + lane], queues, tile);
                    fragments += 1;
                }
            }
        }
    }
    fragments
}

/// Adds the triangles that a pixel's samples show where they are several, each where its samples are on the mean.
#[inline(never)]
fn several<S: Simd>(
    simd: S,
    context: &Context,
    planes: &[(Visible, Sample)],
    pixel: usize,
    queues: &mut [Queue],
    tile: &mut Tile,
) -> u64 {
    let mut fragments = 0;
    for (first, (plane, _)) in planes.iter().enumerate() {
        let id = plane.id[pixel];
        if id == NOTHING || planes[..first].iter().any(|(earlier, _)| earlier.id[pixel] == id) {
            continue;
        }
        let (mut samples, mut sum) = (0, [0, 0]);
        for (plane, place) in &planes[first..] {
            if plane.id[pixel] == id {
                (samples, sum) = (samples + 1, [sum[0] + place[0], sum[1] + place[1]]);
            }
        }
        push(simd, context, fragment(samples, sum) + pixel as u32, id, queues, tile);
        fragments += 1;
    }
    fragments
}

/// Adds a fragment.
#[inline(always)]
fn push<S: Simd>(simd: S, context: &Context, place: u32, id: Id, queues: &mut [Queue], tile: &mut Tile) {
    let texture = (id >> TEXTURE) as usize;
    let queue = &mut queues[texture];
    let at = queue.count & (BLOCK - 1);
    queue.place[0][at] = place;
    queue.id[0][at] = id;
    queue.count = at + 1;
    if queue.count == BLOCK {
        flush(simd, context, texture, queue, tile);
    }
}

/// How fast the mirrored sky goes from the horizon's colour to the zenith's: half of it in 1 / this of the sine.
const RISE: f32 = 4.0;

/// What film shows of light.
#[inline(always)]
fn film<S: Simd>(simd: S, light: F<S>) -> F<S> {
    -math::exp2(simd, light * -std::f32::consts::LOG2_E) + 1.0
}

/// Shades a queue and adds its light to its pixels.
#[simd]
pub fn flush<S: Simd>(simd: S, context: &Context, texture: usize, queue: &mut Queue, tile: &mut Tile) {
    let Context { world, sights, .. } = *context;
    let count = queue.count.min(BLOCK);
    queue.count -= count;
    // What stands behind the last is left over from others.
    let (place, id) = (queue.place[0][0], queue.id[0][0]);
    queue.place[0][count..].fill(place);
    queue.id[0][count..].fill(id);
    find(simd, context, [tile.x, tile.y], queue);
    let lanes = F::<S>::LEN;
    if let Some(texture) = world.textures.get(texture) {
        let mut painted = [[0.0; BLOCK]; 3];
        texture::shade(simd, texture, &queue.point, Some(&queue.footprint), &mut painted);
        let mut i = 0;
        while i < BLOCK / lanes {
            store3(load3(simd, &queue.albedo, i).mulv(load3(simd, &painted, i)), &mut queue.albedo, i);
            i += 1;
        }
    }
    if let (Some(snow), Some(sight)) = (&world.snow, sights.last())
        && !cfg!(without = "snow-cover")
    {
        settle(simd, context, snow, sight, queue);
    }
    let (mut low, mut high) = (V3::splat(simd, Vec3::INFINITY), V3::splat(simd, Vec3::NEG_INFINITY));
    let mut i = 0;
    while i < BLOCK / lanes {
        let p = load3(simd, &queue.point, i);
        low = V3 { x: low.x.min(p.x), y: low.y.min(p.y), z: low.z.min(p.z) };
        high = V3 { x: high.x.max(p.x), y: high.y.max(p.y), z: high.z.max(p.z) };
        i += 1;
    }
    for (light, sight) in world.lights.iter().zip(sights) {
        if light.meets(simd, low, high) {
            shine(simd, context, light, sight, &queue.point, &queue.normal, &mut queue.light);
        }
    }
    finish(simd, context, queue);
    // To the pixels, as many at a time as follow each other.
    let mut i = 0;
    while i < count {
        let first = queue.place[0][i] as usize & (Tile::AREA - 1);
        let mut run = 1;
        if i + lanes <= count {
            let pixels = U::<S>::from_slice(simd, &queue.place[0][i..i + lanes]) & (Tile::AREA as u32 - 1);
            let row = U::<S>::from_slice(simd, &STEPS[..lanes]) + first as u32;
            if pixels.simd_eq(row).all_true() {
                run = lanes;
            }
        }
        let planes = [&mut tile.red, &mut tile.green, &mut tile.blue, &mut tile.coverage];
        for (plane, light) in planes.into_iter().zip([&queue.light[0], &queue.light[1], &queue.light[2], &queue.weight])
        {
            if run > 1 {
                let sum = F::<S>::from_slice(simd, &plane[first..first + lanes])
                    + F::<S>::from_slice(simd, &light[i..i + lanes]);
                sum.store_slice(&mut plane[first..first + lanes]);
            } else {
                plane[first] += light[i];
            }
        }
        for (near, at) in tile.inv_depth[first..].iter_mut().zip(&queue.inv_depth[i..i + run]) {
            *near = near.max(*at);
        }
        i += run;
    }
    queue.place[0] = queue.place[1];
    queue.id[0] = queue.id[1];
}

/// Finds the surfaces of a queue's fragments, in the tile with that corner.
#[simd]
#[inline(never)] // Apart, it and the next two have fewer numbers to keep at a time.
fn find<S: Simd>(simd: S, context: &Context, corner: [usize; 2], queue: &mut Queue) {
    let Context { world, rasters, view, .. } = *context;
    let pieces = &rasters[0].pieces;
    let one = F::<S>::splat(simd, 1.0);
    let eye = view.camera().eye;
    let lanes = F::<S>::LEN;
    let mut i = 0;
    while i < BLOCK / lanes {
        let ids: U<S> = load(simd, &queue.id[0], i);
        let places: U<S> = load(simd, &queue.place[0], i);
        let x = steps(simd, (places & 63) << 8 | (places >> 12) & 255) + corner[0] as u32 as f32;
        let y = steps(simd, (places << 2) & (63 << 8) | (places >> 20) & 255) + corner[1] as u32 as f32;
        let mut n = V3::splat(simd, Vec3::ZERO);
        let mut albedo = n;
        let (mut near, mut gloss) = (one, one);
        let mut todo = ids.simd_eq(ids).to_bitmask();
        while todo != 0 {
            let id = queue.id[0][(i * lanes + todo.trailing_zeros() as usize) & (BLOCK - 1)];
            let here = ids.simd_eq(U::<S>::splat(simd, id));
            todo &= !here.to_bitmask();
            let (piece, number) = parts(id);
            let Triangle { anchor, at, by: [along, down], range, paint, .. } = &pieces[piece].triangles[number];
            let (dx, dy) = (x - anchor[0], y - anchor[1]);
            let normal = V3 {
                x: dx * along.x + dy * down.x + at.x,
                y: dx * along.y + dy * down.y + at.y,
                z: dx * along.z + dy * down.z + at.z,
            };
            n = V3::select(here, normal, n);
            albedo = V3::select(here, V3::splat(simd, paint.albedo), albedo);
            let z = (dx * along.w + dy * down.w + at.w).max(range[0]).min(range[1]);
            near = here.select(z, near);
            gloss = here.select(F::<S>::splat(simd, paint.gloss), gloss);
        }
        let far = one / near.max(F::<S>::splat(simd, FARTHEST));
        let p = V3::splat(simd, eye) + view.rays(simd, x, y) * Lane(far);
        let n = n * Lane(one / n.dot(n).max(F::<S>::splat(simd, 1e-30)).sqrt());
        let way = p.sub1(eye);
        let cosine = way.dot(n).abs() / way.dot(way).sqrt();
        // Between the pixel's width and its length.
        let stretch = one / cosine.max(F::<S>::splat(simd, 0.04)).sqrt();
        store(far * stretch * view.pixel(), &mut queue.footprint, i);
        store3(p, &mut queue.point, i);
        store3(n, &mut queue.normal, i);
        store3(albedo, &mut queue.albedo, i);
        store3(V3::splat(simd, world.ambient[0]) + V3::splat(simd, world.ambient[1]) * Lane(n.y), &mut queue.light, i);
        store(near, &mut queue.inv_depth, i);
        store(gloss, &mut queue.gloss, i);
        i += 1;
    }
}

/// Adds what a light gives to points with unit normals.
#[simd]
#[inline(never)]
pub fn shine<S: Simd>(
    simd: S,
    context: &Context,
    light: &Light,
    sight: &ShadowLookup,
    points: &Block3,
    normals: &Block3,
    out: &mut Block3,
) {
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (p, n) = (load3(simd, points, i), load3(simd, normals, i));
        let mut gives = light.at(simd, sight, context.rasters, p, n);
        if let (Source::Sun(_), Some(veil)) = (light.source, &context.world.veil)
            && !cfg!(without = "cloud-shadows")
        {
            gives = gives * Lane(veil.at(simd, p));
        }
        store3(load3(simd, out, i) + gives, out, i);
        i += 1;
    }
}

/// From light on surfaces to light that is seen, by what their pixels have of it.
#[simd]
#[inline(never)]
fn finish<S: Simd>(simd: S, context: &Context, queue: &mut Queue) {
    let Context { world, view, share, .. } = *context;
    let haze = &world.haze;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (p, n) = (load3(simd, &queue.point, i), load3(simd, &queue.normal, i));
        let mut color = load3(simd, &queue.albedo, i).mulv(load3(simd, &queue.light, i));
        let way = p.sub1(view.camera().eye);
        let distance = way.dot(way).sqrt();
        let way = way * Lane(one / distance);
        let gloss: F<S> = load(simd, &queue.gloss, i);
        if gloss.simd_gt(zero).any_true() {
            let cosine = way.dot(n);
            let mirrored = way - n * Lane(cosine + cosine);
            let horizon = haze.at(simd, mirrored);
            let height = one - math::exp2(simd, mirrored.y.max(zero) * -RISE);
            let sky =
                horizon + (V3::splat(simd, world.zenith) - horizon) * Lane(height) + haze.image_at(simd, mirrored);
            // Schlick's approximation.
            let rest = one - cosine.abs().min(one);
            let grazing = rest * rest;
            let grazing = grazing * grazing * rest;
            color = color + (sky - color) * Lane(gloss * (grazing * 0.95 + 0.05));
        }
        if world.film || !BENCH {
            color = V3 { x: film(simd, color.x), y: film(simd, color.y), z: film(simd, color.z) };
        }
        let clear = math::exp2(simd, distance * (-haze.density * std::f32::consts::LOG2_E));
        let before = haze.at(simd, way);
        let samples = (load::<S, U<S>>(simd, &queue.place[0], i) >> 28) + 1;
        let weight = float(simd, samples) * share;
        store3((before + (color - before) * Lane(clear)) * Lane(weight), &mut queue.light, i);
        store(weight, &mut queue.weight, i);
        i += 1;
    }
}

/// Steps of 1/256 as a number.
#[inline(always)]
fn steps<S: Simd>(simd: S, steps: U<S>) -> F<S> {
    float(simd, steps) * (1.0 / SUB as f32)
}

/// Vector `i` of a block.
#[inline(always)]
fn load3<S: Simd>(simd: S, block: &Block3, i: usize) -> V3<S> {
    V3 { x: load(simd, &block[0], i), y: load(simd, &block[1], i), z: load(simd, &block[2], i) }
}

/// Writes vector `i` of a block.
#[inline(always)]
fn store3<S: Simd>(v: V3<S>, block: &mut Block3, i: usize) {
    store(v.x, &mut block[0], i);
    store(v.y, &mut block[1], i);
    store(v.z, &mut block[2], i);
}
