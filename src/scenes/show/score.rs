//! The music of the show, and what one hears of its scenes.
//!
//! The cuts are on beats of a second. Dawn, June, the flight, the evening and the last light are in D, snow and fires in E
//! minor. One theme goes through them: it is rung at dawn, sung by the flight, rung again in the snow in minor, and ends
//! the show.

use crate::sound::{Note, Score, Voice};

/// The length of the score, seconds: that of the show.
const LENGTH: f64 = 154.0;
/// The D above middle C, hertz: the pitch that numbers and letters count from.
const D: f32 = 293.664_77;

/// A row of music: where it starts, the length of a step and how often it is played, its voice, octaves above [`D`],
/// loudness, place from -1 at the left to 1 at the right, and its steps.
///
/// A step is a letter, for as many semitones above [`D`] as it comes after `a`; or a digit, for a tone of the chord of
/// that time, from 4 on an octave higher; or `-`, which holds the note before; or anything else, for silence.
type Row = (f32, f32, usize, &'static Voice, i32, f32, f32, &'static str);

static PAD: Voice = Voice {
    attack: 1.2,
    fade: 0.15,
    release: 1.6,
    index: 0.16,
    dulling: 0.3,
    detune: 0.0025,
    room: 0.5,
    ..Voice::SINE
};
static BELL: Voice =
    Voice { fade: 1.7, release: 1.5, ratio: 3.0, index: 0.2, dulling: 4.0, detune: 0.0006, room: 0.6, ..Voice::SINE };
static BOX: Voice = Voice { fade: 3.0, release: 1.0, ratio: 5.0, index: 0.12, dulling: 9.0, room: 0.7, ..Voice::SINE };
static CHAPEL: Voice = Voice {
    attack: 0.01,
    fade: 0.9,
    release: 3.0,
    ratio: 1.4,
    index: 0.45,
    dulling: 0.8,
    detune: 0.001,
    room: 0.9,
    ..Voice::SINE
};
static PLUCK: Voice =
    Voice { fade: 5.0, release: 0.3, ratio: 2.0, index: 0.22, dulling: 8.0, room: 0.35, ..Voice::SINE };
static LEAD: Voice = Voice {
    attack: 0.05,
    fade: 0.5,
    release: 0.25,
    index: 0.22,
    dulling: 0.6,
    detune: 0.0035,
    room: 0.55,
    ..Voice::SINE
};
static FLUTE: Voice = Voice {
    attack: 0.09,
    fade: 0.3,
    release: 0.3,
    ratio: 2.0,
    index: 0.035,
    detune: 0.0015,
    noise: 0.035,
    colour: 9_000.0,
    room: 0.6,
    ..Voice::SINE
};
static HORN: Voice =
    Voice { attack: 0.12, fade: 0.4, release: 0.5, index: 0.3, dulling: 1.2, detune: 0.002, room: 0.6, ..Voice::SINE };
static BASS: Voice =
    Voice { attack: 0.006, fade: 2.5, release: 0.08, index: 0.3, dulling: 5.0, room: 0.06, ..Voice::SINE };
static KICK: Voice =
    Voice { attack: 0.002, fade: 9.0, release: 0.1, fall: 2.6, falling: 45.0, room: 0.03, ..Voice::SINE };
static DRUM: Voice = Voice {
    fade: 6.0,
    release: 0.2,
    index: 0.1,
    dulling: 12.0,
    fall: 1.5,
    falling: 22.0,
    noise: 0.04,
    colour: 3_000.0,
    room: 0.4,
    ..Voice::SINE
};
static HAT: Voice = Voice { attack: 0.0015, fade: 38.0, release: 0.02, noise: 1.0, room: 0.1, ..Voice::SINE };
static SNARE: Voice = Voice { fade: 16.0, colour: 12_000.0, room: 0.4, ..HAT };
static BIRD: Voice =
    Voice { attack: 0.015, fade: 9.0, release: 0.05, fall: -38.0, falling: 11.0, room: 0.5, ..Voice::SINE };
