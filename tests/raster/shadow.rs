//! Shadows of the sun by depth maps against what stands between a point and the light, in f64; and that a kept map changes nothing.
//!
//! A point is misclassified where more than half of the light comes though it should not, or the other way round. Acne
//! (dark instead of lit) and leaks (lit instead of dark) are counted apart. Only the box is to cast a shadow where what
//! looks away from the sun is drawn: level ground does not.

use glam::{Affine3A, Vec2, Vec3A, vec3a};
use paprsek::frame::Cache;
use paprsek::raster::{Bias, Body, Light, Mesh, Projection, ShadowViews, World};
use paprsek::view::Camera;
use std::f32::consts::{PI, TAU};
use std::sync::Arc;
use testkit::drawn::{Planes, blank, block, body, dark, draw, draw_with, enters, ground, ray};
use testkit::sunny::{BOX, MARGIN, NEAR, QUALITY, REACH, SHARE, SIZE, Sunny, cameras};

#[test]
fn the_suns_shadow_has_its_outline() {
    let none = Bias { constant: 1e-3, slope: 0.0, normal: 0.0 };
    for elevation in [1.0, 5.0, 30.0, 60.0, 90.0] {
        for texels in [128, 512, 2048] {
            for smooth in [false, true] {
                let (width, bias, back_faces, traced) = (44.0, none, true, false);
                let scene = Sunny { elevation, texels, width, bias, smooth, back_faces, traced };
                for camera in cameras() {
                    let count = scene.count(camera, REACH);
                    println!("{elevation} degrees, {texels}: {:.3} %, {count:?}", 100.0 * count.share());
                    assert!(count.pixels > 5000 && count.dark > 20, "{elevation} {texels}: {count:?}");
                    assert_eq!(count.far, 0, "{elevation} degrees, {texels} texels: {count:?}");
                    // At a third of a metre the texels themselves are some hundredths of what is seen.
                    assert!(texels < 512 || count.share() <= SHARE, "{elevation} {texels}: {count:?}");
                }
            }
        }
    }
}

#[test]
fn ground_does_not_shadow_itself() {
    // Two texels along the normal lift level ground over all texels that are looked up, however low the sun is; they
    // move what is seen of the map by as much.
    let bias = Bias { constant: 0.002, slope: 0.0, normal: 2.0 };
    for elevation in [1.0, 5.0, 30.0, 60.0, 90.0] {
        for texels in [512, 2048] {
            for smooth in [false, true] {
                let (width, back_faces, traced) = (44.0, false, false);
                let scene = Sunny { elevation, texels, width, bias, smooth, back_faces, traced };
                let count = scene.count(cameras()[0], REACH + 2.0);
                println!("{elevation} degrees, {texels}: {:.3} %, {count:?}", 100.0 * count.share());
                assert_eq!(count.far, 0, "{elevation} degrees, {texels} texels: {count:?}");
            }
        }
    }
    // Without, it does: the test can fail.
    let bias = Bias { constant: 0.0, slope: 0.0, normal: 0.0 };
    let (smooth, back_faces, traced) = (true, false, false);
    let scene = Sunny { elevation: 30.0, texels: 512, width: 44.0, bias, smooth, back_faces, traced };
    let count = scene.count(cameras()[0], REACH + 2.0);
    assert!(count.acne > 1000, "{count:?}");
}

/// Texels: corners are snapped to 1/256, and a little is left of the bias.
const TRACED_REACH: f64 = 0.1;

#[test]
fn traced_shadows_have_their_outline() {
    let (width, smooth, traced) = (44.0, true, true);
    for elevation in [1.0, 5.0, 30.0, 60.0, 90.0] {
        for texels in [64, 512] {
            // Where the ground is drawn it must not hide itself; where the box's back is, there is no need.
            for (back_faces, share) in [(false, 1.0), (true, 0.0)] {
                let bias = Bias { constant: 0.02, slope: share, normal: share };
                let scene = Sunny { elevation, texels, width, bias, smooth, back_faces, traced };
                for camera in cameras() {
                    let count = scene.count(camera, TRACED_REACH);
                    assert!(count.pixels > 5000 && count.dark > 20, "{elevation} {texels}: {count:?}");
                    assert_eq!(count.far, 0, "{elevation} degrees, {texels} texels: {count:?}");
                }
            }
        }
    }
}

