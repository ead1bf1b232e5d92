//! The rasterizer with any mesh.

use crate::input::Input;
use crate::{pixels, solid};
use glam::{Affine3A, Vec2, Vec3A};
use paprsek::raster::{Bias, Body, Face, Haze, Light, Mesh, Paint, RasterLayer, ShadowViews, World, fit};
use paprsek::settings::{Quality, RasterSettings};
use paprsek::view::View;
use std::sync::Arc;

/// Most of each, so that a picture takes milliseconds.
const BODIES: usize = 5;
const POINTS: usize = 60;
const FACES: usize = 60;

pub fn run(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let view = solid::view(input);
    let coverage = input.one_of(&[1, 2, 4, 8, 16]);
    let settings = RasterSettings { coverage, grid: input.one_of(&[1, 1, 1, 8]), ..Quality::DEFAULT.raster };
    let world = world(input, &view);
    let layers = || vec![Box::new(RasterLayer::new(world.clone(), &view, &settings)) as Box<_>];
    pixels::check(layers, (view.width(), view.height()), input.is_wild);
}

fn world(input: &mut Input, view: &View) -> World {
    let mut world = World {
        ambient: [input.color(), input.color()],
        haze: Haze::even(input.color(), input.number(0.0, 0.5)),
        zenith: input.color(),
        film: input.flag(),
        background: input.flag().then_some(Vec3A::splat(0.25)),
        ..World::default()
    };
    for _ in 0..input.below(3) {
        let light = light(input, view);
        world.lights.push(light);
    }
    for _ in 0..input.below(4) {
        let texture = solid::texture(input);
        world.textures.push(texture);
    }
    while world.bodies.len() < BODIES && !input.is_empty() {
        let mesh = Arc::new(mesh(input, world.textures.len()));
        let place = Affine3A { matrix3: input.turn() * input.number(0.1, 3.0), translation: input.vector(8.0) };
        world.bodies.push(Body::new(mesh, place));
    }
    world
}

fn light(input: &mut Input, view: &View) -> Light {
    let (is_sun, color) = (input.flag(), input.color());
    let bias = Bias { constant: input.number(0.0, 0.1), slope: input.number(0.0, 4.0), normal: input.number(0.0, 2.0) };
    // A multiple of 64 texels.
    let size = 64 * (1 + input.below(4) as u32);
    let (light, views) = if is_sun {
        let towards = input.direction();
        let first = input.number(0.5, 10.0);
        let views =
            fit::cascades(view.camera(), view.width() as f32 / view.height() as f32, towards, &[first, 40.0], size);
        (Light::sun(towards, color), views)
    } else {
        let position = input.vector(8.0);
        let falloff = Vec2::new(input.number(0.0, 1.0), input.number(0.0, 1.0));
        let reach = if input.flag() { f32::INFINITY } else { input.number(0.1, 30.0) };
        (Light::lamp(position, color, falloff, reach), fit::cube(position, size))
    };
    if input.flag() {
        return light;
    }
    let (back_faces, traced, smooth) = (input.flag(), input.flag(), input.flag());
    light.with_shadow(ShadowViews { back_faces, traced, smooth, ..ShadowViews::new(views, bias) })
}

/// Any points, normals and faces, whose indices are within them.
fn mesh(input: &mut Input, textures: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let is_smooth = input.flag();
    // Normals may have any length, 0 among them.
    let length = input.one_of(&[1.0, 1.0, 0.0]);
    for _ in 0..3 + input.below(POINTS) {
        // Further ones would all be the same.
        if input.is_empty() && mesh.points.len() > 3 {
            break;
        }
        mesh.points.push(input.vector(5.0));
        if is_smooth {
            let normal = input.vector(3.0) * length;
            mesh.normals.push(normal);
        }
    }
    for _ in 0..1 + input.below(3) {
        let texture = (textures > 0 && input.flag()).then(|| input.below(textures) as u8);
        let paint = Paint { albedo: input.color().min(Vec3A::ONE), texture, gloss: input.number(0.0, 1.0) };
        mesh.paints.push(paint);
    }
    for _ in 0..1 + input.below(FACES) {
        let corners = [0; 3].map(|_| input.below(mesh.points.len()) as u16);
        mesh.faces.push(Face { corners, paint: input.below(mesh.paints.len()) as u16 });
        if input.is_empty() {
            break;
        }
    }
    mesh
}
