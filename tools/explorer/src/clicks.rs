//! Clicks that are over before anybody looks. minifb keeps the state of the buttons alone: one that has gone down and up
//! between two looks is lost. So a connection of its own hears every press as XInput's raw events, which any number of
//! clients may ask for, and those that minifb has not shown are told as clicks.

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{ConnectionExt as _, Device, EventMask, XIEventMask};
use x11rb::protocol::xproto::{ConnectionExt as _, Window};
use x11rb::rust_connection::RustConnection;

/// X's numbers of the left and the right button.
const BUTTONS: [u32; 2] = [1, 3];
/// Windows within windows down to ours at most.
const DEEPEST: usize = 16;

/// Hears presses over a window.
pub struct Clicks {
    connection: RustConnection,
    root: Window,
    window: Window,
    missed: [Missed; 2],
    /// Whether the X server has gone.
    pub gone: bool,
}

impl Clicks {
    /// Begins to hear; none where there is no X server, or none that knows of raw events.
    pub fn over(window: Window) -> Option<Clicks> {
        let (connection, screen) = x11rb::connect(None).ok()?;
        connection.xinput_xi_query_version(2, 2).ok()?.reply().ok()?;
        let root = connection.setup().roots.get(screen)?.root;
        let mask = EventMask { deviceid: Device::ALL_MASTER.into(), mask: vec![XIEventMask::RAW_BUTTON_PRESS] };
        connection.xinput_xi_select_events(root, &[mask]).ok()?.check().ok()?;
        Some(Clicks { connection, root, window, missed: Default::default(), gone: false })
    }

    /// The clicks that `down`, the state of both buttons now, says nothing of.
    pub fn missed(&mut self, down: [bool; 2]) -> [u8; 2] {
        let mut heard = [0; 2];
        loop {
            let event = match self.connection.poll_for_event() {
                Ok(Some(event)) => event,
                Ok(None) => break,
                Err(_) => {
                    self.gone = true;
                    return [0; 2];
                }
            };
            if let Event::XinputRawButtonPress(press) = event
                && let Some(place) = BUTTONS.iter().position(|button| *button == press.detail)
            {
                heard[place] += 1;
            }
        }
        if heard != [0; 2] && !self.is_under_mouse() {
            heard = [0; 2];
        }
        [0, 1].map(|place| self.missed[place].look(heard[place], down[place]))
    }

    /// Whether the mouse is over the window, with nothing between.
    fn is_under_mouse(&self) -> bool {
        let mut at = self.root;
        for _ in 0..DEEPEST {
            let Some(found) = self.connection.query_pointer(at).ok().and_then(|asked| asked.reply().ok()) else {
                return false;
            };
            if found.child == x11rb::NONE {
                break;
            }
            at = found.child;
        }
        at == self.window
    }
}

/// Presses of a button that were heard and not seen.
#[derive(Default)]
struct Missed {
    /// Presses heard, less those seen.
    open: i8,
    /// Whether it was down at the last look.
    down: bool,
    /// Presses that were open at the last look already: both connections have had the time to tell of them.
    old: i8,
}

impl Missed {
    /// Takes presses heard since the last look, and whether the button is down. Gives the clicks that were missed.
    fn look(&mut self, heard: i8, down: bool) -> u8 {
        self.open = self.open.saturating_add(heard) - i8::from(down && !self.down);
        if self.down && !down {
            // What has not been heard of a press that is over will not be.
            self.open = self.open.max(0);
        }
        self.down = down;
        let clicks = if down { 0 } else { self.old.min(self.open).max(0) };
        self.open -= clicks;
        self.old = self.open;
        clicks as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The clicks of looks, each with the presses heard before it and whether the button was down.
    fn told(looks: &[(i8, bool)]) -> u8 {
        let mut missed = Missed::default();
        looks.iter().map(|(heard, down)| missed.look(*heard, *down)).sum()
    }

    #[test]
    fn a_press_is_told_unless_it_was_seen() {
        // Between two looks; twice.
        assert_eq!(told(&[(1, false), (0, false), (0, false)]), 1);
        assert_eq!(told(&[(2, false), (0, false), (0, false)]), 2);
        // Seen, and heard before, with, or after that.
        assert_eq!(told(&[(1, false), (0, true), (0, false), (0, false)]), 0);
        assert_eq!(told(&[(1, true), (0, true), (0, false), (0, false)]), 0);
        assert_eq!(told(&[(0, true), (1, true), (0, false), (0, false)]), 0);
        assert_eq!(told(&[(0, true), (1, false), (0, false), (0, false)]), 0);
        // One seen and never heard takes nothing from the next one.
        assert_eq!(told(&[(0, true), (0, false), (0, false), (1, false), (0, false)]), 1);
        // Up and down again between two looks, and up: two presses, of which one was seen.
        assert_eq!(told(&[(1, true), (1, true), (0, false), (0, false)]), 1);
    }
}
