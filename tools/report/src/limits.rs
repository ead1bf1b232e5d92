//! What this machine's memory and arithmetic allow.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use paprsek::frame::Renderer;
use paprsek::simd::lanes::F;
use std::hint::black_box;
use std::time::Instant;

/// The number of floats of a stored particle: place and speed, each padded to four.
pub const NUMBERS: usize = 8;
/// The number of floats in a piece (256 kB), and the number of pieces: 512 MB, far more than any cache.
const PIECE: usize = 1 << 16;
const PIECES: usize = 2048;
/// The number of independent chains of sums and of products: enough to hide the latency of each.
const CHAINS: usize = 6;
/// The number of steps of each chain in a job, and the number of jobs.
const STEPS: usize = 1 << 18;
const JOBS: usize = 64;
/// Bytes that are read of a cache in one round.
const READ: usize = 1 << 29;
/// Turns of a word in one measurement of the clock.
const TURNS: usize = 1 << 26;

/// The sum of a piece, which reads it once.
#[inline(always)]
fn sum<S: Simd>(simd: S, piece: &[f32]) -> f32 {
    let mut sums = [F::<S>::splat(simd, 0.0); 4];
    for part in piece.chunks_exact(4 * F::<S>::LEN) {
        for (sum, lanes) in sums.iter_mut().zip(part.chunks_exact(F::<S>::LEN)) {
            *sum += F::<S>::from_slice(simd, lanes);
        }
    }
    (sums[0] + sums[1] + (sums[2] + sums[3]))[0]
}

/// Moves the particles of a piece. Blocks of 16 floats of places and of 16 floats of speeds alternate.
#[inline(always)]
fn step<S: Simd>(simd: S, piece: &mut [f32], time: f32) {
    for block in piece.chunks_exact_mut(32) {
        let (places, speeds) = block.split_at_mut(16);
        for (place, speed) in places.chunks_exact_mut(F::<S>::LEN).zip(speeds.chunks_exact(F::<S>::LEN)) {
            (F::<S>::from_slice(simd, place) + F::<S>::from_slice(simd, speed) * time).store_slice(place);
        }
    }
}

/// Chains of sums and products, each of which depends on its own last result alone.
#[inline(always)]
fn chains<S: Simd>(simd: S, factor: f32) -> f32 {
    let (factor, mut sums) = (F::<S>::splat(simd, factor), [F::<S>::splat(simd, 1.0); CHAINS]);
    let mut products = sums;
    for _ in 0..STEPS {
        for sum in &mut sums {
            *sum += factor;
        }
        for product in &mut products {
            *product *= factor;
        }
    }
    let mut all = sums[0];
    for k in 0..CHAINS {
        all = all + sums[k] + products[k];
    }
    all[0]
}

/// Seconds of the quickest round: a limit is not slowed down by other load.
fn best(rounds: usize, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let began = Instant::now();
        work();
        began.elapsed().as_secs_f64()
    };
    (0..rounds).map(time).fold(f64::MAX, f64::min)
}

/// Particles per second that a renderer's threads can read from memory; and that they can read, move and write back.
pub fn memory(renderer: &Renderer, rounds: usize) -> [f64; 2] {
    let level = renderer.level();
    let mut numbers = vec![1.0f32; PIECE * PIECES];
    let particles = (numbers.len() / NUMBERS) as f64;
    let read = best(rounds, || {
        renderer.workers().each(numbers.chunks_exact(PIECE), |piece| {
            black_box(dispatch!(level, simd => sum(simd, piece)));
        });
    });
    let both = best(rounds, || {
        renderer.workers().each(numbers.chunks_exact_mut(PIECE), |piece| {
            dispatch!(level, simd => step(simd, piece, black_box(1e-3)));
        });
    });
    [particles / read, particles / both]
}

/// Vectors per second that a renderer's threads add or multiply at a level.
pub fn arithmetic(renderer: &Renderer, level: Level, rounds: usize) -> f64 {
    let seconds = best(rounds, || {
        renderer.workers().each(0..JOBS, |_| {
            black_box(dispatch!(level, simd => chains(simd, black_box(0.999_999_9))));
        });
    });
    (JOBS * STEPS * 2 * CHAINS) as f64 / seconds
}

/// Bytes per second that one thread reads of a piece of memory of so many bytes, again and again.
pub fn bandwidth(level: Level, bytes: usize, rounds: usize) -> f64 {
    let numbers = vec![1.0f32; bytes / size_of::<f32>()];
    let times = READ / bytes;
    let seconds = best(rounds, || {
        for _ in 0..times {
            black_box(dispatch!(level, simd => sum(simd, black_box(&numbers))));
        }
    });
    (bytes * times) as f64 / seconds
}

/// Cycles per second: a turn of a word and what is added to it take one each, and each waits for the one before.
pub fn clock(rounds: usize) -> f64 {
    let step = black_box(0x9e37_79b9_u64);
    let seconds = best(rounds, || {
        black_box((0..TURNS).fold(black_box(1_u64), |word, _| word.rotate_left(5).wrapping_add(step)));
    });
    (2 * TURNS) as f64 / seconds
}
