//! Shading: from the fragments of a queue to light in a tile's pixels, a block of one texture at a time.
//!
//! ```text
//! find       the surface of each fragment: position, normal, paint, size of the pixel on it
//! paint      multiply the albedo by the texture
//! settle     whiten what lies open to falling snow
//! shine      add what each light in reach of the block gives      (lighting.rs)
//! finish     reflect, mirror the sky, expose the film, add haze
//! scatter    add the light to the tile's pixels by coverage
//! ```
//!
//! Surfaces are Lambertian; gloss adds the sky, which a gradient stands for, above a hazy shore, by Schlick's Fresnel term
//! `[Schlick94]`. The texture of water is the tilt of its waves.

use super::context::{ShadeContext, ShadowLookup};
use super::exact_shadow::lifted;
use super::id::{Id, parts};
use super::illuminate::illuminate;
use super::light::Light;
use super::lighting::shine;
use super::queue::{FragmentQueue, LIFTED, NORMALS, POINTS};
use super::setup::SetupMesh;
use super::snow_cover::{GRAIN, SnowCover};
use super::triangle::{SUB, Triangle};
use super::world::World;
use crate::cuts;
use crate::frame::Tile;
#[cfg(feature = "full")]
use crate::frame::inspect::count_octaves;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, STEPS, U, V3, float};
use crate::simd::math;
use crate::texture::{self, Texture};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3A, vec3a};

/// Least `inv_depth` of a surface, 1 / metres: squares of greater distances are infinite.
const FARTHEST: f32 = 1e-18;

/// How fast the mirrored sky goes from the horizon's colour to the zenith's with the sine of the height: half of it in
/// 1 / `RISE`.
const RISE: f32 = 4.0;

/// The sine of the height up to which a shore is mirrored, as between mountains, and how fast the sky follows above.
const SHORE: [f32; 2] = [0.1, 8.0];

/// The light of the shore, for water whose own light has a green of 1.
const LAND: Vec3A = vec3a(1.0, 1.3, 0.5);

/// How much of the horizon's light is before the mirrored shore, as haze.
const HAZY: f32 = 0.2;

/// How far a wave tilts the surface to the eye, radians for a texture of 2.
const WAVE: f32 = 0.09;

/// A glossy surface whose albedo's green is 1 / `MIRRORED` is level.
const MIRRORED: f32 = 20.0;

/// Shades the first block of a queue and adds its light to the pixels of the tile. `texture` is the index of the queue's
/// texture, or [`super::id::PLAIN`].
#[simd]
pub fn flush<S: Simd>(simd: S, context: &ShadeContext, texture: usize, queue: &mut FragmentQueue, tile: &mut Tile) {
    let ShadeContext { world, lookups, .. } = *context;
    let count = queue.count.min(BLOCK);
    queue.count -= count;
    // What follows the last fragment is stale, and may name triangles that are gone: the first one is repeated instead.
    let (place, id) = (queue.place[0][0], queue.id[0][0]);
    queue.place[0][count..].fill(place);
    queue.id[0][count..].fill(id);
    find(simd, context, [tile.x, tile.y], queue);
    if let Some(texture) = world.textures.get(texture) {
        #[cfg(feature = "full")]
        count_noise(texture, count, queue, tile);
        paint(simd, texture, queue);
    }
    if let (Some(snow), Some(lookup)) = (&world.snow, lookups.last())
        && !cfg!(without = "snow-cover")
    {
        #[cfg(feature = "full")]
        count_noise(&GRAIN, count, queue, tile);
        settle(simd, context, snow, lookup, queue);
    }
    let traced = |light: &Light| light.shadow_views().is_some_and(|views| views.traced);
    if cuts::TRACED_SHADOWS && world.lights.iter().any(traced) {
        queue.places[LIFTED] = lifted(context, queue);
    }
    illuminate(simd, context, queue);
    finish(simd, context, queue);
    scatter(simd, count, queue, tile);
    queue.place[0] = queue.place[1];
    queue.id[0] = queue.id[1];
}

/// Counts the octaves of noise of a texture for the first `count` fragments of a queue, where they are counted.
#[cfg(feature = "full")]
#[inline(always)]
fn count_noise(texture: &Texture, count: usize, queue: &FragmentQueue, tile: &mut Tile) {
    if !tile.octaves.is_empty() {
        let mut pixels = queue.place[0][..count].iter().map(|place| *place as usize & (Tile::AREA - 1));
        count_octaves(tile, texture, Some(&queue.footprint), &mut pixels);
    }
}

