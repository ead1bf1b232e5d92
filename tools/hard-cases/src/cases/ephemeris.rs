//! Sun, moon and the calendar.

use super::rays::any;
use crate::case::{Case, Effort, Runs};
use glam::DVec3;
use paprsek::settings::Quality;
use paprsek::sky::dome::{Dome, Sky};
use paprsek::sky::moon::Moon;
use paprsek::sky::place::{Place, angles, refracted};
use paprsek::sky::sun::{self, Day, RISE};
use paprsek::sky::time::{Date, days};
use serde::Deserialize;
use testkit::Found;
use testkit::random::Random;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Scalar,
        "the sun, 1900 to 2100, poles, date line, zenith, year's ends, leap days",
        "NREL SPA",
        "[SPA], table",
        0.02,
        sun_table,
    )
    .unit("degrees"),
    Case::new(
        Runs::Scalar,
        "the sun at random times and places",
        "another program",
        "Astronomy Engine 2.1.19, table",
        0.02,
        sun_random,
    )
    .unit("degrees"),
    Case::new(
        Runs::Scalar,
        "equinoxes and solstices of every tenth year",
        "another program",
        "Astronomy Engine 2.1.19, table",
        0.02,
        seasons,
    )
    .unit("degrees"),
    Case::new(
        Runs::Scalar,
        "refraction from -0.8 degrees to the zenith",
        "at the horizon",
        "[SPA], table",
        2e-3,
        refraction,
    )
    .unit("degrees"),
    Case::new(
        Runs::Scalar,
        "refraction keeps the order of altitudes, by 0.001 degrees",
        "no jump",
        "order",
        0.0,
        refraction_order,
    )
    .unit("failures"),
    Case::new(Runs::Scalar, "the moon's place, 1900 to 2100", "parallax", "[Ephem], table", 0.5, |_| {
        moon_table(|off| off[0])
    })
    .unit("degrees"),
    Case::new(Runs::Scalar, "the moon's lit share", "phases", "[Ephem], table", 0.005, |_| moon_table(|off| off[1])),
    Case::new(Runs::Scalar, "the moon's distance", "size of the disc", "[Ephem], table", 800.0, |_| {
        moon_table(|off| off[2])
    })
    .unit("km"),
    Case::new(
        Runs::Scalar,
        "the moon at random times and places",
        "another program",
        "Astronomy Engine 2.1.19, table",
        0.5,
        moon_random,
    )
    .unit("degrees"),
    Case::new(
        Runs::Scalar,
        "rise and set where the sun climbs 1.5 degrees an hour and more",
        "two risings in a day",
        "[SPA], table",
        60.0,
        |_| rises().0,
    )
    .unit("seconds"),
    Case::new(
        Runs::Scalar,
        "rise and set near a polar switch",
        "flat climbs",
        "[SPA], table; or 0.02 degrees of altitude",
        1.0,
        |_| rises().1,
    )
    .unit("of the bound"),
    Case::new(
        Runs::Scalar,
        "number and order of risings and settings, polar day and night",
        "polar switch",
        "[SPA], table",
        0.0,
        |_| rises().2,
    )
    .unit("failures"),
    Case::new(
        Runs::Scalar,
        "every day of -2800 to 6800",
        "leap years, 1900, 2000, 2100",
        "a count day by day from [Meeus98], chapter 7",
        0.0,
        calendar,
    )
    .unit("failures"),
    Case::new(Runs::Scalar, "dates there and back, -8e5 to 8e5 years", "rounding of days", "identity", 0.1, dates)
        .unit("seconds"),
    Case::new(
        Runs::Scalar,
        "times and places of any bits",
        "0, -0, denormals, MAX, infinities, NaN",
        "unit directions, shares of 0 to 1",
        0.0,
        any_bits,
    )
    .unit("failures"),
];

