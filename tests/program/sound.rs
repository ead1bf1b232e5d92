//! The sound of the show: its WAV file, and what a sound server gets, a fake one and PulseAudio itself.

use crate::fake::Fake;
use crate::paprsek;
use crate::window::Display;
use paprsek::scenes::show::score::score;
use paprsek::sound::{Pair, RATE};
use std::fs;
use std::io::{ErrorKind, Read, Result, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::channel;
use std::thread::{self, sleep};
use std::time::{Duration, Instant};
use tempfile::TempDir;
#[cfg(feature = "full")]
use testkit::run::fails;
use testkit::run::{ending, succeeds};
use testkit::{Tool, needs};

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(40);
/// Bytes of a second.
const SECOND: f64 = RATE as f64 * size_of::<Pair>() as f64;

fn pairs(bytes: &[u8]) -> Vec<Pair> {
    bytes
        .as_chunks::<4>()
        .0
        .iter()
        .map(|b| [i16::from_le_bytes([b[0], b[1]]), i16::from_le_bytes([b[2], b[3]])])
        .collect()
}

/// Writes the sound of a range.
#[cfg(feature = "full")]
#[track_caller]
fn wav(words: &[&str]) -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("show.wav");
    succeeds(paprsek().args(words).arg("--sound").arg(&file).output().unwrap());
    // The file alone, under its own name.
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 1);
    fs::read(file).unwrap()
}

#[test]
#[cfg(feature = "full")]
fn a_wav_file_has_the_samples_of_the_range() {
    let file = wav(&["--from", "40.5", "--to", "42"]);
    let (head, data) = file.split_at(44);
    let number = |at: usize| u32::from_le_bytes(head[at..][..4].try_into().unwrap());
    assert_eq!((&head[..4], &head[8..16], &head[36..40]), (&b"RIFF"[..], &b"WAVEfmt "[..], &b"data"[..]));
    assert_eq!((number(4), number(16), number(40)), (file.len() as u32 - 8, 16, data.len() as u32));
    // PCM of two channels; samples and bytes per second; bytes and bits of a sample.
    assert_eq!((number(20), number(24), number(28), number(32)), (1 | 2 << 16, RATE, SECOND as u32, 4 | 16 << 16));
    let mut samples = vec![[0; 2]; 3 * RATE as usize / 2];
    score().samples(40 * u64::from(RATE) + u64::from(RATE) / 2, &mut samples);
    assert_eq!(pairs(data), samples);
    // Pieces make the whole.
    let [a, b] = [["--from", "40.5", "--to", "41.3"], ["--from", "41.3", "--to", "42"]].map(|words| wav(&words));
    assert_eq!([&a[44..], &b[44..]].concat(), data);
    // With frames beside it, too.
    let directory = tempfile::tempdir().unwrap();
    let mut command = paprsek();
    command.args(["--from", "40.5", "--to", "40.6", "--size", "16x9", "--sound", "a.wav", "--capture", "frames"]);
    succeeds(command.current_dir(&directory).output().unwrap());
    assert_eq!(fs::read(directory.path().join("a.wav")).unwrap()[44..], data[..17_640]);
    assert_eq!(fs::read_dir(directory.path().join("frames")).unwrap().count(), 3);
}

#[test]
#[cfg(feature = "full")]
fn what_has_no_sound_is_refused() {
    for line in ["lumen --sound a.wav", "--at 3 --sound a.wav", "--bench --sound a.wav", "--sound", "--no-sound=1"] {
        fails(&paprsek().args(line.split(' ')).output().unwrap(), 2);
    }
    let output = paprsek().args(["--to", "1", "--sound", "/nowhere/a.wav"]).output().unwrap();
    assert!(fails(&output, 1).contains("/nowhere/a.wav"));
    // No file can be as long as that.
    let output = paprsek().args(["--to", "30000", "--fps", "1", "--sound", "/nowhere/a.wav"]).output().unwrap();
    assert!(fails(&output, 1).contains("4 GB"));
}

/// A sound server of a test's own; the directory goes with the test.
struct Server(TempDir);

