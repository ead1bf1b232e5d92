//! The calendar, against one that counts day by day.

use paprsek::sky::time::{Date, add_months, date, days, month_length};
use proptest::prelude::*;

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

fn lengths(year: i64) -> [i64; 12] {
    [31, if is_leap(year) { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]
}

fn at(year: i64, month: i64, day: i64) -> f64 {
    days(&Date { year, month, day, second: 0.0 })
}

#[test]
fn every_day_of_twelve_centuries() {
    // Meeus, chapter 7: noon of 1600-01-01 is Julian day 2305448.
    let mut noon = 2_305_448.0 - 2_451_545.0;
    for year in 1600..2800 {
        for (month, length) in (1..).zip(lengths(year)) {
            assert_eq!(month_length(year, month), length, "{year}-{month}");
            for day in 1..=length {
                assert_eq!(days(&Date { year, month, day, second: 43_200.0 }), noon);
                assert_eq!(date(noon), Date { year, month, day, second: 43_200.0 });
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
        assert_eq!(at(year, month, day), julian - 2_451_545.0, "{year}-{month}-{day}");
    }
}

#[test]
fn months_keep_the_day_where_they_can() {
    for (from, months, to) in [
        ((2024, 1, 31), 1, (2024, 2, 29)),
        ((2023, 1, 31), 1, (2023, 2, 28)),
        ((2024, 3, 31), -1, (2024, 2, 29)),
        ((2024, 2, 29), 12, (2025, 2, 28)),
        ((2024, 2, 29), -48, (2020, 2, 29)),
        ((2000, 2, 29), 1200, (2100, 2, 28)),
        ((2024, 12, 31), 1, (2025, 1, 31)),
        ((2025, 1, 1), -1, (2024, 12, 1)),
        ((2024, 5, 15), 0, (2024, 5, 15)),
        ((1, 1, 1), -13, (-1, 12, 1)),
    ] {
        assert_eq!(add_months(at(from.0, from.1, from.2) + 0.25, months), at(to.0, to.1, to.2) + 0.25, "{from:?}");
    }
}

#[test]
fn jumps_cross_the_end_of_a_year() {
    let eve = Date { year: 2024, month: 12, day: 31, second: 82_800.0 };
    // An hour of f64 days since J2000 is exact to a microsecond.
    let next = date(days(&eve) + 1.0 / 24.0 + 1e-9);
    assert_eq!((next.year, next.month, next.day), (2025, 1, 1));
    assert!(next.second < 0.001);
    let leap = date(at(2024, 2, 28) + 1.0);
    assert_eq!((leap.month, leap.day), (2, 29));
    let none = date(at(2100, 2, 28) + 1.0);
    assert_eq!((none.month, none.day), (3, 1));
}

proptest! {
    #[test]
    fn dates_come_back(time in -3e8..3e8f64) {
        let found = date(time);
        prop_assert!((1..=12).contains(&found.month));
        prop_assert!(found.day >= 1 && found.day <= lengths(found.year)[found.month as usize - 1]);
        prop_assert!((0.0..86_400.0).contains(&found.second));
        prop_assert!((days(&found) - time).abs() < 1e-6);
    }

    #[test]
    fn anything_is_some_date(time in proptest::num::f64::ANY, months: i64) {
        prop_assert!((1..=12).contains(&date(time).month));
        prop_assert!(add_months(time, months).is_finite());
    }

    #[test]
    fn months_go_back(time in -1e6..1e6f64, months in -5000..5000i64) {
        let from = date(time);
        let there = date(add_months(time, months));
        prop_assert_eq!(there.year * 12 + there.month, from.year * 12 + from.month + months);
        prop_assert!(there.day <= from.day);
        // Beyond what f64 keeps of a day, the time of day stays.
        prop_assert!((there.second - from.second).abs() < 1e-3);
    }
}
