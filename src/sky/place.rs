//! From the equator's axes to a place's horizon, and what the air does to it.
//!
//! World axes: x east, y up, z south. Equatorial axes: x to the equinox of date, z to the north pole.

use super::time::{sane, turned};
use glam::{DMat3, DVec3, dvec3};

/// A place on a round earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Radians, north positive.
    pub latitude: f64,
    /// Radians, east positive; whole turns do not matter.
    pub longitude: f64,
}

impl Place {
    /// 49.75 N, 13.38 E.
    pub const PLZEN: Place =
        Place { latitude: 49.75 / 57.295_779_513_082_32, longitude: 13.38 / 57.295_779_513_082_32 };

    /// A place by degrees north and east.
    pub fn degrees(latitude: f64, longitude: f64) -> Place {
        Place { latitude: latitude.to_radians(), longitude: longitude.to_radians() }
    }

    /// The rotation from equatorial axes to the world's at a time. Its z axis is the celestial pole.
    ///
    /// At a pole, where there is no east, the longitude says what south is. Angles that are no numbers count as 0.
    #[inline(never)]
    pub fn turn(&self, days: f64) -> DMat3 {
        let (s, c) = turned(sidereal(days, self.longitude));
        let (sin, cos) = turned(sane(self.latitude).to_degrees());
        DMat3::from_cols(dvec3(-s, c * cos, c * sin), dvec3(c, s * cos, s * sin), dvec3(0.0, sin, -cos))
    }
}

/// Local mean sidereal time, degrees. Meeus, "Astronomical Algorithms", 1998, 12.4, without the square of centuries, 1.4".
///
/// Mean, as the equinox of [`super::sun`] and [`super::moon`] is: their nutation would cancel.
fn sidereal(days: f64, longitude: f64) -> f64 {
    280.460_618_37 + 360.985_647_366_29 * sane(days) + sane(longitude).to_degrees()
}

/// Altitude over the horizon and azimuth, from north over east, 0 to 2 pi, of a unit direction. Radians.
///
/// The azimuth of the zenith is 0.
pub fn angles(d: DVec3) -> (f64, f64) {
    let azimuth = d.x.atan2(-d.z);
    let turn = if azimuth < 0.0 { std::f64::consts::TAU } else { 0.0 };
    let level = d.x == 0.0 && d.z.abs() < 1e-12;
    (d.y.clamp(-1.0, 1.0).asin(), if level { 0.0 } else { azimuth + turn })
}

/// The direction in which air shows a true unit direction: it lifts by 0.0084 (29') at 0, 1010 hPa and 10 C.
///
/// Saemundsson, Sky and Telescope 72, 1986, p. 70, within 0.1" as a fraction of the altitude's sine, down to -1 degree, where
/// his formula is still sound; from there it fades to nothing at -6.
pub fn refracted(d: DVec3) -> DVec3 {
    let low = d.y.max(-0.017_45);
    let lift = 2.964_67e-4 / (low + 0.003_134_79 / (low + 0.089_147));
    (d + DVec3::Y * (lift * (1.2 + d.y * 11.46).clamp(0.0, 1.0))).normalize()
}
