//! The second part of the intro: days on a hill by a lake, from dawn to the stars, through the year.

use super::models::{self, chapel, land, mustang, tree};
use super::{Scene, Shot};
use crate::camera::Camera;
use crate::color::Transfer;
use crate::raster::fit;
use crate::raster::light::{Haze, Light, Source};
use crate::raster::shadow::{Bias, Plan};
use crate::raster::{Body, World};
use crate::tile::Picture;
use crate::timeline::{self, Key};
use glam::{Affine3A, Mat3, Vec2, Vec3, vec3};
use std::sync::{Arc, OnceLock};

/// The part.
pub const DAY: Scene =
    Scene { name: "day", about: "a hill by a lake: four days, one of each season", duration: 4.0 * LENGTH, picture };

/// Seconds that a day takes.
pub const LENGTH: f64 = 60.0;

/// The bodies that never move: the land, the lake, the woods, the chapel.
fn still() -> &'static [Body] {
    static STILL: OnceLock<Vec<Body>> = OnceLock::new();
    STILL.get_or_init(|| {
        let mut meshes = land::ground();
        meshes.extend(tree::woods(&tree::trees()));
        meshes.push(chapel::chapel());
        meshes.push(land::lake());
        meshes.into_iter().map(|mesh| Body::new(Arc::new(mesh), Affine3A::IDENTITY)).collect()
    })
}

const CAMERA: &[Key<7>] = &[
    (0.0, [-34.0, 13.0, 16.0, 0.0, 16.0, -2.0, 50.0]),
    (30.0, [30.0, 16.0, 40.0, 0.0, 14.0, -2.0, 50.0]),
    (60.0, [-34.0, 13.0, 16.0, 0.0, 16.0, -2.0, 50.0]),
];

fn picture(shot: &Shot) -> Picture {
    let day = (shot.time / LENGTH).floor();
    let time = shot.time - day * LENGTH;
    let hour = 4.0 + time * (24.0 / LENGTH);
    let [x, y, z, tx, ty, tz, fov] = timeline::sample(CAMERA, time);
    let camera = Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0);
    let camera = shot.camera(camera);
    let a = ((hour - 12.0) * 15.0f64).to_radians() as f32;
    let towards = vec3(-a.sin(), (a.cos() * 0.85 + 0.25).max(0.02), a.cos() * 0.5).normalize();
    let plan = Plan {
        views: fit::cascades(
            &camera,
            shot.width as f32 / shot.height as f32,
            towards,
            &[40.0, 160.0, 900.0, 6000.0],
            shot.quality.shadow_map.max(1024),
        ),
        bias: Bias { constant: 0.02, slope: 1.0, normal: 1.0 },
        back_faces: false,
        traced: shot.quality.shadow_map == 0,
        smooth: true,
    };
    let sun = Light { source: Source::Sun(towards), color: vec3(3.0, 2.7, 2.2), shadow: Some(plan) };
    let mut bodies = still().to_vec();
    static PLANE: OnceLock<Arc<crate::raster::mesh::Mesh>> = OnceLock::new();
    let plane = PLANE.get_or_init(|| Arc::new(mustang::airframe()));
    bodies.push(Body::new(
        plane.clone(),
        Affine3A::from_mat3_translation(Mat3::from_rotation_y(0.6), vec3(-6.0, 26.0, -6.0)),
    ));
    let sky = vec3(0.5, 0.62, 0.8);
    let world = World {
        bodies,
        textures: models::TEXTURES.to_vec(),
        lights: vec![sun],
        ambient: [vec3(0.35, 0.42, 0.55), vec3(0.15, 0.2, 0.3)],
        haze: Haze { color: sky, density: 1.0 / 9000.0, glow: (towards, vec3(0.4, 0.3, 0.2)) },
        zenith: vec3(0.1, 0.22, 0.55),
        background: Some(sky),
    };
    let _ = (Vec2::ZERO, Vec3::ZERO);
    shot.drawn(world, camera, Transfer::Srgb)
}
