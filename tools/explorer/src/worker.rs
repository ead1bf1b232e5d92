//! Rendering what is asked for, watched.

use crate::overlay::{Coloured, Overlay, coloured};
use crate::request::Request;
use crate::watched::{Record, Watched};
use paprsek::frame::placement::Placed;
use paprsek::frame::{Frame, Renderer};
use paprsek::simd::level;
use std::mem::take;
use std::sync::atomic::Ordering;
use std::sync::{Arc, PoisonError};
use std::time::Instant;

/// A finished frame.
pub struct Shown {
    /// What was asked for.
    pub request: Request,
    /// The pixels.
    pub frame: Frame,
    /// What is shown over them.
    pub coloured: Option<Coloured>,
    /// Where the scene's camera and its aeroplane were.
    pub placed: Placed,
    /// Time of the frame, milliseconds.
    pub ms: f64,
    /// The layers: name, and milliseconds of preparing and of drawing, of all threads together.
    pub layers: Vec<(&'static str, f64, f64)>,
    /// Samples traced or shaded.
    pub samples: u64,
    /// Threads that rendered it.
    pub threads: usize,
}

/// What makes frames: a renderer, which is made anew for another number of threads.
#[derive(Default)]
pub struct Maker(Option<(usize, Renderer)>);

impl Maker {
    /// The renderer that a request is for.
    pub fn renderer(&mut self, threads: usize, simd: &str) -> Result<&mut Renderer, String> {
        let (_, mut own) = match self.0.take() {
            Some((same, own)) if same == threads => (same, own),
            _ => (threads, Renderer::new(threads)?),
        };
        if own.simd() != simd
            && let Some((_, level)) = level::all().into_iter().find(|level| level.0 == simd)
        {
            own = own.at_level(level);
        }
        Ok(&mut self.0.insert((threads, own)).1)
    }

    /// Renders a frame. `begun` gets what is known of it before it is drawn, and the number of its tiles.
    pub fn frame(
        &mut self,
        request: Request,
        overlay: Option<Overlay>,
        begun: impl FnOnce(&Arc<Record>),
    ) -> Result<Shown, String> {
        let renderer = self.renderer(request.threads, request.simd)?;
        let mut frame = Frame::new(request.size.0, request.size.1);
        let began = Instant::now();
        *renderer.cache().get::<Placed>().lock() = Placed::default();
        let mut spec = renderer.spec(request.time, &request.quality, request.size);
        spec.values = &request.values;
        let mut picture = (request.scene.picture)(&spec);
        let (watched, record) = Watched::new(take(&mut picture.layers), overlay, request.size);
        let names = watched.names();
        begun(&record);
        picture.layers.push(Box::new(watched));
        let samples = renderer.draw(picture, &mut frame).samples;
        let ms = began.elapsed().as_secs_f64() * 1000.0;
        let placed = *renderer.cache().get::<Placed>().lock();
        let threads = renderer.threads();
        let milliseconds = |part: usize, layer: usize| record.layers[layer][part].load(Ordering::Relaxed) as f64 * 1e-6;
        let layers =
            names.iter().enumerate().map(|(k, name)| (*name, milliseconds(0, k), milliseconds(1, k))).collect();
        let numbers = record.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        let coloured = overlay.map(|overlay| coloured(overlay, &frame, &numbers));
        drop(numbers);
        Ok(Shown { request, frame, coloured, placed, ms, layers, samples, threads })
    }
}
