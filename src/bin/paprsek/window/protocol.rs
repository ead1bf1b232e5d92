//! A connection to the X server of this machine, by its protocol ("X Window System Protocol", X.Org, version 11), and
//! how a window fills the screen (`Extended Window Manager Hints`, freedesktop.org, version 1.5).
//!
//! A request consists of little-endian words of 32 bits. The first holds the code, a byte that depends on the code, and
//! the length in words. Replies, events and errors are eight words; a reply may have more behind them, and says how
//! many.
//!
//! Nothing that the server says is taken on trust, and nothing is waited for long: the socket never blocks, waits are
//! counted, and what a length names is there, as zeros if need be.

use crate::io::{c_path, contents, environment, variable};
use crate::text::fill;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{read, write};
use rustix::net::{AddressFamily, SocketAddrUnix, SocketFlags, SocketType, connect, socket_with};
use std::os::fd::OwnedFd;

/// Words of a reply, an event or an error.
pub const PACKET: usize = 8;
/// The word of a reply at which what was asked for begins.
const REPLY: usize = 2;

/// The first word of a request: its code, the byte that depends on the code, and its length in words.
#[inline(always)]
pub const fn request(code: u32, detail: u32, words: u32) -> u32 {
    code | detail << 8 | words << 16
}

// Codes of requests and events (X11/Xproto.h).
const CONFIGURE_WINDOW: u32 = 12;
const INTERN_ATOM: u32 = 16;
/// Makes a graphics context.
pub const CREATE_GC: u32 = 55;
const GET_KEYBOARD_MAPPING: u32 = 101;
const SEND_EVENT: u32 = 25;
/// The bits of an event's code. The eighth says that another client has sent the event.
pub const EVENT_CODE: u32 = 0x7f;
/// The event of a key that goes down.
pub const KEY_PRESS: u32 = 2;
/// The event that a client sends to another.
pub const CLIENT_MESSAGE: u32 = 33;

/// The size of the numbers of a message or a property.
pub const BITS_32: u32 = 32;
/// Who hears an event that is sent to the root window: the window manager (SubstructureNotify and
/// SubstructureRedirect).
const TO_WINDOW_MANAGER: u32 = 1 << 19 | 1 << 20;
/// What a request to configure a window sets: x, y, width and height.
const PLACE_AND_SIZE: u32 = 0b1111;
/// Who asks for a window's state, by the Extended Window Manager Hints: an application.
const FROM_APPLICATION: u32 = 1;

// Words of what the server says of itself.
/// The first of the numbers that the client may give to what it makes.
pub const SETUP_ID: usize = 1;
/// The length of the vendor's name in bytes, and of the longest request in words, 16 bits each.
pub const SETUP_LENGTHS: usize = 4;
/// The number of screens, the number of formats, and the byte order of pixels, 8 bits each.
const SETUP_COUNTS: usize = 5;
/// The code of the first key in the third byte, and that of the last in the fourth.
const SETUP_KEYS: usize = 6;
/// The vendor's name. The formats of pixels follow it, and those the screens.
const SETUP_VENDOR: usize = 8;
/// The byte order of pixels that frames have: little-endian.
const LEAST_FIRST: u32 = 0;
/// Bits of a pixel of a frame, shown or not.
const BITS_PER_PIXEL: u32 = 32;
/// Words of a format of pixels, of which the first has a byte each of depth and bits per pixel.
const PIXEL_FORMAT: usize = 2;

// Words of a screen.
/// Its root window.
const SCREEN_ROOT: usize = 0;
/// Its black pixel.
const SCREEN_BLACK: usize = 3;
/// Its width and height in pixels, 16 bits each.
const SCREEN_SIZE: usize = 5;
/// The depth of its root window: the bits of a pixel that are shown, in the third byte.
const SCREEN_DEPTH: usize = 9;

/// Bytes of a cookie.
const COOKIE: usize = 16;
/// What a client says first, before the cookie: little-endian, version 11.0, and the lengths and the name of the
/// method.
const HELLO: &[u8] = b"l\0\x0b\0\0\0\x12\0\x10\0\0\0MIT-MAGIC-COOKIE-1\0\0";
/// Words of the answer: the first byte says whether the server agrees, the last two say how many words follow.
const ANSWER: usize = 2;
const AGREED: u32 = 1;
/// An entry of an authority file from the display's number on, big-endian: it is for any display, and its cookie is of
/// zeros, which a server that wants no cookie ignores.
const LAST: &[u8] = b"\0\0\0\x12MIT-MAGIC-COOKIE-1\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
/// The same up to the cookie.
const ANY: &[u8] = LAST.split_at(LAST.len() - COOKIE).0;

