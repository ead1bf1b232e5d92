//! The bench scenes `snow` and `fire`, as specified for every renderer that is compared.

use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Scene};
use crate::frame::{Layer, Picture, Stats, Tile};
use crate::particles::{Fire, Flakes, Flame, Lens, ParticleLayer, Snow};
use crate::settings::Quality;
use crate::view::Camera;
use crate::view::View;
use fearless_simd::Level;
use glam::{DVec3, Vec3, dvec3, vec3};

/// Flakes of which 200,000 may be seen.
pub const SNOW: Scene =
    Scene { name: "snow", about: "bench: 200,000 flakes of snow", duration: 20.0, parameters: &[], picture: snow };
/// Five torches of 2,000 sprites.
pub const FIRE: Scene = Scene {
    name: "fire",
    about: "bench: five torches of 2,000 sprites",
    duration: 20.0,
    parameters: &[],
    picture: fire,
};

/// The flakes, as specified.
pub const FLAKES: Flakes = Flakes {
    seed: 3,
    count: 254_648,
    extent: vec3(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 0.85,
    fall: [0.9, 0.7],
    sway: [0.15, 0.25],
    pace: [0.8, 0.8],
    radius: [0.008, 0.010],
    by: 7,
    lens: Lens { radius: [1.0, 24.0], near: [0.25, 1.0], ..Lens::SHARP },
};

/// The torches' flames, as specified.
pub const FLAME: Flame = Flame {
    life: [0.8, 0.7],
    ring: [0.0, 0.14],
    narrows: 0.0,
    leans: 0.0,
    cone: 0.35,
    speed: [0.9, 0.7],
    slows: 0.25,
    lift: 0.55,
    radius: [0.15, 0.035],
    light: [vec3(1.0 * 0.008, 0.62 * 0.008, 0.20 * 0.008), vec3(0.80 * 0.008, 0.10 * 0.008, 0.02 * 0.008)],
};

/// Flakes of a field at `time` seconds around an eye that walks as specified, moved by `beside` metres.
pub fn flakes(flakes: &Flakes, time: f64, beside: Vec3) -> Snow {
    let eye = dvec3(1.5 * time, 1.7, -2.0 * time) + beside.as_dvec3();
    Snow::new(flakes, time, eye, dvec3(0.8 * time, 0.0, 0.35 * time), 1.0)
}

fn snow(spec: &FrameSpec) -> Picture {
    over(spec, SNOW_SKY, snowfall(spec, &FLAKES))
}

/// Flakes of a field before the camera that the scene specifies.
pub fn snowfall(spec: &FrameSpec, of: &Flakes) -> ParticleLayer {
    let t = spec.time;
    let way = dvec3((0.3 * t).sin(), 0.08 * (0.5 * t).sin(), (0.3 * t).cos());
    // The eye is the origin, since far from it there are no fractions of metres.
    let camera = spec.camera(Camera::look_at(Vec3::ZERO, way.as_vec3(), 50f32.to_radians(), 0.0));
    let view = View::new(camera, spec.width, spec.height);
    ParticleLayer::new([flakes(of, t, camera.eye)], &view, &spec.quality.particles).colored(vec3(0.95, 0.97, 1.0))
}

/// The torches at `time` seconds, as specified.
pub fn fires(time: f64) -> Vec<Fire> {
    let torch = |j: u32| {
        let angle = 1.25663706 * j as f64;
        Fire {
            flame: FLAME,
            place: dvec3(3.0 * angle.cos(), 1.2, 3.0 * angle.sin()).as_vec3(),
            scale: 1.0,
            time,
            seed: 4,
            first: 2000 * j,
            count: 2000.0,
            weight: 1.0,
            lens: Lens::SHARP,
        }
    };
    (0..5).map(torch).collect()
}

fn fire(spec: &FrameSpec) -> Picture {
    let a = 0.3 * spec.time;
    let eye = dvec3(7.0 * a.sin(), 2.2, 7.0 * a.cos());
    let way = DVec3::Y * 1.8 - eye;
    let camera = spec.camera(Camera::look_at(eye.as_vec3(), (eye + way).as_vec3(), 50f32.to_radians(), 0.0));
    let view = View::new(camera, spec.width, spec.height);
    // All particles that are specified, whatever the quality.
    let particles = ParticleLayer::new(fires(spec.time), &view, &Quality::EXACT.particles);
    over(spec, FIRE_SKY, particles)
}

/// What is behind the flakes, at the bottom and at the top.
pub const SNOW_SKY: [Vec3; 2] = [vec3(0.58, 0.63, 0.70), vec3(0.16, 0.20, 0.30)];
/// What is behind the torches.
pub const FIRE_SKY: [Vec3; 2] = [vec3(0.05, 0.05, 0.07), vec3(0.01, 0.015, 0.05)];

/// Particles over what is there at the bottom and at the top.
pub fn over(spec: &FrameSpec, [bottom, top]: [Vec3; 2], particles: ParticleLayer) -> Picture {
    let behind = Gradient { bottom, top, height: spec.height as u32 as f32 };
    let layers: Vec<Box<dyn Layer>> = vec![Box::new(behind), Box::new(particles.without_solids())];
    Picture { layers, transfer: Transfer::Linear }
}

/// Light that changes from row to row.
struct Gradient {
    bottom: Vec3,
    top: Vec3,
    /// Rows.
    height: f32,
}

impl Layer for Gradient {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for row in 0..tile.height {
            let up = (self.height - 0.5 - (tile.y + row) as u32 as f32) / self.height;
            let light = self.bottom + (self.top - self.bottom) * up;
            for (plane, light) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().zip(light.to_array()) {
                plane[row * Tile::SIZE..][..tile.width].fill(light);
            }
        }
        Stats::default()
    }
}
