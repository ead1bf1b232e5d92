//! The scene `day`: its calendar, its light through the hours, and that nothing jumps.

use paprsek::frame::{Frame, Options, Renderer};
use paprsek::scenes::show::day::{DAY, LENGTH, clock};
use paprsek::settings::{Quality, RasterSettings};

/// Scene seconds of an hour (4 to 28) of a season (0 to 3: summer, autumn, winter, spring).
fn at(season: usize, hour: f64) -> f64 {
    LENGTH * (season as f64 + (hour - 4.0) / 24.0)
}

fn frame(renderer: &mut Renderer, time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(96, 54);
    renderer.render(&DAY, time, quality, &mut frame);
    frame
}

/// The same with the aeroplane far below the ground.
fn land_and_sky(renderer: &mut Renderer, time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(96, 54);
    let options = Options { quality, values: &[("plane.y", -9000.0)], ..Options::default() };
    renderer.render_with(&DAY, time, &options, &mut frame);
    frame
}

/// Mean code of each channel over some rows.
fn mean(frame: &Frame, rows: std::ops::Range<usize>) -> [f64; 3] {
    let pixels = &frame.pixels[rows.start * frame.width..rows.end * frame.width];
    [16, 8, 0].map(|shift| pixels.iter().map(|p| (p >> shift & 255) as f64).sum::<f64>() / pixels.len() as f64)
}

#[test]
fn days_begin_at_four_and_seasons_come_round() {
    assert_eq!(clock(0.0), (0, 4.0));
    assert_eq!(clock(LENGTH / 2.0), (0, 16.0));
    assert_eq!(clock(2.0 * LENGTH), (2, 4.0));
    assert_eq!(clock(4.0 * LENGTH + 5.0), clock(5.0));
    let (season, hour) = clock(at(3, 27.9));
    assert!(season == 3 && (hour - 27.9).abs() < 1e-9);
}

/// Plzen in UT + 1: the sun is up from 4:00 to 20:20 in June and from 8:05 to 16:05 in December.
#[test]
fn the_sky_is_light_when_it_should_be() {
    let mut renderer = Renderer::new(2).unwrap();
    for (season, hour, blue_over_red, lighter_than, darker_than) in [
        (0, 12.0, true, 90.0, 250.0),
        (2, 12.0, true, 90.0, 250.0),
        (0, 6.5, true, 70.0, 250.0),
        // Before the sun rises in December it is night, in June broad day.
        (2, 6.0, true, 5.0, 90.0),
        (0, 24.0, true, 10.0, 90.0),
        (2, 20.0, true, 10.0, 110.0),
    ] {
        let [red, green, blue] = mean(&frame(&mut renderer, at(season, hour), &Quality::FAST), 0..15);
        let light = (red + green + blue) / 3.0;
        assert!((lighter_than..darker_than).contains(&light), "season {season}, {hour} h: {light}");
        assert_eq!(blue > red, blue_over_red, "season {season}, {hour} h: {red} {blue}");
    }
}

/// Snow is whiter than grass under the same noon.
#[test]
fn winter_is_white() {
    let mut renderer = Renderer::new(2).unwrap();
    let [summer, winter] = [0, 2].map(|season| mean(&frame(&mut renderer, at(season, 11.0), &Quality::FAST), 36..54));
    assert!(winter[2] > 1.3 * summer[2], "{winter:?} {summer:?}");
    assert!(summer[1] > 1.2 * summer[2], "{summer:?}");
}

/// A frame of a show at 20 a second is a minute and a fifth of a day later than the last. Between those hours of a season (0 to
/// 3) the mean light of the sky goes on as it went: what it changes by differs by less than two codes from one frame to the
/// next. The aeroplane, passing, would take 1.5.
fn bends_little(spans: &[(usize, f64, f64)]) {
    const STEP: f64 = 0.05;
    const BEND: f64 = 2.0;
    let mut renderer = Renderer::new(2).unwrap();
    let mut worst: f64 = 0.0;
    // No shadow falls on the sky.
    let quick = Quality { raster: RasterSettings { shadow_map: 64, ..Quality::FAST.raster }, ..Quality::FAST };
    for &(season, from, to) in spans {
        let steps = ((to - from) / 24.0 * LENGTH / STEP) as usize;
        let light =
            |step: usize| mean(&land_and_sky(&mut renderer, at(season, from) + STEP * step as f64, &quick), 0..8);
        let light: Vec<_> = (0..steps).map(light).collect();
        for three in light.windows(3) {
            worst = (0..3).map(|i| (three[0][i] - 2.0 * three[1][i] + three[2][i]).abs()).fold(worst, f64::max);
        }
    }
    println!("worst bend {worst:.2} codes");
    assert!(worst < BEND);
}

/// A winter's sunrise.
#[test]
fn light_does_not_jump() {
    bends_little(&[(2, 7.0, 8.5)]);
}

/// Dawns and dusks of summer and winter.
#[test]
#[ignore = "long: run by .ci/run"]
fn light_does_not_jump_at_dawn_or_dusk() {
    bends_little(&[(0, 4.0, 9.0), (0, 14.5, 21.9), (2, 4.0, 9.0), (2, 14.5, 21.9)]);
}

/// In an autumn's dusk the moon takes over from the sun as the land's light: the mean light of the land goes on as it went,
/// what it changes by from frame to frame, at 60 a second, differing by less than a tenth of a code.
#[test]
fn the_moon_takes_over_unseen() {
    const BEND: f64 = 0.1;
    let mut renderer = Renderer::new(2).unwrap();
    let start = LENGTH + 35.5;
    let land = |n: u32| mean(&land_and_sky(&mut renderer, start + f64::from(n) / 60.0, &Quality::DEFAULT), 27..54);
    let light: Vec<_> = (0..36).map(land).collect();
    let bend =
        |three: &[[f64; 3]]| (0..3).map(|i| (three[0][i] - 2.0 * three[1][i] + three[2][i]).abs()).fold(0.0, f64::max);
    let worst = light.windows(3).map(bend).fold(0.0, f64::max);
    println!("worst bend {worst:.3} codes");
    assert!(worst < BEND, "{light:?}");
}

/// By day and at night, where a lamp with a cube of maps burns.
#[test]
fn every_level_and_thread_count_gives_the_same_frame() {
    for quality in [Quality::FAST, Quality::DEFAULT, Quality::EXACT] {
        for time in [at(0, 18.0), at(2, 22.5)] {
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
