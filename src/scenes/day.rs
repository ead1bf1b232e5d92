//! The second part of the intro: days on a hill by a lake, from dawn to the stars, through the year.

use super::models::{self, MEADOW, chapel, land, mustang, tree};
use super::{Scene, Shot};
use crate::camera::Camera;
use crate::color::Transfer;
use crate::raster::fit;
use crate::raster::light::{Haze, Light, Source};
use crate::raster::mesh::Mesh;
use crate::raster::shadow::{Bias, Plan};
use crate::raster::{Body, Drawn, World};
use crate::sky::backdrop::{Backdrop, Look};
use crate::sky::dome::{Dome, DomeQuality, Sky};
use crate::sky::place::Place;
use crate::texture::{Palette, Texture};
use crate::tile::Picture;
use crate::timeline::{self, Key, ease};
use crate::view::View;
use glam::{Affine3A, Mat3, Vec2, Vec3, vec3};
use std::f32::consts::TAU;
use std::sync::{Arc, OnceLock};

/// The part.
pub const DAY: Scene =
    Scene { name: "day", about: "a hill by a lake: four days, one of each season", duration: 4.0 * LENGTH, picture };

/// Seconds that a day takes, from four in the morning to four in the morning.
pub const LENGTH: f64 = 60.0;

/// A day of the year.
pub(super) struct Season {
    /// Days from J2000 to midnight, Central European Time: 2026-06-25, 2026-09-19, 2026-12-22, 2027-03-10.
    midnight: f64,
    /// Albedo of the meadows, and what that of leaves is multiplied by.
    grass: Vec3,
    leaves: Vec3,
    /// Share of the land that is white.
    snow: f32,
}

pub(super) const SEASONS: [Season; 4] = [
    Season { midnight: 9671.5 - HOUR, grass: MEADOW, leaves: Vec3::ONE, snow: 0.0 },
    Season { midnight: 9757.5 - HOUR, grass: vec3(0.16, 0.14, 0.045), leaves: vec3(2.2, 0.8, 0.3), snow: 0.0 },
    Season { midnight: 9851.5 - HOUR, grass: vec3(0.7, 0.72, 0.78), leaves: vec3(0.6, 0.35, 0.7), snow: 1.0 },
    Season { midnight: 9929.5 - HOUR, grass: vec3(0.12, 0.15, 0.03), leaves: vec3(1.0, 1.1, 0.8), snow: 0.15 },
];

/// A day's 24th part.
const HOUR: f64 = 1.0 / 24.0;

/// What day it is at `time` seconds, and how many of its hours have passed.
pub fn clock(time: f64) -> (usize, f64) {
    let day = (time / LENGTH).floor();
    (day as usize % SEASONS.len(), 4.0 + (time - day * LENGTH) * (24.0 / LENGTH))
}

/// Eye, target, vertical field of view in degrees, by the hour.
const CAMERA: &[Key<7>] = &[
    (4.0, [-36.0, 13.5, 14.0, 0.0, 18.5, -2.0, 54.0]),
    (8.0, [-24.0, 17.0, -34.0, 0.0, 17.0, 0.0, 54.0]),
    (12.0, [0.0, 19.0, -47.0, 0.0, 16.0, 0.0, 54.0]),
    (14.0, [38.0, 19.0, -28.0, 0.0, 16.5, 0.0, 54.0]),
    (18.0, [33.0, 13.5, 39.0, 0.0, 18.0, -4.0, 54.0]),
    (21.999, [24.0, 14.0, 44.0, -3.0, 19.0, 0.0, 54.0]),
    // To the south, where the moon stands over the lake.
    (22.0, [-4.0, 15.5, -46.0, -6.0, 19.5, 0.0, 54.0]),
    (28.0, [14.0, 16.5, -45.0, -4.0, 20.0, 0.0, 54.0]),
];

/// The bodies that never move: the land, the lake, the woods, the chapel; then the aeroplane and its propeller.
pub(super) fn bodies() -> &'static (Vec<Body>, [Arc<Mesh>; 2]) {
    static BODIES: OnceLock<(Vec<Body>, [Arc<Mesh>; 2])> = OnceLock::new();
    BODIES.get_or_init(|| {
        let mut meshes = land::ground();
        meshes.extend(tree::woods(&tree::trees()));
        meshes.push(chapel::chapel());
        meshes.push(land::lake());
        let still = meshes.into_iter().map(|mesh| Body::new(Arc::new(mesh), Affine3A::IDENTITY)).collect();
        (still, [mustang::airframe(), mustang::propeller()].map(Arc::new))
    })
}

