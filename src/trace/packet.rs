//! Whitted's recursion `[Whitted80]` in packets: one eye ray per lane, followed through its whole tree of rays.
//!
//! All lanes of a packet take the same path of reflections and refractions; lanes that have nothing to follow there are
//! switched off. The tree is walked depth first, mirrored rays at once and refracted ones from a stack:
//!
//! ```text
//! for each node of the tree, the eye rays first:
//!     hit     find the nearest body per lane; lanes that miss, or are too faint to be traced, add the background
//!     shade   add highlights and untextured light; remember textured hits with their gain
//!     spawn   push the refracted rays, go on with the mirrored ones
//!     mix object, path and the state of every light into the path signature, where the hit counts
//! ```
//!
//! Textures are not evaluated here. A sample says which textured surfaces were hit, where, and how much of their colour it
//! carries (`gain`); [`super::deferred`] looks the colours up later, full blocks at a time. Approximations are the two
//! thresholds of [`Limits`] and the points on soft lights; [`super::reference`] is the recursion without any.

use super::bounds::{Bounds, Extent, Shaft, Start};
use super::light::{Aim, aim, background, visibility};
use super::ray::{RayPacket, Search, nearest};
use super::sample::{HIT, HIT_INV_DEPTH, PLAIN, POINT, REMEMBERED, Sample};
use super::shape::FAR;
use super::surface::{ALBEDO, EXPONENT, FILTER, IOR, SPECULAR, Surface, SurfaceNumbers, TEXTURED, fresnel, resolve};
use super::world::{NOWHERE, World};
use crate::simd::block::BLOCK;
use crate::simd::lanes::{Bits, F, Lane, M, U, V3, masked};
use crate::simd::math;
use crate::texture;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;

/// What a packet reads of the frame and the tile.
#[derive(Clone, Copy)]
pub struct TraceContext<'a> {
    /// The world.
    pub world: &'a World,
    /// What shading needs of the material of every object.
    pub surfaces: &'a [SurfaceNumbers],
    /// The view.
    pub view: &'a View,
    /// Boxes around the objects.
    pub bounds: &'a Bounds,
    /// The bits of the objects that eye rays of the tile may meet.
    pub visible: &'a [u64],
    /// Limits of the recursion.
    pub limits: Limits,
}

/// Limits of the recursion.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Secondary rays of at most this weight are not traced.
    pub min_weight: f32,
    /// Hits whose weight is at most this share of the light gathered before them are no part of the path signature, and
    /// have the mean of their texture.
    pub min_detail: f32,
    /// Points on a light with a radius: as eye rays see it, and as all others do.
    pub light_samples: [u32; 2],
}

/// A packet of rays that reached the same place in the tree.
#[derive(Clone, Copy)]
struct Node<S: Simd> {
    /// Lanes that are traced.
    active: M<S>,
    /// Lanes too faint to be traced. They are guessed to see the background: half the error of leaving them black.
    faint: M<S>,
    ray: RayPacket<S>,
    start: Start,
    /// Share of the ray's light that reaches the eye.
    weight: V3<S>,
    /// Length of the path up to the ray's origin, metres.
    length: F<S>,
    /// 1 for the eye rays, one more with each reflection or refraction.
    level: u32,
    /// 1 for the eye rays, then one more bit per level: 0 reflected, 1 refracted.
    path: u32,
}

/// Where a packet has met bodies.
struct Hit<S: Simd> {
    /// Lanes that have met one.
    lanes: M<S>,
    /// Those of them on glass.
    glass: M<S>,
    object: U<S>,
    /// Of rays that leave the hits outwards.
    start: Start,
    /// Length of the path up to here, metres.
    length: F<S>,
    point: V3<S>,
    surface: Surface<S>,
    /// Unit normal, towards the ray.
    normal: V3<S>,
    /// Of the angle between the ray and the normal.
    cosine: F<S>,
    /// Lanes whose ray comes from inside the body.
    inside: M<S>,
    /// Share of each colour that a mirror on an opaque surface reflects.
    mirror: V3<S>,
}

/// Light of the scene's lights at a hit.
struct Lit<S: Simd> {
    /// Off a white surface.
    diffuse: V3<S>,
    specular: V3<S>,
    /// Two bits per light, for the path signature.
    states: U<S>,
}

/// Highlights with more light than this are part of the path signature. It is low, so that the wide skirt of a highlight
/// leads to the highlight.
const HIGHLIGHT: f32 = 1.0 / 16.0;

/// The light beside which a difference is judged where no light has been gathered yet.
const DARK: f32 = 0.25;

// States of a light at a hit, two bits each.
const UNLIT: u32 = 0;
const LIT: u32 = 1;
const HIGHLIT: u32 = 2;
const PARTLY_LIT: u32 = 3;

