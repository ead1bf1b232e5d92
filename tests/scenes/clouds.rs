//! The scene `clouds`: the same frame everywhere, into clouds and out of them, and no light that jumps but at cuts.

use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::show::clouds::{CLOUDS, SHOTS};
use paprsek::settings::Quality;

fn frame(renderer: &mut Renderer, time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(96, 54);
    renderer.render(&CLOUDS, time, quality, &mut frame);
    frame
}

/// Mean of all codes, and the mean square from it.
fn moments(frame: &Frame) -> [f64; 2] {
    let codes: Vec<f64> = frame.pixels.iter().flat_map(|p| [16, 8, 0].map(|shift| (p >> shift & 255) as f64)).collect();
    let mean = codes.iter().sum::<f64>() / codes.len() as f64;
    [mean, codes.iter().map(|code| (code - mean).powi(2)).sum::<f64>() / codes.len() as f64]
}

/// At dawn before a cloud, in one by the pilot's eyes, and by noon above all.
#[test]
fn every_level_and_thread_count_gives_the_same_frame() {
    for (quality, time) in [(Quality::FAST, 2.5), (Quality::DEFAULT, 7.0), (Quality::DEFAULT, 45.0)] {
        let truth = frame(&mut Renderer::new(1).unwrap(), time, &quality);
        for (name, level) in testkit::levels() {
            for threads in [2, 3] {
                let found = frame(&mut Renderer::new(threads).unwrap().at_level(level), time, &quality);
                assert!(found == truth, "{name}, {threads} threads, {time} s");
            }
        }
    }
}

/// Shapes are kept with the light that they had: by other frames a frame is not changed.
#[test]
fn no_frame_knows_the_ones_before_it() {
    let mut renderer = Renderer::new(2).unwrap();
    let times = [1.0, 20.0, 25.0, 48.0];
    let truth: Vec<Frame> = times.iter().map(|time| frame(&mut renderer, *time, &Quality::FAST)).collect();
    for (time, truth) in times.iter().zip(&truth).rev() {
        frame(&mut renderer, time + 0.4, &Quality::FAST);
        assert!(frame(&mut renderer, *time, &Quality::FAST) == *truth, "{time} s");
    }
}

/// In a cloud there is nothing to see but light, and before and after there is much.
#[test]
fn it_flies_into_clouds_and_out_of_them() {
    let mut renderer = Renderer::new(2).unwrap();
    let mut variance = |time: f64| moments(&frame(&mut renderer, time, &Quality::FAST))[1];
    for (outside, inside) in [(2.0, 4.2), (6.75, 9.2), (31.0, 26.2)] {
        let [outside, inside] = [variance(outside), variance(inside)];
        assert!(outside > 3.0 * inside, "{outside} {inside}");
    }
}

/// What the mean light of a frame changes by differs by less than 2.5 codes from one to the next, at 30 frames a second:
/// the worst is where one breaks out of a cloud. Where clouds are lit anew it is below 1.
#[test]
fn light_does_not_jump() {
    const BEND: f64 = 2.5;
    let mut renderer = Renderer::new(2).unwrap();
    for (from, to) in [(6.6, 7.6), (24.0, 25.0), (47.0, 48.0)] {
        assert!(to <= CLOUDS.duration && !SHOTS.iter().any(|(cut, _)| *cut > from && *cut < to));
        let light = |step: usize| moments(&frame(&mut renderer, from + step as f64 / 30.0, &Quality::FAST))[0];
        let light: Vec<f64> = (0..30).map(light).collect();
        let bend = |three: &[f64]| (three[0] - 2.0 * three[1] + three[2]).abs();
        let worst = light.windows(3).map(bend).fold(0.0, f64::max);
        println!("worst bend from {from} s on: {worst:.2} codes");
        assert!(worst < BEND, "{worst} from {from} s on");
    }
}
