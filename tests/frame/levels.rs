//! The same bytes of a frame at every SIMD level, on any number of threads, after any history, at every size.
//!
//! Nothing is fused and no sum is reordered, so no tolerance is needed.

use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;

const BENCH: [&str; 11] = [
    "spheres",
    "spheres-flat",
    "spheres-glass",
    "shadow",
    "shadow-cube",
    "sky",
    "cumulus",
    "cumulus-inside",
    "sky-of-clouds",
    "snow",
    "fire",
];

fn scene(name: &str) -> Scene {
    scenes::named(name).unwrap()
}

fn frame(renderer: &mut Renderer, name: &str, time: f64, quality: &Quality, size: (usize, usize)) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    renderer.render(&scene(name), time, quality, &mut frame);
    frame
}

/// Pixels that differ, the first of them by place and codes.
fn differences(a: &Frame, b: &Frame) -> Option<String> {
    let off: Vec<usize> = (0..a.pixels.len()).filter(|i| a.pixels[*i] != b.pixels[*i]).collect();
    let first = *off.first()?;
    let (x, y) = (first % a.width, first / a.width);
    Some(format!("{} pixels, ({x}, {y}): {:06x} {:06x}", off.len(), a.pixels[first], b.pixels[first]))
}

fn levels_agree(qualities: &[&str], times: &[f64]) {
    let mut failed = vec![];
    for &quality in qualities {
        // The reference takes 64 samples a pixel.
        let size = if quality == "reference" { (70, 40) } else { (200, 113) };
        for name in BENCH {
            for &time in times {
                let mut first: Option<Frame> = None;
                for (level_name, level) in testkit::levels() {
                    let mut renderer = Renderer::new(2).unwrap().at_level(level);
                    assert_eq!(renderer.simd(), level_name);
                    let found = frame(&mut renderer, name, time, &Quality::named(quality).unwrap(), size);
                    let truth = first.get_or_insert_with(|| found.clone());
                    if let Some(off) = differences(truth, &found) {
                        failed.push(format!("{name} at {time}, {quality}, {level_name}: {off}"));
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn every_level_gives_the_same_frame() {
    levels_agree(&["default"], &[9.4]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn every_level_gives_the_same_frame_at_every_quality() {
    levels_agree(&Quality::NAMES, &[2.0, 9.4]);
}

fn threads_agree(qualities: &[&str], counts: &[usize]) {
    for quality in qualities {
        for name in BENCH {
            let quality = Quality::named(quality).unwrap();
            let one = frame(&mut Renderer::new(1).unwrap(), name, 3.1, &quality, (300, 200));
            for &threads in counts {
                let many = frame(&mut Renderer::new(threads).unwrap(), name, 3.1, &quality, (300, 200));
                assert_eq!(differences(&one, &many), None, "{name} on {threads} threads");
            }
        }
    }
}

#[test]
fn threads_do_not_matter() {
    threads_agree(&["default"], &[3]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn threads_do_not_matter_at_any_quality() {
    threads_agree(&["fast", "default", "exact"], &[2, 3, 8]);
}

fn history_is_forgotten(qualities: &[&str]) {
    for quality in qualities {
        let quality = Quality::named(quality).unwrap();
        // One renderer through scenes, sizes, qualities and time, onto a frame that is never cleared.
        let mut old = Renderer::new(2).unwrap();
        let size = (150, 100);
        let mut kept = Frame::new(size.0, size.1);
        for (k, name) in BENCH.into_iter().cycle().take(3 * BENCH.len()).enumerate() {
            let time = 2.0 + 0.05 * k as f64;
            frame(&mut old, BENCH[k / 3], 5.0, &Quality::DEFAULT, (33, 77 + k));
            old.render(&scene(name), time, &quality, &mut kept);
            let alone = frame(&mut Renderer::new(2).unwrap(), name, time, &quality, size);
            assert_eq!(differences(&alone, &kept), None, "{name} at {time}");
        }
    }
}

#[test]
fn history_does_not_matter() {
    history_is_forgotten(&["default"]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn history_does_not_matter_at_any_quality() {
    history_is_forgotten(&["fast", "default", "exact"]);
}

fn sizes_are_filled(qualities: &[&str]) {
    for &quality in qualities {
        for size in [(1, 1), (7, 3), (63, 65), (130, 1), (1, 130), (65, 64), (0, 5), (5, 0), (0, 0)] {
            if quality == "reference" && size.0 * size.1 > 1000 {
                continue;
            }
            for name in BENCH {
                let quality = Quality::named(quality).unwrap();
                let mut first: Option<Frame> = None;
                for (level_name, level) in testkit::levels() {
                    let mut found = Frame::new(size.0, size.1);
                    // No scene is of this colour.
                    found.pixels.fill(0xff00_0000);
                    Renderer::new(2).unwrap().at_level(level).render(&scene(name), 2.0, &quality, &mut found);
                    assert!(found.pixels.iter().all(|p| p >> 24 == 0), "{name} {size:?}: pixels left out");
                    let truth = first.get_or_insert_with(|| found.clone());
                    assert_eq!(differences(truth, &found), None, "{name} {size:?} at {level_name}");
                }
            }
        }
    }
}

#[test]
fn odd_sizes_are_filled() {
    sizes_are_filled(&["default"]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn odd_sizes_are_filled_at_every_quality() {
    sizes_are_filled(&Quality::NAMES);
}

#[test]
fn pixels_do_not_depend_on_the_picture_around_them() {
    // At one sample a pixel a frame of the same height and another width shows the same middle columns.
    for name in BENCH {
        let mut renderer = Renderer::new(2).unwrap();
        let narrow = frame(&mut renderer, name, 2.0, &Quality::EXACT, (64, 90));
        let wide = frame(&mut renderer, name, 2.0, &Quality::EXACT, (192, 90));
        let mut off = 0;
        for y in 0..90 {
            for x in 0..64 {
                let (a, b) = (narrow.pixels[y * 64 + x], wide.pixels[y * 192 + x + 64]);
                let gap = (0..3).map(|k| (a >> (8 * k) & 255).abs_diff(b >> (8 * k) & 255)).max().unwrap();
                off += (gap > 1) as u32;
            }
        }
        // Columns of rays are counted from another edge, so their last bit may differ, and a rim with it.
        assert!(off <= 3, "{name}: {off} pixels");
    }
}
