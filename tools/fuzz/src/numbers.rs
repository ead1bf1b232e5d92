//! Decimals: read as the standard library reads them, or refused as the grammar says.

use crate::text::{decimal, digits, figure, fill, whole};
use std::str::from_utf8;

/// Units in the last place that a decimal of many digits or places may be off by. Its power of ten has up to 300 factors,
/// each of which rounds.
const LAST_PLACES: f64 = 400.0;
/// Digits and places up to which a decimal is the nearest double.
const EXACT: (usize, usize) = (15, 22);

pub fn run(bytes: &[u8]) {
    let dots = bytes.iter().filter(|byte| **byte == b'.').count();
    let count = bytes.iter().filter(|byte| byte.is_ascii_digit()).count();
    let is_decimal = count > 0 && dots <= 1 && count + dots == bytes.len();
    match decimal(bytes) {
        Some(ours) => {
            assert!(is_decimal, "no decimal is read as {ours:e}");
            let theirs: f64 = from_utf8(bytes).unwrap().parse().unwrap();
            let off = (ours - theirs).abs();
            // Places past the 300th are not looked at.
            assert!(off <= LAST_PLACES * theirs * f64::EPSILON + 1e-299, "{ours:e} for {theirs:e}");
            let places = bytes.iter().rev().position(|byte| *byte == b'.').unwrap_or(0);
            if count <= EXACT.0 && places <= EXACT.1 {
                assert_eq!(ours.to_bits(), theirs.to_bits());
            }
            figures(ours);
        }
        None if is_decimal => {
            let theirs: f64 = from_utf8(bytes).unwrap().parse().unwrap();
            assert!(theirs > 1e300, "{theirs:e} is refused");
        }
        None => {}
    }
    match whole(bytes) {
        Some(ours) => {
            let theirs = from_utf8(bytes).unwrap().parse::<u64>().unwrap_or(u64::MAX);
            assert_eq!(ours as u64, theirs);
            assert_eq!(digits(ours), ours.to_string().as_bytes());
        }
        None => assert!(bytes.is_empty() || count < bytes.len()),
    }
    // A word is filled in as it is.
    assert_eq!(fill("a%b", &[bytes]), [b"a", bytes, b"b"].concat());
}

/// A time in milliseconds is printed exactly as far as its thousandths are whole numbers of a double.
fn figures(value: f64) {
    if value < 1e12 {
        let thousandths = (value * 1000.0 + 0.5) as u64;
        let (whole, rest) = (thousandths / 1000, thousandths % 1000);
        let theirs = if rest == 0 { whole.to_string() } else { format!("{whole}.{rest:03}") };
        assert_eq!(figure(value), theirs.as_bytes());
        assert_eq!(decimal(&figure(value)), theirs.parse().ok());
    }
}
