//! The table of frames whose bytes are kept: every scene at several times, qualities and sizes, with one eye and with two.

use paprsek::frame::{Frame, Options, Renderer, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::view::Stereo;
use std::fmt;

/// Shares of a scene's length at which it is rendered.
const INSTANTS: [f64; 5] = [0.03, 0.27, 0.48, 0.71, 0.94];

/// A frame of the table.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    scene: Scene,
    /// Seconds.
    time: f64,
    quality: &'static str,
    /// Width and height, pixels.
    size: (usize, usize),
    eyes: Option<Stereo>,
}

/// Every frame of the table, in its order.
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for &scene in scenes::all() {
        let mut row = |share: f64, quality, size, eyes| {
            let time = (share * scene.duration * 100.0).round() / 100.0;
            rows.push(Row { scene, time, quality, size, eyes });
        };
        for share in INSTANTS {
            row(share, "fast", (160, 90), None);
            row(share, "default", (160, 90), None);
            row(share, "exact", (97, 55), None);
            row(share, "reference", (31, 17), None);
        }
        for size in [(1, 1), (65, 1), (3, 129)] {
            row(0.6, "default", size, None);
        }
        row(0.35, "default", (131, 66), Some(Stereo { eye_distance: 0.065, convergence: 8.0 }));
    }
    rows
}

impl Row {
    /// Renders the frame.
    pub fn frame(&self, renderer: &mut Renderer) -> Frame {
        let mut frame = Frame::new(self.size.0, self.size.1);
        let quality = &Quality::named(self.quality).expect("a quality of the list");
        let options = Options { quality, stereo: self.eyes, ..Options::default() };
        renderer.render_with(&self.scene, self.time, &options, &mut frame);
        frame
    }

    /// The row of the table: scene, time, quality, size, one eye or two; then the hash.
    pub fn line(&self, renderer: &mut Renderer) -> String {
        format!("{self} {:016x}", hash(&self.frame(renderer)))
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Row { scene, time, quality, size: (width, height), eyes } = self;
        let eyes = if eyes.is_some() { "two" } else { "one" };
        write!(f, "{} {time} {quality} {width}x{height} {eyes}", scene.name)
    }
}

/// The frame's pixels by FNV-1a, 64 bits (Fowler, Noll and Vo).
pub fn hash(frame: &Frame) -> u64 {
    let bytes = frame.pixels.iter().flat_map(|pixel| pixel.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ byte as u64).wrapping_mul(0x0100_0000_01b3))
}
