//! From the triangles that the samples of a tile show to fragments in queues, one queue per texture.
//!
//! A fragment is shaded once, however many samples of its pixel it has, at the mean of their
//! places. Full queues are shaded at once.

use super::context::ShadeContext;
use super::id::{Id, NOTHING, TEXTURE};
use super::queue::{FragmentQueue, fragment};
use super::shade::flush;
use super::visible::{SubPixel, Visible};
use crate::frame::Tile;
use crate::simd::block::BLOCK;
use crate::simd::lanes::{Bits, F, M, STEPS, U};
use fearless_simd::prelude::*;

/// Adds the fragments of a tile to the queues, and shades those that become full. `planes` holds what is visible at each
/// sample of the pixels, and where that sample lies. Returns the number of fragments.
///
/// ```text
/// for each vector of pixels of a row
///     all samples of all pixels show triangles of one texture, the same in each pixel?
///         append the vector to that texture's queue
///     else for each pixel that shows anything
///         all samples show the same triangle?      push one fragment
///         else                                     push one for each of its triangles
/// ```
#[inline(always)]
pub fn collect<S: Simd>(
    simd: S,
    context: &ShadeContext,
    planes: &[(Visible, SubPixel)],
    queues: &mut [FragmentQueue],
    tile: &mut Tile,
) -> u64 {
    let lanes = F::<S>::LEN;
    let mut sum = [0, 0];
    for (_, place) in planes {
        sum = [sum[0] + place[0], sum[1] + place[1]];
    }
    // A fragment of all samples, and a vector of these.
    let whole = fragment(planes.len() as i32, sum);
    let wholes = S::u32s::from_slice(simd, &STEPS[..lanes]) + whole;
    let mut fragments = 0;
    for row in 0..tile.height {
        let mut column = 0;
        while column < tile.width {
            let at = row * Tile::SIZE + column;
            let (ids, same) = samples(simd, planes, at);
            let empty = ids.simd_eq(NOTHING);
            let texture = planes[0].0.id[at] >> TEXTURE;
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

/// What the first samples of a vector of pixels show, and where the other samples of the pixel show the same.
#[inline(always)]
fn samples<S: Simd>(simd: S, planes: &[(Visible, SubPixel)], at: usize) -> (U<S>, M<S>) {
    let lanes = F::<S>::LEN;
    let ids = U::<S>::from_slice(simd, &planes[0].0.id[at..at + lanes]);
    let mut same = ids.simd_eq(ids);
    for (other, _) in &planes[1..] {
        same &= ids.simd_eq(U::<S>::from_slice(simd, &other.id[at..at + lanes]));
    }
    (ids, same)
}

/// Adds a fragment for each of several triangles in a pixel, at the mean of the samples that show it. Returns their number.
#[inline(never)] // For pixels on edges only.
fn several<S: Simd>(
    simd: S,
    context: &ShadeContext,
    planes: &[(Visible, SubPixel)],
    pixel: usize,
    queues: &mut [FragmentQueue],
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

/// Adds a fragment to the queue of its texture, and shades the queue if that makes it full.
#[inline(always)]
fn push<S: Simd>(simd: S, context: &ShadeContext, place: u32, id: Id, queues: &mut [FragmentQueue], tile: &mut Tile) {
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
