//! Which bodies a packet may meet: never one too few, against crossings in exact numbers; and how many too many.

use fearless_simd::{Simd, dispatch, prelude::*};
use glam::{Mat3A, Vec3A, vec3a};
use paprsek::simd::lanes::{F, M, U, V3};
use paprsek::trace::bounds::{Bounds, Extent, Shaft, Start};
use paprsek::trace::ray::{RayPacket, Search, nearest};
use paprsek::trace::world::NOWHERE;
use paprsek::trace::{Material, Object, Shape, World};
use testkit::random::Random;
use testkit::span::{Crossing, span};

/// Most lanes of any level.
const LANES: usize = 16;
/// Packets per world.
const PACKETS: usize = 150;

/// Random worlds and packets.
struct Cases(Random);

impl Cases {
    fn of(seed: usize) -> Cases {
        Cases(Random(seed as u64))
    }

    /// From -1 to 1.
    fn number(&mut self) -> f32 {
        self.0.range(-1.0, 1.0) as f32
    }

    fn vector(&mut self) -> Vec3A {
        vec3a(self.number(), self.number(), self.number())
    }

    fn direction(&mut self) -> Vec3A {
        // On an axis now and then, where a division by zero threatens.
        let v = self.vector();
        if self.number() > 0.8 { Vec3A::AXES[v.max_position()] * v.x.signum() } else { v.normalize_or(Vec3A::Y) }
    }

    fn shape(&mut self) -> Shape {
        let (center, size) = (self.vector() * 10.0, 0.02 + self.number().powi(4) * 2.0);
        let half = self.vector().abs() * size + 1e-3;
        let turn = self.0.turn();
        match (self.0.unit() * 16.0) as u32 {
            0..6 => Shape::Sphere { center, radius: size },
            6..9 => Shape::Block { center, half, turn: Mat3A::IDENTITY },
            9..11 => Shape::Block { center, half, turn },
            11..14 => Shape::Cylinder { center, axis: self.direction(), half: half.x, radius: size },
            14 => Shape::Plane { normal: Vec3A::Y, offset: self.number() * 10.0 },
            _ => Shape::Plane { normal: self.direction(), offset: self.number() * 10.0 },
        }
    }

    fn world(&mut self, count: usize) -> World {
        let object = |shape| Object::new(shape, Material::plain(Vec3A::ONE));
        World::new((0..count).map(|_| object(self.shape())).collect())
    }

    /// Origins and directions of rays that are as far apart as rays of packets are, or much farther.
    fn packet(&mut self) -> [[Vec3A; LANES]; 2] {
        let (origin, direction) = (self.vector() * 12.0, self.direction());
        let [near, narrow] = [self.number().powi(6), self.number().powi(6)];
        let mut rays = [[Vec3A::ZERO; LANES]; 2];
        rays[0] = rays[0].map(|_| origin + self.vector() * 4.0 * near);
        rays[1] = rays[1].map(|_| (direction + self.vector() * narrow).normalize_or(direction));
        rays
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, v: &[Vec3A; LANES]) -> V3<S> {
    let [mut x, mut y, mut z] = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        [x[lane], y[lane], z[lane]] = v[lane].to_array();
    }
    let vector = |x: &[f32; LANES]| F::<S>::from_slice(simd, &x[..F::<S>::LEN]);
    V3 { x: vector(&x), y: vector(&y), z: vector(&z) }
}

/// Whether a bit is set for a body, and the count of all that are set.
fn marks<S: Simd>(simd: S, bounds: &Bounds, shaft: &Shaft, body: usize) -> (bool, u32) {
    let (mut marked, mut count) = (false, 0);
    for word in 0..bounds.all.len() {
        if bounds.words(simd, Some(shaft), word / 64) >> (word % 64) & 1 == 0 {
            continue;
        }
        let bits = bounds.bodies(simd, shaft, word) & bounds.all[word];
        count += bits.count_ones();
        marked |= (0..64).any(|bit| bits >> bit & 1 != 0 && bounds.index(word * 64 + bit) == body);
    }
    (marked, count)
}

/// Whether a line is in a body between two distances, without rounding.
fn meets(shape: &Shape, o: Vec3A, d: Vec3A, reach: f64) -> bool {
    span(shape, o, d, 0.0).is_some_and(|[Crossing { t: t0, .. }, Crossing { t: t1, .. }]| t1 > 0.0 && t0 < reach)
}

/// The lanes of a packet that count, which are all but the last, its rays, where they begin, and their shaft.
#[inline(always)]
fn packet<S: Simd>(simd: S, rays: &[[Vec3A; LANES]; 2]) -> (M<S>, RayPacket<S>, Start, Shaft) {
    let active = M::<S>::from_bitmask(simd, (1u64 << (F::<S>::LEN - 1)) - 1);
    let (origin, direction) = (load(simd, &rays[0]), load(simd, &rays[1]));
    let start = Start { origins: Extent::new(simd, origin, active), leaves: NOWHERE };
    let along = Shaft::new(simd, start, Extent::new(simd, direction, active));
    let (from, inward) = (U::<S>::splat(simd, NOWHERE), M::<S>::splat(simd, false));
    (active, RayPacket { origin, direction, from, inward }, start, along)
}

