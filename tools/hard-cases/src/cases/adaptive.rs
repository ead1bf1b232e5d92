//! The adaptive picture: small things that move through its grid, and errors of whole pictures.

use crate::case::{Case, Effort, Runs};
use fearless_simd::Level;
use glam::{Vec3A, dvec3, vec3a};
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::trace::{Background, Material, Object, Shape, World};
use paprsek::view::Camera;
use testkit::Found;
use testkit::metrics::{Difference, bad_pixels, ssim};
use testkit::picture::traced;
use testkit::random::Random;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Best,
        "balls of 0.1 to 8 pixels swept by 1/8 pixel, tile's inside, edge and corner",
        "misses between corners of the grid",
        "every pixel traced: pictures without the ball",
        0.0,
        missed,
    )
    .unit("failures"),
    Case::new(
        Runs::Best,
        "the same: pixels too many or too few",
        "misses between corners of the grid",
        "every pixel traced",
        1.0,
        miscounted,
    )
    .unit("pixels"),
    Case::new(
        Runs::Best,
        "a ball of 4 pixels swept by 1/8 pixel: light from frame to frame, anti-aliased",
        "flicker",
        "equal, but for regular samples half a pixel apart that turn together",
        0.05,
        flicker,
    )
    .unit("of its area"),
    Case::new(
        Runs::Best,
        "a rim's share of a pixel, balls of 1.5 to 8 pixels, anti-aliased",
        "edges",
        "32 x 32 exact samples a pixel; a rim takes quarters of a pixel",
        0.26,
        shares,
    ),
    Case::new(
        Runs::Best,
        "adaptive pictures at times drawn by chance: decibels short of 40",
        "the target of adaptive pictures",
        "every pixel traced",
        0.0,
        |e| adaptive(e, |d, _| 40.0 - d.psnr()),
    )
    .unit("dB"),
    Case::new(Runs::Best, "the same: structure lost", "[Wang04]", "every pixel traced", 0.02, |e| {
        adaptive(e, |_, ssim| 1.0 - ssim)
    }),
    Case::new(
        Runs::Best,
        "the same: pixels that are off by more than 8 codes",
        "no single metric is a gate",
        "every pixel traced",
        0.005,
        |e| adaptive(e, |d, _| d.bad),
    ),
];

/// Size of the small pictures: two tiles and a part of a square; a metre at the distance of their screen is a pixel.
const SMALL: (usize, usize) = (84, 60);

const SCREEN: f32 = 100.0;

/// Light of the even sky.
const SKY: f64 = 0.4;

fn screen() -> Camera {
    Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, 2.0 * (SMALL.1 as f32 * 0.5 / SCREEN).atan(), 0.0)
}

/// The point of the screen at a place in the picture, pixels from its top left.
fn on_screen(x: f64, y: f64) -> Vec3A {
    vec3a((x - SMALL.0 as f64 * 0.5) as f32, (SMALL.1 as f64 * 0.5 - y) as f32, -SCREEN)
}

fn flat(objects: Vec<Object>) -> World {
    World { ambient: Vec3A::ONE, background: Background::even(Vec3A::splat(SKY as f32)), ..World::new(objects) }
}

fn ball(x: f64, y: f64, radius: f64) -> World {
    let shape = Shape::Sphere { center: on_screen(x, y), radius: radius as f32 };
    flat(vec![Object::new(shape, Material::plain(Vec3A::ONE))])
}

const RADII: [f64; 12] = [0.5, 2.0, 0.1, 8.0, 0.2, 0.35, 0.71, 1.0, 1.5, 3.0, 4.0, 6.0];

/// Steps of an eighth of a pixel across the coarsest square.
const STEPS: usize = Quality::FAST.trace.cell * 8;

/// Balls that are swept through a square, and how many pixels show them: traced, and by the adaptive picture.
fn swept(effort: &Effort, mut each: impl FnMut(usize, usize, String)) {
    let draw = |world: &World, quality| traced(world, screen(), SMALL, quality, Level::new()).frame();
    let empty = draw(&flat(vec![]), Quality::EXACT);
    for &(column, row) in effort.some(&[(32.0, 24.0), (60.0, 24.0), (80.0, 56.0), (-4.0, -4.0)], 1) {
        for &radius in effort.some(&RADII, 2) {
            for k in 0..STEPS {
                // Every column of the finest grid once, the rows in a stride that is prime to them.
                let (x, y) = (column + k as f64 / 8.0, row + (k * 27 % STEPS) as f64 / 8.0);
                let world = ball(x, y, radius);
                let count = |quality| bad_pixels(&draw(&world, quality), &empty);
                each(count(Quality::EXACT), count(Quality::FAST), format!("radius {radius} at {x}, {y}"));
            }
        }
    }
}

