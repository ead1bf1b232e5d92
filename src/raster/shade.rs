//! From what is visible in a tile to light: fragments wait until a block of one texture is full, and each is shaded once.

use super::World;
use super::bins::{Id, LOCAL, NOTHING};
use super::fill::{Sample, Visible};
use super::light::Lit;
use super::triangle::{Piece, Plane, SUB};
use crate::block::{BLOCK, load, store};
use crate::lanes::{F, Lane, U, V3};
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
    /// Triangles and their surfaces.
    pub pieces: &'a [Piece],
    /// The camera.
    pub view: &'a View,
}

/// Parts of pixels that show one triangle each.
#[derive(Clone)]
struct Queue {
    count: usize,
    pixel: [u32; BLOCK],
    id: [Id; BLOCK],
    /// Share of the pixel.
    weight: [f32; BLOCK],
    /// Where it is looked at, pixels from the picture's top left.
    x: [f32; BLOCK],
    y: [f32; BLOCK],
}

const EMPTY: Queue =
    Queue { count: 0, pixel: [0; BLOCK], id: [0; BLOCK], weight: [0.0; BLOCK], x: [0.0; BLOCK], y: [0.0; BLOCK] };

/// Fragments of a tile, by texture; those without one come last.
#[derive(Default)]
pub struct Fragments {
    queues: Vec<Queue>,
}

impl Fragments {
    /// Ready for a world of that many textures.
    pub fn begin(&mut self, textures: usize) {
        self.queues.resize(textures + 1, EMPTY);
    }

    /// Adds what the samples of a tile's pixels show, each `share` of a pixel; returns the number of fragments.
    #[inline(always)]
    pub fn collect<S: Simd>(
        &mut self,
        simd: S,
        context: &Context,
        visible: &[Visible],
        samples: &[Sample],
        share: f32,
        tile: &mut Tile,
    ) -> u64 {
        let lanes = F::<S>::LEN;
        let nothing = U::<S>::splat(simd, NOTHING);
        let mut count = 0;
        for row in 0..tile.height {
            let mut column = 0;
            while column < tile.width {
                let at = row * Tile::SIZE + column;
                let ids = U::<S>::from_slice(simd, &visible[0].id[at..at + lanes]);
                let mut same = ids.simd_eq(ids);
                for other in &visible[1..] {
                    same &= ids.simd_eq(U::<S>::from_slice(simd, &other.id[at..at + lanes]));
                }
                let pixels = lanes.min(tile.width - column);
                let (same, empty) = (same.to_bitmask(), ids.simd_eq(nothing).to_bitmask());
                for lane in 0..pixels {
                    let pixel = at + lane;
                    if same >> lane & 1 == 0 {
                        count += self.several(simd, context, visible, samples, share, pixel, tile);
                    } else if empty >> lane & 1 == 0 {
                        let sample = if samples.len() == 1 { samples[0] } else { super::fill::CENTER };
                        let weight = share * samples.len() as u32 as f32;
                        let place = sample.map(|step| step as f32 * (1.0 / SUB as f32));
                        self.push(simd, context, pixel, visible[0].id[pixel], weight, place, tile);
                        count += 1;
                    }
                }
                column += lanes;
            }
        }
        count
    }

    /// Adds the triangles of a pixel whose samples show more than one, each where its samples are on the mean.
    #[inline(never)]
    #[allow(clippy::too_many_arguments)]
    fn several<S: Simd>(
        &mut self,
        simd: S,
        context: &Context,
        visible: &[Visible],
        samples: &[Sample],
        share: f32,
        pixel: usize,
        tile: &mut Tile,
    ) -> u64 {
        let mut count = 0;
        for (first, plane) in visible.iter().enumerate() {
            let id = plane.id[pixel];
            if id == NOTHING || visible[..first].iter().any(|earlier| earlier.id[pixel] == id) {
                continue;
            }
            let (mut met, mut x, mut y) = (0, 0, 0);
            for (plane, sample) in visible.iter().zip(samples).skip(first) {
                if plane.id[pixel] == id {
                    (met, x, y) = (met + 1, x + sample[0], y + sample[1]);
                }
            }
            let scale = 1.0 / (met * SUB) as f32;
            self.push(simd, context, pixel, id, share * met as f32, [x as f32 * scale, y as f32 * scale], tile);
            count += 1;
        }
        count
    }

