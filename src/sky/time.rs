//! The calendar: days since J2000 (2000-01-01 12:00 UT) to dates and back.
//!
//! Time is an f64 of days everywhere: its rounding is 0.1 ms in 1900 to 2100, and f32 would be off by minutes. What plays
//! is a function of it, so any speed, direction and jump is one sum: an hour is 1/24, a day is 1. A month has no length
//! of its own: [`add_months`].
//!
//! The time is UT. The ephemerides want TT, which was 64 s ahead in 2000 and may be 200 s in 2100. Left out: the sun moves
//! 0.001 and 0.0025 degrees in that time, the moon 0.01 and 0.03.

/// A date of the Gregorian calendar, also before its adoption. The year before 1 is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Date {
    /// Astronomical year.
    pub year: i64,
    /// 1 to 12.
    pub month: i64,
    /// 1 to [`month_length`].
    pub day: i64,
    /// Seconds since midnight UT, 0 to 86,400. There are no leap seconds.
    pub second: f64,
}

/// Numbers that are a time or an angle; 0 for those beyond 10^9 and for NaN, so that nothing after it need look.
pub(super) fn sane(x: f64) -> f64 {
    if x.abs() < 1e9 { x } else { 0.0 }
}

/// Days since J2000 of a date. Months beyond 1 to 12 run into other years, days into other months.
///
/// Hinnant, "chrono-compatible low-level date algorithms", 2013: years begin in March, so that the leap day is the last.
/// Years within 10^9.
pub fn days(date: &Date) -> f64 {
    let months = date.year * 12 + date.month - 3;
    let (year, month) = (months.div_euclid(12), months.rem_euclid(12));
    let leaps = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    let day = year * 365 + leaps + (month * 153 + 2) / 5 + date.day;
    // 2000-01-01 is day 730,426 of the count, and begins half a day before J2000.
    (day - 730_426) as f64 - 0.5 + date.second / 86_400.0
}

/// The date of days since J2000; of 0 for days beyond 10^9 and NaN.
pub fn date(days: f64) -> Date {
    let days = sane(days);
    let midnight = (days + 0.5).floor();
    // Day 0 is 1 March of year 0.
    let day = midnight as i64 + 730_425;
    let era = day.div_euclid(146_097);
    let of_era = day.rem_euclid(146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month = (5 * of_year + 2) / 153;
    let (year, carry) = (year_of_era + era * 400, (month > 9) as i64);
    Date {
        year: year + carry,
        month: month + 3 - 12 * carry,
        day: of_year - (month * 153 + 2) / 5 + 1,
        second: (days + 0.5 - midnight) * 86_400.0,
    }
}

/// Days of a month, 1 to 12 of that year.
pub fn month_length(year: i64, month: i64) -> i64 {
    let first = |month| days(&Date { year, month, day: 1, second: 0.0 });
    (first(month + 1) - first(month)) as i64
}

/// The same time of day `months` later, or earlier for negative ones, on the month's last day where it has too few.
pub fn add_months(from: f64, months: i64) -> f64 {
    let mut to = date(from);
    let count = to.year * 12 + to.month - 1 + months.clamp(-1_000_000_000, 1_000_000_000);
    (to.year, to.month) = (count.div_euclid(12), count.rem_euclid(12) + 1);
    to.day = to.day.min(month_length(to.year, to.month));
    days(&to)
}

/// Days since J2000 as centuries of 36,525 days, the unit of ephemerides.
pub(super) fn centuries(days: f64) -> f64 {
    sane(days) / 36_525.0
}

/// Sine and cosine of degrees.
#[inline(never)]
pub(super) fn turned(degrees: f64) -> (f64, f64) {
    degrees.to_radians().sin_cos()
}