/// Finds the surfaces of a queue's fragments, and the ambient light on them, in the tile whose top left pixel is `corner`.
#[simd]
#[inline(never)] // Apart, the stages have fewer numbers to keep in registers at a time.
fn find<S: Simd>(simd: S, context: &ShadeContext, corner: [usize; 2], queue: &mut FragmentQueue) {
    let ShadeContext { world, raster, view, pixel, .. } = *context;
    let one = F::<S>::splat(simd, 1.0);
    let eye = view.camera().eye;
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let places: U<S> = load(simd, &queue.place[0], i);
        // The pixel's column and row are bits 0 to 5 and 6 to 11, the point's place in the pixel bits 12 to 19 and 20 to
        // 27: put together, steps of 1/256 pixel.
        let x = steps(simd, (places & 63) << 8 | (places >> 12) & 255) + corner[0] as u32 as f32;
        let y = steps(simd, (places << 2) & (63 << 8) | (places >> 20) & 255) + corner[1] as u32 as f32;
        let Surface { normal: n, albedo, inv_depth, gloss, bulge } =
            surfaces(simd, &raster.meshes, &queue.id[0], i, x, y);
        let far = one / inv_depth.max(F::<S>::splat(simd, FARTHEST));
        let p = V3::splat(simd, eye) + view.rays(simd, x, y) * Lane(far);
        let n = n * Lane(one / n.dot(n).max(F::<S>::splat(simd, 1e-30)).sqrt());
        let way = p.sub1(eye);
        let cosine = way.dot(n).abs() / way.dot(way).sqrt();
        // The pixel on the surface is longer than wide by 1 / cosine: the geometric mean of both.
        let stretch = one / cosine.max(F::<S>::splat(simd, 0.04)).sqrt();
        let ambient = V3::splat(simd, world.ambient[0]) + V3::splat(simd, world.ambient[1]) * Lane(n.y);
        store(far * stretch * pixel, &mut queue.footprint, i);
        p.store(&mut queue.places[POINTS], i);
        (p + n * Lane(bulge)).store(&mut queue.places[LIFTED], i);
        n.store(&mut queue.places[NORMALS], i);
        albedo.store(&mut queue.albedo, i);
        ambient.store(&mut queue.light, i);
        store(inv_depth, &mut queue.inv_depth, i);
        store(gloss, &mut queue.gloss, i);
        i += 1;
    }
}

/// What triangles say of the fragments of a vector.
struct Surface<S: Simd> {
    /// Normal, of any length.
    normal: V3<S>,
    albedo: V3<S>,
    inv_depth: F<S>,
    gloss: F<S>,
    /// As in [`Triangle::bulge`].
    bulge: F<S>,
}

/// Evaluates the planes of the triangles of vector `i` at points of the raster: once per triangle, for all lanes that show
/// it, as neighbours mostly show the same one.
#[inline(always)]
fn surfaces<S: Simd>(simd: S, meshes: &[SetupMesh], ids: &[Id; BLOCK], i: usize, x: F<S>, y: F<S>) -> Surface<S> {
    let one = F::<S>::splat(simd, 1.0);
    let all: U<S> = load(simd, ids, i);
    let zero = V3::splat(simd, Vec3A::ZERO);
    let mut out = Surface { normal: zero, albedo: zero, inv_depth: one, gloss: one, bulge: one };
    let mut todo = all.simd_eq(all).to_bitmask();
    while todo != 0 {
        let id = ids[(i * F::<S>::LEN + todo.trailing_zeros() as usize) & (BLOCK - 1)];
        let here = all.simd_eq(U::<S>::splat(simd, id));
        todo &= !here.to_bitmask();
        let (mesh, number) = parts(id);
        let Triangle { anchor, at, by: [along, down], range, paint, bulge, .. } = &meshes[mesh].triangles[number];
        let (dx, dy) = (x - anchor[0], y - anchor[1]);
        let normal = V3 {
            x: dx * along.x + dy * down.x + at.x,
            y: dx * along.y + dy * down.y + at.y,
            z: dx * along.z + dy * down.z + at.z,
        };
        out.normal = V3::select(here, normal, out.normal);
        out.albedo = V3::select(here, V3::splat(simd, paint.albedo), out.albedo);
        let z = (dx * along.w + dy * down.w + at.w).max(range[0]).min(range[1]);
        out.inv_depth = here.select(z, out.inv_depth);
        out.gloss = here.select(F::<S>::splat(simd, paint.gloss), out.gloss);
        out.bulge = here.select(F::<S>::splat(simd, *bulge), out.bulge);
    }
    out
}

/// Multiplies the albedo of a queue's surfaces by a texture.
#[inline(always)]
fn paint<S: Simd>(simd: S, texture: &Texture, queue: &mut FragmentQueue) {
    let mut painted = queue.places[POINTS];
    texture::shade(simd, texture, &mut painted, BLOCK, Some(&queue.footprint));
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        V3::load(simd, &queue.albedo, i).mulv(V3::load(simd, &painted, i)).store(&mut queue.albedo, i);
        i += 1;
    }
}

