//! Decimal numbers read and printed, and templates filled.
//!
//! The standard library's parser and printer of floats are exact for every input, and bring 25 kB of tables and code
//! for that; its formatting brings more. A time on the command line and a figure in a table need neither.

/// What pads the first column of a table to 16 characters.
pub const SPACES: &[u8] = &[b' '; 16];

/// Fills a template: the next word takes the place of each `%`, and of each `#` too, but there it ends where the `#`
/// stands and covers the spaces before it, which aligns a column to the right.
pub fn fill(template: &str, words: &[&[u8]]) -> Vec<u8> {
    let (mut text, mut words) = (Vec::new(), words.iter());
    for byte in template.bytes() {
        if byte == b'%' || byte == b'#' {
            let word = words.next().copied().unwrap_or_default();
            if byte == b'#' {
                text.truncate(text.len() - word.len());
            }
            text.extend_from_slice(word);
        } else {
            text.push(byte);
        }
    }
    text
}

/// The value of a decimal such as `2` or `0.5`: no sign, no exponent, no `inf`, no `nan`.
///
/// With up to 15 digits and 22 places the result is the nearest `f64`, since the digits as a whole number and the power
/// of ten are both exact then and one division rounds once (Clinger, PLDI 1990). With more it may be off by a few units
/// in the last place.
pub fn decimal(text: &[u8]) -> Option<f64> {
    let (mut mantissa, mut scale) = (0u64, 0);
    let (mut digits, mut point) = (false, false);
    for &byte in text {
        match byte {
            b'0'..=b'9' => {
                digits = true;
                // Digits past the eighteenth no longer change the mantissa, only the power of ten; past 300 places they
                // change nothing.
                let kept = mantissa < 10u64.pow(18) && scale > -300;
                if kept {
                    mantissa = mantissa * 10 + u64::from(byte - b'0');
                }
                scale += i32::from(!kept) - i32::from(point);
            }
            b'.' if !point => point = true,
            _ => return None,
        }
    }
    if !digits {
        return None;
    }
    let power = (0..scale.unsigned_abs()).fold(1.0, |power: f64, _| power * 10.0);
    let value = if scale < 0 { mantissa as f64 / power } else { mantissa as f64 * power };
    value.is_finite().then_some(value)
}

/// The value of one or more digits, with nothing before or behind them; the largest `usize` where the value is larger.
pub fn whole(text: &[u8]) -> Option<usize> {
    let add = |sum: usize, byte: &u8| {
        byte.is_ascii_digit().then(|| sum.saturating_mul(10).saturating_add(usize::from(byte - b'0')))
    };
    if text.is_empty() { None } else { text.iter().try_fold(0, add) }
}

/// The decimal digits of a whole number.
pub fn digits(number: usize) -> Vec<u8> {
    let mut text = if number < 10 { Vec::new() } else { digits(number / 10) };
    text.push(b'0' + (number % 10) as u8);
    text
}

/// A figure with three decimals, or without any where all three are zero. Negative values print as zero.
pub fn figure(value: f64) -> Vec<u8> {
    let thousandths = (value * 1000.0 + 0.5) as usize;
    let whole = digits(thousandths / 1000);
    // The 1 before them keeps the leading zeros of the decimals.
    let decimals = &digits(1000 + thousandths % 1000)[1..];
    if decimals == b"000" { whole } else { fill("%.%", &[&whole, decimals]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_the_nearest_double() {
        for text in ["0", "2", "2.0", "0.1", ".5", "5.", "29.97", "0.30000000000000", "007"] {
            assert_eq!(
                decimal(text.as_bytes()).map(f64::to_bits),
                text.parse::<f64>().ok().map(f64::to_bits),
                "{text}"
            );
        }
    }

    #[test]
    fn printed_times_come_back() {
        for number in 1..100_000 {
            let time = f64::from(number) / 30.0;
            let read = decimal(time.to_string().as_bytes()).unwrap_or(f64::NAN);
            assert!((read - time).abs() <= 2.0 * time * f64::EPSILON, "{read}");
            assert_eq!(decimal(format!("{time:.11}").as_bytes()), format!("{time:.11}").parse().ok());
        }
    }

    #[test]
    fn long_decimals_are_within_some_last_places() {
        for text in ["123456789012345678901234567890", "0.000000000000000000000012345678901234567"] {
            let (ours, exact) = (decimal(text.as_bytes()).unwrap_or(f64::NAN), text.parse::<f64>().unwrap());
            assert!((ours - exact).abs() <= 8.0 * exact * f64::EPSILON, "{text}: {ours:e} {exact:e}");
        }
    }

    #[test]
    fn places_without_end_are_nothing_or_too_much() {
        let zeros = "0".repeat(400);
        assert_eq!(decimal(format!("0.{zeros}1").as_bytes()), Some(0.0));
        assert_eq!(decimal(format!("1{zeros}").as_bytes()), None);
        assert_eq!(decimal(format!("{zeros}1.5{zeros}").as_bytes()), Some(1.5));
        let little = format!("0.{}25{zeros}", &zeros[..200]);
        let (ours, exact) = (decimal(little.as_bytes()).unwrap(), little.parse::<f64>().unwrap());
        assert!((ours - exact).abs() <= 200.0 * exact * f64::EPSILON, "{ours:e} {exact:e}");
    }

    #[test]
    fn everything_else_is_refused() {
        for text in [
            "",
            ".",
            "-1",
            "+1",
            "-0",
            "nan",
            "NaN",
            "inf",
            "infinity",
            "1e3",
            "1e",
            "e5",
            "1.2.3",
            "1s",
            " 1",
            "0x1",
            "1e99999999999",
            "१",
        ] {
            assert_eq!(decimal(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn whole_numbers_are_digits() {
        for number in [0, 7, 10, 1024, usize::MAX] {
            assert_eq!((&*digits(number), whole(&digits(number))), (number.to_string().as_bytes(), Some(number)));
        }
        assert_eq!(whole(b"99999999999999999999"), Some(usize::MAX));
        for text in ["", "+1", "-1", "1.0", " 1", "x"] {
            assert_eq!(whole(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn figures_have_three_decimals_or_none() {
        assert_eq!(figure(0.0), b"0");
        assert_eq!(figure(1.0005), b"1.001");
        assert_eq!(figure(7.04), b"7.040");
        assert_eq!(figure(59.9999), b"60");
        assert_eq!(figure(-3.0), b"0");
    }
}