static WIND: Voice = Voice {
    attack: 3.0,
    fade: 0.0,
    release: 3.0,
    detune: 0.1,
    noise: 1.0,
    colour: 400.0,
    gusts: 0.6,
    gustiness: 0.9,
    room: 0.2,
    ..Voice::SINE
};
static SEA: Voice = Voice { colour: 2_400.0, gusts: 0.5, gustiness: 1.4, ..WIND };
static ENGINE: Voice = Voice {
    attack: 4.0,
    fade: 0.0,
    release: 3.0,
    ratio: 0.5,
    index: 0.35,
    detune: 0.004,
    noise: 0.25,
    colour: 500.0,
    room: 0.1,
    ..Voice::SINE
};
static CRACKLE: Voice = Voice {
    attack: 2.0,
    fade: 0.0,
    release: 2.0,
    detune: 0.1,
    noise: 1.0,
    colour: 16_000.0,
    gusts: 90.0,
    gustiness: 9.0,
    room: 0.15,
    ..Voice::SINE
};
static FLAMES: Voice = Voice { colour: 260.0, gusts: 7.0, gustiness: 0.8, ..WIND };

/// Chords: from when on, how loud they are held, the bass and three tones, in semitones above a D.
type Chord = (f32, f32, [i32; 4]);

const IN_D: [i32; 4] = [0, 4, 7, 14];
const IN_G: [i32; 4] = [5, 7, 9, 12];
const IN_A: [i32; 4] = [7, 7, 11, 14];
const IN_B_MINOR: [i32; 4] = [9, 4, 7, 12];
const IN_F_SHARP_MINOR: [i32; 4] = [4, 4, 7, 11];
const IN_E_MINOR: [i32; 4] = [2, 5, 9, 14];
const IN_C: [i32; 4] = [10, 5, 10, 14];
const IN_A_MINOR: [i32; 4] = [7, 7, 10, 14];
const IN_B: [i32; 4] = [9, 4, 9, 13];
const IN_F: [i32; 4] = [3, 7, 10, 15];
const IN_D_MINOR: [i32; 4] = [0, 3, 7, 12];

#[rustfmt::skip]
const CHORDS: &[Chord] = &[
    // Dawn, in bars of three beats.
    (0.0, 0.05, IN_D), (3.0, 0.05, IN_G), (6.0, 0.05, IN_B_MINOR), (9.0, 0.06, IN_G), (12.0, 0.06, IN_E_MINOR),
    (15.0, 0.07, IN_G), (18.0, 0.07, IN_A),
    // June, and from here on bars of two.
    (21.0, 0.05, IN_D), (23.0, 0.05, IN_A), (25.0, 0.05, IN_B_MINOR), (27.0, 0.05, IN_F_SHARP_MINOR),
    (29.0, 0.05, IN_G), (31.0, 0.05, IN_E_MINOR), (33.0, 0.05, IN_A),
    // The flight.
    (35.0, 0.05, IN_B_MINOR), (37.0, 0.05, IN_G), (39.0, 0.05, IN_D), (41.0, 0.05, IN_A),
    (43.0, 0.06, IN_B_MINOR), (45.0, 0.06, IN_G), (47.0, 0.06, IN_D), (49.0, 0.06, IN_A),
    (51.0, 0.06, IN_E_MINOR), (53.0, 0.06, IN_G), (55.0, 0.06, IN_B_MINOR), (57.0, 0.06, IN_A),
    (59.0, 0.07, IN_B_MINOR), (61.0, 0.07, IN_G), (63.0, 0.07, IN_D), (65.0, 0.07, IN_A), (67.0, 0.05, IN_A),
    // The evening.
    (69.0, 0.06, IN_D), (71.0, 0.06, IN_F_SHARP_MINOR), (73.0, 0.06, IN_G), (75.0, 0.06, IN_E_MINOR),
    (77.0, 0.06, IN_G), (79.0, 0.06, IN_A), (81.0, 0.05, IN_B_MINOR),
    // Snow, in bars of three again.
    (83.0, 0.03, IN_E_MINOR), (86.0, 0.035, IN_C), (89.0, 0.04, IN_G), (92.0, 0.04, IN_B), (95.0, 0.045, IN_E_MINOR),
    (98.0, 0.045, IN_C), (101.0, 0.05, IN_A_MINOR), (104.0, 0.05, IN_B), (107.0, 0.045, IN_E_MINOR),
    (110.0, 0.04, IN_E_MINOR),
    // Fires.
    (113.0, 0.04, IN_E_MINOR), (117.0, 0.05, IN_F), (119.0, 0.05, IN_E_MINOR), (123.0, 0.05, IN_D_MINOR),
    (125.0, 0.05, IN_F), (127.0, 0.05, IN_E_MINOR), (129.0, 0.06, IN_C), (131.0, 0.06, IN_D),
    (133.0, 0.06, IN_E_MINOR), (137.0, 0.06, IN_C), (139.0, 0.06, IN_G), (141.0, 0.06, IN_A),
    // The last light.
    (143.0, 0.05, IN_D), (145.0, 0.05, IN_B_MINOR), (147.0, 0.06, IN_G), (149.0, 0.07, IN_D), (151.0, 0.0, IN_D),
];

