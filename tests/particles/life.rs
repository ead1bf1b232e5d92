//! Birth, death and what comes between, at any time.

use glam::{DVec3, Vec3A, vec3a};
use paprsek::particles::{Fire, Flakes, Snow};
use paprsek::scenes::bench::particles::{self, fires};
use testkit::particles::random;
use testkit::sprites::{Size, burn, dusk, off, same, snow, truth, worst};

const SIZE: Size = (128, 72);
/// As in the tests of sprites.
const PLACES: f64 = 1e-4;
/// Light of nothing: film takes the light behind from 1 and back.
const NOTHING: f64 = 1e-7;

/// The torch that the eye looks at, from 4 metres.
fn seen(fire: Fire) -> Vec<Vec3A> {
    let (eye, forward) = from(&fire);
    burn(&[fire], 1.6, eye, forward, SIZE, dusk)
}

fn from(fire: &Fire) -> (Vec3A, Vec3A) {
    (fire.place + vec3a(0.0, 0.8, 4.0), vec3a(0.0, -0.05, -1.0))
}

fn should_be(fire: Fire) -> Vec<DVec3> {
    let (eye, forward) = from(&fire);
    truth(&[fire], 1.6, eye, forward, SIZE, dusk)
}

fn nothing() -> Vec<Vec3A> {
    seen(Fire { count: 0.0, ..fires(0.0)[0] })
}

/// One bright particle that moves and changes, and the time of one of its births.
fn one(generation: f64) -> (Fire, f64) {
    let mut fire = Fire { count: 1.0, first: 77, weight: 20.0, ..fires(0.0)[0] };
    fire.flame.life = [0.75, 0.5];
    let life = 0.75 + 0.5 * random(fire.seed, 77, 0);
    (fire, (generation - random(fire.seed, 77, 1)) * life)
}

#[test]
fn a_particle_is_what_its_life_says() {
    for generation in [-1e6, -1.0, 0.0, 1.0, 1e6] {
        let (fire, birth) = one(generation);
        for age in [0.001, 0.1, 0.3, 0.5, 0.7] {
            let fire = Fire { time: birth + age, ..fire };
            let off = worst(&seen(fire), &should_be(fire));
            assert!(off < PLACES, "generation {generation}, {age} s old: {off}");
        }
    }
}

/// It comes from nothing and goes to nothing, and from one generation to the next nothing jumps.
#[test]
fn light_begins_and_ends_at_nothing() {
    for generation in [-1e6, -3.0, 0.0, 1.0, 1000.0] {
        let (fire, birth) = one(generation);
        let bright = |time: f64| off(&seen(Fire { time, ..fire }), &nothing());
        assert!(bright(birth + 0.3) > 0.05);
        // Light grows as 30 x and ends as 30 (1 - x)^2, times the weight of 20, 0.008 and 1.6.
        for after in [1e-2, 1e-4, 1e-6] {
            let (born, dies) = (bright(birth + after), bright(birth - after));
            assert!(born < 12.0 * after + 2e-7, "{after} s after birth {generation}: {born}");
            assert!(dies < 20.0 * after * after + 2e-7, "{after} s before death: {dies}");
        }
    }
}

/// The difference between two instants is at most in proportion to what is between them, births and deaths included.
#[test]
fn pictures_change_as_little_as_time() {
    /// Light a second: two thousand sparks in a few pixels.
    const FASTEST: f64 = 10.0;
    for time in [3.0, -3.0, 1000.0] {
        for instant in 0..6 {
            let time = time + 0.0137 * f64::from(instant);
            let torch = Fire { time, ..fires(0.0)[0] };
            let before = seen(torch);
            for dt in [1e-2, 1e-3, 1e-4, 1e-5] {
                let off = off(&seen(Fire { time: time + dt, ..torch }), &before);
                assert!(off < FASTEST * dt + 2e-5, "{dt} s from {time}: {off}");
            }
        }
    }
}

#[test]
fn lives_may_be_short() {
    let (mut fire, _) = one(0.0);
    for (life, chance) in [(0.0, 0.0), (1e-300, 0.0), (f64::MIN_POSITIVE, 0.0), (1e-9, 0.0), (0.0, 1e-12)] {
        for time in [-1e9, -2.0, 0.0, 0.3, 1e9] {
            fire.flame.life = [life, chance];
            let light = seen(Fire { time, ..fire });
            assert!(light.iter().all(|c| c.is_finite()), "{life} {chance} at {time} s");
            if life == 0.0 && chance == 0.0 {
                assert!(same(&light, &nothing()), "who does not live is not seen, at {time} s");
            }
        }
    }
    // And where it is short, but f64 still knows the phase.
    fire.flame.life = [1e-6, 1e-6];
    for time in [0.2, 1.0 + 0.3e-6, -2.0] {
        let fire = Fire { time, ..fire };
        assert!(worst(&seen(fire), &should_be(fire)) < PLACES, "{time} s");
    }
}

