//! A window on this machine's X server by the protocol itself ([`super::protocol`]). It takes 1 kB packed, where
//! minifb, Xlib's table of functions and what they take of the standard library are 6.

use super::common::{TITLE, keysym};
use super::protocol::{
    BITS_32, CLIENT_MESSAGE, CREATE_GC, EVENT_CODE, KEY_PRESS, Keyboard, PACKET, SETUP_ID, Server, UNFIT, request,
};
use super::put::{Surface, Target, put};
use paprsek::frame::Frame;
use rustix::io::read;
use std::array::from_fn;
use std::mem::take;

// Codes of requests (X11/Xproto.h).
const CREATE_WINDOW: u32 = 1;
const MAP_WINDOW: u32 = 8;
const CHANGE_PROPERTY: u32 = 18;
const CREATE_PIXMAP: u32 = 53;
const POLY_FILL_RECTANGLE: u32 = 70;
const CREATE_CURSOR: u32 = 93;

const KEY_RELEASE: u32 = 3;
const DESTROY_NOTIFY: u32 = 17;
const CONFIGURE_NOTIFY: u32 = 22;

// Words of events.
/// When a key was pressed or released, milliseconds.
const KEY_TIME: usize = 1;
/// The new width and height of the window, 16 bits each.
const CONFIGURED_SIZE: usize = 5;
/// What a message says.
const MESSAGE: usize = 3;

// Atoms that every server has: two types of properties, and the property that is the title.
const ATOM: u32 = 4;
const STRING: u32 = 31;
const WM_NAME: u32 = 39;

/// The size of the letters of a property.
const BITS_8: u32 = 8;
/// What is set when a window is created: background, events and cursor.
const BACKGROUND_EVENTS_CURSOR: u32 = 1 << 1 | 1 << 11 | 1 << 14;
/// The events that are heard: key down, key up, and what happens to the window (StructureNotify).
const EVENTS: u32 = 1 | 1 << 1 | 1 << 17;
/// Width and height of one pixel.
const ONE_PIXEL: u32 = 1 | 1 << 16;

// What is added to the window's number for what belongs to it.
/// The graphics context that frames are put with.
const CONTEXT: u32 = 1;
/// The picture and the mask of the cursor.
const PIXMAP: u32 = 2;
/// The cursor.
const CURSOR: u32 = 3;
/// The graphics context that draws the cursor's picture.
const PEN: u32 = 4;

/// Most events that are heard at once, so that a server that never stops talking does not keep us.
const EVENTS_AT_ONCE: usize = 64;
/// Longest time from the release to the press that the server makes up while a held key repeats, milliseconds.
const REPEAT: u32 = 20;

/// An open window.
pub struct Window {
    server: Server,
    /// Bits of a pixel that are shown.
    depth: u32,
    /// Width and height at present, pixels.
    size: (usize, usize),
    /// Width and height where the window does not fill the screen, pixels.
    usual: (usize, usize),
    /// The atom `WM_DELETE_WINDOW`.
    delete: u32,
    /// What the keys mean.
    keyboard: Keyboard,
    /// Whether the size has changed since the last frame was sent.
    resized: bool,
    /// The code of the key that was released last, and when, milliseconds.
    released: (u32, u32),
    /// An event, and how many of its bytes have come.
    event: ([u8; 4 * PACKET], usize),
    /// The symbols of keys that wait for [`Window::next_key`].
    pressed: Vec<u32>,
}

impl Window {
    /// Opens a window of `size`, width and height in pixels. The error says why there is none.
    pub fn open(size: (usize, usize)) -> Result<Window, String> {
        let mut why = UNFIT;
        Server::find(&mut why).and_then(|server| Window::create(server, size)).ok_or_else(|| why.into())
    }

