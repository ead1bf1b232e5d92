//! The guard: squares of the corner grid that must be cut whatever their corners say, because something small is there.
//!
//! A body whose picture is smaller than a square can hide between the corners. The rim of a larger one can bulge into a
//! square between two corners by up to its sagitta, `size^2 / (8 radius)`. Both are excluded by cutting the squares under
//! the body's picture to `sqrt(radius)` pixels, where the sagitta is an eighth of a pixel. The same is done for the body's
//! shadow, which is found by following the light's ray through it, and for its image in a flat mirror.
//!
//! Images in round mirrors, and the highlights on round and flat bodies, which are images of the lights, are only made
//! sure to be met by a sample, with squares of half their radius; from there their edges are followed.
//!
//! Not guarded are images in the sides of blocks and cylinders, images of images, and in worlds of more than 64 bodies
//! images in round mirrors, of which there are as many as pairs.

use super::bounds::{Bounds, Extent, Shaft, Start, WORD};
use super::ray::{RayPacket, Search, nearest};
use super::shape::{FAR, Shape};
use super::world::{Emitter, Light, Material, Object, World};
use crate::cuts;
use crate::simd::lanes::{F, Lane, M, U, V3};
use crate::simd::level;
use crate::view::View;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3A;

/// Edge of the blocks of the picture that the guard keeps apart, pixels.
const BLOCK: usize = 8;
/// Most balls that stand for one long body.
const MOST_BALLS: f32 = 64.0;
/// Twice the logarithm of 8: a highlight is guarded as far as it has an eighth of its peak.
const SKIRT: f32 = 4.158_883;

/// What is asked of the rim of a small thing.
#[derive(Clone, Copy)]
enum Rim {
    /// No bulge is lost.
    Exact,
    /// A sample meets it.
    Found,
}

/// For each block of the picture, the largest square that may be interpolated there.
pub struct Guard {
    /// Blocks in a row.
    columns: usize,
    /// The largest square's edge, pixels: a power of two, or `u8::MAX` for any size. At 0 a pixel is too large.
    finest: Vec<u8>,
}

impl Guard {
    /// The guard of a `world` as a view shows it. `bounds` has boxes around all objects.
    pub fn new(world: &World, bounds: &Bounds, view: &View) -> Guard {
        let (columns, rows) = (view.width().div_ceil(BLOCK), view.height().div_ceil(BLOCK));
        let mut guard = Guard { columns, finest: vec![u8::MAX; columns * rows] };
        let eye = view.camera().eye;
        let many = cuts::MANY_BODIES && world.objects.len() > WORD;
        let mut mirrors = Vec::new();
        for (index, body) in world.objects.iter().enumerate() {
            let flat = matches!(body.shape, Shape::Plane { .. });
            // Not every ball in every ball where there are many.
            if mirrors_light(&body.material) && (flat || !many) {
                mirrors.push(index);
            }
        }
        for (index, body) in world.objects.iter().filter(|_| !cfg!(without = "guard")).enumerate() {
            for light in &world.lights {
                guard.highlight(view, body, position(light, eye));
            }
            for (center, radius) in (0..).map_while(|n| ball(&body.shape, n)) {
                guard.protect(view, center, radius, Rim::Exact);
                for &other in &mirrors {
                    let mirror = &world.objects[other];
                    if other != index
                        && let Some((image, radius)) = reflected(eye, mirror, center, radius)
                    {
                        let flat = matches!(mirror.shape, Shape::Plane { .. });
                        guard.protect(view, image, radius, if flat { Rim::Exact } else { Rim::Found });
                    }
                }
                if body.casts_shadow {
                    for light in &world.lights {
                        guard.shadow(world, bounds, view, index, light, center, radius);
                    }
                }
            }
        }
        guard
    }

    /// Edge of the largest square that may be interpolated at a pixel of the picture, pixels. At 0 something is there that
    /// is smaller than a pixel.
    #[inline(always)]
    pub fn finest(&self, x: usize, y: usize) -> usize {
        self.finest[(y / BLOCK) * self.columns + x / BLOCK] as usize
    }

