//! The light of the sky at a time and place, as an eye sees it that has adapted to it.
//!
//! The exposure is a power of the light of four directions, so it changes as smoothly as that light does. A shoulder
//! instead of a clamp turns what dazzles white. Nights are lighter than true ones, as one remembers them.

use super::air::{self, Air, DistantLight, scattered};
use super::moon::Moon;
use super::place::{Place, refracted};
use super::sun;
use crate::settings::SkySettings;
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::level;
use crate::simd::math::exp3;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::{Mat3A, Vec3A, vec3a};

/// Light of a full moon over that of the sun: sixteen times what it is in nature.
const MOONLIGHT: f32 = 4e-5;
/// Light of the night itself over that of the sun, into which the dusk fades: a hundred times the airglow.
const NIGHT: Vec3A = vec3a(1.5e-7, 2.2e-7, 4.5e-7);
/// The exposure for a sky of a level `l` is `KEY / l^(ADAPTION / 256)`, so what is shown falls as `l^((256 - ADAPTION)
/// / 256)`.
const KEY: f32 = 0.95;
const ADAPTION: u32 = 189;

/// What stands in the sky at a time and place, and the air before it.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// Unit vector towards where the sun is seen, which refraction lifts.
    pub sun: Vec3A,
    /// Unit vector towards where the moon is seen, which refraction lifts.
    pub moon: Vec3A,
    /// Unit vector from the moon to the sun.
    pub moon_to_sun: Vec3A,
    /// Share of the moon's disc that is lit, 0 to 1.
    pub lit: f32,
    /// Radius of the moon's disc, radians.
    pub moon_radius: f32,
    /// The rotation from equatorial axes to the world's. Its z axis is the celestial pole.
    pub turn: Mat3A,
    /// The air.
    pub air: Air,
}

impl Sky {
    /// The sky at a time, days since J2000, and a place, with the season's air. Times and angles that are not finite
    /// count as 0.
    pub fn new(days: f64, place: &Place) -> Sky {
        let moon = Moon::new(days, place);
        let turn = place.turn(days);
        Sky {
            sun: refracted(sun::direction(days, place)).as_vec3a(),
            moon: refracted(moon.direction).as_vec3a(),
            moon_to_sun: moon.to_sun.as_vec3a(),
            lit: moon.lit as f32,
            moon_radius: moon.radius as f32,
            turn: turn.as_mat3().into(),
            air: Air::of_season(days, place),
        }
    }
}

/// The light of the sky at an instant, and how large and bright an eye sees what stands in it.
#[derive(Clone, Copy, Debug)]
pub struct Dome {
    /// What stands in the sky.
    pub sky: Sky,
    /// Light that is shown, before the shoulder, per light of the sky.
    pub exposure: f32,
    /// Luminance of the sky as a whole, over the sun's outside of the air: 0.1 by day, 1e-8 at night.
    pub level: f32,
    /// The sun's diameter over its true one.
    pub(super) sun_size: f32,
    /// The moon's diameter over its true one.
    pub(super) moon_size: f32,
    /// The time that stars twinkle by, seconds.
    pub(super) shimmer: f64,
    /// Points along a direction at which scattered light is summed.
    steps: u32,
    /// Light from all around that is scattered again.
    again: Vec3A,
    /// Sun and moon; of strength 0 where they do not count.
    pub(super) lights: [DistantLight; 2],
}

