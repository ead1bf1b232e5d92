//! Keyframes with easing, and cuts: from seconds to values.
//!
//! A table has one line a key: the time, then the values. Between keys runs Steffen's monotone cubic: the speed is
//! continuous, a value between two keys never leaves their range, so nothing swings past a wall, and two keys of the
//! same value hold it still. Catmull-Rom, which does neither, was the alternative.
//!
//! M. Steffen, "A simple method for monotonic interpolation in one dimension", Astronomy & Astrophysics 239, 1990.

/// A key: seconds, and the values there. Times ascend within a table.
pub type Key<const N: usize> = (f32, [f32; N]);

/// The values of a table at `time`: those of the first key before it and at NaN, of the last after it.
///
/// Panics where the table is empty.
pub fn sample<const N: usize>(keys: &[Key<N>], time: f64) -> [f32; N] {
    std::array::from_fn(|i| value(keys.len(), &|k| (keys[k].0, keys[k].1[i]), time))
}

/// One value of a table of `count` keys at `time`: `key` gives the seconds and the value of each.
#[inline(never)] // Else it is unrolled for each value.
fn value(count: usize, key: &dyn Fn(usize) -> (f32, f32), time: f64) -> f32 {
    // NaN is after no key.
    let next = (0..count).take_while(|&k| key(k).0 as f64 <= time).count();
    if next == 0 || next == count {
        return key(next.max(1) - 1).1;
    }
    let here = next - 1;
    let ((start, a), (end, b)) = (key(here), key(next));
    let length = end as f64 - start as f64;
    let x = ((time - start as f64) / length) as f32;
    let length = length as f32;
    let (from, to) = (slope(count, key, here) * length, slope(count, key, next) * length);
    // Hermite's cubic, written so that equal keys give their value exactly.
    let y = 1.0 - x;
    a + (b - a) * (x * x * (1.0 + 2.0 * y)) + (from * y - to * x) * (x * y)
}

/// Speed of that value at key `k`, a second.
fn slope(count: usize, key: &dyn Fn(usize) -> (f32, f32), k: usize) -> f32 {
    let interval = |k: usize| {
        let ((start, a), (end, b)) = (key(k), key(k + 1));
        (end - start, (b - a) / (end - start))
    };
    let last = count - 1;
    if k == 0 || k == last {
        // The parabola through the three keys of that end, as far as it is monotone; through two the line.
        let ((h, s), (h2, s2)) = match k {
            0 => (interval(0), interval(1.min(last - 1))),
            _ => (interval(last - 1), interval(last.max(2) - 2)),
        };
        let p = s + (s - s2) * (h / (h + h2));
        return if p * s <= 0.0 { 0.0 } else { p.abs().min(2.0 * s.abs()).copysign(s) };
    }
    let ((h0, s0), (h1, s1)) = (interval(k - 1), interval(k));
    if s0 * s1 <= 0.0 {
        return 0.0;
    }
    let p = (s0 * h1 + s1 * h0) / (h0 + h1);
    s0.abs().min(s1.abs()).min(0.5 * p.abs()).copysign(s0) * 2.0
}

/// 0 up to `from`, 1 from `to` on, at rest at both: Perlin's quintic. NaN is 0.
pub fn ease(from: f64, to: f64, time: f64) -> f32 {
    let x = (time - from) / (to - from);
    let x = if x > 0.0 { x.min(1.0) as f32 } else { 0.0 };
    x * x * x * (x * (x * 6.0 - 15.0) + 10.0)
}

/// The shot of a list of starts and shots that runs at `time`, and the seconds since its start.
///
/// The first before its start and at NaN; the last up to `end`, where it stops. Panics where the list is empty.
pub fn cut<T>(list: &[(f64, T)], end: f64, time: f64) -> (&T, f64) {
    let next = list.partition_point(|&(start, _)| start <= time).max(1);
    let (start, shot) = &list[next - 1];
    let end = list.get(next).map_or(end, |&(start, _)| start);
    (shot, (time - start).max(0.0).min(end - start))
}
