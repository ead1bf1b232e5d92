//! The reference for packets of rays: Whitted's recursion `[Whitted80]` as a textbook has it, one ray at a time.
//!
//! It has no lanes, no deferred textures and no thresholds, and takes lights with a radius as points. Conventions are those
//! of [`super::ray`] and [`super::world`]. The tests hold the packets against it, and it against closed forms.

use super::ray::{GATHERS, passes};
use super::shape::{FAR, Shape};
use super::surface::DENSE;
use super::world::{Background, Emitter, Light, World};
use crate::vector::unit;
use glam::{Mat3A, Vec3A};

/// The interval in which the line `o + t d` with `|d| = 1` is inside a body; none where it never is.
///
/// A line that only touches a round body is not inside it. Distances may be negative, and reach to minus or plus [`FAR`].
/// The rest of the contract is that of [`Shape::span`]: `d` has to have the length 1, and is not normalised.
pub fn span(shape: &Shape, o: Vec3A, d: Vec3A) -> Option<(f32, f32)> {
    let (t0, t1) = match *shape {
        Shape::Sphere { center, radius } => {
            let q = o - center;
            let b = -q.dot(d);
            let m = q + d * b;
            let disc = radius * radius - m.dot(m);
            let far = b + disc.max(0.0).sqrt().copysign(b);
            let near = (q.dot(q) - radius * radius) / far;
            (disc > 0.0).then(|| (far.min(near), far.max(near)))?
        }
        Shape::Plane { normal, offset } => {
            let (speed, height) = (d.dot(normal), o.dot(normal) - offset);
            match speed {
                s if s < 0.0 => (-height / s, FAR),
                s if s > 0.0 => (-FAR, -height / s),
                _ => (height <= 0.0).then_some((-FAR, FAR))?,
            }
        }
        #[cfg(feature = "full")]
        Shape::Globe { touch, normal, radius } => {
            let q = o - touch;
            let (along, slope) = (q.dot(d), d.dot(normal));
            let m = q - d * along;
            let disc = slope * slope * radius - 2.0 * m.dot(normal) - m.dot(m) / radius;
            let b = -(along + slope * radius);
            let far = b + (disc.max(0.0) * radius).sqrt().copysign(b);
            let near = (q.dot(q) + 2.0 * radius * q.dot(normal)) / far;
            (disc > 0.0).then(|| (far.min(near), far.max(near)))?
        }
        Shape::Block { center, half, turn } => {
            let (o, d) = (turn * (o - center), turn * d);
            let mut span = (-FAR, FAR);
            for axis in 0..3 {
                let (a, b) = slab(o[axis], d[axis], half[axis]);
                span = (span.0.max(a), span.1.min(b));
            }
            span
        }
        Shape::Cylinder { center, axis, half, radius } => {
            let q = o - center;
            let (qa, da) = (q.dot(axis), d.dot(axis));
            let (c0, c1) = slab(qa, da, half);
            let (q, d) = (q - axis * qa, d - axis * da);
            let a = d.dot(d).max(1e-12);
            let b = -q.dot(d) / a;
            let m = q + d * b;
            let disc = radius * radius - m.dot(m);
            let s = (disc.max(0.0) / a).sqrt();
            (disc > 0.0).then(|| (c0.max(b - s), c1.min(b + s)))?
        }
    };
    (t0 <= t1).then_some((t0, t1))
}

/// The interval in which a line is between `-half` and `half` on one axis.
fn slab(o: f32, d: f32, half: f32) -> (f32, f32) {
    let d = d.abs().max(1e-20).copysign(d);
    let (a, b) = ((-half - o) / d, (half - o) / d);
    (a.min(b), a.max(b))
}

impl Shape {
    /// Unit outward normal at a point of the surface, in scalar code.
    pub fn normal_at(&self, p: Vec3A) -> Vec3A {
        match *self {
            Shape::Sphere { center, .. } => unit(p - center),
            Shape::Plane { normal, .. } => normal,
            #[cfg(feature = "full")]
            Shape::Globe { touch, normal, radius } => unit((p - touch) / radius + normal),
            Shape::Block { center, half, turn } => {
                let q = turn * (p - center);
                let axis = (q / half).abs().max_position();
                Mat3A::transpose(&turn).col(axis) * q[axis].signum()
            }
            Shape::Cylinder { center, axis, half, radius } => {
                let q = p - center;
                let h = q.dot(axis);
                let round = q - axis * h;
                if h.abs() / half >= round.length() / radius { axis * h.signum() } else { unit(round) }
            }
        }
    }
}

