//! Two renderers in one process do not disturb each other: what one keeps from frame to frame, the other does not see.

use paprsek::frame::{Frame, Renderer};
use paprsek::raster::RasterMemory;
use paprsek::scenes;
use paprsek::settings::{CloudSettings, Quality};
use std::thread;

const SIZE: (usize, usize) = (120, 68);

/// Scenes that keep something: shadow maps, lit shapes of clouds, imposters.
const SCENES: [&str; 3] = ["shadow-cube", "clouds", "sky-of-clouds"];

fn quality() -> Quality {
    Quality { cloud: CloudSettings { imposter: 1.0, ..Quality::FAST.cloud }, ..Quality::FAST }
}

/// The film of a scene from a time on, a frame per half of a second.
fn film(renderer: &mut Renderer, scene: &str, from: f64) -> Vec<Vec<u32>> {
    let scene = scenes::named(scene).unwrap();
    let frames = (0..3).map(|number| {
        let mut frame = Frame::new(SIZE.0, SIZE.1);
        renderer.render(&scene, from + 0.5 * number as f64, &quality(), &mut frame);
        frame.pixels
    });
    frames.collect()
}

#[test]
fn two_renderers_at_once_give_the_frames_of_one_alone() {
    for scene in SCENES {
        let alone = [2.0, 11.0].map(|from| film(&mut Renderer::new(1).unwrap(), scene, from));
        let films = thread::scope(|scope| {
            let play = |from| scope.spawn(move || film(&mut Renderer::new(1).unwrap(), scene, from));
            [2.0, 11.0].map(play).map(|thread| thread.join().unwrap())
        });
        assert!(films == alone, "{scene}");
    }
}

#[test]
fn what_one_renderer_keeps_another_does_not_see() {
    let (mut one, other) = (Renderer::new(1).unwrap(), Renderer::new(1).unwrap());
    film(&mut one, "shadow-cube", 2.0);
    let maps = |renderer: &Renderer| renderer.cache().get::<RasterMemory>().lock().maps.iter().count();
    assert!(maps(&one) > 0);
    assert_eq!(maps(&other), 0);
}
