//! Sprites and their closed forms of time.

use crate::case::{Case, Effort, Runs};
use glam::{DVec3, Vec3A, vec3a};
use paprsek::frame::{Frame, Renderer};
use paprsek::particles::Fire;
use paprsek::scenes::{self, bench::particles::fires};
use paprsek::settings::Quality;
use testkit::metrics::channels;
use testkit::particles::{random as chance, scene};
use testkit::random::Random;
use testkit::sprites::{Size, burn, dusk, off, still, truth, worst};
use testkit::{Found, levels};

const SIZE: Size = (96, 64);
/// Light, where places on the screen are good to some 1e-5 pixels and sprites are about a pixel large, or larger.
const PLACES: f64 = 1e-4;
/// Light of nothing: film takes the light behind from 1 and back.
const NOTHING: f64 = 1e-7;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "all flakes of a snowfall at -1e9 to 1e9 s",
        "time never enters as f32",
        "f64, time in whole numbers",
        1.0,
        snow,
    )
    .unit("codes"),
    Case::new(
        Runs::Levels,
        "all sparks of five fires at -1e9 to 1e9 s",
        "f32 phases are off by 3e-3 after a day",
        "f64, time in whole numbers",
        1.0,
        fire,
    )
    .unit("codes"),
    Case::new(
        Runs::Best,
        "discs of 1e-3 to 1e18 m anywhere before the eye",
        "[Reeves83]",
        "f64, every pixel's middle",
        PLACES,
        discs,
    ),
    Case::new(
        Runs::Best,
        "sprites near the near plane, and with middles far outside of the picture",
        "near plane, places beyond f32",
        "f64; 1e-4 of the radius in metres",
        1.0,
        near,
    )
    .unit("of the bound"),
    Case::new(
        Runs::Best,
        "sprites behind the eye, on the near plane, of no size, not numbers",
        "w <= 0",
        "closed form: nothing",
        NOTHING,
        nowhere,
    ),
    Case::new(Runs::Best, "one life in generations of -1e6 to 1e6", "generation change", "f64", PLACES, lives),
    Case::new(
        Runs::Best,
        "birth and death, 1e-6 to 1e-2 s before and after",
        "continuity",
        "closed form: 30 x and 30 (1 - x)^2",
        1.0,
        ends,
    )
    .unit("of the bound"),
    Case::new(Runs::Best, "lives of 0, 1e-300 and 1e-9 s at any time", "life -> 0", "finite", 0.0, short)
        .unit("failures"),
    Case::new(
        Runs::Best,
        "phases within 1e-12 of 1 and of 0",
        "a share below 1 in f64 is 1 in f32",
        "closed form: dark",
        NOTHING,
        phases,
    ),
    Case::new(Runs::Best, "300 sprites of light in any order", "sums of light", "each other", 3e-6, orders),
    Case::new(
        Runs::Best,
        "a fire from one instant to another, 1e-5 to 1e-2 s",
        "frame rate",
        "10 of light a second",
        1.0,
        steps,
    )
    .unit("of the bound"),
];

fn text(effort: &Effort, name: &str) -> Found {
    let mut found = Found::default();
    let size = (201, 113);
    let times = [2.0, 1e9, -3.3071, 86_400.0, 0.0, 7.3519, 1000.0, 1e6, -1e9 - 0.3];
    let Some(asked) = scenes::named(name) else { return found };
    for &time in effort.some(&times, 2) {
        let light = scene(name, time, size);
        for (level_name, level) in levels() {
            let Ok(renderer) = Renderer::new(1) else { return Found::default() };
            let mut frame = Frame::new(size.0, size.1);
            renderer.at_level(level).render(&asked, time, &Quality::EXACT, &mut frame);
            for (at, (pixel, light)) in frame.pixels.iter().zip(&light).enumerate() {
                let codes = channels(*pixel).map(f64::from);
                let exact = light.to_array().map(|c| (255.0 * c.clamp(0.0, 1.0)).round());
                let gap = (0..3).map(|k| (codes[k] - exact[k]).abs()).fold(0.0, f64::max);
                found.see(gap, || format!("{level_name}, {time} s, pixel {at}"));
            }
        }
    }
    found
}

fn snow(effort: &Effort) -> Found {
    text(effort, "snow")
}

fn fire(effort: &Effort) -> Found {
    text(effort, "fire")
}

