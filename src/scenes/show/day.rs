//! The scene `day`, two parts of the show: days on a hill by a lake from dawn to the stars, one of each season.
//!
//! The subject of thesis E, modelling the sun's cycle: a clock runs sixty times and more faster than life, and sun,
//! moon, stars, light and shadows follow from it. The camera's keys are hours of the day.

use super::valley;
use super::valley::{HOUR, LATITUDE, LONGITUDE};
use crate::angle;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::scenes::script::{Script, Word, operations, script};
use crate::timeline::{self, ease};
use crate::view::Camera;
use glam::vec3a;

/// The scene.
pub const DAY: Scene = Scene {
    name: "day",
    about: "a hill by a lake: four days, one of each season",
    duration: 4.0 * LENGTH,
    parameters: &[DATE, START, SPEED, LATITUDE, LONGITUDE],
    picture,
}
.part();

/// The date of the first day.
const DATE: Parameter = Parameter::new(
    "date",
    "days",
    (1.0, 366.0),
    176.0,
    "the first day's number in the year 2026; the others follow after 86, 180 and 258 days",
);
/// The hour at which the sky's clock starts. The camera's always starts at 4.
const START: Parameter =
    Parameter::new("hour", "h", (0.0, 24.0), FIRST_HOUR, "time of day at which a day begins, UT + 1");
/// How fast both clocks run.
const SPEED: Parameter =
    Parameter::new("speed", "h/s", (0.0, 24.0), 24.0 / LENGTH, "hours of a day per second; the camera goes with them");

/// The length of a day, seconds. It lasts from four in the morning to four in the morning.
pub const LENGTH: f64 = 60.0;
const FIRST_HOUR: f64 = 4.0;

/// The number of the day, 0 to 3, and the hour, 4 to 28, at `time` seconds.
pub fn clock(time: f64) -> (usize, f64) {
    let day = (time / LENGTH).floor();
    (day as usize % 4, FIRST_HOUR + (time - day * LENGTH) * (24.0 / LENGTH))
}

/// The hour at which the camera leaps to where the moon stands over the lake.
pub const LEAP: f32 = 22.0;
/// The same in the unit of keys.
const LEAP_KEY: Word = LEAP / 10.0;

operations! {
    /// The only operation: the keys are on the stack.
    end = 40;
}

/// The camera around the chapel. The last two keys are to the south of where the moon stands over the lake.
const COURSE: &[u8] = script! {
    ..key(4.0, [-36.0, 13.5, 14.0], [0.0, 18.5, -2.0], 54.0);
    ..key(8.0, [-24.0, 17.0, -34.0], [0.0, 17.0, 0.0], 54.0);
    ..key(12.0, [0.0, 19.0, -47.0], [0.0, 16.0, 0.0], 54.0);
    ..key(14.0, [38.0, 19.0, -28.0], [0.0, 16.5, 0.0], 54.0);
    ..key(18.0, [33.0, 13.5, 39.0], [0.0, 18.0, -4.0], 54.0);
    // A thousandth of an hour before it leaps.
    push(-0.02 * 0.005 + LEAP_KEY); ..view([24.0, 14.0, 44.0], [-3.0, 19.0, 0.0], 54.0);
    ..key(LEAP, [-4.0, 15.5, -46.0], [-6.0, 19.5, 0.0], 54.0);
    ..key(28.0, [14.0, 16.5, -45.0], [-4.0, 20.0, 0.0], 54.0);
    end();
};

/// A key of the camera: the hour; eye and target, metres; the vertical field of view, degrees. Tens of each fit a
/// script.
const fn key(hour: Word, eye: [Word; 3], target: [Word; 3], fov: Word) -> [Word; 8] {
    let [x, y, z, tx, ty, tz, fov] = view(eye, target, fov);
    [hour / 10.0, x, y, z, tx, ty, tz, fov]
}

const fn view([x, y, z]: [Word; 3], [tx, ty, tz]: [Word; 3], fov: Word) -> [Word; 7] {
    [x / 10.0, y / 10.0, z / 10.0, tx / 10.0, ty / 10.0, tz / 10.0, fov / 10.0]
}

fn picture(spec: &FrameSpec) -> Picture {
    let time = spec.time * (spec.get(&SPEED) / SPEED.default);
    let (day, hour) = clock(time);
    let mut course = Script::new(COURSE, [0.0; 2]);
    course.next();
    let key: [f32; 8] = timeline::sample(course.stack().as_chunks().0, 0.1 * hour);
    let [_, x, y, z, tx, ty, tz, fov] = key.map(|n| 10.0 * n);
    let camera = Camera::look_at(vec3a(x, y, z), vec3a(tx, ty, tz), fov.to_radians(), 0.0);
    let (date, textures) = valley::season(day);
    // Central European Time is an hour ahead of UT.
    let start = spec.get(&START) - FIRST_HOUR - 1.0;
    let midnight = valley::date(spec, &DATE) + start * HOUR + date as f64;
    let mut dome = valley::sky(spec, midnight + hour * HOUR);
    let dark = ease(-0.02, 0.1, -dome.sky.sun.y as f64);
    // A display needs more light than an eye.
    dome.exposure *= 1.0 + dark;
    let now = dome.lighting();
    // The aeroplane comes over the hill every 6 seconds, and where the show cuts from it to September.
    let flights = (spec.time + 2.0) / 6.0;
    let way = (flights - flights.floor() - 0.5) as f32 * 900.0;
    let turn = angle::turn_y(-1.0) * angle::turn_z(0.25);
    let place = turn * vec3a(0.0, 0.0, -way) + vec3a(-4.0, 30.0, -20.0);
    #[cfg(feature = "full")]
    let (place, turn) = spec.flown(place, turn);
    let view = spec.view(camera);
    let mut world = valley::world(&dome, textures, turn, place, spec.time);
    world.lights[0].shadow = valley::cascades(spec, view.camera(), now.direction, &[24.0, 80.0, 500.0, 1800.0]);
    valley::lamp(&mut world, dark);
    valley::show(spec, dome, world, view, None)
}
