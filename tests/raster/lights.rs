//! Several lights in one pass, how far they reach, and how much of a pixel triangles cover: against formulas in f64.

use glam::{DVec2, DVec3, Vec2, Vec3A, dvec2, dvec3, vec3a};
use paprsek::raster::{Bias, Light, Projection, ShadowViews, World};
use paprsek::settings::{Quality, RasterSettings};
use paprsek::view::Camera;
use paprsek::view::View;
use testkit::drawn::{Planes, block, body, dark, draw, ground, ray, triangles};
use testkit::{ULP, random::Random};

const SIZE: [usize; 2] = [120, 80];
/// Depth maps and light as the intro has them, one sample a pixel.
const ONE: Quality = Quality::FAST;

fn lamp(position: Vec3A, falloff: Vec2, reach: f32, color: Vec3A) -> Light {
    Light::lamp(position, color, falloff, reach)
}

fn camera() -> Camera {
    Camera::look_at(vec3a(0.0, 9.0, 12.0), Vec3A::ZERO, 0.9, 0.0)
}

/// Where a pixel's eye ray meets level ground.
fn point(camera: &Camera, pixel: usize) -> DVec3 {
    let d = ray(camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
    camera.eye.as_dvec3() - d * (camera.eye.y as f64 / d.y)
}

/// The point is found from its nearness, which snapped corners tilt: relative error of light.
const LIGHT: f64 = 3e-4;

#[test]
fn lamps_fade_by_their_formula_and_end_at_their_reach() {
    let camera = camera();
    let place = vec3a(1.0, 2.0, -0.5);
    for falloff in [Vec2::ZERO, vec2(0.0, 0.06), vec2(0.7, 0.0), vec2(0.3, 1.8), vec2(0.0, 1e-4), vec2(1e-9, 0.0)] {
        for reach in [f32::INFINITY, 30.0, 5.0, 2.5, 1.9] {
            let lights = vec![lamp(place, falloff, reach, Vec3A::ONE)];
            let world = World { lights, ..dark(vec![body(ground(9.0, 0.0, 4))]) };
            let planes = draw(&world, camera, SIZE, ONE, testkit::levels()[0].1);
            let (a, b, r) = (falloff.x as f64, falloff.y as f64, reach as f64);
            let left = |d: f64| 1.0 / (1.0 + a * d + b * d * d);
            // What does not fade ends at once.
            let cut = if reach.is_finite() && falloff != Vec2::ZERO { left(r) } else { 0.0 };
            let mut met = 0;
            for pixel in (0..planes.color.len()).filter(|&i| planes.coverage[i] == 1.0) {
                let p = point(&camera, pixel);
                let d = p.distance(place.as_dvec3());
                // On its rim either is right.
                if falloff == Vec2::ZERO && (d / r - 1.0).abs() < 1e-4 {
                    continue;
                }
                let found = planes.color[pixel].x as f64;
                if d > r * (1.0 + 1e-4) {
                    assert_eq!(found, 0.0, "{falloff}, {reach}: {d} metres");
                    continue;
                }
                let truth = place.y as f64 / d * ((left(d) - cut) / (1.0 - cut)).max(0.0);
                // Where it ends little is left of much.
                let slack = LIGHT * (truth + left(d)) + 8.0 * ULP;
                assert!((found - truth).abs() <= slack, "{falloff}, {reach}, {d}: {found} instead of {truth}");
                met += (found > 0.0) as u32;
            }
            assert!(met > 0 || reach < 2.0, "{falloff}, {reach}");
        }
    }
}

fn vec2(x: f32, y: f32) -> Vec2 {
    Vec2::new(x, y)
}

/// Lights of every kind, with and without shadows.
fn lights(random: &mut Random, count: usize) -> Vec<Light> {
    let bias = Bias { constant: 0.02, slope: 2.0, normal: 1.0 };
    (0..count)
        .map(|k| {
            let color = vec3a(random.unit() as f32, random.unit() as f32, random.unit() as f32);
            let position =
                vec3a(random.range(-6.0, 6.0) as f32, random.range(1.0, 4.0) as f32, random.range(-6.0, 6.0) as f32);
            let shadow_views = |views| Some(ShadowViews { smooth: k % 2 == 0, ..ShadowViews::new(views, bias) });
            match k % 4 {
                0 => {
                    let towards = random.direction().with_y(0.7).normalize();
                    let views = vec![Projection::parallel(towards, Vec3A::ZERO, 26.0, 256)];
                    Light { shadow: shadow_views(views), ..Light::sun(towards, color) }
                }
                1 => {
                    let views = (0..6).map(|face| Projection::face(face, position, 128)).collect();
                    Light { shadow: shadow_views(views), ..lamp(position, vec2(0.1, 0.2), 8.0, color) }
                }
                2 => lamp(position, vec2(0.0, 1.0), 3.0, color),
                _ => lamp(position, vec2(0.2, 0.1), f32::INFINITY, color),
            }
        })
        .collect()
}

/// What the lights shine on.
fn stage() -> World {
    dark(vec![
        body(ground(9.0, 0.0, 5)),
        body(block(vec3a(-2.0, 0.0, -1.0), vec3a(-1.0, 2.0, 1.0))),
        body(block(vec3a(1.0, 0.5, -1.0), vec3a(2.0, 1.0, 3.0))),
    ])
}

/// Between fragments of a row the light of many lights is interpolated where both ends have nearly the same: no pixel is
/// off by more than an eighth of what they may be apart.
#[test]
fn light_between_fragments_is_near_their_own() {
    let (camera, size) = (camera(), [480, 320]);
    let places = [vec3a(-4.0, 2.0, -3.0), vec3a(1.0, 3.0, 2.0), vec3a(5.0, 2.0, -1.0), vec3a(-2.0, 4.0, 4.0)];
    let lights: Vec<Light> = places.map(|place| lamp(place, vec2(0.1, 0.3), f32::INFINITY, Vec3A::ONE)).into();
    let world = World { lights, ..dark(vec![body(ground(9.0, 0.0, 4))]) };
    for (name, level) in testkit::levels() {
        let exact = Quality { raster: RasterSettings { threshold: 0.0, ..ONE.raster }, ..ONE };
        let [own, between] = [exact, ONE].map(|quality| draw(&world, camera, size, quality, level));
        let mut differ = 0;
        for pixel in (0..own.color.len()).filter(|&i| own.coverage[i] == 1.0) {
            let d = ray(&camera, size, (pixel % size[0]) as f64 + 0.5, (pixel / size[0]) as f64 + 0.5);
            let p = camera.eye.as_dvec3() - d * (camera.eye.y as f64 / d.y);
            let light = |place: &Vec3A| {
                let d = p.distance(place.as_dvec3());
                place.y as f64 / d / (1.0 + 0.1 * d + 0.3 * d * d)
            };
            let truth: f64 = places.iter().map(light).sum();
            let off = |planes: &Planes| (planes.color[pixel].x as f64 / truth - 1.0).abs();
            assert!(off(&own) < LIGHT, "{name}: {} of {truth} by itself", off(&own));
            assert!(off(&between) < 0.0125, "{name}: {} of {truth} between", off(&between));
            differ += (own.color[pixel] != between.color[pixel]) as usize;
        }
        assert!(differ > own.color.len() / 4, "{name}: only {differ} pixels are interpolated");
    }
}

#[test]
fn one_pass_is_the_sum_of_a_pass_for_each_light() {
    let mut random = Random(1);
    for (name, level) in testkit::levels() {
        for mut quality in [Quality::FAST, Quality::DEFAULT] {
            // Every fragment by itself.
            quality.raster.threshold = 0.0;
            for count in [2, 5, 32] {
                let lights = lights(&mut random, count);
                let with = |lights: Vec<Light>| draw(&World { lights, ..stage() }, camera(), SIZE, quality, level);
                let all = with(lights.clone());
                let single: Vec<Planes> = lights.iter().map(|light| with(vec![light.clone()])).collect();
                for pixel in 0..all.color.len() {
                    let sum: DVec3 = single.iter().map(|planes| planes.color[pixel].as_dvec3()).sum();
                    // A rounding a light and a few for what is in the pixel.
                    let slack = ULP * (count as f64 + 16.0) * sum.max_element().max(1e-6);
                    let gap = (all.color[pixel].as_dvec3() - sum).abs().max_element();
                    assert!(gap <= slack, "{name}, {count} lights: {gap} at pixel {pixel}");
                }
            }
        }
    }
}

#[test]
fn a_light_out_of_reach_changes_no_bit() {
    let mut random = Random(2);
    for (name, level) in testkit::levels() {
        let few = lights(&mut random, 4);
        let truth = draw(&World { lights: few.clone(), ..stage() }, camera(), SIZE, Quality::DEFAULT, level);
        // Its box is near enough to some blocks of pixels, but no point is.
        for position in [vec3a(0.0, 3.1, 0.0), vec3a(30.0, 1.0, 0.0), vec3a(9.8, 1.0, 9.8), vec3a(0.0, -1.0, 0.0)] {
            let reach = if position.y < 0.0 { 1.2 } else { 1.0 };
            // Without a shadow, with one from maps, with one that is traced.
            for (at, kind) in [(0, 0), (4, 0), (0, 1), (4, 2)] {
                let bias = Bias { constant: 0.01, slope: 2.0, normal: 0.0 };
                let views = (0..6).map(|face| Projection::face(face, position, 64)).collect();
                let shadow_views = ShadowViews { traced: kind == 2, ..ShadowViews::new(views, bias) };
                let mut light = lamp(position, vec2(0.3, 1.8), reach, Vec3A::splat(1e6));
                light.shadow = (kind > 0).then_some(shadow_views);
                let mut lights = few.clone();
                lights.insert(at, light);
                let planes = draw(&World { lights, ..stage() }, camera(), SIZE, Quality::DEFAULT, level);
                assert_eq!(planes.differs(&truth), None, "{name}: {position}");
            }
        }
    }
}

/// Whatever the lamp, if a point that may be seen is within its reach, it counts; far beside the picture, and behind the
/// eye, it does not.
#[test]
fn a_lamp_counts_if_it_reaches_what_is_seen() {
    let mut random = Random(7);
    let camera = camera();
    let raster = Projection::of_view(&View::new(camera, SIZE[0], SIZE[1]));
    let mut number = |low: f64, high: f64| random.range(low, high);
    for _ in 0..20_000 {
        let (x, y) = (number(0.0, SIZE[0] as f64), number(0.0, SIZE[1] as f64));
        let seen = camera.eye.as_dvec3() + ray(&camera, SIZE, x, y) * 10f64.powf(number(-1.2, 3.0));
        let way = dvec3(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
        let reach = way.length() as f32 * 1.000_001;
        assert!(lamp((seen + way).as_vec3a(), Vec2::ONE, reach, Vec3A::ONE).counts(&raster), "{seen} {way}");
    }
    let away = |position: Vec3A, reach: f32| !lamp(position, Vec2::ONE, reach, Vec3A::ONE).counts(&raster);
    assert!(away(camera.eye - camera.forward * 3.0, 2.9) && away(camera.eye + camera.right * 40.0, 10.0));
    assert!(!away(camera.eye - camera.forward * 3.0, f32::INFINITY));
}

/// `exp2` and its argument's rounding.
const FILM: f64 = 1e-6;

#[test]
fn film_squeezes_light() {
    let mut random = Random(5);
    let world = World { lights: lights(&mut random, 8), ..stage() };
    for (name, level) in testkit::levels() {
        let plain = draw(&world, camera(), SIZE, ONE, level);
        let film = draw(&World { film: true, ..world.clone() }, camera(), SIZE, ONE, level);
        assert!(plain.color.iter().any(|c| c.max_element() > 1.0));
        for (pixel, (light, found)) in plain.color.iter().zip(&film.color).enumerate() {
            let truth = light.as_dvec3().to_array().map(|c| 1.0 - (-c).exp());
            let gap = (found.as_dvec3() - DVec3::from(truth)).abs().max_element();
            assert!(gap <= FILM, "{name}, pixel {pixel}: {found} of {light}");
        }
    }
}

#[test]
fn shares_of_a_pixel_sum_up_to_one() {
    // A fan of many small triangles that covers the picture: whatever the samples show, all of them show something.
    let mut random = Random(3);
    let mut points = ground(1.0, 0.0, 60);
    for p in &mut points.points {
        let wiggle = |random: &mut Random| random.range(-0.008, 0.008) as f32;
        *p = vec3a(p.x + wiggle(&mut random), -p.z + wiggle(&mut random), wiggle(&mut random));
    }
    let camera = Camera::look_at(vec3a(0.0, 0.0, 1.0), Vec3A::ZERO, 0.9, 0.2);
    let world = World { ambient: [Vec3A::ONE, Vec3A::ZERO], ..dark(vec![body(points)]) };
    for (name, level) in testkit::levels() {
        for (coverage, grid) in [(1, 1), (2, 1), (4, 1), (8, 1), (16, 1), (1, 8)] {
            let planes = draw(
                &world,
                camera,
                [100, 70],
                Quality { raster: RasterSettings { coverage, grid, ..Quality::EXACT.raster }, ..Quality::EXACT },
                level,
            );
            for (pixel, (share, color)) in planes.coverage.iter().zip(&planes.color).enumerate() {
                assert!((share - 1.0).abs() <= 1e-6, "{name}, {coverage} samples: {share} at pixel {pixel}");
                assert!((color.x - share).abs() <= 1e-6, "{name}, {coverage} samples: {color} at pixel {pixel}");
            }
        }
    }
}

/// Area of a convex polygon within a pixel: cut by its four sides.
fn area(triangle: [DVec2; 3], x: f64, y: f64) -> f64 {
    let mut polygon = triangle.to_vec();
    for (axis, side, sign) in [(0, x, 1.0), (0, x + 1.0, -1.0), (1, y, 1.0), (1, y + 1.0, -1.0)] {
        let depth = |p: DVec2| sign * (p[axis] - side);
        let mut rest = Vec::new();
        for i in 0..polygon.len() {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            if depth(a) >= 0.0 {
                rest.push(a);
            }
            if (depth(a) > 0.0) != (depth(b) > 0.0) && depth(a) != depth(b) {
                rest.push(a.lerp(b, depth(a) / (depth(a) - depth(b))));
            }
        }
        polygon = rest;
    }
    let pairs = (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()]));
    (pairs.sum::<f64>() * 0.5).abs()
}