/// The largest difference of what burns before an eye in the origin that looks along -z.
fn error(fires: &[Fire], exposure: f32) -> f64 {
    let found = burn(fires, exposure, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, dusk);
    worst(&found, &truth(fires, f64::from(exposure), Vec3A::ZERO, Vec3A::NEG_Z, SIZE, dusk))
}

/// Light of any colour.
fn color(random: &mut Random) -> Vec3A {
    Vec3A::from_array([0; 3].map(|_| random.unit() as f32))
}

/// A sprite anywhere in the picture.
fn sprite(random: &mut Random) -> Fire {
    let depth = random.log(0.4, 100.0) as f32;
    let place = vec3a(random.range(-0.7, 0.7) as f32, random.range(-0.6, 0.6) as f32, -1.0) * depth;
    still(place, depth * random.log(1e-3, 0.5) as f32, color(random))
}

fn discs(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(90));
    for round in 0..effort.of(400) {
        let fire = match round % 4 {
            0 => still(vec3a(0.0, 0.0, -3.0), random.log(1.0, 1e18) as f32, color(&mut random)),
            _ => sprite(&mut random),
        };
        found.see(error(&[fire], 1.0), || format!("{fire:?}"));
    }
    found
}

fn near(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(91));
    for round in 0..effort.of(200) {
        let side = random.direction().with_z(0.0).normalize_or(Vec3A::X);
        let away = random.log(0.5, 300.0) as f32;
        let (place, radius) = match round % 2 {
            0 => (vec3a(0.0, 0.0, -0.25 * random.range(1.0001, 1.2) as f32), random.log(0.01, 1.0) as f32),
            _ => (side * away + Vec3A::NEG_Z, away + random.range(-0.3, 0.3) as f32),
        };
        let fire = still(place, radius.max(0.01), color(&mut random));
        // Of middles that many pixels away the last bits are missing.
        found.see(error(&[fire], 1.0) / PLACES.max(radius as f64 * 1e-4), || format!("{place}, {radius}"));
    }
    found
}

fn nowhere(effort: &Effort) -> Found {
    const NAN: f32 = f32::NAN;
    let good = still(vec3a(0.0, 0.0, -3.0), 0.5, Vec3A::ONE);
    let at = |x, y, z| Fire { place: vec3a(x, y, z), ..good };
    let mut all = vec![
        at(0.0, 0.0, 3.0),
        at(0.0, 0.0, 0.0),
        at(1.0, 0.0, 0.0),
        at(0.0, 0.0, -0.25),
        at(0.0, 0.0, -0.249),
        at(9.0, 0.0, -3.0),
        at(0.0, 9.0, -3.0),
        Fire { weight: NAN, ..good },
        Fire { weight: 0.0, ..good },
        Fire { count: 0.0, ..good },
        Fire { count: NAN, ..good },
        Fire { count: -3.0, ..good },
        Fire { scale: 0.0, ..good },
        Fire { scale: NAN, ..good },
        Fire { time: f64::NAN, ..good },
        Fire { time: f64::INFINITY, ..good },
        Fire { time: f64::NEG_INFINITY, ..good },
    ];
    for bad in [NAN, f32::INFINITY, f32::NEG_INFINITY, 1e20, -1e20, 1e38, f32::MAX] {
        all.extend([at(bad, 0.0, -3.0), at(0.0, bad, -3.0), at(0.0, 0.0, -bad.abs())]);
    }
    let (mut found, mut random) = (Found::default(), Random(92));
    let others: Vec<Fire> = (0..effort.of(40)).map(|_| sprite(&mut random)).collect();
    for others in [&[], &others[..]] {
        let draw = |fires: &[Fire]| burn(fires, 1.0, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, dusk);
        let without = draw(others);
        for case in &all {
            let with = draw(&[others, &[*case]].concat());
            found.see(off(&without, &with), || format!("{case:?}"));
        }
    }
    found
}

/// One bright particle that moves and changes, and the time of one of its births.
fn one(generation: f64) -> (Fire, f64) {
    let mut fire = Fire { count: 1.0, first: 77, weight: 20.0, ..fires(0.0)[0] };
    fire.flame.life = [0.75, 0.5];
    fire.place = vec3a(0.0, -0.8, -4.0);
    let life = 0.75 + 0.5 * chance(fire.seed, 77, 0);
    (fire, (generation - chance(fire.seed, 77, 1)) * life)
}

const GENERATIONS: [f64; 8] = [0.0, 1e6, -1.0, 1.0, -1e6, 7.0, -3.0, 1000.0];

