//! Keyframes with easing, and cuts: from seconds to values.
//!
//! A table has one line a key: the time, then the values. Between keys runs Steffen's monotone cubic: the speed is
//! continuous, a value between two keys never leaves their range, so nothing swings past a wall, and two keys of the
//! same value hold it still. Catmull-Rom, which does neither, was the alternative.
//!
//! M. Steffen, "A simple method for monotonic interpolation in one dimension", Astronomy & Astrophysics 239, 1990.

/// A key: seconds, then the values there. Times ascend within a table.
pub type Key<const N: usize> = [f32; N];

/// The line of a table at `time`: the first key before it and at NaN, the last after it.
///
/// Panics where the table is empty.
pub fn sample<const N: usize>(keys: &[Key<N>], time: f64) -> Key<N> {
    let mut line = [0.0; N];
    interpolate(keys.as_flattened(), time, &mut line);
    line
}

/// [`sample`] for a table whose lines are as long as `out`.
#[inline(never)]
fn interpolate(keys: &[f32], time: f64, out: &mut [f32]) {
    let n = out.len();
    let last = keys.len() / n - 1;
    // NaN is after no key.
    let mut next = 0;
    while next <= last && keys[next * n] as f64 <= time {
        next += 1;
    }
    let here = next.max(1) - 1;
    let x = (time - keys[here * n] as f64) as f32;
    for (i, value) in out.iter_mut().enumerate() {
        let a = keys[here * n + i];
        *value = a;
        if next > 0 && next <= last {
            let length = keys[next * n] - keys[here * n];
            let change = keys[next * n + i] - a;
            let [from, to] = [here, next].map(|k| slope(keys, n, k, i) * length);
            // Hermite's cubic, written so that equal keys give their value exactly.
            let x = x / length;
            let y = 1.0 - x;
            *value += change * (x * x * (1.0 + 2.0 * y)) + (from * y - to * x) * (x * y);
        }
    }
}

/// Speed of value `i` at key `k`, a second: that of the parabola through three keys, at both ends too, as far as the
/// curve stays monotone.
#[inline(never)]
fn slope(keys: &[f32], n: usize, k: usize, i: usize) -> f32 {
    let last = keys.len() / n - 1;
    let interval = |k: usize| {
        let [here, next] = [k * n, k * n + n];
        let length = keys[next] - keys[here];
        (length, (keys[next + i] - keys[here + i]) / length)
    };
    // Of three keys, `k` among them, and of two the line.
    let middle = k.clamp(1, last.max(2) - 1);
    let ((h0, s0), (h1, s1)) = (interval(middle - 1), interval(middle.min(last - 1)));
    let way = 2.0 * keys[k * n] - keys[(middle - 1) * n] - keys[middle * n];
    let p = s0 + (s1 - s0) / (h0 + h1) * way;
    let [(_, before), (_, after)] = [k.max(1) - 1, k.min(last - 1)].map(interval);
    p.max(2.0 * before.max(after).min(0.0)).min(2.0 * before.min(after).max(0.0))
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
