//! A sound server that says anything: answers, requests for sound and errors, over a true socket.
//!
//! What it says is whole packets, each described by a few bytes of the input, and raw bytes at the end.

use crate::input::Input;
use crate::listener::Listener;
use crate::sound::play;
use std::env;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Longest time with a server that says all at once and then hangs up.
const LONG: Duration = Duration::from_secs(4);
/// Most packets, so that most of an input is left for raw bytes.
const PACKETS: usize = 64;

/// Bytes of a packet's head, and of the longest packet that is listened to.
const HEAD: usize = 20;
const LONGEST: usize = 1024;
/// Bytes of a piece of sound, and of a second.
const PIECE: u64 = 1024;
const SECOND: u64 = 4 * 44_100;
/// The most bytes that count as wanted at once, and the seconds that a server may get ahead.
const MOST: u64 = 1 << 20;
const AHEAD: u64 = 6;

/// Commands as the protocol numbers them, those that mean something to a client of a stream among others.
const COMMANDS: [u32; 6] = [0, 2, 3, 14, 61, 64];
/// Numbers that are odd somewhere, and polite ones.
const NUMBERS: [u32; 8] = [0, 3, 8, 14, 17_640, 1 << 20, i32::MAX as u32, u32::MAX];
/// Times that the clock says: the first is rest.
const TIMES: [Option<f64>; 5] = [None, Some(0.0), Some(44.0), Some(153.9), Some(1e9)];

pub fn run(bytes: &[u8]) {
    static SERVER: OnceLock<Listener> = OnceLock::new();
    let server = SERVER.get_or_init(|| {
        let name = env::var("PULSE_SERVER").unwrap_or_default();
        let path = name.strip_prefix("unix:").expect("PULSE_SERVER is to be a socket of the fuzzer's own");
        assert!(path.contains("paprsek-fuzz"), "{path} may be somebody else's");
        Listener::open(PathBuf::from(path))
    });
    let mut input = Input::new(bytes);
    let time = input.one_of(&TIMES);
    let mut says: Vec<u8> = (0..input.below(PACKETS)).flat_map(|_| packet(&mut input)).collect();
    says.extend(input.rest());
    server.says(&says);
    let began = Instant::now();
    let clock = |heard: Option<f64>| {
        assert!(heard.is_none_or(f64::is_finite), "{heard:?} s are heard");
        time
    };
    // It ends with the server.
    assert!(play(&clock).is_none());
    let took = began.elapsed();
    assert!(took < LONG, "{took:?}");
    let heard = server.heard();
    assert_eq!(heard.len(), 1);
    let sound = sound_in(&heard[0]);
    let wanted = wanted_by(&says);
    assert!(sound <= wanted.next_multiple_of(PIECE), "{sound} bytes of sound for {wanted}");
    let played = (took.as_secs_f64() * SECOND as f64) as u64;
    assert!(sound <= AHEAD * SECOND + played + PIECE, "{sound} bytes of sound after {took:?}");
}

/// A packet as the input has it: of polite length and form, with numbers of any kind.
fn packet(input: &mut Input) -> Vec<u8> {
    let mut values = Vec::new();
    for number in [input.one_of(&COMMANDS), input.one_of(&NUMBERS)] {
        values.push(b'L');
        values.extend(number.to_be_bytes());
    }
    // Of any type: what matters is the place.
    for _ in 0..input.below(14) {
        values.push(if input.flag() { b'1' } else { b'L' });
        values.extend(input.one_of(&NUMBERS).to_be_bytes());
    }
    let head = [values.len() as u32, u32::MAX, 0, 0, 0].map(u32::to_be_bytes);
    [head.as_flattened(), &values].concat()
}

/// The number at a place.
fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes(*bytes[at..].first_chunk().expect("a word"))
}

/// The bytes of sound that a client sent, after its three commands and among its questions of latency. The last packet may
/// be cut, where the server went.
fn sound_in(mut heard: &[u8]) -> u64 {
    let (mut sound, mut commands) = (0, [8, 9, 3].into_iter());
    while let Some((head, rest)) = heard.split_at_checked(HEAD) {
        let length = word(head, 0) as usize;
        let body;
        (body, heard) = rest.split_at(length.min(rest.len()));
        if length as u64 == PIECE {
            sound += body.len() as u64;
        } else if body.len() >= 5 {
            assert_eq!(word(body, 1), commands.next().unwrap_or(14), "not what is to be said");
        }
    }
    sound
}

/// At most as many bytes of sound are wanted by what a server said, as the protocol has it.
fn wanted_by(mut said: &[u8]) -> u64 {
    let (mut wanted, mut stale) = (0, [0; HEAD + LONGEST]);
    while said.len() >= HEAD {
        let length = word(said, 0) as usize;
        if length > LONGEST || said.len() < HEAD + length {
            break;
        }
        // What is behind a short packet is of the one before.
        stale[..HEAD + length].copy_from_slice(&said[..HEAD + length]);
        said = &said[HEAD + length..];
        let value = |at| word(&stale, HEAD + at);
        match (value(1), value(6)) {
            (0, _) => break,
            (2, 3) => wanted += u64::from(value(21)).min(MOST),
            (61, _) => wanted += u64::from(value(16)).min(MOST),
            _ => {}
        }
    }
    wanted
}
