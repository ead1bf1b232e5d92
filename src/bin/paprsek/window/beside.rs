//! A connection of our own beside minifb's, for what minifb cannot do: it fills the screen, and puts frames into a window
//! that is too large for minifb.

use super::patience;
use super::protocol::{CREATE_GC, PACKET, SETUP_ID, Server, request};
use super::put::{Surface, Target, put};
use paprsek::frame::Frame;
use rustix::io::read;
use std::mem::replace;

/// Events and errors that are read at once: nothing depends on them.
const SCRAP: usize = 64 * 4 * PACKET;

/// The connection, and the window that it serves.
pub struct Beside {
    server: Server,
    target: Target,
    resized: bool,
}

impl Beside {
    /// Connects for that window. `None` where the X server is not one of this machine.
    pub fn open(window: u32) -> Option<Beside> {
        let mut server = Server::find(&mut "")?;
        // minifb's window has the root's depth too.
        let [_, _, depth] = server.screen()?;
        let context = server.setup[SETUP_ID];
        server.send(&[request(CREATE_GC, 0, 4), context, window, 0])?;
        Some(Beside { server, target: Target { window, context, depth, size: (0, 0) }, resized: true })
    }

    /// Lets the window fill the screen, or puts it back to `usual`, width and height in pixels.
    pub fn toggle_fullscreen(&mut self, usual: (usize, usize)) {
        self.server.toggle_fullscreen(self.target.window, usual);
    }

    /// Puts a frame into the window, which has that width and height in pixels, or begins to: Esc ends it. `None` where
    /// the display is lost.
    pub fn show(&mut self, frame: &Frame, size: (usize, usize)) -> Option<()> {
        self.resized |= replace(&mut self.target.size, size) != size;
        put(self, frame)
    }

    /// To be told when minifb has put a frame there.
    pub fn forget(&mut self) {
        self.resized = true;
    }
}

impl Surface for Beside {
    fn server(&mut self) -> &mut Server {
        &mut self.server
    }

    fn target(&self) -> Target {
        Target { ..self.target }
    }

    fn take_resized(&mut self) -> bool {
        replace(&mut self.resized, false)
    }

    /// Keys are heard by another connection (`ears.rs`).
    fn leaves(&mut self) -> Option<bool> {
        match read(&self.server.socket, &mut [0; SCRAP]) {
            Ok(0) => None,
            _ => Some(patience::is_leaving()),
        }
    }
}
