//! The table of keys: what each does, and what the help says about it.

use minifb::Key;

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Shows or hides the help.
    Help,
    /// Shows or hides the panel.
    Panel,
    /// Shows or hides the line below.
    Hud,
    /// Shows or hides the graph of frame times.
    Times,
    /// Another cap of the frame rate.
    Cap(i32),
    /// Another overlay, or none.
    Overlay(i32),
    /// Compares the frame with the truth.
    Compare,
    /// Tells of the pixel under the mouse.
    Probe,
    /// Pauses and continues.
    Pause,
    /// Moves by seconds.
    Seek(i32),
    /// Moves by frames of 1/30 s.
    Frame(i32),
    /// Halves or doubles the speed of time.
    Rate(i32),
    /// Life's own speed of time.
    RealTime,
    /// Another scene.
    Scene(i32),
    /// Another day.
    Day(i32),
    /// Another month.
    Month(i32),
    /// Changes the parameter of that number by a step.
    Turn(usize, i32),
    /// No flakes, or as many as before.
    Snow,
    /// Every parameter and setting as it was.
    Reset,
    /// The scene's own camera.
    Home,
    /// A key of the camera, where it is.
    Key,
    /// Takes the aeroplane, or leaves it.
    Fly,
    /// From the pilot's eyes, or from behind.
    Person,
    /// Copies the frame as a command line.
    Copy,
    /// Saves the frame.
    Still,
    /// Begins to record, or ends it.
    Record,
    /// Ends.
    Quit,
}

/// A row: the key, whether with Shift, what it does.
type Row = (Key, bool, Action);

/// The keys that do something when they go down.
#[rustfmt::skip]
const ROWS: &[Row] = &[
    (Key::F1, false, Action::Help),
    (Key::Tab, false, Action::Panel),
    (Key::M, false, Action::Hud),
    (Key::F2, false, Action::Times),
    (Key::F6, false, Action::Cap(1)),
    (Key::F6, true, Action::Cap(-1)),
    (Key::F3, false, Action::Overlay(1)),
    (Key::F3, true, Action::Overlay(-1)),
    (Key::F4, false, Action::Compare),
    (Key::F5, false, Action::Probe),
    (Key::Space, false, Action::Pause),
    (Key::Left, false, Action::Seek(-5)),
    (Key::Right, false, Action::Seek(5)),
    (Key::Comma, false, Action::Frame(-1)),
    (Key::Period, false, Action::Frame(1)),
    (Key::LeftBracket, false, Action::Rate(-1)),
    (Key::RightBracket, false, Action::Rate(1)),
    (Key::Backslash, false, Action::RealTime),
    (Key::Z, false, Action::Scene(-1)),
    (Key::X, false, Action::Scene(1)),
    (Key::PageUp, false, Action::Day(1)),
    (Key::PageDown, false, Action::Day(-1)),
    (Key::PageUp, true, Action::Month(1)),
    (Key::PageDown, true, Action::Month(-1)),
    (Key::N, false, Action::Snow),
    (Key::Delete, false, Action::Reset),
    (Key::Home, false, Action::Home),
    (Key::Semicolon, false, Action::Key),
    (Key::B, false, Action::Fly),
    (Key::V, false, Action::Person),
    (Key::C, false, Action::Copy),
    (Key::F12, false, Action::Still),
    (Key::F9, false, Action::Record),
    (Key::Escape, false, Action::Quit),
];

/// Pairs of keys for the scene's parameters, in the order of its table: the upper key raises, the lower one lowers.
/// With Shift they are the parameters from the seventh on, with Ctrl those from the thirteenth on.
pub const PAIRS: [(Key, Key, &str); 6] = [
    (Key::R, Key::F, "R F"),
    (Key::T, Key::G, "T G"),
    (Key::Y, Key::H, "Y H"),
    (Key::U, Key::J, "U J"),
    (Key::I, Key::K, "I K"),
    (Key::O, Key::L, "O L"),
];

/// The keys of the parameter of that number, from 0, as the help has them.
pub fn pair(number: usize) -> String {
    let keys = PAIRS[number % PAIRS.len()].2;
    match number / PAIRS.len() {
        0 => keys.to_owned(),
        1 => format!("Shift {keys}"),
        _ => format!("Ctrl {keys}"),
    }
}

/// What a key does that goes down with Shift or Ctrl.
pub fn action(key: Key, shift: bool, ctrl: bool) -> Option<Action> {
    let bank = if ctrl { 2 } else { usize::from(shift) };
    for (place, (up, down, _)) in PAIRS.iter().enumerate() {
        if key == *up || key == *down {
            return Some(Action::Turn(bank * PAIRS.len() + place, if key == *up { 1 } else { -1 }));
        }
    }
    ROWS.iter().find(|row| (row.0, row.1) == (key, shift)).map(|row| row.2)
}

/// Whether an action is repeated while its key is held.
pub fn repeats(action: Action) -> bool {
    matches!(action, Action::Seek(_) | Action::Frame(_) | Action::Turn(..) | Action::Day(_) | Action::Month(_))
}

/// The help: groups of keys and what they do. The pairs of the scene's parameters stand beside these.
#[rustfmt::skip]
pub const HELP: &[(&str, &[(&str, &str)])] = &[
    ("Move", &[
        ("W A S D", "walk; with Shift 10 times as fast, with Ctrl a tenth"),
        ("E Q", "rise and sink"),
        ("drag", "look around, with either button"),
        ("wheel", "walk faster or slower; with Ctrl the field of view"),
        ("Home", "back to the scene's own camera"),
        (";", "a key of the camera; the panel plays and writes them"),
        ("Z X", "the scene before, the next scene"),
    ]),
    ("Fly", &[
        ("B", "take the aeroplane, and leave it"),
        ("Up Down", "nose down, nose up"),
        ("Left Right", "roll"),
        ("W S", "faster, slower"),
        ("V", "from the pilot's eyes, or from behind"),
    ]),
    ("Time", &[
        ("Space", "pause and continue"),
        ("Left Right", "5 s back, 5 s on"),
        (", .", "a frame back, a frame on"),
        ("[ ] \\", "time at half the speed, at twice, as it is"),
        ("F6", "frames per second at most: 60 at first; with Shift fewer"),
        ("PageUp PageDown", "a day on, a day back; with Shift a month"),
    ]),
    ("Turn", &[
        ("Tab", "the panel: every parameter and every setting"),
        ("N", "snow or rain on and off"),
        ("Delete", "every parameter and setting as it was"),
    ]),
    ("Keep", &[
        ("C", "copy the frame as a command line"),
        ("F12", "save the picture as PNG"),
        ("F9", "record, until F9 again"),
    ]),
    ("Show", &[
        ("F1", "this help"),
        ("F2", "frame times, their slowest hundredth, the layers' shares"),
        ("F3", "what the algorithms do, one overlay after another; with Shift back"),
        ("F4", "compare with the exact frame or the reference"),
        ("F5", "how the pixel under the mouse came to be"),
        ("M", "the line below"),
        ("Esc", "close what is open, then end"),
    ]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        for (place, row) in ROWS.iter().enumerate() {
            assert!(ROWS[..place].iter().all(|other| (other.0, other.1) != (row.0, row.1)), "{row:?}");
            assert!(PAIRS.iter().all(|pair| pair.0 != row.0 && pair.1 != row.0), "{row:?}");
            assert!(![Key::W, Key::A, Key::S, Key::D, Key::Q, Key::E].contains(&row.0), "{row:?}");
        }
    }
}
