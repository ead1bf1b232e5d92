//! The third part of the intro: by aeroplane through a morning's clouds, from dawn to noon.

use super::{Scene, Shot, day};
use crate::camera::Camera;
use crate::cloud::field::Field;
use crate::cloud::march::Look;
use crate::cloud::shape::Kind;
use crate::cloud::voxels::Voxels;
use crate::cloud::{CloudQuality, Clouds, sunlight};
use crate::color::Transfer;
use crate::lanes;
use crate::raster::light::{Haze, Light, Source};
use crate::raster::{Drawn, World};
use crate::sky::backdrop::{self, Backdrop};
use crate::sky::dome::{Dome, DomeQuality, Sky};
use crate::sky::place::Place;
use crate::tile::Picture;
use crate::view::View;
use fearless_simd::dispatch;
use glam::{Affine3A, Mat3, Vec2, Vec3, vec3};
use std::f32::consts::TAU;
use std::sync::{Arc, Mutex};

/// The part.
pub const CLOUDS: Scene =
    Scene { name: "clouds", about: "a flight through clouds, from dawn to noon", duration: 50.0, picture };

const FIELD: Field = Field {
    seed: 5,
    spacing: 520.0,
    share: 0.55,
    height: 640.0,
    size: [110.0, 170.0],
    range: 5200.0,
    extinction: 26.0,
};

/// Shapes lit by a sun that is `towards`: made again when it has moved by some half of a degree.
fn shapes(towards: Vec3) -> Vec<Arc<Voxels>> {
    type Slot = (Vec3, Option<Arc<Voxels>>);
    static SLOTS: Mutex<[Slot; 6]> = Mutex::new([const { (Vec3::ZERO, None) }; 6]);
    let mut slots = SLOTS.lock().unwrap();
    let level = lanes::best();
    let mut shapes = Vec::new();
    for (number, (lit, shape)) in slots.iter_mut().enumerate() {
        // Each at a time of its own, lest all are made in one frame.
        let sun = ((towards * 128.0 + number as f32 / 6.0).floor() - number as f32 / 6.0 + 0.5).normalize();
        if *lit != sun || shape.is_none() {
            let kind = if number < 4 { Kind::CUMULUS } else { Kind::CONGESTUS };
            let mut new = match shape {
                Some(old) => Voxels::new(64, old.density.clone()),
                None => dispatch!(level, simd => Kind::grow(simd, &kind, number as u32, 64)),
            };
            dispatch!(level, simd => sunlight::bake(simd, &mut new, sun, FIELD.extinction));
            *shape = Some(Arc::new(new));
            *lit = sun;
        }
        shapes.extend(shape.clone());
    }
    shapes
}

fn picture(shot: &Shot) -> Picture {
    let time = shot.time as f32;
    let hour = 4.75 + 7.25 * (shot.time / 50.0).powf(1.6);
    let way = |t: f32| {
        vec3(70.0 * t, 690.0 + 60.0 * (0.21 * t).sin() - 40.0 * (0.13 * t).cos(), 260.0 * (0.05 * t).sin() - 300.0)
    };
    let place = way(time);
    let ahead = (way(time + 0.5) - place).normalize();
    let bend = (way(time + 1.5) - way(time + 1.0)).normalize() - ahead;
    let side = ahead.cross(Vec3::Y).normalize();
    let bank = (bend.dot(side) * 6.0).clamp(-0.9, 0.9);
    let turn = Mat3::from_cols(side, side.cross(ahead), -ahead) * Mat3::from_rotation_z(-bank);
    let orbit = 0.35 * (0.17 * time).sin() + 0.5;
    let eye = place - ahead * (16.0 * orbit.cos())
        + side * (16.0 * orbit.sin())
        + Vec3::Y * (3.5 + 2.0 * (0.23 * time).sin());
    let camera = Camera::look_at(eye, place + ahead * 9.0, 50f32.to_radians(), -0.25 * bank);
    let camera = shot.camera(camera);
    let dome = Dome::new(Sky::new(9671.5 + (hour - 1.0) / 24.0, &Place::PLZEN), DomeQuality::new(&shot.quality));
    let now = dome.lighting();
    let mut bodies = day::bodies().clone();
    let turns = 5.0 * shot.time;
    let spin = turn * Mat3::from_rotation_z((turns - turns.floor()) as f32 * TAU);
    let aeroplane = bodies.len() - 2;
    for (body, turn) in bodies[aeroplane..].iter_mut().zip([turn, spin]) {
        body.put(Affine3A::from_mat3_translation(turn, place));
    }
    let towards = vec3(now.direction.x, 0.05, now.direction.z).normalize();
    let [glow, haze] = [towards, vec3(-towards.x, towards.y, -towards.z)].map(|d| dome.radiance(d));
    let world = World {
        bodies,
        textures: day::plan(0, 0.0).2,
        lights: vec![Light { source: Source::Sun(now.direction), color: now.color, shadow: None }],
        veil: None,
        ambient: [(now.sky + now.ground) * 0.5, (now.sky - now.ground) * 0.5],
        haze: Haze {
            color: haze,
            density: 1.0 / 5000.0,
            glow: (towards, (glow - haze).max(Vec3::ZERO)),
            image: Vec3::ZERO,
        },
        zenith: dome.radiance(Vec3::Y),
        film: true,
        background: None,
    };
    let view = View::new(camera, shot.width, shot.height);
    let drawn = Drawn::new(world, view, shot.width, shot.height, shot.quality);
    let drift = Vec2::new(9.0, 4.0) * time;
    let field = FIELD.around(eye, drift, &shapes(now.direction));
    let look = Look {
        ambient: [now.ground * 0.5 + now.sky * 0.35, now.sky * 0.9],
        towards: now.direction,
        sun: now.color * 0.8,
        phase: [0.8, 0.9],
    };
    let air = |d: Vec3| dome.radiance(vec3(d.x, d.y.max(0.03), d.z).normalize());
    let clouds = Clouds::new(field, look, air, 6000.0, view, CloudQuality::new(&shot.quality));
    let look = backdrop::Look { behind: true, shimmer: shot.time, ..backdrop::Look::default() };
    let backdrop = Backdrop::new(dome, camera, shot.width, shot.height, look);
    Picture { layers: vec![Box::new(drawn), Box::new(clouds), Box::new(backdrop)], transfer: Transfer::Srgb }
}
