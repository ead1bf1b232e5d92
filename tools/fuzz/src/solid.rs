//! Solid textures, cameras and sizes of pictures from an input.

use crate::input::Input;
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::view::{Camera, View};

/// A texture.
pub fn texture(input: &mut Input) -> Texture {
    let octaves = input.below(6) as u32;
    let pattern = match input.below(7) {
        0 | 1 => Pattern::Plain,
        2 => Pattern::Checker,
        3 => Pattern::Clouds { octaves },
        4 => Pattern::Turbulence { octaves },
        5 => Pattern::Marble { warp: input.number(0.0, 8.0), scale: input.number(0.1, 8.0), octaves },
        _ => Pattern::Wood { warp: input.number(0.0, 1.0), octaves },
    };
    let palette = if input.flag() {
        Palette::Mix(input.color(), input.color())
    } else {
        Palette::Ramp([input.color(), input.color(), input.color(), input.color()])
    };
    Texture { pattern, palette, turn: input.turn() * input.number(0.1, 20.0), origin: input.vector(10.0) }
}

/// What a camera sees in a picture of up to 130 x 70 pixels, which is up to six tiles.
pub fn view(input: &mut Input) -> View {
    let (width, height) = (1 + input.below(130), 1 + input.below(70));
    let (eye, target) = (input.vector(20.0), input.vector(4.0));
    let target = if target == eye { eye - glam::Vec3A::Z } else { target };
    View::new(Camera::look_at(eye, target, input.number(0.05, 2.5), input.number(-4.0, 4.0)), width, height)
}