/// A ball of few faces with the normals of a round one. Its corners lie on the unit sphere, its poles on the y axis.
fn coarse_ball(rings: usize, sides: usize) -> Mesh {
    let mut mesh = blank();
    for i in 0..=rings {
        for k in 0..=sides {
            let (sin, cos) = (PI * i as f32 / rings as f32).sin_cos();
            let turn = TAU * (k % sides) as f32 / sides as f32;
            // Exactly one point at each pole, so that no face there has two corners in one place.
            let sin = if i == 0 || i == rings { 0.0 } else { sin };
            mesh.points.push(vec3a(-turn.sin() * sin, -cos, -turn.cos() * sin));
        }
    }
    mesh.normals = mesh.points.clone();
    mesh.loft(0, sides + 1, 0, &[]);
    mesh
}

/// Of the pixels of a coarse ball that face the light, and how many of them keep less than a share of it.
fn hidden(rings: usize, sides: usize, turn: f32, keeps: f32, bias: Bias, traced: bool) -> (usize, usize) {
    let towards = vec3a(turn.sin(), 0.4, turn.cos()).normalize();
    let views = vec![Projection::parallel(towards, Vec3A::ZERO, 3.0, 256)];
    let picture = |shadow| {
        let lights = vec![Light { shadow, ..Light::sun(towards, Vec3A::ONE) }];
        let world = World { lights, ..dark(vec![body(coarse_ball(rings, sides))]) };
        let camera = Camera::look_at(vec3a(0.0, 0.5, 3.0), Vec3A::ZERO, 0.9, 0.0);
        draw(&world, camera, SIZE, QUALITY, testkit::levels()[0].1)
    };
    let truth = picture(None);
    let found = picture(Some(ShadowViews { traced, ..ShadowViews::new(views, bias) }));
    let lit = truth.color.iter().filter(|color| color.x > 0.0).count();
    let pairs = found.color.iter().zip(&truth.color);
    (pairs.filter(|(found, truth)| found.x + 1e-6 < keeps * truth.x).count(), lit)
}

/// Rings and sides of coarse balls, and how the sun stands to them, radians.
const BALLS: [(usize, usize); 3] = [(5, 7), (8, 12), (20, 30)];
const TURNS: [f32; 4] = [0.3, 1.1, 2.0, 2.6];

