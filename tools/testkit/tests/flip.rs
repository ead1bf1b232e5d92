//! FLIP against its authors' own program, per pixel and in the mean: frames of scenes by a fast quality and by the
//! exact one, noise, flat colours, and pictures smaller than the filters.

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};
use paprsek::frame::{Frame, Renderer};
use paprsek::{Quality, scenes};
use testkit::flip::{PIXELS_PER_DEGREE, flip, mean};
use testkit::random::Random;

/// The largest difference of a pixel, and of the mean.
const MOST: f64 = 1e-3;

fn theirs(picture: &Frame, truth: &Frame) -> Vec<f32> {
    let (width, height) = (truth.width as u32, truth.height as u32);
    let [picture, truth] = [picture, truth].map(|frame| FlipImageRgb8::with_data(width, height, &frame.to_rgb()));
    nv_flip::flip(truth, picture, DEFAULT_PIXELS_PER_DEGREE).to_vec()
}

/// The largest difference, after both have been held together.
fn compare(what: &str, picture: &Frame, truth: &Frame) -> f64 {
    let (own, theirs) = (flip(picture, truth), theirs(picture, truth));
    assert_eq!(own.len(), theirs.len());
    let gap = own.iter().zip(&theirs).map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max);
    let means = [&own, &theirs].map(|flip| mean(flip));
    println!("{what}: mean {:.6}, theirs {:.6}, largest difference of a pixel {gap:.1e}", means[0], means[1]);
    assert!(gap < MOST && (means[0] - means[1]).abs() < MOST, "{what}");
    means[0]
}

#[test]
fn frames_differ_by_as_much() {
    assert!((PIXELS_PER_DEGREE - f64::from(DEFAULT_PIXELS_PER_DEGREE)).abs() < 1e-3);
    let mut renderer = Renderer::new(0).unwrap();
    let mut render = |scene: &str, time: f64, quality: &Quality| {
        let mut frame = Frame::new(320, 180);
        renderer.render(&scenes::named(scene).unwrap(), time, quality, &mut frame);
        frame
    };
    let times =
        [("spheres", 2.0), ("shadow", 3.0), ("snowfall", 12.0), ("clouds", 6.6), ("torches", 10.0), ("day", 44.0)];
    let mut different = 0;
    for (scene, time) in times {
        let [fast, exact] = [Quality::FAST, Quality::EXACT].map(|quality| render(scene, time, &quality));
        different += usize::from(compare(scene, &fast, &exact) > 1e-4);
        let later = render(scene, time + 1.0, &Quality::FAST);
        assert!(compare(&format!("{scene}, 1 s later"), &later, &exact) > 1e-3, "{scene}");
    }
    assert!(different >= 3, "nearly all frames are equal");
}

#[test]
fn noise_flat_colours_and_small_pictures_differ_by_as_much() {
    let mut random = Random(11);
    let mut noise = |width: usize, height: usize, all: u32| {
        let pixels = (0..width * height).map(|_| (random.unit() * f64::from(0x100_0000)) as u32 & all).collect();
        Frame { width, height, pixels }
    };
    for (width, height) in [(64, 64), (1, 1), (3, 50), (50, 2), (19, 21)] {
        for all in [0xff_ffff, 0x0f_0f0f, 0x00_00ff, 0xff_0000] {
            let (a, b) = (noise(width, height, all), noise(width, height, all));
            compare(&format!("noise {all:06x}, {width}x{height}"), &a, &b);
        }
    }
    for (a, b) in [(0, 0xff_ffff), (0x00_ff00, 0x00_00ff), (0xff_0000, 0x01_0203)] {
        let [a, b] = [a, b].map(|pixel| Frame { width: 30, height: 20, pixels: vec![pixel; 600] });
        compare("flat colours", &a, &b);
    }
}
