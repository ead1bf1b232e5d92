//! Plays in a window.
//!
//! The window lives on the main thread and the renderer on one of its own, which is a worker of the renderer. So
//! Esc ends at once however long a frame takes, and a frame is sent to the display while the next one renders.

use crate::args::Args;
use crate::canvas;
use crate::clock::Clock;
use crate::window::{Press, Window};
use paprsek::pool::start;
use paprsek::tile::{Frame, Renderer};
use std::mem::{swap, take};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

/// Time from frame to frame at the least: 60 a second, what most displays show. A faster scene rests.
const PERIOD: Duration = Duration::from_nanos(16_666_667);
/// How long the keys may wait for a frame.
const POLL: Duration = Duration::from_millis(10);
/// A still is sent again this often: the display forgets what another window covers.
const REFRESH: Duration = Duration::from_millis(200);
/// Seconds that an arrow key moves.
const SEEK: f64 = 5.0;

/// What the two threads pass each other: three frames go round, so neither waits for the other.
struct Desk {
    clock: Clock,
    /// The latest finished frame, until `fresh` is taken.
    frame: Frame,
    fresh: bool,
    /// The renderer is at work no more: the end of the range, or an error.
    ended: Option<Result<(), String>>,
}

/// Plays until Esc, until the window is closed or until the range ends.
pub fn play(mut window: Window, args: &Args) -> Result<(), String> {
    let (size, scene, quality, stereo, threads) = (args.size, args.scene(), args.quality, args.stereo, args.threads);
    let mut frame = canvas::frame(size)?;
    let desk = Desk { clock: Clock::new(args), frame: canvas::frame(size)?, fresh: false, ended: None };
    // Kept for good: when the window goes, the process goes, in the middle of a frame if need be.
    let desk: &Mutex<Desk> = Box::leak(Box::new(Mutex::new(desk)));
    let here = thread::current();
    let render = move || {
        let run = || {
            let (renderer, back) = (Renderer::new(threads)?, canvas::frame(size)?);
            render(renderer, back, desk, &here, |renderer, time, frame| {
                renderer.render_eyes(scene, time, &quality, stereo, frame);
            });
            Ok(())
        };
        let ended = run();
        lock(desk).ended = Some(ended);
    };
    start(Box::leak(Box::new(render))).ok_or("cannot start threads")?;

    let mut shown: Option<Instant> = None;
    loop {
        let fresh = {
            thread::park_timeout(POLL);
            let mut desk = lock(desk);
            let fresh = take(&mut desk.fresh);
            if fresh {
                swap(&mut desk.frame, &mut frame);
            } else if let Some(ended) = desk.ended.take() {
                // The last frame has been shown.
                return ended;
            }
            fresh
        };
        if fresh || shown.is_some_and(|shown| shown.elapsed() >= REFRESH) {
            window.show(&frame)?;
            shown = Some(Instant::now());
        }
        while let Some(press) = window.press() {
            match press {
                Press::Leave => return Ok(()),
                Press::Pause => lock(desk).clock.toggle(),
                Press::Back => lock(desk).clock.seek(-SEEK),
                Press::Forward => lock(desk).clock.seek(SEEK),
            }
        }
    }
}

/// Renders what the clock says, until it says nothing any more.
fn render(
    mut renderer: Renderer,
    mut frame: Frame,
    desk: &Mutex<Desk>,
    window: &Thread,
    draw: impl Fn(&mut Renderer, f64, &mut Frame),
) {
    let mut last = None;
    loop {
        let began = Instant::now();
        let Some(time) = lock(desk).clock.now() else { return };
        if last == Some(time) {
            thread::sleep(POLL);
            continue;
        }
        draw(&mut renderer, time, &mut frame);
        last = Some(time);
        let mut shared = lock(desk);
        swap(&mut shared.frame, &mut frame);
        shared.fresh = true;
        drop(shared);
        window.unpark();
        thread::sleep(PERIOD.saturating_sub(began.elapsed()));
    }
}

/// A panic elsewhere has ended the process already; the lock itself cannot fail.
fn lock(desk: &Mutex<Desk>) -> MutexGuard<'_, Desk> {
    desk.lock().unwrap_or_else(PoisonError::into_inner)
}