impl Dome {
    /// The dome of a sky. The exposure follows from the light of a few directions.
    ///
    /// Sun and moon are drawn at twice their true diameters, as large as they seem, and stars stand still.
    pub fn new(sky: Sky, settings: &SkySettings) -> Dome {
        // The moon is left out by day, where it gives 1e-5 of the light, and each of the two when it is far down.
        let counts = [sky.sun.y >= -0.36, sky.sun.y < 0.05 && sky.moon.y > -0.2];
        let mut lights = [(sky.sun, 1.0), (sky.moon, MOONLIGHT * sky.lit * sky.lit * sky.lit)]
            .map(|(direction, strength)| DistantLight { direction, strength });
        for (light, counts) in lights.iter_mut().zip(counts) {
            if !counts {
                light.strength = 0.0;
            }
        }
        let mut dome = Dome {
            sky,
            exposure: 0.0,
            level: 0.0,
            sun_size: 2.0,
            moon_size: 2.0,
            shimmer: 0.0,
            steps: settings.built().steps,
            again: Vec3A::ZERO,
            lights,
        };
        let level = vec3a(sky.sun.x, 0.0, sky.sun.z).normalize_or(Vec3A::X);
        let mut mean = Vec3A::ZERO;
        for (side, up) in [(0.0, 1.0), (0.9, 0.44), (-0.9, 0.44), (0.995, 0.1)] {
            mean += dome.light(level * side + Vec3A::Y * up) * 0.25;
        }
        // More of blue, which is scattered most often.
        dome.again = mean * vec3a(0.5, 1.0, 2.5) * sky.air.again;
        dome.level = mean.dot(vec3a(0.21, 0.72, 0.07));
        let level = dome.level.max(1e-9);
        // The eye adapts to moonlight less, or no night would be lighter than another.
        let moon = lights[1].strength * sky.moon.y.max(0.0) * 0.02 / level;
        dome.exposure = KEY / power(level, ADAPTION) * (1.0 + moon.min(1.0));
        dome
    }

    /// The same dome with sun and moon drawn at these multiples of their true diameters.
    #[inline(always)] // A call would copy the dome once more.
    pub fn with_sizes(self, sun: f32, moon: f32) -> Dome {
        Dome { sun_size: sun, moon_size: moon, ..self }
    }

    /// The same dome with stars that twinkle, as they do at a time in seconds. It is the film's time: the sky's own may
    /// run faster.
    #[inline(always)] // A call would copy the dome once more.
    pub fn with_shimmer(self, seconds: f64) -> Dome {
        Dome { shimmer: seconds, ..self }
    }

    /// A quantity of one direction, a unit vector.
    #[inline(never)] // One instance of the kernel for all that ask about single directions.
    fn ask(&self, d: Vec3A, quantity: Quantity) -> Vec3A {
        dispatch!(level::best(), simd => evaluate(simd, self, V3::splat(simd, d), quantity).first())
    }

    /// The light of the sky from a unit direction, over the sun's outside of the air.
    pub fn light(&self, d: Vec3A) -> Vec3A {
        self.ask(d, Quantity::Light)
    }

    /// The light of the sky from a unit direction as it is shown, linear light of 0 to 1: for fog, and for what mirrors
    /// the sky.
    pub fn radiance(&self, d: Vec3A) -> Vec3A {
        self.ask(d, Quantity::Shown)
    }

    /// The share of light from outside of the air, out of a unit direction, that the air lets through, by colour.
    pub fn through(&self, d: Vec3A) -> Vec3A {
        self.ask(d, Quantity::Through)
    }
}

/// What can be asked about a direction.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    /// The sky's light.
    Light,
    /// The sky's light as it is shown.
    Shown,
    /// The share of light that the air lets through.
    Through,
}

/// A quantity of unit directions.
#[simd]
pub(super) fn evaluate<S: Simd>(simd: S, dome: &Dome, d: V3<S>, quantity: Quantity) -> V3<S> {
    if quantity == Quantity::Through {
        return air::through(simd, &dome.sky.air, d);
    }
    let light = scattered(simd, &dome.sky.air, &dome.lights, dome.again, dome.steps, d);
    // Airglow is a thin shell, so there is more of it towards the horizon.
    let low = F::<S>::splat(simd, 1.0) - d.y.abs();
    let light = light + V3::splat(simd, NIGHT) * Lane(low * low + 1.0);
    if quantity == Quantity::Light {
        return light;
    }
    // A shoulder instead of a clamp: what is brighter than the screen turns white, not yellow and cyan.
    V3::splat(simd, Vec3A::ONE) - exp3(simd, light, -dome.exposure)
}

/// `x^(n / 256)` for `n` below 256, by roots: without the standard library's tables.
#[inline(never)] // Called in a few places, never in a hot loop.
pub(super) fn power(x: f32, n: u32) -> f32 {
    let (mut root, mut product, mut bit) = (x, 1.0, 128);
    while bit > 0 {
        root = root.sqrt();
        if n & bit != 0 {
            product *= root;
        }
        bit /= 2;
    }
    product
}