/// Most words that are believed to follow a packet. A set-up has no more, and 255 keys of 255 symbols have fewer.
const MOST: usize = 0xffff;
/// How often the server is waited for: 5 s in all for the opening, and 5 s for each request of a frame. Waits are
/// counted rather than timed, so that a process that was stopped for a while gives up nothing.
pub const WAITS: u32 = 500;
/// The longest single wait, a hundredth of a second.
const WAIT: Timespec = Timespec { tv_sec: 0, tv_nsec: 10_000_000 };

/// Why there is no window: the server is silent, makes no sense, or has other pixels.
pub const UNFIT: &str = "no X server with 32 bits per pixel";
/// Why there is no window: the server accepts none of the cookies.
const REFUSED: &str = "the display refused access";

/// A connection.
pub struct Server {
    /// The socket, which never blocks.
    pub socket: OwnedFd,
    /// What the server says of itself, with zeros behind it: whatever lengths it names, their places exist.
    pub setup: Vec<u32>,
    /// The atoms `_NET_WM_STATE` and `_NET_WM_STATE_FULLSCREEN`.
    state: [u32; 2],
    /// Whether a window of ours fills the screen.
    fullscreen: bool,
    /// How often the server may still be waited for.
    pub waits: u32,
}

/// What the keys mean.
pub struct Keyboard {
    /// The symbols of all keys.
    symbols: Vec<u32>,
    /// The code of the first key.
    first: u32,
    /// The number of symbols per key.
    each: u32,
}

impl Keyboard {
    /// The first symbol of a key, given its code.
    #[inline(always)]
    pub fn symbol(&self, key: u32) -> Option<u32> {
        self.symbols.get(key.wrapping_sub(self.first).wrapping_mul(self.each) as usize).copied()
    }
}

impl Server {
    /// Connects to the server that `DISPLAY` names, trying each cookie that may be for it. Without success `why` has
    /// the reason, if one is known.
    pub fn find(why: &mut &'static str) -> Option<Server> {
        let environment = environment();
        let number = variable(environment, b"DISPLAY=:")?.split(|byte| *byte == b'.').next()?;
        let address = SocketAddrUnix::new(c_path(&fill("/tmp/.X11-unix/X%\0", &[number]))).ok()?;
        let authority = match variable(environment, b"XAUTHORITY=") {
            Some(path) => fill("%\0", &[path]),
            None => fill("%/.Xauthority\0", &[variable(environment, b"HOME=").unwrap_or_default()]),
        };
        // As `ANY`, but with the number of this display behind its length.
        let own = fill("\0%%\0\x12MIT-MAGIC-COOKIE-1\0\x10", &[&[number.len() as u8], number]).leak();
        let mut entries = contents(authority.leak());
        entries.extend_from_slice(LAST);
        let entries = entries.leak();
        let mut waits = WAITS;
        for at in 0..entries.len() {
            let rest = &entries[at..];
            if let Some(rest) = rest.strip_prefix(own).or(rest.strip_prefix(ANY))
                && let Some(cookie) = rest.get(..COOKIE)
            {
                let (mut server, agreed) = Server::greet(&address, cookie, waits, why)?;
                if agreed {
                    server.state = [server.atom(b"_NET_WM_STATE")?, server.atom(b"_NET_WM_STATE_FULLSCREEN")?];
                    return Some(server);
                }
                *why = REFUSED;
                waits = server.waits;
            }
        }
        None
    }

    /// Connects with a cookie, and says whether the server agrees.
    fn greet(address: &SocketAddrUnix, cookie: &[u8], waits: u32, why: &mut &'static str) -> Option<(Server, bool)> {
        let flags = SocketFlags::NONBLOCK | SocketFlags::CLOEXEC;
        let socket = socket_with(AddressFamily::UNIX, SocketType::STREAM, flags, None).ok()?;
        connect(&socket, address).ok()?;
        // The 64 kB build starts with this reason.
        if cfg!(feature = "minifb") {
            *why = UNFIT;
        }
        let mut server = Server { socket, setup: Vec::new(), state: [0; 2], fullscreen: false, waits };
        server.send_bytes(HELLO)?;
        server.send_bytes(cookie)?;
        server.setup = server.receive(ANSWER)?;
        let agreed = server.setup[0] & 255 == AGREED;
        if agreed {
            server.setup = server.receive((server.setup[1] >> 16) as usize)?;
        }
        Some((server, agreed))
    }

    /// Sends whole requests.
    pub fn send(&mut self, words: &[u32]) -> Option<()> {
        self.send_bytes(&bytes(words))
    }

    /// Sends all bytes.
    pub fn send_bytes(&mut self, mut bytes: &[u8]) -> Option<()> {
        while !bytes.is_empty() {
            bytes = &bytes[self.push(bytes)?..];
        }
        Some(())
    }

    /// Sends as many bytes as there is room for after one wait, and says how many.
    pub fn push(&mut self, bytes: &[u8]) -> Option<usize> {
        self.wait(PollFlags::OUT)?;
        // A server that has gone takes nothing, until there are no waits left.
        Some(write(&self.socket, bytes).unwrap_or(0))
    }

