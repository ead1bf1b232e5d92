//! minifb's window: the only file that names minifb.

use super::{Press, TITLE};
#[cfg(unix)]
use crate::last_word::during;
use minifb::{InputCallback, Key, ScaleMode, WindowOptions};
use paprsek::tile::Frame;
use std::cell::RefCell;
use std::mem::replace;
use std::rc::Rc;

/// An open window.
pub struct Window {
    window: minifb::Window,
    keys: Keys,
}

impl Window {
    /// Opens a window of `size`, in pixels; the error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        let options =
            WindowOptions { resize: true, scale_mode: ScaleMode::AspectRatioStretch, ..WindowOptions::default() };
        let mut window =
            during(|| minifb::Window::new(TITLE, size.0, size.1, options)).map_err(|error| error.to_string())?;
        window.set_cursor_visibility(false);
        // The renderer keeps the pace; minifb would sleep a second time.
        window.set_target_fps(0);
        let keys = Keys::default();
        window.set_input_callback(Box::new(keys.clone()));
        Ok(Window { window, keys })
    }

    /// Shows a frame, as large as it fits.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        during(|| self.window.update_with_buffer(&frame.pixels, frame.width, frame.height))
            .map_err(|error| error.to_string())
    }

    /// What has been asked for since the last call, one at a time; `None` when that was all.
    pub fn press(&mut self) -> Option<Press> {
        if self.keys.0.borrow().0.is_empty() {
            during(|| self.window.update());
        }
        if !self.window.is_open() {
            return Some(Press::Leave);
        }
        let mut keys = self.keys.0.borrow_mut();
        (!keys.0.is_empty()).then(|| keys.0.remove(0))
    }
}

/// Elsewhere a lost display does not end the process.
#[cfg(not(unix))]
fn during<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// Keys as they go down, and whether Space is. minifb's own state loses a key that goes down and up between two polls.
#[derive(Clone, Default)]
struct Keys(Rc<RefCell<(Vec<Press>, bool)>>);

impl InputCallback for Keys {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        let (pressed, space) = &mut *self.0.borrow_mut();
        // Held keys repeat: right for seeking, not for the pause.
        let repeated = key == Key::Space && replace(space, down);
        let press = match key {
            Key::Escape => Press::Leave,
            Key::Space => Press::Pause,
            Key::Left => Press::Back,
            Key::Right => Press::Forward,
            _ => return,
        };
        if down && !repeated {
            pressed.push(press);
        }
    }
}
