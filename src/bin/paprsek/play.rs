//! Plays in a window.
//!
//! The window lives on the main thread and the renderer on one of its own, which is a worker of the renderer. So
//! Esc ends at once however long a frame takes, and a frame is sent to the display while the next one renders.

use crate::args::Args;
use crate::canvas;
use crate::capture;
use crate::clock::Clock;
use crate::governor::{EIGHTHS, Governor};
use crate::io::complain;
use crate::window::{BACK, FILL, FIRST_PART, FORWARD, LAST_PART, LEAVE, PAUSE, STILL, Window};
use paprsek::frame::pool::start;
use paprsek::frame::{Frame, Renderer};
use std::mem::{swap, take};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

/// Time from frame to frame at the least: 60 a second, what most displays show. A faster scene rests.
const PERIOD: Duration = Duration::from_nanos(16_666_667);
/// How long the keys may wait for a frame.
const POLL: Duration = Duration::from_millis(10);
/// A still is sent again after so many looks at the keys, a fifth of a second: the display forgets what another window
/// covers.
const REFRESH: usize = 20;
/// Seconds that an arrow key moves.
const SEEK: f64 = 5.0;
/// Parts of the width that a light has come by each [`REFRESH`] until there is a first frame, and how bright it is.
const STEPS: usize = 16;
const GREY: u32 = 0x404040;

/// What the two threads pass each other: three frames go round, so neither waits for the other.
struct Desk {
    clock: Clock,
    /// The latest finished frame and its scene time, until `fresh` is taken.
    frame: Frame,
    time: f64,
    fresh: bool,
    /// The scene time of a still that has been asked for, until it is taken up; is one being saved?
    still: Option<f64>,
    saving: bool,
    /// There are no more frames: the end of the range, or an error.
    ended: Option<Result<(), Vec<u8>>>,
    /// After an error, no more stills either.
    failed: bool,
}

/// Plays until Esc, until the window is closed or until the range ends.
pub fn play(mut window: Window, args: &'static Args) -> Result<(), Vec<u8>> {
    let frame = canvas::frame(args.size)?;
    let back = canvas::frame(args.size)?;
    let clock = Clock::new(args);
    let desk =
        Desk { clock, frame: back, time: 0.0, fresh: false, still: None, saving: false, ended: None, failed: false };
    // Kept for good: when the window goes, the process goes, in the middle of a frame if need be.
    let desk: &Mutex<Desk> = Box::leak(Box::new(Mutex::new(desk)));
    let here = thread::current();
    let render = move || {
        let ended = render(args, desk, &here);
        let mut desk = lock(desk);
        desk.failed = true;
        desk.ended = Some(ended);
    };
    start(Box::leak(Box::new(render))).ok_or("cannot start threads")?;
    if args.full && !cfg!(without = "fullscreen") {
        window.fill();
    }
    let ended = watch(window, frame, desk);
    // The window is gone at once; a still that has been asked for is saved.
    while {
        let desk = lock(desk);
        !desk.failed && (desk.saving || desk.still.is_some())
    } {
        thread::park_timeout(POLL);
    }
    ended
}

/// Shows frames and hears keys, until the end.
fn watch(mut window: Window, mut frame: Frame, desk: &Mutex<Desk>) -> Result<(), Vec<u8>> {
    // The time of the frame that is shown, and how often the keys have been looked at since.
    let (mut time, mut looks) = (None, 0);
    loop {
        let fresh = {
            thread::park_timeout(POLL);
            let mut desk = lock(desk);
            let fresh = take(&mut desk.fresh);
            if fresh {
                swap(&mut desk.frame, &mut frame);
                time = Some(desk.time);
            } else if let Some(ended) = desk.ended.take() {
                // The last frame has been shown.
                return ended;
            }
            fresh
        };
        looks = if fresh { 0 } else { looks + 1 };
        if looks % REFRESH == 0 {
            if time.is_none() {
                // What is made before the first frame takes its time: a light runs along the middle.
                let width = frame.width;
                let line = &mut frame.pixels[width * (frame.height / 2)..][..width];
                line.fill(0);
                line[width * (looks / REFRESH % STEPS) / STEPS..][..width.div_ceil(STEPS)].fill(GREY);
            }
            window.show(&frame)?;
        }
        while let Some(symbol) = window.press() {
            let mut desk = lock(desk);
            match symbol {
                LEAVE => return Ok(()),
                PAUSE => desk.clock.toggle(),
                BACK => desk.clock.seek(-SEEK),
                FORWARD => desk.clock.seek(SEEK),
                FILL if !cfg!(without = "fullscreen") => window.fill(),
                STILL if !cfg!(without = "stills") => desk.still = time,
                FIRST_PART..=LAST_PART => desk.clock.jump((symbol - FIRST_PART) as usize),
                _ => {}
            }
        }
    }
}

/// Renders what the clock says, and stills, also when it says nothing any more; ends with an error alone.
fn render(args: &Args, desk: &Mutex<Desk>, window: &Thread) -> Result<(), Vec<u8>> {
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let mut governor = Governor::new();
    let mut last = None;
    loop {
        let (now, rests, still) = {
            let mut desk = lock(desk);
            let (now, still) = (desk.clock.now(), desk.still.take());
            desk.saving = still.is_some();
            if now.is_none() {
                desk.ended = Some(Ok(()));
            }
            (now, desk.clock.rests(), still)
        };
        if let Some(still) = still {
            // Of the time that its name tells.
            let still = (still * 1000.0 + 0.5).floor() / 1000.0;
            draw(args, &mut renderer, still, 0, &mut frame);
            if let Err(why) = capture::still(args.scene(), still, &frame) {
                complain(&why);
            }
            continue;
        }
        let (Some(time), true) = (now, now != last) else {
            thread::park_timeout(POLL);
            continue;
        };
        let began = Instant::now();
        // What does not move can be waited for.
        let step = if rests { 0 } else { governor.step };
        draw(args, &mut renderer, time, step, &mut frame);
        if args.governed && !rests && !cfg!(without = "governor") {
            governor.frame(began.elapsed().as_secs_f64() * args.fps);
        }
        last = Some(time);
        let mut shared = lock(desk);
        swap(&mut shared.frame, &mut frame);
        shared.time = time;
        shared.fresh = true;
        drop(shared);
        window.unpark();
        // Threads that have drawn wake this one, so a single rest may end at once.
        while let Some(rest) = PERIOD.checked_sub(began.elapsed()) {
            thread::park_timeout(rest);
        }
    }
}

/// Draws an instant of the scene at that step of the governor's.
fn draw(args: &Args, renderer: &mut Renderer, time: f64, step: usize, frame: &mut Frame) {
    let ((width, height), eighths) = (args.size, EIGHTHS[step]);
    (frame.width, frame.height) = (width * eighths / 8, height * eighths / 8);
    // There is memory for the whole.
    frame.pixels.resize(frame.width * frame.height, 0);
    renderer.render_with(args.scene(), time, &args.options, frame);
}

/// A panic elsewhere has ended the process already; the lock itself cannot fail.
fn lock(desk: &Mutex<Desk>) -> MutexGuard<'_, Desk> {
    desk.lock().unwrap_or_else(PoisonError::into_inner)
}
