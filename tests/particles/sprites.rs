//! Sprites in awkward places, before and in solids, across tiles, in colours and in great numbers.

use glam::{DVec3, Vec3A, vec3a};
use paprsek::frame::Renderer;
use paprsek::particles::{Emitter, Fire, Flakes, Lens, ParticleLayer};
use paprsek::scenes::bench::particles::{self, fires, flakes};
use paprsek::settings::Quality;
use testkit::levels;
use testkit::particles::{FLAKES, random, snow_beside};
use testkit::sprites::{Behind, Size, burn, draw, dusk, off, same, snow, still, truth, view, worst};

/// Light, where places on the screen are good to some 1e-5 pixels and sprites are about a pixel large, or larger.
const PLACES: f64 = 1e-4;
/// Light of nothing: film takes the light behind from 1 and back.
const NOTHING: f64 = 1e-7;
/// Four tiles and parts of others.
const SIZE: Size = (150, 140);
/// For many particles.
const WIDE: Size = (320, 180);
/// Where the eye of `snow` looks after two seconds: `(sin .6, .08 sin 1, cos .6)`.
const WALK: Vec3A = vec3a(0.564_642_5, 0.067_317_68, 0.825_335_6);
/// A stream of random numbers for tests.
const STREAM: u32 = 9;

/// A number from -1 to 1 of a test's thing.
fn between(i: u32, k: u32) -> f32 {
    (2.0 * random(STREAM, i, k) - 1.0) as f32
}

/// Burns before an eye in the origin that looks along -z, and what that should be.
fn both(fires: &[Fire], exposure: f32) -> (Vec<Vec3A>, Vec<DVec3>) {
    let (eye, forward) = (Vec3A::ZERO, Vec3A::NEG_Z);
    let found = burn(fires, exposure, eye, forward, SIZE, dusk);
    (found, truth(fires, f64::from(exposure), eye, forward, SIZE, dusk))
}

/// Sprites of all colours and sizes anywhere before the eye, some of them beside the picture.
fn colours(count: u32) -> Vec<Fire> {
    let one = |i: u32| {
        // From 0.4 to 50 metres, each further away than the one before.
        let depth = 0.4 * 125f32.powf((i as f32 + between(i, 7) * 0.4 + 0.5) / count as f32);
        let place = vec3a(between(i, 0) * 0.6, between(i, 1) * 0.6, -1.0) * depth;
        let light = vec3a(between(i, 2).abs(), between(i, 3).abs(), between(i, 4).abs());
        still(place, depth * (0.01 + 0.12 * between(i, 5).abs()), light)
    };
    (0..count).map(one).collect()
}

#[test]
fn a_sprite_is_its_disc() {
    for radius in [0.01, 0.1, 1.0, 10.0] {
        let (found, truth) = both(&[still(vec3a(0.3, -0.2, -4.0), radius, vec3a(0.2, 0.4, 0.6))], 1.0);
        let off = worst(&found, &truth);
        assert!(off < PLACES, "radius {radius}: {off}");
    }
}

#[test]
fn nothing_is_seen_of_what_is_nowhere() {
    const NAN: f32 = f32::NAN;
    const INFINITE: f32 = f32::INFINITY;
    let good = still(vec3a(0.0, 0.0, -3.0), 0.5, Vec3A::ONE);
    let at = |x, y, z| Fire { place: vec3a(x, y, z), ..good };
    let mut cases = vec![
        ("behind the eye", at(0.0, 0.0, 3.0)),
        ("in the eye", at(0.0, 0.0, 0.0)),
        ("beside the eye", at(1.0, 0.0, 0.0)),
        ("on the near plane", at(0.0, 0.0, -0.25)),
        ("before the near plane", at(0.0, 0.0, -0.249)),
        ("beside the picture", at(9.0, 0.0, -3.0)),
        ("above the picture", at(0.0, 9.0, -3.0)),
        ("not a number of light", Fire { weight: NAN, ..good }),
        ("no light", Fire { weight: 0.0, ..good }),
        ("no particle", Fire { count: 0.0, ..good }),
        ("of no size", Fire { scale: 0.0, ..good }),
        ("not a size", Fire { scale: NAN, ..good }),
        ("at no time", Fire { time: f64::NAN, ..good }),
        ("at the end of time", Fire { time: f64::INFINITY, ..good }),
    ];
    for bad in [NAN, INFINITE, -INFINITE] {
        cases.extend([("x", at(bad, 0.0, -3.0)), ("y", at(0.0, bad, -3.0)), ("z", at(0.0, 0.0, bad))]);
    }
    for far in [1e20, -1e20, 1e38, -1e38, f32::MAX] {
        cases.extend([("x", at(far, 0.0, -3.0)), ("y", at(0.0, far, -3.0)), ("z", at(0.0, 0.0, -far.abs()))]);
    }
    // With and without something else in the picture.
    for others in [vec![], colours(40)] {
        let (without, _) = both(&others, 1.0);
        for (name, case) in &cases {
            let (with, _) = both(&[&others[..], &[*case]].concat(), 1.0);
            let off = off(&without, &with);
            assert!(off < NOTHING, "{name}: {off} by {case:?}");
        }
    }
}

