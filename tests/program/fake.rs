//! A fake X server, which says what a test wants, and an authority file for it.
//!
//! [`Client::agree`] and [`Client::serve_until`] are polite: each request that has an answer gets as little as will do, and
//! nothing is shown. What is to be odd a test says itself, before that or in its place.

use std::fs;
use std::io::{Read, Result, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;

/// Codes of requests (X11/Xproto.h).
pub const CREATE_WINDOW: u8 = 1;
pub const CHANGE_WINDOW_ATTRIBUTES: u8 = 2;
const WINDOW_ATTRIBUTES: u8 = 3;
pub const DESTROY_WINDOW: u8 = 4;
pub const MAP_WINDOW: u8 = 8;
pub const PUT_IMAGE: u8 = 72;
const INTERN_ATOM: u8 = 16;
pub const KEYBOARD_MAPPING: u8 = 101;
/// All that have an answer.
const ANSWERED: [u8; 41] = [
    3, 14, 15, 16, 17, 20, 21, 23, 26, 31, 38, 39, 40, 43, 44, 47, 48, 49, 50, 52, 73, 83, 84, 85, 86, 87, 91, 92, 97,
    98, 99, 101, 103, 106, 108, 110, 114, 116, 117, 118, 119,
];

/// The first key that there may be, and which ones there are.
const FIRST_KEY: u8 = 8;
pub const ESC: u8 = 9;
pub const S: u8 = 10;

/// A server; it stops listening at the end of the test.
pub struct Fake {
    /// Its `DISPLAY`.
    pub name: String,
    socket: PathBuf,
}

impl Fake {
    /// Talks with each client in a thread of its own. An error ends the talk alone: the client has gone.
    pub fn open(talk: impl Fn(Client) -> Result<()> + Clone + Send + 'static) -> Fake {
        let (fake, listener) = Fake::deaf();
        thread::spawn(move || {
            for stream in listener.incoming() {
                let (talk, stream) = (talk.clone(), stream.unwrap());
                thread::spawn(move || talk(Client { stream, asked: 0, window: [0; 4] }));
            }
        });
        fake
    }

    /// A server that does not take up connections, as long as the listener is kept.
    pub fn deaf() -> (Fake, UnixListener) {
        // Far from the numbers of true servers, and other tests' own.
        static NEXT: AtomicU32 = AtomicU32::new(0);
        fs::create_dir_all("/tmp/.X11-unix").unwrap();
        loop {
            let number = 1000 + (64 * std::process::id() + NEXT.fetch_add(1, Ordering::Relaxed)) % 1_000_000;
            let socket = PathBuf::from(format!("/tmp/.X11-unix/X{number}"));
            if let Ok(listener) = UnixListener::bind(&socket) {
                return (Fake { name: format!(":{number}"), socket }, listener);
            }
        }
    }

    /// The number of its display.
    pub fn number(&self) -> &str {
        &self.name[1..]
    }
}

impl Drop for Fake {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.socket);
    }
}

/// A connection, how many requests it has made, and the window that it has made last or else listens to.
pub struct Client {
    pub stream: UnixStream,
    asked: u16,
    window: [u8; 4],
}

impl Client {
    /// Hears who wants to connect, and gives the cookie.
    pub fn hello(&mut self) -> Result<Vec<u8>> {
        let head = self.hear(12)?;
        let length = |at: usize| usize::from(u16::from_le_bytes([head[at], head[at + 1]]));
        self.hear(length(6).next_multiple_of(4))?;
        let mut cookie = self.hear(length(8).next_multiple_of(4))?;
        cookie.truncate(length(8));
        Ok(cookie)
    }

    /// Hears it, and agrees.
    pub fn agree(&mut self) -> Result<()> {
        self.hello()?;
        self.say(&set_up(24, 32))
    }

    /// Serves until such a request, which it answers too.
    pub fn serve_until(&mut self, code: u8) -> Result<()> {
        loop {
            let request = self.request()?;
            self.answer(&request)?;
            if request[0] == code {
                return Ok(());
            }
        }
    }

    /// Serves until there is a picture in the window.
    pub fn serve_until_shown(&mut self) -> Result<()> {
        self.serve_until_shows(|_| true)
    }

    /// Serves until there is such a picture in the window: it is told the request.
    pub fn serve_until_shows(&mut self, what: impl Fn(&[u8]) -> bool) -> Result<()> {
        loop {
            let request = self.request()?;
            self.answer(&request)?;
            if request[0] == PUT_IMAGE && request[4..8] == self.window && what(&request) {
                return Ok(());
            }
        }
    }

    /// Serves until the client has put its window on the screen, or listens to another client's. Which of the two?
    pub fn serve_until_mapped(&mut self) -> Result<bool> {
        let mut made = false;
        loop {
            let request = self.request()?;
            self.answer(&request)?;
            match request[0] {
                CREATE_WINDOW => made = true,
                MAP_WINDOW => return Ok(true),
                CHANGE_WINDOW_ATTRIBUTES if !made => return Ok(false),
                _ => {}
            }
        }
    }

