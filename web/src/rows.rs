//! Rows of a frame, in the form that a canvas takes.

use paprsek::frame::bands::Prepared;
use paprsek::frame::{Options, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;

/// The frame that rows are asked of.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The scene's place in [`scenes::ALL`].
    pub scene: usize,
    /// Seconds since the scene's start.
    pub time: f64,
    /// Width and height of the whole frame, pixels.
    pub size: (usize, usize),
    /// The quality's place in [`Quality::NAMED`].
    pub quality: usize,
    /// A value for each of the scene's parameters, in the order of its table. NaN, or none at all, is the default; what a
    /// parameter does not take is the nearest that it takes.
    pub values: Vec<f64>,
}

/// A renderer on one thread, with the frame that it has prepared last.
pub struct Rows {
    renderer: Renderer,
    prepared: Option<(Request, Prepared)>,
    pixels: Vec<u32>,
}

impl Rows {
    /// A renderer that has prepared nothing. Fails where threads cannot be started.
    pub fn new() -> Result<Rows, String> {
        Ok(Rows { renderer: Renderer::new(1)?, prepared: None, pixels: Vec::new() })
    }

    /// Renders rows `first` to `last`, the latter not among them: a pixel has red, green, blue and 255, a byte each. None
    /// where there is no such scene or quality.
    ///
    /// A frame whose rows come in several calls is prepared once.
    pub fn render(&mut self, request: &Request, first: usize, last: usize) -> &[u32] {
        self.pixels.clear();
        let scene = scenes::ALL.get(request.scene);
        let quality = Quality::NAMED.get(request.quality);
        let (Some(scene), Some((_, quality))) = (scene, quality) else { return &[] };
        if self.prepared.as_ref().is_none_or(|prepared| prepared.0 != *request) {
            // The last one goes first, so that there is memory for one only.
            self.prepared = None;
            let asked = scene.parameters.iter().zip(&request.values).filter(|(_, value)| !value.is_nan());
            let values: Vec<_> = asked
                .map(|(parameter, value)| (parameter.name, value.clamp(parameter.range.0, parameter.range.1)))
                .collect();
            let options = Options { quality, stereo: None, values: &values };
            let prepared = self.renderer.prepare_rows(scene, request.time, &options, request.size);
            self.prepared = Some((request.clone(), prepared));
        }
        if let Some((_, prepared)) = &self.prepared {
            self.renderer.draw_rows(prepared, first..last, &mut self.pixels);
        }
        for pixel in &mut self.pixels {
            *pixel = rgba(*pixel);
        }
        &self.pixels
    }

    /// The name of the SIMD level.
    pub fn simd(&self) -> &'static str {
        self.renderer.simd()
    }
}

/// A pixel `0x00RRGGBB` as the bytes red, green, blue and 255 of a little-endian machine, which WebAssembly is.
fn rgba(pixel: u32) -> u32 {
    pixel.swap_bytes() >> 8 | 0xff00_0000
}

#[cfg(test)]
mod tests {
    use super::*;
    use paprsek::frame::Frame;

    #[test]
    fn a_pixel_has_the_canvas_s_order() {
        assert_eq!(rgba(0x0012_3456).to_le_bytes(), [0x12, 0x34, 0x56, 255]);
    }

    /// The whole frame by the renderer's usual way, as a canvas takes it.
    fn whole(request: &Request, values: &[(&'static str, f64)]) -> Vec<u32> {
        let mut frame = Frame::new(request.size.0, request.size.1);
        let options = Options { quality: &Quality::NAMED[request.quality].1, stereo: None, values };
        let scene = &scenes::ALL[request.scene];
        Renderer::new(1).unwrap().render_with(scene, request.time, &options, &mut frame);
        frame.pixels.into_iter().map(rgba).collect()
    }

    /// Rows in any order and of any number, after frames of other scenes, are those of the whole frame.
    #[test]
    fn rows_are_those_of_the_whole_frame() {
        let mut rows = Rows::new().unwrap();
        for scene in 0..scenes::ALL.len() {
            let request = Request { scene, time: 1.5, size: (70, 150), quality: scene % 2, values: vec![] };
            let whole = whole(&request, &[]);
            for (first, last) in
                [(128, 150), (0, 64), (64, 128), (3, 5), (60, 131), (0, 150), (149, 999), (7, 7), (150, 9)]
            {
                let end = last.min(150);
                let expected = &whole[first.min(end) * 70..end * 70];
                assert!(rows.render(&request, first, last) == expected, "{scene}: {first} to {last}");
            }
        }
    }

    #[test]
    fn parameters_are_set_by_their_place_and_kept_within_their_range() {
        let mut rows = Rows::new().unwrap();
        let scene = scenes::ALL.iter().position(|scene| scene.name == "shadow").unwrap();
        let table = scenes::ALL[scene].parameters;
        let request = |values| Request { scene, time: 2.0, size: (64, 36), quality: 0, values };
        let plain = whole(&request(vec![]), &[]);
        assert!(rows.render(&request(vec![f64::NAN; 9]), 0, 36) == plain);
        let mut differ = 0;
        for (place, parameter) in table.iter().enumerate() {
            let mut values = vec![f64::NAN; table.len()];
            values[place] = parameter.range.1 + 1.0;
            let expected = whole(&request(vec![]), &[(parameter.name, parameter.range.1)]);
            assert!(rows.render(&request(values), 0, 36) == expected, "{}", parameter.name);
            differ += usize::from(expected != plain);
        }
        assert!(differ > 0, "{} parameters change nothing", table.len());
    }

    #[test]
    fn what_is_not_there_has_no_rows() {
        let mut rows = Rows::new().unwrap();
        let request = Request { scene: 0, time: 0.0, size: (8, 8), quality: 0, values: vec![] };
        assert!(rows.render(&Request { scene: 999, ..request.clone() }, 0, 8).is_empty());
        assert!(rows.render(&Request { quality: 999, ..request.clone() }, 0, 8).is_empty());
        assert_eq!(rows.render(&request, 0, 8).len(), 64);
    }
}
