//! Two eyes side by side: each half is the picture of its eye, and depths are where geometry has them.

use glam::{Vec3A, vec3a};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Options, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::trace::{Material, Object, Shape, World};
use paprsek::view::View;
use paprsek::view::{Camera, Eye, Stereo};
use testkit::picture::traced;

/// Pixels that a projection may be off: f32 has steps of 6e-5 at 1000 pixels, and a point 1e5 metres away is itself
/// rounded to 1e-2 of them.
const PROJECTED: f32 = 2e-3;
/// Pixels that the middle of a ball's picture may be off between two eyes: 64 samples a pixel along its rim.
const RENDERED: f64 = 0.02;

const BOTH: Stereo = Stereo { eye_distance: 0.065, convergence: 5.0 };

fn render(
    renderer: &mut Renderer,
    scene: &Scene,
    quality: &Quality,
    stereo: Option<Stereo>,
    size: (usize, usize),
) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    // No scene is of this colour, and what is left over must be black.
    frame.pixels.fill(0xff00_0000);
    let options = Options { quality, stereo, ..Options::default() };
    renderer.render_with(scene, 2.0, &options, &mut frame);
    frame
}

/// Columns of a frame.
fn columns(frame: &Frame, range: std::ops::Range<usize>) -> Vec<u32> {
    frame.pixels.chunks(frame.width.max(1)).flat_map(|row| &row[range.clone()]).copied().collect()
}

fn eyes(stereo: Stereo) -> [Eye; 2] {
    [-0.5, 0.5].map(|side| stereo.eye(side))
}

fn eyes_in_one_place_agree(qualities: &[&str]) {
    let mut renderer = Renderer::new(2).unwrap();
    let stereo = Some(Stereo { eye_distance: 0.0, ..BOTH });
    for scene in scenes::all() {
        for &name in qualities {
            let quality = Quality::named(name).unwrap();
            // The reference takes 64 samples a pixel.
            let (half, height) = if name == "reference" { (16, 9) } else { (133, 70) };
            let one = render(&mut renderer, scene, &quality, None, (half, height));
            for width in [2 * half, 2 * half + 1] {
                let both = render(&mut renderer, scene, &quality, stereo, (width, height));
                assert!(columns(&both, 0..half) == one.pixels, "{} {name} {width}: left", scene.name);
                assert!(columns(&both, half..2 * half) == one.pixels, "{} {name} {width}: right", scene.name);
                assert!(columns(&both, 2 * half..width).iter().all(|pixel| *pixel == 0));
            }
        }
    }
}

