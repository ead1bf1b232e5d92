//! Where the moon is, how far away, and how much of it is lit.
//!
//! The 19 largest terms of `[Meeus98]`, tables 47.A and B: 0.13 degrees off `[Ephem]` at worst in 1900 to 2100.

use super::place::Place;
use super::sun;
use super::time::{centuries, short, turned};
use glam::DVec3;

/// The moon as it is seen from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moon {
    /// True unit direction on world axes, without refraction. Within 0.3 degrees in 1900 to 2100.
    pub direction: DVec3,
    /// Distance from the place, km.
    pub distance: f64,
    /// Radius of the disc, radians.
    pub radius: f64,
    /// Unit vector from the moon to the sun: which side is lit.
    pub to_sun: DVec3,
    /// Share of the disc that is lit, 0 to 1, seen from the earth's centre as almanacs have it. From a place it may be
    /// 0.008 more or less.
    pub lit: f64,
}

/// Radii of the moon and the earth, km.
const RADIUS: f64 = 1737.4;
const EARTH: f64 = 6371.0;
/// The sun's mean distance, km.
const SUN: f64 = short(149_597_870.7);

/// Arguments of the series, degrees at J2000 and degrees per century: the moon's elongation, the sun's anomaly, the
/// moon's anomaly, and its distance from the node. Rounded to about 0.1.
const ARGUMENTS: [(f64, f64); 4] = [(297.875, 445_267.0), (357.5, 35_999.0), (135.0, 477_199.0), (93.25, 483_202.0)];

/// One term of the series: whole multiples of the four arguments, whose sum is its angle; the factor of its sine, in
/// units of 0.05 degrees; and that of its cosine, in units of 165 km.
type Term = [i8; 6];

/// Terms of longitude and distance, and from number [`LATITUDE`] on terms of latitude.
const TERMS: [Term; 19] = [
    [0, 0, 1, 0, 126, -127],
    [2, 0, -1, 0, 25, -22],
    [2, 0, 0, 0, 13, -18],
    [0, 0, 2, 0, 4, -3],
    [0, 1, 0, 0, -4, 0],
    [0, 0, 0, 2, -2, 0],
    [2, 0, -2, 0, 1, 1],
    [2, -1, -1, 0, 1, -1],
    [2, 0, 1, 0, 1, -1],
    [2, -1, 0, 0, 1, -1],
    [0, 1, -1, 0, -1, -1],
    [1, 0, 0, 0, -1, 1],
    [0, 1, 1, 0, -1, 1],
    [0, 0, 0, 1, 103, 0],
    [0, 0, 1, 1, 6, 0],
    [0, 0, 1, -1, 6, 0],
    [2, 0, 0, -1, 3, 0],
    [2, 0, -1, 1, 1, 0],
    [2, 0, -1, -1, 1, 0],
];
const LATITUDE: usize = 13;

impl Moon {
    /// The moon at a time, days since J2000, from a place. Times beyond 10^9 days and NaN count as 0.
    pub fn new(days: f64, place: &Place) -> Moon {
        let t = centuries(days);
        // Longitude and latitude, degrees, and distance, km.
        let mut sums = [short(218.316_4) + 481_267.881_3 * t, 0.0];
        let mut range = short(385_000.6);
        for (n, term) in TERMS.iter().enumerate() {
            let mut angle = 0.0;
            for (k, (start, rate)) in ARGUMENTS.into_iter().enumerate() {
                angle += term[k] as f64 * (start + rate * t);
            }
            let (s, c) = turned(angle);
            sums[(n >= LATITUDE) as usize] += term[4] as f64 * short(0.05) * s;
            range += term[5] as f64 * 165.0 * c;
        }
        let center = sun::equatorial(sums[0], sums[1], days);
        let turn = place.turn(days);
        let to_sun = (sun::equator(days) * SUN - center * range).normalize();
        // From the place rather than from the earth's centre, which differs by up to a degree.
        let moon = turn * center * range - DVec3::Y * EARTH;
        let distance = moon.length();
        Moon {
            direction: moon / distance,
            distance,
            radius: RADIUS / distance,
            to_sun: turn * to_sun,
            lit: 0.5 - 0.5 * to_sun.dot(center),
        }
    }
}
