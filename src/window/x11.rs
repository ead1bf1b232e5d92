//! A window on this machine's X server, by the protocol itself ("X Window System Protocol", X.Org, version 11):
//! 1 kB packed, where minifb, Xlib's table of functions and what they take of the standard library are 6.
//!
//! A request is little-endian words of 32 bits: the first has its code, a byte of its own and its length in words.
//! Answers, events and errors are eight words; an answer may have more.

use super::{Press, TITLE};
use paprsek::tile::Frame;
use rustix::fs::{Mode, OFlags, open};
use rustix::io::{ioctl_fionread, read, write};
use rustix::net::{AddressFamily, RecvFlags, SocketAddrUnix, SocketType, connect, recv, socket};
use std::ffi::{CStr, CString};
use std::os::fd::OwnedFd;

/// Words of an answer, an event or an error.
const PACKET: usize = 8;
/// Words of a PutImage request before its pixels.
const HEAD: usize = 6;
/// Bytes of a cookie.
const COOKIE: usize = 16;
/// Longest time from the release to the press that the server makes up where a held key repeats, milliseconds.
const REPEAT: u32 = 20;

/// An open window.
pub struct Window {
    server: OwnedFd,
    /// The window; the next number is its graphics context.
    id: u32,
    /// Bits of a pixel that are shown.
    depth: u32,
    /// Longest request, words.
    longest: usize,
    /// Width and height, pixels.
    size: (usize, usize),
    /// The atom `WM_DELETE_WINDOW`.
    delete: u32,
    /// Symbols of the keys, the code of the first and how many each has.
    symbols: (Vec<u32>, u32, u32),
    /// Code of the key that was released last, and when, milliseconds.
    released: (u32, u32),
}

