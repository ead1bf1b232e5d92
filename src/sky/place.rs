//! From the equator's axes to a place's horizon, and what the air does to it.
//!
//! World axes: x east, y up, z south. Equatorial axes: x to the equinox of date, z to the north pole.

use super::time::{centuries, sane};
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
    pub fn turn(&self, days: f64) -> DMat3 {
        let (s, c) = sidereal(days, self.longitude).sin_cos();
        let (sin, cos) = sane(self.latitude).sin_cos();
        DMat3::from_cols(dvec3(-s, c * cos, c * sin), dvec3(c, s * cos, s * sin), dvec3(0.0, sin, -cos))
    }
}

/// Local mean sidereal time, radians. Meeus, "Astronomical Algorithms", 1998, 12.4.
///
/// Mean, as the equinox of [`super::sun`] and [`super::moon`] is: their nutation would cancel.
pub fn sidereal(days: f64, longitude: f64) -> f64 {
    let t = centuries(days);
    (280.460_618_37 + 360.985_647_366_29 * sane(days) + 3.879e-4 * t * t).to_radians() + sane(longitude)
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

/// How much air lifts what is at a true altitude, radians: 0.0084 (29') at 0, 1010 hPa and 10 C.
///
/// Saemundsson, Sky and Telescope 72, 1986, p. 70, down to -1 degree, where his formula is still sound; from there it fades
/// to nothing at -6. The zenith stays where it is to within 0.1".
pub fn refraction(altitude: f64) -> f64 {
    let h = altitude.to_degrees();
    let low = h.max(-1.0);
    let lift = 1.02 / (low + 10.3 / (low + 5.11)).to_radians().tan() / 60.0;
    lift.to_radians() * (1.2 + h * 0.2).clamp(0.0, 1.0)
}

/// The direction in which air shows a true unit direction.
pub fn refracted(d: DVec3) -> DVec3 {
    let (altitude, azimuth) = angles(d);
    let (y, level) = (altitude + refraction(altitude)).sin_cos();
    let (east, north) = azimuth.sin_cos();
    dvec3(level * east, y, -level * north)
}
