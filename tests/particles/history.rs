//! Frames a second do not matter: neither to an instant's picture nor to the light of a flame.

use super::truth::render;
use paprsek::frame::{Frame, Renderer};
use paprsek::settings::Quality;
use testkit::particles::{SPARKS, fire};

const SIZE: (usize, usize) = (96, 54);

/// Pictures of a span at so many frames a second, of which those at full tenths of a second are kept.
fn tenths(name: &str, from: u32, fps: u32) -> Vec<Frame> {
    let mut renderer = Renderer::new(2).unwrap();
    let mut kept = Vec::new();
    for step in 0..=fps * 2 / 10 {
        // A quotient, so that every rate has the same bits for the same instant.
        let time = f64::from(from * fps + step) / f64::from(fps);
        let frame = render(&mut renderer, name, time, &Quality::FAST, SIZE);
        if step % (fps / 10) == 0 {
            kept.push(frame);
        }
    }
    kept
}

#[test]
fn ten_and_a_thousand_frames_a_second_have_the_same_pictures() {
    for (name, from) in [("snow", 2), ("fire", 86_400)] {
        let (few, many) = (tenths(name, from, 10), tenths(name, from, 1000));
        assert_eq!((few.len(), many.len()), (3, 3));
        assert!(few == many, "{name}");
        assert!(few[0] != few[1] && few[1] != few[2], "{name} stands still");
        // And backwards, alone.
        for (step, frame) in few.iter().enumerate().rev() {
            let time = f64::from(from * 10 + step as u32) / 10.0;
            assert!(render(&mut Renderer::new(1).unwrap(), name, time, &Quality::FAST, SIZE) == *frame, "{name}");
        }
    }
}

/// The mean of all codes.
fn mean(frame: &Frame) -> f64 {
    let sum: u64 = frame.pixels.iter().map(|p| u64::from((p >> 16 & 255) + (p >> 8 & 255) + (p & 255))).sum();
    sum as f64 / (3 * frame.pixels.len()) as f64
}

/// A flame that is fed once a frame pulses with the rate of frames. Sparks are born at times of their own here, so the
/// mean code of a frame changes as little as the oracle's does: what is counted is the difference between frames.
#[test]
fn fire_burns_steadily_at_any_frame_rate() {
    /// Codes of the mean: rounding of pixels to codes has left it by then.
    const CLOSE: f64 = 0.02;
    /// The light of 10,000 sparks at phases of their own differs by 0.6 % (one standard deviation) from their mean.
    const STEADY: f64 = 0.03;
    let mut renderer = Renderer::new(2).unwrap();
    for fps in [7, 60, 1000] {
        let mut means = Vec::new();
        for step in 0..12 {
            let time = 40.0 + f64::from(step) / f64::from(fps);
            let found = mean(&render(&mut renderer, "fire", time, &Quality::FAST, SIZE));
            let light = fire(time, SIZE, 0..SPARKS);
            let truth = 255.0 * light.iter().map(|c| c.element_sum() / 3.0).sum::<f64>() / light.len() as f64;
            assert!((found - truth).abs() < CLOSE, "{found} {truth} at {time} s");
            means.push(found);
        }
        let middle = means.iter().sum::<f64>() / means.len() as f64;
        let off = means.iter().map(|m| (m / middle - 1.0).abs()).fold(0.0, f64::max);
        println!("{fps} frames a second: mean code {middle:.2}, off by {:.2} %", 100.0 * off);
        assert!(off < STEADY, "{off} at {fps} frames a second");
    }
}
