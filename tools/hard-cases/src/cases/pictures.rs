//! Light of traced worlds that is known: conservation, and the plain recursion.

use crate::case::{Case, Effort, Runs};
use glam::{Mat3A, Vec3A, vec3a};
use paprsek::settings::Quality;
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::{Background, Light, Material, Object, Shape, World};
use paprsek::view::Camera;
use testkit::fresnel::by_angles as fresnel;
use testkit::lines::alone;
use testkit::picture::{eye_ray, plain, traced};
use testkit::random::Random;
use testkit::{Found, ULP, levels};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "glass balls in an even sky, 2 to 16 levels",
        "white furnace, R + T = 1",
        "closed form: 1 - (1 - R) R^(n - 2)",
        1.0,
        furnace,
    )
    .unit("of the bound"),
    Case::new(
        Runs::Levels,
        "bodies of equal index, from outside and inside",
        "conservation",
        "closed form: the sky alone",
        1e-6,
        invisible,
    ),
    Case::new(
        Runs::All,
        "perfect mirrors of 1e-3 to 1e6 m in an even sky",
        "conservation, self-hits",
        "closed form: the sky alone",
        0.0,
        mirrors,
    ),
    Case::new(Runs::Levels, "matt floors under a sun, Lambert's cosine", "Lambert", "f64", 2e-6, lambert),
    Case::new(
        Runs::All,
        "packets against single rays: 12 bodies of glass, mirror and paint in one another",
        "[Whitted80]",
        "the scalar recursion, and what it makes of rays turned by 8 roundings",
        1.0,
        packets,
    )
    .unit("of the bound"),
];

fn furnace(effort: &Effort) -> Found {
    let mut found = Found::default();
    for (ior, level) in effort.some(&[(1.5, 3), (2.417, 16), (1.333, 2), (1.1, 4), (1.0001, 3), (1.5, 6), (3.0, 9)], 2)
    {
        let (ior, level): (f64, u32) = (*ior, *level);
        let ball = Shape::Sphere { center: Vec3A::ZERO, radius: 1.0 };
        let world = alone(ball, Material::glass(ior as f32, Vec3A::ONE), level);
        let camera = Camera::look_at(vec3a(0.0, 0.0, 3.0), Vec3A::ZERO, 0.8, 0.0);
        let size = (128, 128);
        for (name, simd) in levels() {
            let picture = traced(&world, camera, size, Quality::EXACT, simd);
            for (i, light) in picture.pixels.iter().enumerate() {
                let d = eye_ray(&camera, size, i % 128, i / 128).as_dvec3();
                let offset = camera.eye.as_dvec3().cross(d).length();
                if offset > 0.999 {
                    continue;
                }
                // By symmetry every crossing has one reflectance; the series breaks off after n - 2 terms.
                let r = fresnel(ior, offset.asin());
                let due = 1.0 - (1.0 - r) * r.powi(level as i32 - 2);
                // The offset of the line is known to a few roundings, angles to that over their cosine.
                let cosine = (1.0 - offset * offset).sqrt().min((1.0 - (offset / ior).powi(2)).sqrt());
                let doubt = 2e-6 + 8.0 * level as f64 * ULP * 4.0 / cosine;
                found.see((light.x as f64 - due).abs() / doubt, || {
                    format!("{name}, index {ior}, level {level}, pixel {i}")
                });
            }
        }
    }
    found
}

fn invisible(effort: &Effort) -> Found {
    let turn = Mat3A::from_rotation_x(0.7) * Mat3A::from_rotation_y(0.4);
    let shapes = [
        Shape::Sphere { center: Vec3A::ZERO, radius: 1.0 },
        Shape::Block { center: Vec3A::ZERO, half: vec3a(0.8, 0.5, 1.1), turn },
        Shape::Cylinder { center: Vec3A::ZERO, axis: vec3a(0.6, 0.8, 0.0), half: 1.0, radius: 0.7 },
        Shape::Plane { normal: Vec3A::Y, offset: -0.5 },
        Shape::Globe { touch: vec3a(0.0, -0.5, 0.0), normal: Vec3A::Y, radius: 1e6 },
    ];
    let mut found = Found::default();
    for shape in effort.some(&shapes, 3) {
        for eye in [vec3a(0.0, 0.3, 4.0), vec3a(0.1, 0.0, 0.2), vec3a(0.0, 50.0, 0.1)] {
            let world = alone(*shape, Material::glass(1.0, Vec3A::ONE), 4);
            let camera = Camera::look_at(eye, Vec3A::ZERO, 0.9, 0.3);
            for (name, level) in levels() {
                for light in traced(&world, camera, (96, 64), Quality::EXACT, level).pixels {
                    found.see((light - Vec3A::ONE).abs().max_element() as f64, || {
                        format!("{name}: {shape:?} from {eye}")
                    });
                }
            }
        }
    }
    found
}

