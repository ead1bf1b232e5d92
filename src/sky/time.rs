//! The calendar: civil dates and days since J2000.
//!
//! A time is an `f64` of days since J2000 (2000-01-01 12:00 UT) everywhere in the sky. Its rounding is 0.1 ms in 1900
//! to 2100, where an `f32` would be off by minutes. The sky is a function of that number alone, so any speed, direction
//! or jump through time is one addition: an hour is 1/24, a day is 1.
//!
//! The time is UT. The ephemerides want terrestrial time, which was 64 s ahead in 2000 and may be 200 s ahead in 2100.
//! The difference is left out: in it the sun moves by 0.001 (0.0025) degrees, the moon by 0.01 (0.03).

/// A date of the Gregorian calendar, extended to before its adoption.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Date {
    /// Astronomical year: the year before 1 is 0.
    pub year: i64,
    /// Month, 1 to 12.
    pub month: i64,
    /// Day of the month, from 1 on.
    pub day: i64,
    /// Seconds since midnight UT, 0 to 86,400. There are no leap seconds.
    pub second: f64,
}

impl Date {
    /// The date at a time in days since J2000. NaN and times beyond 10^9 days count as 0.
    pub fn at(days: f64) -> Date {
        let days = sane(days);
        let midnight = (days + 0.5).floor();
        // Day 0 of this count is 1 March of year 0. An era is the calendar's period of 400 years.
        let day = midnight as i64 + MARCH_0;
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

    /// The date as days since J2000; see [`days`] for months and days out of range.
    pub const fn days(&self) -> f64 {
        days(self.year, self.month, self.day) + self.second / 86_400.0
    }
}

/// A number to the 24 bits of an `f32`, which has half as many bytes that are not zeros: for what need not be known
/// better than to 6e-8 of it.
pub(super) const fn short(x: f64) -> f64 {
    x as f32 as f64
}

/// The day on which J2000's noon lies, 2000-01-01, counted from 1 March of year 0.
const MARCH_0: i64 = 730_425;

/// Midnight UT at the start of a date, in days since J2000: `days(2026, 6, 25)` is 9671.5. Months out of 1 to 12 run on
/// into other years, days out of their month into other months.
///
/// By `[Hinnant13]`: years begin in March, so that the leap day is a year's last. The years' absolute value is to be
/// below 10^9.
pub const fn days(year: i64, month: i64, day: i64) -> f64 {
    let months = year * 12 + month - 3;
    let (year, month) = (months.div_euclid(12), months.rem_euclid(12));
    let leaps = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    let day = year * 365 + leaps + (month * 153 + 2) / 5 + day;
    // `day` counts from 1; J2000 is the noon of its day.
    (day - 1 - MARCH_0) as f64 - 0.5
}

/// A time or an angle as it is, or 0 for NaN and what is beyond 10^9, so that no function behind this one need check.
pub(super) fn sane(x: f64) -> f64 {
    if x.abs() < 1e9 { x } else { 0.0 }
}

/// Days since J2000 as Julian centuries of 36,525 days, the unit of ephemerides.
pub(super) fn centuries(days: f64) -> f64 {
    sane(days) / 36_525.0
}

/// Sine and cosine of an angle in degrees.
#[inline(never)] // Called in many places, never in a hot loop.
pub(super) fn turned(degrees: f64) -> (f64, f64) {
    degrees.to_radians().sin_cos()
}
