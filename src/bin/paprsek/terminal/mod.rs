//! Plays in a terminal that shows colour: two pixels per character, as upper half blocks.
//!
//! However it ends, the terminal is put back as it was: at the end of the scene, by a key, and before a signal ends the
//! process.

mod signals;

use crate::args::Args;
use crate::capture;
use crate::clock::{Clock, SEEK};
#[cfg(target_os = "linux")]
use crate::sound;
use paprsek::frame::Frame;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::termios::{
    InputModes, LocalModes, OptionalActions, SpecialCodeIndex, Termios, tcgetattr, tcgetwinsize, tcsetattr,
};
use std::env;
use std::fs::File;
use std::io::{self, IsTerminal, Read, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Shortest time from one frame to the next: 25 per second, more than most terminals draw of text in full colour.
const PERIOD: Duration = Duration::from_millis(40);
/// Most columns and rows, against a terminal that reports nonsense.
const MAX_SIDE: usize = 1000;
/// Columns and rows of a terminal that reports none.
const USUAL_SIZE: (usize, usize) = (80, 24);
/// How long putting the terminal back waits for it after a signal.
const SECOND: Duration = Duration::from_secs(1);

// Escape sequences (ECMA-48, and xterm's private modes).
/// Enters the alternate screen, hides the cursor, and clears.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[2J";
/// Resets colours, shows the cursor, and leaves the alternate screen.
const LEAVE: &[u8] = b"\x1b[0m\x1b[?25h\x1b[?1049l";
/// Resets colours.
const RESET: &[u8] = b"\x1b[0m";
/// What a colour is for: the letter, or what is behind it.
const FOREGROUND: u8 = 38;
const BACKGROUND: u8 = 48;
/// The letter whose upper half is foreground and whose lower half is background.
const UPPER_HALF_BLOCK: &str = "\u{2580}";

// Bytes that keys send.
const CTRL_C: u8 = 3;
const ESC: u8 = 0x1b;

/// Whether stdout is a terminal that can be expected to know colour.
pub fn shows_colour() -> bool {
    io::stdout().is_terminal() && env::var_os("TERM").is_some_and(|term| !term.is_empty() && term != "dumb")
}

/// Plays until Esc, q or Ctrl-C, or until the end of the scene.
pub fn play(args: &Args) -> Result<(), String> {
    let mut renderer = capture::renderer(args)?;
    // Leaked: the sound goes on until the process goes.
    let clock: &Mutex<Clock> = Box::leak(Box::new(Mutex::new(Clock::new(args, true))));
    let lock = move || clock.lock().unwrap_or_else(PoisonError::into_inner);
    #[cfg(target_os = "linux")]
    if args.sounds() {
        // Without a thread for it the show is silent.
        let _ = thread::Builder::new().spawn(move || sound::play(&|heard| lock().follow(heard)));
    }
    let mut keyboard = Keyboard::open();
    let mut frame = capture::black_frame((1, 1))?;
    let mut text = Vec::new();
    loop {
        let Some(time) = lock().now() else { return Ok(()) };
        let began = Instant::now();
        let (columns, rows) = size();
        if (frame.width, frame.height) != (columns, 2 * rows) {
            frame = capture::black_frame((columns, 2 * rows))?;
        }
        renderer.render_with(args.scene(), time, &args.options, &mut frame);
        text.clear();
        half_blocks(&frame, &mut text);
        write(&text).map_err(|error| format!("cannot write to the terminal: {error}"))?;
        match keyboard.as_mut().map_or(Action::Nothing, Keyboard::action) {
            Action::Nothing => {}
            Action::Leave => return Ok(()),
            Action::Pause => lock().toggle(),
            Action::Seek(seconds) => lock().seek(seconds),
            Action::Part(part) => lock().jump(part),
        }
        thread::sleep(PERIOD.saturating_sub(began.elapsed()));
    }
}

/// Columns and rows of the terminal. Where it does not report them, `COLUMNS` and `LINES` of the environment, or 80x24.
fn size() -> (usize, usize) {
    let told = tcgetwinsize(io::stdout()).map_or((0, 0), |size| (size.ws_col.into(), size.ws_row.into()));
    let or_else = |told: usize, name: &str, usual: usize| {
        let named = || env::var(name).ok().and_then(|text| text.parse().ok()).filter(|n| *n > 0);
        if told > 0 { told } else { named().unwrap_or(usual) }.min(MAX_SIDE)
    };
    (or_else(told.0, "COLUMNS", USUAL_SIZE.0), or_else(told.1, "LINES", USUAL_SIZE.1))
}

/// The frame as text. A colour is set only where it changes, and reset at the end of each row.
fn half_blocks(frame: &Frame, text: &mut Vec<u8>) {
    for (row, pair) in frame.pixels.chunks_exact(2 * frame.width).enumerate() {
        // The cursor goes to the start of the row. Writing to a vector cannot fail.
        let _ = write!(text, "\x1b[{};1H", row + 1);
        let (upper, lower) = pair.split_at(frame.width);
        let mut last = (None, None);
        for (&upper, &lower) in upper.iter().zip(lower) {
            if last.0 != Some(upper) {
                colour(text, FOREGROUND, upper);
            }
            if last.1 != Some(lower) {
                colour(text, BACKGROUND, lower);
            }
            last = (Some(upper), Some(lower));
            text.extend_from_slice(UPPER_HALF_BLOCK.as_bytes());
        }
        text.extend_from_slice(RESET);
    }
}

/// Sets the colour of the foreground or of the background.
fn colour(text: &mut Vec<u8>, layer: u8, pixel: u32) {
    let [_, red, green, blue] = pixel.to_be_bytes();
    let _ = write!(text, "\x1b[{layer};2;{red};{green};{blue}m");
}

/// Held by whoever writes to the screen, so that no part of a frame follows what puts the screen back.
static SCREEN: Mutex<()> = Mutex::new(());

fn write(text: &[u8]) -> io::Result<()> {
    let _screen = SCREEN.lock();
    let mut out = io::stdout().lock();
    out.write_all(text)?;
    out.flush()
}

/// What the keys ask for.
#[derive(Debug, PartialEq)]
enum Action {
    Nothing,
    Leave,
    Pause,
    /// Moves by seconds of the scene.
    Seek(f64),
    /// Jumps to a part, counted from 0.
    Part(usize),
}

/// A terminal that delivers keys one by one, with Ctrl-C among them. So playing ends between frames, with the screen
/// put back, and not in the middle of an escape sequence.
struct Keyboard(Arc<Terminal>);

struct Terminal {
    /// The controlling terminal of the process.
    terminal: File,
    /// Its modes before playing.
    before: Termios,
}

impl Keyboard {
    /// Takes over the terminal. `None` where the process has no controlling one, and so gets no Ctrl-C either.
    fn open() -> Option<Keyboard> {
        let terminal = File::open("/dev/tty").ok()?;
        let before = tcgetattr(&terminal).ok()?;
        let mut modes = before.clone();
        modes.local_modes -= LocalModes::ICANON | LocalModes::ECHO | LocalModes::ISIG;
        // Ctrl-S becomes a key like any other. It would block the writing of the frame, and with that the reading of
        // keys.
        modes.input_modes -= InputModes::IXON;
        // A read returns at once with what is there, even if that is nothing.
        modes.special_codes[SpecialCodeIndex::VMIN] = 0;
        modes.special_codes[SpecialCodeIndex::VTIME] = 0;
        let terminal = Arc::new(Terminal { terminal, before });
        let signalled = Arc::clone(&terminal);
        // If there is no thread for this, a signal leaves the screen as it is.
        let _ = signals::before_the_end(move || signalled.put_back_soon());
        tcsetattr(&terminal.terminal, OptionalActions::Now, &modes).ok()?;
        let keyboard = Keyboard(terminal);
        write(ENTER).ok().map(|()| keyboard)
    }

    /// What the keys pressed since the last call ask for.
    fn action(&mut self) -> Action {
        let mut bytes = [0; 16];
        match (&self.0.terminal).read(&mut bytes) {
            Ok(count) => meaning(bytes.get(..count).unwrap_or_default()),
            // The terminal is gone.
            Err(_) => Action::Leave,
        }
    }
}

impl Drop for Keyboard {
    fn drop(&mut self) {
        let _ = write(LEAVE);
        self.0.put_modes_back();
    }
}

impl Terminal {
    fn put_modes_back(&self) {
        let _ = tcsetattr(&self.terminal, OptionalActions::Now, &self.before);
    }

    /// Puts screen and modes back after a signal. Nobody else writes as long as the guard is kept. A terminal that
    /// takes nothing for a second, or is in the middle of a frame for that long, gets back its modes alone.
    fn put_back_soon(&self) -> Option<MutexGuard<'static, ()>> {
        let began = Instant::now();
        let screen = loop {
            match SCREEN.try_lock() {
                Ok(screen) => break Some(screen),
                Err(_) if began.elapsed() < SECOND => thread::sleep(Duration::from_millis(1)),
                Err(_) => break None,
            }
        };
        let (out, second) = (io::stdout(), Timespec { tv_sec: 1, tv_nsec: 0 });
        if screen.is_some() && poll(&mut [PollFd::new(&out, PollFlags::OUT)], Some(&second)) == Ok(1) {
            let _ = out.lock().write_all(LEAVE).and_then(|()| out.lock().flush());
        }
        self.put_modes_back();
        screen
    }
}