/// A share of a life that is less than 1 in f64 becomes 1 in f32, and less than 0 becomes 1 in f64: both are its end.
#[test]
fn phases_that_round_to_one_are_dark() {
    // The particle whose first birth is at 0: one in 2^24 is.
    let stream = (0..255).flat_map(|seed| (0..200_000).map(move |i| (seed, i)));
    let (seed, first) = stream.into_iter().find(|(seed, i)| random(*seed, *i, 1) == 0.0).expect("one of 51 million");
    let (mut fire, _) = one(0.0);
    fire.flame.life = [1.0, 0.0];
    let fire = Fire { seed, first, ..fire };
    for time in [0.0, -0.0, -1e-300, -1e-20, -1e-17, -1e-12, 1.0 - 1e-12, 1.0, 1e-300, 1e-12, 1e9, -1e9] {
        let light = off(&seen(Fire { time, ..fire }), &nothing());
        assert!(light < NOTHING, "{light} at {time} s");
    }
    assert!(!same(&seen(Fire { time: 0.3, ..fire }), &nothing()));
}

/// A fire may grow: from one particle to the next nothing jumps, and each count is what it should be.
#[test]
fn fires_grow_smoothly() {
    let torch = fires(2.0)[0];
    let (mut last, mut most) = (None::<Vec<Vec3A>>, 0.0f64);
    for step in 0..30 {
        let fire = Fire { count: 20.0 + step as f32 * 0.1, weight: 10.0, ..torch };
        let found = seen(fire);
        assert!(worst(&found, &should_be(fire)) < PLACES, "{}", fire.count);
        if let Some(last) = last {
            most = most.max(off(&found, &last));
        }
        last = Some(found);
    }
    // A tenth of a particle of the greatest light at a time.
    assert!(most < 0.1 * 1.6 * 10.0 * 0.008 * 40.0 / 9.0 + 1e-5, "{most}");
}

/// A snowfall that sets in: as smoothly.
#[test]
fn snow_sets_in_smoothly() {
    /// Light of 0.8, of which a flake takes 0.85, in ten or more steps: 0.2 would be a flake at once.
    const GRADUAL: f64 = 0.07;
    let draw = |share: f32| {
        let field = Snow::new(&particles::FLAKES, 2.0, DVec3::ZERO, DVec3::ZERO, share);
        snow(field, Vec3A::ZERO, Vec3A::Z, SIZE)
    };
    let mean = |light: &[Vec3A]| light.iter().map(|c| f64::from(c.x)).sum::<f64>() / light.len() as f64;
    let none = Snow::new(&Flakes { opacity: 0.0, ..particles::FLAKES }, 2.0, DVec3::ZERO, DVec3::ZERO, 1.0);
    let (none, all) = (mean(&snow(none, Vec3A::ZERO, Vec3A::Z, SIZE)), mean(&draw(1.0)));
    assert!(all > none + 0.01, "{none} {all}");
    // Flakes hide each other, so it is not quite in proportion: but never less.
    let mut last = none - 1e-9;
    for share in [0.0, 0.1, 0.3, 0.5, 0.9, 0.99, 1.0] {
        let light = mean(&draw(share));
        println!("share {share}: {:.4} of all", (light - none) / (all - none));
        assert!(light >= last, "share {share}");
        last = light;
    }
    let before = snow(Snow::new(&particles::FLAKES, 2.0, DVec3::ZERO, DVec3::ZERO, 0.0), Vec3A::ZERO, Vec3A::Z, SIZE);
    assert_eq!(mean(&before), none, "before it snows it does not");
    // Large ones, few enough that each can be told from the next.
    let few = Flakes { count: 200, radius: [0.1, 0.0], ..particles::FLAKES };
    let draw = |share: f64| {
        let field = Snow::new(&few, 2.0, DVec3::ZERO, DVec3::ZERO, share as f32);
        snow(field, Vec3A::ZERO, Vec3A::Z, SIZE)
    };
    let (mut before, mut most) = (draw(0.0), 0.0f64);
    for step in 1..=500 {
        let next = draw(f64::from(step) / 1000.0);
        most = most.max(off(&next, &before));
        before = next;
    }
    println!("from one thousandth to the next: {most}");
    assert!(most < GRADUAL, "{most}");
}
