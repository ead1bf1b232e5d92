//! Plays in a window.
//!
//! The window lives on the main thread and the renderer on one of its own, which is a worker of the renderer. So
//! Esc ends at once however long a frame takes, and a frame is sent to the display while the next one renders.

use crate::args::Args;
use crate::canvas;
use crate::clock::Clock;
use crate::window::{Press, Window};
use paprsek::tile::{Frame, Renderer};
use std::mem::{swap, take};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time from frame to frame at the least: 60 a second, what most displays show. A faster scene rests.
const PERIOD: Duration = Duration::from_nanos(16_666_667);
/// How long the keys may wait for a frame.
const POLL: Duration = Duration::from_millis(10);
/// A still is sent again this often: the display forgets what another window covers.
const REFRESH: Duration = Duration::from_millis(200);
/// Stack of the renderer's thread, bytes: the standard size. Said here, it is not looked for in the environment.
const STACK: usize = 2 << 20;
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

type Shared = (Mutex<Desk>, Condvar);

/// Plays until Esc, until the window is closed or until the range ends.
pub fn play(mut window: Window, args: &Args) -> Result<(), String> {
    let mut frame = canvas::frame(args.size)?;
    let desk = Desk { clock: Clock::new(args), frame: canvas::frame(args.size)?, fresh: false, ended: None };
    let shared: Arc<Shared> = Arc::new((Mutex::new(desk), Condvar::new()));
    let (theirs, scene, quality, stereo) = (shared.clone(), args.scene(), args.quality, args.stereo);
    let (threads, back) = (args.threads, canvas::frame(args.size)?);
    let render = move || {
        let ended = Renderer::new(threads).map(|renderer| {
            render(renderer, back, &theirs, |renderer, time, frame| {
                renderer.render_eyes(&scene, time, &quality, stereo, frame);
            });
        });
        lock(&theirs).ended = Some(ended);
    };
    // Never joined: when the window goes, the process goes, in the middle of a frame if need be.
    thread::Builder::new().stack_size(STACK).spawn(render).map_err(|error| format!("cannot start threads: {error}"))?;

    let mut shown: Option<Instant> = None;
    loop {
        let fresh = {
            let mut desk = lock(&shared);
            if !desk.fresh {
                desk = shared.1.wait_timeout(desk, POLL).unwrap_or_else(PoisonError::into_inner).0;
            }
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
                Press::Pause => lock(&shared).clock.toggle(),
                Press::Back => lock(&shared).clock.seek(-SEEK),
                Press::Forward => lock(&shared).clock.seek(SEEK),
            }
        }
    }
}

/// Renders what the clock says, until it says nothing any more.
fn render(mut renderer: Renderer, mut frame: Frame, shared: &Shared, draw: impl Fn(&mut Renderer, f64, &mut Frame)) {
    let mut last = None;
    let mut due = Instant::now();
    loop {
        let Some(time) = lock(shared).clock.now() else { return };
        if last == Some(time) {
            thread::sleep(POLL);
            continue;
        }
        draw(&mut renderer, time, &mut frame);
        last = Some(time);
        let mut desk = lock(shared);
        swap(&mut desk.frame, &mut frame);
        desk.fresh = true;
        drop(desk);
        shared.1.notify_one();
        // Late frames are not made up for: the next one is due a period after this one came.
        due = Instant::now().max(due + PERIOD);
        thread::sleep(due.saturating_duration_since(Instant::now()));
    }
}

/// A panic elsewhere has ended the process already; the lock itself cannot fail.
fn lock(shared: &Shared) -> MutexGuard<'_, Desk> {
    shared.0.lock().unwrap_or_else(PoisonError::into_inner)
}
