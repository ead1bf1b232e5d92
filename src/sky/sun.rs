//! Where the sun is, and when it rises and sets.
//!
//! `[Meeus98]`, chapter 25, low accuracy: 0.0082 degrees off `[SPA]` at worst in 1900 to 2100.

use super::place::{Place, angles};
use super::time::{centuries, sane, short, turned};
use glam::{DVec3, dvec3};

/// Altitude of the sun's centre when its upper edge is seen on the horizon, radians: -0.833 degrees, 34' of refraction
/// and 16' of radius.
pub const RISE: f64 = (-0.833f64).to_radians();

/// Radius of the sun's disc at its mean distance, radians. Over a year it varies by 1.7 %.
pub const RADIUS: f64 = 0.266_6f64.to_radians();

/// The unit vector on equatorial axes of an ecliptic longitude and latitude of date, degrees.
#[inline(never)] // Called in a few places, never in a hot loop.
pub(super) fn equatorial(longitude: f64, latitude: f64, days: f64) -> DVec3 {
    let (sin, cos) = turned(short(23.4393) - short(0.013) * centuries(days));
    let ((s, c), (z, level)) = (turned(longitude), turned(latitude));
    let y = s * level;
    dvec3(c * level, y * cos - z * sin, y * sin + z * cos)
}

/// The sun's apparent unit direction on equatorial axes, seen from the earth's centre, at a time in days since J2000.
///
/// The pull of the planets is left out: 0.01 degrees. The Astronomical Almanac's shorter series drifts away by 0.02
/// degrees towards 1900 and 2100.
pub fn equator(days: f64) -> DVec3 {
    let t = centuries(days);
    let (s, c) = turned(short(357.529_11) + 35_999.050_29 * t);
    let center = (short(1.914_602) - short(0.004_817) * t) * s + short(0.039_986) * s * c;
    // The first number includes aberration.
    equatorial(short(280.460_77) + t * 36_000.769_83 + center, 0.0, days)
}

/// The sun's true unit direction on world axes, without refraction (see [`super::place::refracted`]), at a time in days
/// since J2000.
///
/// Within 0.01 degrees in 1900 to 2100. Times beyond 10^9 days and NaN count as 0.
pub fn direction(days: f64, place: &Place) -> DVec3 {
    // From the place rather than from the earth's centre, by 1/23,455 of the distance. That is 0.0024 degrees, and ten
    // minutes of a pole's sunrise.
    (place.turn(days) * equator(days) - DVec3::Y / 23_455.0).normalize()
}

/// A passage of the sun through an altitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// When it passes, days since J2000.
    pub time: f64,
    /// Whether it rises.
    pub rising: bool,
}

/// The rises and sets of 24 hours.
///
/// There are none in polar day and polar night. Near the switch between the two there can be three or four, two of them
/// rises.
#[derive(Clone, Debug, PartialEq)]
pub struct Day {
    /// When the 24 hours begin, days since J2000.
    pub start: f64,
    /// Whether the sun is up at their beginning.
    pub starts_up: bool,
    /// The passages in order of time.
    pub crossings: Vec<Crossing>,
}

impl Day {
    /// The passages of the sun's centre through an altitude in the 24 hours from `start`, days since J2000, at a place.
    ///
    /// `altitude` is a true one, without refraction, in radians: such as [`RISE`], or that of civil twilight, -6
    /// degrees. Times are within a minute, and within two and a half where the sun all but stays up or down.
    pub fn new(start: f64, place: &Place, altitude: f64) -> Day {
        let start = sane(start);
        let height = |time: f64| angles(direction(start + time, place)).0 - altitude;
        let mut day = Day { start, starts_up: height(0.0) > 0.0, crossings: Vec::new() };
        const STEP: f64 = 1.0 / 24.0;
        let (mut low, mut last) = (0.0, height(0.0));
        // Where the height turns within a step it may pass the altitude twice. So steps end at its extremes too.
        let mut pass = |from: &mut f64, was: &mut f64, to: f64, is: f64| {
            if (*was > 0.0) != (is > 0.0) {
                let rising = is > 0.0;
                let (mut a, mut b) = (*from, to);
                for _ in 0..40 {
                    let middle = 0.5 * (a + b);
                    if (height(middle) > 0.0) == rising { b = middle } else { a = middle }
                }
                day.crossings.push(Crossing { time: start + b, rising });
            }
            (*from, *was) = (to, is);
        };
        for hour in 1..=24u32 {
            let end = hour as f64 * STEP;
            let (mut a, mut b) = (end - STEP, end);
            // The sign of the slope, by a difference over two seconds.
            let climbs = |time: f64| height(time + 1e-5) > height(time - 1e-5);
            let first = climbs(a);
            if first != climbs(b) {
                for _ in 0..30 {
                    let middle = 0.5 * (a + b);
                    if climbs(middle) == first { a = middle } else { b = middle }
                }
                pass(&mut low, &mut last, a, height(a));
            }
            pass(&mut low, &mut last, end, height(end));
        }
        day
    }

    /// How long the sun is up, as a share of the 24 hours.
    pub fn light(&self) -> f64 {
        let (mut up, mut since, mut sum) = (self.starts_up, self.start, 0.0);
        for crossing in &self.crossings {
            if up {
                sum += crossing.time - since;
            }
            (up, since) = (crossing.rising, crossing.time);
        }
        sum + if up { self.start + 1.0 - since } else { 0.0 }
    }

    /// Whether the sun is up all day.
    pub fn is_polar_day(&self) -> bool {
        self.crossings.is_empty() && self.starts_up
    }

    /// Whether the sun is never up.
    pub fn is_polar_night(&self) -> bool {
        self.crossings.is_empty() && !self.starts_up
    }
}
