//! A window on this machine's X server, by the protocol itself ([`super::protocol`]): 1 kB packed, where minifb, Xlib's
//! table of functions and what they take of the standard library are 6.

use super::protocol::{PACKET, Server, UNFIT, WAITS, bytes};
use super::{BACK, FORWARD, LEAVE, TITLE};
use paprsek::frame::Frame;
use paprsek::frame::resample;
use rustix::io::read;
use std::array::from_fn;
use std::mem::take;

/// Words of a PutImage request before its pixels.
const HEAD: usize = 6;
/// Largest side of what is drawn, pixels: a frame's. In a larger window the picture is at its left upper corner, since X counts
/// pixels up to 32,767.
const MAX_SIDE: usize = 16384;
/// Most events that are heard at once, so that a server that never ends does not keep us.
const EVENTS: usize = 64;
/// Longest time from the release to the press that the server makes up where a held key repeats, milliseconds.
const REPEAT: u32 = 20;

/// An open window.
pub struct Window {
    server: Server,
    /// Bits of a pixel that are shown.
    depth: u32,
    /// Width and height, pixels, now and where it does not fill the screen.
    size: (usize, usize),
    usual: (usize, usize),
    /// The atom `WM_DELETE_WINDOW`.
    delete: u32,
    /// Symbols of the keys, the code of the first and how many each has.
    symbols: (Vec<u32>, u32, u32),
    /// Has the size changed since the last frame was sent?
    resized: bool,
    /// Code of the key that was released last, and when, milliseconds.
    released: (u32, u32),
    /// An event, and how many bytes of it have come.
    event: ([u8; 4 * PACKET], usize),
    /// The keys that wait for [`Window::press`].
    pressed: Vec<u32>,
}

impl Window {
    /// Opens a window of `size`, in pixels; the error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        let mut why = UNFIT;
        Server::find(&mut why).and_then(|server| Window::create(server, size)).ok_or_else(|| why.into())
    }

    /// The window, where the server has 32 bits a pixel, little-endian.
    fn create(mut server: Server, size: (usize, usize)) -> Option<Window> {
        let [root, black, depth] = server.screen()?;
        let (id, codes) = (server.setup[1], server.setup[6]);
        let (first, last) = (codes >> 16 & 255, codes >> 24);
        let (protocols, delete) = (server.atom(b"WM_PROTOCOLS")?, server.atom(b"WM_DELETE_WINDOW")?);
        // GetKeyboardMapping
        server.send(&[101 | 2 << 16, first | (last + 1).wrapping_sub(first) << 8])?;
        let keyboard = server.receive(PACKET)?;
        let symbols = (server.receive(keyboard[1] as usize)?, first, keyboard[0] >> 8 & 255);
        let [left, top, width, height] = server.place(size);
        let [context, pixmap, cursor, pen] = [id | 1, id | 2, id | 3, id | 4];
        let [name, end] = TITLE_WORDS;
        server.send(&[
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
            left | top << 16,
            width | height << 16,
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
            delete,
            // MapWindow
            8 | 2 << 16,
            id,
        ])?;
        Some(Window {
            server,
            depth,
            size,
            usual: size,
            delete,
            symbols,
            resized: false,
            released: (0, 0),
            event: ([0; _], 0),
            pressed: Vec::new(),
        })
    }

    /// Shows a frame, as large as it fits.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        self.put(frame).ok_or_else(|| "the display went away".into())
    }

    fn put(&mut self, frame: &Frame) -> Option<()> {
        // Pixels that the longest request has room for. A picture has a row at least of them, and no more rows.
        let room = ((self.server.setup[4] >> 16) as usize).saturating_sub(HEAD).clamp(1, MAX_SIDE);
        let size = (self.size.0.min(room), self.size.1.min(room));
        let (columns, count) = resample::fit(frame, size);
        let (left, top) = (size.0.saturating_sub(columns) / 2, size.1.saturating_sub(count) / 2);
        let id = self.server.setup[1];
        let band = room / columns;
        self.server.waits = WAITS;
        if take(&mut self.resized) {
            // ClearArea, of what was sent for another size.
            self.server.send(&[61 | 4 << 16, id, 0, 0])?;
        }
        for first in (0..count).step_by(band) {
            let rows = first..count.min(first + band);
            // PutImage of whole pixels.
            let mut request = bytes(&[
                72 | 2 << 8 | ((HEAD + rows.len() * columns) as u32) << 16,
                id,
                id | 1,
                columns as u32 | (rows.len() as u32) << 16,
                left as u32 | ((top + first) as u32) << 16,
                self.depth << 8,
            ]);
            request.extend_from_slice(&resample::rows(frame, columns, count, rows));
            self.server.waits = WAITS;
            let mut rest = &*request;
            while !rest.is_empty() {
                // However long all of it takes, Esc ends at once.
                self.listen()?;
                if self.pressed.contains(&LEAVE) {
                    return Some(());
                }
                rest = &rest[self.server.push(rest)?..];
            }
        }
        Some(())
    }

    /// Fills the screen, or does so no more.
    pub fn fill(&mut self) {
        self.server.fill(self.server.setup[1], self.usual);
    }

    /// The keys that have gone down since the last call, one at a time; `None` when those were all.
    pub fn press(&mut self) -> Option<u32> {
        // A lost display is noticed where the next frame is shown.
        let _ = self.listen();
        if self.pressed.is_empty() { None } else { Some(self.pressed.remove(0)) }
    }

    /// Hears what the server has said by now; `None` where it has hung up.
    fn listen(&mut self) -> Option<()> {
        for _ in 0..EVENTS {
            let (packet, got) = &mut self.event;
            match read(&self.server.socket, &mut packet[*got..]) {
                Ok(0) => return None,
                Ok(count) => *got += count,
                Err(_) => break,
            }
            if *got < packet.len() {
                break;
            }
            *got = 0;
            let event = packet.as_chunks().0;
            let event: [u32; PACKET] = from_fn(|at| u32::from_le_bytes(event[at]));
            let (key, time) = (event[0] >> 8 & 255, event[1]);
            match event[0] & 127 {
                // KeyPress
                2 => {
                    let (symbols, first, each) = &self.symbols;
                    let place = key.wrapping_sub(*first).wrapping_mul(*each);
                    let held = self.released.0 == key && time.wrapping_sub(self.released.1) < REPEAT;
                    if let Some(&symbol) = symbols.get(place as usize)
                        && (!held || matches!(symbol, BACK | FORWARD))
                    {
                        self.pressed.push(symbol);
                    }
                }
                // KeyRelease
                3 => self.released = (key, time),
                // DestroyNotify: another client closed it.
                17 => self.pressed.push(LEAVE),
                // ConfigureNotify
                22 => {
                    self.size = ((event[5] & 0xffff) as usize, (event[5] >> 16) as usize);
                    self.resized = true;
                }
                // ClientMessage
                33 if event[3] == self.delete => self.pressed.push(LEAVE),
                _ => {}
            }
        }
        Some(())
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
