//! The scene `torches`: the same frame everywhere, light that wavers but does not jump, and the moon where it should be.

use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::show::torches::{FIRES, LENGTH, NIGHT, SHOTS, TORCHES};
use paprsek::settings::{Quality, RasterSettings};
use paprsek::sky::dome::Sky;
use paprsek::sky::place::{Place, angles};
use paprsek::sky::time::days;

fn frame(renderer: &mut Renderer, time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(96, 54);
    renderer.render(&TORCHES, time, quality, &mut frame);
    frame
}

/// Mean of all codes.
fn mean(frame: &Frame) -> f64 {
    let codes = frame.pixels.iter().flat_map(|p| [16, 8, 0].map(|shift| (p >> shift & 255) as f64));
    codes.sum::<f64>() / (3 * frame.pixels.len()) as f64
}

/// Where shots start, and where the last one ends.
fn cuts() -> Vec<f64> {
    SHOTS.iter().map(|shot| shot.0).chain([LENGTH]).collect()
}

/// In each shot, at one quality after the other.
#[test]
fn every_level_and_thread_count_gives_the_same_frame() {
    for (number, cut) in cuts().windows(2).enumerate() {
        let quality = [Quality::FAST, Quality::DEFAULT, Quality::EXACT][number % 3];
        let time = 0.5 * (cut[0] + cut[1]);
        let truth = frame(&mut Renderer::new(1).unwrap(), time, &quality);
        for (name, level) in testkit::levels() {
            for threads in [1, 2, 3] {
                let found = frame(&mut Renderer::new(threads).unwrap().at_level(level), time, &quality);
                assert!(found == truth, "{name}, {threads} threads, {time} s");
            }
        }
    }
}

/// Maps are kept from frame to frame: by other frames a frame is not changed.
#[test]
fn no_frame_knows_the_ones_before_it() {
    let mut renderer = Renderer::new(2).unwrap();
    let times = [1.0, 9.0, 9.05, 20.0];
    let truth: Vec<Frame> = times.iter().map(|time| frame(&mut renderer, *time, &Quality::FAST)).collect();
    for (time, truth) in times.iter().zip(&truth).rev() {
        frame(&mut renderer, time + 0.4, &Quality::FAST);
        assert!(frame(&mut renderer, *time, &Quality::FAST) == *truth, "{time} s");
    }
}

/// What the mean light of a frame changes by differs by less than a code and a half from one to the next, at 60 frames a
/// second: the first frames of each shot. The worst is a torch that fills the picture.
fn bends_little(frames: usize) {
    const BEND: f64 = 1.5;
    let mut renderer = Renderer::new(2).unwrap();
    // No edge of a shadow of the moon is that large.
    let quick = Quality { raster: RasterSettings { shadow_map: 64, ..Quality::FAST.raster }, ..Quality::FAST };
    for cut in cuts().windows(2) {
        let (mut worst, mut least, mut most) = (0f64, f64::MAX, 0f64);
        assert!(cut[1] - cut[0] > 2.0);
        let light = |step: usize| mean(&frame(&mut renderer, cut[0] + step as f64 / 60.0, &quick));
        let light: Vec<f64> = (0..frames).map(light).collect();
        for three in light.windows(3) {
            worst = worst.max((three[0] - 2.0 * three[1] + three[2]).abs());
            (least, most) = (least.min(three[1]), most.max(three[1]));
        }
        println!("from {} s on: {least:.1} to {most:.1}, worst bend {worst:.2} codes", cut[0]);
        assert!(worst < BEND, "{worst} from {} s on", cut[0]);
    }
}

#[test]
fn light_does_not_jump() {
    bends_little(20);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn light_does_not_jump_for_two_seconds() {
    bends_little(120);
}

/// Half past midnight on 24 March 2027, Central European Time: the moon is all but full and stands in the south; the sun is
/// far below.
#[test]
fn it_is_a_night_with_a_moon() {
    assert!((NIGHT - (days(2027, 3, 23) + 23.5 / 24.0)).abs() < 1e-9);
    let sky = Sky::new(NIGHT, &Place::PLZEN);
    let (altitude, azimuth) = angles(sky.moon.as_dvec3());
    let (altitude, azimuth) = (altitude.to_degrees(), azimuth.to_degrees());
    println!("moon at {altitude:.1} degrees, azimuth {azimuth:.1}, {:.1} % lit", 100.0 * sky.lit);
    assert!(sky.lit > 0.95 && (20.0..45.0).contains(&altitude) && (160.0..200.0).contains(&azimuth));
    assert!(sky.sun.y < -0.36);
}

/// Fires burn between their radii; five or more, none in another.
#[test]
fn fires_stand_apart() {
    assert!(FIRES.len() >= 5);
    for (k, [x, y, z, inner, outer, scale]) in FIRES.into_iter().enumerate() {
        assert!(inner >= 0.0 && inner < outer && scale > 0.0);
        for [x2, y2, z2, _, outer2, _] in &FIRES[..k] {
            let apart = ((x - x2).powi(2) + (y - y2).powi(2) + (z - z2).powi(2)).sqrt();
            assert!(apart > outer + outer2, "{k}");
        }
    }
}
