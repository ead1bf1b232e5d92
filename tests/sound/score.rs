//! The show's score.

use ebur128::{EbuR128, Mode};
use paprsek::scenes::show::intro::{INTRO, PARTS};
use paprsek::scenes::show::score::score;
use paprsek::sound::{BLOCK, Pair, RATE};
use std::sync::LazyLock;
use testkit::levels;

/// Samples of the show.
const LENGTH: usize = INTRO.duration as usize * RATE as usize;

/// All samples, in one piece.
static WHOLE: LazyLock<Vec<Pair>> = LazyLock::new(|| {
    let mut samples = vec![[0; 2]; LENGTH];
    score().samples(0, &mut samples);
    samples
});

/// Wherever one starts to listen, and however much one asks for at once, the samples are those of the whole.
#[test]
fn a_sample_depends_on_its_number_alone() {
    let mut score = score();
    // Further on, back, the same again; pieces that end within blocks and at their ends, and those of one sample.
    let mut first = 12_345;
    for (hop, length) in (0..40).zip([1, 63, 64, 65, 1000, 4096, 7, 30_000].into_iter().cycle()) {
        let mut samples = vec![[1; 2]; length];
        score.samples(first as u64, &mut samples);
        assert!(samples == WHOLE[first..][..length], "{length} samples from {first} on");
        first =
            if hop % 3 == 0 { (first * 7919 + 1) % (LENGTH - 30_000) } else { (first + length).min(LENGTH - 30_000) };
    }
}

#[test]
fn every_level_has_the_same_samples() {
    for (name, level) in levels() {
        let mut score = score().at_level(level);
        // Half a second about each cut, and of the flight and the fires, which have all voices.
        for start in PARTS.iter().map(|part| part.0 as usize).chain([50, 61, 120, 135]) {
            let first = (start * RATE as usize).saturating_sub(11_000);
            let mut samples = vec![[0; 2]; 22_050];
            score.samples(first as u64, &mut samples);
            assert!(samples == WHOLE[first..][..22_050], "{name}, {start} s");
        }
    }
}

/// Loudness `[EBU128]`. Services play at -14 to -16 LUFS, broadcasters at -23.
#[test]
fn it_is_as_loud_as_music() {
    let mut meter = EbuR128::new(2, RATE, Mode::I | Mode::TRUE_PEAK | Mode::LRA).unwrap();
    let samples: Vec<i16> = WHOLE.iter().flatten().copied().collect();
    meter.add_frames_i16(&samples).unwrap();
    let loudness = meter.loudness_global().unwrap();
    assert!((-18.0..-14.0).contains(&loudness), "{loudness} LUFS");
    // Quiet parts and loud ones, but no part that one has to turn up.
    let range = meter.loudness_range().unwrap();
    assert!((2.0..12.0).contains(&range), "{range} LU");
    for ear in 0..2 {
        let peak = meter.true_peak(ear).unwrap();
        assert!(peak < 0.99, "{peak} between samples");
    }
}

/// Neither ear is louder over a part than the other by more than one notices.
#[test]
fn both_ears_hear_as_much() {
    for part in PARTS.windows(2) {
        let [from, to] = [0, 1].map(|k| part[k].0 as usize * RATE as usize);
        let power = |ear: usize| -> f64 { WHOLE[from..to].iter().map(|pair| f64::from(pair[ear]).powi(2)).sum() };
        let decibels = 10.0 * (power(0) / power(1)).log10();
        assert!(decibels.abs() < 1.5, "{decibels} dB at {} s", part[0].0);
    }
}

/// Something is heard from the first second on and in every second, and nothing after the end.
#[test]
fn it_starts_and_ends_with_the_show() {
    for (second, samples) in WHOLE.chunks(RATE as usize).enumerate().take(152) {
        assert!(samples.iter().any(|pair| pair[0].abs() > 1000), "second {second} is silent");
    }
    // 50 dB below the loudest.
    assert!(WHOLE[LENGTH - RATE as usize / 20..].iter().all(|pair| pair[0].abs() < 100), "it ends before it is silent");
    let mut after = [[1; 2]; 3 * BLOCK];
    score().samples(LENGTH as u64 - LENGTH as u64 % BLOCK as u64, &mut after);
    assert_eq!(after, [[0; 2]; 3 * BLOCK]);
    score().samples(u64::MAX - 1000, &mut after);
}

/// Notes of a line begin on the beats of a second that the cuts are on, or on parts of them.
#[test]
fn each_cut_is_on_a_beat() {
    let score = score();
    for (start, _) in PARTS {
        let block = (start * f64::from(RATE) / BLOCK as f64).round() as u32;
        let on = score.notes().iter().filter(|note| note.start == block).count();
        assert!(on >= 3, "{on} notes at the cut at {start} s");
    }
}

/// What a second takes of a processor. Half of all machines' time is no measure, so the bound is five times the goal of
/// 10 ms; `cargo bench --bench sound` has the figure.
#[test]
fn it_is_cheap() {
    let mut score = score();
    let mut samples = vec![[0; 2]; 5 * RATE as usize];
    let began = cpu_time::ProcessTime::now();
    // The flight, of which no second has fewer notes.
    score.samples(60 * u64::from(RATE), &mut samples);
    let each = began.elapsed().as_secs_f64() / 5.0;
    let bound = if cfg!(debug_assertions) { 0.5 } else { 0.05 };
    assert!(each < bound, "{each} s of processor for a second");
}
