//! What layers tell of themselves is what they do.

use paprsek::frame::inspect::Aspect;
use paprsek::frame::probe::probe;
use paprsek::frame::{Frame, Options, Renderer, Tile};
use paprsek::{Quality, scenes};

/// Fragments that are counted pixel by pixel are those that the rasterizer says it has shaded.
#[test]
fn samples_of_pixels_are_those_of_the_frame() {
    let (width, height) = (210, 120);
    let mut renderer = Renderer::new(2).unwrap();
    for name in ["shadow", "shadow-cube"] {
        let scene = scenes::named(name).unwrap();
        for quality in [Quality::FAST, Quality::DEFAULT] {
            let mut frame = Frame::new(width, height);
            let shaded = renderer.render(&scene, 3.0, &quality, &mut frame).samples;
            let mut picture = (scene.picture)(&renderer.spec(3.0, &quality, (width, height)));
            let layer = &mut picture.layers[0];
            layer.prepare(renderer.workers(), renderer.cache());
            let mut sum = 0.0;
            for (column, row) in (0..4).flat_map(|column| (0..2).map(move |row| (column, row))) {
                let mut tile = Tile::at(column, row, width, height);
                let numbers = layer.inspect(Aspect::Samples, renderer.level(), &mut tile).unwrap();
                sum += numbers.iter().map(|number| f64::from(*number)).sum::<f64>();
            }
            assert!(shaded > 1000);
            assert_eq!(sum, shaded as f64, "{name}");
        }
    }
}

/// The code that the probe ends with is that of the frame's pixel, in every scene.
#[test]
fn a_probe_ends_with_the_pixel() {
    let (width, height) = (160, 90);
    let mut renderer = Renderer::new(2).unwrap();
    for scene in scenes::all() {
        let time = 0.4 * scene.duration;
        let options = Options { quality: &Quality::FAST, ..Options::default() };
        let mut frame = Frame::new(width, height);
        renderer.render_with(scene, time, &options, &mut frame);
        for (x, y) in [(0, 0), (80, 45), (159, 89), (33, 70)] {
            let text = probe(&renderer, scene, time, &options, (width, height), (x, y));
            let [_, red, green, blue] = frame.pixels[y * width + x].to_be_bytes();
            let last = text.lines().last().unwrap();
            assert!(last.starts_with(&format!("code {red} {green} {blue},")), "{} {x},{y}: {text}", scene.name);
            assert!(text.lines().count() >= 3, "{text}");
        }
    }
}
