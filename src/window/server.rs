//! This machine's X server by the protocol itself ("X Window System Protocol", X.Org, version 11), and how a window fills
//! its screen: `Extended Window Manager Hints` (freedesktop.org, version 1.5) where there is a window manager.
//!
//! A request is little-endian words of 32 bits: the first has its code, a byte of its own and its length in words.
//! Answers, events and errors are eight words; an answer may have more.

use crate::output::{contents, fill, named};
use rustix::io::write;
use rustix::net::{AddressFamily, RecvFlags, SocketAddrUnix, SocketType, connect, recv, socket};
use std::os::fd::OwnedFd;

/// Words of an answer, an event or an error.
pub const PACKET: usize = 8;
/// Bytes of a cookie.
const COOKIE: usize = 16;

/// A connection.
pub struct Server {
    /// The socket.
    pub socket: OwnedFd,
    /// What the server says of itself.
    pub setup: Vec<u32>,
    /// The atoms `_NET_WM_STATE` and `_NET_WM_STATE_FULLSCREEN`.
    state: [u32; 2],
    /// Does a window of ours fill the screen?
    full: bool,
}

impl Server {
    /// The server that `DISPLAY` names. Each cookie that there is for it is tried.
    pub fn find() -> Option<Server> {
        let environment = contents(b"/proc/self/environ\0");
        let variable = |name: &[u8]| environment.split(|byte| *byte == 0).find_map(|entry| entry.strip_prefix(name));
        let number = variable(b"DISPLAY=:")?.split(|byte| *byte == b'.').next()?;
        let address = SocketAddrUnix::new(named(&fill("/tmp/.X11-unix/X%\0", &[number]))).ok()?;
        let authority = match variable(b"XAUTHORITY=") {
            Some(path) => fill("%\0", &[path]),
            None => fill("%/.Xauthority\0", &[variable(b"HOME=").unwrap_or_default()]),
        };
        // Of an entry: number, method and cookie, each after its length, big-endian.
        let key = fill("%%\0\x12MIT-MAGIC-COOKIE-1\0\x10", &[&[0, number.len() as u8], number]);
        let entries = contents(&authority);
        let cookies = entries.windows(key.len() + COOKIE).filter_map(|entry| entry.strip_prefix(&*key));
        // A server that wants none ignores it.
        let mut server = cookies.chain([&[0; COOKIE][..]]).find_map(|cookie| greet(&address, cookie))?;
        server.state = [server.atom(b"_NET_WM_STATE")?, server.atom(b"_NET_WM_STATE_FULLSCREEN")?];
        Some(server)
    }

    /// Sends whole requests.
    pub fn send(&self, words: &[u32]) -> Option<()> {
        let mut bytes = Vec::new();
        for word in words {
            bytes.extend_from_slice(&word.to_le_bytes());
        }
        self.send_bytes(&bytes)
    }

    /// The same of bytes.
    pub fn send_bytes(&self, mut bytes: &[u8]) -> Option<()> {
        while !bytes.is_empty() {
            bytes = &bytes[write(&self.socket, bytes).ok()?..];
        }
        Some(())
    }

    /// Waits for words.
    pub fn receive(&self, count: usize) -> Option<Vec<u32>> {
        let mut bytes = vec![0; 4 * count];
        let (got, _) = recv(&self.socket, &mut *bytes, RecvFlags::WAITALL).ok()?;
        (got == bytes.len()).then(|| bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
    }

    /// The number of an atom. Not where events may come before the answer.
    pub fn atom(&self, name: &[u8]) -> Option<u32> {
        let length = name.len() as u32;
        // InternAtom
        self.send(&[16 | (2 + length.div_ceil(4)) << 16, length])?;
        self.send_bytes(name)?;
        self.send_bytes(&[0; 3][..name.len().wrapping_neg() % 4])?;
        Some(self.receive(PACKET)?[2])
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

/// Connects, with a cookie, and gives the server if it agrees.
fn greet(address: &SocketAddrUnix, cookie: &[u8]) -> Option<Server> {
    let socket = socket(AddressFamily::UNIX, SocketType::STREAM, None).ok()?;
    connect(&socket, address).ok()?;
    let mut server = Server { socket, setup: Vec::new(), state: [0; 2], full: false };
    server.send_bytes(&fill("l\0\x0b\0\0\0\x12\0\x10\0\0\0MIT-MAGIC-COOKIE-1\0\0%", &[cookie]))?;
    let head = server.receive(2)?;
    server.setup = server.receive((head[1] >> 16) as usize)?;
    (head[0] & 255 == 1).then_some(server)
}
