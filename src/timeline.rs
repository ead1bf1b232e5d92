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
#[inline(never)]
pub fn sample<const N: usize>(keys: &[Key<N>], time: f64) -> Key<N> {
    // NaN is after no key.
    let mut next = 0;
    while next < keys.len() && keys[next][0] as f64 <= time {
        next += 1;
    }
    let here = next.max(1) - 1;
    let mut line = keys[here];
    if next > 0 && next < keys.len() {
        let length = keys[next][0] - line[0];
        let x = (time - line[0] as f64) as f32 / length;
        let y = 1.0 - x;
        for (i, value) in line.iter_mut().enumerate() {
            let [from, to] = [here, next].map(|k| speed(keys, k, i) * length);
            // Hermite's cubic, written so that equal keys give their value exactly.
            *value += (keys[next][i] - *value) * (x * x * (1.0 + 2.0 * y)) + (from * y - to * x) * (x * y);
        }
    }
    line
}

/// Speed of value `i` at key `k`, a second: that of the parabola through three keys, at both ends too, as far as the
/// curve stays monotone; through two keys the line.
#[inline(never)]
fn speed<const N: usize>(keys: &[Key<N>], k: usize, i: usize) -> f32 {
    let last = keys.len() - 1;
    let mean = |k: usize| {
        let [a, b] = [k.min(last - 1), k.min(last - 1) + 1].map(|k| &keys[k]);
        (b[i] - a[i]) / (b[0] - a[0])
    };
    let time = |k: usize| keys[k.min(last)][0];
    let middle = k.clamp(1, last.max(2) - 1);
    let bend = (mean(middle) - mean(middle - 1)) / (time(middle + 1) - time(middle - 1));
    let speed = mean(middle - 1) + bend * (2.0 * time(k) - time(middle - 1) - time(middle));
    let (before, after) = (mean(k.max(1) - 1), mean(k));
    speed.max(2.0 * before.max(after).min(0.0)).min(2.0 * before.min(after).max(0.0))
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
    let mut next = 1;
    while next < list.len() && list[next].0 <= time {
        next += 1;
    }
    let (start, shot) = &list[next - 1];
    let end = list.get(next).map_or(end, |&(start, _)| start);
    (shot, (time - start).max(0.0).min(end - start))
}