#[rustfmt::skip]
const ROWS: &[Row] = &[
    // Dawn.
    (0.0, 0.5, 1, &BELL, 0, 0.16, 0.2, "...hmoq--om-l--h--j----....hmor--qo-o--l-."),
    (0.0, 1.5, 14, &BOX, 1, 0.025, -0.4, "13"),
    (0.0, 3.0, 7, &BASS, -2, 0.12, 0.0, "0"),
    (12.0, 0.25, 6, &PLUCK, 0, 0.03, -0.5, "013532"),
    // June.
    (21.0, 0.25, 7, &PLUCK, 0, 0.07, -0.35, "13253532"),
    (21.125, 0.25, 7, &PLUCK, 1, 0.03, 0.5, "31521325"),
    (21.0, 0.5, 1, &FLUTE, 1, 0.09, 0.25, "q-oml-h-j-moq---r-qoo-mjl--."),
    (21.0, 1.0, 7, &BASS, -2, 0.14, 0.0, "00"),
    (22.1, 0.13, 3, &BIRD, 3, 0.02, 0.8, "c.c..e....................."),
    (24.4, 0.11, 3, &BIRD, 3, 0.015, -0.8, "hh.h.......fff........"),
    // The flight.
    (35.0, 0.125, 16, &PLUCK, 0, 0.06, -0.3, "1231532312315653"),
    (37.0625, 0.125, 15, &PLUCK, 1, 0.025, 0.5, "1231532312315653"),
    (35.0, 2.0, 2, &BASS, -2, 0.16, 0.0, "0"),
    (39.0, 0.25, 14, &BASS, -2, 0.18, 0.0, "0.00.040"),
    (43.0, 0.5, 48, &KICK, -3, 0.32, 0.0, "h"),
    (43.25, 0.5, 48, &HAT, 5, 0.06, 0.3, "a"),
    (51.0, 0.125, 16, &HAT, 5, 0.03, -0.4, "a.aaa.aaa.aaa.aa"),
    (51.5, 1.0, 16, &SNARE, 2, 0.12, 0.0, "a"),
    (41.0, 0.25, 1, &LEAD, 0, 0.1, 0.1, "....h.moq---o-m-j-----hjm---h-m-o---l-h-j---m-o-r---q-o-q-----moo---l---q---o-m-v---t-r-t---q-m-o---q-o-l------."),
    (59.0, 0.25, 1, &BELL, 1, 0.07, -0.2, "q---o-m-v---t-r-t---q-m-o---q-o-l------."),
    (35.0, 34.0, 1, &WIND, 0, 0.12, 0.0, "a"),
    (36.0, 32.0, 1, &ENGINE, -2, 0.045, -0.2, "a"),
    // The evening.
    (69.0, 0.5, 1, &FLUTE, 0, 0.12, 0.1, "q---o-l-j-m-o---r-q-o-l-m--."),
    (69.0, 0.25, 7, &PLUCK, 0, 0.045, -0.4, "1.3.5.3."),
    (69.0, 2.0, 7, &BASS, -2, 0.15, 0.0, "0"),
    (70.0, 2.0, 6, &CHAPEL, -1, 0.05, -0.7, "a"),
    // Snow.
    (83.0, 0.5, 10, &BOX, 1, 0.07, -0.25, "123532"),
    (89.25, 0.5, 8, &BOX, 2, 0.025, 0.6, "3.1.2."),
    (83.0, 0.5, 1, &BELL, 1, 0.09, 0.2, ".........joqr--qo-n--j--o-----...joqt--rq-q--n--o-----o----."),
    (89.0, 3.0, 7, &BASS, -2, 0.12, 0.0, "0"),
    (83.0, 30.0, 1, &WIND, 0, 0.07, 0.3, "a"),
    // Fires.
    (113.0, 30.0, 1, &CRACKLE, 3, 0.3, 0.2, "a"),
    (113.0, 30.0, 1, &CRACKLE, 3, 0.2, -0.6, "h"),
    (113.0, 30.0, 1, &FLAMES, -1, 0.1, 0.0, "a"),
    (113.0, 2.0, 15, &BASS, -2, 0.16, 0.0, "0"),
    (115.0, 0.25, 7, &DRUM, -2, 0.2, -0.1, "c..c..c.c...c.cc"),
    (117.0, 0.25, 6, &DRUM, -1, 0.1, 0.4, "..c...j...c..jc."),
    (129.0, 0.25, 3, &DRUM, -1, 0.07, -0.5, ".cc.cc.c.cc.ccjj"),
    (129.0, 0.25, 6, &BASS, -2, 0.12, 0.0, "..0.4.0."),
    (117.0, 0.5, 1, &HORN, 0, 0.12, 0.0, "h-f-c---j-h-h-d-k-h-j---o-k-m-h-j-f-c---k-o-r-q-o-l-"),
    (129.0, 0.25, 7, &PLUCK, 0, 0.04, 0.4, "13531353"),
    // The last light.
    (143.0, 0.5, 1, &BELL, 0, 0.17, 0.15, "hmoq-omlj---m---"),
    (149.0, 0.25, 1, &BELL, 1, 0.05, -0.4, "..aehm--"),
    (143.0, 2.0, 4, &BASS, -2, 0.15, 0.0, "0"),
    (143.0, 1.0, 6, &BOX, 1, 0.03, -0.4, "1"),
    (143.0, 7.0, 1, &SEA, 1, 0.09, 0.0, "a"),
];

