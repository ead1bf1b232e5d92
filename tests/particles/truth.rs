//! The renderer's pictures of the bench scenes beside the oracle's.

use glam::DVec3;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use testkit::levels;
use testkit::particles::{FLAKES, SPARKS, fire, flakes_in_the_cylinder, scene, snow};

/// A multiple of neither tiles nor lanes in one direction, so that their edges are somewhere else in each row of them.
const SIZE: (usize, usize) = (632, 356);
/// Decibels between 8-bit pictures: one code in a channel of two hundred. Most have 85 and more, as rounding to codes is
/// all that differs.
const NEAR: f64 = 75.0;
/// Codes by which a channel may differ.
const CODES: f64 = 1.0;

/// Pictures of both scenes: two seconds, times that are no multiple of a frame's, and some at which f32 has lost seconds,
/// their hundredths and all.
const TIMES: [f64; 9] = [2.0, 0.0, 7.3519, -3.3071, 1000.0, 86_400.0, 1e6, 1e9, -1e9 - 0.3];

pub fn render(renderer: &mut Renderer, name: &str, time: f64, quality: &Quality, size: (usize, usize)) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    renderer.render(&scenes::named(name).unwrap(), time, quality, &mut frame);
    frame
}

/// Codes of a picture of 0 to 1.
fn codes(light: &[DVec3]) -> Vec<f64> {
    light.iter().flat_map(|c| c.to_array()).map(|c| (255.0 * c.clamp(0.0, 1.0)).round()).collect()
}

fn channels(frame: &Frame) -> Vec<f64> {
    frame.pixels.iter().flat_map(|p| [16, 8, 0].map(|shift| f64::from(p >> shift & 255))).collect()
}

/// Decibels between codes, 99 for the same ones, and the largest difference.
fn difference(a: &[f64], b: &[f64]) -> (f64, f64) {
    assert_eq!(a.len(), b.len());
    let off = || a.iter().zip(b).map(|(a, b)| (a - b).abs());
    let square = off().map(|d| d * d).sum::<f64>() / a.len() as f64;
    let psnr = if square == 0.0 { 99.0 } else { 10.0 * (255.0 * 255.0 / square).log10() };
    (psnr, off().fold(0.0, f64::max))
}

fn compare(name: &str, size: (usize, usize), times: &[f64]) {
    let mut renderer = Renderer::new(2).unwrap();
    for &time in times {
        let truth = codes(&scene(name, time, size));
        for quality in ["exact", "fast"] {
            let found = render(&mut renderer, name, time, &Quality::named(quality).unwrap(), size);
            let (psnr, largest) = difference(&channels(&found), &truth);
            println!("{name} {quality} {size:?} at {time} s: {psnr:.1} dB, {largest} codes at most");
            assert!(psnr >= NEAR && largest <= CODES, "{name} {quality} at {time} s: {psnr} dB, {largest} codes");
        }
    }
}

#[test]
fn snow_is_what_its_text_says() {
    compare("snow", SIZE, &TIMES);
}

#[test]
fn fire_is_what_its_text_says() {
    compare("fire", SIZE, &TIMES);
}

#[test]
fn they_are_so_at_the_size_of_the_text() {
    for name in ["snow", "fire"] {
        compare(name, (1280, 720), &[2.0]);
    }
}

#[test]
fn a_millisecond_would_be_seen() {
    // So small an error of time at any time is what the tolerance sees.
    for name in ["snow", "fire"] {
        for time in [2.0, 1e9] {
            let (psnr, _) = difference(&codes(&scene(name, time, SIZE)), &codes(&scene(name, time + 1e-3, SIZE)));
            println!("{name} at {time} s, a millisecond off: {psnr:.1} dB");
            assert!(psnr < NEAR, "{name} at {time} s: {psnr}");
        }
    }
}

#[test]
fn as_many_flakes_as_the_text_says_are_in_the_cylinder() {
    for time in TIMES {
        let count = flakes_in_the_cylinder(time);
        assert!(count.abs_diff(200_000) <= 500, "{count} at {time} s");
    }
}

/// In f64 every order gives the same picture, so the renderer may have any.
#[test]
fn order_does_not_matter() {
    const ROUNDING: f64 = 1e-12;
    // 1789 has no factor in common with either number.
    let shuffled = |n: u32| (0..n).map(move |i| (u64::from(i) * 1789 % u64::from(n)) as u32);
    let size = (160, 90);
    let snows = [snow(2.0, size, 0..FLAKES), snow(2.0, size, (0..FLAKES).rev()), snow(2.0, size, shuffled(FLAKES))];
    let fires = [fire(2.0, size, 0..SPARKS), fire(2.0, size, (0..SPARKS).rev()), fire(2.0, size, shuffled(SPARKS))];
    for [first, reverse, shuffled] in [snows, fires] {
        for other in [reverse, shuffled] {
            let off = first.iter().zip(&other).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
            assert!(off < ROUNDING, "{off}");
        }
    }
}

#[test]
fn every_level_and_thread_count_gives_the_same_bytes() {
    for (name, time, quality) in [("snow", 2.0, Quality::FAST), ("fire", 1e9, Quality::EXACT)] {
        let size = (333, 187);
        let truth = render(&mut Renderer::new(1).unwrap(), name, time, &quality, size);
        for (level_name, level) in levels() {
            for threads in [1, 2, 3] {
                let mut renderer = Renderer::new(threads).unwrap().at_level(level);
                let found = render(&mut renderer, name, time, &quality, size);
                assert!(found == truth, "{name} at {level_name} on {threads} threads");
            }
        }
    }
}
