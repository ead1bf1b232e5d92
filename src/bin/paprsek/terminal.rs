//! Plays in a terminal that shows colour: two pixels a character, as upper half blocks.

mod signals;

use crate::args::Args;
use crate::canvas;
use crate::clock::Clock;
use paprsek::frame::{Frame, Renderer};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::termios::{
    InputModes, LocalModes, OptionalActions, SpecialCodeIndex, Termios, tcgetattr, tcgetwinsize, tcsetattr,
};
use std::env;
use std::fs::File;
use std::io::{self, IsTerminal, Read, Write};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

/// 25 frames a second: more than most terminals draw of full-colour text.
const PERIOD: Duration = Duration::from_millis(40);
/// Most columns and rows, against a terminal that reports nonsense.
const LIMIT: usize = 1000;
/// Seconds that an arrow key moves.
const SEEK: f64 = 5.0;

/// How long a signal waits for the terminal.
const SECOND: Duration = Duration::from_secs(1);

/// Alternate screen, no cursor.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[2J";
/// Colours, cursor and screen as they were.
const LEAVE: &[u8] = b"\x1b[0m\x1b[?25h\x1b[?1049l";

/// Whether stdout is a terminal that can be expected to know colour.
pub fn shows_colour() -> bool {
    io::stdout().is_terminal() && env::var_os("TERM").is_some_and(|term| !term.is_empty() && term != "dumb")
}

/// Plays until Esc, q, Ctrl-C or the end of the scene.
pub fn play(args: &Args) -> Result<(), String> {
    let mut renderer = Renderer::new(args.threads)?;
    let mut clock = Clock::new(args).once();
    let mut keyboard = Keyboard::open();
    let mut frame = canvas::frame((1, 1))?;
    let mut text = Vec::new();
    while let Some(time) = clock.now() {
        let began = Instant::now();
        let (columns, rows) = size();
        if (frame.width, frame.height) != (columns, 2 * rows) {
            frame = canvas::frame((columns, 2 * rows))?;
        }
        renderer.render_with(args.scene(), time, &args.options, &mut frame);
        text.clear();
        encode(&frame, &mut text);
        write(&text).map_err(|error| format!("cannot write to the terminal: {error}"))?;
        match keyboard.as_mut().map_or(Press::Nothing, Keyboard::press) {
            Press::Nothing => {}
            Press::Leave => return Ok(()),
            Press::Pause => clock.toggle(),
            Press::Seek(seconds) => clock.seek(seconds),
            Press::Part(part) => clock.jump(part),
        }
        thread::sleep(PERIOD.saturating_sub(began.elapsed()));
    }
    Ok(())
}

/// Columns and rows of the terminal; `COLUMNS` and `LINES`, or 80x24, where it does not say.
fn size() -> (usize, usize) {
    let told = tcgetwinsize(io::stdout()).map_or((0, 0), |size| (size.ws_col.into(), size.ws_row.into()));
    let or_else = |told: usize, name: &str, usual: usize| {
        let named = || env::var(name).ok().and_then(|text| text.parse().ok()).filter(|n| *n > 0);
        if told > 0 { told } else { named().unwrap_or(usual) }.min(LIMIT)
    };
    (or_else(told.0, "COLUMNS", 80), or_else(told.1, "LINES", 24))
}

/// The picture as text: a colour is named only where it changes, and a row ends in none.
fn encode(frame: &Frame, text: &mut Vec<u8>) {
    for (row, pair) in frame.pixels.chunks_exact(2 * frame.width).enumerate() {
        // Writing to a vector cannot fail.
        let _ = write!(text, "\x1b[{};1H", row + 1);
        let (upper, lower) = pair.split_at(frame.width);
        let mut last = (None, None);
        for (&upper, &lower) in upper.iter().zip(lower) {
            if last.0 != Some(upper) {
                colour(text, 38, upper);
            }
            if last.1 != Some(lower) {
                colour(text, 48, lower);
            }
            last = (Some(upper), Some(lower));
            text.extend_from_slice("\u{2580}".as_bytes());
        }
        text.extend_from_slice(b"\x1b[0m");
    }
}

fn colour(text: &mut Vec<u8>, layer: u8, pixel: u32) {
    let [_, red, green, blue] = pixel.to_be_bytes();
    let _ = write!(text, "\x1b[{layer};2;{red};{green};{blue}m");
}