fn lives(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &generation in effort.some(&GENERATIONS, 2) {
        let (fire, birth) = one(generation);
        for age in [0.001, 0.01, 0.1, 0.3, 0.5, 0.7] {
            let fire = Fire { time: birth + age, ..fire };
            found.see(error(&[fire], 1.6), || format!("generation {generation}, {age} s old"));
        }
    }
    found
}

fn draw(fire: Fire) -> Vec<Vec3A> {
    burn(&[fire], 1.6, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, dusk)
}

fn ends(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &generation in effort.some(&GENERATIONS, 2) {
        let (fire, birth) = one(generation);
        let nothing = draw(Fire { count: 0.0, ..fire });
        let bright = |time: f64| off(&draw(Fire { time, ..fire }), &nothing);
        // The test can fail: in between there is light.
        found.more(if bright(birth + 0.3) > 0.05 { 0.0 } else { f64::INFINITY }, || {
            "dark in the middle of its life".into()
        });
        for after in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            // Light grows as 30 x and ends as 30 (1 - x)^2, times the weight of 20, 0.008 and 1.6.
            found.see(bright(birth + after) / (12.0 * after + 2e-7), || format!("{after} s after birth {generation}"));
            found.see(bright(birth - after) / (20.0 * after * after + 2e-7), || format!("{after} s before it"));
        }
    }
    found
}

fn short(_: &Effort) -> Found {
    let mut found = Found::default();
    let (mut fire, _) = one(0.0);
    for (life, more) in [(0.0, 0.0), (1e-300, 0.0), (f64::MIN_POSITIVE, 0.0), (5e-324, 0.0), (1e-9, 0.0), (0.0, 1e-12)]
    {
        for time in [-1e9, -2.0, -0.0, 0.3, 1e9, 1e300] {
            fire.flame.life = [life, more];
            let light = draw(Fire { time, ..fire });
            let dark = life > 0.0 || more > 0.0 || off(&light, &draw(Fire { count: 0.0, ..fire })) == 0.0;
            found.judge(dark && light.iter().all(|c| c.is_finite()), || format!("{life} {more} at {time} s"));
        }
    }
    found
}

fn phases(_: &Effort) -> Found {
    let mut found = Found::default();
    // The particle whose first birth is at 0: one in 2^24 is.
    let stream = (0..255).flat_map(|seed| (0..200_000).map(move |i| (seed, i)));
    let Some((seed, first)) = stream.into_iter().find(|(seed, i)| chance(*seed, *i, 1) == 0.0) else { return found };
    let (mut fire, _) = one(0.0);
    fire.flame.life = [1.0, 0.0];
    let fire = Fire { seed, first, ..fire };
    let nothing = draw(Fire { count: 0.0, ..fire });
    for time in [0.0, -0.0, -1e-300, -1e-20, -1e-17, -1e-12, 1.0 - 1e-12, 1.0, 1e-300, 1e-12, 1e9, -1e9, 4e15] {
        found.see(off(&draw(Fire { time, ..fire }), &nothing), || format!("at {time} s"));
    }
    found
}

fn orders(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(93));
    for _ in 0..effort.of(20) {
        let mut fires: Vec<Fire> = (0..300).map(|_| sprite(&mut random)).collect();
        let draw = |fires: &[Fire]| burn(fires, 0.2, Vec3A::ZERO, Vec3A::NEG_Z, SIZE, dusk);
        let first = draw(&fires);
        fires.reverse();
        found.see(off(&draw(&fires), &first), || "reversed".into());
        fires.rotate_left(101);
        found.see(off(&draw(&fires), &first), || "turned".into());
    }
    found
}

fn steps(effort: &Effort) -> Found {
    // Two thousand sparks in a few pixels.
    const FASTEST: f64 = 10.0;
    let (mut found, mut random) = (Found::default(), Random(94));
    for _ in 0..effort.of(60) {
        let time = [3.0, -3.0, 1000.0, 1e7][(random.unit() * 4.0) as usize] + random.unit();
        let torch = Fire { time, place: vec3a(0.0, -0.8, -4.0), ..fires(0.0)[0] };
        let before: Vec<DVec3> = draw(torch).iter().map(|c| c.as_dvec3()).collect();
        for dt in [1e-2, 1e-3, 1e-4, 1e-5] {
            let change = worst(&draw(Fire { time: time + dt, ..torch }), &before);
            found.see(change / (FASTEST * dt + 2e-5), || format!("{dt} s from {time}"));
        }
    }
    found
}