/// What a server heard: the sound, when its first byte came, and when the client went.
struct Heard {
    bytes: Vec<u8>,
    began: Instant,
    ended: Instant,
}

impl Server {
    /// A server that talks like that with the one client.
    fn new(talk: impl FnOnce(UnixStream) + Send + 'static) -> Server {
        let directory = tempfile::tempdir().unwrap();
        let listener = UnixListener::bind(directory.path().join("native")).unwrap();
        thread::spawn(move || talk(listener.accept().unwrap().0));
        Server(directory)
    }

    /// Where it listens, as `PULSE_SERVER` names it.
    fn address(&self) -> String {
        format!("unix:{}", self.0.path().join("native").display())
    }

    /// Plays a range of the show before a display that sees nothing, with sound to this server.
    fn play(&self, words: &[&str]) -> (Child, Fake) {
        let fake = Fake::open(|mut client| {
            client.agree()?;
            client.serve_until(0)
        });
        let mut command = paprsek();
        command.args(words).args(["--size", "64x36"]).env("DISPLAY", &fake.name).env("XAUTHORITY", "/nowhere");
        command.env("PULSE_SERVER", self.address()).env_remove("XMODIFIERS");
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        (command.spawn().unwrap(), fake)
    }
}

/// A command with its numbers, as both sides write it.
fn command(numbers: &[u32], rest: &[u8]) -> Vec<u8> {
    let mut packet: Vec<u8> = numbers.iter().flat_map(|n| [&b"L"[..], &n.to_be_bytes()].concat()).collect();
    packet.extend(rest);
    let head = [packet.len() as u32, u32::MAX, 0, 0, 0].map(u32::to_be_bytes);
    [head.as_flattened(), &packet].concat()
}

/// The next packet, its channel before it; none while there is no more than a part of one.
fn packet(stream: &mut UnixStream, buffer: &mut Vec<u8>) -> Result<Option<(u32, Vec<u8>)>> {
    let number = |buffer: &[u8], at: usize| u32::from_be_bytes(buffer[at..][..4].try_into().unwrap());
    let whole = |buffer: &[u8]| buffer.len() >= 20 && buffer.len() >= 20 + number(buffer, 0) as usize;
    if !whole(buffer) {
        let mut bytes = [0; 1 << 16];
        match stream.read(&mut bytes) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => buffer.extend(&bytes[..count]),
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(error) => return Err(error),
        }
    }
    if !whole(buffer) {
        return Ok(None);
    }
    let (channel, end) = (number(buffer, 4), 20 + number(buffer, 0) as usize);
    Ok(Some((channel, buffer.drain(..end).skip(20).collect())))
}

/// A polite server, whose card plays so much faster than the processor's clock goes.
fn serve(mut stream: UnixStream, speed: f64) -> Heard {
    const CHANNEL: u32 = 7;
    const KEPT: usize = 17_640;
    stream.set_read_timeout(Some(Duration::from_millis(2))).unwrap();
    let (mut buffer, mut heard, mut wanted) = (Vec::new(), Vec::new(), KEPT);
    let mut began = None;
    let mut talk = || -> Result<()> {
        loop {
            let said = packet(&mut stream, &mut buffer)?;
            // It begins once it has as much as it keeps.
            let played = |began: Option<Instant>| began.map_or(0.0, |b| b.elapsed().as_secs_f64() * speed * SECOND);
            match said {
                Some((CHANNEL, sound)) => {
                    heard.extend(sound);
                    if heard.len() >= KEPT && began.is_none() {
                        began = Some(Instant::now());
                    }
                }
                Some((_, words)) => {
                    let number = |at: usize| u32::from_be_bytes(words[at..][..4].try_into().unwrap());
                    let (what, tag) = (number(1), number(6));
                    match what {
                        8 => assert!(words.len() == 10 + 5 + 5 + 256 && number(11) == 8, "not as version 8 has it"),
                        9 => assert_eq!(&words[10..], b"tPaprsek\0"),
                        3 => stream.write_all(&command(&[2, tag, CHANNEL, 0, KEPT as u32], b""))?,
                        14 => {
                            let taken = (played(began) as u64).min(heard.len() as u64);
                            let times = [&b"U"[..], &[0; 8], b"U", &[0; 8], b"1T", &[0; 8], b"T", &[0; 8]].concat();
                            let counts =
                                [b"r", &(heard.len() as u64).to_be_bytes()[..], b"r", &taken.to_be_bytes()].concat();
                            stream.write_all(&command(&[2, tag], &[times, counts].concat()))?;
                        }
                        _ => panic!("command {what}"),
                    }
                }
                None => {}
            }
            let due = played(began) as usize + KEPT;
            if due > wanted + 1764 {
                stream.write_all(&command(&[61, u32::MAX, CHANNEL, (due - wanted) as u32], b""))?;
                wanted = due;
            }
        }
    };
    talk().unwrap_err();
    Heard { bytes: heard, began: began.unwrap(), ended: Instant::now() }
}

