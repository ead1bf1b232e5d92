//! A client of PulseAudio's native protocol, version 8, which PipeWire speaks too: one stream of sound to a server of the
//! same user.
//!
//! A packet has a head of five big-endian words: the length of what follows, a channel, two words of an offset, and flags.
//! On channel -1 are commands, whose values each have a byte for their type before them; on a stream's channel is its
//! sound. Nothing that the server says is taken on trust: a packet longer than any that is meant for this client, or a
//! value of another type than is due, ends the sound.

use paprsek::sound::{Pair, RATE};
use std::env;
use std::io::{ErrorKind, Read, Write};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Longest wait for the server to say something.
const WAIT: Duration = Duration::from_millis(10);
/// Longest wait for it to take something: one that takes longer plays nothing.
const PATIENCE: Duration = Duration::from_secs(2);
/// The longest packet that is listened to, bytes. Those that come are of some tens.
const LONGEST: usize = 1 << 16;
/// Bytes of a packet's head.
const HEAD: usize = 20;
/// Bytes of sound that the server is asked to keep: a tenth of a second. With more, one hears a jump later.
const KEPT: u32 = RATE / 10 * size_of::<Pair>() as u32;
/// What stands for any, where a number is due.
const ANY: u32 = u32::MAX;

// Commands (pulsecore/native-common.h).
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
/// A volume that changes nothing.
const UNCHANGED: u32 = 0x10000;

/// The name of the program, and of its stream.
const NAME: &[u8] = b"Paprsek";

/// A connection with a stream on it.
pub struct Stream {
    socket: UnixStream,
    /// What was received and not yet understood.
    received: Vec<u8>,
    /// The stream's channel, once the server has said it.
    channel: Option<u32>,
    /// Bytes of sound that the server wants by now.
    pub wanted: usize,
    /// Bytes that were sent.
    pub sent: u64,
    /// How late what was sent last will be heard, seconds; when the server said so, and the bytes that were sent until
    /// then.
    delay: Option<(f64, Instant, u64)>,
}

/// What the server has said.
#[derive(Default)]
pub struct News {
    /// How long ago the last sample that was sent would have to have been for being heard now, seconds.
    pub delay: Option<f64>,
}

impl Stream {
    /// A stream on the server of this user, if there is one.
    pub fn open() -> Option<Stream> {
        let socket = UnixStream::connect(address()?).ok()?;
        socket.set_read_timeout(Some(WAIT)).ok()?;
        socket.set_write_timeout(Some(PATIENCE)).ok()?;
        let mut stream = Stream { socket, received: Vec::new(), channel: None, wanted: 0, sent: 0, delay: None };
        // All at once: the server answers them in turn.
        stream.say(Command::new(AUTH).number(VERSION).bytes(&[0; COOKIE]))?;
        stream.say(Command::new(SET_CLIENT_NAME).text(NAME))?;
        let create = Command::new(CREATE_PLAYBACK_STREAM)
            .text(NAME)
            .raw(&[b'a', S16LE, 2])
            .raw(&RATE.to_be_bytes())
            .raw(&[b'm', 2])
            .raw(&LEFT_RIGHT)
            // Any sink, by its number and by its name.
            .number(ANY)
            .raw(b"N")
            // The longest buffer; not corked; what it keeps, has before it starts, and asks for at least.
            .number(ANY)
            .raw(b"0")
            .number(KEPT)
            .number(ANY)
            .number(ANY)
            // Together with no other stream.
            .number(0)
            .raw(&[b'v', 2])
            .raw(&UNCHANGED.to_be_bytes())
            .raw(&UNCHANGED.to_be_bytes());
        stream.say(create)?;
        Some(stream)
    }

    /// Asks how late what is sent is heard.
    pub fn ask(&mut self) -> Option<()> {
        let Some(channel) = self.channel else { return Some(()) };
        self.say(Command::new(GET_PLAYBACK_LATENCY).number(channel).raw(b"T\0\0\0\0\0\0\0\0"))
    }

    /// How late what is sent now will be heard, seconds, if the server has said.
    pub fn delay(&self) -> Option<f64> {
        let (delay, at, then) = self.delay?;
        Some(delay + seconds(self.sent - then) - at.elapsed().as_secs_f64())
    }

    /// Sends sound.
    pub fn send(&mut self, samples: &[Pair]) -> Option<()> {
        let bytes: Vec<u8> = samples.as_flattened().iter().flat_map(|code| code.to_le_bytes()).collect();
        self.packet(self.channel?, &bytes)?;
        self.sent += bytes.len() as u64;
        self.wanted = self.wanted.saturating_sub(bytes.len());
        Some(())
    }

