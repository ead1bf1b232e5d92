//! Plays in a window.
//!
//! The window belongs to the main thread, and the renderer to a thread of its own, which is one of its workers. So Esc
//! ends at once however long a frame takes, and one frame is sent to the display while the next one renders. Three
//! frames go round between the two threads, and neither waits for the other.

use crate::args::Args;
use crate::capture;
use crate::clock::{Clock, SEEK};
use crate::governor::{EIGHTHS, Governor, WHOLE};
use crate::io::complain;
#[cfg(target_os = "linux")]
use crate::sound;
#[cfg(all(unix, feature = "minifb"))]
use crate::window;
use crate::window::{Window, keysym};
use paprsek::frame::{Frame, Renderer, pool};
use std::mem::{swap, take};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

/// Shortest time from one frame to the next: 60 per second, which is what most displays show.
const PERIOD: Duration = Duration::from_nanos(16_666_667);
/// Longest time from one look at the keys to the next.
const POLL: Duration = Duration::from_millis(10);
/// Polls after which a still is sent again, a fifth of a second: the display forgets what another window covers.
const REFRESH: usize = 20;
/// A line grows along the middle of the window until there is a first frame, by a pixel each [`POLL`]: its colour.
const LIGHT_COLOUR: u32 = 0x404040;

/// What the two threads share.
struct Shared {
    clock: Clock,
    /// The latest finished frame, which the window takes while `fresh` is set.
    frame: Frame,
    /// The time of that frame, seconds of the scene.
    time: f64,
    /// Whether that frame has not been shown yet.
    fresh: bool,
    /// The time of a still that has been asked for, until the renderer takes it up.
    still: Option<f64>,
    /// Whether a still is being saved.
    saving: bool,
    /// Why there are no more frames: the range has ended, or there was an error.
    ended: Option<Result<(), Vec<u8>>>,
    /// Whether rendering has failed: then there are no more stills either.
    failed: bool,
}

/// Plays until Esc, until the window is closed or until the range ends.
pub fn play(mut window: Window, args: &'static Args) -> Result<(), Vec<u8>> {
    let frame = capture::black_frame(args.size)?;
    let back = capture::black_frame(args.size)?;
    let clock = Clock::new(args, args.once);
    let shared =
        Shared { clock, frame: back, time: 0.0, fresh: false, still: None, saving: false, ended: None, failed: false };
    // Leaked: when the window goes, the process goes, in the middle of a frame if need be.
    let shared: &Mutex<Shared> = Box::leak(Box::new(Mutex::new(shared)));
    let here = thread::current();
    let render = move || {
        let ended = render(args, shared, &here);
        let mut shared = lock(shared);
        shared.failed = true;
        shared.ended = Some(ended);
    };
    pool::start(Box::leak(Box::new(render))).ok_or("cannot start threads")?;
    #[cfg(target_os = "linux")]
    if args.sounds() {
        let clock = move |heard| lock(shared).clock.follow(heard);
        // Without a thread for it the show is silent.
        pool::start(Box::leak(Box::new(move || _ = sound::play(&clock))));
    }
    if args.fullscreen && !cfg!(without = "fullscreen") {
        window.toggle_fullscreen();
    }
    // The window goes at once, and the process once a still that has been asked for is saved.
    let may_end = move || {
        let shared = lock(shared);
        shared.failed || !(shared.saving || shared.still.is_some())
    };
    #[cfg(all(unix, feature = "minifb"))]
    window::leave_once(may_end);
    let ended = watch(&mut window, frame, shared);
    window.close();
    while !may_end() {
        thread::park_timeout(POLL);
    }
    ended
}

