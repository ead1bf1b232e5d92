//! From equatorial axes to a place's horizon, and refraction.
//!
//! World axes are x east, y up, z south. Equatorial axes are x to the mean equinox of date, z to the celestial north
//! pole. Both are right-handed.

use super::time::{sane, short, turned};
use glam::{DMat3, DVec3, dvec3};

/// A place on a round earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Latitude, radians, north positive.
    pub latitude: f64,
    /// Longitude, radians, east positive. Whole turns do not matter.
    pub longitude: f64,
}

impl Place {
    /// Plzen: 49.75 N, 13.38 E.
    pub const PLZEN: Place = Place::degrees(49.75, 13.38);

    /// The place at a latitude in degrees north and a longitude in degrees east.
    pub const fn degrees(latitude: f64, longitude: f64) -> Place {
        Place { latitude: latitude.to_radians(), longitude: longitude.to_radians() }
    }

    /// The rotation from equatorial axes to the world's at a time, days since J2000. Its z axis is the celestial pole.
    ///
    /// At a pole, where there is no east, the longitude says which way is south. Angles and times beyond 10^9 and NaN
    /// count as 0.
    #[inline(never)] // Called in a few places, never in a hot loop.
    pub fn turn(&self, days: f64) -> DMat3 {
        let (s, c) = turned(sidereal(days, self.longitude));
        let (sin, cos) = turned(sane(self.latitude).to_degrees());
        DMat3::from_cols(dvec3(-s, c * cos, c * sin), dvec3(c, s * cos, s * sin), dvec3(0.0, sin, -cos))
    }
}

/// Local mean sidereal time, degrees: `[Meeus98]`, 12.4, without the term in the square of the centuries, 1.4".
///
/// It is mean, as the equinox of [`super::sun`] and [`super::moon`] is: nutation would cancel.
fn sidereal(days: f64, longitude: f64) -> f64 {
    280.460_618_37 + 360.985_647_366_29 * sane(days) + sane(longitude).to_degrees()
}

/// Altitude and azimuth of a unit direction on world axes, radians. The azimuth is 0 to 2 pi, from north over east;
/// that of the zenith is 0.
pub fn angles(d: DVec3) -> (f64, f64) {
    let azimuth = d.x.atan2(-d.z);
    let turn = if azimuth < 0.0 { std::f64::consts::TAU } else { 0.0 };
    let level = d.x == 0.0 && d.z.abs() < 1e-12;
    (d.y.clamp(-1.0, 1.0).asin(), if level { 0.0 } else { azimuth + turn })
}

/// The unit direction in which the air shows what is in the true unit direction `d`: on the horizon, at 1010 hPa and 10
/// degrees Celsius, it lifts by 0.0084 radians (29').
///
/// It is the formula of `[Saemundsson86]`, rewritten as a fraction of the altitude's sine, within 0.1", down to -1
/// degree, to where it is sound. From there refraction fades to nothing at -6 degrees.
pub fn refracted(d: DVec3) -> DVec3 {
    let low = d.y.max(short(-0.017_45));
    let lift = short(2.964_67e-4) / (low + short(0.003_134_79) / (low + short(0.089_147)));
    (d + DVec3::Y * (lift * (short(1.2) + d.y * short(11.46)).clamp(0.0, 1.0))).normalize()
}
