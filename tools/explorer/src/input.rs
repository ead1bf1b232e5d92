//! From the window's events to egui's, and to the keys that are held down.

use crate::window::Events;
use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};
use minifb::Key;
use std::collections::BTreeSet;

/// Points that a notch of the wheel scrolls.
const NOTCH: f32 = 40.0;

/// A key that went down.
#[derive(Clone, Copy, Debug)]
pub struct Pressed {
    /// The key.
    pub key: Key,
    /// Whether it was down already.
    pub repeated: bool,
    /// Whether Shift was down then.
    pub shift: bool,
    /// Whether Ctrl was down then.
    pub ctrl: bool,
}

/// What the mouse and the keyboard are doing.
#[derive(Default)]
pub struct Input {
    held: BTreeSet<u8>,
    buttons: [bool; 2],
    /// Clicks that were over between two looks and are still to be told, and whether one is down.
    clicks: [u8; 2],
    clicked: [bool; 2],
    mouse: Option<(f32, f32)>,
    /// How far the mouse went since the last look, pixels.
    pub moved: (f32, f32),
    /// Whether the window has the keyboard.
    pub active: bool,
}

impl Input {
    /// Whether a key is down.
    pub fn held(&self, key: Key) -> bool {
        self.held.contains(&(key as u8))
    }

    /// Whether either key of a pair is down.
    pub fn shift(&self) -> bool {
        self.held(Key::LeftShift) || self.held(Key::RightShift)
    }

    /// Whether a control key is down.
    pub fn ctrl(&self) -> bool {
        self.held(Key::LeftCtrl) || self.held(Key::RightCtrl)
    }

    /// Where the mouse is, pixels.
    pub fn mouse(&self) -> Option<(f32, f32)> {
        self.mouse
    }

    /// Whether the left and the right button are down.
    pub fn buttons(&self) -> [bool; 2] {
        self.buttons
    }

    /// Takes the window's events. Gives egui's, and the keys that went down.
    pub fn take(&mut self, events: &Events, size: (usize, usize), scale: f32, time: f64) -> (RawInput, Vec<Pressed>) {
        let mut out = Vec::new();
        let mut pressed = Vec::new();
        if self.active && !events.active {
            // Nobody will tell when the keys go up.
            self.held.clear();
            out.push(Event::PointerGone);
        }
        self.active = events.active;
        for &(key, down) in &events.keys {
            let repeated = if down { !self.held.insert(key as u8) } else { !self.held.remove(&(key as u8)) };
            if down {
                // Shift may be up again before anybody looks.
                pressed.push(Pressed { key, repeated, shift: self.shift(), ctrl: self.ctrl() });
            }
            if let Some(key) = named(key) {
                let modifiers = self.modifiers();
                out.push(Event::Key { key, physical_key: None, pressed: down, repeat: repeated, modifiers });
            }
        }
        if !events.text.is_empty() && !self.ctrl() {
            out.push(Event::Text(events.text.clone()));
        }
        let at = |(x, y): (f32, f32)| pos2(x / scale, y / scale);
        self.moved = match (self.mouse, events.mouse) {
            (Some(old), Some(new)) => (new.0 - old.0, new.1 - old.1),
            _ => (0.0, 0.0),
        };
        if events.mouse != self.mouse {
            out.push(events.mouse.map_or(Event::PointerGone, |mouse| Event::PointerMoved(at(mouse))));
            self.mouse = events.mouse;
        }
        let pos = self.mouse.map_or(Pos2::ZERO, at);
        for (place, button) in [PointerButton::Primary, PointerButton::Secondary].into_iter().enumerate() {
            let pressed = events.buttons[place];
            if pressed != self.buttons[place] {
                out.push(Event::PointerButton { pos, button, pressed, modifiers: self.modifiers() });
            }
        }
        self.buttons = events.buttons;
        for (place, button) in [PointerButton::Primary, PointerButton::Secondary].into_iter().enumerate() {
            self.clicks[place] += events.clicks[place];
            // Down in one picture and up in the next: sliders want to be seen held.
            let was = std::mem::take(&mut self.clicked[place]);
            if was || self.clicks[place] > 0 {
                self.clicked[place] = !was;
                self.clicks[place] -= u8::from(!was);
                out.push(Event::PointerButton { pos, button, pressed: !was, modifiers: self.modifiers() });
            }
        }
        if events.wheel != 0.0 {
            let delta = vec2(0.0, events.wheel.clamp(-8.0, 8.0) * NOTCH);
            let (unit, modifiers) = (egui::MouseWheelUnit::Point, self.modifiers());
            out.push(Event::MouseWheel { unit, delta, modifiers });
        }
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(size.0 as f32 / scale, size.1 as f32 / scale));
        let raw = RawInput {
            screen_rect: Some(screen),
            events: out,
            modifiers: self.modifiers(),
            time: Some(time),
            // A display without a window manager never says that the window has the keyboard.
            focused: true,
            ..RawInput::default()
        };
        (raw, pressed)
    }

    fn modifiers(&self) -> Modifiers {
        Modifiers { shift: self.shift(), ctrl: self.ctrl(), command: self.ctrl(), ..Modifiers::NONE }
    }
}

/// The keys that fields of text and sliders use.
fn named(key: Key) -> Option<egui::Key> {
    Some(match key {
        Key::Left => egui::Key::ArrowLeft,
        Key::Right => egui::Key::ArrowRight,
        Key::Up => egui::Key::ArrowUp,
        Key::Down => egui::Key::ArrowDown,
        Key::Backspace => egui::Key::Backspace,
        Key::Delete => egui::Key::Delete,
        Key::Home => egui::Key::Home,
        Key::End => egui::Key::End,
        Key::Enter | Key::NumPadEnter => egui::Key::Enter,
        Key::Escape => egui::Key::Escape,
        Key::A => egui::Key::A,
        _ => return None,
    })
}
