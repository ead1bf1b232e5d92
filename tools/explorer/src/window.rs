//! minifb's window: pixels out, keys and the mouse in. The only file that opens it.

use crate::args::LEAST;
use crate::clicks::Clicks;
use crate::patience::{begin, during};
use minifb::{InputCallback, Key, MouseButton, MouseMode, ScaleMode, WindowOptions};
use std::cell::RefCell;
use std::rc::Rc;

/// What has happened since the last look.
#[derive(Default)]
pub struct Events {
    /// Keys that went down or up, in order. A held key goes down again and again.
    pub keys: Vec<(Key, bool)>,
    /// Characters that were typed.
    pub text: String,
    /// Where the mouse is, pixels of the picture; none outside of the window.
    pub mouse: Option<(f32, f32)>,
    /// Whether the left and the right button are down.
    pub buttons: [bool; 2],
    /// Clicks of these that were over between two looks.
    pub clicks: [u8; 2],
    /// Notches of the wheel, up positive.
    pub wheel: f32,
    /// Whether the window has the keyboard.
    pub active: bool,
    /// Whether the window was closed.
    pub closed: bool,
    /// Whether the display has gone.
    pub gone: bool,
}

/// An open window.
pub struct Window {
    window: minifb::Window,
    heard: Heard,
    clicks: Option<Clicks>,
}

impl Window {
    /// Opens a window, width and height in pixels.
    pub fn open((width, height): (usize, usize)) -> Result<Window, String> {
        begin()?;
        let options = WindowOptions { resize: true, scale_mode: ScaleMode::Stretch, ..WindowOptions::default() };
        let opened = during(|| minifb::Window::new("Paprsek explorer", width, height, options));
        let mut window = opened.map_err(|error| error.to_string())?;
        // The caller keeps the pace.
        window.set_target_fps(0);
        let heard = Heard::default();
        window.set_input_callback(Box::new(heard.clone()));
        // X's windows have numbers of 29 bits.
        let clicks = during(|| Clicks::over(window.get_window_handle() as usize as u32));
        Ok(Window { window, heard, clicks })
    }

    /// Width and height of the picture that fits: the window's, or the least where that is smaller.
    pub fn size(&self) -> (usize, usize) {
        let (width, height) = self.window.get_size();
        (width.max(LEAST.0), height.max(LEAST.1))
    }

    /// Shows a picture.
    pub fn show(&mut self, pixels: &[u32], (width, height): (usize, usize)) -> Result<(), String> {
        during(|| self.window.update_with_buffer(pixels, width, height)).map_err(|error| error.to_string())
    }

    /// Looks for events without showing anything.
    pub fn look(&mut self) {
        during(|| self.window.update());
    }

    /// What has happened.
    pub fn events(&mut self) -> Events {
        let (keys, text) = {
            let mut heard = self.heard.0.borrow_mut();
            (std::mem::take(&mut heard.keys), std::mem::take(&mut heard.text))
        };
        let (window, (width, height)) = (self.window.get_size(), self.size());
        let scale = (width as f32 / window.0.max(1) as f32, height as f32 / window.1.max(1) as f32);
        let mouse = self.window.get_unscaled_mouse_pos(MouseMode::Pass);
        let buttons = [MouseButton::Left, MouseButton::Right].map(|button| self.window.get_mouse_down(button));
        let clicks = self.clicks.as_mut().map_or([0; 2], |clicks| during(|| clicks.missed(buttons)));
        Events {
            keys,
            text,
            mouse: mouse.map(|(x, y)| (x * scale.0, y * scale.1)),
            buttons,
            clicks,
            wheel: self.window.get_scroll_wheel().map_or(0.0, |wheel| wheel.1),
            active: self.window.is_active(),
            closed: !self.window.is_open(),
            gone: self.clicks.as_ref().is_some_and(|clicks| clicks.gone),
        }
    }
}

/// Hears the keys. minifb's own state loses a key that goes down and up between two looks.
#[derive(Clone, Default)]
struct Heard(Rc<RefCell<Log>>);

#[derive(Default)]
struct Log {
    keys: Vec<(Key, bool)>,
    text: String,
}

impl InputCallback for Heard {
    fn add_char(&mut self, code: u32) {
        let typed = char::from_u32(code).filter(|typed| !typed.is_control());
        self.0.borrow_mut().text.extend(typed);
    }

    fn set_key_state(&mut self, key: Key, down: bool) {
        self.0.borrow_mut().keys.push((key, down));
    }
}
