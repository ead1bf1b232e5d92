//! The light that matters now, for what stands below the sky.

use super::dome::Dome;
use glam::{Vec3, vec3};
use std::f32::consts::FRAC_1_PI;

/// The light of an instant, as the eye sees it that has got used to it: linear, and more than 1 where it dazzles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// Unit vector towards the sun or the moon, whichever gives more.
    pub direction: Vec3,
    /// What a white matt surface sends that faces it. Falls to nothing where the two give the same, so no shadow jumps.
    pub color: Vec3,
    /// What a white matt surface sends that lies under the open sky, without sun and moon.
    pub sky: Vec3,
    /// The same of a surface that faces the ground, of an albedo of 0.2.
    pub ground: Vec3,
}

/// How bright a colour is.
fn luminance(c: Vec3) -> f32 {
    c.dot(vec3(0.21, 0.72, 0.07))
}

impl Dome {
    /// The light of sun or moon, and of the sky.
    pub fn lighting(&self) -> Lighting {
        let sky = &self.sky;
        let scale = self.exposure * FRAC_1_PI;
        let [sun, moon] = self.lamps.map(|lamp| self.through(lamp.direction) * (scale * lamp.strength));
        let (a, b) = (luminance(sun), luminance(moon));
        let (direction, color) = if a >= b { (sky.sun, sun) } else { (sky.moon, moon) };
        let color = color * ((a - b).abs() / a.max(b).max(1e-9));
        // A third from the zenith, the rest from where the sky is wide.
        let level = vec3(sky.sun.x, 0.0, sky.sun.z).normalize_or(Vec3::X) * 0.87 + Vec3::Y * 0.5;
        let away = vec3(-level.x, level.y, -level.z);
        let around = (self.light(Vec3::Y) + self.light(level) + self.light(away)) * (self.exposure / 3.0);
        Lighting { direction, color, sky: around, ground: (around + color * direction.y.max(0.0)) * 0.2 }
    }
}
