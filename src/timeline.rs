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
    let mut line = keys[0];
    blend(keys.as_flattened(), N, time, &mut line);
    line
}

/// The same for a table with keys of `width` numbers: once, and not for each width.
#[inline(never)]
fn blend(keys: &[f32], width: usize, time: f64, line: &mut [f32]) {
    let at = |key: usize, value: usize| keys[key * width + value];
    let last = keys.len() / width - 1;
    // NaN is after no key.
    let mut next = 0;
    while next <= last && at(next, 0) as f64 <= time {
        next += 1;
    }
    let here = next.max(1) - 1;
    let x =
        if next > 0 && next <= last { (time - at(here, 0) as f64) as f32 / (at(next, 0) - at(here, 0)) } else { 0.0 };
    let y = 1.0 - x;
    for (i, value) in line.iter_mut().enumerate() {
        *value = at(here, i);
        if next > 0 && next <= last {
            // This interval, and its neighbours if there are: their lengths and mean speeds.
            let [(h0, s0), (h, s), (h1, s1)] = [here.max(1) - 1, here, next.min(last - 1)].map(|k| {
                let length = at(k + 1, 0) - at(k, 0);
                (length, (at(k + 1, i) - at(k, i)) / length)
            });
            // The parabola's speed at both ends; the first and the last are those of its neighbour's.
            let (mut from, mut to) = ((s0 * h + s * h0) / (h0 + h), (s * h1 + s1 * h) / (h + h1));
            if here == 0 {
                from = 2.0 * s - to;
            }
            if next == last {
                to = 2.0 * s - from;
            }
            // Hermite's cubic, written so that equal keys give their value exactly.
            *value +=
                h * (s * (x * x * (1.0 + 2.0 * y)) + (monotone(from, s0, s) * y - monotone(to, s, s1) * x) * (x * y));
        }
    }
}

/// A speed where intervals of two mean speeds meet, as far as the curve stays monotone in both.
#[inline(never)]
fn monotone(speed: f32, a: f32, b: f32) -> f32 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let most = if low > 0.0 { 2.0 * low } else { 0.0 };
    let least = if high < 0.0 { 2.0 * high } else { 0.0 };
    if speed < least {
        least
    } else if speed > most {
        most
    } else {
        speed
    }
}

/// 0 up to `from`, 1 from `to` on, at rest at both: Perlin's quintic. NaN is 0.
#[inline(never)] // Called in many places, never in a hot loop.
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