/// Lets snow settle on a queue's surfaces.
#[simd]
#[inline(never)] // As the stages beside it.
fn settle<S: Simd>(
    simd: S,
    context: &ShadeContext,
    snow: &SnowCover,
    lookup: &ShadowLookup,
    queue: &mut FragmentQueue,
) {
    let (mut open, mut grain) = ([[0.0; BLOCK]; 3], queue.places[POINTS]);
    shine(simd, context, (&snow.fall, lookup), &queue.places, BLOCK, &mut open);
    texture::shade(simd, &GRAIN, &mut grain, BLOCK, Some(&queue.footprint));
    snow.whiten(simd, &open, &grain, queue);
}

/// From light on surfaces to light that reaches the eye, weighted by coverage.
#[simd]
#[inline(never)] // As the stages beside it.
fn finish<S: Simd>(simd: S, context: &ShadeContext, queue: &mut FragmentQueue) {
    let ShadeContext { world, view, share, .. } = *context;
    let haze = &world.haze;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (p, n) = (V3::load(simd, &queue.places[POINTS], i), V3::load(simd, &queue.places[NORMALS], i));
        let albedo = V3::load(simd, &queue.albedo, i);
        let mut color = albedo.mulv(V3::load(simd, &queue.light, i));
        let way = p.sub1(view.camera().eye);
        let distance = way.dot(way).sqrt();
        let way = way * Lane(one / distance);
        let gloss: F<S> = load(simd, &queue.gloss, i);
        if gloss.simd_gt(zero).any_true() {
            color = glossy(simd, world, color, gloss, albedo.y * MIRRORED - 1.0, way, n);
        }
        if world.film || !cuts::LIGHT_WITHOUT_FILM {
            color = V3 { x: film(simd, color.x), y: film(simd, color.y), z: film(simd, color.z) };
        }
        let clear = math::exp2(simd, distance * (-haze.density * std::f32::consts::LOG2_E));
        let before = haze.at(simd, way);
        let samples = (load::<S, U<S>>(simd, &queue.place[0], i) >> 28) + 1;
        let weight = float(simd, samples) * share;
        ((before + (color - before) * Lane(clear)) * Lane(weight)).store(&mut queue.light, i);
        store(weight, &mut queue.weight, i);
        i += 1;
    }
}

/// Light of surfaces with the mirrored sky over it, seen along the unit direction `way`.
#[inline(always)]
fn glossy<S: Simd>(simd: S, world: &World, color: V3<S>, gloss: F<S>, wave: F<S>, way: V3<S>, n: V3<S>) -> V3<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let cosine = way.dot(n) + wave * WAVE;
    let mirrored = way - n * Lane(cosine + cosine);
    let mirrored = mirrored * Lane(one / mirrored.dot(mirrored).sqrt());
    let horizon = world.haze.at(simd, mirrored);
    let height = one - math::exp2(simd, mirrored.y.max(zero) * -RISE);
    let sky = horizon + (V3::splat(simd, world.zenith) - horizon) * Lane(height);
    let shore = V3::splat(simd, LAND) * Lane(color.y) + horizon * Lane(one * HAZY);
    let open = ((mirrored.y - SHORE[0]) * SHORE[1]).max(zero).min(one);
    let sky = shore + (sky - shore) * Lane(open) + world.haze.image_at(simd, mirrored);
    // Schlick's approximation of the Fresnel term.
    let rest = one - cosine.abs().min(one);
    let grazing = rest * rest;
    let grazing = grazing * grazing * rest;
    color + (sky - color) * Lane(gloss * (grazing * 0.95 + 0.05))
}

/// What film shows of light: `1 - exp(-light)`.
#[inline(always)]
fn film<S: Simd>(simd: S, light: F<S>) -> F<S> {
    -math::exp2(simd, light * -std::f32::consts::LOG2_E) + 1.0
}

/// Adds the light and the coverage of the first `count` fragments to their pixels, a vector at a time where fragments are
/// neighbours in a row.
#[inline(always)]
fn scatter<S: Simd>(simd: S, count: usize, queue: &FragmentQueue, tile: &mut Tile) {
    let lanes = F::<S>::LEN;
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
        for (nearest, inv_depth) in tile.inv_depth[first..].iter_mut().zip(&queue.inv_depth[i..i + run]) {
            *nearest = nearest.max(*inv_depth);
        }
        i += run;
    }
}

/// Steps of 1 / [`SUB`] pixel as pixels.
#[inline(always)]
fn steps<S: Simd>(simd: S, steps: U<S>) -> F<S> {
    float(simd, steps) * (1.0 / SUB as f32)
}
