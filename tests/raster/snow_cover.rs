//! Snow that settles, against its formula in f64 and what stands above a point.

use glam::{DVec3, Vec2, Vec3A, Vec3Swizzles as _, vec2, vec3a};
use paprsek::frame::Cache;
use paprsek::noise::noise;
use paprsek::raster::snow_cover::{EDGE, GRAIN, KEEPS, PRINT, RELIEF, ROUGH, SINKS, STANCE, STEP, VARIES, WHITE};
use paprsek::raster::{Bias, Body, Light, Mesh, Projection, ShadowViews, SnowCover, World};
use paprsek::settings::Quality;
use paprsek::texture::{Palette, Pattern};
use paprsek::view::Camera;
use testkit::drawn::{Planes, block, body, dark, draw, draw_with, enters, ground, ray, triangles};

const SIZE: [usize; 2] = [160, 100];
const AMOUNTS: [f32; 7] = [0.0, 0.1, 0.25, 0.4, 0.6, 0.85, 1.0];
/// Dark ground, as of a meadow in late autumn.
const GROUND: Vec3A = vec3a(0.16, 0.14, 0.05);

/// A shadow of one view straight down, `width` metres wide.
fn shadow_views(width: f32, texels: u32) -> ShadowViews {
    let views = vec![Projection::parallel(Vec3A::Y, Vec3A::ZERO, width, texels)];
    ShadowViews::new(views, Bias { constant: 0.05, slope: 2.0, normal: 0.0 })
}

fn snow(amount: f32, shadow: Option<ShadowViews>) -> Option<SnowCover> {
    let fall = Light { shadow, ..Light::sun(Vec3A::Y, Vec3A::ONE) };
    Some(SnowCover { amount, fall, sky: Vec3A::ZERO, track: [Vec2::ZERO; 2] })
}

/// Light from all around, so that a picture has the albedo of what it shows.
fn even(bodies: Vec<Body>) -> World {
    World { ambient: [Vec3A::ONE, Vec3A::ZERO], ..dark(bodies) }
}

fn paint(mut mesh: Mesh, albedo: Vec3A, gloss: f32) -> Mesh {
    (mesh.paints[0].albedo, mesh.paints[0].gloss) = (albedo, gloss);
    mesh
}

fn picture(world: &World, camera: Camera) -> Planes {
    draw(world, camera, SIZE, Quality::FAST, testkit::levels()[0].1)
}

fn from_above() -> Camera {
    Camera::look_at(vec3a(2.0, 9.0, 11.0), Vec3A::ZERO, 0.7, 0.0)
}

/// Where a pixel's eye ray meets the ground at a height of 0, and what it is there.
struct Spot {
    /// The ray, its axial part 1, and how far along it.
    ray: DVec3,
    depth: f64,
    point: DVec3,
    grain: f64,
    /// Length of the pixel there.
    footprint: f64,
}

/// On a plane through the origin.
fn spot(camera: &Camera, pixel: usize, normal: DVec3) -> Spot {
    let ray = ray(camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
    let eye = camera.eye.as_dvec3();
    let depth = -eye.dot(normal) / ray.dot(normal);
    let point = eye + ray * depth;
    // A pixel's length there, as the rasterizer has it; octaves of noise fade over it.
    let stretch = 1.0 / ray.normalize().dot(normal).abs().max(0.04).sqrt();
    let footprint = depth * stretch * camera.up.length() as f64 * 2.0 / SIZE[1] as f64;
    let Pattern::Clouds { octaves } = GRAIN.pattern else { unreachable!() };
    let Palette::Mix(_, most) = GRAIN.palette else { unreachable!() };
    let turn = GRAIN.turn.as_dmat3();
    let sum: f64 = (0..octaves)
        .map(|k| {
            let zoom = 2f64.powi(k as i32);
            let square = (footprint * turn.x_axis.length() * zoom).powi(2);
            let fade = 1.0 / (1.0 + 0.4 * square + 0.1 * square * square);
            0.5f64.powi(k as i32 + 1) * noise((turn * point * zoom).as_vec3a()) as f64 * fade
        })
        .sum();
    Spot { ray, depth, point, grain: sum * most.x as f64, footprint }
}

fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The depth of snow, by how much of the sky a surface faces.
fn depth(amount: f32, open: f64) -> f64 {
    let [steep, level] = KEEPS.map(f64::from);
    amount as f64 * (1.0 + EDGE as f64) * smooth((open - steep) / (level - steep))
}

/// The share of a surface that is white under a depth of snow, over a pixel of a length.
fn cover(depth: f64, albedo: Vec3A, grain: f64, footprint: f64) -> f64 {
    let rough = (ROUGH as f64 * albedo.y as f64 + grain).clamp(0.0, 1.0);
    let across = (footprint * VARIES as f64).min(depth).min(1.0 + EDGE as f64 - depth);
    let edge = across.hypot(EDGE as f64);
    smooth((depth - rough - 0.5 * EDGE as f64) / edge + 0.5)
}

/// What snow looks like in light 1.
fn white(grain: f64) -> DVec3 {
    WHITE.as_dvec3() * (1.0 + RELIEF as f64 * grain)
}

/// A point is found from its nearness, which snapped corners tilt: it is a millimetre off, and noise with it, whose slope
/// counts six times where snow begins.
const EXACT: f64 = 1e-2;
/// Where nothing but snow is seen.
const ALL: f64 = 1e-3;

/// A slope that falls towards the eye, and its normal.
fn slope(degrees: f32) -> (Mesh, DVec3) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let at = |x: f32, z: f32| vec3a(x, -z * sin, z * cos);
    let (a, b, c, d) = (at(-9.0, 9.0), at(9.0, 9.0), at(9.0, -9.0), at(-9.0, -9.0));
    (triangles(&[[a, b, c], [a, c, d]]), DVec3::new(0.0, cos as f64, sin as f64))
}

