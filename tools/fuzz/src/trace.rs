//! The ray tracer with any world.

use crate::input::Input;
use crate::{pixels, solid};
use glam::Vec3A;
use paprsek::settings::{Quality, TraceSettings};
use paprsek::trace::{Background, Emitter, Glow, Light, Material, Object, Shape, TraceLayer, World};

/// Most bodies, so that a picture takes milliseconds. More than 64 are sorted into groups; they come of a few that are
/// repeated.
const BODIES: usize = 10;

pub fn run(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let view = solid::view(input);
    let settings = settings(input);
    let world = world(input);
    let layers = || vec![Box::new(TraceLayer::new(world.clone(), &view, &settings)) as Box<_>];
    pixels::check(layers, (view.width(), view.height()), input.is_wild);
}

fn settings(input: &mut Input) -> TraceSettings {
    let named = input.one_of(&[Quality::FAST, Quality::DEFAULT, Quality::EXACT]).trace;
    // Powers of two from 1 on.
    let cell = 1 << input.below(5);
    TraceSettings { cell, light_samples: [input.one_of(&[1, 4, 16]), input.one_of(&[1, 4])], ..named }
}

fn world(input: &mut Input) -> World {
    let mut world = World {
        ambient: input.color(),
        background: Background {
            horizon: input.color(),
            zenith: input.color(),
            glow: Glow { direction: input.direction(), color: input.color(), squarings: input.below(10) as u32 },
        },
        max_level: input.below(6) as u32,
        ..World::EMPTY
    };
    for _ in 0..input.below(World::MAX_LIGHTS.min(4)) {
        let emitter =
            if input.flag() { Emitter::Point(input.vector(10.0)) } else { Emitter::Directional(input.direction()) };
        let radius = if input.flag() { input.number(0.0, 2.0) } else { 0.0 };
        world.lights.push(Light { emitter, color: input.color(), radius });
    }
    while world.objects.len() < BODIES && !input.is_empty() {
        let object = object(input);
        world.objects.push(object);
    }
    // The same bodies, moved: so many that they are sorted.
    if input.flag()
        && let Some(&first) = world.objects.first()
    {
        for i in 0..70 {
            let mut object = first;
            if let Shape::Sphere { center, .. } | Shape::Block { center, .. } | Shape::Cylinder { center, .. } =
                &mut object.shape
            {
                *center += Vec3A::new(i as f32 % 8.0, i as f32 / 8.0, 0.5 * i as f32);
            }
            world.objects.push(object);
        }
    }
    world
}

fn object(input: &mut Input) -> Object {
    let center = input.vector(8.0);
    let radius = input.number(0.01, 4.0);
    let shape = match input.below(5) {
        0 => Shape::Sphere { center, radius },
        1 => Shape::Plane { normal: input.direction(), offset: input.number(-5.0, 5.0) },
        2 => Shape::Globe { touch: center, normal: input.direction(), radius: 1000.0 * radius },
        3 => {
            let half = [radius, input.number(0.01, 4.0), input.number(0.01, 4.0)].into();
            Shape::Block { center, half, turn: input.turn() }
        }
        _ => Shape::Cylinder { center, axis: input.direction(), half: input.number(0.01, 4.0), radius },
    };
    let albedo = solid::texture(input);
    let material = match input.below(4) {
        0 => Material::glass(input.number(1.0, 2.5), input.color().min(Vec3A::ONE)),
        1 => Material::mirror(input.color().min(Vec3A::ONE)),
        2 => Material::matte(albedo),
        _ => {
            let shiny = Material::matte(albedo).polished(input.number(0.0, 1.0), input.number(0.0, 1.0), 1.0);
            shiny.shiny(input.number(0.0, 1.0), input.number(1.0, 500.0)).lacquered(input.number(0.0, 1.0))
        }
    };
    Object { shape, material, casts_shadow: input.flag() }
}
