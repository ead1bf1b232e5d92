//! The show: its parts are what plays, each at its own time, and dark is only where one ends.

use paprsek::frame::Scene;
use paprsek::frame::{Frame, Options, Renderer};
use paprsek::scenes;
use paprsek::scenes::show::intro::{DARK, FADE, INTRO, PARTS, READ, WRITING, brightness};
use paprsek::settings::Quality;
use paprsek::view::Stereo;

const SIZE: (usize, usize) = (96, 54);

fn render(scene: &Scene, time: f64, stereo: Option<Stereo>) -> Vec<u32> {
    let mut frame = Frame::new(SIZE.0, SIZE.1);
    Renderer::new(2).unwrap().render_with(scene, time, &Options { stereo, ..Options::default() }, &mut frame);
    frame.pixels
}

#[test]
fn it_comes_first_and_its_parts_are_scenes() {
    assert_eq!(scenes::ALL[0].name, INTRO.name);
    assert_eq!(scenes::INTRO.name, INTRO.name);
    assert_eq!(PARTS[0].0, 0.0);
    let ends = PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]);
    for ((start, (scene, from)), end) in PARTS.iter().zip(ends) {
        assert!(scenes::named(scene.name).is_some(), "{}", scene.name);
        assert!(*from >= 0.0 && end - start > 4.0 * FADE, "{}", scene.name);
        assert!(from + end - start <= scene.duration, "{} is too short", scene.name);
    }
}

/// Every so many seconds, up to the very fades, or to the cuts that have none.
fn parts_are_shown_as_they_are(step: usize) {
    let ends: Vec<f64> = PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]).collect();
    for (number, (start, (scene, from))) in PARTS.iter().enumerate() {
        let fade = |cut: f64| if DARK.contains(&cut) || cut == INTRO.duration { FADE } else { 0.0 };
        let first = start + fade(*start);
        // A frame before the next part.
        let last = ends[number] - fade(ends[number]).max(1.0 / 60.0);
        let steps = (last - first).floor() as usize;
        for time in (0..=steps).step_by(step).map(|step| first + step as f64).chain([last]) {
            let written = WRITING.iter().any(|([begin, ..], _)| (0.0..READ).contains(&(time - f64::from(*begin))));
            let stereo = (time > 20.0).then_some(Stereo { eye_distance: 0.1, convergence: 4.0 });
            let same = render(&INTRO, time, stereo) == render(scene, from + (time - start), stereo);
            // What begins to come together, or has nearly flown apart, may be too dim to be seen.
            assert!(same || written, "{} at {time}", scene.name);
        }
    }
}

#[test]
fn a_part_is_shown_as_it_is() {
    parts_are_shown_as_they_are(9);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn every_second_of_a_part_is_shown_as_it_is() {
    parts_are_shown_as_they_are(1);
}

#[test]
fn what_is_written_is_seen() {
    for ([begin, ..], text) in WRITING {
        let (begin, ends) = (f64::from(*begin), PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]));
        let ((start, (scene, from)), end) =
            PARTS.iter().zip(ends).filter(|((start, _), _)| *start <= begin).last().unwrap();
        assert!(begin + READ <= end - FADE, "{text} is cut off");
        let time = begin + 0.5 * READ;
        assert_ne!(render(&INTRO, time, None), render(scene, from + (time - start), None), "{text}");
    }
}

#[test]
fn it_ends_in_the_dark() {
    let codes =
        |pixels: Vec<u32>| pixels.into_iter().map(|p| u64::from(p & 255) + u64::from(p >> 8 & 255)).sum::<u64>();
    let dimmed: Vec<u64> =
        (0..=10).map(|k| codes(render(&INTRO, INTRO.duration - FADE * (1.0 - f64::from(k) / 10.0), None))).collect();
    assert!(dimmed.windows(2).all(|pair| pair[1] < pair[0] + pair[0] / 50), "{dimmed:?}");
    assert!(dimmed[5] < dimmed[0] * 3 / 4 && dimmed[5] > dimmed[0] / 4, "{dimmed:?}");
    assert_eq!(dimmed[10], 0);
    assert_eq!(codes(render(&INTRO, INTRO.duration + 9.0, None)), 0);
}

#[test]
fn light_fades_at_dark_cuts_and_at_the_end_alone() {
    let light = |time| brightness(&[10.0, 25.0], 40.0, time);
    for time in [-3.0, 0.0, 0.1, 5.0, 10.0 - FADE, 10.0 + FADE, 24.0, 25.0 + FADE, 40.0 - FADE] {
        assert_eq!(light(time), 1.0, "{time}");
    }
    for time in [10.0, 25.0, 40.0, 41.0, f64::INFINITY] {
        assert_eq!(light(time), 0.0, "{time}");
    }
    assert!((0.0..=1.0).contains(&light(f64::NAN)));
    for k in 1..20 {
        let (a, b) = (FADE * f64::from(k) / 20.0, FADE * f64::from(k + 1) / 20.0);
        for edge in [10.0, 25.0] {
            assert!(light(edge + a) <= light(edge + b) && light(edge - a) <= light(edge - b));
            assert!((light(edge + a) - light(edge - a)).abs() < 1e-6 && light(edge + a) < 1.0);
        }
        assert!(light(40.0 - a) <= light(40.0 - b));
    }
}

/// Whether nine tenths of a frame's pixels are within 12 codes of its median colour.
fn is_one_color(frame: &Frame) -> bool {
    let channels = |pixel: u32| [16, 8, 0].map(|shift| (pixel >> shift & 255) as i32);
    let median = [0, 1, 2].map(|channel| {
        let mut codes: Vec<i32> = frame.pixels.iter().map(|pixel| channels(*pixel)[channel]).collect();
        let middle = codes.len() / 2;
        *codes.select_nth_unstable(middle).1
    });
    let like = |pixel: &&u32| channels(**pixel).iter().zip(median).all(|(code, median)| (code - median).abs() <= 12);
    frame.pixels.iter().filter(like).count() * 10 > frame.pixels.len() * 9
}

/// Into a cloud and out of it again: ten frames a second of the flight, of which no five in a row are of one colour.
#[test]
fn the_flight_is_never_one_color_for_half_a_second() {
    let mut renderer = Renderer::new(2).unwrap();
    let mut frame = Frame::new(160, 90);
    let mut longest = 0;
    let mut run = 0;
    // From after its fade to before the next.
    for step in 354..688 {
        renderer.render(&INTRO, step as f64 / 10.0, &Quality::FAST, &mut frame);
        run = if is_one_color(&frame) { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    println!("longest run of frames of one colour: {longest}");
    assert!(longest < 5, "{longest} frames in a row");
    frame.pixels.fill(0x40_50_60);
    assert!(is_one_color(&frame));
}
