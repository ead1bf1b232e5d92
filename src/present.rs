//! The window: the only file that names minifb.
//!
//! The window lives on the main thread and the renderer on one of its own, which is a worker of the renderer. So
//! Esc ends at once however long a frame takes, and a frame is sent to the display while the next one renders.

use crate::args::Args;
use crate::canvas;
use crate::clock::Clock;
#[cfg(unix)]
use crate::last_word::during;
use minifb::{InputCallback, Key, ScaleMode, Window, WindowOptions};
use paprsek::tile::{Frame, Renderer};
use std::cell::RefCell;
use std::mem::{replace, swap, take};
use std::rc::Rc;
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

/// An open window.
pub struct Screen {
    window: Window,
    keys: Keys,
}

impl Screen {
    /// Opens a window of the render size; the error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Screen, String> {
        let options =
            WindowOptions { resize: true, scale_mode: ScaleMode::AspectRatioStretch, ..WindowOptions::default() };
        let mut window =
            during(|| Window::new("Paprsek", size.0, size.1, options)).map_err(|error| error.to_string())?;
        window.set_cursor_visibility(false);
        // The renderer keeps the pace; minifb would sleep a second time.
        window.set_target_fps(0);
        let keys = Keys::default();
        window.set_input_callback(Box::new(keys.clone()));
        Ok(Screen { window, keys })
    }

    /// Plays until Esc, until the window is closed or until the range ends.
    pub fn play(mut self, args: &Args) -> Result<(), String> {
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
        thread::Builder::new()
            .stack_size(STACK)
            .spawn(render)
            .map_err(|error| format!("cannot start threads: {error}"))?;

        let mut shown: Option<Instant> = None;
        while self.window.is_open() {
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
                during(|| self.window.update_with_buffer(&frame.pixels, frame.width, frame.height))
                    .map_err(|error| error.to_string())?;
                shown = Some(Instant::now());
            } else {
                during(|| self.window.update());
            }
            for key in self.keys.take() {
                match key {
                    Key::Escape => return Ok(()),
                    Key::Space => lock(&shared).clock.toggle(),
                    Key::Left => lock(&shared).clock.seek(-SEEK),
                    Key::Right => lock(&shared).clock.seek(SEEK),
                    _ => {}
                }
            }
        }
        Ok(())
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

/// Elsewhere a lost display does not end the process.
#[cfg(not(unix))]
fn during<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// A panic elsewhere has ended the process already; the lock itself cannot fail.
fn lock(shared: &Shared) -> MutexGuard<'_, Desk> {
    shared.0.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keys as they go down. minifb's own state loses a key that goes down and up between two polls.
#[derive(Clone, Default)]
struct Keys(Rc<RefCell<(Vec<Key>, bool)>>);

impl Keys {
    fn take(&self) -> Vec<Key> {
        take(&mut self.0.borrow_mut().0)
    }
}

impl InputCallback for Keys {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        let (pressed, space) = &mut *self.0.borrow_mut();
        // Held keys repeat: right for seeking, not for the pause.
        let repeated = key == Key::Space && replace(space, down);
        if down && !repeated {
            pressed.push(key);
        }
    }
}
