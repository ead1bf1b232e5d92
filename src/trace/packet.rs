//! Whitted's recursion in packets: one eye ray a lane, all levels, and everything that a corner has to remember.
//!
//! Textures are not evaluated here. A sample says which textured surfaces its chain of hits met, where, and how much of
//! their colour it carries (`gain`); [`super::deferred`] looks the colours up later, full blocks at a time.

use super::light::{sky, toward, visibility};
use super::sample::{HIT, PLAIN, REMEMBERED, Sample};
use super::shape::{Ball, FAR, Shape};
use super::world::{ALBEDO, EXPONENT, FILTER, FRESNEL, IOR, REFLECTANCE, SPECULAR, SURFACE, TEXTURED, World};
use crate::simd::block::BLOCK;
use crate::simd::lanes::{Bits, F, Lane, M, U, V3};
use crate::simd::math;
use crate::texture;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;

/// What a packet reads of the frame.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// The scene.
    pub world: &'a World,
    /// What the shading of a hit needs of every object.
    pub surfaces: &'a [[f32; SURFACE]],
    /// The camera.
    pub view: &'a View,
    /// The objects that eye rays may meet, and all that others may.
    pub visible: &'a [u32],
    /// Every object.
    pub all: &'a [u32],
    /// The knobs of the recursion.
    pub limits: Limits,
}

/// The knobs of the recursion.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Secondary rays of less weight are not traced.
    pub min_weight: f32,
    /// Hits of less weight beside a white surface in full light are no part of the chain, and their textures are their
    /// means.
    pub min_detail: f32,
    /// Points on a light that has a size, for eye rays and for the others.
    pub light_samples: [u32; 2],
}

/// A bundle of rays that take the same path (sequence of reflections and refractions) from the eye.
#[derive(Clone, Copy)]
struct Node<S: Simd> {
    active: M<S>,
    /// Lanes too faint to be traced. They are guessed to see the sky: half of the error of leaving them black.
    faint: M<S>,
    ray: Ray<S>,
    weight: V3<S>,
    /// Length of the path up to the ray's origin.
    length: F<S>,
    level: u32,
    /// 1 for the eye ray, then a bit for each level: 0 reflected, 1 refracted.
    path: u32,
}

/// A ray a lane, and where it comes from.
#[derive(Clone, Copy)]
pub struct Ray<S: Simd> {
    /// Start.
    pub origin: V3<S>,
    /// Unit direction.
    pub direction: V3<S>,
    /// The body that the ray leaves, or [`NOWHERE`].
    pub from: U<S>,
    /// Does it go inside?
    pub inward: M<S>,
}

/// No body.
pub const NOWHERE: u32 = u32::MAX;
/// Highlights of more light than this are part of a corner's state: the skirt of a highlight finds the highlight.
const HIGHLIGHT: f32 = 1.0 / 16.0;

/// Light beside which a difference is judged even where there is none.
const DARK: f32 = 0.25;

/// Normal and material of what each lane has hit.
struct Surface<S: Simd> {
    normal: V3<S>,
    numbers: [F<S>; SURFACE],
}

impl<S: Simd> Surface<S> {
    /// The colour that begins at that number.
    #[inline(always)]
    fn color(&self, at: usize) -> V3<S> {
        V3 { x: self.numbers[at], y: self.numbers[at + 1], z: self.numbers[at + 2] }
    }
}

/// Traces the eye rays through `xs`, `ys` (pixels) into the samples `out`, in order. All are of the same length.
#[simd]
pub fn trace<S: Simd>(simd: S, context: &Context, xs: &[f32], ys: &[f32], out: &mut [Sample]) {
    let lanes = F::<S>::LEN;
    let mut stack = Vec::new();
    let mut px = [0.0; 64];
    let mut py = [0.0; 64];
    let mut at = 0;
    while at < xs.len() {
        let count = lanes.min(xs.len() - at);
        // The last packet repeats its last ray.
        for lane in 0..lanes {
            px[lane] = xs[at + lane.min(count - 1)];
            py[lane] = ys[at + lane.min(count - 1)];
        }
        let (x, y) = (F::<S>::from_slice(simd, &px[..lanes]), F::<S>::from_slice(simd, &py[..lanes]));
        packet(simd, context, context.view.rays(simd, x, y), &mut out[at..at + count], &mut stack);
        at += count;
    }
}