fn mirrors(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(130));
    for round in 0..effort.of(100) {
        let scale = random.log(1e-3, 1e6) as f32;
        let shape = testkit::lines::bodies(&mut random, scale)[round as usize % 5];
        let (center, _) = testkit::lines::place(&shape);
        let world = alone(shape, Material::mirror(Vec3A::ONE), 2);
        let camera = Camera::look_at(center + random.direction() * 5.0 * scale, center, 0.5, 0.0);
        let mut see = |name: &str, pixels: Vec<Vec3A>| {
            for light in pixels {
                found.see((light - Vec3A::ONE).abs().max_element() as f64, || format!("{name}: {light}, {shape:?}"));
            }
        };
        see("scalar", plain(&world, camera, (40, 40)).pixels);
        for (name, level) in levels() {
            see(name, traced(&world, camera, (40, 40), Quality::EXACT, level).pixels);
        }
    }
    found
}

fn lambert(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(131));
    for _ in 0..effort.of(200) {
        let floor = Shape::Plane { normal: Vec3A::Y, offset: 0.0 };
        let aim = random.direction().abs();
        let mut world = alone(floor, Material::plain(Vec3A::splat(0.8)), 1);
        world.lights = vec![Light::directional(aim, Vec3A::splat(0.9))];
        world.ambient = Vec3A::splat(0.1);
        let camera = Camera::look_at(vec3a(0.0, 3.0, 0.0), vec3a(0.2, 0.0, 0.1), 0.9, 0.0);
        let due = 0.8 * (0.1 + 0.9 * aim.y.max(0.0) as f64);
        for (name, level) in levels() {
            for light in traced(&world, camera, (16, 16), Quality::EXACT, level).pixels {
                found.see((light.x as f64 - due).abs(), || format!("{name}: {light} for {due}, sun {aim}"));
            }
        }
    }
    found
}

fn packets(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(134));
    for _ in 0..effort.of(40) {
        let mut objects = vec![Object::new(
            Shape::Plane { normal: Vec3A::Y, offset: -1.0 },
            Material::plain(Vec3A::splat(0.7)).polished(0.2, 0.0, 1.0),
        )];
        for _ in 0..12 {
            let center = random.direction() * random.range(0.0, 3.0) as f32;
            let shape = match (random.unit() * 3.0) as u32 {
                0 => Shape::Block { center, half: vec3a(0.4, 0.3, 0.5), turn: random.turn() },
                1 => Shape::Cylinder { center, axis: random.direction(), half: 0.5, radius: 0.3 },
                _ => Shape::Sphere { center, radius: random.range(0.1, 0.8) as f32 },
            };
            let material = match (random.unit() * 3.0) as u32 {
                0 => Material::glass(random.range(1.0, 2.4) as f32, Vec3A::splat(0.95)),
                1 => Material::mirror(Vec3A::splat(0.9)),
                _ => Material::plain(vec3a(0.8, 0.5, 0.2)).shiny(0.4, 30.0),
            };
            let object = Object::new(shape, material);
            // In a ball of glass that casts a shadow, what lies before its middle is lit: packets know no more of it.
            objects.push(if material.is_glass() { object.without_shadow() } else { object });
        }
        let world = World {
            lights: vec![
                Light::point(random.direction().abs() * 6.0, Vec3A::splat(0.7)),
                Light::directional(random.direction().abs(), Vec3A::splat(0.3)),
            ],
            ambient: Vec3A::splat(0.1),
            background: Background::gradient(vec3a(0.7, 0.8, 0.9), vec3a(0.2, 0.4, 0.7)),
            ..World::new(objects)
        };
        let camera = Camera::look_at(random.direction() * 6.0, Vec3A::ZERO, 0.9, 0.0);
        let size = (80, 60);
        let truth = plain(&world, camera, size);
        for (name, level) in levels() {
            let picture = traced(&world, camera, size, Quality::EXACT, level);
            for (at, (light, due)) in picture.pixels.iter().zip(&truth.pixels).enumerate() {
                let error = (*light - *due).abs().max_element();
                // What a ray that is turned by a few roundings may see instead, through glass off mirrors.
                let doubt = if error > SEEN { doubt(&world, &camera, size, at, *due) } else { 0.0 };
                found.see((error / (SEEN + doubt)) as f64, || {
                    format!("{name}, pixel {at} from {}: {light} for {due}, doubt {doubt}", camera.eye)
                });
            }
        }
    }
    found
}

/// Differences of light that nobody sees.
const SEEN: f32 = 1e-3;

/// By how much the light of a pixel changes where its ray is turned by up to eight roundings.
fn doubt(world: &World, camera: &Camera, size: (usize, usize), at: usize, light: Vec3A) -> f32 {
    let d = eye_ray(camera, size, at % size.0, at / size.0);
    let mut random = Random(at as u64);
    let turned = (0..200).map(|_| (d + random.direction() * (8.0 * ULP * random.unit()) as f32).normalize());
    turned
        .map(|d| (reference::radiance(world, Ray::new(camera.eye, d), 1) - light).abs().max_element())
        .fold(0.0, f32::max)
}
