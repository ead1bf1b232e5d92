//! The authority file: any bytes, and files of many entries, whose fitting cookies all have to be tried in their order.

use crate::display::Display;
use crate::input::Input;
use crate::window::protocol::Server;
use std::fs;
use std::time::{Duration, Instant};

/// What the server says to each cookie: no.
const REFUSAL: &[u8] = b"\0\x0c\x0b\0\0\0\x03\0no such luck";
/// The method of cookies that X servers use.
const METHOD: &[u8] = b"MIT-MAGIC-COOKIE-1";
/// Where the cookie is in what a client says: behind 12 bytes, and the method in whole words.
const COOKIE_AT: usize = 32;
/// Bytes of a cookie.
const COOKIE: usize = 16;
/// Most entries: each takes some of the 500 waits that there are for all.
const ENTRIES: usize = 40;
/// Longest time with a server that answers at once.
const LONG: Duration = Duration::from_secs(4);

pub fn run(bytes: &[u8]) {
    let display = Display::get();
    let input = &mut Input::new(bytes);
    let (file, fitting) = if input.flag() { (bytes.to_vec(), Vec::new()) } else { entries(input, &display.number) };
    fs::write(&display.authority, file).unwrap();
    display.server.says(REFUSAL);
    let began = Instant::now();
    let mut why = "";
    assert!(Server::find(&mut why).is_none(), "a refusal is taken for a welcome");
    assert!(began.elapsed() < LONG, "{:?}", began.elapsed());
    let heard = display.server.heard();
    let mut tried = heard.iter().filter_map(|said| said.get(COOKIE_AT..)?.first_chunk::<COOKIE>());
    // Bytes of an entry may look like another, so there may be more.
    for cookie in &fitting {
        assert!(tried.any(|tried| tried == cookie), "a cookie was not tried: {cookie:?}");
    }
}

/// A file of entries as Xlib writes them, and the cookies among them that fit this display.
fn entries(input: &mut Input, own: &str) -> (Vec<u8>, Vec<[u8; COOKIE]>) {
    let (mut file, mut fitting) = (Vec::new(), Vec::new());
    while !input.is_empty() && fitting.len() < ENTRIES {
        let family = input.one_of(&[[0xff, 0xff], [1, 0], [0, 0]]);
        let address = vec![b'h'; input.below(9)];
        let number = input.one_of(&["", own, "0", "1", "10000000"]);
        let method = input.one_of(&[METHOD, METHOD, b"XDM-AUTHORIZATION-1", b""]);
        let length = input.one_of(&[COOKIE, COOKIE, COOKIE, 8, 0, 255]);
        let cookie: Vec<u8> = (0..length).map(|_| input.byte()).collect();
        file.extend(family);
        for part in [&address, number.as_bytes(), method, &cookie] {
            file.extend((part.len() as u16).to_be_bytes());
            file.extend(part);
        }
        if let Ok(cookie) = cookie.try_into()
            && method == METHOD
            && (number.is_empty() || number == own)
        {
            fitting.push(cookie);
        }
    }
    (file, fitting)
}