/// Bodies of which all are tested, since finding those that matter takes as long.
const FEW: u32 = 5;

/// Most lanes of any SIMD level.
const MOST_LANES: usize = 16;

/// Traces the eye rays through the points `xs`, `ys` (pixels from the picture's top left) into the samples `out`, in order.
/// All three have the same length.
#[simd]
pub fn trace<S: Simd>(simd: S, context: &TraceContext, xs: &[f32], ys: &[f32], out: &mut [Sample]) {
    let lanes = F::<S>::LEN;
    let mut stack = Vec::new();
    let mut px = [0.0; MOST_LANES];
    let mut py = [0.0; MOST_LANES];
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

/// Follows one packet of unnormalised eye rays through its tree; the module's text has the outline. The stack is memory
/// that packets share, empty before and after.
#[simd]
fn packet<S: Simd>(simd: S, context: &TraceContext, ray: V3<S>, out: &mut [Sample], stack: &mut Vec<Node<S>>) {
    let TraceContext { world, limits, .. } = *context;
    let zero = F::<S>::splat(simd, 0.0);
    for sample in out.iter_mut() {
        // Numbers beyond `used` may stay what they were.
        (sample.count, sample.numbers[0], sample.numbers[1], sample.numbers[2]) = (0, 0.0, 0.0, 0.0);
    }
    let lanes = M::<S>::from_bitmask(simd, (1u64 << out.len()) - 1);
    let step = ray.dot(ray).sqrt();
    let mut path_signature = U::<S>::splat(simd, 0);
    let mut light = V3::splat(simd, Vec3A::ZERO);
    // The light so far if all textures were white: what `min_detail` is a share of.
    let mut gathered = zero;
    let mut first_inv_depth = zero;
    stack.clear();
    let direction = ray * Lane(F::<S>::splat(simd, 1.0) / step);
    let mut node = Node::root(simd, context.view.camera().eye, direction, lanes);
    loop {
        let Node { active, weight, level, path, .. } = node;

        // Hit.
        let (object, t) = meet(simd, context, &node);
        // Beside much light little is seen (Weber), in the dark it is.
        let detailed = weight.max_element().simd_gt((gathered + DARK) * limits.min_detail);
        let lanes = active & object.simd_ne(U::<S>::splat(simd, NOWHERE));
        let missed = (active & !lanes) | node.faint;
        if missed.any_true() {
            let behind = background(simd, &world.background, node.ray.direction);
            light = light + behind.mulv(weight).masked(missed);
        }
        let mut states = U::<S>::splat(simd, UNLIT);
        let mut goes_on = false;
        if lanes.any_true() {
            let hit = Hit::new(simd, context, &node, object, t, lanes);
            let inv_depth = step / hit.length;
            if level == 1 {
                first_inv_depth = masked::<S>(inv_depth, lanes);
            }

            // Shade: the surface's own light is what is left beside the mirror.
            let matte = lanes & !hit.glass;
            let shaded = matte | (hit.glass & hit.surface.numbers[SPECULAR].simd_gt(zero));
            let local = (weight - weight.mulv(hit.mirror)).masked(matte);
            let lit = illuminate(simd, context, &node, &hit, shaded);
            states = lit.states;
            // Glass shows the lights themselves and nothing else of its own.
            let shine = lit.specular.mulv(V3::select(hit.glass, weight, local));
            light = light + shine.masked(shaded);
            let gain = local.mulv(lit.diffuse);
            gathered += gain.max_element();
            let textured = matte & hit.surface.numbers[TEXTURED].simd_gt(zero) & detailed;
            light = light + gain.mulv(hit.surface.color(ALBEDO)).masked(matte & !textured);
            if textured.any_true() {
                remember(simd, world, textured.to_bitmask(), &object, &[gain, hit.point], &inv_depth, out);
            }

            if level < world.max_level {
                goes_on = spawn(simd, limits.min_weight, &mut node, &hit, stack);
            }
        }
        let code = hash(simd, (object + 1) ^ (states << 12), path);
        path_signature += (active & detailed).select(code, U::<S>::splat(simd, 0));
        if !goes_on {
            match stack.pop() {
                Some(next) => node = next,
                None => break,
            }
        }
    }
    for (lane, sample) in out.iter_mut().enumerate() {
        sample.path_signature = path_signature[lane];
        let [red, green, blue, inv_depth, ..] = &mut sample.numbers;
        // Added, because textures that found no place are there already.
        *red += light.x[lane];
        *green += light.y[lane];
        *blue += light.z[lane];
        *inv_depth = first_inv_depth[lane];
    }
}

impl<S: Simd> Node<S> {
    /// The eye rays.
    #[inline(always)]
    fn root(simd: S, eye: Vec3A, direction: V3<S>, active: M<S>) -> Node<S> {
        let one = F::<S>::splat(simd, 1.0);
        let nothing = M::<S>::splat(simd, false);
        let from = U::<S>::splat(simd, NOWHERE);
        Node {
            active,
            faint: nothing,
            ray: RayPacket { origin: V3::splat(simd, eye), direction, from, inward: nothing },
            start: Start { origins: Extent::point(eye), leaves: NOWHERE },
            weight: V3 { x: one, y: one, z: one },
            length: F::<S>::splat(simd, 0.0),
            level: 1,
            path: 1,
        }
    }
}

/// The nearest body of every active lane, or [`NOWHERE`], and its rough distance.
#[inline(always)]
fn meet<S: Simd>(simd: S, context: &TraceContext, node: &Node<S>) -> (U<S>, F<S>) {
    let far = F::<S>::splat(simd, FAR);
    if !node.active.any_true() {
        return (U::<S>::splat(simd, NOWHERE), far);
    }
    let TraceContext { world, bounds, visible, .. } = *context;
    let Node { ray, active, .. } = node;
    if node.level == 1 && visible.iter().map(|word| word.count_ones()).sum::<u32>() <= FEW {
        let (object, t, _) = nearest(simd, world, bounds, visible, None, ray, *active, far, Search::Nearest);
        return (object, t);
    }
    let list = if node.level == 1 { visible } else { &bounds.all };
    let shaft = Shaft::new(simd, node.start, Extent::new(simd, ray.direction, *active));
    let (object, t, _) = nearest(simd, world, bounds, list, Some(&shaft), ray, *active, far, Search::Nearest);
    (object, t)
}

impl<S: Simd> Hit<S> {
    /// What is at the rough distance `t` on the bodies `object`, for the `lanes` that have met one.
    #[inline(always)]
    fn new(simd: S, context: &TraceContext, node: &Node<S>, object: U<S>, t: F<S>, lanes: M<S>) -> Hit<S> {
        let zero = F::<S>::splat(simd, 0.0);
        let (t, point, surface, leaves) = resolve(simd, context.world, context.surfaces, &node.ray, object, t, lanes);
        let facing = -node.ray.direction.dot(surface.normal);
        let inside = facing.simd_lt(zero);
        let cosine = facing.abs();
        let normal = V3::select(inside, -surface.normal, surface.normal);
        let glass = lanes & surface.numbers[IOR].simd_gt(zero);
        let mirror = surface.mirror(simd, cosine);
        let start = Start { origins: Extent::new(simd, point, lanes), leaves };
        Hit { lanes, glass, object, start, length: node.length + t, point, surface, normal, cosine, inside, mirror }
    }
}

/// Diffuse light and highlights of all lights in the `shaded` lanes, and the state of every light there.
#[inline(always)]
fn illuminate<S: Simd>(simd: S, context: &TraceContext, node: &Node<S>, hit: &Hit<S>, shaded: M<S>) -> Lit<S> {
    let TraceContext { world, limits, .. } = *context;
    let Hit { object, point, normal, cosine, .. } = *hit;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let shininess = hit.surface.numbers[SPECULAR];
    let mut diffuse = V3::splat(simd, world.ambient);
    let mut specular = V3::splat(simd, Vec3A::ZERO);
    let mut states = U::<S>::splat(simd, UNLIT);
    if !shaded.any_true() {
        return Lit { diffuse, specular, states };
    }
    let samples = limits.light_samples[(node.level > 1) as usize];
    for (index, source) in world.lights.iter().enumerate() {
        let Aim { direction, reach } = aim(simd, source, point);
        let cos_light = normal.dot(direction);
        let front = shaded & cos_light.simd_gt(zero);
        if !front.any_true() {
            continue;
        }
        let seen = visibility(
            simd,
            world,
            context.bounds,
            samples,
            source,
            hit.start,
            point,
            Aim { direction, reach },
            object,
            front,
        );
        let most = seen.max_element();
        let lit = front & most.simd_gt(zero);
        // The cosine between the mirrored ray and the light [Phong75].
        let glint = cos_light * cosine * 2.0 + direction.dot(node.ray.direction);
        let near = noticeable(simd, glint, hit.surface.numbers[EXPONENT]);
        let shiny = lit & glint.simd_gt(zero) & shininess.simd_gt(zero) & near;
        let mut shine = zero;
        if shiny.any_true() {
            let power = math::powf(simd, glint, hit.surface.numbers[EXPONENT]);
            shine = masked::<S>(power * shininess, shiny);
        }
        // Lanes that are not lit may have anything, also what is not a number.
        let color = V3::splat(simd, source.color).mulv(seen).masked(lit);
        diffuse = diffuse + color * Lane(masked::<S>(cos_light, lit));
        specular = specular + color * Lane(shine);
        let bright = lit & (shine * most * node.weight.max_element()).simd_gt(F::<S>::splat(simd, HIGHLIGHT));
        let partly = lit & most.simd_ne(one);
        let state = |state| U::<S>::splat(simd, state);
        let code =
            partly.select(state(PARTLY_LIT), bright.select(state(HIGHLIT), lit.select(state(LIT), state(UNLIT))));
        states |= code << (2 * index as u32);
    }
    Lit { diffuse, specular, states }
}

/// Where the power of a cosine can be seen: it is less than e^-24 elsewhere, since `g^n <= e^(n (g - 1))`. That is below
/// half an ulp of whatever light it is added to, and most highlights are that far from most directions.
#[inline(always)]
fn noticeable<S: Simd>(simd: S, cosine: F<S>, exponent: F<S>) -> M<S> {
    ((F::<S>::splat(simd, 1.0) - cosine) * exponent).simd_lt(F::<S>::splat(simd, 24.0))
}

/// Makes a packet that has met bodies that of the mirrored rays, and leaves the refracted ones on the stack. Returns whether
/// anything is mirrored. In place, since a packet is 0.6 kB.
#[inline(always)]
fn spawn<S: Simd>(simd: S, min_weight: f32, node: &mut Node<S>, hit: &Hit<S>, stack: &mut Vec<Node<S>>) -> bool {
    let Hit { glass, normal, cosine, inside, .. } = *hit;
    let Node { weight, path, .. } = *node;
    let direction = node.ray.direction;
    let one = F::<S>::splat(simd, 1.0);
    let least = F::<S>::splat(simd, min_weight);
    (node.length, node.level) = (hit.length, node.level + 1);
    (node.ray.origin, node.ray.from) = (hit.point, hit.object);
    let mirrored = direction + normal * Lane(cosine * 2.0);
    let mut reflected = weight.mulv(hit.mirror);
    let mut stays_inside = M::<S>::splat(simd, false);
    if glass.any_true() {
        let ior = hit.surface.numbers[IOR];
        let eta = inside.select(ior, one / ior);
        let (share, cos_through, passes) = fresnel(simd, eta, cosine);
        let bend = eta * cosine - cos_through;
        let refracted = direction * Lane(eta) + normal * Lane(bend);
        let through = weight.mulv(hit.surface.color(FILTER)) * Lane(one - share);
        let (active, faint) = strength(simd, glass & passes, through, least);
        if (active | faint).any_true() {
            let ray = RayPacket { origin: hit.point, direction: refracted, from: hit.object, inward: !inside };
            let start = hit.start.without(simd, active & !inside);
            let Node { length, level, .. } = *node;
            stack.push(Node { active, faint, ray, start, weight: through, length, level, path: path * 2 + 1 });
        }
        reflected = V3::select(glass, weight * Lane(share), reflected);
        stays_inside = glass & inside;
    }
    (node.active, node.faint) = strength(simd, hit.lanes, reflected, least);
    (node.ray.direction, node.ray.inward) = (mirrored, stays_inside);
    node.start = hit.start.without(simd, stays_inside);
    (node.weight, node.path) = (reflected, path * 2);
    (node.active | node.faint).any_true()
}

/// The `wanted` lanes whose weight is more than `least` and that are traced, and those that have less but some.
#[inline(always)]
fn strength<S: Simd>(simd: S, wanted: M<S>, weight: V3<S>, least: F<S>) -> (M<S>, M<S>) {
    let most = weight.max_element();
    let strong = most.simd_gt(least);
    (wanted & strong, wanted & !strong & most.simd_gt(F::<S>::splat(simd, 0.0)))
}

/// Adds the textured hits of a packet to its samples, lane by lane; `vectors` are gain and point.
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
        hit[..POINT].copy_from_slice(&[gain.x[lane], gain.y[lane], gain.z[lane]]);
        hit[POINT..HIT_INV_DEPTH].copy_from_slice(&point);
        hit[HIT_INV_DEPTH] = k;
        sample.count += 1;
    }
    // What finds no place is looked up on the spot, once for each object.
    while late != 0 {
        let id = object[late.trailing_zeros() as usize];
        let here = late & object.simd_eq(U::<S>::splat(simd, id)).to_bitmask();
        late &= !here;
        let mut block = [[0.0; BLOCK]; 3];
        point.store(&mut block, 0);
        texture::shade(simd, &world.objects[id as usize].material.albedo, &mut block, F::<S>::LEN, None);
        for lane in Bits(here) {
            let [red, green, blue, ..] = &mut out[lane].numbers;
            *red += block[0][lane] * gain.x[lane];
            *green += block[1][lane] * gain.y[lane];
            *blue += block[2][lane] * gain.z[lane];
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
