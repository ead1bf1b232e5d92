//! How the pixel under the mouse came to be, told by a thread of its own.

use crate::background::Background;
use crate::request::Request;
use crate::worker::Maker;
use paprsek::frame::Options;
use paprsek::frame::probe::probe;

/// A pixel and what is told of it, or why nothing is.
type Told = Result<((usize, usize), String), String>;

/// The probe, and what it has told.
pub struct Probing {
    /// Whether it is shown.
    pub on: bool,
    /// The pixel and what is told of it.
    pub told: Option<((usize, usize), String)>,
    asked: Option<(Request, (usize, usize))>,
    thread: Background<(Request, (usize, usize)), Told>,
}

impl Probing {
    /// A probe that is not shown yet.
    pub fn new() -> Result<Probing, String> {
        let mut maker = Maker::default();
        let work = move |(request, pixel): (Request, (usize, usize))| {
            let renderer = maker.renderer(1, request.simd)?;
            let options = Options { quality: &request.quality, values: &request.values, ..Options::default() };
            Ok((pixel, probe(renderer, &request.scene, request.time, &options, request.size, pixel)))
        };
        Ok(Probing { on: false, told: None, asked: None, thread: Background::start(work)? })
    }

    /// Asks about a pixel of a frame, unless that has been asked. Gives whether there is something new.
    pub fn look(&mut self, request: &Request, mouse: Option<(f32, f32)>) -> Result<bool, String> {
        let told = self.thread.take().transpose()?;
        let fresh = told.is_some();
        self.told = told.or_else(|| self.told.take());
        if let Some((x, y)) = mouse.filter(|(x, y)| self.on && *x >= 0.0 && *y >= 0.0) {
            let pixel = (x as usize, y as usize);
            let asked = self.asked.as_ref().is_some_and(|asked| asked.1 == pixel && asked.0 == *request);
            if !asked && pixel.0 < request.size.0 && pixel.1 < request.size.1 {
                self.asked = Some((request.clone(), pixel));
                self.thread.ask((request.clone(), pixel));
            }
        }
        Ok(fresh)
    }
}
