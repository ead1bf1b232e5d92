//! Where particles come from.

use super::fire::Fire;
use super::screen::Screen;
use super::snow::Snow;
use super::sprite::Sprite;
use super::strokes::Strokes;
use crate::simd::lanes::{F, STEPS, U};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;

/// Particles of one kind.
pub enum Emitter {
    /// Flakes or drops around the eye.
    Snow(Snow),
    /// Flames or sparks.
    Fire(Fire),
    /// Writing made of sparks.
    Strokes(Strokes),
}

impl From<Snow> for Emitter {
    fn from(snow: Snow) -> Emitter {
        Emitter::Snow(snow)
    }
}

impl From<Fire> for Emitter {
    fn from(fire: Fire) -> Emitter {
        Emitter::Fire(fire)
    }
}

impl From<Strokes> for Emitter {
    fn from(strokes: Strokes) -> Emitter {
        Emitter::Strokes(strokes)
    }
}

impl Emitter {
    /// The number of particles, seen or not.
    pub(super) fn count(&self) -> u32 {
        match self {
            Emitter::Snow(snow) => snow.count(),
            Emitter::Fire(fire) => fire.count(),
            Emitter::Strokes(strokes) => strokes.count(),
        }
    }
}

/// Adds the sprites of an emitter's particles from number `first` to before number `end` that are on the screen.
#[simd]
pub fn emit<S: Simd>(simd: S, emitter: &Emitter, [first, end]: [u32; 2], screen: &Screen, sprites: &mut Vec<Sprite>) {
    let lanes = F::<S>::LEN as u32;
    let mut i = first;
    while i < end {
        let numbers = U::<S>::from_slice(simd, &STEPS[..F::<S>::LEN]) + i;
        let (batch, lens, eye) = match emitter {
            Emitter::Snow(snow) => (snow.batch(simd, numbers), &snow.flakes.lens, Vec3A::ZERO),
            Emitter::Fire(fire) => (fire.batch(simd, numbers), &fire.lens, screen.eye),
            Emitter::Strokes(strokes) => (strokes.batch(simd, numbers), &strokes.lens, Vec3A::ZERO),
        };
        let wanted = (1 << lanes.min(end - i)) - 1;
        screen.push(simd, batch, lens, eye, wanted, sprites);
        i += lanes;
    }
}