    /// The next request.
    pub fn request(&mut self) -> Result<Vec<u8>> {
        let mut request = self.hear(4)?;
        let words = usize::from(u16::from_le_bytes([request[2], request[3]]));
        request.extend(self.hear(4 * words.max(1) - 4)?);
        self.asked = self.asked.wrapping_add(1);
        if request[0] == CREATE_WINDOW || request[0] == CHANGE_WINDOW_ATTRIBUTES && self.window == [0; 4] {
            self.window.copy_from_slice(&request[4..8]);
        }
        Ok(request)
    }

    /// The answer to it, if there is one.
    pub fn answer(&mut self, request: &[u8]) -> Result<()> {
        if !ANSWERED.contains(&request[0]) {
            return Ok(());
        }
        let [low, high] = self.asked.to_le_bytes();
        let mut answer = vec![0; 32];
        (answer[0], answer[2], answer[3]) = (1, low, high);
        match request[0] {
            // No two names are the same here.
            INTERN_ATOM => (answer[8], answer[9]) = (low, high | 1),
            WINDOW_ATTRIBUTES => {
                answer[4] = 3;
                answer.extend([0; 12]);
            }
            KEYBOARD_MAPPING => {
                let (first, count) = (request[4], request[5]);
                (answer[1], answer[4]) = (1, count);
                for place in 0..count {
                    let symbol: u32 = match first + place {
                        ESC => 0xff1b,
                        S => u32::from(b's'),
                        _ => 0,
                    };
                    answer.extend(symbol.to_le_bytes());
                }
            }
            _ => {}
        }
        self.say(&answer)
    }

    /// Presses a key and lets it go.
    pub fn press(&mut self, key: u8) -> Result<()> {
        self.event(2, key, &[&[0; 8][..], &self.window, &[0; 14], &[1]].concat())?;
        self.event(3, key, &[&[0; 8][..], &self.window, &[0; 14], &[1]].concat())
    }

    /// The window has another size.
    pub fn resize(&mut self, width: u16, height: u16) -> Result<()> {
        let sides = [width.to_le_bytes(), height.to_le_bytes()].concat();
        self.event(22, 0, &[&self.window, &self.window, &[0; 8][..], &sides].concat())
    }

    /// An event: its code, its byte, and what follows the number of the latest request.
    fn event(&mut self, code: u8, detail: u8, rest: &[u8]) -> Result<()> {
        let mut event = [&[code, detail][..], &self.asked.to_le_bytes(), rest].concat();
        event.resize(32, 0);
        self.say(&event)
    }

    pub fn say(&mut self, bytes: &[u8]) -> Result<()> {
        self.stream.write_all(bytes)
    }

    fn hear(&mut self, count: usize) -> Result<Vec<u8>> {
        let mut bytes = vec![0; count];
        self.stream.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}

/// What a server says of itself that agrees: one screen of that depth, in pixels of so many bits.
pub fn set_up(depth: u8, bits: u8) -> Vec<u8> {
    let mut words = vec![
        // Release; first number for what the client makes, and which bits there are for it; motion buffer.
        1,
        0x400000,
        0x1fffff,
        256,
        // Bytes of the vendor's name and words of the longest request; one screen, one format, little-endian; keys.
        4 | 0xffff << 16,
        1 | 1 << 8,
        32 | 32 << 8 | u32::from(FIRST_KEY) << 16 | 255 << 24,
        0,
        u32::from_le_bytes(*b"fake"),
        // The format.
        u32::from(depth) | u32::from(bits) << 8 | 32 << 16,
        0,
    ];
    // Root, colour map, white, black, events; sides in pixels and millimetres; maps, visual; depth and how many.
    words.extend([0x100, 0x101, 0xffffff, 0, 0, 640 | 480 << 16, 170 | 127 << 16, 1 | 1 << 16, 0x102]);
    words.push(u32::from(depth) << 16 | 1 << 24);
    // The depth with its one visual: TrueColor, eight bits a channel.
    words.extend([u32::from(depth) | 1 << 16, 0, 0x102, 4 | 8 << 8 | 256 << 16, 0xff0000, 0xff00, 0xff, 0]);
    agreed(&words)
}

/// The same of words that a test chooses.
pub fn agreed(words: &[u32]) -> Vec<u8> {
    let head = [1 | 11 << 16, (words.len() as u32) << 16];
    head.iter().chain(words).flat_map(|word| word.to_le_bytes()).collect()
}

/// What a server says that wants another cookie.
pub fn refusal() -> Vec<u8> {
    [&[0, 12, 11, 0, 0, 0, 3, 0][..], b"no such luck"].concat()
}

/// An entry of an authority file, for the display of that number.
pub fn entry(number: &str, method: &str, cookie: &[u8]) -> Vec<u8> {
    // Of any machine.
    let mut entry = vec![0xff, 0xff];
    for part in [b"", number.as_bytes(), method.as_bytes(), cookie] {
        entry.extend((part.len() as u16).to_be_bytes());
        entry.extend(part);
    }
    entry
}
