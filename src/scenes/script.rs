//! A small language for sets, since a number in a table takes fewer bytes than one in code.
//!
//! A script is a row of words, run from left to right over a stack: a number goes onto it, an operation takes its
//! numbers from there. Arithmetic is done here, all other operations by whoever asks for the [`Script::next`] one: they
//! take the whole stack. Below it are [`VARIABLES`], which stay.

use crate::texture::{Palette, Pattern, Texture};
use glam::{Mat3, Vec3, vec3};

/// A word: a number from -4 to 11.9 in tenths, which is one byte; from -25.6 to 25.595 in steps of 1/200, which is two;
/// or an operation, which is [`word`] of its byte.
pub type Word = f32;

/// Numbers beside the stack.
pub const VARIABLES: usize = 16;
/// Bytes from here on start a number of two bytes,
const TWO: u8 = 56;
/// bytes from here on are one.
const ONE: u8 = 96;
// The first bytes of 0.
const TWO_ZERO: i32 = 76;
const ONE_ZERO: i32 = 136;
/// Steps of 1, and of a tenth.
const STEPS: f32 = 200.0;
const TENTH: i32 = 20;

/// An operation as a word.
pub const fn word(operation: u8) -> Word {
    1000.0 + operation as f32
}

/// Puts the value of a variable onto the stack.
pub const fn get(variable: u8) -> Word {
    word(variable)
}

/// Takes the value of a variable from the stack.
pub const fn set(variable: u8) -> Word {
    word(VARIABLES as u8 + variable)
}