#[test]
fn coverage_nears_the_area_with_more_samples() {
    let mut random = Random(4);
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, 0.9, 0.0);
    let qualities = [(1, 1), (2, 1), (4, 1), (8, 1), (16, 1), (1, 8)];
    let (mut errors, mut biases, mut edges) = ([0.0; 6], [0.0; 6], 0);
    for _ in 0..150 {
        let mut face = [0; 3].map(|_| {
            let (x, y) = (random.range(-0.8, 0.8), random.range(-0.5, 0.5));
            vec3a(x as f32, y as f32, -1.0) * random.log(1.0, 10.0) as f32
        });
        if (face[1] - face[0]).cross(face[2] - face[0]).dot(face[0]) > 0.0 {
            face.swap(1, 2);
        }
        let flat = face.map(|p| {
            let (p, h) = (p.as_dvec3() / -p.z as f64, SIZE[1] as f64);
            let scale = 0.5 * h / (0.45f64).tan();
            dvec2(0.5 * SIZE[0] as f64 + p.x * scale, 0.5 * h - p.y * scale)
        });
        let world = dark(vec![body(triangles(&[face]))]);
        let drawn: Vec<Planes> = qualities
            .iter()
            .map(|&(coverage, grid)| {
                let quality =
                    Quality { raster: RasterSettings { coverage, grid, ..Quality::EXACT.raster }, ..Quality::EXACT };
                draw(&world, camera, SIZE, quality, testkit::levels()[0].1)
            })
            .collect();
        for pixel in 0..SIZE[0] * SIZE[1] {
            let truth = area(flat, (pixel % SIZE[0]) as f64, (pixel / SIZE[0]) as f64);
            // Pixels within and outside are exact.
            if truth > 1e-3 && truth < 1.0 - 1e-3 {
                edges += 1;
            }
            for (k, planes) in drawn.iter().enumerate() {
                let gap = planes.coverage[pixel] as f64 - truth;
                if !(1e-3..=1.0 - 1e-3).contains(&truth) {
                    // Snapping, and a corner between samples.
                    assert!(gap.abs() < 1.1 / qualities[k].0.max(qualities[k].1) as f64, "pixel {pixel}: {gap}");
                }
                errors[k] += gap.abs();
                biases[k] += gap;
            }
        }
    }
    let mean = errors.map(|e| e / edges as f64);
    println!("mean error of {edges} pixels on an edge at 1, 2, 4, 8, 16 and 64 samples: {mean:.4?}");
    for k in 1..6 {
        // Each step halves the samples' distance along an edge; a third less is the least that this is worth.
        assert!(mean[k] < 0.72 * mean[k - 1], "{mean:?}");
        assert!((biases[k] / edges as f64).abs() < 0.01, "{biases:?} of {edges}");
    }
}
