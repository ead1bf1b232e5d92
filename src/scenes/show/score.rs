//! The music of the show, and what one hears of its scenes.
//!
//! The cuts are on beats of a second. Dawn, June, the flight, the evening and the last light are in D, snow and fires in E
//! minor. One theme goes through them: it is rung at dawn, sung by the flight, rung again in the snow in minor, and ends
//! the show.

use crate::sound::{Note, Score, Voice, exp2};

/// The length of the score, seconds: that of the show.
const LENGTH: usize = 154;
/// The D above middle C, hertz: the pitch that numbers and letters count from.
const D: f32 = 293.664_77;

/// A row of music: where it starts and the length of a step, in seconds, multiples of [`TICK`]; how often it is played,
/// its voice, octaves above [`D`], loudness, place from -1 at the left to 1 at the right, and its steps.
///
/// A step is a letter, for as many semitones above [`D`] as it comes after `a`; or a digit, for a tone of the chord of
/// that time, from 4 on an octave higher; or `-`, which holds the note before; or anything else, for silence.
type Row = (f32, f32, u8, u8, i8, f32, f32, &'static str);

/// The unit of a row's times, seconds.
const TICK: f32 = 1.0 / 16.0;
/// The units of loudness and of places.
const LOUDNESS: f32 = 1.0 / 200.0;
const PLACE: f32 = 1.0 / 20.0;

/// Names the numbers of voices, and makes the table of them.
macro_rules! voices {
    ($($name:ident: $voice:expr;)+) => {
        #[allow(clippy::upper_case_acronyms)]
        enum Number { $($name),+ }
        $(const $name: u8 = Number::$name as u8;)+
        static VOICES: [Voice; [$($name),+].len()] = [$($voice),+];
    };
}

/// A band of noise.
const NOISE: Voice = Voice { fade: 40.0, release: 0.02, noise: 1.0, room: 0.1, ..Voice::SINE };
/// Noise that comes and goes.
const GUSTS: Voice = Voice {
    attack: 3.0,
    fade: 0.0,
    release: 3.0,
    detune: 0.1,
    noise: 1.0,
    colour: 400.0,
    gusts: 0.6,
    gustiness: 0.9,

    ..Voice::SINE
};

voices! {
    PAD: Voice {
        attack: 1.2,
        fade: 0.15,
        release: 1.5,
        index: 0.15,
        dulling: 0.3,
        detune: 0.0025,
        room: 0.5,
        ..Voice::SINE
    };
    BELL: Voice { fade: 1.5, release: 1.5, ratio: 3.0, index: 0.2, dulling: 4.0, detune: 0.001, room: 0.5, ..Voice::SINE };
    BOX: Voice { fade: 3.0, release: 1.0, ratio: 5.0, index: 0.1, dulling: 8.0, room: 0.5, ..Voice::SINE };
    CHAPEL: Voice {
        attack: 0.01,
        fade: 1.0,
        release: 3.0,
        ratio: 1.4,
        index: 0.4,
        dulling: 0.6,
        detune: 0.001,
        room: 1.0,
        ..Voice::SINE
    };
    PLUCK: Voice { fade: 5.0, release: 0.3, ratio: 2.0, index: 0.2, dulling: 8.0, ..Voice::SINE };
    LEAD: Voice {
        attack: 0.05,
        fade: 0.5,
        release: 0.3,
        index: 0.2,
        dulling: 0.6,
        detune: 0.0025,
        room: 0.5,
        ..Voice::SINE
    };
    FLUTE: Voice {
        attack: 0.1,
        fade: 0.3,
        release: 0.3,
        ratio: 2.0,
        index: 0.04,
        detune: 0.001,
        noise: 0.04,
        colour: 9_000.0,
        room: 0.5,
        ..Voice::SINE
    };
    HORN: Voice { attack: 0.1, fade: 0.4, release: 0.5, index: 0.3, dulling: 1.0, detune: 0.0025, room: 0.5, ..Voice::SINE };
    BASS: Voice { fade: 2.5, release: 0.1, index: 0.3, dulling: 5.0, room: 0.1, ..Voice::SINE };
    KICK: Voice { fade: 9.0, release: 0.1, fall: 2.5, falling: 40.0, room: 0.1, ..Voice::SINE };
    DRUM: Voice {
        fade: 6.0,
        release: 0.3,
        index: 0.1,
        dulling: 12.0,
        fall: 1.5,
        falling: 20.0,
        noise: 0.04,
        colour: 3_000.0,
        room: 0.5,
        ..Voice::SINE
    };
    HAT: NOISE;
    SNARE: Voice { fade: 16.0, colour: 9_000.0, room: 0.5, ..NOISE };
    BIRD: Voice { attack: 0.01, fade: 9.0, release: 0.1, fall: -38.0, falling: 11.0, room: 0.5, ..Voice::SINE };
    WIND: GUSTS;
    SEA: Voice { colour: 2_400.0, gusts: 0.6, gustiness: 1.4, ..GUSTS };
    ENGINE: Voice {
        attack: 3.0,
        fade: 0.0,
        release: 3.0,
        ratio: 0.5,
        index: 0.3,
        detune: 0.0025,
        noise: 0.25,
        colour: 400.0,
        room: 0.1,
        ..Voice::SINE
    };
    CRACKLE: Voice {
        attack: 3.0,
        fade: 0.0,
        release: 2.0,
        detune: 0.1,
        noise: 1.0,
        colour: 16_000.0,
        gusts: 90.0,
        gustiness: 9.0,
        room: 0.1,
        ..Voice::SINE
    };
    FLAMES: Voice { colour: 250.0, gusts: 7.0, gustiness: 0.8, ..GUSTS };
}

/// A chord: from which second on, how loud it is held, in units of [`LOUDNESS`], and its number in [`TONES`].
type Chord = (u8, u8, u8);

/// The chords: the bass and three tones, in semitones above a D.
#[rustfmt::skip]
static TONES: [[i8; 4]; 11] = [
    [0, 4, 7, 14], // IN_D
    [5, 7, 9, 12], // IN_G
    [7, 7, 11, 14], // IN_A
    [9, 4, 7, 12], // IN_B_MINOR
    [4, 4, 7, 11], // IN_F_SHARP_MINOR
    [2, 5, 9, 14], // IN_E_MINOR
    [10, 5, 10, 14], // IN_C
    [7, 7, 10, 14], // IN_A_MINOR
    [9, 4, 9, 13], // IN_B
    [3, 7, 10, 15], // IN_F
    [0, 3, 7, 12], // IN_D_MINOR
];
const IN_D: u8 = 0;
const IN_G: u8 = 1;
const IN_A: u8 = 2;
const IN_B_MINOR: u8 = 3;
const IN_F_SHARP_MINOR: u8 = 4;
const IN_E_MINOR: u8 = 5;
const IN_C: u8 = 6;
const IN_A_MINOR: u8 = 7;
const IN_B: u8 = 8;
const IN_F: u8 = 9;
const IN_D_MINOR: u8 = 10;

#[rustfmt::skip]
const CHORDS: &[Chord] = &[
    // Dawn, in bars of three beats.
    (0, 10, IN_D), (3, 10, IN_G), (6, 10, IN_B_MINOR), (9, 12, IN_G), (12, 12, IN_E_MINOR),
    (15, 14, IN_G), (18, 14, IN_A),
    // June, and from here on bars of two.
    (21, 10, IN_D), (23, 10, IN_A), (25, 10, IN_B_MINOR), (27, 10, IN_F_SHARP_MINOR),
    (29, 10, IN_G), (31, 10, IN_E_MINOR), (33, 10, IN_A),
    // The flight.
    (35, 10, IN_B_MINOR), (37, 10, IN_G), (39, 10, IN_D), (41, 10, IN_A),
    (43, 12, IN_B_MINOR), (45, 12, IN_G), (47, 12, IN_D), (49, 12, IN_A),
    (51, 12, IN_E_MINOR), (53, 12, IN_G), (55, 12, IN_B_MINOR), (57, 12, IN_A),
    (59, 14, IN_B_MINOR), (61, 14, IN_G), (63, 14, IN_D), (65, 14, IN_A), (67, 10, IN_A),
    // The evening.
    (69, 12, IN_D), (71, 12, IN_F_SHARP_MINOR), (73, 12, IN_G), (75, 12, IN_E_MINOR),
    (77, 12, IN_G), (79, 12, IN_A), (81, 10, IN_B_MINOR),
    // Snow, in bars of three again.
    (83, 6, IN_E_MINOR), (86, 7, IN_C), (89, 8, IN_G), (92, 8, IN_B), (95, 9, IN_E_MINOR),
    (98, 9, IN_C), (101, 10, IN_A_MINOR), (104, 10, IN_B), (107, 9, IN_E_MINOR),
    (110, 8, IN_E_MINOR),
    // Fires.
    (113, 8, IN_E_MINOR), (117, 10, IN_F), (119, 10, IN_E_MINOR), (123, 10, IN_D_MINOR),
    (125, 10, IN_F), (127, 10, IN_E_MINOR), (129, 12, IN_C), (131, 12, IN_D),
    (133, 12, IN_E_MINOR), (137, 12, IN_C), (139, 12, IN_G), (141, 12, IN_A),
    // The last light.
    (143, 10, IN_D), (145, 10, IN_B_MINOR), (147, 12, IN_G), (149, 14, IN_D), (151, 0, IN_D),
];

#[rustfmt::skip]
const ROWS: &[Row] = &[
    // Dawn.
    (0.0, 0.5, 1, BELL, 0, 0.16, 0.2, "...hmoq--om-l--h--j----....hmor--qo-o--l-."),
    (0.0, 1.5, 14, BOX, 1, 0.025, -0.4, "13"),
    (0.0, 3.0, 7, BASS, -2, 0.12, 0.0, "0"),
    (12.0, 0.25, 6, PLUCK, 0, 0.03, -0.5, "013532"),
    // June.
    (21.0, 0.25, 7, PLUCK, 0, 0.07, -0.35, "13253532"),
    (21.125, 0.25, 7, PLUCK, 1, 0.03, 0.5, "31521325"),
    (21.0, 0.5, 1, FLUTE, 1, 0.09, 0.25, "q-oml-h-j-moq---r-qoo-mjl--."),
    (21.0, 1.0, 7, BASS, -2, 0.14, 0.0, "00"),
    (22.125, 0.125, 3, BIRD, 3, 0.02, 0.8, "c.c..e....................."),
    (24.375, 0.125, 3, BIRD, 3, 0.015, -0.8, "hh.h.......fff........"),
    // The flight.
    (35.0, 0.125, 16, PLUCK, 0, 0.06, -0.3, "1231532312315653"),
    (37.0625, 0.125, 15, PLUCK, 1, 0.025, 0.5, "1231532312315653"),
    (35.0, 2.0, 2, BASS, -2, 0.16, 0.0, "0"),
    (39.0, 0.25, 14, BASS, -2, 0.18, 0.0, "0.00.040"),
    (43.0, 0.5, 48, KICK, -3, 0.32, 0.0, "h"),
    (43.25, 0.5, 48, HAT, 5, 0.06, 0.3, "a"),
    (51.0, 0.125, 8, HAT, 5, 0.03, -0.4, "a.aaa.aaa.aaa.aa"),
    (51.5, 1.0, 16, SNARE, 2, 0.12, 0.0, "a"),
    (41.0, 0.25, 1, LEAD, 0, 0.1, 0.1, "....h.moq---o-m-j-----hjm---h-m-o---l-h-j---m-o-r---q-o-q-----moo---l---q---o-m-v---t-r-t---q-m-o---q-o-l------."),
    (59.0, 0.25, 1, BELL, 1, 0.07, -0.2, "q---o-m-v---t-r-t---q-m-o---q-o-l------."),
    (35.0, 2.0, 1, WIND, 0, 0.12, 0.0, "a----------------"),
    (36.0, 2.0, 1, ENGINE, -2, 0.045, -0.2, "a---------------"),
    // The evening.
    (69.0, 0.5, 1, FLUTE, 0, 0.12, 0.1, "q---o-l-j-m-o---r-q-o-l-m--."),
    (69.0, 0.25, 7, PLUCK, 0, 0.045, -0.4, "1.3.5.3."),
    (69.0, 2.0, 7, BASS, -2, 0.15, 0.0, "0"),
    (70.0, 2.0, 6, CHAPEL, -1, 0.05, -0.7, "a"),
    // Snow.
    (83.0, 0.5, 10, BOX, 1, 0.07, -0.25, "123532"),
    (89.25, 0.5, 8, BOX, 2, 0.025, 0.6, "3.1.2."),
    (83.0, 0.5, 1, BELL, 1, 0.09, 0.2, ".........joqr--qo-n--j--o-----...joqt--rq-q--n--o-----o----."),
    (89.0, 3.0, 7, BASS, -2, 0.12, 0.0, "0"),
    (83.0, 2.0, 1, WIND, 0, 0.07, 0.3, "a--------------"),
    // Fires.
    (113.0, 2.0, 1, CRACKLE, 3, 0.3, 0.2, "a--------------"),
    (113.0, 2.0, 1, CRACKLE, 3, 0.2, -0.6, "h--------------"),
    (113.0, 2.0, 1, FLAMES, -1, 0.1, 0.0, "a--------------"),
    (113.0, 2.0, 15, BASS, -2, 0.16, 0.0, "0"),
    (115.0, 0.25, 7, DRUM, -2, 0.2, -0.1, "c..c..c.c...c.cc"),
    (117.0, 0.25, 6, DRUM, -1, 0.1, 0.4, "..c...j...c..jc."),
    (129.0, 0.25, 3, DRUM, -1, 0.07, -0.5, ".cc.cc.c.cc.ccjj"),
    (129.0, 0.25, 6, BASS, -2, 0.12, 0.0, "..0.4.0."),
    (117.0, 0.5, 1, HORN, 0, 0.12, 0.0, "h-f-c---j-h-h-d-k-h-j---o-k-m-h-j-f-c---k-o-r-q-o-l-"),
    (129.0, 0.25, 7, PLUCK, 0, 0.04, 0.4, "13531353"),
    // The last light.
    (143.0, 0.5, 1, BELL, 0, 0.17, 0.15, "hmoq-omlj---m---"),
    (149.0, 0.25, 1, BELL, 1, 0.05, -0.4, "..aehm--"),
    (143.0, 2.0, 4, BASS, -2, 0.15, 0.0, "0"),
    (143.0, 1.0, 6, BOX, 1, 0.03, -0.4, "1"),
    (143.0, 7.0, 1, SEA, 1, 0.09, 0.0, "a"),
];

/// Rounded to the nearest.
const fn nearest(x: f32) -> i32 {
    (x + if x < 0.0 { -0.5 } else { 0.5 }) as i32
}

/// [`ROWS`] as bytes, as far as `N` of them go, and how many there are: of each row seven numbers, of which the first has
/// two bytes, and its steps with a zero at their end.
const fn encode<const N: usize>() -> ([u8; N], usize) {
    let (mut bytes, mut size, mut i) = ([0; N], 0, 0);
    while i < ROWS.len() {
        let (start, step, times, voice, octave, gain, place, steps) = ROWS[i];
        let [low, high] = (nearest(start / TICK) as u16).to_le_bytes();
        let step = nearest(step / TICK) as u8;
        let head =
            [low, high, step, times, voice, octave as u8, nearest(gain / LOUDNESS) as u8, nearest(place / PLACE) as u8];
        let mut k = 0;
        while k <= head.len() + steps.len() {
            if size < N {
                bytes[size] = if k < head.len() {
                    head[k]
                } else if k < head.len() + steps.len() {
                    steps.as_bytes()[k - head.len()]
                } else {
                    0
                };
            }
            size += 1;
            k += 1;
        }
        i += 1;
    }
    (bytes, size)
}

/// The music, in the bytes that the 64 kB build has of it.
static BYTES: [u8; encode::<0>().1] = encode().0;

/// The score.
pub fn score() -> Score {
    let mut notes = Vec::new();
    let mut play = |start: f32, held: f32, tone: i32, voice: u8, gain: f32, place: f32| {
        // The same power wherever it is heard from.
        let [left, right] = [1.0 - place, 1.0 + place].map(|share| gain * share.sqrt());
        // Nine octaves up and down again: exponents are at most 0.
        let pitch = D * 512.0 * exp2(tone as f32 / 12.0 - 9.0);
        notes.push(Note::new(start, held, pitch, [left, right], &VOICES[voice as usize]));
    };
    // The chord of each second.
    let mut chords = [0; LENGTH];
    let mut end = LENGTH;
    for &(start, gain, chord) in CHORDS.iter().rev() {
        let start = start as usize;
        chords[start..end].fill(chord);
        for (tone, place) in TONES[chord as usize][1..].iter().zip([-0.4, 0.4, 0.0]) {
            play(start as f32, (end - start) as f32, i32::from(*tone) - 12, PAD, f32::from(gain) * LOUDNESS, place);
        }
        end = start;
    }
    let mut bytes = &BYTES[..];
    while let [low, high, step, times, voice, octave, gain, place, rest @ ..] = bytes {
        let (mut time, step) = (f32::from(u16::from_le_bytes([*low, *high])) * TICK, f32::from(*step) * TICK);
        let length = rest.iter().position(|&letter| letter == 0).unwrap_or(0);
        let steps = &rest[..length];
        bytes = &rest[length + 1..];
        for _ in 0..*times {
            for (n, &letter) in steps.iter().enumerate() {
                let tone = match letter {
                    b'0'..=b'7' => {
                        let tone = letter - b'0';
                        i32::from(TONES[chords[time as i32 as usize] as usize][tone as usize % 4])
                            + 12 * i32::from(tone / 4)
                    }
                    b'a'..=b'z' => i32::from(letter - b'a'),
                    _ => -1,
                };
                let held = steps[n + 1..].iter().take_while(|&&letter| letter == b'-').count() + 1;
                if tone >= 0 {
                    let gain = f32::from(*gain) * LOUDNESS;
                    let place = f32::from(*place as i8) * PLACE;
                    play(time, held as f32 * step, tone + 12 * i32::from(*octave as i8), *voice, gain, place);
                }
                time += step;
            }
        }
    }
    Score::new(notes, LENGTH as f64)
}
