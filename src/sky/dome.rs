//! The sky at a time and place, as an eye sees it that has got used to the light.

use super::air::{self, Air, Lamp, exp3, scattered};
use super::moon::Moon;
use super::place::{Place, refracted};
use super::sun;
use super::time::{sane, turned};
use crate::settings::SkySettings;
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::level;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::{Mat3, Vec3, vec3};

/// The moon's full light over the sun's: sixteen times the truth, and
const MOONLIGHT: f32 = 4e-5;
/// light of the night itself, a hundred times its airglow, as one remembers nights; the dusk fades into it.
const NIGHT: Vec3 = vec3(1.5e-7, 2.2e-7, 4.5e-7);
/// Light shown of a scene of light 1, and how little the eye lets it fall as that falls: `l^(1 - ADAPTION / 256)`.
const KEY: f32 = 0.95;
const ADAPTION: u32 = 189;

/// What stands in the sky at a time and place.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// Unit vector towards the sun, as air shows it.
    pub sun: Vec3,
    /// Unit vector towards the moon, as air shows it.
    pub moon: Vec3,
    /// Unit vector from the moon to the sun.
    pub moon_to_sun: Vec3,
    /// Share of the moon's disc that is lit, 0 to 1.
    pub lit: f32,
    /// Radius of the moon's disc, radians.
    pub moon_radius: f32,
    /// From equatorial axes to the world's: its z axis is the celestial pole.
    pub turn: Mat3,
    /// The air.
    pub air: Air,
}

impl Sky {
    /// The sky at a time, days since J2000, and a place, with the season's air.
    pub fn new(days: f64, place: &Place) -> Sky {
        let moon = Moon::new(days, place);
        let turn = place.turn(days);
        Sky {
            sun: refracted(sun::direction(days, place)).as_vec3(),
            moon: refracted(moon.direction).as_vec3(),
            moon_to_sun: moon.to_sun.as_vec3(),
            lit: moon.lit as f32,
            moon_radius: moon.radius as f32,
            turn: turn.as_mat3(),
            air: Air::of_season(days, place),
        }
    }
}

impl Air {
    /// The air of a time of year: hazy and thin in ozone in late summer, clear in late winter.
    pub fn of_season(days: f64, place: &Place) -> Air {
        // Day 205 of a year is 24 July, when it is warmest north of the equator.
        let summer = turned((sane(days) - 205.0) * (360.0 / 365.25)).1;
        let warmth = (summer * turned(sane(place.latitude).to_degrees()).0) as f32;
        Air { haze: 1.3 + 0.7 * warmth, ozone: 1.15 - 0.15 * warmth, again: 0.7 }
    }
}

/// The light of the sky at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Dome {
    /// What stands in it.
    pub sky: Sky,
    /// Speed against error.
    pub quality: SkySettings,
    /// Light shown of light 1, before the shoulder.
    pub exposure: f32,
    /// Light of the sky as a whole, over the sun's outside of the air: 0.1 by day, 1e-8 at night.
    pub level: f32,
    /// Light from all around that is scattered again.
    again: Vec3,
    /// Sun and moon; of strength 0 where they do not count.
    pub(super) lamps: [Lamp; 2],
}

impl Dome {
    /// The dome of a sky; its exposure follows from the light in a few directions.
    pub fn new(sky: Sky, quality: SkySettings) -> Dome {
        // The moon is left out by day, where it gives 1e-5 of the light, and each when far down.
        let counts = [sky.sun.y >= -0.36, sky.sun.y < 0.05 && sky.moon.y > -0.2];
        let mut lamps = [(sky.sun, 1.0), (sky.moon, MOONLIGHT * sky.lit * sky.lit * sky.lit)]
            .map(|(direction, strength)| Lamp { direction, strength });
        for (lamp, counts) in lamps.iter_mut().zip(counts) {
            if !counts {
                lamp.strength = 0.0;
            }
        }
        let mut dome = Dome { sky, quality, exposure: 0.0, level: 0.0, again: Vec3::ZERO, lamps };
        let level = vec3(sky.sun.x, 0.0, sky.sun.z).normalize_or(Vec3::X);
        let mut mean = Vec3::ZERO;
        for (side, up) in [(0.0, 1.0), (0.9, 0.44), (-0.9, 0.44), (0.995, 0.1)] {
            mean += dome.light(level * side + Vec3::Y * up) * 0.25;
        }
        // More for blue, which is scattered most often.
        dome.again = mean * vec3(0.5, 1.0, 2.5) * sky.air.again;
        dome.level = mean.dot(vec3(0.21, 0.72, 0.07));
        let level = dome.level.max(1e-9);
        // The eye gets used to moonlight less, or no night would be lighter than another.
        let moon = lamps[1].strength * sky.moon.y.max(0.0) * 0.02 / level;
        dome.exposure = KEY / power(level, ADAPTION) * (1.0 + moon.min(1.0));
        dome
    }

    /// One answer of the kernels for a unit direction.
    #[inline(never)]
    fn ask(&self, d: Vec3, what: What) -> Vec3 {
        dispatch!(level::best(), simd => answer(simd, self, V3::splat(simd, d), what).first())
    }

    /// The light of the sky itself from a unit direction, over the sun's outside of the air.
    pub fn light(&self, d: Vec3) -> Vec3 {
        self.ask(d, What::Light)
    }

    /// The linear display light of the sky from a unit direction, 0 to 1: for fog, and for what mirrors the sky.
    pub fn radiance(&self, d: Vec3) -> Vec3 {
        self.ask(d, What::Shown)
    }

    /// The share of the light from a unit direction outside that air lets through.
    pub fn through(&self, d: Vec3) -> Vec3 {
        self.ask(d, What::Through)
    }
}

/// What is asked about a direction: the sky's light, that as it is shown, what the air lets through.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum What {
    Light,
    Shown,
    Through,
}

/// One answer for each direction.
#[simd]
pub(super) fn answer<S: Simd>(simd: S, dome: &Dome, d: V3<S>, what: What) -> V3<S> {
    if what == What::Through {
        return air::through(simd, &dome.sky.air, d);
    }
    let light = scattered(simd, &dome.sky.air, &dome.lamps, dome.again, dome.quality.steps, d);
    // Airglow is a thin shell: more of it towards the horizon.
    let low = F::<S>::splat(simd, 1.0) - d.y.abs();
    let light = light + V3::splat(simd, NIGHT) * Lane(low * low + 1.0);
    if what == What::Light {
        return light;
    }
    // A shoulder instead of a clamp: what is brighter than the screen turns white, not yellow and cyan.
    V3::splat(simd, Vec3::ONE) - exp3(simd, light, -dome.exposure)
}

/// `x^(n / 256)`, by roots.
#[inline(never)]
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