/// One packet of eye rays, to its last reflection.
#[simd]
fn packet<S: Simd>(simd: S, context: &Context, ray: V3<S>, out: &mut [Sample], stack: &mut Vec<Node<S>>) {
    let Context { world, limits, .. } = *context;
    let eye = context.view.camera().eye;
    let zero = F::<S>::splat(simd, 0.0);
    let one = F::<S>::splat(simd, 1.0);
    for sample in out.iter_mut() {
        // Numbers beyond `used` may stay what they were.
        (sample.count, sample.numbers[0], sample.numbers[1], sample.numbers[2]) = (0, 0.0, 0.0, 0.0);
    }
    let lanes_in_use = M::<S>::from_bitmask(simd, (1u64 << out.len()) - 1);
    let step = ray.dot(ray).sqrt();
    let mut path_signature = U::<S>::splat(simd, 0);
    let mut light = V3::splat(simd, Vec3::ZERO);
    // Light of white surfaces so far.
    let mut seen = zero;
    let mut first_closeness = zero;
    stack.clear();
    let mut next = Some(Node {
        active: lanes_in_use,
        faint: M::<S>::splat(simd, false),
        ray: Ray {
            origin: V3::splat(simd, eye),
            direction: ray * Lane(one / step),
            from: U::<S>::splat(simd, NOWHERE),
            inward: M::<S>::splat(simd, false),
        },
        weight: V3 { x: one, y: one, z: one },
        length: zero,
        level: 1,
        path: 1,
    });
    loop {
        let node = match next.take() {
            Some(node) => node,
            None => match stack.pop() {
                Some(node) => node,
                None => break,
            },
        };
        let Node { active, weight, length, level, path, .. } = node;
        let direction = node.ray.direction;
        let far = F::<S>::splat(simd, FAR);
        let (mut object, mut t) = (U::<S>::splat(simd, NOWHERE), far);
        if active.any_true() {
            let list = if level == 1 { context.visible } else { context.all };
            (object, t) = nearest(simd, world, list, &node.ray, active, far, false);
        }
        // Beside much light little is seen (Weber), in the dark it is.
        let detailed = weight.max_element().simd_gt((seen + DARK) * limits.min_detail);
        let hit = active & object.simd_ne(U::<S>::splat(simd, NOWHERE));
        let missed = (active & !hit) | node.faint;
        if missed.any_true() {
            light = light + sky(simd, world, direction).mulv(weight).masked(simd, missed);
        }
        let mut state = U::<S>::splat(simd, 0);
        if hit.any_true() {
            let (t, point, surface) = resolve(simd, context, &node.ray, object, t, hit);
            let length = length + t;
            let inv_depth = step / length;
            if level == 1 {
                first_closeness = hit.select(inv_depth, zero);
            }
            let facing = -direction.dot(surface.normal);
            let inside = facing.simd_lt(zero);
            let cosine = facing.abs();
            let normal = V3::select(inside, -surface.normal, surface.normal);
            let (shininess, ior) = (surface.numbers[SPECULAR], surface.numbers[IOR]);
            let glass = hit & ior.simd_gt(zero);
            let matt = hit & !glass;
            let shaded = matt | (glass & shininess.simd_gt(zero));

            // Local light: what is left beside the mirror.
            let grazing = one - cosine.min(one);
            let grazing = grazing * grazing * (grazing * grazing) * grazing;
            let boost = surface.numbers[FRESNEL] * grazing;
            let reflectance = surface.color(REFLECTANCE);
            let mirror = reflectance + (V3 { x: one, y: one, z: one } - reflectance) * Lane(boost);
            let local = (weight - weight.mulv(mirror)).masked(simd, matt);
            let mut diffuse = V3::splat(simd, world.ambient);
            let mut specular = V3::splat(simd, Vec3::ZERO);
            if shaded.any_true() {
                let samples = limits.light_samples[(level > 1) as usize];
                for (index, source) in world.lights.iter().enumerate() {
                    let (to_light, reach) = toward(simd, source, point);
                    let cos_light = normal.dot(to_light);
                    let front = shaded & cos_light.simd_gt(zero);
                    if !front.any_true() {
                        continue;
                    }
                    let seen = visibility(simd, context, samples, source, point, to_light, reach, object, front);
                    let lit = front & seen.simd_gt(zero);
                    let glint = cos_light * cosine * 2.0 + to_light.dot(direction);
                    let shiny = lit & glint.simd_gt(zero) & shininess.simd_gt(zero);
                    let mut shine = zero;
                    if shiny.any_true() {
                        let power = math::exp2(simd, math::log2(simd, glint) * surface.numbers[EXPONENT]);
                        shine = shiny.select(power * shininess * seen, zero);
                    }
                    let amount = lit.select(cos_light * seen, zero);
                    diffuse = diffuse + V3::splat(simd, source.color) * Lane(amount);
                    specular = specular + V3::splat(simd, source.color) * Lane(shine);
                    // 0 unlit, 1 lit, 2 lit with a highlight, 3 half lit.
                    let bright = lit & (shine * weight.max_element()).simd_gt(F::<S>::splat(simd, HIGHLIGHT));
                    let half = lit & seen.simd_lt(one);
                    let code = half.select(
                        U::<S>::splat(simd, 3),
                        bright
                            .select(U::<S>::splat(simd, 2), lit.select(U::<S>::splat(simd, 1), U::<S>::splat(simd, 0))),
                    );
                    state |= code << (2 * index as u32);
                }
            }
            // Glass shows the lights themselves and nothing else of its own.
            let shine = specular.mulv(V3::select(glass, weight, local));
            light = light + shine.masked(simd, shaded);
            let gain = local.mulv(diffuse);
            seen += gain.max_element();
            let textured = matt & surface.numbers[TEXTURED].simd_gt(zero) & detailed;
            light = light + gain.mulv(surface.color(ALBEDO)).masked(simd, matt & !textured);
            if textured.any_true() {
                remember(simd, world, textured.to_bitmask(), &object, &[gain, point], &inv_depth, out);
            }

            if level < world.max_level {
                let least = F::<S>::splat(simd, limits.min_weight);
                let child = Node { length, level: level + 1, ..node };
                let leaving = Ray { origin: point, from: object, ..node.ray };
                let mirrored = direction + normal * Lane(cosine * 2.0);
                let mut reflected = weight.mulv(mirror);
                let mut stays_inside = M::<S>::splat(simd, false);
                if glass.any_true() {
                    let eta = inside.select(ior, one / ior);
                    let (share, cos_through, passes) = fresnel(simd, eta, cosine);
                    let bend = eta * cosine - cos_through;
                    let refracted = direction * Lane(eta) + normal * Lane(bend);
                    let through = weight.mulv(surface.color(FILTER)) * Lane(one - share);
                    let (active, faint) = strength(simd, glass & passes, through, least);
                    if (active | faint).any_true() {
                        let ray = Ray { direction: refracted, inward: !inside, ..leaving };
                        stack.push(Node { active, faint, ray, weight: through, path: path * 2 + 1, ..child });
                    }
                    reflected = V3::select(glass, weight * Lane(share), reflected);
                    stays_inside = glass & inside;
                }
                let (active, faint) = strength(simd, hit, reflected, least);
                if (active | faint).any_true() {
                    let ray = Ray { direction: mirrored, inward: stays_inside, ..leaving };
                    next = Some(Node { active, faint, ray, weight: reflected, path: path * 2, ..child });
                }
            }
        }
        let code = hash(simd, (object + 1) ^ (state << 12), path);
        path_signature += (active & detailed).select(code, U::<S>::splat(simd, 0));
    }
    for (lane, sample) in out.iter_mut().enumerate() {
        sample.path_signature = path_signature[lane];
        // Textures that did not fit are in the light already.
        sample.numbers[0] += light.x[lane];
        sample.numbers[1] += light.y[lane];
        sample.numbers[2] += light.z[lane];
        sample.numbers[3] = first_closeness[lane];
    }
}

