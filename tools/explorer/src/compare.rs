//! The frame that is shown against the same frame without shortcuts, which a thread of its own renders.

use crate::background::Background;
use crate::request::Request;
use crate::watched::Record;
use crate::worker::Maker;
use paprsek::Quality;
use paprsek::frame::{Frame, Tile};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, PoisonError};
use testkit::flip;
use testkit::metrics::{Difference, channels, ssim};

/// A comparison of a frame.
pub struct Compared {
    /// The frame that was compared, as it was asked for.
    pub request: Request,
    /// The same frame without shortcuts.
    pub truth: Frame,
    /// How far they are apart.
    pub difference: Difference,
    /// Their structural similarity, 1 for equal pictures.
    pub ssim: f64,
    /// FLIP at the usual viewing distance, the mean over the pixels.
    pub flip: f64,
}

/// What the comparison is set to, and what it has found.
pub struct Compare {
    /// Whether it is shown.
    pub on: bool,
    /// Name of the quality that is the truth: `exact` or `reference`.
    pub against: &'static str,
    /// Whether the difference is shown in place of the truth.
    pub difference: bool,
    /// How many times larger differences are shown than they are.
    pub amplified: f32,
    /// The share of the picture's width that shows the frame itself; the rest shows the truth or the difference.
    pub split: f32,
    /// What was found last.
    pub found: Option<Compared>,
    /// What is being compared.
    asked: Option<(Request, &'static str)>,
    record: Arc<Mutex<Option<Arc<Record>>>>,
    thread: Background<(Request, &'static str, Frame), Result<Option<Compared>, String>>,
}

impl Compare {
    /// A comparison that is not shown yet.
    pub fn new() -> Result<Compare, String> {
        let record = Arc::<Mutex<Option<Arc<Record>>>>::default();
        let (own, mut maker) = (record.clone(), Maker::default());
        let work = move |(request, against, frame): (Request, &'static str, Frame)| {
            // One thread, so that the picture stays in motion beside it.
            let quality = Quality::named(against).unwrap_or_default();
            let exact = Request { quality, base: against, threads: 1, ..request.clone() };
            let begun =
                |record: &Arc<Record>| *own.lock().unwrap_or_else(PoisonError::into_inner) = Some(record.clone());
            let truth = maker.frame(exact, None, begun)?.frame;
            let record = own.lock().unwrap_or_else(PoisonError::into_inner).take();
            if record.is_none_or(|record| record.cancelled.load(Ordering::Relaxed)) {
                return Ok(None);
            }
            let difference = Difference::between(&frame, &truth);
            let (ssim, flip) = (ssim(&frame, &truth), flip::mean(&flip::flip(&frame, &truth)));
            Ok(Some(Compared { request, truth, difference, ssim, flip }))
        };
        let thread = Background::start(work)?;
        Ok(Compare {
            on: false,
            against: "exact",
            difference: false,
            amplified: 8.0,
            split: 0.5,
            found: None,
            asked: None,
            record,
            thread,
        })
    }

    /// Compares the frame that is shown, unless that has been asked for or is about to change. Gives whether there is
    /// something new.
    pub fn look(&mut self, request: &Request, frame: &Frame, rests: bool) -> Result<bool, String> {
        let found = self.thread.take().transpose()?.flatten();
        let fresh = found.is_some();
        self.found = found.or_else(|| self.found.take());
        if self.on && rests && self.asked.as_ref() != Some(&(request.clone(), self.against)) {
            // What is under way is for a frame that is no longer shown.
            if let Some(record) = &*self.record.lock().unwrap_or_else(PoisonError::into_inner) {
                record.cancelled.store(true, Ordering::Relaxed);
            }
            self.found = None;
            self.asked = Some((request.clone(), self.against));
            self.thread.ask((request.clone(), self.against, frame.clone()));
        }
        Ok(fresh)
    }

    /// The share of the truth that is rendered, 0 to 1.
    pub fn progress(&self) -> f32 {
        let record = self.record.lock().unwrap_or_else(PoisonError::into_inner);
        let Some((request, _)) = &self.asked else { return 0.0 };
        let tiles = request.size.0.div_ceil(Tile::SIZE) * request.size.1.div_ceil(Tile::SIZE);
        record.as_ref().map_or(0.0, |record| record.tiles.load(Ordering::Relaxed) as f32 / tiles as f32)
    }

    /// What was found, if it is of that frame.
    pub fn of(&self, request: &Request) -> Option<&Compared> {
        let asked = self.asked.as_ref().is_some_and(|asked| asked.1 == self.against);
        self.found.as_ref().filter(|found| self.on && asked && found.request == *request)
    }

    /// Draws the truth or the difference into the right part of a picture.
    pub fn draw(&self, found: &Compared, frame: &Frame, pixels: &mut [u32]) {
        let from = (frame.width as f32 * self.split) as usize;
        for (row, out) in pixels.chunks_exact_mut(frame.width).enumerate() {
            let own = &frame.pixels[row * frame.width..];
            let truth = &found.truth.pixels[row * frame.width..];
            for ((out, own), truth) in out.iter_mut().zip(own).zip(truth).skip(from) {
                *out = if self.difference { amplified(*own, *truth, self.amplified) } else { *truth };
            }
            if from < frame.width {
                out[from] = 0xff_ffff;
            }
        }
    }
}

/// The difference of two pixels, times a factor, around grey.
fn amplified(own: u32, truth: u32, factor: f32) -> u32 {
    let (own, truth) = (channels(own), channels(truth));
    let code = |k: usize| (128.0 + (f32::from(own[k]) - f32::from(truth[k])) * factor).clamp(0.0, 255.0) as u32;
    code(0) << 16 | code(1) << 8 | code(2)
}
