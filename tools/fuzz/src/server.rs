//! An X server that says anything: set-up, answers, events and errors, over a true socket.

use crate::display::Display;
use crate::window::protocol::Server;
use crate::window::x11::Window;
use paprsek::frame::Frame;
use std::fs;
use std::time::{Duration, Instant};

/// Words that follow each packet in memory, whatever length it names.
const WORDS: usize = 0xffff;
/// Longest time with a server that says all at once and then hangs up. A silent one would be left after 5 s.
const LONG: Duration = Duration::from_secs(4);
/// Most keys that are taken.
const KEYS: usize = 1000;

/// A set-up reply that agrees: one screen of 640x480 in 24 bits, 32 bits per pixel; and the answers that the intro asks
/// for, up to the keyboard. `replay` begins with it.
pub fn polite() -> Vec<u8> {
    let setup: [u32; 28] = [
        1,
        0x400000,
        0x1fffff,
        256,
        4 | 0xffff << 16,
        1 | 1 << 8,
        32 | 32 << 8 | 8 << 16 | 255 << 24,
        0,
        u32::from_le_bytes(*b"fuzz"),
        24 | 32 << 8 | 32 << 16,
        0,
        0x100,
        0x101,
        0xffffff,
        0,
        0,
        640 | 480 << 16,
        170 | 127 << 16,
        1 | 1 << 16,
        0x102,
        24 << 16 | 1 << 24,
        24 | 1 << 16,
        0,
        0x102,
        4 | 8 << 8 | 256 << 16,
        0xff0000,
        0xff00,
        0xff,
    ];
    let mut words = vec![1 | 11 << 16, (setup.len() as u32) << 16];
    words.extend(setup);
    // Four atoms, and a keyboard of one symbol per key.
    for atom in 1..5 {
        words.extend([1 | atom << 16, 0, 300 + atom, 0, 0, 0, 0, 0]);
    }
    words.extend([1 | 1 << 8 | 5 << 16, 248, 0, 0, 0, 0, 0, 0]);
    words.extend((0..248).map(|key| if key == 1 { 0xff1b } else { 0x61 + key % 26 }));
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

pub fn run(bytes: &[u8]) {
    let display = Display::get();
    let _ = fs::remove_file(&display.authority);
    // The first byte says how much of a polite beginning there is.
    let Some((&beginning, rest)) = bytes.split_first() else { return };
    let polite = polite();
    let kept = if beginning < 128 { polite.len() } else { polite.len() * usize::from(beginning - 128) / 128 };
    display.server.says(&[&polite[..kept], rest].concat());
    let began = Instant::now();
    let mut why = "";
    if let Some(mut server) = Server::find(&mut why) {
        assert_eq!(server.setup.len(), WORDS);
        let (formats, screen) = server.formats();
        assert!(formats.len() <= 2 * 255 && screen.len() > 9);
        let [left, top, width, height] = server.place((320, 180));
        assert!(left <= 0xffff && top <= 0xffff && (width, height) == (320, 180));
        if server.screen().is_some()
            && let Some(keyboard) = server.keyboard()
        {
            for key in 0..256 {
                let _ = keyboard.symbol(key);
            }
        }
        server.toggle_fullscreen(1, (320, 180));
    }
    match Window::open((320, 180)) {
        Err(why) => {
            assert!(!why.is_empty());
            assert!(kept < polite.len(), "a polite server gets no window: {why}");
        }
        Ok(mut window) => {
            let frame = Frame { width: 16, height: 9, pixels: vec![0x123456; 16 * 9] };
            for _ in 0..3 {
                let keys = (0..KEYS).map_while(|_| window.next_key()).count();
                assert!(keys < KEYS, "keys without end");
                window.toggle_fullscreen();
                if let Err(why) = window.show(&frame) {
                    assert!(!why.is_empty());
                }
            }
            window.close();
        }
    }
    assert!(began.elapsed() < LONG, "{:?}", began.elapsed());
    display.server.heard();
}