/// Of a smooth convex body every point that faces the light is lit, also where it is drawn with flat faces, some of which
/// are turned away. Without lifting up to a third of the lit pixels were in shadow.
#[test]
fn a_coarse_ball_does_not_shadow_itself() {
    let mut failed = Vec::new();
    for ((rings, sides), turn) in BALLS.iter().flat_map(|ball| TURNS.map(|turn| (*ball, turn))) {
        let bias = Bias { constant: 0.02, slope: 1.0, normal: 1.0 };
        let (hidden, lit) = hidden(rings, sides, turn, 1.0, bias, true);
        assert!(lit > 200, "{lit}");
        if hidden * 1000 > lit {
            failed.push(format!("{rings} rings, turn {turn}: {hidden} of {lit}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// The same of a depth map, whose lookups are lifted by one height per face.
#[test]
fn a_coarse_ball_hardly_shadows_itself_in_a_map() {
    let mut worst = 0.0f64;
    for ((rings, sides), turn) in BALLS.iter().flat_map(|ball| TURNS.map(|turn| (*ball, turn))) {
        let (hidden, lit) = hidden(rings, sides, turn, 0.5, Bias::SHOW, false);
        assert!(lit > 200, "{lit}");
        let share = hidden as f64 / lit as f64;
        println!("{rings} rings, turn {turn}: {share:.4} of {lit}");
        worst = worst.max(share);
    }
    // Looked up on the flat faces it is 0.21.
    assert!(worst < 1e-3, "{worst}");
}

#[test]
fn a_plan_without_views_is_no_shadow() {
    let world = |shadow| {
        let lights = vec![Light { shadow, ..Light::sun(Vec3A::Y, Vec3A::ONE) }];
        World { lights, ..dark(vec![body(ground(14.0, 0.0, 6)), body(block(BOX.0, BOX.1))]) }
    };
    let picture = |shadow| draw(&world(shadow), cameras()[0], SIZE, QUALITY, testkit::levels()[0].1);
    for traced in [false, true] {
        let bias = Bias { constant: 0.0, slope: 0.0, normal: 0.0 };
        let shadow_views = ShadowViews { traced, ..ShadowViews::new(Vec::new(), bias) };
        assert_eq!(picture(Some(shadow_views)).differs(&picture(None)), None);
    }
}

#[test]
fn bodies_before_the_first_that_casts_hide_nothing() {
    // The box comes first: it hides the ground unless the shadow begins after it.
    let picture = |shadow| {
        let lights = vec![Light { shadow, ..Light::sun(Vec3A::Y, Vec3A::ONE) }];
        let bodies = vec![body(block(BOX.0, BOX.1)), body(ground(14.0, 0.0, 6))];
        draw(&World { lights, ..dark(bodies) }, cameras()[0], SIZE, QUALITY, testkit::levels()[0].1)
    };
    let truth = picture(None);
    for traced in [false, true] {
        let hidden = |from| {
            let bias = Bias { constant: 0.5, slope: 0.0, normal: 0.0 };
            let views = vec![Projection::parallel(Vec3A::Y, Vec3A::ZERO, 30.0, 256)];
            let shadow_views = ShadowViews { traced, first_caster: from, ..ShadowViews::new(views, bias) };
            let found = picture(Some(shadow_views));
            let pairs = found.color.iter().zip(&truth.color);
            pairs.filter(|(found, truth)| (**found - **truth).length() > 1e-5).count()
        };
        assert!(hidden(0) > 200, "{}", hidden(0));
        // The number of bodies, and one beyond.
        assert_eq!([hidden(1), hidden(2), hidden(3)], [0; 3]);
    }
}

#[test]
fn beyond_the_map_is_light() {
    // The box is larger than the map.
    let bias = Bias { constant: 1e-3, slope: 0.0, normal: 0.0 };
    for smooth in [false, true] {
        let (texels, width) = (64, 2.5);
        let (back_faces, traced) = (true, false);
        let scene = Sunny { elevation: 9.0, texels, width, bias, smooth, back_faces, traced };
        let view = scene.shadow_views().views[0];
        let (mut beyond, mut dark, mut cut) = (0, 0, 0);
        for (p, share) in scene.receivers(cameras()[0]) {
            let at = view.matrix().project_point3(p.as_vec3());
            let (low, high) = (at.x.min(at.y), at.x.max(at.y));
            if low < MARGIN - NEAR || high > texels as f32 - MARGIN + NEAR {
                assert!((share - 1.0).abs() < 1e-5, "{p}: {share}");
                beyond += 1;
                cut += enters(p, scene.towards(), BOX).is_some() as u32;
            } else {
                dark += (share < 0.5) as u32;
            }
        }
        assert!(beyond > 1000 && dark > 100 && cut > 20, "{beyond} {dark} {cut}");
    }
}

#[test]
fn the_finest_map_that_reaches_is_looked_up() {
    // Two maps: a wide one, and a fine one around the box. Within the fine one it is as if that were alone.
    let bias = Bias { constant: 1e-3, slope: 0.0, normal: 0.0 };
    let scene =
        |width| Sunny { elevation: 40.0, texels: 128, width, bias, smooth: true, back_faces: true, traced: false };
    let (fine, wide) = (scene(6.0), scene(44.0));
    let camera = cameras()[0];
    let both = {
        let mut shadow_views = fine.shadow_views();
        shadow_views.views.extend(wide.shadow_views().views);
        let bodies = vec![body(ground(14.0, 0.0, 6)), body(block(BOX.0, BOX.1))];
        let lights = vec![Light::sun(fine.towards().as_vec3a(), Vec3A::ONE).with_shadow(shadow_views)];
        draw(&World { lights, ..dark(bodies) }, camera, SIZE, QUALITY, testkit::levels()[0].1)
    };
    let (fine_alone, wide_alone) = (fine.draw(camera), wide.draw(camera));
    let view = fine.shadow_views().views[0];
    let (mut inside, mut outside) = (0, 0);
    for pixel in 0..both.color.len() {
        if both.inv_depth[pixel] == 0.0 {
            continue;
        }
        let d = ray(&camera, SIZE, (pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
        let p = camera.eye.as_dvec3() + d / both.inv_depth[pixel] as f64;
        let at = view.matrix().project_point3(p.as_vec3());
        // On the margin's edge either may be looked up.
        let (low, high) = (at.x.min(at.y), at.x.max(at.y));
        if low > MARGIN + NEAR && high < 128.0 - MARGIN - NEAR {
            assert_eq!(both.color[pixel], fine_alone.color[pixel], "{p}");
            inside += 1;
        } else if low < MARGIN - NEAR || high > 128.0 - MARGIN + NEAR {
            assert_eq!(both.color[pixel], wide_alone.color[pixel], "{p}");
            outside += 1;
        }
    }
    assert!(inside > 1000 && outside > 1000, "{inside} {outside}");
}

#[test]
fn kept_maps_change_no_frame() {
    let shapes: Vec<Arc<Mesh>> = [1.0, 1.0, 0.6].map(|s| Arc::new(block(BOX.0 * s, BOX.1 * s))).to_vec();
    let floor = Arc::new(ground(14.0, 0.0, 6));
    // Box, its place, is it there, the sun, texels, lights.
    let frame = |cache: &Cache, k: usize, fresh: bool| {
        let renew = |mesh: &Arc<Mesh>| if fresh { Arc::new(Mesh::clone(mesh)) } else { mesh.clone() };
        // Every way in which one frame may resemble the last.
        let shape = [0, 0, 1, 1, 0, 2, 0, 0, 0, 0][k % 10];
        let at = [0.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-3][k % 10];
        let there = k % 10 != 6;
        let (elevation, texels) = ([40.0, 40.0, 40.0, 40.0, 40.0, 40.0, 40.0, 41.0][k % 8], [192, 64][k % 7 / 6]);
        let scene = Sunny {
            elevation,
            texels,
            width: [44.0, 30.0][k % 5 / 4],
            bias: Bias { constant: 0.01, slope: 2.0, normal: 1.0 },
            smooth: !k.is_multiple_of(3),
            back_faces: k % 9 == 8,
            traced: k % 11 == 10,
        };
        let position = vec3a(0.0, 4.0 + (k % 2) as f32, 5.0);
        let views = (0..6).map(|face| Projection::face(face, position, 64)).collect();
        let lamp = Light::lamp(position, Vec3A::X, Vec2::new(0.0, 0.1), 20.0);
        let lamp = lamp.with_shadow(ShadowViews { views, ..scene.shadow_views() });
        let mut lights =
            vec![Light::sun(scene.towards().as_vec3a(), Vec3A::ONE).with_shadow(scene.shadow_views()), lamp];
        if k % 4 == 3 {
            lights.reverse();
        }
        lights.truncate(1 + (k % 6 != 5) as usize);
        let place = Affine3A::from_translation(glam::vec3(at, 0.0, 0.0));
        let mut bodies = vec![Body::new(renew(&floor), Affine3A::IDENTITY), Body::new(renew(&shapes[shape]), place)];
        bodies.truncate(1 + there as usize);
        let size = [[90, 60], [64, 64], [33, 70]][k % 3];
        draw_with(cache, &World { lights, ..dark(bodies) }, cameras()[k % 2], size, QUALITY, testkit::levels()[0].1)
    };
    let truths: Vec<Planes> = (0..40).map(|k| frame(&Cache::default(), k, true)).collect();
    // Several at once with one cache: they take maps from each other.
    let cache = Cache::default();
    std::thread::scope(|scope| {
        for thread in 0..3 {
            let (frame, truths, cache) = (&frame, &truths, &cache);
            scope.spawn(move || {
                for k in 0..120 {
                    // Often the same twice, or back to the one before.
                    let k = [k, k, k + 1, k][k % 4] * (thread + 1) % truths.len();
                    assert_eq!(truths[k].differs(&frame(cache, k, false)), None, "frame {k}");
                }
            });
        }
    });
    assert!((1..40).filter(|&k| truths[k].color != truths[k - 1].color).count() > 30);
}