impl Window {
    /// Opens a window of `size`, in pixels; the error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        let window = find().and_then(|(server, setup)| Window::create(server, &setup, size));
        window.ok_or_else(|| "no X server with 32 bits a pixel".into())
    }

    /// The window, where the server has 32 bits a pixel, little-endian.
    fn create(server: OwnedFd, setup: &[u32], size: (usize, usize)) -> Option<Window> {
        let (id, lengths, counts, codes) = (setup[1], setup[4], setup[5], setup[6]);
        let (formats, screen) =
            setup[8 + (lengths & 0xffff).div_ceil(4) as usize..].split_at(2 * (counts >> 8 & 255) as usize);
        let (root, black, area, depth) = (screen[0], screen[3], screen[5], screen[9] >> 16 & 255);
        formats.chunks(2).find(|format| format[0] & 0xffff == (32 << 8 | depth) && counts >> 16 & 255 == 0)?;
        let (first, last) = (codes >> 16 & 255, codes >> 24);
        let mut window = Window {
            server,
            id,
            depth,
            longest: (lengths >> 16) as usize,
            size,
            delete: 0,
            symbols: (Vec::new(), first, 0),
            released: (0, 0),
        };
        let text = |bytes: &[u8; 4]| u32::from_le_bytes(*bytes);
        window.send(&[
            // InternAtom, twice.
            16 | 5 << 16,
            12,
            text(b"WM_P"),
            text(b"ROTO"),
            text(b"COLS"),
            16 | 6 << 16,
            16,
            text(b"WM_D"),
            text(b"ELET"),
            text(b"E_WI"),
            text(b"NDOW"),
            // GetKeyboardMapping
            101 | 2 << 16,
            first | (last + 1 - first) << 8,
        ])?;
        let protocols = window.receive(PACKET)?[2];
        window.delete = window.receive(PACKET)?[2];
        let keyboard = window.receive(PACKET)?;
        window.symbols = (window.receive(keyboard[1] as usize)?, first, keyboard[0] >> 8 & 255);
        let middle = |screen: u32, side: usize| (screen & 0xffff).saturating_sub(side as u32) / 2;
        let [context, pixmap, cursor, pen] = [id + 1, id + 2, id + 3, id + 4];
        let [name, end] = TITLE_WORDS;
        window.send(&[
            // CreatePixmap of one pixel of one bit, CreateGC of black, PolyFillRectangle.
            53 | 1 << 8 | 4 << 16,
            pixmap,
            root,
            1 | 1 << 16,
            55 | 4 << 16,
            pen,
            pixmap,
            0,
            70 | 5 << 16,
            pixmap,
            pen,
            0,
            1 | 1 << 16,
            // CreateCursor that shows nothing.
            93 | 8 << 16,
            cursor,
            pixmap,
            pixmap,
            0,
            0,
            0,
            0,
            // CreateWindow: no border, background, events (keys down and up, StructureNotify), cursor.
            1 | 11 << 16,
            id,
            root,
            middle(area, size.0) | middle(area >> 16, size.1) << 16,
            size.0 as u32 | (size.1 as u32) << 16,
            1 << 16,
            0,
            0x4802,
            black,
            0x20003,
            cursor,
            // CreateGC
            55 | 4 << 16,
            context,
            id,
            0,
            // ChangeProperty WM_NAME of STRING, WM_PROTOCOLS of ATOM.
            18 | 8 << 16,
            id,
            39,
            31,
            8,
            TITLE.len() as u32,
            name,
            end,
            18 | 7 << 16,
            id,
            protocols,
            4,
            32,
            1,
            window.delete,
            // MapWindow
            8 | 2 << 16,
            id,
        ])?;
        Some(window)
    }

    /// Shows a frame, as large as it fits.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        self.put(frame).ok_or_else(|| "the display went away".into())
    }

    fn put(&mut self, frame: &Frame) -> Option<()> {
        let (width, height) = self.size;
        let columns = (height * frame.width / frame.height).clamp(1, width);
        let rows = (width * frame.height / frame.width).clamp(1, height);
        let (left, top) = ((width - columns) / 2, (height - rows) / 2);
        // The nearest pixel, without a division for each.
        let sources = |count, of| (0..count).map(|place| place * of / count).collect::<Vec<_>>();
        let (across, down) = (sources(columns, frame.width), sources(rows, frame.height));
        let mut first = top;
        for band in down.chunks(((self.longest - HEAD) / columns).max(1)) {
            // PutImage of whole pixels.
            self.send(&[
                72 | 2 << 8 | ((HEAD + band.len() * columns) as u32) << 16,
                self.id,
                self.id + 1,
                columns as u32 | (band.len() as u32) << 16,
                left as u32 | (first as u32) << 16,
                self.depth << 8,
            ])?;
            first += band.len();
            let mut bytes = Vec::with_capacity(4 * band.len() * columns);
            for row in band {
                let line = &frame.pixels[row * frame.width..];
                for &column in &across {
                    bytes.extend_from_slice(&line[column].to_le_bytes());
                }
            }
            send(&self.server, &bytes)?;
        }
        Some(())
    }

    /// What has been asked for since the last call, one at a time; `None` when that was all.
    pub fn press(&mut self) -> Option<Press> {
        while ioctl_fionread(&self.server).ok()? >= 4 * PACKET as u64 {
            let event = self.receive(PACKET)?;
            let (key, time) = (event[0] >> 8 & 255, event[1]);
            match event[0] & 127 {
                // KeyPress
                2 => {
                    let (symbols, first, each) = &self.symbols;
                    // Held keys repeat: right for seeking, not for the pause.
                    let held = self.released.0 == key && time.wrapping_sub(self.released.1) < REPEAT;
                    match symbols.get(((key - first) * each) as usize) {
                        Some(0xff1b) => return Some(Press::Leave),
                        Some(0x20) if !held => return Some(Press::Pause),
                        Some(0xff51) => return Some(Press::Back),
                        Some(0xff53) => return Some(Press::Forward),
                        _ => {}
                    }
                }
                // KeyRelease
                3 => self.released = (key, time),
                // DestroyNotify: another client closed it.
                17 => return Some(Press::Leave),
                // ConfigureNotify
                22 => {
                    self.size = ((event[5] & 0xffff) as usize, (event[5] >> 16) as usize);
                    // ClearArea, of what was sent for another size.
                    self.send(&[61 | 4 << 16, self.id, 0, 0])?;
                }
                // ClientMessage
                33 if event[3] == self.delete => return Some(Press::Leave),
                _ => {}
            }
        }
        None
    }

    fn send(&self, words: &[u32]) -> Option<()> {
        let mut bytes = Vec::new();
        for word in words {
            bytes.extend_from_slice(&word.to_le_bytes());
        }
        send(&self.server, &bytes)
    }

    fn receive(&self, count: usize) -> Option<Vec<u32>> {
        receive(&self.server, count)
    }
}