#[test]
fn sprites_near_the_eye_cover_what_they_should() {
    let cases = [
        ("just past the near plane", vec3a(0.01, 0.0, -0.2501), 0.05),
        ("all of the picture", vec3a(0.0, 0.0, -0.3), 1.0),
        ("a middle far to the left", vec3a(-20.0, 0.5, -1.0), 20.3),
        ("a middle far above", vec3a(0.1, 50.0, -1.0), 50.2),
        ("only a corner", vec3a(0.52, 0.47, -1.0), 0.05),
        ("a hundred thousand pixels", vec3a(0.0, -300.0, -0.5), 300.1),
    ];
    for (name, place, radius) in cases {
        let (found, truth) = both(&[still(place, radius, vec3a(0.3, 0.5, 0.7))], 1.0);
        let off = worst(&found, &truth);
        println!("{name}: {off:.1e}");
        // Of middles that many pixels away the last bits are missing.
        assert!(off < PLACES.max(f64::from(radius) * 1e-4), "{name}: {off}");
    }
}

/// A sprite of any size whatever is a sprite.
#[test]
fn a_sprite_may_be_as_large_as_it_likes() {
    for radius in [1e6, 1e9, 1e12, 1e18] {
        let (found, truth) = both(&[still(vec3a(0.0, 0.0, -3.0), radius, vec3a(0.3, 0.5, 0.7))], 1.0);
        let off = worst(&found, &truth);
        assert!(off < PLACES, "{radius} metres: {off}");
    }
}

/// Light is light where it has no red.
#[test]
fn a_sprite_may_be_of_any_colour() {
    for light in [Vec3A::X, Vec3A::Y, Vec3A::Z] {
        let (found, truth) = both(&[still(vec3a(0.0, 0.0, -3.0), 0.5, light)], 1.0);
        let off = worst(&found, &truth);
        assert!(off < PLACES, "{light}: {off}");
    }
}

#[test]
fn a_lens_limits_what_is_small_and_near() {
    let lens = particles::FLAKES.lens;
    assert_eq!((lens.radius, lens.near), ([1.0, 24.0], [0.25, 1.0]));
    let few = |depth: f32| Fire { lens, ..still(vec3a(0.1, 0.02, -1.0) * depth, 0.05, Vec3A::ONE) };
    for depth in [0.2501, 0.3, 0.6, 0.999, 1.0, 3.0, 20.0, 100.0] {
        let (found, truth) = both(&[few(depth)], 1.0);
        let off = worst(&found, &truth);
        assert!(off < PLACES, "{depth} metres: {off}");
    }
}

/// The circle of confusion of a lens of 5 cm that is focused on 4 metres, and the same light in it.
#[test]
fn a_lens_blurs_what_is_near() {
    let lens = Lens { aperture: 0.05, focus: 4.0, ..fires(0.0)[0].lens };
    for depth in [0.3, 1.0, 3.99, 4.0, 8.0] {
        for radius in [1e-3, 0.1] {
            let fire = Fire { lens, ..still(vec3a(0.05, 0.02, -1.0) * depth, radius, Vec3A::ONE) };
            let (found, truth) = both(&[fire], 1.0);
            let off = worst(&found, &truth);
            assert!(off < PLACES, "{radius} at {depth} metres: {off}");
        }
    }
}

#[test]
fn what_only_shines_has_any_order() {
    /// Sums of 400 numbers in f32.
    const ROUNDING: f64 = 3e-6;
    let mut fires = colours(400);
    let (found, truth) = both(&fires, 0.2);
    assert!(worst(&found, &truth) < PLACES);
    fires.reverse();
    let reversed = both(&fires, 0.2).0;
    let off = off(&reversed, &found);
    assert!(off < ROUNDING, "{off}");
}

/// Solids to the left, beside them nothing; a slope, and steps from before the sprite to far behind it.
fn solids(x: usize, y: usize) -> (Vec3A, Option<f32>) {
    let depth = match y / 20 {
        0 => 1.0,
        1 => 2.999,
        2 => 3.1,
        3 => 3.25,
        4 => 3.75,
        5 => 4.5,
        _ => 2.0 + 0.02 * x as f32,
    };
    (Vec3A::new(0.1, 0.2, 0.3), (x < 100).then_some(depth))
}

