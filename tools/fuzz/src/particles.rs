//! The particle renderer with any fall of snow and any fire.

use crate::input::Input;
use crate::{pixels, solid};
use glam::{DVec3, dvec3};
use paprsek::frame::Layer;
use paprsek::particles::{Fire, Flakes, Lens, ParticleLayer, Snow};
use paprsek::raster::{RasterLayer, World};
use paprsek::scenes::bench::particles::{FLAKES, FLAME};
use paprsek::settings::{ParticleSettings, Quality};

pub fn run(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let view = solid::view(input);
    let settings = ParticleSettings { detail: input.one_of(&[f32::INFINITY, 1.0 / 128.0, 0.5, 0.0]) };
    let color = input.color();
    let lens = Lens {
        radius: [input.number(0.1, 2.0), input.number(2.0, 30.0)],
        near: [input.number(0.05, 0.5), input.number(0.5, 2.0)],
        aperture: if input.flag() { 0.0 } else { input.number(0.0, 0.05) },
        focus: input.number(0.5, 20.0),
        crystals: input.flag(),
        streaks: input.flag(),
    };
    let flakes = Flakes {
        seed: input.word(),
        count: input.below(3000) as u32,
        opacity: input.number(0.0, 1.0),
        radius: [input.number(0.001, 0.02), input.number(0.0, 0.05)],
        sway: [input.number(0.0, 1.0), input.number(0.0, 1.0)],
        lens,
        ..FLAKES
    };
    let (time, share) = (time(input), input.number(0.0, 1.0));
    let eye = view.camera().eye.as_dvec3();
    let wind: DVec3 = dvec3(f64::from(input.number(-20.0, 20.0)), 0.0, f64::from(input.number(-20.0, 20.0)));
    let fire = Fire {
        flame: FLAME,
        place: input.vector(8.0),
        scale: input.number(0.05, 3.0),
        time,
        seed: input.word(),
        first: input.below(1000) as u32,
        count: input.below(3000) as f32,
        weight: input.number(0.0, 1.0),
        wind: input.vector(3.0),
        lens,
    };
    let layers = || {
        let ground = RasterLayer::new(World::default(), &view, &Quality::DEFAULT.raster);
        let snow = Snow::new(&flakes, time, eye, wind, share);
        let seen = ParticleLayer::new(vec![snow.into(), fire.into()], &view, &settings).colored(color);
        vec![Box::new(ground) as Box<dyn Layer>, Box::new(seen)]
    };
    pixels::check(layers, (view.width(), view.height()), input.is_wild);
}

/// A time that the command line takes, seconds: up to 10^12.
fn time(input: &mut Input) -> f64 {
    let (whole, shift) = (f64::from(input.word()), input.below(12) as i32);
    whole * 10f64.powi(shift - 9)
}