/// The score.
pub fn score() -> Score {
    let mut notes = Vec::new();
    let mut play = |start: f32, held: f32, tone: f32, voice: &'static Voice, gain: f32, place: f32| {
        // The same power wherever it is heard from.
        let [left, right] = [1.0 - place, 1.0 + place].map(|share| gain * share.sqrt());
        notes.push(Note::new(start, held, D * semitones(tone), [left, right], voice));
    };
    for (at, &(start, gain, [_, tones @ ..])) in CHORDS.iter().enumerate() {
        let end = CHORDS.get(at + 1).map_or(start, |next| next.0);
        for (tone, place) in tones.into_iter().zip([-0.4, 0.4, 0.0]) {
            play(start, end - start, (tone - 12) as f32, &PAD, gain, place);
        }
    }
    for &(start, step, times, voice, octave, gain, place, steps) in ROWS {
        for (n, letter) in steps.bytes().cycle().take(steps.len() * times).enumerate() {
            let time = start + n as f32 * step;
            let chord = CHORDS.iter().rfind(|chord| chord.0 <= time).unwrap_or(&CHORDS[0]).2;
            let tone = match letter {
                b'0'..=b'7' => {
                    let tone = (letter - b'0') as usize;
                    chord[tone % 4] + 12 * (tone / 4) as i32
                }
                b'a'..=b'z' => (letter - b'a') as i32,
                _ => continue,
            };
            let after = &steps.as_bytes()[n % steps.len() + 1..];
            let held = after.iter().take_while(|&&letter| letter == b'-').count() + 1;
            play(time, held as f32 * step, (tone + 12 * octave) as f32, voice, gain, place);
        }
    }
    Score::new(notes, LENGTH)
}

/// The ratio of frequencies `tone` semitones apart.
fn semitones(tone: f32) -> f32 {
    (f64::from(tone) / 12.0).exp2() as f32
}
