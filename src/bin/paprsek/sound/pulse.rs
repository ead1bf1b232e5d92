//! A client of PulseAudio's native protocol, version 8, which PipeWire speaks too: one stream of sound to a server of the
//! same user.
//!
//! A packet has a head of five big-endian words: the length of what follows, a channel, two words of an offset, and flags.
//! On channel -1 are commands, whose values each have a byte for their type before them; on a stream's channel is its
//! sound. What the server says is looked for where version 8 has it. A packet longer than any that is meant for this
//! client ends the sound, as an error does; numbers that make no sense are as good as others.

use crate::io::{c_path, environment, variable, write_all};
use crate::text::fill;
use paprsek::sound::{BLOCK, Pair, RATE};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::read;
use rustix::net::{AddressFamily, SocketAddrUnix, SocketType, connect, socket};
use std::os::fd::{AsFd, OwnedFd};

/// Longest wait for the server to say something.
const WAIT: Timespec = Timespec { tv_sec: 0, tv_nsec: 10_000_000 };
/// The longest packet that is listened to, bytes. Those that come are of some tens.
const LONGEST: usize = 1024;
/// Bytes of a packet's head.
const HEAD: usize = 20;
/// Blocks of sound that are sent at once, 6 ms, and their bytes.
pub const PIECE: usize = 4;
const SENT: usize = PIECE * BLOCK * size_of::<Pair>();
/// Bytes of sound that the server is asked to keep: whole pieces, a tenth of a second. With more, one hears a jump later.
const KEPT: u32 = 17 * SENT as u32;
/// The most bytes that a server may want at once.
const MOST: u32 = 1 << 20;
/// What stands for any, where a number is due; the channel of commands.
const ANY: u32 = u32::MAX;

// Commands (pulsecore/native-common.h).
const ERROR: u32 = 0;
const REPLY: u32 = 2;
const CREATE_PLAYBACK_STREAM: u32 = 3;
const AUTH: u32 = 8;
const SET_CLIENT_NAME: u32 = 9;
const GET_PLAYBACK_LATENCY: u32 = 14;
const REQUEST: u32 = 61;

/// The version of the protocol.
const VERSION: u32 = 8;
/// Bytes of a cookie, which a server of the same user does not look at.
const COOKIE: usize = 256;
/// 16 bits with a sign, little-endian.
const S16LE: u8 = 3;
/// The channels of a front left and a front right loudspeaker.
const LEFT_RIGHT: [u8; 2] = [1, 2];
/// Bytes of sound in a second.
pub const SECOND: f64 = RATE as f64 * size_of::<Pair>() as f64;
/// A volume that changes nothing.
const UNCHANGED: u32 = 0x10000;

// Where the values of an answer are, each after the byte of its type: what it is, the number of the command that it
// answers, and what follows them.
const WHAT: usize = 1;
const TAG: usize = 6;
/// The stream's channel, and the bytes that the server wants at first.
const CHANNEL: usize = 11;
const FIRST: usize = 21;
/// How late the sink is, microseconds; whether it plays; the bytes that it has taken from the stream.
const SINK: usize = 11;
const PLAYS: usize = 28;
const TAKEN: usize = 57;
/// Of a request, whose tag is any: the bytes that the server wants now.
const MORE: usize = 16;

/// What is said at first, all at once: the server answers in turn.
static HELLO: Packet = {
    let hello = Packet::command(AUTH).number(VERSION).raw(b"x").word(COOKIE as u32).raw(&[0; COOKIE]);
    let hello = hello.then(SET_CLIENT_NAME).raw(b"tPaprsek\0");
    let hello = hello.then(CREATE_PLAYBACK_STREAM).raw(b"tPaprsek\0");
    let hello = hello.raw(&[b'a', S16LE, 2]).word(RATE).raw(b"m\x02").raw(&LEFT_RIGHT);
    // Any sink, by its number and by its name.
    let hello = hello.number(ANY).raw(b"N");
    // The longest buffer; not corked; what it keeps, has before it starts, and asks for at least.
    let hello = hello.number(ANY).raw(b"0").number(KEPT).number(ANY).number(ANY);
    // Together with no other stream, and as loud as it is.
    hello.number(0).raw(b"v\x02").word(UNCHANGED).word(UNCHANGED)
};
/// Asks how late what is sent is heard: the stream's channel, which is still to be put in, and a time of day.
const ASK: Packet = Packet::command(GET_PLAYBACK_LATENCY).number(0).raw(b"T\0\0\0\0\0\0\0\0");

/// A connection with a stream on it.
pub struct Stream {
    socket: OwnedFd,
    /// What the server is saying, and how many of its bytes have come.
    packet: [u8; HEAD + LONGEST],
    got: usize,
    /// The stream's channel, once the server has said it.
    channel: [u8; 4],
    /// Bytes of sound that the server wants by now; below 0 where it got more.
    pub wanted: i32,
    /// Bytes of sound that were sent.
    pub sent: u64,
}

