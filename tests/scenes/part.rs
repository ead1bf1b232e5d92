//! The first part as a film: long enough, the same every time, smooth between its cuts, never dark or blown out,
//! and never inside of things.

use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::show::intro::PARTS;
use paprsek::scenes::show::lumen::{CUTS, LUMEN, stage};
use paprsek::settings::Quality;
use paprsek::trace::reference;

const WIDTH: usize = 160;
const HEIGHT: usize = 90;
const FPS: f64 = 30.0;

/// Largest mean difference of adjacent frames within a shot, codes of 0 to 255: a pop of a tenth of the picture by half
/// of the scale is 12.
const MAX_STEP: f64 = 4.0;
/// Bounds of the mean code of a frame.
const MEAN: std::ops::Range<f64> = 24.0..216.0;
/// Room that the camera keeps from everything, metres.
const ROOM: f32 = 0.1;

fn render(renderer: &mut Renderer, time: f64) -> Vec<u32> {
    let mut frame = Frame::new(WIDTH, HEIGHT);
    renderer.render(&LUMEN, time, &Quality::FAST, &mut frame);
    frame.pixels
}

fn codes(pixels: &[u32]) -> impl Iterator<Item = u8> + '_ {
    pixels.iter().flat_map(|p| p.to_le_bytes().into_iter().take(3))
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    values.sum::<f64>() / (WIDTH * HEIGHT * 3) as f64
}

#[test]
fn it_opens_the_show_and_is_long_enough() {
    let (start, (part, from)) = PARTS[0];
    assert_eq!((start, part.name, from), (0.0, LUMEN.name, 0.0));
    assert!((45.0..=60.0).contains(&LUMEN.duration));
    assert!((4..=6).contains(&CUTS.len()));
    assert!(CUTS.windows(2).all(|pair| pair[1].0 - pair[0].0 >= 8.0));
}

#[test]
fn a_frame_has_no_history() {
    let (mut one, mut two) = (Renderer::new(1).unwrap(), Renderer::new(2).unwrap());
    let times = CUTS.iter().map(|cut| cut.0 + 4.7);
    let first: Vec<_> = times.clone().map(|t| render(&mut one, t)).collect();
    let again: Vec<_> = times.rev().map(|t| render(&mut two, t)).collect();
    assert!(first.iter().eq(again.iter().rev()));
}

/// The 64 kB build finds bodies in one word of 64 bits.
#[test]
fn bodies_fit_a_word() {
    for number in 0..(LUMEN.duration * 4.0) as u32 {
        let bodies = stage(number as f64 / 4.0).0.objects.len();
        assert!((1..=64).contains(&bodies), "{bodies} bodies at {} s", number as f64 / 4.0);
    }
}

#[test]
fn it_starts_in_colours() {
    let mut colours = render(&mut Renderer::new(0).unwrap(), 0.0);
    colours.sort_unstable();
    colours.dedup();
    assert!(colours.len() > 100, "{} colours", colours.len());
}

/// In the first seconds of each shot.
fn shots_are_smooth(seconds: f64) {
    let mut renderer = Renderer::new(0).unwrap();
    let mut last: Option<(usize, Vec<u32>)> = None;
    let mut largest = (0.0, 0.0);
    for number in 0..(LUMEN.duration * FPS) as usize {
        let time = number as f64 / FPS;
        let shot = CUTS.iter().rposition(|cut| cut.0 <= time).unwrap();
        if time - CUTS[shot].0 > seconds {
            continue;
        }
        let pixels = render(&mut renderer, time);
        let light = mean(codes(&pixels).map(f64::from));
        assert!(MEAN.contains(&light), "mean code {light} at {time}");
        if let Some((before, old)) = &last
            && *before == shot
        {
            let step = mean(codes(old).zip(codes(&pixels)).map(|(a, b)| a.abs_diff(b) as f64));
            assert!(step <= MAX_STEP, "frames differ by {step} at {time}");
            assert!(step > 0.0, "nothing moves at {time}");
            if step > largest.0 {
                largest = (step, time);
            }
        }
        last = Some((shot, pixels));
    }
    println!("largest step {} at {}", largest.0, largest.1);
}

#[test]
fn nothing_pops_and_light_keeps_its_bounds() {
    shots_are_smooth(1.5);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn nothing_pops_in_whole_shots() {
    shots_are_smooth(f64::INFINITY);
}

#[test]
fn the_camera_goes_through_nothing() {
    for number in 0..(LUMEN.duration * FPS) as usize {
        let time = number as f64 / FPS;
        let (world, camera) = stage(time);
        let axes = [camera.forward, camera.right.normalize(), camera.up.normalize()];
        for (index, body) in world.objects.iter().enumerate() {
            for axis in axes {
                // Convex: inside where the line is, on both sides of the eye.
                let span = reference::span(&body.shape, camera.eye, axis);
                let near = span.is_some_and(|(t0, t1)| t0 < ROOM && t1 > -ROOM);
                assert!(!near, "object {index} at {time}: {span:?}");
            }
        }
    }
}

#[test]
fn worlds_are_moderate() {
    for number in 0..LUMEN.duration as usize {
        let (world, _) = stage(number as f64 + 0.5);
        assert!(world.objects.len() <= 30 && world.lights.len() <= 3);
        assert!(world.objects.iter().all(|o| o.material.reflectance.max_element() <= 1.0));
    }
}

#[test]
fn any_time_has_a_picture() {
    for time in [-1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, LUMEN.duration] {
        let (world, camera) = stage(time);
        assert!(camera.eye.is_finite() && camera.forward.is_finite());
        assert!(world.objects.iter().all(|o| o.shape.bound().0.is_finite()), "{time}");
    }
}