    /// The window, where the server has 32 bits per pixel, little-endian.
    fn create(mut server: Server, size: (usize, usize)) -> Option<Window> {
        let [root, black, depth] = server.screen()?;
        let id = server.setup[SETUP_ID];
        let (protocols, delete) = (server.atom(b"WM_PROTOCOLS")?, server.atom(b"WM_DELETE_WINDOW")?);
        let keyboard = server.keyboard()?;
        let [left, top, width, height] = server.place(size);
        let [context, pixmap, cursor, pen] = [id | CONTEXT, id | PIXMAP, id | CURSOR, id | PEN];
        let [name, end] = TITLE_WORDS;
        server.send(&[
            // A cursor that shows nothing: its picture and its mask are one black pixel of one bit.
            request(CREATE_PIXMAP, 1, 4),
            pixmap,
            root,
            ONE_PIXEL,
            request(CREATE_GC, 0, 4),
            pen,
            pixmap,
            0,
            request(POLY_FILL_RECTANGLE, 0, 5),
            pixmap,
            pen,
            0,
            ONE_PIXEL,
            request(CREATE_CURSOR, 0, 8),
            cursor,
            pixmap,
            pixmap,
            0,
            0,
            0,
            0,
            // The window, of the root's depth and without a border (the 1 is its class, InputOutput).
            request(CREATE_WINDOW, 0, 11),
            id,
            root,
            left | top << 16,
            width | height << 16,
            1 << 16,
            0,
            BACKGROUND_EVENTS_CURSOR,
            black,
            EVENTS,
            cursor,
            // What its pictures are put with.
            request(CREATE_GC, 0, 4),
            context,
            id,
            0,
            // Its title.
            request(CHANGE_PROPERTY, 0, 8),
            id,
            WM_NAME,
            STRING,
            BITS_8,
            TITLE.len() as u32,
            name,
            end,
            // A window manager is to ask for the end, not to cut the connection.
            request(CHANGE_PROPERTY, 0, 7),
            id,
            protocols,
            ATOM,
            BITS_32,
            1,
            delete,
            request(MAP_WINDOW, 0, 2),
            id,
        ])?;
        Some(Window {
            server,
            depth,
            size,
            usual: size,
            delete,
            keyboard,
            resized: false,
            released: (0, 0),
            event: ([0; _], 0),
            pressed: Vec::new(),
        })
    }

    /// Shows a frame, as large as it fits into the window at its own aspect.
    pub fn show(&mut self, frame: &Frame) -> Result<(), String> {
        put(self, frame).ok_or_else(|| "the display went away".into())
    }

    /// Fills the screen, or goes back to the usual size.
    pub fn toggle_fullscreen(&mut self) {
        self.server.toggle_fullscreen(self.server.setup[SETUP_ID], self.usual);
    }

    /// Closes the window: the server does, once the process has ended.
    #[inline(always)]
    pub fn close(self) {}

    /// The next key that has gone down, as a [`keysym`]; `None` when there are no more.
    pub fn next_key(&mut self) -> Option<u32> {
        // A lost display is noticed when the next frame is shown.
        let _ = self.listen();
        if self.pressed.is_empty() { None } else { Some(self.pressed.remove(0)) }
    }

    /// Hears what the server has said by now. `None` where it has hung up.
    fn listen(&mut self) -> Option<()> {
        for _ in 0..EVENTS_AT_ONCE {
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
            let (key, time) = (event[0] >> 8 & 255, event[KEY_TIME]);
            match event[0] & EVENT_CODE {
                KEY_PRESS => {
                    let held = self.released.0 == key && time.wrapping_sub(self.released.1) < REPEAT;
                    if let Some(symbol) = self.keyboard.symbol(key)
                        && (!held || matches!(symbol, keysym::LEFT | keysym::RIGHT))
                    {
                        self.pressed.push(symbol);
                    }
                }
                KEY_RELEASE => self.released = (key, time),
                // Another client has closed the window.
                DESTROY_NOTIFY => self.pressed.push(keysym::ESCAPE),
                CONFIGURE_NOTIFY => {
                    let size = event[CONFIGURED_SIZE];
                    self.size = ((size & 0xffff) as usize, (size >> 16) as usize);
                    self.resized = true;
                }
                CLIENT_MESSAGE if event[MESSAGE] == self.delete => self.pressed.push(keysym::ESCAPE),
                _ => {}
            }
        }
        Some(())
    }
}

impl Surface for Window {
    #[inline(always)]
    fn server(&mut self) -> &mut Server {
        &mut self.server
    }

    #[inline(always)]
    fn target(&self) -> Target {
        let id = self.server.setup[SETUP_ID];
        Target { window: id, context: id | CONTEXT, depth: self.depth, size: self.size }
    }

    #[inline(always)]
    fn take_resized(&mut self) -> bool {
        take(&mut self.resized)
    }

    #[inline(always)]
    fn leaves(&mut self) -> Option<bool> {
        self.listen()?;
        Some(self.pressed.contains(&keysym::ESCAPE))
    }
}

/// The title as words: up to eight bytes, and zeros.
const TITLE_WORDS: [u32; 2] = {
    let mut words = [0; 2];
    let mut i = 0;
    while i < TITLE.len() {
        words[i / 4] |= (TITLE.as_bytes()[i] as u32) << (8 * (i % 4));
        i += 1;
    }
    words
};