#[test]
fn solids_hide_sprites_softly() {
    for radius in [0.5, 5.0, 1e-3] {
        // So that the fade is that of its radius: all of it is before 3 metres and behind.
        let light = vec3a(0.8, 0.3, 0.5);
        let fires = [still(vec3a(0.0, 0.0, -3.0), radius, light), still(vec3a(0.4, 0.0, -3.5), radius, light)];
        let found = burn(&fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, solids);
        let truth = truth(&fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, solids);
        let off = worst(&found, &truth);
        println!("radius {radius}: {off:.1e}");
        assert!(off < PLACES, "radius {radius}: {off}");
    }
}

/// Where a solid is nearer than a sprite's middle nothing of it is there, to the bit; where none is near, all of it.
#[test]
fn depth_is_tested_exactly() {
    const GREY: Vec3A = Vec3A::splat(0.25);
    let one = [still(vec3a(0.0, 0.0, -3.0), 0.5, vec3a(0.8, 0.3, 0.5))];
    let wall = |fires: &[Fire], behind: Behind| burn(fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, behind);
    let without = wall(&[], |_, _| (GREY, None));
    let whole = wall(&one, |_, _| (GREY, None));
    assert!(same(&without, &[GREY; SIZE.0 * SIZE.1]), "no particles change nothing");
    assert!(same(&wall(&one, |_, _| (GREY, Some(2.9999))), &without), "a wall before it");
    assert!(same(&wall(&one, |_, _| (GREY, Some(3.0))), &without), "a wall in it");
    assert!(same(&wall(&one, |_, _| (GREY, Some(3.5001))), &whole), "a wall behind it");
    assert!(!same(&whole, &without));
}

/// Tiles begin elsewhere in a wider picture of the same height, and nothing else changes.
#[test]
fn there_are_no_seams_between_tiles() {
    /// Columns are counted from another edge, so a middle's last bit differs.
    const ROUNDING: f64 = 2e-5;
    const HEIGHT: usize = 140;
    let fires = colours(200);
    let narrow = burn(&fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, (150, HEIGHT), |_, _| (Vec3A::splat(0.2), None));
    for more in [1, 16, 31, 40] {
        let width = 150 + 2 * more;
        let wide = burn(&fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, (width, HEIGHT), |_, _| (Vec3A::splat(0.2), None));
        let middle: Vec<DVec3> =
            wide.chunks(width).flat_map(|row| row[more..more + 150].iter().map(|c| c.as_dvec3())).collect();
        let off = worst(&narrow, &middle);
        assert!(off < ROUNDING, "{more} columns more: {off}");
    }
}

#[test]
fn every_level_and_thread_count_gives_the_same_light() {
    let mut first = None;
    for (name, level) in levels() {
        for threads in [1, 2, 3] {
            let view = view(Vec3A::ZERO, Vec3A::NEG_Z, SIZE);
            let particles = ParticleLayer::new(
                colours(150).into_iter().map(Emitter::Fire).collect(),
                &view,
                &Quality::EXACT.particles,
            );
            let mut renderer = Renderer::new(threads).unwrap().at_level(level);
            let found = draw(&mut renderer, particles, SIZE, solids);
            assert!(same(first.get_or_insert(found.clone()), &found), "{name}, {threads} threads");
        }
    }
}

/// Flakes are where they are, from wherever one looks: so they are for two eyes.
#[test]
fn flakes_stay_where_they_are_as_the_eye_moves() {
    for beside in [Vec3A::ZERO, vec3a(0.03, 0.0, -0.01), vec3a(-7.0, 3.0, 11.0)] {
        let found = snow(flakes(&particles::FLAKES, 2.0, beside), beside, WALK, WIDE);
        let off = worst(&found, &snow_beside(2.0, WIDE, 0..FLAKES, beside.as_dvec3()));
        println!("{beside} metres away: {off:.1e}");
        assert!(off < PLACES, "{beside}: {off}");
    }
}

/// A million flakes at once, and a million sparks of a hundredth of the light.
#[test]
fn a_million_particles_are_as_exact() {
    const MANY: u32 = 1_000_000;
    let found = snow(flakes(&Flakes { count: MANY, ..particles::FLAKES }, 2.0, Vec3A::ZERO), Vec3A::ZERO, WALK, WIDE);
    let off = worst(&found, &snow_beside(2.0, WIDE, 0..MANY, DVec3::ZERO));
    println!("a million flakes: {off:.1e}");
    assert!(off < PLACES, "{off}");

    let torch = [Fire { count: MANY as f32, weight: 2e-3, ..fires(2.0)[0] }];
    let (eye, forward) = (torch[0].place + vec3a(1.0, 1.0, 4.0), vec3a(-0.2, 0.0, -1.0));
    let found = burn(&torch, 1.6, eye, forward, WIDE, dusk);
    let off = worst(&found, &truth(&torch, 1.6, eye, forward, WIDE, dusk));
    println!("a million sparks: {off:.1e}");
    assert!(off < PLACES, "{off}");
}