/// The textures of a season.
pub(super) fn textures(season: &Season) -> Vec<Texture> {
    let mut textures = models::TEXTURES.to_vec();
    for (index, scale) in [(0, season.grass / MEADOW), (6, season.leaves)] {
        if let Palette::Mix(a, b) = &mut textures[index].palette {
            let calm = 0.7 * season.snow;
            (*a, *b) = (a.lerp(Vec3::ONE, calm) * scale, b.lerp(Vec3::ONE, calm) * scale);
        }
    }
    if let Palette::Ramp(colors) = &mut textures[1].palette {
        colors[0] = season.grass;
        for color in &mut colors[1..3] {
            *color = color.lerp(Vec3::splat(0.6), 0.5 * season.snow);
        }
    }
    textures
}

fn picture(shot: &Shot) -> Picture {
    let (day, hour) = clock(shot.time);
    let season = &SEASONS[day];
    let [x, y, z, tx, ty, tz, fov] = timeline::sample(CAMERA, hour);
    let camera = Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0);
    let camera = shot.camera(camera);
    let dome = Dome::new(Sky::new(season.midnight + hour * HOUR, &Place::PLZEN), DomeQuality::new(&shot.quality));
    let now = dome.lighting();
    let (still, aeroplane) = bodies();
    let mut bodies = still.clone();
    // Over the hill in some seconds, again and again.
    let flights = shot.time / 15.0;
    let way = (flights - flights.floor() - 0.5) as f32 * 900.0;
    let turn = Mat3::from_rotation_y(-1.0) * Mat3::from_rotation_z(0.25);
    let place = turn * vec3(0.0, 0.0, -way) + vec3(-4.0, 38.0, -20.0);
    // Turns a second, five.
    let turns = 5.0 * shot.time;
    let spin = turn * Mat3::from_rotation_z((turns - turns.floor()) as f32 * TAU);
    for (mesh, turn, at) in [(&aeroplane[0], turn, Vec3::ZERO), (&aeroplane[1], spin, turn * mustang::HUB)] {
        bodies.push(Body::new(mesh.clone(), Affine3A::from_mat3_translation(turn, place + at)));
    }
    let aspect = shot.width as u32 as f32 / shot.height as u32 as f32;
    let size = if shot.quality.shadow_map == 0 { 1024 } else { shot.quality.shadow_map };
    let plan = Plan {
        views: fit::cascades(&camera, aspect, now.direction, &[40.0, 160.0, 900.0, 6000.0], size),
        // The curve of docs/report/shadows.md has its knee here.
        bias: Bias { constant: 0.02, slope: 3.0, normal: 0.5 },
        back_faces: false,
        traced: shot.quality.shadow_map == 0,
        smooth: true,
    };
    let mut lights = vec![Light { source: Source::Sun(now.direction), color: now.color, shadow: Some(plan) }];
    // Somebody lights a lamp when it gets dark.
    let dark = ease(-0.02, 0.1, -dome.sky.sun.y as f64);
    if dark > 0.0 {
        let position = vec3(0.0, 14.5, 1.0);
        let plan = Plan {
            views: fit::cube(position, 512),
            bias: Bias { constant: 0.02, slope: 2.0, normal: 0.0 },
            back_faces: false,
            traced: false,
            smooth: true,
        };
        let source = Source::Lamp { position, falloff: Vec2::new(0.05, 0.06), reach: 30.0 };
        lights.push(Light { source, color: vec3(3.2, 1.5, 0.5) * dark, shadow: Some(plan) });
    }
    let towards = vec3(now.direction.x, 0.05, now.direction.z).normalize();
    let [glow, haze] = [towards, vec3(-towards.x, towards.y, -towards.z)].map(|d| dome.radiance(d));
    let image = now.color * ease(0.0, 0.04, now.direction.y as f64) * 3.0;
    let world = World {
        bodies,
        textures: textures(season),
        lights,
        ambient: [(now.sky + now.ground) * 0.5, (now.sky - now.ground) * 0.5],
        haze: Haze { color: haze, density: 1.0 / 9000.0, glow: (towards, (glow - haze).max(Vec3::ZERO)), image },
        zenith: dome.radiance(Vec3::Y),
        film: true,
        background: None,
    };
    let view = View::new(camera, shot.width, shot.height);
    let drawn = Drawn::new(world, view, shot.width, shot.height, shot.quality);
    let look = Look { behind: true, shimmer: shot.time, ..Look::default() };
    let backdrop = Backdrop::new(dome, camera, shot.width, shot.height, look);
    Picture { layers: vec![Box::new(drawn), Box::new(backdrop)], transfer: Transfer::Srgb }
}