#[test]
fn open_slopes_are_covered_by_their_formula() {
    let light = vec3a(0.4, 0.5, 0.7);
    let mut worst: f64 = 0.0;
    for degrees in [0.0, 10.0, 30.0, 45.0, 60.0, 75.0, 76.0, 85.0] {
        for (albedo, gloss) in [(GROUND, 0.0), (vec3a(0.9, 0.02, 0.4), 0.0), (Vec3A::splat(0.3), 0.0), (GROUND, 0.5)] {
            let (mesh, normal) = slope(degrees);
            let world = even(vec![body(paint(mesh, albedo, gloss))]);
            let camera = Camera::look_at(vec3a(0.0, 6.0, 14.0), Vec3A::ZERO, 0.5, 0.0);
            for amount in AMOUNTS {
                let settled = snow(amount, None).map(|snow| SnowCover { sky: light, ..snow });
                let planes = picture(&World { snow: settled, ..world.clone() }, camera);
                for (pixel, found) in planes.color.iter().enumerate().filter(|(pixel, _)| planes.coverage[*pixel] > 0.0)
                {
                    let Spot { ray, grain, footprint, .. } = spot(&camera, pixel, normal);
                    let cover = cover(depth(amount, normal.y), albedo, grain, footprint) * (1.0 - gloss as f64);
                    let lit = 1.0 + light.as_dvec3() * normal.y;
                    let seen = albedo.as_dvec3().lerp(white(grain), cover);
                    let color = seen * lit;
                    // What is left of its gloss mirrors a black sky above a shore, tilted by the green that is seen.
                    let cosine = ray.normalize().dot(normal) + 0.09 * (20.0 * seen.y - 1.0);
                    let up = (ray.normalize() - 2.0 * cosine * normal).normalize().y;
                    let open = ((up - 0.1) * 8.0).clamp(0.0, 1.0);
                    let shore = DVec3::new(1.0, 1.3, 0.5) * color.y * (1.0 - open);
                    let grazing = (1.0 - cosine.abs().min(1.0)).powi(5);
                    let mirrored = gloss as f64 * (1.0 - cover) * (0.05 + 0.95 * grazing);
                    let gap = (found.as_dvec3() - color.lerp(shore, mirrored)).abs().max_element();
                    worst = worst.max(gap);
                    assert!(gap <= EXACT, "{degrees} degrees, {amount}: off by {gap} at {pixel}");
                }
            }
        }
    }
    println!("worst error {worst:.1e}");
}

