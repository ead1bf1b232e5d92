//! Steps of the parameter `date`, which counts days from 1 January 2026 on.

/// Days of the months of 2026, and of 2027, which has as many.
const MONTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// Month and day of the month, both from 0, of a day counted from 1; months go on through the years.
fn split(day: u32) -> (u32, u32) {
    let (mut month, mut left) = (0, day.max(1) - 1);
    while left >= MONTHS[month as usize % 12] {
        left -= MONTHS[month as usize % 12];
        month += 1;
    }
    (month, left)
}

/// The day a number of months later, on the same day of the month or the last one; not before the first.
pub fn months_later(day: f64, months: i32) -> f64 {
    let (month, left) = split(day.round() as u32);
    let month = month.saturating_add_signed(months);
    let before: u32 = (0..month).map(|month| MONTHS[month as usize % 12]).sum();
    f64::from(before + left.min(MONTHS[month as usize % 12] - 1) + 1)
}

/// The date as words, such as `25 Jun 2026`.
pub fn words(day: f64) -> String {
    const NAMES: [&str; 12] = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];
    let (month, left) = split(day.floor() as u32);
    format!("{} {} {}", left + 1, NAMES[month as usize % 12], 2026 + month / 12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn months_have_their_days() {
        assert_eq!(words(1.0), "1 Jan 2026");
        assert_eq!(words(59.0), "28 Feb 2026");
        assert_eq!(words(60.0), "1 Mar 2026");
        assert_eq!(words(366.0), "1 Jan 2027");
        // The last of January is followed by the last of February.
        assert_eq!(words(months_later(31.0, 1)), "28 Feb 2026");
        assert_eq!(months_later(176.0, 12), 176.0 + 365.0);
        assert_eq!(months_later(10.0, -1), 10.0);
    }
}
