//! Lookups of a depth map against the area of the lit texels around a point.

use testkit::depth_map::{lit, place, random_map, truth};
use testkit::random::Random;

#[test]
fn a_lookup_is_the_lit_share_of_the_texels_around() {
    let mut random = Random(1);
    for size in [64, 128] {
        let (map, depths) = random_map(&mut random, size);
        for case in 0..600 {
            // Whole and half texels, and beyond the map.
            let (at, view) = (place(&mut random, case, size), case % 2);
            // Now and then as near as a texel.
            let near = if case % 5 == 0 { depths[view][case % (size * size)] } else { random.unit() as f32 };
            for smooth in [false, true] {
                let truth = truth(&depths[view], size, at.map(f64::from), near, smooth);
                for (name, level) in testkit::levels() {
                    let found = lit(level, &map, view, at, near, smooth);
                    // Sums of sixteen weights, each rounded where the place is.
                    let slack = if smooth { 1e-6 * (1.0 + size as f64) } else { 1e-7 };
                    let right = (found as f64 - truth).abs() <= slack;
                    assert!(right, "{name}, {size}, {smooth}: {found} instead of {truth} at {at:?}");
                }
            }
        }
    }
}