/// Held by whoever writes to the screen: nothing of a frame may follow what puts it back.
static SCREEN: Mutex<()> = Mutex::new(());

fn write(text: &[u8]) -> io::Result<()> {
    let _screen = SCREEN.lock();
    let mut out = io::stdout().lock();
    out.write_all(text)?;
    out.flush()
}

/// What the keys ask for.
#[derive(Debug, PartialEq)]
enum Press {
    Nothing,
    Leave,
    Pause,
    Seek(f64),
    /// Counted from 0.
    Part(usize),
}

/// The terminal with its keys delivered one by one, Ctrl-C among them: so it ends between frames, with the screen
/// put back, and not in the middle of an escape sequence.
struct Keyboard(Arc<Terminal>);

/// A terminal, and its modes before.
struct Terminal {
    terminal: File,
    before: Termios,
}

impl Keyboard {
    /// `None` where there is no controlling terminal, and so no Ctrl-C either.
    fn open() -> Option<Keyboard> {
        let terminal = File::open("/dev/tty").ok()?;
        let before = tcgetattr(&terminal).ok()?;
        let mut modes = before.clone();
        modes.local_modes -= LocalModes::ICANON | LocalModes::ECHO | LocalModes::ISIG;
        // Ctrl-S is a key like any other: it would stop the frame, and with that the look at the keys.
        modes.input_modes -= InputModes::IXON;
        // A read returns what is there, if only nothing.
        modes.special_codes[SpecialCodeIndex::VMIN] = 0;
        modes.special_codes[SpecialCodeIndex::VTIME] = 0;
        let terminal = Arc::new(Terminal { terminal, before });
        let signalled = Arc::clone(&terminal);
        // Where there is no thread for that, a signal leaves the screen as it is.
        let _ = signals::before_the_end(move || signalled.put_back_soon());
        tcsetattr(&terminal.terminal, OptionalActions::Now, &modes).ok()?;
        let keyboard = Keyboard(terminal);
        write(ENTER).ok().map(|()| keyboard)
    }

    fn press(&mut self) -> Press {
        let mut bytes = [0; 16];
        match (&self.0.terminal).read(&mut bytes) {
            Ok(count) => meaning(bytes.get(..count).unwrap_or_default()),
            // The terminal is gone.
            Err(_) => Press::Leave,
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

    /// The whole of it after a signal. As long as the guard is kept nobody else writes. A terminal that takes nothing for
    /// a second, or is in the middle of a frame as long, gets its modes alone.
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

/// The last key of a read decides, but for Ctrl-C, which always does.
fn meaning(bytes: &[u8]) -> Press {
    match bytes {
        _ if bytes.contains(&3) => Press::Leave,
        [.., 0x1b, b'[', b'C'] => Press::Seek(SEEK),
        [.., 0x1b, b'[', b'D'] => Press::Seek(-SEEK),
        [.., 0x1b | b'q'] => Press::Leave,
        [.., b' '] => Press::Pause,
        [.., digit @ b'1'..=b'9'] => Press::Part(usize::from(digit - b'1')),
        _ => Press::Nothing,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_named_where_it_changes() {
        let frame = Frame { width: 2, height: 2, pixels: vec![0x102030, 0x102030, 0x000001, 0xffffff] };
        let mut text = Vec::new();
        encode(&frame, &mut text);
        let expected = "\x1b[1;1H\x1b[38;2;16;32;48m\x1b[48;2;0;0;1m▀\x1b[48;2;255;255;255m▀\x1b[0m";
        assert_eq!(String::from_utf8_lossy(&text), expected);
    }

    #[test]
    fn keys_mean_what_they_do_in_the_window() {
        assert_eq!(meaning(b""), Press::Nothing);
        assert_eq!(meaning(b"x"), Press::Nothing);
        assert_eq!(meaning(b"\x1b"), Press::Leave);
        assert_eq!(meaning(b"\x03x"), Press::Leave);
        assert_eq!(meaning(b" "), Press::Pause);
        assert_eq!(meaning(b"\x1b[D"), Press::Seek(-5.0));
        assert_eq!(meaning(b"2"), Press::Part(1));
    }
}