/// Names operations, as words and in the module `byte` as bytes.
macro_rules! operations {
    ($($(#[$about:meta])* $name:ident = $byte:expr;)+) => {
        $($(#[$about])* pub const $name: $crate::scenes::script::Word = $crate::scenes::script::word(byte::$name);)+
        #[allow(missing_docs)]
        pub mod byte {
            $(pub const $name: u8 = $byte;)+
        }
    };
}
pub(crate) use operations;

operations! {
    /// The sum of two numbers.
    ADD = 32;
    /// Their product.
    MUL = 33;
    /// The sine of a number.
    SIN = 34;
    /// Its cosine.
    COS = 35;
    /// What it is without its sign.
    ABS = 36;
    /// Takes a width and before it a number, and leaves of a stack of such rows that one, counted around.
    PICK = 37;
    /// Takes a number: what follows is to run so often, by a [`COUNT`] from 0 on,
    REPEAT = 38;
    /// up to here. Operations from 40 on are left to others.
    AGAIN = 39;
}
/// The variable that counts.
pub const COUNT: Word = get(3);
/// The bytes of a word, and how many.
const fn coded(word: Word) -> ([u8; 2], usize) {
    if word >= self::word(0) {
        return ([(word - self::word(0)) as u8, 0], 1);
    }
    let steps = (word * STEPS + (TWO_ZERO << 8) as f32 + 0.5) as i32;
    let exact = steps - (TWO_ZERO << 8);
    let one = exact / TENTH + ONE_ZERO;
    if exact % TENTH == 0 && one >= ONE as i32 && one < 256 {
        return ([one as u8, 0], 1);
    }
    assert!(steps >> 8 >= TWO as i32 && steps >> 8 < ONE as i32);
    ([(steps >> 8) as u8, steps as u8], 2)
}

/// The bytes of a script's parts, if it takes at most so many, and how many it takes.
pub const fn bytes<const N: usize>(parts: &[&[Word]]) -> ([u8; N], usize) {
    let (mut bytes, mut size, mut i) = ([0; N], 0, 0);
    while i < parts.len() {
        let mut k = 0;
        while k < parts[i].len() {
            let (word, length) = coded(parts[i][k]);
            let mut byte = 0;
            while byte < length {
                if size < N {
                    bytes[size] = word[byte];
                }
                size += 1;
                byte += 1;
            }
            k += 1;
        }
        i += 1;
    }
    (bytes, size)
}

/// The bytes of a script of some parts, each of which is an array of words.
macro_rules! script {
    ($($part:expr),+ $(,)?) => {{
        const PARTS: &[&[$crate::scenes::script::Word]] = &[$(&$part),+];
        const SIZE: usize = $crate::scenes::script::bytes::<0>(PARTS).1;
        static BYTES: [u8; SIZE] = $crate::scenes::script::bytes(PARTS).0;
        &BYTES
    }};
}
pub(crate) use script;

/// A script that runs.
pub struct Script {
    bytes: &'static [u8],
    /// The next byte.
    at: usize,
    /// What is to be repeated from where, and how often.
    again: (usize, f32),
    /// Variables, then the stack.
    pub numbers: [f32; 256],
    /// The end of the stack.
    top: u8,
}

impl Script {
    /// Of these bytes, with the first variables.
    #[inline(never)]
    pub fn new(bytes: &'static [u8], variables: [f32; 2]) -> Script {
        let mut numbers = [0.0; 256];
        [numbers[0], numbers[1]] = variables;
        Script { bytes, at: 0, again: (0, 0.0), numbers, top: 0 }
    }

    /// The numbers that the last operation takes.
    pub fn stack(&self) -> &[f32] {
        &self.numbers[VARIABLES..self.top as usize]
    }

    /// The next operation that is not arithmetic. Panics after the last one.
    #[inline(never)]
    pub fn next(&mut self) -> u8 {
        const COUNT: usize = 3;
        let mut top = VARIABLES as u8;
        loop {
            let word = self.bytes[self.at];
            self.at += 1;
            // The last two numbers; where the result goes.
            let mut at = top - 2;
            let [a, b] = [at, at + 1].map(|i| self.numbers[i as usize]);
            let number = match word {
                byte::ADD => a + b,
                byte::MUL => a * b,
                byte::SIN | byte::COS | byte::ABS => {
                    at += 1;
                    match word {
                        byte::SIN => b.sin(),
                        byte::COS => b.cos(),
                        _ => b.abs(),
                    }
                }
                byte::PICK => {
                    let width = b as u8;
                    let rows = (at - VARIABLES as u8) / width;
                    let row = a as u8 % rows * width;
                    top = VARIABLES as u8;
                    for _ in 0..width {
                        self.numbers[top as usize] = self.numbers[(top + row) as usize];
                        top += 1;
                    }
                    continue;
                }
                byte::AGAIN => {
                    self.numbers[COUNT] += 1.0;
                    if self.numbers[COUNT] < self.again.1 {
                        self.at = self.again.0;
                    }
                    continue;
                }
                byte::REPEAT => {
                    self.again = (self.at, b);
                    self.numbers[COUNT] = 0.0;
                    top -= 1;
                    continue;
                }
                16..32 => {
                    self.numbers[word as usize - VARIABLES] = b;
                    top -= 1;
                    continue;
                }
                _ => {
                    at = top;
                    match word {
                        0..16 => self.numbers[word as usize],
                        TWO.. => {
                            let mut steps = (word as i32 - ONE_ZERO) * TENTH;
                            if word < ONE {
                                steps = (word as i32 - TWO_ZERO) * 256 + self.bytes[self.at] as i32;
                                self.at += 1;
                            }
                            steps as f32 / STEPS
                        }
                        _ => {
                            self.top = top;
                            return word;
                        }
                    }
                }
            };
            self.numbers[at as usize] = number;
            top = at + 1;
        }
    }
}

// Kinds of textures: one colour, the first; squares; soft noise; noise with creases.
pub const PLAIN: u8 = 0;
pub const CHECKER: u8 = 1;
pub const CLOUDS: u8 = 2;
pub const CREASES: u8 = 3;
/// Layers along x, folded.
pub const MARBLE: u8 = 4;
/// Shades of the second colour, with veins of the first.
pub const VEINS: u8 = 5;
/// Rings around y. The last year's wood is as dark as the next one's.
pub const WOOD: u8 = 6;
/// Layers of four colours one above the other. Beside what others have: how wide the noise is, two colours, and where
/// the middle of a layer is, hundreds of metres.
pub const LAYERS: u8 = 7;

/// The words of most textures: two colours; units a metre; how far noise bends it, or how many octaves it has; the kind.
pub const fn kind(kind: u8, [r, g, b]: [Word; 3], [x, y, z]: [Word; 3], scale: Word, warp: Word) -> [Word; 9] {
    [r, g, b, x, y, z, scale, warp, kind as Word]
}

/// The texture of such numbers, turned by `turn` (world to texture) around `at`.
#[inline(never)]
pub fn texture(n: &[f32; 17], turn: &Mat3, at: Vec3) -> Texture {
    let color = |i: usize| vec3(n[i], n[i + 1], n[i + 2]);
    let (a, b, warp, kind) = (color(0), color(3), n[7], n[8] as u8);
    let octaves = warp as u32;
    let pattern = match kind {
        PLAIN => Pattern::Plain,
        CHECKER => Pattern::Checker,
        CLOUDS => Pattern::Clouds { octaves },
        CREASES => Pattern::Turbulence { octaves },
        WOOD => Pattern::Wood { warp, octaves: 2 },
        LAYERS => Pattern::Marble { warp, scale: n[9], octaves: 5 },
        _ => Pattern::Marble { warp, scale: 0.5 * warp, octaves: 3 },
    };
    let palette = match kind {
        VEINS => Palette::Ramp([a, b, b * 0.75, b]),
        WOOD => Palette::Ramp([a, b, a * 0.4 + b * 0.6, a]),
        LAYERS => Palette::Ramp([a, b, color(10), color(13)]),
        _ => Palette::Mix(a, b),
    };
    let mut texture = Texture { pattern, palette, turn: *turn * n[6], origin: at };
    if kind == LAYERS {
        // What is x there is y here.
        (texture.turn.x_axis, texture.turn.y_axis) = (texture.turn.y_axis, texture.turn.x_axis);
        texture.origin.y = 100.0 * n[16];
    }
    texture
}