fn missed(effort: &Effort) -> Found {
    let mut found = Found::default();
    swept(effort, |there, here, what| found.judge(there == 0 || here > 0, || what));
    found
}

fn miscounted(effort: &Effort) -> Found {
    let mut found = Found::default();
    swept(effort, |there, here, what| found.see(there.abs_diff(here) as f64, || format!("{what}: {here} for {there}")));
    found
}

fn flicker(effort: &Effort) -> Found {
    let mut found = Found::default();
    let radius = 4.0;
    let mut last = None::<f64>;
    for k in 0..effort.of(256).max(64) {
        let world = ball(20.0 + k as f64 / 8.0, 25.0 + k as f64 / 37.0, radius);
        let picture = traced(&world, screen(), SMALL, Quality::DEFAULT, Level::new());
        // A ball beside the axis is an ellipse, longer than wide: compared from frame to frame.
        let light: f64 = picture.pixels.iter().map(|c| (c.x as f64 - SKY) / (1.0 - SKY)).sum();
        let area = std::f64::consts::PI * radius * radius;
        if let Some(last) = last {
            found.see((light - last).abs() / area, || format!("step {k}: {light} pixels after {last}"));
        }
        last = Some(light);
    }
    found
}

fn shares(effort: &Effort) -> Found {
    const POINTS: usize = 32;
    let (mut found, mut random) = (Found::default(), Random(132));
    for _ in 0..effort.of(100) {
        let (x, y, radius) = (random.range(30.0, 50.0), random.range(20.0, 40.0), random.range(1.5, 8.0));
        let picture = traced(&ball(x, y, radius), screen(), SMALL, Quality::DEFAULT, Level::new());
        let center = on_screen(x, y).as_dvec3();
        // A ray meets the ball where its angle to the centre is less than the rim's.
        let cosine = (1.0 - radius * radius / center.length_squared()).sqrt() * center.length();
        for (at, pixel) in picture.pixels.iter().enumerate() {
            let (column, row) = ((at % SMALL.0) as f64, (at / SMALL.0) as f64);
            if (column - x).hypot(row - y) > radius + 4.0 {
                continue;
            }
            let meets = |k: usize| {
                let [dx, dy] = [k % POINTS, k / POINTS].map(|k| (k as f64 + 0.5) / POINTS as f64);
                let d = dvec3(column + dx - SMALL.0 as f64 * 0.5, SMALL.1 as f64 * 0.5 - row - dy, -SCREEN as f64);
                d.normalize().dot(center) > cosine
            };
            let area = (0..POINTS * POINTS).filter(|&k| meets(k)).count() as f64 / (POINTS * POINTS) as f64;
            let share = (pixel.x as f64 - SKY) / (1.0 - SKY);
            found.see((share - area).abs(), || format!("radius {radius} at {x}, {y}, pixel {at}: {share} for {area}"));
        }
    }
    found
}

fn adaptive(effort: &Effort, error: fn(&Difference, f64) -> f64) -> Found {
    let (mut found, mut random) = (Found::default(), Random(133));
    let names = ["spheres", "spheres-flat", "spheres-glass"];
    for &name in effort.some(&names, 1) {
        let (Some(scene), Ok(mut renderer)) = (scenes::named(name), Renderer::new(0)) else { return Found::default() };
        for _ in 0..effort.of(8) {
            let time = random.range(0.0, scene.duration);
            let mut draw = |quality| {
                let mut frame = Frame::new(640, 360);
                renderer.render(&scene, time, &quality, &mut frame);
                frame
            };
            let (exact, fast) = (draw(Quality::EXACT), draw(Quality::FAST));
            let error = error(&Difference::between(&exact, &fast), ssim(&exact, &fast));
            found.see(error, || format!("{name} at {time}"));
        }
    }
    found
}
