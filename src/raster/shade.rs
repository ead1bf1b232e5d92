//! From what is visible in a tile to light: fragments wait until a block of one texture is full, and each is shaded once.

use super::bins::{Id, NOTHING, PLAIN, TEXTURE, parts};
use super::fill::{CENTER, STEPS, Sample, Visible};
use super::light::Lit;
use super::triangle::{Plane, SUB};
use super::{Raster, World};
use crate::block::{BLOCK, load, store};
use crate::lanes::{Bits, F, Lane, U, V3};
use crate::math;
use crate::texture::{self, Block3};
use crate::tile::Tile;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;

/// What shading reads of the frame.
pub struct Context<'a> {
    /// Materials, haze.
    pub world: &'a World,
    /// Lights with their maps.
    pub lights: &'a [Lit],
    /// The camera's raster, and those of lights.
    pub rasters: &'a [Raster],
    /// The camera.
    pub view: &'a View,
}

/// Nearness of the farthest: beyond, squares of distances are infinite.
const FARTHEST: f32 = 1e-18;

/// Room for a block, and for the vector that fills it up.
const ROOM: usize = 2 * BLOCK;

/// Parts of pixels that show one triangle each.
#[derive(Clone)]
struct Queue {
    count: usize,
    pixel: [u32; ROOM],
    id: [Id; ROOM],
    /// Share of the pixel.
    weight: [f32; ROOM],
    /// Where it is looked at, pixels from the picture's top left.
    x: [f32; ROOM],
    y: [f32; ROOM],
}

const EMPTY: Queue =
    Queue { count: 0, pixel: [0; ROOM], id: [0; ROOM], weight: [0.0; ROOM], x: [0.0; ROOM], y: [0.0; ROOM] };

/// The first block of a queue's array.
#[inline(always)]
fn head<T>(room: &[T; ROOM]) -> &[T; BLOCK] {
    &room.as_chunks().0[0]
}

/// Fragments of a tile, by the texture in their [`Id`].
#[derive(Default)]
pub struct Fragments {
    queues: Vec<Queue>,
}

/// Where and how a tile's samples are turned into fragments.
pub struct Samples<'a> {
    /// What is visible at each.
    pub visible: &'a [Visible],
    /// Where they lie in a pixel.
    pub places: &'a [Sample],
    /// What one of them counts.
    pub share: f32,
}

impl Fragments {
    /// Adds what the samples of a tile's pixels show; returns the number of fragments.
    #[inline(always)]
    pub fn collect<S: Simd>(&mut self, simd: S, context: &Context, samples: &Samples, tile: &mut Tile) -> u64 {
        let lanes = F::<S>::LEN;
        self.queues.resize(PLAIN as usize + 1, EMPTY);
        let (first, others) = samples.visible.split_at(1);
        // Where all samples show the same, the pixel is looked at in its middle.
        let place = if others.is_empty() { samples.places[0] } else { CENTER };
        let whole = samples.share * samples.places.len() as u32 as f32;
        let steps: F<S> = S::u32s::from_slice(simd, &STEPS[..lanes]).bitcast::<S::i32s>().to_float();
        let steps = steps + place[0] as f32 * (1.0 / SUB as f32);
        let mut count = 0;
        for row in 0..tile.height {
            let y = (tile.y + row) as u32 as f32 + place[1] as f32 * (1.0 / SUB as f32);
            let mut column = 0;
            while column < tile.width {
                let at = row * Tile::SIZE + column;
                let ids = U::<S>::from_slice(simd, &first[0].id[at..at + lanes]);
                let mut same = ids.simd_eq(ids);
                for other in others {
                    same &= ids.simd_eq(U::<S>::from_slice(simd, &other.id[at..at + lanes]));
                }
                let empty = ids.simd_eq(NOTHING);
                let full = same & !empty;
                let texture = first[0].id[at] >> TEXTURE;
                let left = column;
                column += lanes;
                if column <= tile.width && (full & (ids >> TEXTURE).simd_eq(texture)).all_true() {
                    let queue = &mut self.queues[texture as usize];
                    let end = queue.count..queue.count + lanes;
                    let pixels = S::u32s::from_slice(simd, &STEPS[..lanes]) + at as u32;
                    pixels.store_slice(&mut queue.pixel[end.clone()]);
                    ids.store_slice(&mut queue.id[end.clone()]);
                    F::<S>::splat(simd, whole).store_slice(&mut queue.weight[end.clone()]);
                    (steps + (tile.x + left) as u32 as f32).store_slice(&mut queue.x[end.clone()]);
                    F::<S>::splat(simd, y).store_slice(&mut queue.y[end]);
                    queue.count += lanes;
                    count += lanes as u64;
                    if queue.count >= BLOCK {
                        flush(simd, context, texture as usize, queue, tile);
                    }
                    continue;
                }
                let full = full.to_bitmask();
                let in_use = (1 << lanes.min(tile.width - left)) - 1;
                for lane in Bits(!(same & empty).to_bitmask() & in_use) {
                    let id = first[0].id[at + lane];
                    if full >> lane & 1 != 0 {
                        self.push(simd, context, at + lane, id, whole, place, tile);
                        count += 1;
                    } else {
                        count += self.several(simd, context, samples, at + lane, tile);
                    }
                }
            }
        }
        count
    }