    /// Receives `count` words, of which 16 bits are believed. Zeros follow them, up to [`MOST`] words in all.
    pub fn receive(&mut self, count: usize) -> Option<Vec<u32>> {
        let (mut bytes, end, mut got) = (vec![0; 4 * MOST], 4 * (count & MOST), 0);
        while got < end {
            self.wait(PollFlags::IN)?;
            got += read(&self.socket, &mut bytes[got..end]).unwrap_or(0);
        }
        Some(bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }

    /// Waits until the socket can be read or written, but not for long. `None` when there are no waits left.
    fn wait(&mut self, what: PollFlags) -> Option<()> {
        self.waits = self.waits.checked_sub(1)?;
        let _ = poll(&mut [PollFd::new(&self.socket, what)], Some(&WAIT));
        Some(())
    }

    /// The number of an atom. Not to be called when events may come before the reply.
    pub fn atom(&mut self, name: &[u8]) -> Option<u32> {
        let length = name.len() as u32;
        self.send(&[request(INTERN_ATOM, 0, 2 + length.div_ceil(4)), length])?;
        self.send_bytes(name)?;
        self.send_bytes(&[0; 3][..name.len().wrapping_neg() % 4])?;
        Some(self.receive(PACKET)?[REPLY])
    }

    /// What the keys mean. Not to be called when events may come before the reply.
    #[inline(always)]
    pub fn keyboard(&mut self) -> Option<Keyboard> {
        let codes = self.setup[SETUP_KEYS];
        let (first, last) = (codes >> 16 & 255, codes >> 24);
        self.send(&[request(GET_KEYBOARD_MAPPING, 0, 2), first | (last + 1).wrapping_sub(first) << 8])?;
        // How many symbols each key has is in the second byte, how many words follow in the second word.
        let keyboard = self.receive(PACKET)?;
        Some(Keyboard { symbols: self.receive(keyboard[1] as usize)?, first, each: keyboard[0] >> 8 & 255 })
    }

    /// The root window, the black pixel and the depth (bits of a pixel that are shown) of the first screen, where its
    /// pixels have 32 bits, little-endian.
    pub fn screen(&self) -> Option<[u32; 3]> {
        let (formats, screen) = self.formats();
        let (order, depth) = (self.setup[SETUP_COUNTS] >> 16 & 255, screen[SCREEN_DEPTH] >> 16 & 255);
        let format = BITS_PER_PIXEL << 8 | depth;
        let fit = formats.chunks(PIXEL_FORMAT).any(|words| words[0] & 0xffff == format && order == LEAST_FIRST);
        fit.then_some([screen[SCREEN_ROOT], screen[SCREEN_BLACK], depth])
    }

    /// The formats of pixels, and the first screen with what follows it.
    pub fn formats(&self) -> (&[u32], &[u32]) {
        let (vendor, counts) = (self.setup[SETUP_LENGTHS] & 0xffff, self.setup[SETUP_COUNTS]);
        self.setup[SETUP_VENDOR + vendor.div_ceil(4) as usize..].split_at(PIXEL_FORMAT * (counts >> 8 & 255) as usize)
    }

    /// Where a window of `size` is to be, as left, top, width and height: in the middle of the screen, or all of it.
    pub fn place(&self, size: (usize, usize)) -> [u32; 4] {
        let area = self.formats().1[SCREEN_SIZE];
        let screen = [area & 0xffff, area >> 16];
        let [width, height] = if self.fullscreen { screen } else { [size.0 as u32, size.1 as u32] };
        [screen[0].saturating_sub(width) / 2, screen[1].saturating_sub(height) / 2, width, height]
    }

    /// Lets a window of ours fill the screen, or puts it back to `size`.
    pub fn toggle_fullscreen(&mut self, window: u32, size: (usize, usize)) {
        self.fullscreen = !self.fullscreen;
        let root = self.formats().1[SCREEN_ROOT];
        let ([state, fullscreen], [left, top, width, height]) = (self.state, self.place(size));
        self.waits = WAITS;
        // Errors are ignored: a lost display is noticed when the next frame is shown.
        let _ = self.send(&[
            // A message to the window manager, which listens at the root window: it adds the state (1) or removes it
            // (0).
            request(SEND_EVENT, 0, 11),
            root,
            TO_WINDOW_MANAGER,
            request(CLIENT_MESSAGE, BITS_32, 0),
            window,
            state,
            u32::from(self.fullscreen),
            fullscreen,
            0,
            FROM_APPLICATION,
            0,
            // Without a window manager any client may place a window. With one this comes too late to matter.
            request(CONFIGURE_WINDOW, 0, 7),
            window,
            PLACE_AND_SIZE,
            left,
            top,
            width,
            height,
        ]);
    }
}

/// Words as bytes.
pub fn bytes(words: &[u32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for word in words {
        bytes.extend_from_slice(&word.to_le_bytes());
    }
    bytes
}
