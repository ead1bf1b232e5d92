//! Where the moon is, how far, and how much of it is lit.

use super::place::Place;
use super::sun;
use super::time::centuries;
use glam::DVec3;

/// The moon, seen from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moon {
    /// True unit direction on world axes, without refraction. Within 0.3 degrees in 1900 to 2100.
    pub direction: DVec3,
    /// Distance from the place, km.
    pub distance: f64,
    /// Radius of the disc, radians.
    pub radius: f64,
    /// Unit vector from the moon to the sun, world axes: which side is lit.
    pub to_sun: DVec3,
    /// Share of the disc that is lit, 0 to 1, as almanacs count it: from the earth's centre. A place may see 0.008 more
    /// or less.
    pub lit: f64,
}

/// Radii of moon and earth, km.
const RADIUS: f64 = 1737.4;
const EARTH: f64 = 6371.0;
/// Distance of the sun, km.
const SUN: f64 = 1.496e8;

/// Arguments of the series, degrees at J2000 and a century: elongation, the sun's anomaly, the moon's, and its distance
/// from the node.
const ARGUMENTS: [(f64, f64); 4] =
    [(297.850_2, 445_267.111_5), (357.529_1, 35_999.050_3), (134.963_4, 477_198.867_6), (93.272_1, 483_202.017_5)];

/// One wave: whole multiples of the arguments; 2e-4 degrees of longitude or latitude by its sine, km by its cosine.
type Wave = ([i8; 4], i16, i16);

/// Longitude and distance. Meeus, "Astronomical Algorithms", 1998, table 47.A, its largest.
const LONGITUDE: [Wave; 13] = [
    ([0, 0, 1, 0], 31_444, -20_905),
    ([2, 0, -1, 0], 6370, -3_699),
    ([2, 0, 0, 0], 3292, -2_956),
    ([0, 0, 2, 0], 1068, -570),
    ([0, 1, 0, 0], -926, 49),
    ([0, 0, 0, 2], -572, -3),
    ([2, 0, -2, 0], 294, 246),
    ([2, -1, -1, 0], 286, -152),
    ([2, 0, 1, 0], 266, -171),
    ([2, -1, 0, 0], 229, -205),
    ([0, 1, -1, 0], -204, -130),
    ([1, 0, 0, 0], -174, 109),
    ([0, 1, 1, 0], -152, 105),
];

/// Latitude. The same, table 47.B.
const LATITUDE: [Wave; 6] = [
    ([0, 0, 0, 1], 25_641, 0),
    ([0, 0, 1, 1], 1403, 0),
    ([0, 0, 1, -1], 1388, 0),
    ([2, 0, 0, -1], 866, 0),
    ([2, 0, -1, 1], 277, 0),
    ([2, 0, -1, -1], 232, 0),
];

/// The sums of sines, degrees, and of cosines, km.
fn series(waves: &[Wave], t: f64) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for (multiples, sine, cosine) in waves {
        let mut angle = 0.0;
        for (multiple, (start, rate)) in multiples.iter().zip(ARGUMENTS) {
            angle += *multiple as f64 * (start + rate * t);
        }
        let (s, c) = angle.to_radians().sin_cos();
        sum = (sum.0 + *sine as f64 * 2e-4 * s, sum.1 + *cosine as f64 * c);
    }
    sum
}

impl Moon {
    /// The moon at a time, days since J2000, from a place.
    pub fn new(days: f64, place: &Place) -> Moon {
        let t = centuries(days);
        let (wave, range) = series(&LONGITUDE, t);
        let longitude = 218.316_4 + 481_267.881_3 * t + wave;
        let latitude = series(&LATITUDE, t).0;
        let center = sun::equatorial(longitude.to_radians(), latitude.to_radians(), days) * (385_000.6 + range);
        let turn = place.turn(days);
        // From the place rather than from the earth's centre: up to a degree.
        let from_center = turn * center;
        let moon = from_center - DVec3::Y * EARTH;
        let sun = turn * sun::equator(days) * SUN;
        let distance = moon.length();
        let phase = (sun - from_center).normalize().dot(from_center.normalize());
        Moon {
            direction: moon / distance,
            distance,
            radius: (RADIUS / distance).asin(),
            to_sun: (sun - moon).normalize(),
            lit: 0.5 - 0.5 * phase,
        }
    }
}