    /// Cuts the squares under the shadow of a ball that stands for a part of the body `caster`.
    #[allow(clippy::too_many_arguments)]
    #[inline(never)] // 57 bytes less packed.
    fn shadow(
        &mut self,
        world: &World,
        bounds: &Bounds,
        view: &View,
        caster: usize,
        light: &Light,
        center: Vec3A,
        radius: f32,
    ) {
        let source = position(light, view.camera().eye);
        let toward = |point: Vec3A| match light.emitter {
            Emitter::Point(_) => (point - source).normalize_or(Vec3A::NEG_Y),
            Emitter::Directional(direction) => -direction,
        };
        let aim = toward(center);
        // The middle of the shadow; and where that is small its rim, which may fall on another body.
        let (u, v) = aim.any_orthonormal_pair();
        let mut small = true;
        for offset in [Vec3A::ZERO, u, -u, v, -v] {
            if !small || radius == 0.0 && offset != Vec3A::ZERO {
                break;
            }
            let through = center + offset * radius;
            let direction = toward(through);
            let landing = dispatch!(level::best(), simd => landing(simd, world, bounds, caster, through, direction));
            let Some((point, normal)) = landing else { continue };
            let grown = point.distance(source) / through.distance(source).max(1e-6);
            // The shadow is longer than wide by 1 / slope; at most 8 of it counts.
            let slope = normal.dot(direction).abs();
            small = self.protect(view, point, radius * grown / slope.max(0.125), Rim::Exact);
        }
    }

    /// Cuts the squares under the highlight that a light at `source` makes on a body.
    fn highlight(&mut self, view: &View, body: &Object, source: Vec3A) {
        let material = &body.material;
        if material.specular == 0.0 {
            return;
        }
        let Some(point) = mirror_point(view.camera().eye, &body.shape, source) else { return };
        // Half the angle of the lobe, since turning a normal turns the mirrored ray by twice as much.
        // A lobe cos(a)^n is all but the Gaussian exp(-n a^2 / 2), and never wider.
        let angle = 0.5 * (SKIRT / material.exponent.max(1.0)).sqrt();
        let radius = match body.shape {
            Shape::Sphere { radius, .. } => radius * angle,
            _ => 2.0 * angle * point.distance(view.camera().eye),
        };
        self.protect(view, point, radius, Rim::Found);
    }

    /// Cuts the squares under the picture of a ball. Returns whether it is small enough for that to be needed.
    fn protect(&mut self, view: &View, center: Vec3A, radius: f32, rim: Rim) -> bool {
        let Some((x, y, metre)) = view.project(center) else { return false };
        let pixels = radius * metre;
        let finest = match rim {
            Rim::Exact => pixels.sqrt(),
            Rim::Found => pixels * 0.5,
        }
        .max(1.0);
        // Written so that a position that is not a number is left alone.
        let small = finest < BLOCK as f32 && x.is_finite() && y.is_finite();
        if small {
            // Rounded down to a power of two. A ball that is smaller than a pixel may hide between its corners.
            let within = radius > 0.0 && pixels < 1.0;
            let finest = if within { 0 } else { 1 << ((finest.to_bits() >> 23) - 127) };
            let rows = self.finest.len() / self.columns.max(1);
            let ((x0, x1), (y0, y1)) = (blocks(x, pixels, self.columns), blocks(y, pixels, rows));
            for row in y0..y1 {
                for block in &mut self.finest[row * self.columns..][x0..x1] {
                    *block = (*block).min(finest);
                }
            }
        }
        small
    }
}

/// Where a ray from inside or on the body `from` first meets another body, and the normal there.
#[simd]
fn landing<S: Simd>(
    simd: S,
    world: &World,
    bounds: &Bounds,
    from: usize,
    origin: Vec3A,
    direction: Vec3A,
) -> Option<(Vec3A, Vec3A)> {
    let from = from as u32;
    let inward = M::<S>::splat(simd, false);
    let (start, along) = (V3::splat(simd, origin), V3::splat(simd, direction));
    let ray = RayPacket { origin: start, direction: along, from: U::<S>::splat(simd, from), inward };
    let shaft = Shaft::new(simd, Start { origins: Extent::point(origin), leaves: from }, Extent::point(direction));
    let far = F::<S>::splat(simd, FAR);
    let (object, t, _) = nearest(simd, world, bounds, &bounds.all, Some(&shaft), &ray, !inward, far, Search::Nearest);
    let body = world.objects.get(object[0] as usize)?;
    let point = ray.origin + ray.direction * Lane(t);
    Some((point.first(), body.shape.normal(simd, point).first()))
}