    /// Adds a fragment at `place` in its pixel.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn push<S: Simd>(
        &mut self,
        simd: S,
        context: &Context,
        pixel: usize,
        id: Id,
        weight: f32,
        place: [f32; 2],
        tile: &mut Tile,
    ) {
        let texture = context.pieces[(id >> LOCAL) as usize].surfaces[local(id)].texture;
        let index = texture.map_or(self.queues.len() - 1, usize::from);
        let queue = &mut self.queues[index];
        let at = queue.count & (BLOCK - 1);
        queue.pixel[at] = pixel as u32;
        queue.id[at] = id;
        queue.weight[at] = weight;
        queue.x[at] = (tile.x + pixel % Tile::SIZE) as u32 as f32 + place[0];
        queue.y[at] = (tile.y + pixel / Tile::SIZE) as u32 as f32 + place[1];
        queue.count = at + 1;
        if queue.count == BLOCK {
            flush(simd, context, index, queue, tile);
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

/// The number of a triangle in its piece.
#[inline(always)]
fn local(id: Id) -> usize {
    (id & ((1 << LOCAL) - 1)) as usize
}

/// A plane at offsets from its anchor, where `here`.
#[inline(always)]
fn at<S: Simd>(plane: &Plane, dx: F<S>, dy: F<S>) -> F<S> {
    dx * plane.by[0] + dy * plane.by[1] + plane.at
}

/// Shades a queue and adds its light to its pixels.
#[simd]
fn flush<S: Simd>(simd: S, context: &Context, texture: usize, queue: &mut Queue, tile: &mut Tile) {
    let Context { world, lights, pieces, view } = *context;
    let count = queue.count;
    queue.count = 0;
    // What stands behind the last is left over from others.
    let (id, x, y) = (queue.id[0], queue.x[0], queue.y[0]);
    queue.id[count..].fill(id);
    queue.x[count..].fill(x);
    queue.y[count..].fill(y);
    let (mut point, mut normal, mut color) = ([[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3]);
    let (mut depth, mut nearness) = ([0.0; BLOCK], [0.0; BLOCK]);
    let one = F::<S>::splat(simd, 1.0);
    let (mut low, mut high) = (V3::splat(simd, Vec3::INFINITY), V3::splat(simd, Vec3::NEG_INFINITY));
    let lanes = F::<S>::LEN;
    let mut i = 0;
    while i < BLOCK / lanes {
        let ids: U<S> = load(simd, &queue.id, i);
        let (x, y): (F<S>, F<S>) = (load(simd, &queue.x, i), load(simd, &queue.y, i));
        let mut n = V3::splat(simd, Vec3::ZERO);
        let mut albedo = n;
        let mut near = one;
        let mut todo = ids.simd_eq(ids).to_bitmask();
        while todo != 0 {
            let id = queue.id[(i * lanes + todo.trailing_zeros() as usize) & (BLOCK - 1)];
            let here = ids.simd_eq(U::<S>::splat(simd, id));
            todo &= !here.to_bitmask();
            let piece = &pieces[(id >> LOCAL) as usize];
            let (triangle, surface) = (&piece.triangles[local(id)], &piece.surfaces[local(id)]);
            let (dx, dy) = (x - triangle.anchor[0], y - triangle.anchor[1]);
            let [nx, ny, nz] = &surface.normal;
            n = V3::select(here, V3 { x: at::<S>(nx, dx, dy), y: at::<S>(ny, dx, dy), z: at::<S>(nz, dx, dy) }, n);
            albedo = V3::select(here, V3::splat(simd, surface.albedo), albedo);
            let z = at::<S>(&triangle.nearness, dx, dy).max(triangle.range[0]).min(triangle.range[1]);
            near = here.select(z, near);
        }
        let far = one / near;
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
        i += 1;
    }
    if let Some(texture) = world.textures.get(texture) {
        paint(simd, texture, &point, &normal, &depth, view, &mut color);
    }
    let (low, high) = (lowest(simd, low), -lowest(simd, -high));
    let mut near = [0u32; 32];
    let mut reaching = 0;
    for (index, light) in lights.iter().enumerate() {
        if light.reaches(low, high) && reaching < near.len() {
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
            light = light + lights[near[k] as usize].at(simd, p, n);
            k += 1;
        }
        let haze = &world.haze;
        let way = p.sub1(view.camera().eye);
        let distance = way.dot(way).sqrt();
        let clear = math::exp2(simd, distance * (-haze.density * std::f32::consts::LOG2_E));
        let glow = (way.dot1(haze.glow.0) / distance).max(F::<S>::splat(simd, 0.0));
        let glow = glow * glow;
        let glow = glow * glow;
        let before = V3::splat(simd, haze.color) + V3::splat(simd, haze.glow.1) * Lane(glow * glow);
        let seen = before + (albedo.mulv(light) - before) * Lane(clear);
        let seen = seen * Lane(load(simd, &queue.weight, i));
        store(seen.x, &mut color[0], i);
        store(seen.y, &mut color[1], i);
        store(seen.z, &mut color[2], i);
        i += 1;
    }
    for j in 0..count {
        let pixel = queue.pixel[j] as usize & (Tile::AREA - 1);
        tile.red[pixel] += color[0][j];
        tile.green[pixel] += color[1][j];
        tile.blue[pixel] += color[2][j];
        tile.coverage[pixel] += queue.weight[j];
        tile.closeness[pixel] = tile.closeness[pixel].max(nearness[j]);
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
    let (_, pixels) = view.screen();
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (p, n) = (load3(simd, point, i), load3(simd, normal, i));
        let way = p.sub1(view.camera().eye);
        let cosine = way.dot(n).abs() / way.dot(way).sqrt();
        // Between the pixel's width and its length.
        let stretch = F::<S>::splat(simd, 1.0) / cosine.max(F::<S>::splat(simd, 0.04)).sqrt();
        store(load::<S, F<S>>(simd, depth, i) * stretch * (1.0 / pixels), &mut footprint, i);
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