#[test]
fn all_that_is_level_is_white_in_the_end_and_walls_are_not() {
    for albedo in [GROUND, Vec3A::ONE, Vec3A::ZERO] {
        let wall = triangles(&[[vec3a(-9.0, -9.0, 0.0), vec3a(9.0, -9.0, 0.0), vec3a(0.0, 9.0, 0.0)]]);
        for (mesh, level) in [(ground(9.0, 0.0, 3), true), (wall, false)] {
            let world = even(vec![body(paint(mesh, albedo, 0.0))]);
            let bare = picture(&world, from_above());
            let planes = picture(&World { snow: snow(1.0, None), ..world }, from_above());
            assert!(planes.coverage.contains(&1.0));
            if level {
                for pixel in (0..planes.color.len()).filter(|pixel| planes.coverage[*pixel] > 0.0) {
                    let truth = white(spot(&from_above(), pixel, DVec3::Y).grain);
                    let gap = (planes.color[pixel].as_dvec3() - truth).abs().max_element();
                    assert!(gap <= ALL, "off by {gap} at {pixel}");
                }
            } else {
                assert_eq!(planes.differs(&bare), None);
            }
        }
    }
}

/// Water melts it.
#[test]
fn what_mirrors_as_water_does_keeps_none() {
    let world = even(vec![body(paint(ground(9.0, 0.0, 3), GROUND, 1.0))]);
    let bare = picture(&world, from_above());
    assert_eq!(picture(&World { snow: snow(1.0, None), ..world }, from_above()).differs(&bare), None);
}

/// Along a walk from corner to corner, and nowhere else.
#[test]
fn footprints_are_where_feet_have_trodden() {
    let track = [vec2(-3.0, 2.5), vec2(3.5, -2.0)];
    let [from, to] = track.map(|p| p.as_dvec2());
    let (way, length) = ((to - from).normalize(), from.distance(to));
    let camera = Camera::look_at(vec3a(0.5, 3.5, 4.0), Vec3A::ZERO, 0.9, 0.0);
    let world = even(vec![body(paint(ground(9.0, 0.0, 3), GROUND, 0.0))]);
    for amount in [0.5, 0.8, 1.0] {
        let settled = snow(amount, None).map(|snow| SnowCover { track, ..snow });
        let planes = picture(&World { snow: settled, ..world.clone() }, camera);
        let mut trodden = 0;
        for pixel in (0..planes.color.len()).filter(|pixel| planes.coverage[*pixel] > 0.0) {
            let Spot { point, grain, footprint, .. } = spot(&camera, pixel, DVec3::Y);
            let place = point.xz() - from;
            let (along, across) = (place.dot(way), way.perp().dot(place));
            // The n-th foot comes down in the middle of the n-th step, the left one first.
            let foot = (along / STEP as f64).floor();
            let side = if foot.rem_euclid(2.0) == 0.0 { -1.0 } else { 1.0 } * STANCE as f64;
            let u = (along - (foot + 0.5) * STEP as f64) / PRINT[0] as f64;
            let v = (across - side) / PRINT[1] as f64;
            let on_the_way = (0.0..=length).contains(&along);
            let print = if on_the_way { (1.0 - u * u - v * v).clamp(0.0, 1.0) } else { 0.0 };
            let cover = cover(depth(amount, 1.0) - print * SINKS as f64, GROUND, grain, footprint);
            let snow = WHITE.as_dvec3() * (1.0 + RELIEF as f64 * (grain - print));
            let gap = (planes.color[pixel].as_dvec3() - GROUND.as_dvec3().lerp(snow, cover)).abs().max_element();
            assert!(gap <= 2.0 * EXACT, "{amount}: off by {gap} at {pixel}");
            trodden += usize::from(print > 0.5);
        }
        assert!(trodden > 20, "{trodden} pixels in footprints");
    }
}

/// A map cannot know an edge better than its 3x3 texels reach.
const REACH: f64 = 1.5;
const SLAB: (Vec3A, Vec3A) = (vec3a(-1.5, 2.5, -1.0), vec3a(1.5, 2.8, 2.0));