    /// Adds the triangles of a pixel whose samples show more than one, each where its samples are on the mean.
    #[inline(never)]
    fn several<S: Simd>(
        &mut self,
        simd: S,
        context: &Context,
        samples: &Samples,
        pixel: usize,
        tile: &mut Tile,
    ) -> u64 {
        let visible = samples.visible;
        let mut count = 0;
        for (first, plane) in visible.iter().enumerate() {
            let id = plane.id[pixel];
            if id == NOTHING || visible[..first].iter().any(|earlier| earlier.id[pixel] == id) {
                continue;
            }
            let (mut met, mut x, mut y) = (0, 0, 0);
            for (plane, place) in visible.iter().zip(samples.places).skip(first) {
                if plane.id[pixel] == id {
                    (met, x, y) = (met + 1, x + place[0], y + place[1]);
                }
            }
            self.push(simd, context, pixel, id, samples.share * met as f32, [x / met, y / met], tile);
            count += 1;
        }
        count
    }

    /// Adds a fragment at `place` in its pixel.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)] // A fragment, and what shades it.
    fn push<S: Simd>(
        &mut self,
        simd: S,
        context: &Context,
        pixel: usize,
        id: Id,
        weight: f32,
        place: Sample,
        tile: &mut Tile,
    ) {
        let queue = &mut self.queues[(id >> TEXTURE) as usize];
        let at = queue.count & (BLOCK - 1);
        let [x, y] = place.map(|step| step as f32 * (1.0 / SUB as f32));
        queue.pixel[at] = pixel as u32;
        queue.id[at] = id;
        queue.weight[at] = weight;
        queue.x[at] = (tile.x + pixel % Tile::SIZE) as u32 as f32 + x;
        queue.y[at] = (tile.y + pixel / Tile::SIZE) as u32 as f32 + y;
        queue.count = at + 1;
        if queue.count == BLOCK {
            flush(simd, context, (id >> TEXTURE) as usize, queue, tile);
        }
    }

    /// Shades all that still waits.
    pub fn finish<S: Simd>(&mut self, simd: S, context: &Context, tile: &mut Tile) {
        for (texture, queue) in self.queues.iter_mut().enumerate() {
            if queue.count > 0 {
                flush(simd, context, texture, queue, tile);
            }
        }
    }
}

/// How fast the mirrored sky goes from the horizon's colour to the zenith's: half of it in 1 / this of the sine.
const RISE: f32 = 4.0;

/// What film shows of light.
#[inline(always)]
fn film<S: Simd>(simd: S, light: F<S>) -> F<S> {
    -math::exp2(simd, light * -std::f32::consts::LOG2_E) + 1.0
}

/// A plane at offsets from its anchor, where `here`.
#[inline(always)]
fn at<S: Simd>(plane: &Plane, dx: F<S>, dy: F<S>) -> F<S> {
    dx * plane.by[0] + dy * plane.by[1] + plane.at
}

