//! Hears Esc while a call into Xlib lasts.
//!
//! Xlib waits for its display in the middle of a call, or sends it a large picture, and hears no key meanwhile. But
//! several clients may hear the keys of one window. So a thread listens over a connection of our own, on which nothing
//! else is ever sent.

use super::common::keysym;
use super::patience;
use super::protocol::{EVENT_CODE, KEY_PRESS, PACKET, Server, request};
use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::{Errno, read};
use std::thread;

/// The code of a request (X11/Xproto.h).
const CHANGE_WINDOW_ATTRIBUTES: u32 = 2;
/// What is changed: the events that this client hears.
const EVENTS: u32 = 1 << 11;
/// The event that is heard: key down.
const KEY_DOWN: u32 = 1;

/// Listens to that window's keys. Over a network, and where there is no thread or connection to spare, Xlib alone hears
/// them.
pub fn listen(window: u32) {
    let _ = thread::Builder::new().spawn(move || {
        let _ = hear(window);
    });
}

/// Listens until the display goes away.
fn hear(window: u32) -> Option<()> {
    let mut server = Server::find(&mut "")?;
    let keyboard = server.keyboard()?;
    server.send(&[request(CHANGE_WINDOW_ATTRIBUTES, 0, 4), window, EVENTS, KEY_DOWN])?;
    let (mut event, mut got) = ([0; 4 * PACKET], 0);
    loop {
        let _ = poll(&mut [PollFd::new(&server.socket, PollFlags::IN)], None);
        match read(&server.socket, &mut event[got..]) {
            Ok(0) => return None,
            Ok(count) => got += count,
            Err(Errno::AGAIN | Errno::INTR) => {}
            Err(_) => return None,
        }
        if got == event.len() {
            got = 0;
            let [code, key] = [event[0], event[1]].map(u32::from);
            if code & EVENT_CODE == KEY_PRESS && keyboard.symbol(key) == Some(keysym::ESCAPE) {
                patience::leave();
            }
        }
    }
}
