//! Single notes, whose spectra and courses are known.

use paprsek::sound::{Note, Pair, RATE, Score, Voice};
use std::f64::consts::TAU;

/// Samples of a second.
const SECOND: usize = RATE as usize;
/// The gain of the notes here: what [`Score`] makes of it is not yet rounded off at the top.
const GAIN: f32 = 0.1;

/// The first seconds of a score of one note, which is held throughout.
fn play(voice: &'static Voice, pitch: f32, seconds: usize) -> Vec<Pair> {
    let mut score = Score::new(vec![Note::new(0.0, 60.0, pitch, [GAIN; 2], voice)], 60.0);
    let mut samples = vec![[0; 2]; seconds * SECOND];
    score.samples(0, &mut samples);
    samples
}

/// The amplitude of a frequency in hertz in the second second of the left ear, as a whole number of turns fits it.
fn amplitude(samples: &[Pair], frequency: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (n, pair) in samples[SECOND..2 * SECOND].iter().enumerate() {
        let (sin, cos) = (TAU * frequency * n as f64 / SECOND as f64).sin_cos();
        re += f64::from(pair[0]) * cos;
        im += f64::from(pair[0]) * sin;
    }
    2.0 * re.hypot(im) / SECOND as f64
}

/// Bessel's function of the first kind by its series.
fn bessel(order: i32, x: f64) -> f64 {
    let n = order.unsigned_abs();
    let mut term = (1..=n).fold(1.0, |term, k| term * x / 2.0 / f64::from(k));
    let mut sum = 0.0;
    for k in 1..60 {
        sum += term;
        term *= -(x * x) / 4.0 / f64::from(k) / f64::from(k + n);
    }
    if order < 0 && n % 2 == 1 { -sum } else { sum }
}

/// Where a modulator of frequency m moves the phase of a carrier c by I radians, the frequency c + k m has the amplitude
/// J_k(I); what lies below 0 comes back, with its sign turned `[Chowning73]`.
#[test]
fn spectra_are_those_of_frequency_modulation() {
    static VOICE: Voice = Voice { fade: 0.0, ratio: 2.0, index: 0.35, room: 0.0, ..Voice::SINE };
    const PITCH: i32 = 440;
    /// 66 dB down: what rounding off at the top adds to the third overtones of each.
    const OFF: f64 = 5e-4;
    let samples = play(&VOICE, PITCH as f32, 2);
    let index = f64::from(VOICE.index) * TAU;
    let expected = |frequency: i32| -> f64 {
        let sideband = |k: i32| (PITCH + 2 * PITCH * k, bessel(k, index));
        let sum = |sign: i32| -> f64 {
            (-20..=20).map(sideband).filter(|side| side.0 * sign == frequency).map(|side| side.1).sum()
        };
        // A sine of a frequency below 0 is that of the one above, turned.
        (sum(1) - sum(-1)).abs()
    };
    // The loudness of the whole, from the sine of the same note.
    static SINE: Voice = Voice { fade: 0.0, room: 0.0, ..Voice::SINE };
    let whole = amplitude(&play(&SINE, PITCH as f32, 2), f64::from(PITCH));
    for k in 1..20 {
        let share = amplitude(&samples, f64::from(PITCH * k)) / whole;
        assert!((share - expected(PITCH * k)).abs() < OFF, "{k}: {share}, {}", expected(PITCH * k));
    }
}

/// A plain sine has no overtones: what there is of them is that of the rounding at the top, the third, and dither.
#[test]
fn a_sine_is_one() {
    static SINE: Voice = Voice { fade: 0.0, room: 0.0, ..Voice::SINE };
    let samples = play(&SINE, 1000.0, 2);
    let whole = amplitude(&samples, 1000.0);
    for k in [2, 4, 5, 6, 7, 8, 9, 10] {
        let share = amplitude(&samples, 1000.0 * f64::from(k)) / whole;
        // 80 dB down.
        assert!(share < 1e-4, "{k}: {share}");
    }
}

#[test]
fn notes_fade_by_halves() {
    static VOICE: Voice = Voice { fade: 3.0, room: 0.0, ..Voice::SINE };
    let samples = play(&VOICE, 441.0, 2);
    // Whole periods of the sine, a third of a second apart.
    let power =
        |from: usize| -> f64 { samples[from..][..4410].iter().map(|pair| f64::from(pair[0]).powi(2)).sum::<f64>() };
    let ratio = (power(14_700 + 4410) / power(4410)).sqrt();
    assert!((ratio - 0.5).abs() < 0.005, "{ratio}");
}

/// No step from one sample to the next is larger than a sine of the note's frequency has, neither where a note begins nor
/// where it ends: there are no clicks.
#[test]
fn notes_come_and_go_without_clicks() {
    static VOICE: Voice = Voice { attack: 0.01, fade: 0.0, release: 0.05, room: 0.0, ..Voice::SINE };
    let note = Note::new(0.5, 0.5, 300.0, [GAIN; 2], &VOICE);
    let mut score = Score::new(vec![note], 2.0);
    let mut samples = vec![[0; 2]; 2 * SECOND];
    score.samples(0, &mut samples);
    let loudest = samples.iter().map(|pair| pair[0].abs()).max().unwrap();
    assert!(loudest > 2000, "{loudest}");
    let steepest = f64::from(loudest) * TAU * 300.0 / f64::from(RATE);
    for pair in samples.windows(2) {
        let step = (i32::from(pair[1][0]) - i32::from(pair[0][0])).abs();
        // Dither adds up to two codes, and an attack of a hundredth of a second its own slope.
        assert!(f64::from(step) <= 1.06 * steepest + 3.0, "{step}, {steepest}");
    }
    // Not a code outside.
    let (start, end) = (22_050 - 64, (1.05 * f64::from(RATE)) as usize + 128);
    assert!(samples[..start].iter().chain(&samples[end..]).all(|pair| *pair == [0, 0]));
}

/// The room is heard for as long as it says, and not at all where nothing is sent to it.
#[test]
fn a_room_answers_and_falls_silent() {
    static DRY: Voice = Voice { fade: 60.0, room: 0.0, ..Voice::SINE };
    static WET: Voice = Voice { room: 1.0, ..DRY };
    for (voice, answers) in [(&DRY, false), (&WET, true)] {
        let mut score = Score::new(vec![Note::new(0.0, 0.1, 500.0, [GAIN; 2], voice)], 4.0);
        let mut samples = vec![[0; 2]; 4 * SECOND];
        score.samples(0, &mut samples);
        let loud = |from: usize, to: usize| samples[from..to].iter().any(|pair| pair[0] != 0 || pair[1] != 0);
        assert_eq!(loud(SECOND / 2, SECOND), answers);
        assert!(!loud(SECOND * 5 / 2, 4 * SECOND));
    }
}

/// Pitches that a note may have all the same: below 0, infinite, none. No panic, and codes that are loud at most.
#[test]
fn wild_notes_play() {
    static VOICE: Voice = Voice { noise: 0.5, gusts: f32::NAN, fall: 1e30, index: f32::INFINITY, ..Voice::SINE };
    for pitch in [0.0, -440.0, 1e9, f32::INFINITY, f32::NAN] {
        let notes = vec![Note::new(0.1, f32::NAN, pitch, [f32::NAN, 1e30], &VOICE)];
        let mut samples = [[0; 2]; 9000];
        Score::new(notes, 1.0).samples(0, &mut samples);
    }
}