/// The title, of up to eight bytes.
const TITLE_WORDS: [u32; 2] = {
    let mut words = [0; 2];
    let mut i = 0;
    while i < TITLE.len() {
        words[i / 4] |= (TITLE.as_bytes()[i] as u32) << (8 * (i % 4));
        i += 1;
    }
    words
};

/// Sends whole requests.
fn send(server: &OwnedFd, mut bytes: &[u8]) -> Option<()> {
    while !bytes.is_empty() {
        bytes = &bytes[write(server, bytes).ok()?..];
    }
    Some(())
}

/// Waits for words.
fn receive(server: &OwnedFd, count: usize) -> Option<Vec<u32>> {
    let mut bytes = vec![0; 4 * count];
    let (got, _) = recv(server, &mut *bytes, RecvFlags::WAITALL).ok()?;
    (got == bytes.len()).then(|| bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

/// The server that `DISPLAY` names, with what it says of itself. Each cookie that there is for it is tried.
fn find() -> Option<(OwnedFd, Vec<u32>)> {
    let environment = contents(c"/proc/self/environ");
    let variable = |name: &[u8]| environment.split(|byte| *byte == 0).find_map(|entry| entry.strip_prefix(name));
    let number = variable(b"DISPLAY=:")?.split(|byte| *byte == b'.').next()?;
    let address = SocketAddrUnix::new(&*CString::new([b"/tmp/.X11-unix/X", number].concat()).ok()?).ok()?;
    let authority = match variable(b"XAUTHORITY=") {
        Some(path) => path.to_vec(),
        None => [variable(b"HOME=").unwrap_or_default(), b"/.Xauthority"].concat(),
    };
    // Of an entry: number, method and cookie, each after its length, big-endian.
    let key = [&[0, number.len() as u8], number, b"\0\x12MIT-MAGIC-COOKIE-1\0\x10"].concat();
    let entries = contents(&CString::new(authority).ok()?);
    let cookies = entries.windows(key.len() + COOKIE).filter_map(|entry| entry.strip_prefix(&*key));
    // A server that wants none ignores it.
    cookies.chain([&[0; COOKIE][..]]).find_map(|cookie| greet(&address, cookie))
}

/// Connects, with a cookie, and gives what the server says of itself if it agrees.
fn greet(address: &SocketAddrUnix, cookie: &[u8]) -> Option<(OwnedFd, Vec<u32>)> {
    let server = socket(AddressFamily::UNIX, SocketType::STREAM, None).ok()?;
    connect(&server, address).ok()?;
    send(&server, &[b"l\0\x0b\0\0\0\x12\0\x10\0\0\0MIT-MAGIC-COOKIE-1\0\0", cookie].concat())?;
    let head = receive(&server, 2)?;
    let setup = receive(&server, (head[1] >> 16) as usize)?;
    (head[0] & 255 == 1).then_some((server, setup))
}

/// A file's first megabyte, which is all; nothing where it cannot be read.
fn contents(path: &CStr) -> Vec<u8> {
    let mut bytes = vec![0; 1 << 20];
    let file = open(path, OFlags::RDONLY, Mode::empty());
    let length = file.and_then(|file| read(file, &mut *bytes)).unwrap_or(0);
    bytes.truncate(length);
    bytes
}