/// Index and distance of the nearest surface in front of the point `o` in the unit direction `d`, among the bodies for whose
/// index `counts` holds.
///
/// Only distances above 0 and below [`FAR`] count. Inside a body, its far side is in front; on its surface, what is ahead.
/// A direction of another length is not normalised, see [`Shape::span`].
pub fn nearest(world: &World, o: Vec3A, d: Vec3A, counts: impl Fn(usize) -> bool) -> Option<(usize, f32)> {
    first(world, o, d, |index| if counts(index) { Exits::Both } else { Exits::None })
}

/// Which crossings of a body's surface count.
pub(super) enum Exits {
    None,
    Far,
    Both,
}

/// Index and distance of the first crossing in front of a point that counts.
pub(super) fn first(world: &World, o: Vec3A, d: Vec3A, exits: impl Fn(usize) -> Exits) -> Option<(usize, f32)> {
    let mut best = None;
    for (index, body) in world.objects.iter().enumerate() {
        let Some((t0, t1)) = span(&body.shape, o, d) else { continue };
        let t = match exits(index) {
            Exits::None => continue,
            Exits::Far => t1,
            Exits::Both if t0 > 0.0 => t0,
            Exits::Both => t1,
        };
        if t > 0.0 && best.is_none_or(|(_, b)| t < b) && t < FAR {
            best = Some((index, t));
        }
    }
    best
}

/// A ray, and the body that it leaves.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Start, metres.
    pub origin: Vec3A,
    /// Unit direction.
    pub direction: Vec3A,
    /// Index of the body whose surface it leaves, and whether it goes into that body.
    pub from: Option<(usize, bool)>,
}

impl Ray {
    /// A ray that leaves no body.
    pub fn new(origin: Vec3A, direction: Vec3A) -> Ray {
        Ray { origin, direction, from: None }
    }
}

/// Fresnel reflectance of a dielectric for unpolarised light, 0 to 1, and the cosine of the refracted ray; `None` where
/// all is reflected.
///
/// Arguments and errors are those of [`super::fresnel`], whose bits it has.
pub fn fresnel(eta: f32, cosine: f32) -> Option<(f32, f32)> {
    let incident = eta * cosine;
    let near = (1.0 - eta) * (eta + 1.0) + incident * incident;
    let k = if eta < DENSE { near } else { 1.0 - eta * eta * (1.0 - cosine * cosine) };
    let through = k.max(0.0).sqrt();
    let s = (incident - through) / (incident + through);
    let p = (eta * through - cosine) / (eta * through + cosine);
    (k > 0.0).then_some(((s * s + p * p) * 0.5, through))
}