/// The range of blocks below `end` that a ball's picture may touch along one axis; its centre and radius are pixels.
fn blocks(at: f32, radius: f32, end: usize) -> (usize, usize) {
    let end = end as i32;
    let block = |pixel: f32| pixel as i32 >> BLOCK.trailing_zeros();
    let low = block(at - radius - 1.0).max(0).min(end);
    let high = (block(at + radius + 1.0) + 1).max(low).min(end);
    (low as usize, high as usize)
}

/// Position of a light. A directional one is put far away.
fn position(light: &Light, eye: Vec3A) -> Vec3A {
    match light.emitter {
        Emitter::Point(position) => position,
        Emitter::Directional(direction) => eye + direction * 1e6,
    }
}

/// Centre and radius of ball `n` of those that stand for a body; none after the last one. Planes and globes have none.
///
/// The first ones cover the body and are no wider than it, except for plates. Then follow the corners of a block as balls
/// of radius 0, because they reach into squares whose corners all lie outside.
fn ball(shape: &Shape, n: u32) -> Option<(Vec3A, f32)> {
    let (center, axis, half, radius) = match *shape {
        Shape::Sphere { center, radius } => (center, Vec3A::ZERO, 0.0, radius),
        Shape::Cylinder { center, axis, half, radius } => (center, axis, half, radius),
        Shape::Block { center, half, turn } => {
            let long = half.max_position();
            let mut across = half;
            across[long] = 0.0;
            (center, turn.row(long), half[long], across.length())
        }
        Shape::Plane { .. } => return None,
        #[cfg(feature = "full")]
        Shape::Globe { .. } => return None,
    };
    let count = (half / radius).ceil().clamp(1.0, MOST_BALLS);
    if n < count as u32 {
        return Some((center + axis * half * ((2 * n + 1) as f32 / count - 1.0), radius.max(half / count)));
    }
    let n = n - count as u32;
    match *shape {
        Shape::Block { center, half, turn } if n < 8 => {
            let sign = |axis: u32| if n >> axis & 1 == 0 { -1.0 } else { 1.0 };
            Some((center + turn.transpose() * (half * Vec3A::new(sign(0), sign(1), sign(2))), 0.0))
        }
        _ => None,
    }
}

/// The point of a body in which the eye sees `target` mirrored; none where it cannot, or where no simple formula gives it.
fn mirror_point(eye: Vec3A, shape: &Shape, target: Vec3A) -> Option<Vec3A> {
    match *shape {
        Shape::Plane { normal, offset } => {
            let (above, height) = (normal.dot(eye) - offset, normal.dot(target) - offset);
            (above > 0.0 && height > 0.0)
                .then(|| eye + (target - normal * (2.0 * height) - eye) * (above / (above + height)))
        }
        Shape::Sphere { center, radius } => {
            // Alhazen's problem: the normal there halves the angle. Each round reduces the error to a quarter or less.
            let mut normal = (eye - center).try_normalize()?;
            for _ in 0..12 {
                let point = center + normal * radius;
                let to_eye = (eye - point).try_normalize()?;
                normal = (to_eye + (target - point).try_normalize()?).try_normalize()?;
            }
            (normal.dot(target - center) > radius).then_some(center + normal * radius)
        }
        _ => None,
    }
}

/// Whether anything is seen in a body of the material.
fn mirrors_light(material: &Material) -> bool {
    material.reflectance.max_element() != 0.0 || material.fresnel != 0.0 || material.is_glass()
}

/// The image of a ball in a mirror: a point that is seen in the same direction, and the radius that it appears to have
/// there; none where its shape makes none that is simple.
fn reflected(eye: Vec3A, mirror: &Object, center: Vec3A, radius: f32) -> Option<(Vec3A, f32)> {
    match mirror.shape {
        Shape::Plane { normal, offset } if normal.dot(eye) > offset => {
            Some((center - normal * (2.0 * (normal.dot(center) - offset)), radius))
        }
        Shape::Sphere { radius: curvature, .. } => {
            let point = mirror_point(eye, &mirror.shape, center)?;
            // A convex mirror of focal length R/2 makes images smaller by (R/2) / (distance + R/2).
            let focal = 0.5 * curvature;
            // Towards the rim images are stretched. Half as large again is enough for what can be seen of them.
            Some((point, 1.5 * radius * focal / (point.distance(center) + focal)))
        }
        _ => None,
    }
}
