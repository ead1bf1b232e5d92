//! The thread that renders: it takes the newest request, and leaves the newest frame.

use crate::request::Request;
use crate::watched::Watched;
use paprsek::frame::placement::Placed;
use paprsek::frame::{Frame, Layer, Renderer};
use paprsek::simd::level;
use std::mem::take;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Instant;

/// A finished frame.
pub struct Shown {
    /// What was asked for.
    pub request: Request,
    /// The pixels.
    pub frame: Frame,
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

/// What the threads share.
#[derive(Default)]
struct Slot {
    asked: Option<Request>,
    done: Option<Shown>,
    /// Why there will be no more frames.
    failed: Option<String>,
}

/// The thread that renders. It ends with the process.
pub struct Worker(Arc<(Mutex<Slot>, Condvar)>);

impl Worker {
    /// Starts the thread.
    pub fn start() -> Result<Worker, String> {
        let shared = Arc::<(Mutex<Slot>, Condvar)>::default();
        let own = shared.clone();
        let render = move || {
            if let Err(why) = render(&own) {
                lock(&own.0).failed = Some(why);
            }
        };
        thread::Builder::new().spawn(render).map_err(|error| error.to_string())?;
        Ok(Worker(shared))
    }

    /// Asks for a frame, in place of one that has been asked for and not begun.
    pub fn ask(&self, request: Request) {
        lock(&self.0.0).asked = Some(request);
        self.0.1.notify_one();
    }

    /// The newest frame, if there is one that has not been taken.
    pub fn take(&self) -> Result<Option<Shown>, String> {
        let mut slot = lock(&self.0.0);
        match slot.failed.take() {
            Some(why) => Err(why),
            None => Ok(slot.done.take()),
        }
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Renders what is asked for, for ever.
fn render((slot, wake): &(Mutex<Slot>, Condvar)) -> Result<(), String> {
    let mut renderer: Option<(usize, Renderer)> = None;
    let mut last: Option<Request> = None;
    loop {
        let request = {
            let mut slot = lock(slot);
            loop {
                match slot.asked.take().filter(|asked| Some(asked) != last.as_ref()) {
                    Some(asked) => break asked,
                    None => slot = wake.wait(slot).unwrap_or_else(PoisonError::into_inner),
                }
            }
        };
        // A renderer keeps its threads and its level; another number of threads takes another renderer.
        let (threads, mut own) = match renderer.take() {
            Some((threads, own)) if threads == request.threads => (threads, own),
            _ => (request.threads, Renderer::new(request.threads)?),
        };
        if own.simd() != request.simd
            && let Some((_, level)) = level::all().into_iter().find(|level| level.0 == request.simd)
        {
            own = own.at_level(level);
        }
        let shown = frame(&mut own, &request);
        renderer = Some((threads, own));
        last = Some(request);
        lock(slot).done = Some(shown);
    }
}

/// Renders one frame and watches its layers.
pub fn frame(renderer: &mut Renderer, request: &Request) -> Shown {
    let mut frame = Frame::new(request.size.0, request.size.1);
    let began = Instant::now();
    *renderer.cache().get::<Placed>().lock() = Placed::default();
    let mut spec = renderer.spec(request.time, &request.quality, request.size);
    spec.values = &request.values;
    let mut picture = (request.scene.picture)(&spec);
    let mut layers = Vec::new();
    for inner in take(&mut picture.layers) {
        let (watched, taken) = Watched::new(inner);
        layers.push((watched.name(), taken));
        picture.layers.push(Box::new(watched));
    }
    let samples = renderer.draw(picture, &mut frame).samples;
    let ms = began.elapsed().as_secs_f64() * 1000.0;
    let placed = *renderer.cache().get::<Placed>().lock();
    let nanoseconds = |count: &AtomicU64| count.load(Ordering::Relaxed) as f64 * 1e-6;
    let layers =
        layers.iter().map(|(name, taken)| (*name, nanoseconds(&taken.prepare), nanoseconds(&taken.draw))).collect();
    Shown { request: request.clone(), frame, placed, ms, layers, samples, threads: renderer.threads() }
}