/// What the bytes of a read mean: the last key decides, except that Ctrl-C always does.
fn meaning(bytes: &[u8]) -> Action {
    match bytes {
        _ if bytes.contains(&CTRL_C) => Action::Leave,
        [.., ESC, b'[', b'C'] => Action::Seek(SEEK),
        [.., ESC, b'[', b'D'] => Action::Seek(-SEEK),
        [.., ESC | b'q'] => Action::Leave,
        [.., b' '] => Action::Pause,
        [.., digit @ b'1'..=b'9'] => Action::Part(usize::from(digit - b'1')),
        _ => Action::Nothing,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_set_where_it_changes() {
        let frame = Frame { width: 2, height: 2, pixels: vec![0x102030, 0x102030, 0x000001, 0xffffff] };
        let mut text = Vec::new();
        half_blocks(&frame, &mut text);
        let expected = "\x1b[1;1H\x1b[38;2;16;32;48m\x1b[48;2;0;0;1m▀\x1b[48;2;255;255;255m▀\x1b[0m";
        assert_eq!(String::from_utf8_lossy(&text), expected);
    }

    #[test]
    fn keys_mean_what_they_do_in_the_window() {
        assert_eq!(meaning(b""), Action::Nothing);
        assert_eq!(meaning(b"x"), Action::Nothing);
        assert_eq!(meaning(b"\x1b"), Action::Leave);
        assert_eq!(meaning(b"\x03x"), Action::Leave);
        assert_eq!(meaning(b" "), Action::Pause);
        assert_eq!(meaning(b"\x1b[D"), Action::Seek(-5.0));
        assert_eq!(meaning(b"2"), Action::Part(1));
    }
}
