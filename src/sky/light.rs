//! What lights the ground: the sun or the moon, and the sky.
//!
//! A renderer has one directional light. So it is the brighter of sun and moon, and it fades out and in where they take
//! turns.

use super::dome::Dome;
use glam::{Vec3A, vec3a};
use std::f32::consts::FRAC_1_PI;

/// The light of an instant as an eye sees it that has adapted to it: linear, and more than 1 where it dazzles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// Unit vector towards the sun or the moon, whichever gives more light.
    pub direction: Vec3A,
    /// What a white matt surface that faces it reflects. It falls to nothing where sun and moon give the same, so that
    /// no shadow jumps.
    pub color: Vec3A,
    /// What a white matt surface that lies under the open sky reflects of it, without sun and moon.
    pub sky: Vec3A,
    /// What a white matt surface that faces the ground reflects of it. The ground's albedo is 0.2.
    pub ground: Vec3A,
}

/// The luminance of a linear colour.
fn luminance(c: Vec3A) -> f32 {
    c.dot(vec3a(0.21, 0.72, 0.07))
}

impl Dome {
    /// What lights the ground.
    pub fn lighting(&self) -> Lighting {
        let sky = &self.sky;
        let scale = self.exposure * FRAC_1_PI;
        let [sun, moon] = self.lights.map(|light| self.through(light.direction) * (scale * light.strength));
        let (a, b) = (luminance(sun), luminance(moon));
        let (direction, color) = if a >= b { (sky.sun, sun) } else { (sky.moon, moon) };
        let color = color * ((a - b).abs() / a.max(b).max(1e-9));
        // A third of the sky's light from the zenith, the rest from lower down, where there is more of the sky.
        let level = vec3a(sky.sun.x, 0.0, sky.sun.z).normalize_or(Vec3A::X) * 0.87 + Vec3A::Y * 0.5;
        let away = vec3a(-level.x, level.y, -level.z);
        let around = (self.light(Vec3A::Y) + self.light(level) + self.light(away)) * (self.exposure / 3.0);
        Lighting { direction, color, sky: around, ground: (around + color * direction.y.max(0.0)) * 0.2 }
    }
}
