//! minifb's window; the only file that names minifb.
//!
//! Each call into minifb may wait for the display or lose it, and then Xlib waits for ever or ends the process. So
//! every call is watched (`patience.rs`, `xlib_exit.rs`), Esc is heard meanwhile (`ears.rs`), and what minifb cannot
//! survive is looked for first (`beforehand.rs`). Of a window that is too large minifb does not hear (`raw.rs`): frames
//! are put into it without minifb (`beside.rs`).

use super::common::{TITLE, keysym};
#[cfg(all(unix, not(feature = "wayland")))]
use super::{beforehand, beside::Beside, ears};
#[cfg(unix)]
use super::{patience, xlib_exit};
#[cfg(all(unix, not(target_os = "macos"), feature = "x11"))]
use crate::raw;
use minifb::{InputCallback, Key, ScaleMode, WindowOptions};
use paprsek::frame::Frame;
use std::cell::RefCell;
use std::rc::Rc;

/// An open window.
pub struct Window {
    window: minifb::Window,
    keys: Keys,
    /// A connection of our own to the X server, once it is needed.
    #[cfg(all(unix, not(feature = "wayland")))]
    beside: Option<Beside>,
    /// Width and height where the window does not fill the screen, pixels.
    #[cfg(all(unix, not(feature = "wayland")))]
    usual: (usize, usize),
}

impl Window {
    /// Opens a window of `size`, width and height in pixels. The error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        #[cfg(all(unix, not(feature = "wayland")))]
        let is_near = beforehand::check()?;
        #[cfg(feature = "wayland")]
        let is_near = false;
        #[cfg(unix)]
        patience::begin().map_err(|error| error.to_string())?;
        let options =
            WindowOptions { resize: true, scale_mode: ScaleMode::AspectRatioStretch, ..WindowOptions::default() };
        let mut window =
            during(|| minifb::Window::new(TITLE, size.0, size.1, options)).map_err(|error| error.to_string())?;
        // Where frames are put into a large window without minifb, its picture is not kept.
        #[cfg(all(unix, not(target_os = "macos"), feature = "x11"))]
        during(|| raw::bound(&window, if is_near { 1 } else { raw::LARGEST }));
        during(|| window.set_cursor_visibility(false));
        // The renderer keeps the pace; minifb would sleep a second time.
        window.set_target_fps(0);
        let keys = Keys::default();
        window.set_input_callback(Box::new(keys.clone()));
        #[cfg(all(unix, not(feature = "wayland")))]
        ears::listen(window.get_window_handle() as usize as u32);
        Ok(Window {
            window,
            keys,
            #[cfg(all(unix, not(feature = "wayland")))]
            beside: None,
            #[cfg(all(unix, not(feature = "wayland")))]
            usual: size,
        })
    }

    /// Shows a frame, as large as it fits into the window at its own aspect.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        #[cfg(all(unix, not(target_os = "macos"), feature = "x11", not(feature = "wayland")))]
        if let Some(size) = raw::too_large() {
            if let Some(beside) = self.beside() {
                return beside.show(frame, size).ok_or_else(|| "the display went away".into());
            }
        } else if let Some(beside) = &mut self.beside {
            beside.forget();
        }
        during(|| self.window.update_with_buffer(&frame.pixels, frame.width, frame.height))
            .map_err(|error| error.to_string())
    }

    /// Fills the screen, or goes back to the usual size. minifb cannot, but an X server of this machine lets any client
    /// ask for it.
    #[cfg(all(unix, not(feature = "wayland")))]
    pub fn toggle_fullscreen(&mut self) {
        let usual = self.usual;
        if let Some(beside) = self.beside() {
            beside.toggle_fullscreen(usual);
        }
    }

    /// The connection of our own, where there can be one.
    #[cfg(all(unix, not(feature = "wayland")))]
    fn beside(&mut self) -> Option<&mut Beside> {
        self.beside = self.beside.take().or_else(|| Beside::open(self.window.get_window_handle() as usize as u32));
        self.beside.as_mut()
    }

    /// Elsewhere windows cannot fill the screen.
    #[cfg(any(not(unix), feature = "wayland"))]
    pub fn toggle_fullscreen(&mut self) {}

    /// Closes the window.
    pub fn close(self) {
        during(|| drop(self.window));
    }

    /// The next key that has gone down, as a [`keysym`]; `None` when there are no more.
    pub fn next_key(&mut self) -> Option<u32> {
        if self.keys.0.borrow().pressed.is_empty() {
            during(|| self.window.update());
        }
        if !self.window.is_open() {
            return Some(keysym::ESCAPE);
        }
        // minifb may hear it later.
        #[cfg(all(unix, not(feature = "wayland")))]
        if patience::is_leaving() {
            return Some(keysym::ESCAPE);
        }
        let mut keys = self.keys.0.borrow_mut();
        (!keys.pressed.is_empty()).then(|| keys.pressed.remove(0))
    }
}

/// Makes calls that may wait for the display, or lose it.
#[cfg(unix)]
fn during<T>(call: impl FnOnce() -> T) -> T {
    patience::during(|| xlib_exit::during(call))
}

/// Elsewhere a lost display does not end the process.
#[cfg(not(unix))]
fn during<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// Hears the keys. minifb's own state loses a key that goes down and up between two polls.
#[derive(Clone, Default)]
struct Keys(Rc<RefCell<KeyState>>);

#[derive(Default)]
struct KeyState {
    /// The symbols of keys that wait for [`Window::next_key`].
    pressed: Vec<u32>,
    /// The key that is down, if any.
    held: Option<Key>,
}

impl InputCallback for Keys {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        let KeyState { pressed, held } = &mut *self.0.borrow_mut();
        let repeated = *held == Some(key);
        if down {
            *held = Some(key);
        } else if repeated {
            *held = None;
        }
        let symbol = match key {
            Key::Escape => keysym::ESCAPE,
            Key::Space => keysym::SPACE,
            Key::Left => keysym::LEFT,
            Key::Right => keysym::RIGHT,
            Key::F => keysym::F,
            Key::S => keysym::S,
            // Consecutive in minifb too.
            Key::Key1
            | Key::Key2
            | Key::Key3
            | Key::Key4
            | Key::Key5
            | Key::Key6
            | Key::Key7
            | Key::Key8
            | Key::Key9 => keysym::DIGIT_1 + key as u32 - Key::Key1 as u32,
            _ => return,
        };
        // A held key repeats, which only seeking wants.
        if down && (!repeated || matches!(symbol, keysym::LEFT | keysym::RIGHT)) {
            pressed.push(symbol);
        }
    }
}
