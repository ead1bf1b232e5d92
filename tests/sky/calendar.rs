//! The calendar, against one that counts day by day.

use paprsek::sky::time::{Date, days};
use proptest::prelude::*;

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

fn lengths(year: i64) -> [i64; 12] {
    [31, if is_leap(year) { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]
}

#[test]
fn every_day_of_twelve_centuries() {
    // Meeus, chapter 7: noon of 1600-01-01 is Julian day 2305448.
    let mut noon = 2_305_448.0 - 2_451_545.0;
    for year in 1600..2800 {
        for (month, length) in (1..).zip(lengths(year)) {
            for day in 1..=length {
                assert_eq!(Date { year, month, day, second: 43_200.0 }.days(), noon);
                assert_eq!(Date::at(noon), Date { year, month, day, second: 43_200.0 });
                noon += 1.0;
            }
        }
    }
}

#[test]
fn known_julian_days() {
    // Meeus, "Astronomical Algorithms", chapter 7, Gregorian dates.
    for (year, month, day, julian) in [
        (2000, 1, 1, 2_451_544.5),
        (1999, 1, 1, 2_451_179.5),
        (1987, 1, 27, 2_446_822.5),
        (1988, 1, 27, 2_447_187.5),
        (1900, 1, 1, 2_415_020.5),
        (1600, 1, 1, 2_305_447.5),
        (1600, 12, 31, 2_305_812.5),
        // Proleptic: 1 January of year 0 and -4712-11-24 of the Gregorian calendar.
        (0, 1, 1, 1_721_059.5),
        (-4713, 11, 24, -0.5),
    ] {
        assert_eq!(days(year, month, day), julian - 2_451_545.0, "{year}-{month}-{day}");
    }
}

/// A scene writes its date as a constant.
#[test]
fn dates_are_constants() {
    const DAY: f64 = days(2026, 6, 25);
    assert_eq!(DAY, 9671.5);
}

#[test]
fn months_and_days_run_on() {
    assert_eq!(days(2024, 14, 1), days(2025, 2, 1));
    assert_eq!(days(2024, 0, 31), days(2023, 12, 31));
    assert_eq!(days(2024, 2, 30), days(2024, 3, 1));
    assert_eq!(days(2024, 3, 0), days(2024, 2, 29));
}

#[test]
fn jumps_cross_the_end_of_a_year() {
    let eve = Date { year: 2024, month: 12, day: 31, second: 82_800.0 };
    // An hour of f64 days since J2000 is exact to a microsecond.
    let next = Date::at(eve.days() + 1.0 / 24.0 + 1e-9);
    assert_eq!((next.year, next.month, next.day), (2025, 1, 1));
    assert!(next.second < 0.001);
    let leap = Date::at(days(2024, 2, 28) + 1.0);
    assert_eq!((leap.month, leap.day), (2, 29));
    let none = Date::at(days(2100, 2, 28) + 1.0);
    assert_eq!((none.month, none.day), (3, 1));
}

proptest! {
    #[test]
    fn dates_come_back(time in -3e8..3e8f64) {
        let found = Date::at(time);
        prop_assert!((1..=12).contains(&found.month));
        prop_assert!(found.day >= 1 && found.day <= lengths(found.year)[found.month as usize - 1]);
        prop_assert!((0.0..86_400.0).contains(&found.second));
        prop_assert!((found.days() - time).abs() < 1e-6);
    }

    #[test]
    fn anything_is_some_date(time in proptest::num::f64::ANY) {
        prop_assert!((1..=12).contains(&Date::at(time).month));
    }
}
