//! Sun and moon, against `oracle.toml`.

use glam::DVec3;
use paprsek::sky::moon::Moon;
use paprsek::sky::place::{Place, angles, refracted};
use paprsek::sky::sun::{self, Day, RISE};
use proptest::prelude::*;
use serde::Deserialize;

/// Degrees that the sun may be off in 1900 to 2100, and seconds of its rise; near a polar switch, where it comes in
/// flat, more.
const SUN: f64 = 0.02;
const RISE_SECONDS: f64 = 60.0;
const FLAT_SECONDS: f64 = 150.0;
/// Degrees that the moon may be off, and its lit share.
const MOON: f64 = 0.5;
const LIT: f64 = 0.005;
/// Kilometres, 0.2 %: the disc's size.
const RANGE: f64 = 800.0;

#[derive(Deserialize)]
struct Oracle {
    sun: Vec<[f64; 6]>,
    moon: Vec<[f64; 8]>,
    rise: Vec<Vec<f64>>,
}

fn oracle() -> Oracle {
    toml::from_str(include_str!("oracle.toml")).unwrap()
}

/// The unit direction at an altitude and azimuth, degrees.
fn direction(altitude: f64, azimuth: f64) -> DVec3 {
    let ((y, level), (east, north)) = (altitude.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    DVec3::new(level * east, y, -level * north)
}

/// How much air lifts what is at an altitude, radians.
fn refraction(altitude: f64) -> f64 {
    angles(refracted(direction(altitude.to_degrees(), 0.0))).0 - altitude
}

/// Degrees between two unit vectors, also for small angles.
fn between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

#[test]
fn sun_is_where_spa_says() {
    let (mut worst, mut sum) = (0.0f64, 0.0);
    let rows = oracle().sun;
    assert!(rows.len() > 300);
    for [days, latitude, longitude, altitude, azimuth, _] in &rows {
        let place = Place::degrees(*latitude, *longitude);
        let off = between(sun::direction(*days, &place), direction(*altitude, *azimuth));
        // At a pole the azimuth is a matter of convention: the longitude's meridian, which is ours too.
        assert!(off < SUN, "{days} {latitude} {longitude}: {off}");
        (worst, sum) = (worst.max(off), sum + off * off);
    }
    println!("sun: worst {worst:.4}, rms {:.4} degrees", (sum / rows.len() as f64).sqrt());
}

#[test]
fn refraction_is_spas_above_the_horizon() {
    let mut worst = 0.0f64;
    for [_, _, _, altitude, _, lifted] in oracle().sun {
        if altitude > -0.8 {
            let found = altitude + refraction(altitude.to_radians()).to_degrees();
            worst = worst.max((found - lifted).abs());
        }
    }
    println!("refraction: worst {worst:.5} degrees");
    assert!(worst < 0.002, "{worst}");
    // 34' lift what is seen on the horizon.
    let seen = -34.0f64 / 60.0;
    assert!((seen.to_radians() + refraction(seen.to_radians())).to_degrees().abs() < 0.01);
}

#[test]
fn refraction_keeps_order_and_has_no_jump() {
    let mut last = f64::MIN;
    for i in -9000..=9000 {
        let altitude = (i as f64 * 0.01).to_radians();
        let seen = altitude + refraction(altitude);
        assert!(seen > last && seen - last < 0.01f64.to_radians() * 1.2 || i == -9000, "{i}");
        last = seen;
    }
    assert!(refraction(std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    assert!(refraction(-0.2).abs() < 1e-12);
}

#[test]
fn angles_of_the_poles_of_the_sky() {
    assert_eq!(angles(DVec3::Y), (std::f64::consts::FRAC_PI_2, 0.0));
    assert_eq!(angles(-DVec3::Y), (-std::f64::consts::FRAC_PI_2, 0.0));
    for (d, degrees) in [(-DVec3::Z, 0.0), (DVec3::X, 90.0), (DVec3::Z, 180.0), (-DVec3::X, 270.0)] {
        assert_eq!(angles(d).1.to_degrees(), degrees);
    }
    // At a pole the sun's altitude is its declination all day.
    let pole = Place::degrees(90.0, 0.0);
    for i in 0..24 {
        let (altitude, _) = angles(sun::direction(8938.0 + i as f64 / 24.0, &pole));
        assert!((altitude.to_degrees() - 23.43).abs() < 0.03);
    }
}

#[test]
fn the_date_line_is_no_line() {
    for days in [0.0, 123.4, 8000.9] {
        let (east, west) = (Place::degrees(51.5, 180.0), Place::degrees(51.5, -180.0));
        assert!(sun::direction(days, &east).distance(sun::direction(days, &west)) < 1e-9);
        assert!(Moon::new(days, &east).direction.distance(Moon::new(days, &west).direction) < 1e-9);
    }
}

#[test]
fn moon_is_where_libastro_says() {
    let [mut worst, mut lit_off, mut range_off] = [0.0f64; 3];
    for [days, latitude, longitude, altitude, azimuth, lit, radius, range] in oracle().moon {
        let place = Place::degrees(latitude, longitude);
        let moon = Moon::new(days, &place);
        worst = worst.max(between(moon.direction, direction(altitude, azimuth)));
        lit_off = lit_off.max((moon.lit - lit).abs());
        assert!((moon.radius.to_degrees() - radius).abs() < 0.01, "{days}: {} {radius}", moon.radius.to_degrees());
        range_off = range_off.max((moon.distance - range).abs());
        assert!((moon.to_sun.length() - 1.0).abs() < 1e-12);
    }
    println!("moon: worst {worst:.3} degrees, lit share {lit_off:.4}, distance {range_off:.0} km");
    assert!(worst < MOON && lit_off < LIT && range_off < RANGE);
}

#[test]
fn moon_is_near_its_known_phases() {
    // The eclipses of 1999-08-11 11:03 and 2000-07-16 13:56 UT (Espenak, NASA): new and full to a fraction of a degree.
    let center = Place::degrees(45.1, 24.3);
    let moon = Moon::new(-143.0 - 0.0396, &center);
    assert!(between(moon.direction, sun::direction(-143.0 - 0.0396, &center)) < 0.5);
    assert!(moon.lit < 1e-4);
    let full = Moon::new(197.0 + 0.0806, &center);
    assert!(full.lit > 0.9995);
}

#[test]
fn sun_rises_and_sets_when_spa_says() {
    let (mut worst, mut flat_worst, mut doubles) = (0.0f64, 0.0f64, 0);
    for row in oracle().rise {
        let [start, latitude, longitude, up] = row[..4] else { panic!() };
        let place = Place::degrees(latitude, longitude);
        let day = Day::new(start, &place, RISE);
        // What is so near to the day's ends may fall to another day.
        let within = |t: f64| (t - start - 0.5).abs() < 0.5 - RISE_SECONDS / 86_400.0;
        let truth: Vec<(f64, bool)> = row[4..].chunks(2).map(|c| (c[0], c[1] == 1.0)).filter(|c| within(c.0)).collect();
        let found: Vec<_> = day.crossings.iter().filter(|c| within(c.time)).collect();
        let directions: Vec<bool> = found.iter().map(|c| c.rising).collect();
        assert_eq!(directions, truth.iter().map(|t| t.1).collect::<Vec<_>>(), "{row:?} {day:?}");
        if truth.len() == row[4..].len() / 2 {
            assert_eq!(day.starts_up, up == 1.0, "{row:?}");
            assert_eq!(day.is_polar_day(), truth.is_empty() && up == 1.0);
            assert_eq!(day.is_polar_night(), truth.is_empty() && up == 0.0);
        }
        doubles += (truth.iter().filter(|t| t.1).count() > 1) as u32;
        for (found, (time, _)) in found.iter().zip(&truth) {
            let off = (found.time - time).abs() * 86_400.0;
            // How fast it climbs, degrees an hour.
            let climb = |t: f64| angles(sun::direction(t, &place)).0.to_degrees();
            let slope = (climb(time + 1e-3) - climb(time - 1e-3)).abs() / 0.048;
            let steep = slope > 1.5;
            *if steep { &mut worst } else { &mut flat_worst } = off.max(if steep { worst } else { flat_worst });
            let allowed = if steep { RISE_SECONDS } else { FLAT_SECONDS.max(SUN / slope * 3600.0) };
            assert!(off < allowed, "{row:?}: {off} s at {slope} degrees an hour");
        }
    }
    println!("rise and set: worst {worst:.1} s, where flat {flat_worst:.1} s; {doubles} days with two risings");
    assert!(doubles > 0);
}

#[test]
fn day_and_night_make_a_day() {
    // Plzen's longest and shortest day: 16 h 16 min and 8 h 10 min (timeanddate.com, 2024, rounded).
    let length = |start: f64| Day::new(start, &Place::PLZEN, RISE).light() * 24.0;
    assert!((length(8936.5) - 16.3).abs() < 0.15, "{}", length(8936.5));
    assert!((length(9120.5) - 8.15).abs() < 0.15, "{}", length(9120.5));
    let pole = Place::degrees(90.0, 0.0);
    assert_eq!(Day::new(8936.5, &pole, RISE).light(), 1.0);
    assert_eq!(Day::new(9120.5, &pole, RISE).light(), 0.0);
}

proptest! {
    #[test]
    fn nothing_breaks(
        days in proptest::num::f64::ANY, latitude in proptest::num::f64::ANY, longitude in proptest::num::f64::ANY,
    ) {
        let place = Place { latitude, longitude };
        let seen = refracted(sun::direction(days, &place));
        prop_assert!((seen.length() - 1.0).abs() < 1e-9);
        let moon = Moon::new(days, &place);
        prop_assert!((moon.direction.length() - 1.0).abs() < 1e-9 && (0.0..=1.0).contains(&moon.lit));
        prop_assert!(moon.radius.is_finite());
        let day = Day::new(days, &place, RISE);
        prop_assert!((0.0..=1.0).contains(&day.light()) && day.crossings.len() <= 8);
    }

    #[test]
    fn crossings_alternate(days in -36525.0..36525.0f64, latitude in -90.0..=90.0f64, longitude in -180.0..=180.0f64) {
        let day = Day::new(days, &Place::degrees(latitude, longitude), RISE);
        let mut up = day.starts_up;
        let mut last = days;
        for crossing in &day.crossings {
            prop_assert!(crossing.rising != up && crossing.time >= last && crossing.time <= days + 1.0);
            (up, last) = (crossing.rising, crossing.time);
        }
    }
}
