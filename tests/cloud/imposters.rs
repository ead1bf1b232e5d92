//! Imposters of clouds: frames do not depend on which are kept, and are near to those of rays.

use fearless_simd::Level;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::{CloudSettings, Quality};
use testkit::metrics::Difference;

const SIZE: (usize, usize) = (320, 180);

fn render(renderer: &mut Renderer, time: f64, imposter: f32, size: (usize, usize)) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    let quality = Quality { cloud: CloudSettings { imposter, ..Quality::FAST.cloud }, ..Quality::FAST };
    let scene = scenes::named("sky-of-clouds").expect("a scene");
    renderer.render(&scene, time, &quality, &mut frame);
    frame
}

#[test]
fn a_frame_has_no_history() {
    // Each by a renderer that has kept nothing.
    let alone = [2.0, 2.9, 3.0, 3.1, 7.5].map(|time| {
        let mut renderer = Renderer::new(2).expect("threads");
        (time, render(&mut renderer, time, 1.0, SIZE))
    });
    // Now imposters are made in another order, by one thread, and for frames between.
    let mut renderer = Renderer::new(1).expect("a thread");
    for (time, frame) in alone.iter().rev() {
        render(&mut renderer, time + 0.05, 1.0, SIZE);
        assert!(render(&mut renderer, *time, 1.0, SIZE) == *frame, "{time}");
    }
    // As many frames as no imposter outlives, of another size, for which others are needed.
    for i in 0..130 {
        render(&mut renderer, 20.0 + f64::from(i), 1.0, (16, 16));
    }
    for (time, frame) in &alone {
        assert!(render(&mut renderer, *time, 1.0, SIZE) == *frame, "{time}");
    }
}

#[test]
fn levels_give_the_same_bytes() {
    // Rays once ended before further clouds when those of their vector had: its length mattered.
    for imposter in [0.0, 1.0] {
        let best = render(&mut Renderer::new(1).expect("a thread"), 4.0, imposter, (160, 96));
        let mut least = Renderer::new(1).expect("a thread").at_level(Level::baseline());
        assert!(render(&mut least, 4.0, imposter, (160, 96)) == best, "{imposter}");
    }
}

fn stay_near(count: u32) {
    // Texels are fewer than pixels: smaller pictures, whose pixels have more in them, are off by more.
    const SIZE: (usize, usize) = (1280, 720);
    let mut renderer = Renderer::new(2).expect("threads");
    let mut last: Option<[Frame; 2]> = None;
    let mut changes = [0.0f64; 2];
    for i in 0..count {
        let frames = [0.0, 1.0].map(|bound| render(&mut renderer, 2.0 + f64::from(i) / 60.0, bound, SIZE));
        let psnr = Difference::between(&frames[0], &frames[1]).psnr();
        assert!(psnr > 35.0, "{psnr} dB in frame {i}");
        if let Some(last) = last {
            for (change, (a, b)) in changes.iter_mut().zip(last.iter().zip(&frames)) {
                *change = change.max(Difference::between(a, b).rmse());
            }
        }
        last = Some(frames);
    }
    assert!(changes[1] < 2.0 * changes[0], "{changes:?}");
}

#[test]
fn frames_are_near_to_those_of_rays_and_do_not_pop() {
    stay_near(3);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn frames_do_not_pop_for_some_tenths_of_a_second() {
    stay_near(24);
}
