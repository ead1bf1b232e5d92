//! Keyframes: exact at the keys, smooth between them, quiet beyond them.

use paprsek::timeline::{Key, cut, ease, sample};
use proptest::prelude::*;

const KEYS: &[Key<3>] = &[[1.0, 0.0, 5.0], [2.0, 1.0, 5.0], [4.5, 7.0, -3.0], [5.0, 7.0, 0.25], [9.0, -2.0, 0.5]];

#[test]
fn keys_are_exact() {
    for &key in KEYS {
        assert_eq!(sample(KEYS, key[0] as f64), key);
    }
}

#[test]
fn beyond_the_ends_the_ends() {
    for time in [f64::NEG_INFINITY, -1e300, -1.0, 0.999, f64::NAN] {
        assert_eq!(sample(KEYS, time), KEYS[0], "{time}");
    }
    for time in [9.0, 9.001, 1e300, f64::INFINITY] {
        assert_eq!(sample(KEYS, time), KEYS[4], "{time}");
    }
    assert_eq!(sample(&[[3.0, 4.0]], 8.0), [3.0, 4.0]);
    assert_eq!(sample(&[[3.0, 4.0]], f64::NAN), [3.0, 4.0]);
}

#[test]
fn two_keys_are_a_line() {
    let keys = [[0.0, 1.0], [4.0, 3.0]];
    for n in 0..=16 {
        let time = n as f64 / 4.0;
        assert!((sample(&keys, time)[1] as f64 - (1.0 + time / 2.0)).abs() < 1e-6);
    }
}

#[test]
fn equal_keys_hold_still() {
    for n in 0..=100 {
        assert_eq!(sample(KEYS, 1.0 + n as f64 / 100.0)[2], 5.0);
    }
}

#[test]
fn speed_is_continuous() {
    // One-sided differences over h differ by O(h) where the speed is continuous, by the jump where it is not.
    let h = 1e-2;
    for &[time, ..] in &KEYS[1..KEYS.len() - 1] {
        let [before, at, after] = [-h, 0.0, h].map(|d| sample(KEYS, time as f64 + d));
        for i in 1..3 {
            let (left, right) = ((at[i] - before[i]) as f64 / h, (after[i] - at[i]) as f64 / h);
            assert!((left - right).abs() < 0.6, "at {time}: {left} and {right}");
        }
    }
}

#[test]
fn late_times_keep_their_precision() {
    // A frame at 60 Hz after a day of playing.
    let keys = [[86_400.0, 0.0], [86_401.0, 1.0]];
    let value = sample(&keys, 86_400.0 + 1.0 / 60.0)[1];
    assert!((value - 1.0 / 60.0).abs() < 1e-6, "{value}");
}

#[test]
fn ease_rests_at_both_ends() {
    for (time, value) in [(-5.0, 0.0), (2.0, 0.0), (3.0, 0.5), (4.0, 1.0), (1e9, 1.0), (f64::NAN, 0.0)] {
        assert_eq!(ease(2.0, 4.0, time), value, "{time}");
    }
    assert!(ease(2.0, 4.0, 2.02) < 1e-4 && ease(2.0, 4.0, 3.98) > 1.0 - 1e-4);
}

#[test]
fn cuts_are_where_they_are_listed() {
    let list = [(0.0, 'a'), (10.0, 'b'), (15.0, 'c')];
    let at = |time| {
        let (&shot, local) = cut(&list, 20.0, time);
        (shot, local)
    };
    assert_eq!(at(0.0), ('a', 0.0));
    assert_eq!(at(9.5), ('a', 9.5));
    assert_eq!(at(10.0), ('b', 0.0));
    assert_eq!(at(15.5), ('c', 0.5));
    assert_eq!(at(1e300), ('c', 5.0));
    assert_eq!(at(f64::INFINITY), ('c', 5.0));
    assert_eq!(at(-1.0), ('a', 0.0));
    assert_eq!(at(f64::NAN), ('a', 0.0));
}

proptest! {
    #[test]
    fn never_beyond_the_keys(
        values in prop::collection::vec(-100f32..100.0, 2..8),
        gaps in prop::collection::vec(0.01f32..10.0, 8),
        share in 0f64..1.0,
    ) {
        let mut time = 0.0;
        let keys: Vec<Key<2>> = values.iter().zip(gaps).map(|(&v, gap)| { time += gap; [time, v] }).collect();
        for pair in keys.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let value = sample(&keys, a[0] as f64 + share * (b[0] - a[0]) as f64)[1];
            let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
            prop_assert!(value >= low - 1e-4 && value <= high + 1e-4, "{value} outside {low}..{high}");
        }
    }

    #[test]
    fn any_time_does_not_panic(time in any::<f64>()) {
        prop_assert!(sample(KEYS, time).iter().all(|v| v.is_finite()));
        prop_assert!((0.0..=1.0).contains(&ease(1.0, 2.0, time)));
    }
}
