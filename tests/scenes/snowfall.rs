//! The scene `snowfall`: its weather, that it whitens, the same frame everywhere, and no light that jumps.

use glam::DVec3;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::show::snowfall::{LENGTH, SNOWFALL, weather};
use paprsek::settings::Quality;

fn frame(renderer: &mut Renderer, time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(96, 54);
    renderer.render(&SNOWFALL, time, quality, &mut frame);
    frame
}

/// Mean code of each channel over some rows.
fn mean(frame: &Frame, rows: std::ops::Range<usize>) -> [f64; 3] {
    let pixels = &frame.pixels[rows.start * frame.width..rows.end * frame.width];
    [16, 8, 0].map(|shift| pixels.iter().map(|p| (p >> shift & 255) as f64).sum::<f64>() / pixels.len() as f64)
}

/// Snow begins with none, is never more than all, and what has blown is what the wind sums up to.
#[test]
fn weather_is_smooth_and_wind_sums_up() {
    assert_eq!(weather(0.0).snow, 0.0);
    assert_eq!(weather(0.0).drift, DVec3::ZERO);
    let (mut most, mut sum) = (0.0f32, [0.0; 2]);
    const STEP: f64 = 1.0 / 128.0;
    for step in 0..(3.0 * LENGTH / STEP) as usize {
        let time = step as f64 * STEP;
        let (now, next, middle) = (weather(time), weather(time + STEP), weather(time + 0.5 * STEP));
        assert!((0.0..=1.0).contains(&now.snow) && (next.snow - now.snow).abs() < 0.3 * STEP as f32, "{time}");
        assert!((0.3..4.0).contains(&now.wind.length()), "{time}");
        for (axis, sum) in sum.iter_mut().enumerate() {
            *sum += STEP * middle.wind[axis] as f64;
            // The speed is rounded.
            assert!((*sum - next.drift[2 * axis]).abs() < 1e-4, "{time}");
        }
        most = most.max(now.snow);
    }
    assert!(most > 0.8);
}

/// Brown ground is white in the end, whiter than the sky; and it is getting dark.
#[test]
fn it_whitens_and_gets_dark() {
    let mut renderer = Renderer::new(2).unwrap();
    let [first, last] = [0.0, LENGTH - 0.1].map(|time| frame(&mut renderer, time, &Quality::FAST));
    let ([red, _, blue], [sky, ..]) = (mean(&first, 44..54), mean(&first, 0..8));
    assert!(red > 1.3 * blue && sky > 1.3 * red, "{red} {blue}, {sky}");
    let ([red, _, blue], [dark, ..]) = (mean(&last, 44..54), mean(&last, 0..8));
    assert!(blue > red && red > dark && dark < 0.4 * sky, "{red} {blue}, {dark}");
}

/// What the mean light of a frame changes by differs by less than 1.5 codes from one to the next, at 30 frames a second: also
/// where the map of what stands above is drawn anew for another number of lights.
fn bends_little(seconds: std::ops::Range<f64>) {
    const BEND: f64 = 1.5;
    let mut renderer = Renderer::new(2).unwrap();
    let light = |step: usize| mean(&frame(&mut renderer, step as f64 / 30.0, &Quality::FAST), 0..54);
    let light: Vec<_> = ((30.0 * seconds.start) as usize..(30.0 * seconds.end) as usize).map(light).collect();
    let bend =
        |three: &[[f64; 3]]| (0..3).map(|i| (three[0][i] - 2.0 * three[1][i] + three[2][i]).abs()).fold(0.0, f64::max);
    let worst = light.windows(3).map(bend).fold(0.0, f64::max);
    println!("worst bend {worst:.2} codes");
    assert!(worst < BEND);
}

/// As the lamp is lit.
#[test]
fn light_does_not_jump() {
    bends_little(19.0..22.0);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn light_does_not_jump_on_the_whole_walk() {
    bends_little(0.0..LENGTH);
}

/// Bare, in the shower, and by the lamp.
#[test]
fn every_level_and_thread_count_gives_the_same_frame() {
    for quality in [Quality::FAST, Quality::DEFAULT, Quality::EXACT] {
        for time in [0.5, 15.0, 31.0] {
            let truth = frame(&mut Renderer::new(1).unwrap(), time, &quality);
            for (name, level) in testkit::levels() {
                for threads in [2, 3] {
                    let found = frame(&mut Renderer::new(threads).unwrap().at_level(level), time, &quality);
                    assert!(found == truth, "{name}, {threads} threads, {time} s");
                }
            }
        }
    }
}

/// Maps are kept: by other frames a frame is not changed.
#[test]
fn no_frame_knows_the_ones_before_it() {
    let mut renderer = Renderer::new(2).unwrap();
    let times = [1.0, 14.0, 23.0, 31.0];
    let truth: Vec<Frame> = times.iter().map(|time| frame(&mut renderer, *time, &Quality::FAST)).collect();
    for (time, truth) in times.iter().zip(&truth).rev() {
        frame(&mut renderer, 30.0 - time, &Quality::FAST);
        assert!(frame(&mut renderer, *time, &Quality::FAST) == *truth, "{time} s");
    }
}
