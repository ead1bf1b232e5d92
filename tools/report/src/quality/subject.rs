//! What is drawn: scenes at a few instants, and the sky alone at a few heights of the sun.

use super::sweep::{Group, Point};
use crate::dome;
use glam::{Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Picture, Renderer, Scene};
use paprsek::scenes;
use paprsek::sky::dome::Dome;
use paprsek::sky::layer::SkyLayer;
use paprsek::view::{Camera, View};

/// Something to draw.
pub struct Subject {
    /// Its name in tables and curves.
    pub name: &'static str,
    /// The sweeps that it takes part in.
    pub groups: &'static [Group],
    /// The scene; none is the sky alone.
    scene: Option<Scene>,
    /// Instants, seconds; for the sky alone, heights of the sun above the horizon, degrees.
    times: [f64; 3],
}

/// Instants, as shares of a scene's length.
pub const SHARES: [f64; 3] = [0.1, 0.4, 0.7];

/// Hours of the first day of `day`, in summer: the sun is 6 to 8 degrees high, and 55 to 64.
const LOW: [f64; 3] = [4.9, 19.4, 5.0];
const HIGH: [f64; 3] = [12.0, 10.5, 13.5];

/// Everything that is drawn.
pub fn all() -> Vec<Subject> {
    let scene = |name: &str| scenes::named(name).expect("a scene of the list");
    let shares = |name: &'static str, groups| {
        let scene = scene(name);
        Subject { name, groups, scene: Some(scene), times: SHARES.map(|share| share * scene.duration) }
    };
    // The day of the scene begins at four o'clock.
    let seconds = |hours: [f64; 3]| hours.map(|hour| (hour - 4.0) * scenes::show::day::LENGTH / 24.0);
    let day =
        |name, hours| Subject { name, groups: &[Group::Shadows], scene: Some(scene("day")), times: seconds(hours) };
    let sky = |name, times| Subject { name, groups: &[Group::Sky], scene: None, times };
    vec![
        shares("spheres", &[Group::Tracer]),
        shares("spheres-glass", &[Group::Tracer]),
        shares("lumen", &[Group::Tracer]),
        shares("shadow", &[Group::Raster]),
        shares("day", &[Group::Raster]),
        day("day, low sun", LOW),
        day("day, high sun", HIGH),
        shares("cumulus", &[Group::CloudLayer]),
        shares("sky-of-clouds", &[Group::CloudLayer]),
        shares("clouds", &[Group::CloudLayer]),
        shares("torches", &[Group::Fires]),
        sky("sky by day", [30.0, 10.0, 60.0]),
        sky("sky at sunset", [0.0, 2.0, -1.0]),
        sky("sky at dusk", [-6.0, -4.0, -9.0]),
    ]
}

impl Subject {
    /// Whether it has that name, or is of that scene.
    pub fn answers_to(&self, name: &str) -> bool {
        self.name == name
            || self.scene.is_some_and(|scene| scene.name == name)
            || (self.scene.is_none() && name == "dome")
    }

    /// The picture at an instant, ready to be drawn.
    pub fn picture(
        &self,
        instant: usize,
        point: &Point,
        (width, height): (usize, usize),
        renderer: &Renderer,
    ) -> Picture {
        let (time, quality) = (self.times[instant], point.quality);
        if let Some(scene) = self.scene {
            return (scene.picture)(&renderer.spec(time, &quality, (width, height)));
        }
        let settings = point.dome.unwrap_or(quality.sky);
        let camera = Camera::look_at(Vec3A::ZERO, vec3a(0.0, 0.35, -1.0), 50f32.to_radians(), 0.0);
        let layer = SkyLayer::new(
            Dome::new(dome::sky(time as f32, dome::HAZE), &settings),
            &View::new(camera, width, height),
            &settings,
        );
        Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }
    }
}
