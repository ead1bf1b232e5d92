//! Sound: what a second of the show takes of one core, at each SIMD level. `cargo bench --bench sound`.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use paprsek::scenes::show::score::score;
use paprsek::sound::RATE;
use std::hint::black_box;
use testkit::levels;

/// Seconds of the show: quiet, full, and with most noise.
const SECONDS: [u64; 3] = [5, 62, 135];

fn sound(c: &mut Criterion) {
    let mut group = c.benchmark_group("a second");
    group.sample_size(10);
    for (name, level) in levels() {
        for second in SECONDS {
            let first = second * u64::from(RATE);
            // One that has just heard the sample before, so that no jump is counted.
            let mut listening = score().at_level(level);
            listening.samples(first - 1, &mut [[0; 2]]);
            let mut samples = vec![[0; 2]; RATE as usize];
            group.bench_function(format!("{second} s, {name}"), |b| {
                b.iter_batched(
                    || listening.clone(),
                    |mut score| {
                        score.samples(first, &mut samples);
                        black_box(&samples);
                    },
                    BatchSize::PerIteration,
                );
            });
        }
    }
    group.finish();
}

criterion_group!(benches, sound);
criterion_main!(benches);
