//! Parameters that scenes with flakes or drops have in common: the keys of thesis C, snow for virtual reality.

use crate::frame::Parameter;
use crate::particles::Flakes;

/// The height of a field, metres.
pub const fn height(default: f64, about: &'static str) -> Parameter {
    Parameter::new("height", "m", (2.0, 100.0), default, about)
}

/// The radius of a field around the eye, metres.
pub const fn radius(name: &'static str, default: f64, about: &'static str) -> Parameter {
    Parameter::new(name, "m", (1.0, 200.0), default, about)
}

/// The number of flakes of a field.
pub const fn count(name: &'static str, default: f64, about: &'static str) -> Parameter {
    Parameter::new(name, "count", (0.0, 1e6), default, about)
}

/// The wind towards the east or the south, metres per second.
pub const fn wind(name: &'static str, default: f64, about: &'static str) -> Parameter {
    Parameter::new(name, "m/s", (-20.0, 20.0), default, about)
}

/// The speed at which the slowest flake falls, metres per second.
pub const fn fall(default: f64) -> Parameter {
    let about = "speed of fall of the slowest; the spread of the others scales with it";
    Parameter::new("fall", "m/s", (0.1, 30.0), default, about)
}

/// The share of the flakes that is there.
pub const fn share(about: &'static str) -> Parameter {
    Parameter::new("share", "1", (0.0, 1.0), 1.0, about)
}

/// The radius of the smallest flake, metres.
pub const fn size(default: f64) -> Parameter {
    let about = "radius of the smallest; the spread of the others scales with it";
    Parameter::new("size", "m", (0.001, 0.1), default, about)
}

/// A field of flakes with another height and radius, metres, another count, and speeds and sizes times a factor.
pub fn altered(flakes: &Flakes, height: f64, radius: f64, count: f64, faster: f64, larger: f64) -> Flakes {
    let (height, reach) = (height as f32, radius as f32);
    Flakes {
        count: count as u32,
        extent: glam::vec3a(2.0 * reach, height, 2.0 * reach),
        reach,
        fall: flakes.fall.map(|speed| speed * faster),
        radius: flakes.radius.map(|radius| radius * larger as f32),
        ..*flakes
    }
}
