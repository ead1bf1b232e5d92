//! minifb's window: the only file that names minifb.

#[cfg(all(unix, not(feature = "wayland")))]
use super::beforehand;
#[cfg(unix)]
use super::patience;
#[cfg(all(unix, not(feature = "wayland")))]
use super::protocol::Server;
use super::{BACK, FILL, FIRST_PART, FORWARD, LEAVE, PAUSE, STILL, TITLE};
#[cfg(unix)]
use crate::window::xlib_exit;
use minifb::{InputCallback, Key, ScaleMode, WindowOptions};
use paprsek::frame::Frame;
use std::cell::RefCell;
use std::rc::Rc;

/// An open window.
pub struct Window {
    window: minifb::Window,
    keys: Keys,
    /// Our own connection to the X server, once it is needed; width and height where it does not fill the screen, pixels.
    #[cfg(all(unix, not(feature = "wayland")))]
    screen: (Option<Server>, (usize, usize)),
}

impl Window {
    /// Opens a window of `size`, in pixels; the error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        #[cfg(all(unix, not(feature = "wayland")))]
        beforehand::look()?;
        #[cfg(unix)]
        patience::begin().map_err(|error| error.to_string())?;
        let options =
            WindowOptions { resize: true, scale_mode: ScaleMode::AspectRatioStretch, ..WindowOptions::default() };
        let mut window =
            during(|| minifb::Window::new(TITLE, size.0, size.1, options)).map_err(|error| error.to_string())?;
        during(|| window.set_cursor_visibility(false));
        // The renderer keeps the pace; minifb would sleep a second time.
        window.set_target_fps(0);
        let keys = Keys::default();
        window.set_input_callback(Box::new(keys.clone()));
        Ok(Window {
            window,
            keys,
            #[cfg(all(unix, not(feature = "wayland")))]
            screen: (None, size),
        })
    }

    /// Shows a frame, as large as it fits.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        during(|| self.window.update_with_buffer(&frame.pixels, frame.width, frame.height))
            .map_err(|error| error.to_string())
    }

    /// Fills the screen, or does so no more: minifb cannot, but the X server of this machine lets any client ask for that.
    #[cfg(all(unix, not(feature = "wayland")))]
    pub fn fill(&mut self) {
        let (server, size) = &mut self.screen;
        *server = server.take().or_else(|| Server::find(&mut ""));
        if let Some(server) = server {
            server.fill(self.window.get_window_handle() as usize as u32, *size);
        }
    }

    /// Elsewhere windows cannot fill the screen.
    #[cfg(any(not(unix), feature = "wayland"))]
    pub fn fill(&mut self) {}

    /// The keys that have gone down since the last call, one at a time; `None` when those were all.
    pub fn press(&mut self) -> Option<u32> {
        if self.keys.0.borrow().0.is_empty() {
            during(|| self.window.update());
        }
        if !self.window.is_open() {
            return Some(LEAVE);
        }
        let mut keys = self.keys.0.borrow_mut();
        (!keys.0.is_empty()).then(|| keys.0.remove(0))
    }
}

/// A call that may wait for the display, or lose it.
#[cfg(unix)]
fn during<T>(call: impl FnOnce() -> T) -> T {
    patience::during(|| xlib_exit::during(call))
}

/// Elsewhere a lost display does not end the process.
#[cfg(not(unix))]
fn during<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// Keys as they go down, and the one that is held. minifb's own state loses a key that goes down and up between two polls.
#[derive(Clone, Default)]
struct Keys(Rc<RefCell<(Vec<u32>, Option<Key>)>>);

impl InputCallback for Keys {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        let (pressed, held) = &mut *self.0.borrow_mut();
        let repeated = *held == Some(key);
        if down {
            *held = Some(key);
        } else if repeated {
            *held = None;
        }
        let symbol = match key {
            Key::Escape => LEAVE,
            Key::Space => PAUSE,
            Key::Left => BACK,
            Key::Right => FORWARD,
            Key::F => FILL,
            Key::S => STILL,
            // minifb has them in a row too.
            Key::Key1
            | Key::Key2
            | Key::Key3
            | Key::Key4
            | Key::Key5
            | Key::Key6
            | Key::Key7
            | Key::Key8
            | Key::Key9 => FIRST_PART + key as u32 - Key::Key1 as u32,
            _ => return,
        };
        // Held keys repeat: right for seeking alone.
        if down && (!repeated || matches!(symbol, BACK | FORWARD)) {
            pressed.push(symbol);
        }
    }
}