/// Plays a range against such a server.
#[track_caller]
fn hear(words: &[&str], speed: f64) -> Heard {
    let (sender, heard) = channel();
    let server = Server::new(move |stream| sender.send(serve(stream, speed)).unwrap());
    let (child, _fake) = server.play(words);
    succeeds(ending(child, PATIENCE));
    heard.recv_timeout(PATIENCE).unwrap()
}

/// The pieces of the show that were heard: number of the first pair that was heard, the sample of the show that it is, and
/// how many follow it.
fn pieces(heard: &[Pair], from: usize, to: usize) -> Vec<(usize, usize, usize)> {
    let mut show = vec![[0; 2]; (to - from) * RATE as usize];
    score().samples(from as u64 * u64::from(RATE), &mut show);
    let (mut pieces, mut at) = (Vec::new(), 0);
    /// Pairs that do not come again by chance.
    const RUN: usize = 6;
    while at + RUN < heard.len() {
        let run = &heard[at..at + RUN];
        let found = if run.contains(&[0, 0]) { None } else { show.windows(RUN).position(|piece| piece == run) };
        let Some(place) = found else {
            at += 1;
            continue;
        };
        let length = heard[at..].iter().zip(&show[place..]).take_while(|(a, b)| a == b).count();
        pieces.push((at, place + from * RATE as usize, length));
        at += length;
    }
    pieces
}

#[test]
fn the_show_is_heard_as_it_is_and_with_the_picture() {
    if !needs(&[Tool::Xlib]) {
        return;
    }
    let heard = hear(&["--from", "44", "--to", "48"], 1.0);
    let pieces = pieces(&pairs(&heard.bytes), 43, 50);
    let &(at, place, length) = pieces.iter().max_by_key(|piece| piece.2).unwrap();
    // Without a jump, once it has begun; a thread that waits longer than that on a loaded machine may make one.
    assert!(length > 2 * RATE as usize && pieces.len() < 4, "{pieces:?}");
    // What was heard when the show was over, and the window closed, was its end.
    let last = (heard.ended - heard.began).as_secs_f64() + (place as f64 - at as f64) / f64::from(RATE);
    assert!((last - 48.0).abs() < 0.15, "{last}");
}

#[test]
#[cfg(feature = "terminal")]
fn a_terminal_hears_it_too() {
    if !needs(&[Tool::Script]) {
        return;
    }
    let (sender, heard) = channel();
    let server = Server::new(move |stream| sender.send(serve(stream, 1.0)).unwrap());
    let line = format!("stty rows 4 cols 8; exec {} --from 44 --to 47", paprsek().get_program().display());
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).env("TERM", "xterm-256color").env("SHELL", "/bin/sh");
    script.env("PULSE_SERVER", server.address()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let mut child = script.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    // Kept to the end: a closed input would be an end of file typed into the terminal.
    let _keyboard = child.stdin.take();
    succeeds(ending(child, PATIENCE));
    let heard = heard.recv_timeout(PATIENCE).unwrap();
    let pieces = pieces(&pairs(&heard.bytes), 43, 49);
    assert!(pieces.iter().any(|piece| piece.2 > RATE as usize), "{pieces:?}");
    let &(at, place, _) = pieces.iter().max_by_key(|piece| piece.2).unwrap();
    let last = (heard.ended - heard.began).as_secs_f64() + (place as f64 - at as f64) / f64::from(RATE);
    assert!((last - 47.0).abs() < 0.15, "{last}");
}