/// Shades a queue and adds its light to its pixels.
#[simd]
fn flush<S: Simd>(simd: S, context: &Context, texture: usize, queue: &mut Queue, tile: &mut Tile) {
    let Context { world, lights, rasters, view } = *context;
    let pieces = &rasters[0].pieces;
    let count = queue.count.min(BLOCK);
    // What stands behind the last is left over from others.
    let (id, x, y) = (queue.id[0], queue.x[0], queue.y[0]);
    queue.id[count..BLOCK].fill(id);
    queue.x[count..BLOCK].fill(x);
    queue.y[count..BLOCK].fill(y);
    let (mut point, mut normal, mut color) = ([[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3]);
    let (mut depth, mut nearness, mut glosses) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
    let mut glossy = false;
    let one = F::<S>::splat(simd, 1.0);
    let (mut low, mut high) = (V3::splat(simd, Vec3::INFINITY), V3::splat(simd, Vec3::NEG_INFINITY));
    let lanes = F::<S>::LEN;
    let mut i = 0;
    while i < BLOCK / lanes {
        let ids: U<S> = load(simd, head(&queue.id), i);
        let (x, y): (F<S>, F<S>) = (load(simd, head(&queue.x), i), load(simd, head(&queue.y), i));
        let mut n = V3::splat(simd, Vec3::ZERO);
        let mut albedo = n;
        let (mut near, mut gloss) = (one, one);
        let mut todo = ids.simd_eq(ids).to_bitmask();
        while todo != 0 {
            let id = queue.id[(i * lanes + todo.trailing_zeros() as usize) & (BLOCK - 1)];
            let here = ids.simd_eq(U::<S>::splat(simd, id));
            todo &= !here.to_bitmask();
            let (piece, number) = parts(id);
            let (triangle, surface) = (&pieces[piece].triangles[number], &pieces[piece].surfaces[number]);
            let (dx, dy) = (x - triangle.anchor[0], y - triangle.anchor[1]);
            let [nx, ny, nz] = &surface.normal;
            n = V3::select(here, V3 { x: at::<S>(nx, dx, dy), y: at::<S>(ny, dx, dy), z: at::<S>(nz, dx, dy) }, n);
            albedo = V3::select(here, V3::splat(simd, surface.paint.albedo), albedo);
            let z = at::<S>(&triangle.nearness, dx, dy).max(triangle.range[0]).min(triangle.range[1]);
            near = here.select(z, near);
            gloss = here.select(F::<S>::splat(simd, surface.paint.gloss), gloss);
            glossy |= surface.paint.gloss > 0.0;
        }
        let far = one / near.max(F::<S>::splat(simd, FARTHEST));
        let p = V3::splat(simd, view.camera().eye) + view.rays(simd, x, y) * Lane(far);
        low = V3 { x: low.x.min(p.x), y: low.y.min(p.y), z: low.z.min(p.z) };
        high = V3 { x: high.x.max(p.x), y: high.y.max(p.y), z: high.z.max(p.z) };
        let n = n * Lane(one / n.dot(n).max(F::<S>::splat(simd, 1e-30)).sqrt());
        for (block, v) in [(&mut point, p), (&mut normal, n), (&mut color, albedo)] {
            store(v.x, &mut block[0], i);
            store(v.y, &mut block[1], i);
            store(v.z, &mut block[2], i);
        }
        store(far, &mut depth, i);
        store(near, &mut nearness, i);
        store(gloss, &mut glosses, i);
        i += 1;
    }
    if let Some(texture) = world.textures.get(texture) {
        paint(simd, texture, &point, &normal, &depth, view, &mut color);
    }
    let (low, high) = (lowest(simd, low), -lowest(simd, -high));
    let mut near = [0u32; 32];
    let mut reaching = 0;
    for (index, light) in lights.iter().enumerate() {
        if light.reaches((low + high) * 0.5, low.distance(high) * 0.5) && reaching < near.len() {
            near[reaching] = index as u32;
            reaching += 1;
        }
    }
    let mut i = 0;
    while i < BLOCK / lanes {
        let (p, n, albedo) = (load3(simd, &point, i), load3(simd, &normal, i), load3(simd, &color, i));
        let mut light = V3::splat(simd, world.ambient[0]) + V3::splat(simd, world.ambient[1]) * Lane(n.y);
        let mut k = 0;
        while k < reaching {
            light = light + lights[near[k] as usize].at(simd, rasters, p, n);
            k += 1;
        }
        let mut color_here = albedo.mulv(light);
        let haze = &world.haze;
        let way = p.sub1(view.camera().eye);
        let distance = way.dot(way).sqrt();
        let way = way * Lane(one / distance);
        if glossy {
            let cosine = way.dot(n);
            let mirrored = way - n * Lane(cosine + cosine);
            let (horizon, sun) = haze.at(simd, mirrored);
            let height = one - math::exp2(simd, mirrored.y.max(F::<S>::splat(simd, 0.0)) * -RISE);
            let sky = horizon + (V3::splat(simd, world.zenith) - horizon) * Lane(height) + sun;
            // Schlick's approximation.
            let rest = one - cosine.abs().min(one);
            let grazing = rest * rest;
            let grazing = grazing * grazing * rest;
            let gloss = load::<S, F<S>>(simd, &glosses, i) * (grazing * 0.95 + 0.05);
            color_here = color_here + (sky - color_here) * Lane(gloss);
        }
        if world.film {
            color_here = V3 { x: film(simd, color_here.x), y: film(simd, color_here.y), z: film(simd, color_here.z) };
        }
        let clear = math::exp2(simd, distance * (-haze.density * std::f32::consts::LOG2_E));
        let before = haze.at(simd, way).0;
        let seen = before + (color_here - before) * Lane(clear);
        let seen = seen * Lane(load(simd, head(&queue.weight), i));
        store(seen.x, &mut color[0], i);
        store(seen.y, &mut color[1], i);
        store(seen.z, &mut color[2], i);
        i += 1;
    }
    add(simd, queue, count, &color, &nearness, tile);
    queue.count -= count;
    if queue.count > 0 {
        // What the vector that filled the block up left over.
        let rest = BLOCK..BLOCK + lanes;
        queue.pixel.copy_within(rest.clone(), 0);
        queue.id.copy_within(rest.clone(), 0);
        queue.weight.copy_within(rest.clone(), 0);
        queue.x.copy_within(rest.clone(), 0);
        queue.y.copy_within(rest, 0);
    }
}

/// Adds the light of the first `count` fragments to their pixels.
#[inline(always)]
fn add<S: Simd>(simd: S, queue: &Queue, count: usize, color: &Block3, nearness: &[f32; BLOCK], tile: &mut Tile) {
    let lanes = F::<S>::LEN;
    let steps = U::<S>::from_slice(simd, &STEPS[..lanes]);
    let mut i = 0;
    while i < count {
        let first = queue.pixel[i] as usize & (Tile::AREA - 1);
        let pixels = U::<S>::from_slice(simd, &queue.pixel[i..i + lanes]);
        if i + lanes <= count && pixels.simd_eq(steps + first as u32).all_true() {
            let at = first..first + lanes;
            let planes = [&mut tile.red, &mut tile.green, &mut tile.blue, &mut tile.coverage];
            for (plane, light) in planes.into_iter().zip([&color[0][..], &color[1], &color[2], &queue.weight]) {
                let sum = F::<S>::from_slice(simd, &plane[at.clone()]) + F::<S>::from_slice(simd, &light[i..i + lanes]);
                sum.store_slice(&mut plane[at.clone()]);
            }
            let plane = &mut tile.closeness[at];
            let near = F::<S>::from_slice(simd, &nearness[i..i + lanes]);
            F::<S>::from_slice(simd, plane).max(near).store_slice(plane);
        } else {
            for j in i..count.min(i + lanes) {
                let pixel = queue.pixel[j] as usize & (Tile::AREA - 1);
                tile.red[pixel] += color[0][j];
                tile.green[pixel] += color[1][j];
                tile.blue[pixel] += color[2][j];
                tile.coverage[pixel] += queue.weight[j];
                tile.closeness[pixel] = tile.closeness[pixel].max(nearness[j]);
            }
        }
        i += lanes;
    }
}

/// Multiplies albedos by a texture, averaged over the length of each pixel on the surface.
#[inline(always)]
fn paint<S: Simd>(
    simd: S,
    texture: &texture::Texture,
    point: &Block3,
    normal: &Block3,
    depth: &[f32; BLOCK],
    view: &View,
    color: &mut Block3,
) {
    let mut footprint = [0.0; BLOCK];
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (p, n) = (load3(simd, point, i), load3(simd, normal, i));
        let way = p.sub1(view.camera().eye);
        let cosine = way.dot(n).abs() / way.dot(way).sqrt();
        // Between the pixel's width and its length.
        let stretch = F::<S>::splat(simd, 1.0) / cosine.max(F::<S>::splat(simd, 0.04)).sqrt();
        store(load::<S, F<S>>(simd, depth, i) * stretch * view.pixel(), &mut footprint, i);
        i += 1;
    }
    let mut painted = [[0.0; BLOCK]; 3];
    texture::shade(simd, texture, point, Some(&footprint), &mut painted);
    for channel in 0..3 {
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let albedo: F<S> = load(simd, &color[channel], i);
            store(albedo * load::<S, F<S>>(simd, &painted[channel], i), &mut color[channel], i);
            i += 1;
        }
    }
}

/// Vector `i` of a block.
#[inline(always)]
fn load3<S: Simd>(simd: S, block: &Block3, i: usize) -> V3<S> {
    V3 { x: load(simd, &block[0], i), y: load(simd, &block[1], i), z: load(simd, &block[2], i) }
}

/// The least of each component over the lanes.
#[inline(always)]
fn lowest<S: Simd>(_simd: S, v: V3<S>) -> Vec3 {
    let mut least = Vec3::INFINITY;
    for (axis, lanes) in [v.x, v.y, v.z].iter().enumerate() {
        for &value in lanes.as_slice() {
            least[axis] = least[axis].min(value);
        }
    }
    least
}