/// Which of the `wanted` lanes have weight enough to be traced, and which have less but some.
#[inline(always)]
fn strength<S: Simd>(simd: S, wanted: M<S>, weight: V3<S>, least: F<S>) -> (M<S>, M<S>) {
    let most = weight.max_element();
    let strong = most.simd_gt(least);
    (wanted & strong, wanted & !strong & most.simd_gt(F::<S>::splat(simd, 0.0)))
}

/// The nearest of the bodies in `list` for every lane, or [`NOWHERE`], and its distance but for a few ulps.
///
/// For the `shadow` of a light at the distance `reach`: any body before it that casts shadows, whose distance does not matter. The search ends
/// when all `active` lanes are dark.
#[simd]
#[allow(clippy::too_many_arguments)]
pub fn nearest<S: Simd>(
    simd: S,
    world: &World,
    list: &[u32],
    ray: &Ray<S>,
    active: M<S>,
    reach: F<S>,
    shadow: bool,
) -> (U<S>, F<S>) {
    let zero = F::<S>::splat(simd, 0.0);
    let nowhere = U::<S>::splat(simd, NOWHERE);
    let (mut best, mut object) = (reach, nowhere);
    let ball = if shadow { Ball::Middle } else { Ball::Rough };
    for &index in list {
        let body = &world.objects[index as usize];
        if shadow && !body.casts_shadow {
            continue;
        }
        let (t0, t1, hit) = body.shape.span(simd, ray.origin, ray.direction, ball);
        if !(hit & active).any_true() {
            continue;
        }
        let id = U::<S>::splat(simd, index);
        let other = !ray.from.simd_eq(id);
        if shadow {
            object = (hit & other & t1.simd_gt(zero) & t0.simd_lt(reach)).select(id, object);
            if !(active & object.simd_eq(nowhere)).any_true() {
                break;
            }
        } else {
            // Outwards the body that the ray leaves does not count; inwards only its far side does.
            let t = (t0.simd_gt(zero) & other).select(t0, t1);
            let meets = hit & t.simd_gt(zero) & t.simd_lt(best) & (other | ray.inward);
            best = meets.select(t, best);
            object = meets.select(id, object);
        }
    }
    (object, best)
}