/// A card that plays 4 % faster than it says: so does the show.
#[test]
fn the_picture_follows_the_sound() {
    if !needs(&[Tool::Xlib]) {
        return;
    }
    let took = |speed: f64| {
        let heard = hear(&["--from", "44", "--to", "56"], speed);
        let pieces = pieces(&pairs(&heard.bytes), 43, 58);
        assert!(pieces.len() < 5, "{pieces:?}");
        let &(at, place, _) = pieces.iter().max_by_key(|piece| piece.2).unwrap();
        // From where it was at first to the end.
        let start = (place as f64 - at as f64) / f64::from(RATE);
        ((heard.ended - heard.began).as_secs_f64(), start)
    };
    let (fast, start) = took(1.04);
    // Seconds of the show by seconds of the clock: without following, 1.
    let pace = (56.0 - start) / fast;
    assert!((1.025..1.055).contains(&pace), "{pace}");
}

/// Servers that refuse, lie, talk nonsense or say nothing: the show plays to its end, at its pace, without a word.
#[test]
fn the_show_goes_on_without_sound() {
    if !needs(&[Tool::Xlib]) {
        return;
    }
    type Talk = fn(&mut UnixStream) -> Result<()>;
    let talks: [(&str, Talk); 9] = [
        ("leaves", |_| Ok(())),
        ("says nothing", |_| {
            sleep(PATIENCE);
            Ok(())
        }),
        ("refuses", |stream| {
            stream.write_all(&command(&[0, 8, 1], b""))?;
            stream.read_to_end(&mut Vec::new()).map(drop)
        }),
        ("talks nonsense", |stream| {
            stream.write_all(&[0x4c; 4096])?;
            stream.read_to_end(&mut Vec::new()).map(drop)
        }),
        ("has four gigabytes to say", |stream| {
            stream.write_all(&[0xff; 20])?;
            stream.read_to_end(&mut Vec::new()).map(drop)
        }),
        ("wants four gigabytes and takes nothing", |stream| {
            stream.write_all(&command(&[2, 3, 7, 0, u32::MAX], b""))?;
            sleep(PATIENCE);
            Ok(())
        }),
        ("wants four gigabytes again and again", |stream| {
            stream.write_all(&command(&[2, 3, 7, 0, u32::MAX], b""))?;
            let mut bytes = vec![0; 1 << 16];
            let (began, mut taken) = (Instant::now(), 0);
            while began.elapsed() < Duration::from_secs(1) {
                taken += stream.read(&mut bytes)?;
                stream.write_all(&command(&[61, u32::MAX, 7, u32::MAX], b""))?;
            }
            // A second takes 0.18 MB.
            assert!(taken < 2_000_000, "{taken}");
            Ok(())
        }),
        ("says short values", |stream| {
            stream.write_all(&command(&[2, 3, 7, 0, 17_640], b""))?;
            stream.write_all(&command(&[2, 14], b"U\0"))?;
            stream.read_to_end(&mut Vec::new()).map(drop)
        }),
        ("says wild times", |stream| {
            stream.write_all(&command(&[2, 3, 7, 0, 17_640], b""))?;
            let times = [b"U".as_slice(), &[0xff; 8], b"U", &[0xff; 8], b"1T", &[0; 8], b"T", &[0; 8]].concat();
            let counts = [b"r".as_slice(), &[0x80; 8], b"r", &[0xff; 8]].concat();
            for _ in 0..100 {
                stream.write_all(&command(&[2, 14], &[&times[..], &counts].concat()))?;
                sleep(Duration::from_millis(10));
            }
            stream.read_to_end(&mut Vec::new()).map(drop)
        }),
    ];
    for (what, talk) in talks {
        let server = Server::new(move |mut stream| {
            let _ = talk(&mut stream);
        });
        let began = Instant::now();
        let (child, _fake) = server.play(&["--from", "150", "--to", "151.5"]);
        succeeds(ending(child, PATIENCE));
        let took = began.elapsed().as_secs_f64();
        assert!((1.4..8.0).contains(&took), "a server that {what}: {took} s");
    }
}

