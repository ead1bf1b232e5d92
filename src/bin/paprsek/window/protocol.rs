//! This machine's X server by the protocol itself ("X Window System Protocol", X.Org, version 11), and how a window fills
//! its screen: `Extended Window Manager Hints` (freedesktop.org, version 1.5) where there is a window manager.
//!
//! A request is little-endian words of 32 bits: the first has its code, a byte of its own and its length in words.
//! Answers, events and errors are eight words; an answer may have more.

use crate::io::{contents, fill, named};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{read, write};
use rustix::net::{AddressFamily, SocketAddrUnix, SocketFlags, SocketType, connect, socket_with};
use std::os::fd::OwnedFd;

/// Words of an answer, an event or an error.
pub const PACKET: usize = 8;
/// Bytes of a cookie.
const COOKIE: usize = 16;
/// An entry of the authority file from the display's number on, big-endian: for any display, and with the cookie that a server
/// ignores that wants none.
const LAST: &[u8] = b"\0\0\0\x12MIT-MAGIC-COOKIE-1\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
/// The same without the cookie.
const ANY: &[u8] = LAST.split_at(LAST.len() - COOKIE).0;
/// Most words that an answer may have after its packet, against a server that says anything: a set-up has no more, and 255
/// keys of 255 symbols have less.
const MOST: usize = 0xffff;
/// How often the server is waited for, a hundredth of a second at most: 5 s for the whole of the opening, and for each
/// request of a frame. Counted and not timed, so that a process that was stopped for long gives up nothing.
pub const WAITS: u32 = 500;
const WAIT: Timespec = Timespec { tv_sec: 0, tv_nsec: 10_000_000 };

/// Why there is no window: the server is silent, makes no sense, or has other pixels; or it wants another cookie.
pub const UNFIT: &str = "no X server with 32 bits a pixel";
const REFUSED: &str = "the display refused us";

/// A connection.
pub struct Server {
    /// The socket, which never blocks.
    pub socket: OwnedFd,
    /// What the server says of itself: whatever lengths it names, all places are there.
    pub setup: Vec<u32>,
    /// The atoms `_NET_WM_STATE` and `_NET_WM_STATE_FULLSCREEN`.
    state: [u32; 2],
    /// Does a window of ours fill the screen?
    full: bool,
    /// How often it may be waited for.
    pub waits: u32,
}