/// The linear light that comes back along a ray, whose direction has to have the length 1. `level` counts the rays of the
/// path, 1 for an eye ray; beyond [`World::max_level`] it is black.
pub fn radiance(world: &World, ray: Ray, level: u32) -> Vec3A {
    if level > world.max_level {
        return Vec3A::ZERO;
    }
    let Ray { origin, direction, from } = ray;
    let hit = first(world, origin, direction, |index| match from {
        Some((f, inward)) if f == index => {
            if inward {
                Exits::Far
            } else {
                Exits::None
            }
        }
        _ => Exits::Both,
    });
    let Some((index, t)) = hit else { return background(world, direction) };
    let body = &world.objects[index];
    let material = &body.material;
    let point = origin + direction * t;
    let outward = body.shape.normal_at(point);
    let inside = direction.dot(outward) > 0.0;
    let normal = if inside { -outward } else { outward };
    let cosine = -direction.dot(normal);
    let mirrored = Ray { origin: point, direction: direction + normal * (2.0 * cosine), from: Some((index, false)) };

    if material.is_glass() {
        let eta = if inside { material.ior } else { 1.0 / material.ior };
        let mirrored = Ray { from: Some((index, inside)), ..mirrored };
        let (_, shine) = local(world, index, point, normal, direction);
        let Some((share, through)) = fresnel(eta, cosine) else {
            return shine + radiance(world, mirrored, level + 1);
        };
        let refracted = Ray {
            origin: point,
            direction: direction * eta + normal * (eta * cosine - through),
            from: Some((index, !inside)),
        };
        return shine
            + radiance(world, mirrored, level + 1) * share
            + radiance(world, refracted, level + 1) * material.filter * (1.0 - share);
    }
    let grazing = (1.0 - cosine.min(1.0)).powi(5);
    let mirror = material.reflectance + (Vec3A::ONE - material.reflectance) * (material.fresnel * grazing);
    let (diffuse, shine) = local(world, index, point, normal, direction);
    let shaded = diffuse * material.albedo.color(point) + shine;
    let mut sum = shaded * (Vec3A::ONE - mirror);
    if mirror.max_element() > 0.0 {
        sum += radiance(world, mirrored, level + 1) * mirror;
    }
    sum
}

/// Light of the lights at a point of the body `index`: off a white surface, and highlights.
pub(super) fn local(world: &World, index: usize, point: Vec3A, normal: Vec3A, direction: Vec3A) -> (Vec3A, Vec3A) {
    let material = &world.objects[index].material;
    let (mut diffuse, mut specular) = (world.ambient, Vec3A::ZERO);
    if material.is_glass() && material.specular == 0.0 {
        return (diffuse, specular);
    }
    for light in &world.lights {
        let (aim, reach) = toward(light, point);
        let cosine = normal.dot(aim);
        let seen = through(world, index, point, aim, reach);
        if cosine <= 0.0 || seen == Vec3A::ZERO {
            continue;
        }
        let glint = (aim - normal * (2.0 * cosine)).dot(direction);
        diffuse += light.color * seen * cosine;
        if glint > 0.0 {
            let power = f64::from(glint).powf(material.exponent.into()) as f32;
            specular += light.color * seen * (material.specular * power);
        }
    }
    (diffuse, specular)
}

/// Unit direction and distance to a light.
pub(super) fn toward(light: &Light, point: Vec3A) -> (Vec3A, f32) {
    match light.emitter {
        Emitter::Point(position) => (unit(position - point), (position - point).length()),
        Emitter::Directional(direction) => (direction, FAR),
    }
}

/// The light that bodies other than `from` let through between a point and a light, in multiples of what there is of each
/// colour without them: 0 in the shadow of anything but a ball of glass.
pub(super) fn through(world: &World, from: usize, point: Vec3A, aim: Vec3A, reach: f32) -> Vec3A {
    let mut light = Vec3A::ONE;
    for (index, body) in world.objects.iter().enumerate() {
        if !body.casts_shadow || index == from {
            continue;
        }
        let Some((t0, t1)) = span(&body.shape, point, aim).filter(|(t0, t1)| *t1 > 0.0 && *t0 < reach) else {
            continue;
        };
        light *= match body.shape {
            Shape::Sphere { radius, .. } if body.material.is_glass() => {
                passes(&body.material) * gathered((t0 + t1) / (2.0 * radius), (t1 - t0) / (2.0 * radius))
            }
            _ => Vec3A::ZERO,
        };
    }
    light
}

/// What [`super::ray`] says of light behind a ball of glass; `z` and half of the chord in radii.
fn gathered(z: f32, half: f32) -> f32 {
    let square = z * z;
    let spread = square + GATHERS * (1.0 - half * half);
    // Not a number in the middle of the ball: dark.
    ((square + GATHERS) / spread * (square / spread)).max(0.0)
}

/// The background's light in a unit direction.
pub fn background(world: &World, d: Vec3A) -> Vec3A {
    let Background { horizon, zenith, glow } = world.background;
    let lobe = f64::from(d.dot(glow.direction).max(0.0)).powi(1 << glow.squarings);
    horizon + (zenith - horizon) * d.y.max(0.0) + glow.color * lobe as f32
}