/// Holds the shafts of rays, and of rays to a target, against all bodies.
#[inline(always)]
fn check<S: Simd>(simd: S, world: &World, bounds: &Bounds, rays: &[[Vec3A; LANES]; 2], target: Vec3A) {
    let lanes = F::<S>::LEN;
    let (_, _, start, along) = packet(simd, rays);
    let to = Shaft::to(simd, start, target);
    for (index, body) in world.objects.iter().enumerate() {
        let lane = |lane: usize| (rays[0][lane], rays[1][lane]);
        if (0..lanes - 1).map(lane).any(|(o, d)| meets(&body.shape, o, d, f64::INFINITY)) {
            assert!(marks(simd, bounds, &along, index).0, "{:?} of {rays:?}", body.shape);
        }
        if (0..lanes - 1).map(lane).any(|(o, _)| meets(&body.shape, o, target - o, 1.0)) {
            assert!(marks(simd, bounds, &to, index).0, "{:?} of {rays:?} to {target}", body.shape);
        }
    }
}

/// Holds what is found in the shaft of rays against what is found among all bodies.
#[inline(always)]
fn find<S: Simd>(simd: S, world: &World, bounds: &Bounds, rays: &[[Vec3A; LANES]; 2]) {
    let (active, ray, _, along) = packet(simd, rays);
    let far = F::<S>::splat(simd, 1e30);
    let list = &bounds.all;
    for search in [Search::Nearest, Search::Shadow] {
        let (culled, t, _) = nearest(simd, world, bounds, list, Some(&along), &ray, active, far, search);
        let (all, u, _) = nearest(simd, world, bounds, list, None, &ray, active, far, search);
        for lane in 0..F::<S>::LEN - 1 {
            match search {
                Search::Nearest => assert_eq!((culled[lane], t[lane]), (all[lane], u[lane])),
                Search::Shadow => assert_eq!(t[lane], u[lane]),
            }
        }
    }
}

#[test]
fn no_body_is_left_out_that_a_ray_meets() {
    // Less than a word, words that are partly filled.
    for count in [1, 9, 64, 65, 200] {
        let mut random = Cases::of(1000 * count);
        let world = random.world(count);
        let bounds = Bounds::new(&world);
        for _ in 0..PACKETS / (1 + count / 20) {
            let (rays, target) = (random.packet(), random.vector() * 12.0);
            for (_, level) in testkit::levels() {
                dispatch!(level, simd => check(simd, &world, &bounds, &rays, target));
            }
        }
    }
}

/// From some hundreds of bodies on packets may be taken apart.
#[test]
fn the_same_bodies_are_found_among_few_and_many() {
    for count in [1, 9, 64, 65, 2000] {
        let mut random = Cases::of(1000 * count);
        let world = random.world(count);
        let bounds = Bounds::new(&world);
        for _ in 0..PACKETS {
            let rays = random.packet();
            for (_, level) in testkit::levels() {
                dispatch!(level, simd => find(simd, &world, &bounds, &rays));
            }
        }
    }
}

#[test]
fn every_body_has_one_bit() {
    for count in [0, 1, 64, 65, 129, 5000] {
        let bounds = Bounds::new(&Cases::of(7).world(count));
        let mut seen = vec![0; count];
        for (word, &all) in bounds.all.iter().enumerate() {
            for bit in (0..64).filter(|bit| all >> bit & 1 != 0) {
                seen[bounds.index(word * 64 + bit)] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n == 1), "{count}");
    }
}

/// Few bodies are tested in vain: what culling is for. Narrow packets among balls that fill a thousandth of a cube.
#[test]
fn few_bodies_are_marked() {
    for (count, most) in [(30, 1.5), (1000, 8.0), (10_000, 30.0)] {
        let mut random = Cases::of(count);
        let radius = 10.0 * (1e-3 / count as f32 * 6.0 / std::f32::consts::PI).cbrt();
        let ball = |center| Object::new(Shape::Sphere { center, radius }, Material::plain(Vec3A::ONE));
        let world = World::new((0..count).map(|_| ball(random.vector() * 10.0)).collect());
        let bounds = Bounds::new(&world);
        let (_, level) = testkit::levels()[0];
        let mut sum = 0;
        for _ in 0..PACKETS {
            let (origin, direction) = (random.vector() * 10.0, random.direction());
            let side = |v: Vec3A| Extent::point(v);
            let start = Start { origins: side(origin), leaves: NOWHERE };
            sum += dispatch!(level, simd => marks(simd, &bounds, &Shaft::new(simd, start, side(direction)), 0).1);
        }
        let mean = sum as f64 / PACKETS as f64;
        assert!(mean < most, "{mean} of {count}");
    }
}