#[test]
fn silence_can_be_asked_for_and_stills_are_silent() {
    if !needs(&[Tool::Xlib]) {
        return;
    }
    let mut silent = vec![vec!["--from", "150", "--to", "151", "--no-sound"]];
    if cfg!(feature = "full") {
        silent.push(vec!["lumen", "--from", "1", "--to", "2"]);
    }
    for words in silent {
        let (sender, asked) = channel();
        let server = Server::new(move |_| sender.send(()).unwrap());
        let (child, _fake) = server.play(&words);
        succeeds(ending(child, PATIENCE));
        assert!(asked.try_recv().is_err(), "{words:?} asked for sound");
    }
}

/// A program that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(command: &mut Command) -> Running {
    Running(command.stdin(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
}

/// PulseAudio itself, whose sink's monitor is recorded: the samples, to the bit; silence while time rests; and the sound of
/// the place that one jumps to.
#[test]
fn pulseaudio_plays_the_samples() {
    if !needs(&[Tool::PulseAudio, Tool::Parec, Tool::Xlib]) {
        return;
    }
    let Some(display) = Display::open() else { return };
    let directory = tempfile::tempdir().unwrap();
    let here = |name: &str| directory.path().join(name);
    fs::create_dir(here("pulse")).unwrap();
    let of = |program: &str| {
        let mut command = Command::new(program);
        command.env("XDG_RUNTIME_DIR", directory.path()).env("HOME", directory.path()).env_remove("PULSE_SERVER");
        command
    };
    let socket = here("pulse/native");
    let _server = start(
        of("pulseaudio")
            .args(["-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes", "--use-pid-file=no"])
            .arg("--load=module-null-sink sink_name=n rate=44100 format=s16le channels=2")
            .arg(format!("--load=module-native-protocol-unix socket={} auth-anonymous=1", socket.display())),
    );
    wait_for(&socket);
    let record = fs::File::create(here("record")).unwrap();
    let _recorder = start(
        of("parec")
            .args(["-d", "n.monitor", "--format=s16le", "--rate=44100", "--channels=2", "--latency-msec=20"])
            .stdout(record),
    );
    sleep(Duration::from_secs(1));
    let mut command = paprsek();
    command.args(["--from", "44", "--to", "62", "--size", "64x36"]).env("DISPLAY", &display.1);
    command.env("XDG_RUNTIME_DIR", directory.path()).env_remove("PULSE_SERVER");
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    sleep(Duration::from_secs(4));
    display.xdotool(&["key", "space"]);
    sleep(Duration::from_millis(1500));
    display.xdotool(&["key", "space"]);
    sleep(Duration::from_secs(2));
    display.xdotool(&["key", "Right"]);
    let output: Output = ending(child, PATIENCE);
    succeeds(output);
    let recorded = pairs(&fs::read(here("record")).unwrap());
    let mut long = pieces(&recorded, 43, 64);
    long.retain(|piece| piece.2 > RATE as usize / 2);
    // Before the rest, after it, and after the jump.
    assert!((3..5).contains(&long.len()), "{long:?}");
    let end = |piece: (usize, usize, usize)| piece.0 + piece.2;
    let rest = &recorded[end(long[0])..long[1].0];
    let longest = rest.split(|pair| *pair != [0, 0]).map(<[Pair]>::len).max().unwrap_or(0);
    assert!(longest > RATE as usize, "{longest} silent samples, {long:?}");
    let jump = long[2].1 as f64 - (long[1].1 + long[1].2) as f64;
    assert!((jump / f64::from(RATE) - 5.0).abs() < 0.4, "{long:?}");
    let last = long[long.len() - 1];
    let seconds = (last.1 + last.2) as f64 / f64::from(RATE);
    assert!((61.7..62.5).contains(&seconds), "it ended at {seconds} s: {long:?}");
}

fn wait_for(path: &Path) {
    let began = Instant::now();
    while !path.exists() {
        assert!(began.elapsed() < PATIENCE, "no sound server");
        sleep(Duration::from_millis(50));
    }
}