/// Shows frames and hears keys until the end.
fn watch(window: &mut Window, mut frame: Frame, shared: &Mutex<Shared>) -> Result<(), Vec<u8>> {
    // The time of the frame that is shown, and the number of polls since it came.
    let (mut time, mut polls) = (None, 0);
    loop {
        let fresh = {
            thread::park_timeout(POLL);
            let mut shared = lock(shared);
            let fresh = take(&mut shared.fresh);
            if fresh {
                swap(&mut shared.frame, &mut frame);
                time = Some(shared.time);
            } else if let Some(ended) = shared.ended.take() {
                // The last frame has been shown.
                return ended;
            }
            fresh
        };
        polls = if fresh { 0 } else { polls + 1 };
        if polls % REFRESH == 0 {
            if time.is_none() {
                // The first frame may take long, as it has to wait for whatever is baked.
                let width = frame.width;
                frame.pixels[width * (frame.height / 2)..][..polls.min(width)].fill(LIGHT_COLOUR);
            }
            window.show(&frame)?;
        }
        while let Some(key) = window.next_key() {
            let mut shared = lock(shared);
            match key {
                keysym::ESCAPE => return Ok(()),
                keysym::SPACE => shared.clock.toggle(),
                keysym::LEFT => shared.clock.seek(-SEEK),
                keysym::RIGHT => shared.clock.seek(SEEK),
                keysym::F if !cfg!(without = "fullscreen") => window.toggle_fullscreen(),
                keysym::S if !cfg!(without = "stills") => shared.still = time,
                keysym::DIGIT_1..=keysym::DIGIT_9 => shared.clock.jump((key - keysym::DIGIT_1) as usize),
                _ => {}
            }
        }
    }
}

/// Renders the frames that the clock asks for, and stills. Past the end of the clock it goes on with stills: it returns
/// only with an error.
fn render(args: &Args, shared: &Mutex<Shared>, window: &Thread) -> Result<(), Vec<u8>> {
    let (mut renderer, mut frame) = capture::open(args)?;
    let mut governor = Governor::new();
    let mut last = None;
    loop {
        let (now, rests, still) = {
            let mut shared = lock(shared);
            let (now, still) = (shared.clock.now(), shared.still.take());
            shared.saving = still.is_some();
            if now.is_none() {
                shared.ended = Some(Ok(()));
            }
            (now, shared.clock.rests(), still)
        };
        if let Some(still) = still {
            // Exactly the time that is in its name, which has milliseconds.
            let still = (still * 1000.0 + 0.5).floor() / 1000.0;
            draw(args, &mut renderer, still, WHOLE, &mut frame);
            if let Err(why) = capture::save_still(args.scene(), still, &frame) {
                complain(&why);
            }
            continue;
        }
        let (Some(time), true) = (now, now != last) else {
            thread::park_timeout(POLL);
            continue;
        };
        let began = Instant::now();
        // A picture that does not move is worth waiting for at the whole size.
        let step = if rests { WHOLE } else { governor.step };
        draw(args, &mut renderer, time, step, &mut frame);
        if args.governed && !rests && !cfg!(without = "governor") {
            governor.record(began.elapsed().as_secs_f64() * args.fps);
        }
        last = Some(time);
        let mut shared = lock(shared);
        swap(&mut shared.frame, &mut frame);
        shared.time = time;
        shared.fresh = true;
        drop(shared);
        window.unpark();
        // Threads that have drawn wake this one, so a single wait may end at once.
        while let Some(rest) = PERIOD.checked_sub(began.elapsed()) {
            thread::park_timeout(rest);
        }
    }
}

/// Draws an instant of the scene at a size of the governor's.
fn draw(args: &Args, renderer: &mut Renderer, time: f64, step: usize, frame: &mut Frame) {
    let ((width, height), eighths) = (args.size, EIGHTHS[step]);
    (frame.width, frame.height) = (width * eighths / 8, height * eighths / 8);
    // There is memory for the whole size.
    frame.pixels.resize(frame.width * frame.height, 0);
    renderer.render_with(args.scene(), time, &args.options, frame);
}

/// Locks what is shared. This cannot fail: a panic in the other thread would have ended the process.
fn lock(shared: &Mutex<Shared>) -> MutexGuard<'_, Shared> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