/// Distance, point and surface of every lane's hit, from what [`nearest`] found: once for each of the few bodies that a
/// packet meets.
#[inline(always)]
fn resolve<S: Simd>(
    simd: S,
    context: &Context,
    ray: &Ray<S>,
    object: U<S>,
    mut t: F<S>,
    hit: M<S>,
) -> (F<S>, V3<S>, Surface<S>) {
    let zero = F::<S>::splat(simd, 0.0);
    let black = V3::splat(simd, Vec3::ZERO);
    let mut point = black;
    let mut surface = Surface { normal: black, numbers: [zero; SURFACE] };
    let mut todo = hit.to_bitmask();
    while todo != 0 {
        let id = object[todo.trailing_zeros() as usize];
        let here = object.simd_eq(U::<S>::splat(simd, id));
        todo &= !here.to_bitmask();
        let body = &context.world.objects[id as usize];
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
        for (number, &value) in surface.numbers.iter_mut().zip(&context.surfaces[id as usize]) {
            *number = here.select(F::<S>::splat(simd, value), *number);
        }
    }
    (t, point, surface)
}

/// Unpolarised Fresnel reflectance of a dielectric, the cosine behind the surface, and where light passes at all.
///
/// `eta` is the index on the ray's side over the index behind.
#[inline(always)]
fn fresnel<S: Simd>(simd: S, eta: F<S>, cosine: F<S>) -> (F<S>, F<S>, M<S>) {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let k = one - eta * eta * (one - cosine * cosine);
    let passes = k.simd_gt(zero);
    let through = k.max(zero).sqrt();
    let s = (eta * cosine - through) / (eta * cosine + through);
    let p = (eta * through - cosine) / (eta * through + cosine);
    (passes.select((s * s + p * p) * 0.5, one), through, passes)
}

/// Notes the textured hits of a packet, lane by lane: `vectors` are gain and point.
#[inline(always)]
fn remember<S: Simd>(
    simd: S,
    world: &World,
    lanes: u64,
    object: &U<S>,
    vectors: &[V3<S>; 2],
    inv_depth: &F<S>,
    out: &mut [Sample],
) {
    let [gain, point] = vectors;
    let mut late = 0u64;
    for lane in Bits(lanes) {
        let sample = &mut out[lane];
        let n = sample.count as usize;
        if n == REMEMBERED {
            late |= 1 << lane;
            continue;
        }
        let k = inv_depth[lane];
        let point = [point.x[lane] * k, point.y[lane] * k, point.z[lane] * k];
        sample.object[n] = object[lane];
        let hit = &mut sample.numbers[PLAIN + HIT * n..][..HIT];
        hit[..3].copy_from_slice(&[gain.x[lane], gain.y[lane], gain.z[lane]]);
        hit[3..6].copy_from_slice(&point);
        hit[6] = k;
        sample.count += 1;
    }
    // What finds no place is looked up on the spot, once for each object.
    while late != 0 {
        let id = object[late.trailing_zeros() as usize];
        let here = late & object.simd_eq(U::<S>::splat(simd, id)).to_bitmask();
        late &= !here;
        let (mut points, mut color) = ([[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3]);
        point.store(&mut points, 0);
        texture::shade(simd, &world.objects[id as usize].material.albedo, &points, None, &mut color);
        for lane in Bits(here) {
            let numbers = &mut out[lane].numbers;
            numbers[0] += color[0][lane] * gain.x[lane];
            numbers[1] += color[1][lane] * gain.y[lane];
            numbers[2] += color[2][lane] * gain.z[lane];
        }
    }
}

/// Mixes what was hit with the path that led there.
#[inline(always)]
fn hash<S: Simd>(simd: S, key: U<S>, path: u32) -> U<S> {
    let h = (key ^ U::<S>::splat(simd, path.wrapping_mul(0x9E37_79B1))) * 0x85EB_CA6B;
    let h = (h ^ (h >> 15)) * 0x2C1B_3C6D;
    h ^ (h >> 13)
}