    /// Waits a little for news; none once the server has gone or makes no sense.
    pub fn listen(&mut self) -> Option<News> {
        let mut bytes = [0; 4096];
        match self.socket.read(&mut bytes) {
            Ok(0) => return None,
            Ok(count) => self.received.extend_from_slice(&bytes[..count]),
            Err(error)
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted) => {}
            Err(_) => return None,
        }
        let mut news = News::default();
        while let Some((head, rest)) = self.received.split_first_chunk::<HEAD>() {
            let [length, channel] =
                [0, 4].map(|at| u32::from_be_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]));
            let length = length as usize;
            if length > LONGEST {
                return None;
            }
            if rest.len() < length {
                break;
            }
            let packet = rest[..length].to_vec();
            self.received.drain(..HEAD + length);
            if channel == ANY {
                self.understand(&packet, &mut news)?;
            }
        }
        Some(news)
    }

    /// Takes in a command of the server's.
    fn understand(&mut self, packet: &[u8], news: &mut News) -> Option<()> {
        let mut values = Values(packet);
        match (values.number()?, values.number()?) {
            (REPLY, CREATE_PLAYBACK_STREAM) => {
                self.channel = Some(values.number()?);
                let _index = values.number()?;
                self.wanted = values.number()? as usize;
            }
            (REPLY, GET_PLAYBACK_LATENCY) => {
                // The sink's, in microseconds, and a source's; whether it plays; two times of day; what the stream was
                // sent and what was taken from it.
                let sink = u64::from_be_bytes(values.of(b'U')?);
                let _: [u8; 8] = values.of(b'U')?;
                let plays = values.byte()? == b'1';
                let _: [[u8; 8]; 2] = [values.of(b'T')?, values.of(b'T')?];
                let _: [u8; 8] = values.of(b'r')?;
                let taken = i64::from_be_bytes(values.of(b'r')?).max(0) as u64;
                // A second is more than any sink has; a larger number is no time.
                let delay = seconds(self.sent.saturating_sub(taken)) + (sink as f64 * 1e-6).min(1.0);
                if plays {
                    self.delay = Some((delay, Instant::now(), self.sent));
                    news.delay = Some(delay);
                }
            }
            (REQUEST, _) => {
                values.number()?;
                self.wanted = self.wanted.saturating_add(values.number()? as usize);
            }
            // Errors: the commands are told from each other by their numbers, so what failed needs no name.
            (0, _) => return None,
            _ => {}
        }
        Some(())
    }

    fn say(&mut self, command: Command) -> Option<()> {
        self.packet(ANY, &command.0)
    }

    fn packet(&mut self, channel: u32, bytes: &[u8]) -> Option<()> {
        let mut packet = Vec::with_capacity(HEAD + bytes.len());
        for word in [bytes.len() as u32, channel, 0, 0, 0] {
            packet.extend_from_slice(&word.to_be_bytes());
        }
        packet.extend_from_slice(bytes);
        self.socket.write_all(&packet).ok()
    }
}

/// The seconds that so many bytes of sound last.
fn seconds(bytes: u64) -> f64 {
    bytes as f64 / (f64::from(RATE) * size_of::<Pair>() as f64)
}

/// Where the server listens.
fn address() -> Option<PathBuf> {
    if let Some(server) = env::var_os("PULSE_SERVER") {
        let server = server.as_bytes();
        let path = server.strip_prefix(b"unix:").unwrap_or(server);
        return path.starts_with(b"/").then(|| PathBuf::from(std::ffi::OsStr::from_bytes(path)));
    }
    Some(PathBuf::from(env::var_os("XDG_RUNTIME_DIR")?).join("pulse/native"))
}

/// A command: its number, the number by which its answer is known, which is the same, and its values.
struct Command(Vec<u8>);

impl Command {
    fn new(number: u32) -> Command {
        Command(Vec::new()).number(number).number(number)
    }

    fn raw(mut self, bytes: &[u8]) -> Command {
        self.0.extend_from_slice(bytes);
        self
    }

    fn number(self, number: u32) -> Command {
        self.raw(b"L").raw(&number.to_be_bytes())
    }

    fn text(self, text: &[u8]) -> Command {
        self.raw(b"t").raw(text).raw(&[0])
    }

    fn bytes(self, bytes: &[u8]) -> Command {
        self.raw(b"x").raw(&(bytes.len() as u32).to_be_bytes()).raw(bytes)
    }
}

/// The values of a command that are still to be read; none where they are of another type or too short.
struct Values<'a>(&'a [u8]);

impl Values<'_> {
    fn byte(&mut self) -> Option<u8> {
        let (&byte, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(byte)
    }

    /// The bytes of a value of this type.
    fn of<const N: usize>(&mut self, kind: u8) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.strip_prefix(&[kind])?.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    fn number(&mut self) -> Option<u32> {
        self.of(b'L').map(u32::from_be_bytes)
    }
}
