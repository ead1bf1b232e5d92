//! Flakes whose shutter stays open: rain.

use glam::{DMat2, DVec2, DVec3, Vec3A, dvec2, vec3a};
use paprsek::frame::Renderer;
use paprsek::particles::{Flakes, Lens, ParticleLayer};
use paprsek::scenes::bench::particles::{self, flakes};
use paprsek::settings::Quality;
use testkit::particles::{Camera, Time, flake, random};
use testkit::sprites::{Size, draw, view};

const SIZE: Size = (300, 240);

/// What is left of white light behind flakes that move so far while a half of the shutter's time passes.
fn passes(field: &Flakes, time: f64, forward: Vec3A, streak: Vec3A) -> Vec<f64> {
    let mut snow = flakes(field, time, Vec3A::ZERO);
    snow.streak = streak;
    let layer = ParticleLayer::new(vec![snow.into()], &view(Vec3A::ZERO, forward, SIZE), &Quality::EXACT.particles)
        .colored(Vec3A::ZERO);
    let light = draw(&mut Renderer::new(2).unwrap(), layer, SIZE, |_, _| (Vec3A::ONE, None));
    light.iter().map(|c| f64::from(c.x)).collect()
}

fn lens(streaks: bool) -> Lens {
    Lens { radius: [1.0, 24.0], streaks, ..particles::FLAKES.lens }
}

/// Weight, middle and second moments of what is taken of the light, pixels from the picture's middle.
fn moments(passes: &[f64]) -> (f64, DVec2, DMat2) {
    let (mut sum, mut first, mut second) = (0.0, DVec2::ZERO, DMat2::ZERO);
    for (at, passes) in passes.iter().enumerate() {
        let p = dvec2((at % SIZE.0) as f64 + 0.5, (at / SIZE.0) as f64 + 0.5);
        let p = p - 0.5 * dvec2(SIZE.0 as f64, SIZE.1 as f64);
        sum += 1.0 - passes;
        first += (1.0 - passes) * p;
        second += DMat2::from_cols(p * p.x, p * p.y) * (1.0 - passes);
    }
    let middle = first / sum;
    (sum, middle, second * (1.0 / sum) - DMat2::from_cols(middle * middle.x, middle * middle.y))
}

/// One flake, whose picture is an ellipse: as long as its way and itself, as wide as itself, with the light that it has
/// without.
#[test]
fn a_streak_lies_along_its_way() {
    /// Of sums over pixels instead of integrals.
    const PIXELS: f64 = 0.02;
    let mut seen = 0;
    for (time, streak) in [
        (1.0, vec3a(0.0, -0.2, 0.0)),
        (3.0, vec3a(0.3, 0.0, 0.0)),
        (4.0, vec3a(0.15, -0.15, 0.05)),
        (6.0, vec3a(-0.1, -0.2, 0.1)),
        (7.0, vec3a(0.0, -0.1, -0.25)),
    ] {
        let (place, _, g) = flake(Time::new(time), 0, DVec3::ZERO);
        if g >= 0.9 {
            continue;
        }
        seen += 1;
        let distance = place.length();
        // Six pixels, whatever its distance.
        let focal = 0.5 * SIZE.1 as f64 / 25f64.to_radians().tan();
        let radius = (6.0 * distance / focal) as f32;
        let few = Flakes { count: 1, radius: [radius, 0.0], opacity: 0.01, ..particles::FLAKES };
        // Not straight at it.
        let forward = place.normalize() + DVec3::new(0.02, -0.03, 0.01);
        let camera = Camera::new(forward, SIZE);
        let middle = camera.spot(place, 1.0).unwrap();
        let size = middle.radius * f64::from(radius);
        // The way in pixels: a step along it, made small.
        let small = 1e-4;
        let faster = f64::from(few.fall[1] as f32) * random(3, 0, 3) / few.fall[0] + 1.0;
        let way = streak.as_dvec3() * DVec3::new(1.0, faster, 1.0) * (distance / 4.0);
        let beyond = camera.spot(place + way * small, 1.0).unwrap();
        let along = dvec2(beyond.x - middle.x, beyond.y - middle.y) / small;

        let streak = streak * (distance / 4.0) as f32;
        let field = Flakes { lens: lens(true), ..few };
        let (sum, found, square) = moments(&passes(&field, time, forward.as_vec3a(), streak));
        let (whole, ..) = moments(&passes(&Flakes { lens: lens(false), ..few }, time, forward.as_vec3a(), streak));
        assert!((sum / whole - 1.0).abs() < PIXELS, "{streak}: light {}", sum / whole);
        let off = found - dvec2(middle.x - 150.0, middle.y - 120.0);
        assert!(off.length() < 0.05, "{streak}: its middle is off by {off}");
        // An ellipse whose weight is (1 - rho^2)^2 has an eighth of its half axes' squares.
        let direction = along.try_normalize().unwrap_or(DVec2::X);
        let (long, wide) = ((size + along.length()).powi(2) / 8.0, size * size / 8.0);
        for (axis, expected) in [(direction, long), (direction.perp(), wide)] {
            let is = axis.dot(square * axis);
            assert!((is / expected - 1.0).abs() < PIXELS, "{streak}: {is} instead of {expected}");
        }
        let skew = direction.perp().dot(square * direction);
        assert!(skew.abs() < PIXELS * (long * wide).sqrt(), "{streak}: skew {skew}");
    }
    assert!(seen >= 4, "{seen}");
}

/// With no time for it a streak is a flake.
#[test]
fn a_short_streak_is_a_flake() {
    const SHORT: f64 = 1e-3;
    let few = Flakes { count: 2000, radius: [0.02, 0.03], ..particles::FLAKES };
    let round = passes(&Flakes { lens: lens(false), ..few }, 2.0, Vec3A::Z, Vec3A::ZERO);
    for streak in [vec3a(1e-7, -1e-6, 0.0), vec3a(0.0, -1e-12, 0.0), Vec3A::ZERO] {
        let drawn = passes(&Flakes { lens: lens(true), ..few }, 2.0, Vec3A::Z, streak);
        let off = round.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < SHORT, "{streak}: {off}");
    }
}