impl Stream {
    /// A stream on the server of this user, if there is one.
    pub fn open() -> Option<Stream> {
        let environment = environment();
        let path = match variable(environment, b"PULSE_SERVER=") {
            Some(server) => fill("%\0", &[server.strip_prefix(b"unix:").unwrap_or(server)]),
            None => fill("%/pulse/native\0", &[variable(environment, b"XDG_RUNTIME_DIR=")?]),
        };
        let socket = socket(AddressFamily::UNIX, SocketType::STREAM, None).ok()?;
        connect(&socket, &SocketAddrUnix::new(c_path(&path)).ok()?).ok()?;
        write_all(socket.as_fd(), HELLO.bytes()).ok()?;
        Some(Stream { socket, packet: [0; _], got: 0, channel: [0; 4], wanted: 0, sent: 0 })
    }

    /// Sends a piece of sound.
    pub fn send(&mut self, samples: &[Pair]) -> Option<()> {
        let mut packet = [0; HEAD + SENT];
        packet[..4].copy_from_slice(&(SENT as u32).to_be_bytes());
        packet[4..8].copy_from_slice(&self.channel);
        for (bytes, code) in packet[HEAD..].as_chunks_mut().0.iter_mut().zip(samples.as_flattened()) {
            *bytes = code.to_le_bytes();
        }
        self.sent += SENT as u64;
        self.wanted -= SENT as i32;
        write_all(self.socket.as_fd(), &packet).ok()
    }

    /// Asks how late what is sent is heard.
    pub fn ask(&self) -> Option<()> {
        let mut ask = ASK;
        ask.bytes[HEAD + CHANNEL..][..4].copy_from_slice(&self.channel);
        write_all(self.socket.as_fd(), ask.bytes()).ok()
    }

    /// Waits a little for the server to say something; none once it has gone or makes no sense. What it may have said is
    /// how late what is sent now will be heard, in seconds.
    pub fn listen(&mut self) -> Option<Option<f64>> {
        if poll(&mut [PollFd::new(&self.socket, PollFlags::IN)], Some(&WAIT)) == Ok(0) {
            return Some(None);
        }
        let end = if self.got < HEAD { HEAD } else { HEAD + self.word(0) as usize };
        match read(&self.socket, &mut self.packet[self.got..end]) {
            Ok(count @ 1..) => self.got += count,
            _ => return None,
        }
        if self.got < HEAD {
            return Some(None);
        }
        let length = self.word(0) as usize;
        if length > LONGEST {
            return None;
        }
        if self.got < HEAD + length {
            return Some(None);
        }
        self.got = 0;
        let value = |at| self.word(HEAD + at);
        let mut more = 0;
        match (value(WHAT), value(TAG)) {
            // Commands are told from each other by their numbers, so what failed needs no name.
            (ERROR, _) => return None,
            (REPLY, CREATE_PLAYBACK_STREAM) => {
                more = value(FIRST);
                self.channel = value(CHANNEL).to_be_bytes();
            }
            (REPLY, GET_PLAYBACK_LATENCY) if self.packet[HEAD + PLAYS] == b'1' => {
                let waits = self.sent.wrapping_sub(self.long(TAKEN)) as i64;
                return Some(Some(self.long(SINK) as f64 * 1e-6 + waits as f64 / SECOND));
            }
            (REQUEST, _) => more = value(MORE),
            _ => {}
        }
        self.wanted = (self.wanted + more.min(MOST) as i32).min(MOST as i32);
        Some(None)
    }

    /// The number at a place of the packet.
    fn word(&self, at: usize) -> u32 {
        let mut word = [0; 4];
        word.copy_from_slice(&self.packet[at..][..4]);
        u32::from_be_bytes(word)
    }

    /// The number of 64 bits at a place among the values.
    fn long(&self, at: usize) -> u64 {
        u64::from(self.word(HEAD + at)) << 32 | u64::from(self.word(HEAD + at + 4))
    }
}

/// Packets while they are put together, and where the last one begins.
#[derive(Clone, Copy)]
struct Packet {
    bytes: [u8; 512],
    length: usize,
    start: usize,
}

impl Packet {
    /// A command: its number, and the number by which its answer is known, which is the same.
    const fn command(number: u32) -> Packet {
        Packet { bytes: [0; 512], length: 0, start: 0 }.then(number)
    }

    /// Another command after those.
    const fn then(self, number: u32) -> Packet {
        let next = Packet { start: self.length, ..self };
        next.word(0).word(ANY).word(0).word(0).word(0).number(number).number(number)
    }

    /// With these bytes after it. The head says so.
    const fn raw(mut self, bytes: &[u8]) -> Packet {
        let mut i = 0;
        while i < bytes.len() {
            self.bytes[self.length] = bytes[i];
            self.length += 1;
            i += 1;
        }
        let length = (self.length.saturating_sub(self.start + HEAD) as u32).to_be_bytes();
        let mut i = 0;
        while i < 4 {
            self.bytes[self.start + i] = length[i];
            i += 1;
        }
        self
    }

    /// With a word without a type after it.
    const fn word(self, word: u32) -> Packet {
        self.raw(&word.to_be_bytes())
    }

    /// With a number after it.
    const fn number(self, number: u32) -> Packet {
        self.raw(b"L").word(number)
    }

    fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}