/// Bare under a slab, white beside it; between, no farther from its edge than 3x3 texels reach.
#[test]
fn what_stands_above_keeps_snow_off() {
    let bodies = vec![body(paint(ground(12.0, 0.0, 6), GROUND, 0.0)), body(block(SLAB.0, SLAB.1))];
    let world = even(bodies);
    for (camera, texels) in [
        (Camera::look_at(vec3a(3.0, 1.2, 7.0), vec3a(0.0, 0.0, 0.5), 0.8, 0.0), 128),
        (Camera::look_at(vec3a(-4.0, 1.8, 5.0), vec3a(0.0, 0.0, 0.5), 0.9, 0.0), 256),
        (from_above(), 64),
    ] {
        let texel = 24.0 / texels as f64;
        let bare = picture(&world, camera);
        let planes = picture(&World { snow: snow(1.0, Some(shadow_views(24.0, texels))), ..world.clone() }, camera);
        let mut seen = [0; 3];
        for pixel in 0..planes.color.len() {
            let Spot { ray, depth, point: p, grain, .. } = spot(&camera, pixel, DVec3::Y);
            // The ground, not the slab or its rim.
            let ground = (planes.inv_depth[pixel] as f64 * depth - 1.0).abs() < 1e-3;
            if ray.y >= 0.0 || !ground || p.abs().max_element() > 11.5 {
                continue;
            }
            // Metres from the slab's edge along x or z, less than 0 under it.
            let (low, high) = (SLAB.0.as_dvec3(), SLAB.1.as_dvec3());
            let away = (low - p).max(p - high).with_y(f64::NEG_INFINITY).max_element();
            assert_eq!(away < 0.0, enters(p, DVec3::Y, SLAB).is_some());
            let gap = (planes.color[pixel].as_dvec3() - white(grain)).abs().max_element();
            if away < -REACH * texel {
                assert_eq!(planes.color[pixel], bare.color[pixel], "{texels} texels: snow {away} m from the edge");
                seen[0] += 1;
            } else if away > REACH * texel {
                assert!(gap <= ALL, "{texels} texels: snow is {gap} off {away} m from the edge");
                seen[1] += 1;
            } else {
                seen[2] += 1;
            }
        }
        println!("{texels} texels: {seen:?} pixels bare, white, between");
        assert!(seen.iter().all(|pixels| *pixels > 100), "{texels}: {seen:?}");
    }
}

/// Slopes, a slab, what is dark and what is pale, many samples a pixel.
fn stage() -> (World, Camera) {
    let bodies = vec![
        body(paint(ground(12.0, 0.0, 6), GROUND, 0.0)),
        body(paint(block(SLAB.0, SLAB.1), vec3a(0.3, 0.25, 0.2), 0.0)),
        body(paint(slope(40.0).0, vec3a(0.05, 0.08, 0.05), 0.3)),
    ];
    (even(bodies), Camera::look_at(vec3a(5.0, 3.0, 9.0), Vec3A::ZERO, 0.9, 0.2))
}

#[test]
fn no_snow_is_as_before_bit_for_bit() {
    let (world, camera) = stage();
    for (name, level) in testkit::levels() {
        for quality in [Quality::FAST, Quality::DEFAULT] {
            let bare = draw(&world, camera, SIZE, quality, level);
            let none = draw(
                &World { snow: snow(0.0, Some(shadow_views(24.0, 64))), ..world.clone() },
                camera,
                SIZE,
                quality,
                level,
            );
            assert_eq!(none.differs(&bare), None, "{name}");
        }
    }
}

#[test]
fn more_snow_is_nowhere_less_white() {
    let (world, camera) = stage();
    let snowy =
        |amount: f32| picture(&World { snow: snow(amount, Some(shadow_views(24.0, 64))), ..world.clone() }, camera);
    let end = snowy(1.0);
    let gaps = |planes: &Planes| -> Vec<f32> {
        planes.color.iter().zip(&end.color).map(|(color, end)| (*end - *color).abs().max_element()).collect()
    };
    let mut last = gaps(&picture(&world, camera));
    for step in 0..24 {
        let next = gaps(&snowy(step as f32 / 24.0));
        // Rounding.
        assert!(next.iter().zip(&last).all(|(next, last)| *next <= last + 1e-6), "step {step}");
        last = next;
    }
}

#[test]
fn every_level_gives_the_same_bits_with_a_kept_map_too() {
    let (world, camera) = stage();
    let cache = Cache::default();
    for quality in [Quality::FAST, Quality::DEFAULT] {
        let world = World { snow: snow(0.6, Some(shadow_views(24.0, 128))), ..world.clone() };
        let truth = draw(&world, camera, SIZE, quality, testkit::levels()[0].1);
        for (name, level) in testkit::levels() {
            for _ in 0..2 {
                assert_eq!(draw_with(&cache, &world, camera, SIZE, quality, level).differs(&truth), None, "{name}");
            }
            // Other snow in between.
            let other = World { snow: snow(0.6, Some(shadow_views(12.0, 64))), ..world.clone() };
            draw_with(&cache, &other, camera, SIZE, quality, level);
        }
    }
}