#[test]
fn eyes_in_one_place_see_the_picture_of_one_eye_twice() {
    eyes_in_one_place_agree(&["fast"]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn eyes_in_one_place_see_it_twice_at_every_quality() {
    eyes_in_one_place_agree(&Quality::NAMES);
}

#[test]
fn every_scene_has_two_eyes() {
    let mut renderer = Renderer::new(2).unwrap();
    for scene in scenes::all() {
        let both = render(&mut renderer, scene, &Quality::FAST, Some(BOTH), (256, 72));
        assert!(columns(&both, 0..128) != columns(&both, 128..256), "{}", scene.name);
    }
}

#[test]
fn narrow_frames_are_black_where_no_picture_fits() {
    let mut renderer = Renderer::new(2).unwrap();
    for size in [(0, 0), (0, 3), (3, 0), (1, 1), (1, 70), (2, 1), (3, 65)] {
        let frame = render(&mut renderer, &scenes::ALL[0], &Quality::DEFAULT, Some(BOTH), size);
        assert!(frame.pixels.iter().all(|pixel| pixel >> 24 == 0), "{size:?}: pixels left out");
        assert!(columns(&frame, size.0 & !1..size.0).iter().all(|pixel| *pixel == 0), "{size:?}");
    }
}

#[test]
fn points_are_apart_by_their_depth() {
    let (width, height) = (640, 720);
    for (eye, target, fov, roll) in [
        (Vec3A::ZERO, Vec3A::NEG_Z, 0.7f32, 0.0),
        (vec3a(3.0, 2.0, 7.0), vec3a(0.2, 0.8, -1.0), 1.2, 0.0),
        (vec3a(-1.0, 5.0, 2.0), vec3a(0.0, 0.0, 0.0), 0.5, 0.9),
    ] {
        let camera = Camera::look_at(eye, target, fov, roll);
        let (right, up) = (camera.right.normalize(), camera.up.normalize());
        // Pixels of a metre at one metre.
        let focal = 0.5 * height as f32 / (0.5 * fov).tan();
        for stereo in
            [BOTH, Stereo { eye_distance: 0.4, convergence: 1.3 }, Stereo { eye_distance: 2.0, convergence: 60.0 }]
        {
            let c = stereo.convergence;
            let [left, other] = eyes(stereo).map(|eye| View::new(camera.at(eye), width, height));
            assert!(((other.camera().eye - left.camera().eye).dot(right) - stereo.eye_distance).abs() < 1e-5);
            for depth in [0.3 * c, 0.8 * c, c, 2.0 * c, 50.0 * c, 1e5] {
                for (a, b) in [(0.0, 0.0), (0.3, 0.2), (-0.4, -0.1)] {
                    let p = eye + (camera.forward + right * a + up * b) * depth;
                    let ((x, y, _), (x2, y2, _)) = (left.project(p).unwrap(), other.project(p).unwrap());
                    let expected = focal * stereo.eye_distance * (1.0 / depth - 1.0 / c);
                    assert!((x - x2 - expected).abs() < PROJECTED, "{stereo:?}, {depth} m: {} {expected}", x - x2);
                    assert!((y - y2).abs() < PROJECTED, "{stereo:?}, {depth} m: {y} {y2}");
                    if depth == c {
                        assert!((x - x2).abs() < PROJECTED);
                    } else {
                        // Nearer points are crossed: the left eye has them further right.
                        assert_eq!(x > x2, depth < c, "{stereo:?}, {depth} m");
                    }
                    // Rays go where projections come from.
                    for (view, x, y) in [(&left, x, y), (&other, x2, y2)] {
                        let found = view.camera().eye + view.ray(x, y) * depth;
                        assert!(found.distance(p) < 1e-5 * (depth + p.length()), "{stereo:?}: {found} {p}");
                    }
                }
            }
            // Infinitely far: eye_distance / convergence, times what a unit of slope has of pixels.
            let [x, x2] = [&left, &other].map(|view| view.project(view.camera().eye + camera.forward).unwrap().0);
            let far = focal * stereo.eye_distance / c;
            assert!((x2 - x - far).abs() < PROJECTED, "{stereo:?}: {} {far}", x2 - x);
        }
    }
}

#[test]
fn one_eye_in_the_middle_is_the_camera() {
    let camera = Camera::look_at(vec3a(3.0, 2.0, 7.0), Vec3A::ZERO, 0.8, 0.3);
    let same = camera.at(Eye::MIDDLE);
    assert_eq!((same.eye, same.forward, same.right, same.up), (camera.eye, camera.forward, camera.right, camera.up));
    assert_eq!(same.shift, 0.0);
}

/// The middle of the light in the picture of a glowing ball, pixels.
fn middle(ball: Vec3A, radius: f32, camera: Camera) -> (f64, f64) {
    let ball = Object::new(Shape::Sphere { center: ball, radius }, Material::plain(Vec3A::ONE));
    let world = World { ambient: Vec3A::ONE, max_level: 1, ..World::new(vec![ball]) };
    let light = traced(&world, camera, (200, 150), Quality::REFERENCE, fearless_simd::Level::new());
    let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
    for (i, pixel) in light.pixels.iter().enumerate() {
        let weight = f64::from(pixel.x);
        sum += weight;
        x += weight * ((i % light.width) as f64 + 0.5);
        y += weight * ((i / light.width) as f64 + 0.5);
    }
    assert!(sum > 50.0, "the ball is not in the picture");
    (x / sum, y / sum)
}

#[test]
fn pictures_of_balls_are_apart_by_their_depth() {
    let camera = Camera::look_at(vec3a(1.0, 2.0, 3.0), vec3a(0.0, 1.8, -4.0), 0.7, 0.0);
    let stereo = Stereo { eye_distance: 0.2, convergence: 4.0 };
    let focal = 75.0 / 0.35f64.tan();
    for (depth, a, b) in [(1.5, 0.05, 0.1), (4.0, -0.1, 0.05), (4.0, 0.0, -0.2), (30.0, 0.1, -0.1)] {
        let ball = camera.eye + (camera.forward + camera.right * (a / 0.35) + camera.up * (b / 0.35)) * depth;
        let [(x, y), (x2, y2)] = eyes(stereo).map(|eye| middle(ball, 0.05 * depth, camera.at(eye)));
        let expected = focal * 0.2 * (1.0 / f64::from(depth) - 0.25);
        // A ball beside the axis shows as an ellipse, whose middle is farther out than the ball's by the square of its
        // radius as a slope; and each eye has it at another slope.
        let expected = expected + focal * 0.05 * 0.05 * 0.2 / f64::from(depth);
        println!("{depth} m: {:.4} apart of {expected:.4}, {:.4} up", x - x2, y - y2);
        assert!((x - x2 - expected).abs() < RENDERED, "{depth} m: {} {expected}", x - x2);
        assert!((y - y2).abs() < RENDERED, "{depth} m: {y} {y2}");
    }
}

#[test]
fn threads_and_levels_do_not_matter() {
    for name in ["lumen", "spheres-glass"] {
        let scene = scenes::named(name).unwrap();
        for quality in [Quality::FAST, Quality::DEFAULT, Quality::EXACT] {
            let draw = |renderer: &mut Renderer| render(renderer, &scene, &quality, Some(BOTH), (301, 130));
            let first = draw(&mut Renderer::new(1).unwrap());
            for threads in [2, 3, 8] {
                assert!(draw(&mut Renderer::new(threads).unwrap()) == first, "{name} on {threads} threads");
            }
            for (level_name, level) in testkit::levels() {
                assert!(draw(&mut Renderer::new(2).unwrap().at_level(level)) == first, "{name} at {level_name}");
            }
        }
    }
}