#[derive(Deserialize)]
struct Tables {
    sun: Vec<[f64; 6]>,
    moon: Vec<[f64; 8]>,
    rise: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Others {
    bodies: Vec<[f64; 9]>,
    seasons: Vec<[f64; 2]>,
}

fn tables() -> Tables {
    toml::from_str(include_str!("../../../../tests/sky/oracle.toml")).expect("a table")
}

fn others() -> Others {
    toml::from_str(include_str!("../../data/astronomy_engine.toml")).expect("a table")
}

/// The unit direction at an altitude and azimuth, degrees.
fn direction(altitude: f64, azimuth: f64) -> DVec3 {
    let ((y, level), (east, north)) = (altitude.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    DVec3::new(level * east, y, -level * north)
}

/// Degrees between two unit vectors, also for small angles.
fn between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

fn lifted(altitude: f64) -> f64 {
    angles(refracted(direction(altitude, 0.0))).0.to_degrees()
}

fn sun_table(_: &Effort) -> Found {
    let mut found = Found::default();
    for [days, latitude, longitude, altitude, azimuth, _] in tables().sun {
        let off = between(sun::direction(days, &Place::degrees(latitude, longitude)), direction(altitude, azimuth));
        found.see(off, || format!("{days}, {latitude}, {longitude}"));
    }
    found
}

fn sun_random(_: &Effort) -> Found {
    let mut found = Found::default();
    for [days, latitude, longitude, altitude, azimuth, ..] in others().bodies {
        let off = between(sun::direction(days, &Place::degrees(latitude, longitude)), direction(altitude, azimuth));
        found.see(off, || format!("{days}, {latitude}, {longitude}"));
    }
    found
}

fn seasons(_: &Effort) -> Found {
    let mut found = Found::default();
    for [days, quarter] in others().seasons {
        let d = sun::equator(days);
        let off = d.y.atan2(d.x).to_degrees() - 90.0 * quarter;
        found.see(((off + 540.0).rem_euclid(360.0) - 180.0).abs(), || format!("{days}, quarter {quarter}: {off}"));
    }
    found
}

fn refraction(_: &Effort) -> Found {
    let mut found = Found::default();
    for [.., altitude, _, seen] in tables().sun.into_iter().filter(|row| row[3] > -0.8) {
        found.see((lifted(altitude) - seen).abs(), || format!("{altitude}: {}", lifted(altitude)));
    }
    found
}

fn refraction_order(effort: &Effort) -> Found {
    let mut found = Found::default();
    let n = effort.of(180_000) as i64;
    let mut last = lifted(-89.999);
    for k in 1..n {
        let altitude = -89.999 + 179.998 * k as f64 / n as f64;
        let seen = lifted(altitude);
        let pace = (seen - last) * n as f64 / 179.998;
        // At the horizon what sinks by a degree sinks by some 0.9 as it is seen; where refraction fades, by 1.2.
        found.judge(pace > 0.0 && pace < 1.25, || format!("{altitude}: {seen} after {last}"));
        last = seen;
    }
    found
}

fn moon_table(pick: fn([f64; 3]) -> f64) -> Found {
    let mut found = Found::default();
    for [days, latitude, longitude, altitude, azimuth, lit, _, range] in tables().moon {
        let moon = Moon::new(days, &Place::degrees(latitude, longitude));
        let off = [
            between(moon.direction, direction(altitude, azimuth)),
            (moon.lit - lit).abs(),
            (moon.distance - range).abs(),
        ];
        found.see(pick(off), || format!("{days}, {latitude}, {longitude}: {off:?}"));
    }
    found
}

fn moon_random(_: &Effort) -> Found {
    let mut found = Found::default();
    for [days, latitude, longitude, _, _, altitude, azimuth, lit, range] in others().bodies {
        let moon = Moon::new(days, &Place::degrees(latitude, longitude));
        let off = between(moon.direction, direction(altitude, azimuth));
        // Share and distance by their own targets, as parts of this one's.
        let off = off.max((moon.lit - lit).abs() / 0.005 * 0.5).max((moon.distance - range).abs() / 800.0 * 0.5);
        found.see(off, || format!("{days}, {latitude}, {longitude}: {moon:?} for {lit}, {range}"));
    }
    found
}

/// Seconds that steep passages are off; flat ones, over what is allowed; and days with a wrong number of them.
fn rises() -> (Found, Found, Found) {
    let [mut steep, mut flat, mut wrong] = [Found::default(), Found::default(), Found::default()];
    for row in tables().rise {
        let [start, latitude, longitude, up] = row[..4] else { return Default::default() };
        let place = Place::degrees(latitude, longitude);
        let day = Day::new(start, &place, RISE);
        // What is so near to the day's ends may fall to another day.
        let within = |t: f64| (t - start - 0.5).abs() < 0.5 - 60.0 / 86_400.0;
        let truth: Vec<(f64, bool)> = row[4..].chunks(2).map(|c| (c[0], c[1] == 1.0)).filter(|c| within(c.0)).collect();
        let ours: Vec<_> = day.crossings.iter().filter(|c| within(c.time)).collect();
        let whole = truth.len() == row[4..].len() / 2;
        let same = ours.iter().map(|c| c.rising).eq(truth.iter().map(|t| t.1))
            && (!whole || day.starts_up == (up == 1.0))
            && (!whole || day.is_polar_day() == (truth.is_empty() && up == 1.0))
            && (!whole || day.is_polar_night() == (truth.is_empty() && up == 0.0));
        wrong.judge(same, || format!("{row:?}: {day:?}"));
        for (ours, (time, _)) in ours.iter().zip(&truth) {
            let off = (ours.time - time).abs() * 86_400.0;
            let climb = |t: f64| angles(sun::direction(t, &place)).0.to_degrees();
            // Degrees an hour.
            let slope = (climb(time + 1e-3) - climb(time - 1e-3)).abs() / 0.048;
            if slope > 1.5 {
                steep.see(off, || format!("{row:?}"));
            } else {
                flat.see(off / 150f64.max(0.02 / slope * 3600.0), || format!("{row:?}: {off} s"));
            }
        }
    }
    (steep, flat, wrong)
}

fn calendar(effort: &Effort) -> Found {
    let mut found = Found::default();
    let leap = |year: i64| year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    // Noon of 2000-01-01 is day 0; backwards, then forwards.
    let reach = effort.of(4800) as i64;
    let length = |year: i64| if leap(year) { 366.0 } else { 365.0 };
    let mut noon: f64 = -(2000 - reach..2000).map(length).sum::<f64>();
    for year in 2000 - reach..2000 + reach {
        let february = if leap(year) { 29 } else { 28 };
        for (month, length) in (1..).zip([31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]) {
            for day in 1..=length {
                let date = Date { year, month, day, second: 43_200.0 };
                let right = date.days() == noon && Date::at(noon) == date && days(year, month, day) == noon - 0.5;
                found.judge(right, || format!("{date:?} is {noon}: {:?}", Date::at(noon)));
                noon += 1.0;
            }
        }
    }
    found
}

fn dates(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(120));
    for _ in 0..effort.of(400_000) {
        let time = random.log(1e-6, 3e8) * if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let date = Date::at(time);
        let fits =
            (1..=12).contains(&date.month) && (1..=31).contains(&date.day) && (0.0..86_400.0).contains(&date.second);
        let off = (date.days() - time).abs() * 86_400.0;
        found.see(if fits { off } else { f64::INFINITY }, || format!("{time}: {date:?}"));
    }
    found
}

fn any_bits(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(121));
    let settings = Quality::DEFAULT.sky;
    for _ in 0..effort.of(20_000) {
        let number =
            |random: &mut Random| any(random) as f64 * [1.0, 1e-20, 1e20, 1e250][(random.unit() * 4.0) as usize];
        let (days, latitude, longitude) = (number(&mut random), number(&mut random), number(&mut random));
        let place = Place { latitude, longitude };
        let sun = refracted(sun::direction(days, &place));
        let (moon, day) = (Moon::new(days, &place), Day::new(days, &place, RISE));
        let dome = Dome::new(Sky::new(days, &place), &settings);
        let c = dome.radiance(random.direction());
        let light = dome.lighting();
        let right = (sun.length() - 1.0).abs() < 1e-9
            && (moon.direction.length() - 1.0).abs() < 1e-9
            && (0.0..=1.0).contains(&moon.lit)
            && (0.0..=1.0).contains(&day.light())
            && c.min_element() >= 0.0
            && c.max_element() <= 1.0
            && [light.color, light.sky, light.ground].iter().all(|c| c.is_finite());
        found.judge(right, || format!("{days:e}, {latitude:e}, {longitude:e}: {sun}, {moon:?}, {c}"));
    }
    found
}
