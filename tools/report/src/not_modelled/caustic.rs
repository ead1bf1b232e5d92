//! The light that a ball of glass gathers on the floor: photons of the sun through it, by Snell and Fresnel.

use super::{Random, Row, frame, told};
use crate::metrics::Error;
use glam::{DVec3, Vec3A, dvec3, vec3a};
use paprsek::trace::reference::{Ray, radiance};
use paprsek::trace::{Background, Light, Material, Object, Shape, World};
use std::f64::consts::TAU;
use std::time::Instant;

/// Of glass.
const INDEX: f64 = 1.5;
/// Half the edge of the floor that is looked at, metres; the ball has a radius of 1 and lies on the floor.
const HALF: f64 = 4.0;

/// The refracted direction and the reflectance where a ray enters a medium of the relative index `eta` (from over to).
fn refract(d: DVec3, normal: DVec3, eta: f64) -> Option<(DVec3, f64)> {
    let cosine = -d.dot(normal);
    let square = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return None;
    }
    let inside = square.sqrt();
    let across = (eta * cosine - inside) / (eta * cosine + inside);
    let along = (eta * inside - cosine) / (eta * inside + cosine);
    Some((d * eta + normal * (eta * cosine - inside), 0.5 * (across * across + along * along)))
}

/// Light on each cell of the floor beside that of the open sun, which is 1: the ball's shadow, and what it gathers. Light that
/// is mirrored inside or outside of the ball is lost.
fn floor(cells: usize, photons: u32, towards: DVec3) -> Vec<f64> {
    let centre = DVec3::Y;
    let (right, area) = (towards.any_orthonormal_vector(), (2.0 * HALF / cells as f64).powi(2));
    let up = towards.cross(right);
    let mut random = Random(7);
    let cell = |p: DVec3| {
        let [x, z] = [p.x, p.z].map(|at| ((at + HALF) / (2.0 * HALF) * cells as f64).floor());
        let inside = |n: f64| n >= 0.0 && n < cells as f64;
        (inside(x) && inside(z)).then(|| z as usize * cells + x as usize)
    };
    let mut light = vec![1.0; cells * cells];
    // A photon carries the sunlight of its share of the disc that the ball cuts from the sun's rays, on level ground.
    let share = 0.5 * TAU / f64::from(photons) / (area * towards.y);
    for _ in 0..photons {
        let (radius, angle) = (random.next().sqrt(), TAU * random.next());
        let aside = (right * angle.cos() + up * angle.sin()) * radius;
        let enters = aside + towards * (1.0 - radius * radius).sqrt();
        let shadow = centre + aside;
        if let Some(at) = cell(shadow - towards * (shadow.y / towards.y)) {
            light[at] -= share;
        }
        let Some((d, mirrored)) = refract(-towards, enters, 1.0 / INDEX) else { continue };
        let leaves = enters - d * (2.0 * d.dot(enters));
        let Some((out, again)) = refract(d, -leaves, INDEX) else { continue };
        let from = centre + leaves;
        // What does not go down lands nowhere on the floor.
        let lands = if out.y < -1e-6 { cell(from - out * (from.y / out.y)) } else { None };
        if let Some(at) = lands {
            light[at] += share * (1.0 - mirrored) * (1.0 - again);
        }
    }
    light.into_iter().map(|light| light.max(0.0)).collect()
}

/// The light on the middles of the cells by the tracer.
fn traced(cells: usize, towards: DVec3) -> Vec<f64> {
    let plane = Shape::Plane { normal: Vec3A::Y, offset: 0.0 };
    let ball = Shape::Sphere { center: Vec3A::Y, radius: 1.0 };
    let bodies = [(plane, Material::plain(Vec3A::ONE)), (ball, Material::glass(INDEX as f32, Vec3A::ONE))];
    let world = World {
        ambient: Vec3A::ZERO,
        background: Background::even(Vec3A::ZERO),
        max_level: 1,
        lights: vec![Light::directional(towards.as_vec3a(), Vec3A::splat(1.0 / towards.y as f32))],
        ..World::new(bodies.map(|(shape, material)| Object::new(shape, material)).to_vec())
    };
    let at = |n: usize| ((n as f64 + 0.5) / cells as f64 * 2.0 * HALF - HALF) as f32;
    let from = |index: usize| vec3a(at(index % cells), 1e-3, at(index / cells));
    (0..cells * cells).map(|index| f64::from(radiance(&world, Ray::new(from(index), Vec3A::NEG_Y), 1).x)).collect()
}

/// A ball's shadow as a solid, no shadow at all, and what the tracer draws, against the light that it gathers.
pub fn rows(quick: bool) -> Vec<Row> {
    let (cells, photons) = if quick { (32, 100_000) } else { (160, 8_000_000) };
    let towards = dvec3(0.6, 0.8, 0.0);
    let began = Instant::now();
    let truth = floor(cells, photons, towards);
    let seconds = began.elapsed().as_secs_f64();
    let most = truth.iter().copied().fold(0.0, f64::max);
    // Light of the sky beside that of the sun, on a floor that reflects a half of both.
    let lit = |light: &[f64]| {
        let linear: Vec<_> = light.iter().map(|light| [0.5 * (0.15 + 0.85 * light); 3]).collect();
        frame(cells, cells, &linear)
    };
    // The solid's shadow is an ellipse: the cells nearer to the ray through the centre than its radius.
    let solid: Vec<_> = (0..cells * cells)
        .map(|index| {
            let at = |n: usize| (n as f64 + 0.5) / cells as f64 * 2.0 * HALF - HALF;
            let from = dvec3(at(index % cells), 0.0, at(index / cells)) - DVec3::Y;
            f64::from(u8::from(from.length_squared() - from.dot(towards).powi(2) > 1.0))
        })
        .collect();
    let truth = lit(&truth);
    let models = [
        ("no shadow", vec![1.0; cells * cells]),
        ("the shadow of a solid", solid),
        ("what the tracer gathers, in closed form", traced(cells, towards)),
    ];
    models
        .into_iter()
        .map(|(model, light)| Row {
            what: "tracer: caustics",
            scene: format!("a ball of glass on 8x8 m of floor, sun 53 degrees high, drawn with {model}"),
            reference: format!("{photons} photons, Snell and Fresnel, f64; up to {most:.1} times the sunlight"),
            error: told(&Error::between(&lit(&light), &truth)),
            cost: format!("{:.0} for 200,000 photons per ball", 1e3 * seconds * 200_000.0 / f64::from(photons)),
            bytes: "700 (photons into a picture of the floor)",
        })
        .collect()
}