impl Server {
    /// The server that `DISPLAY` names; else `why` is what has come between. Each cookie that may be for it is tried.
    pub fn find(why: &mut &'static str) -> Option<Server> {
        // What is read for it stays: to drop it would be code.
        let environment = contents(b"/proc/self/environ\0").leak();
        let variable = |name: &[u8]| environment.split(|byte| *byte == 0).find_map(|entry| entry.strip_prefix(name));
        let number = variable(b"DISPLAY=:")?.split(|byte| *byte == b'.').next()?;
        let address = SocketAddrUnix::new(named(&fill("/tmp/.X11-unix/X%\0", &[number]))).ok()?;
        let authority = match variable(b"XAUTHORITY=") {
            Some(path) => fill("%\0", &[path]),
            None => fill("%/.Xauthority\0", &[variable(b"HOME=").unwrap_or_default()]),
        };
        // The same with the number of this display, after its length.
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

    /// Connects, with a cookie, and hears whether the server agrees.
    fn greet(address: &SocketAddrUnix, cookie: &[u8], waits: u32, why: &mut &'static str) -> Option<(Server, bool)> {
        let flags = SocketFlags::NONBLOCK | SocketFlags::CLOEXEC;
        let socket = socket_with(AddressFamily::UNIX, SocketType::STREAM, flags, None).ok()?;
        connect(&socket, address).ok()?;
        // In the 64 kB build it is that already.
        if cfg!(feature = "minifb") {
            *why = UNFIT;
        }
        let mut server = Server { socket, setup: Vec::new(), state: [0; 2], full: false, waits };
        server.send_bytes(b"l\0\x0b\0\0\0\x12\0\x10\0\0\0MIT-MAGIC-COOKIE-1\0\0")?;
        server.send_bytes(cookie)?;
        server.setup = server.receive(2)?;
        let agreed = server.setup[0] & 255 == 1;
        if agreed {
            server.setup = server.receive((server.setup[1] >> 16) as usize)?;
        }
        Some((server, agreed))
    }

    /// Sends whole requests.
    pub fn send(&mut self, words: &[u32]) -> Option<()> {
        self.send_bytes(&bytes(words))
    }

    /// The same of bytes.
    pub fn send_bytes(&mut self, mut bytes: &[u8]) -> Option<()> {
        while !bytes.is_empty() {
            bytes = &bytes[self.push(bytes)?..];
        }
        Some(())
    }

    /// Sends what there is room for within one wait.
    pub fn push(&mut self, bytes: &[u8]) -> Option<usize> {
        self.wait(PollFlags::OUT)?;
        // A server that has gone takes nothing, until there are no waits left.
        Some(write(&self.socket, bytes).unwrap_or(0))
    }

    /// Waits for words, of whose count 16 bits are believed; behind them are zeros, [`MOST`] in all.
    pub fn receive(&mut self, count: usize) -> Option<Vec<u32>> {
        let (mut bytes, end, mut got) = (vec![0; 4 * MOST], 4 * (count & MOST), 0);
        while got < end {
            self.wait(PollFlags::IN)?;
            got += read(&self.socket, &mut bytes[got..end]).unwrap_or(0);
        }
        Some(bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }

    /// Waits until it can be read or written, but not for long.
    fn wait(&mut self, what: PollFlags) -> Option<()> {
        self.waits = self.waits.checked_sub(1)?;
        let _ = poll(&mut [PollFd::new(&self.socket, what)], Some(&WAIT));
        Some(())
    }

    /// The number of an atom. Not where events may come before the answer.
    pub fn atom(&mut self, name: &[u8]) -> Option<u32> {
        let length = name.len() as u32;
        // InternAtom
        self.send(&[16 | (2 + length.div_ceil(4)) << 16, length])?;
        self.send_bytes(name)?;
        self.send_bytes(&[0; 3][..name.len().wrapping_neg() % 4])?;
        Some(self.receive(PACKET)?[2])
    }

    /// Root window, black and bits that are shown, of the first screen, where it has 32 bits a pixel, little-endian.
    pub fn screen(&self) -> Option<[u32; 3]> {
        let (formats, screen) = self.formats();
        let (order, depth) = (self.setup[5] >> 16 & 255, screen[9] >> 16 & 255);
        let fit = formats.chunks(2).any(|format| format[0] & 0xffff == (32 << 8 | depth) && order == 0);
        fit.then_some([screen[0], screen[3], depth])
    }

    /// Formats of pixels, two words each, and the first screen.
    pub fn formats(&self) -> (&[u32], &[u32]) {
        let (vendor, counts) = (self.setup[4] & 0xffff, self.setup[5]);
        self.setup[8 + vendor.div_ceil(4) as usize..].split_at(2 * (counts >> 8 & 255) as usize)
    }

    /// Where a window of `size` is, left, top, width and height: in the middle of the screen, or all of it.
    pub fn place(&self, size: (usize, usize)) -> [u32; 4] {
        let area = self.formats().1[5];
        let screen = [area & 0xffff, area >> 16];
        let [width, height] = if self.full { screen } else { [size.0 as u32, size.1 as u32] };
        [screen[0].saturating_sub(width) / 2, screen[1].saturating_sub(height) / 2, width, height]
    }

    /// Lets the window of ours fill the screen, or puts it back to `size`.
    pub fn fill(&mut self, window: u32, size: (usize, usize)) {
        self.full = !self.full;
        let root = self.formats().1[0];
        let ([state, fullscreen], [left, top, width, height]) = (self.state, self.place(size));
        self.waits = WAITS;
        // A lost display is noticed where the next frame is shown.
        let _ = self.send(&[
            // SendEvent to the root window, where the window manager listens: ClientMessage, which adds the state or
            // removes it, from an application.
            25 | 11 << 16,
            root,
            0x180000,
            33 | 32 << 8,
            window,
            state,
            u32::from(self.full),
            fullscreen,
            0,
            1,
            0,
            // ConfigureWindow, for where there is none; with one it comes too late to matter for a full screen.
            12 | 7 << 16,
            window,
            15,
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
