//! The surfaces that rays hit: numbers of their materials per lane, hit points, and reflectance.
//!
//! Lanes of a packet may hit different bodies. What shading needs of a material is therefore laid out as a row of
//! numbers per object, of which each lane selects its own.

use super::ray::RayPacket;
use super::shape::{Ball, Shape};
use super::world::{Material, NOWHERE, World};
use crate::simd::lanes::{F, Lane, M, U, V3};
use crate::texture::Pattern;
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Where the mean colour stands among the numbers of a surface (three numbers).
pub const ALBEDO: usize = 0;
/// Where the mirror stands (three numbers).
pub const REFLECTANCE: usize = 3;
/// Where the tint of glass stands (three numbers).
pub const FILTER: usize = 6;
/// Where the growth of the mirror towards grazing angles stands.
pub const FRESNEL: usize = 9;
/// Where the weight of the highlight stands.
pub const SPECULAR: usize = 10;
/// Where the exponent of the highlight stands.
pub const EXPONENT: usize = 11;
/// Where the index of refraction stands.
pub const IOR: usize = 12;
/// Where 1 stands for a surface with a texture, else 0.
pub const TEXTURED: usize = 13;
/// The count of numbers.
pub const SURFACE: usize = 14;

/// The ratio of indices from which on `1 - eta^2 (1 - c^2)` has the smaller error near the critical angle. Below it
/// `(1 - eta)(1 + eta) + (eta c)^2` has: where the ratio is near 1, the former is nothing but rounding.
pub(super) const DENSE: f32 = 1.375;

/// What the shading of a hit needs of a material.
pub type SurfaceNumbers = [f32; SURFACE];

/// The numbers of a material.
pub fn numbers(material: &Material) -> SurfaceNumbers {
    let mut numbers = [0.0; SURFACE];
    let colors = [(ALBEDO, material.albedo.mean()), (REFLECTANCE, material.reflectance), (FILTER, material.filter)];
    for (at, color) in colors {
        numbers[at..at + 3].copy_from_slice(&color.to_array());
    }
    numbers[FRESNEL] = material.fresnel;
    numbers[SPECULAR] = material.specular;
    numbers[EXPONENT] = material.exponent;
    numbers[IOR] = material.ior;
    numbers[TEXTURED] = if material.albedo.pattern == Pattern::Plain { 0.0 } else { 1.0 };
    numbers
}

/// Outward normal and material of what each lane has hit.
pub struct Surface<S: Simd> {
    /// Unit outward normal.
    pub normal: V3<S>,
    /// The numbers of the material.
    pub numbers: [F<S>; SURFACE],
}

impl<S: Simd> Surface<S> {
    /// The colour that begins at a number.
    #[inline(always)]
    pub fn color(&self, at: usize) -> V3<S> {
        V3 { x: self.numbers[at], y: self.numbers[at + 1], z: self.numbers[at + 2] }
    }

    /// The share of each colour that is mirrored under an angle of incidence, by Schlick's approximation `[Schlick94]`.
    #[inline(always)]
    pub fn mirror(&self, simd: S, cosine: F<S>) -> V3<S> {
        let one = F::<S>::splat(simd, 1.0);
        let grazing = one - cosine.min(one);
        let fifth = grazing * grazing * (grazing * grazing) * grazing;
        let boost = self.numbers[FRESNEL] * fifth;
        let reflectance = self.color(REFLECTANCE);
        reflectance + (V3 { x: one, y: one, z: one } - reflectance) * Lane(boost)
    }
}

/// Distance, point and surface of the hit of every lane in `hit`, given the object that [`nearest`] found and its rough
/// distance `t`; and the index of the object if it is one for all of them.
///
/// Runs once for each of the few bodies that a packet meets.
///
/// [`nearest`]: super::ray::nearest
#[inline(always)]
pub fn resolve<S: Simd>(
    simd: S,
    world: &World,
    surfaces: &[SurfaceNumbers],
    ray: &RayPacket<S>,
    object: U<S>,
    mut t: F<S>,
    hit: M<S>,
) -> (F<S>, V3<S>, Surface<S>, u32) {
    let zero = F::<S>::splat(simd, 0.0);
    let black = V3::splat(simd, Vec3A::ZERO);
    let mut point = black;
    let mut surface = Surface { normal: black, numbers: [zero; SURFACE] };
    let mut todo = hit.to_bitmask();
    let mut only = NOWHERE;
    while todo != 0 {
        let id = object[todo.trailing_zeros() as usize];
        let here = object.simd_eq(U::<S>::splat(simd, id));
        todo &= !here.to_bitmask();
        only = if (hit & !here).any_true() { NOWHERE } else { id };
        let body = &world.objects[id as usize];
        if let Shape::Sphere { .. } = body.shape {
            let (t0, t1, _) = body.shape.span(simd, ray.origin, ray.direction, Ball::Exact);
            let outside = t0.simd_gt(zero) & !ray.from.simd_eq(U::<S>::splat(simd, id));
            t = here.select(outside.select(t0, t1).max(zero), t);
        }
        let mut at = ray.origin + ray.direction * Lane(t);
        if let Shape::Plane { normal, offset } = body.shape {
            // Back onto the plane, so that its texture is a slice at one height.
            at = at - V3::splat(simd, normal) * Lane(at.dot1(normal) - offset);
        }
        point = V3::select(here, at, point);
        let normal = body.shape.normal(simd, at);
        surface.normal = V3::select(here, normal, surface.normal);
        for (number, &value) in surface.numbers.iter_mut().zip(&surfaces[id as usize]) {
            *number = here.select(F::<S>::splat(simd, value), *number);
        }
    }
    (t, point, surface, only)
}

/// Fresnel reflectance of a dielectric for unpolarised light, 0 to 1; the cosine of the refracted ray; and the lanes in
/// which light passes at all. The others reflect totally: 1, and a cosine of 0.
///
/// `eta` is the index on the ray's side over the index behind the surface, finite and above 0; `cosine` that of the angle
/// of incidence, above 0 and at most 1. The result is off by no more than 6e-7 and what three units in the last
/// place of the cosine make of it. A cosine of 0 has the reflectance 1, and so has NaN on either side.
#[inline(always)]
pub fn fresnel<S: Simd>(simd: S, eta: F<S>, cosine: F<S>) -> (F<S>, F<S>, M<S>) {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let incident = eta * cosine;
    let near = (one - eta) * (eta + 1.0) + incident * incident;
    let k = eta.simd_lt(DENSE).select(near, one - eta * eta * (one - cosine * cosine));
    let passes = k.simd_gt(zero);
    let through = k.max(zero).sqrt();
    let s = (incident - through) / (incident + through);
    let p = (eta * through - cosine) / (eta * through + cosine);
    (passes.select((s * s + p * p) * 0.5, one), through, passes)
}
