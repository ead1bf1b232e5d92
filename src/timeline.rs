//! Keyframes, easing and cuts: from seconds to values.
//!
//! A table of keys has a time and some values per line. Between the keys each value runs along Steffen's monotone cubic
//! `[Steffen90]`: its speed is continuous, and between two keys it never leaves their range. So nothing swings past a
//! wall, and two keys of the same value hold it still. Catmull-Rom, the alternative, does neither.

/// A key: its time in seconds, then the values at that time. Times ascend within a table.
pub type Key<const N: usize> = [f32; N];

/// The values of a table of keys at `time` seconds.
///
/// Before the first key, and where `time` is NaN, they are those of the first key; after the last key, those of the
/// last. The result's own time is interpolated as the values are. Panics where the table is empty.
pub fn sample<const N: usize>(keys: &[Key<N>], time: f64) -> Key<N> {
    let mut line = keys[0];
    blend(keys.as_flattened(), N, time, &mut line);
    line
}

/// [`sample`] for keys of `width` numbers.
#[inline(never)] // The code is there once, and not for each width.
fn blend(keys: &[f32], width: usize, time: f64, line: &mut [f32]) {
    let at = |key: usize, value: usize| keys[key * width + value];
    let last = keys.len() / width - 1;
    // The first key after `time`. NaN is after no key.
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
            // Lengths and mean speeds of this interval and of its neighbours, where there are any.
            let [(h0, s0), (h, s), (h1, s1)] = [here.max(1) - 1, here, next.min(last - 1)].map(|k| {
                let length = at(k + 1, 0) - at(k, 0);
                (length, (at(k + 1, i) - at(k, i)) / length)
            });
            // Speeds at both ends: those of parabolas through three keys. At the table's ends the parabola is the
            // neighbour's.
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

/// `speed` where intervals of the mean speeds `a` and `b` meet, limited so that the curve stays monotone in both.
#[inline(never)] // Called twice per value, never in a hot loop.
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

/// An ease from 0 at `from` seconds to 1 at `to` seconds, with no speed and no acceleration at either end: Perlin's
/// quintic `[Perlin02]`. A `time` of NaN gives 0.
#[inline(never)] // Called in many places, never in a hot loop.
pub fn ease(from: f64, to: f64, time: f64) -> f32 {
    let x = (time - from) / (to - from);
    let x = if x > 0.0 { x.min(1.0) as f32 } else { 0.0 };
    x * x * x * (x * (x * 6.0 - 15.0) + 10.0)
}

/// The shot that runs at `time`, of a list of shots with the seconds at which they start, and the seconds since its
/// start.
///
/// Before the first start, and where `time` is NaN, it is the start of the first shot. From `end` seconds on it is the
/// end of the last one, where time stops. Panics where the list is empty.
pub fn cut<T>(list: &[(f64, T)], end: f64, time: f64) -> (&T, f64) {
    let mut next = 1;
    while next < list.len() && list[next].0 <= time {
        next += 1;
    }
    let (start, shot) = &list[next - 1];
    let end = list.get(next).map_or(end, |&(start, _)| start);
    (shot, (time - start).max(0.0).min(end - start))
}
