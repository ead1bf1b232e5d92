//! X servers that are silent, odd or strict, against a fake one: every wait is over in 5 s and ends in one line, and Esc
//! is heard. Where there is no window the plain build does something else, and the 64 kB build ends.

use crate::fake::{
    CHANGE_WINDOW_ATTRIBUTES, CREATE_WINDOW, Client, DESTROY_WINDOW, ESC, Fake, KEYBOARD_MAPPING, MAP_WINDOW,
    PUT_IMAGE, S, agreed, entry, refusal, set_up,
};
use crate::paprsek;
use std::fs;
use std::io::Result;
use std::net::Shutdown;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread::{self, sleep};
use std::time::{Duration, Instant};
use testkit::run::{ending, fails, succeeds};
use testkit::{Tool, needs};

/// Has it minifb, a terminal and the benchmark?
const PLAIN: bool = cfg!(feature = "minifb");
/// Every wait of the program is over in 5 s, and this is for a loaded machine.
const OVER: Duration = Duration::from_secs(8);
/// Longest wait for anything, of which to unpack the program is a part.
const PATIENCE: Duration = Duration::from_secs(30);
/// Esc ends at once.
const AT_ONCE: Duration = Duration::from_secs(1);
/// The method of cookies that X servers use.
const COOKIES: &str = "MIT-MAGIC-COOKIE-1";
/// Largest side of a picture, pixels: no drawing in X reaches further.
const MAX_SIDE: usize = 32767;
/// The fake's bits of a pixel that are shown.
const DEPTH: u8 = 24;
/// A still, which stays until Esc.
const STILL: [&str; 7] = ["lumen", "--at", "1", "--size", "16x9", "--threads", "1"];
/// Where there is no authority file.
const NONE: &str = "/nowhere";

/// The 64 kB build speaks X11 itself.
fn has_a_window_system() -> bool {
    !PLAIN || needs(&[Tool::Xlib])
}

/// The program at work; it ends with the test.
struct Running(Option<Child>);

impl Running {
    fn end(mut self, patience: Duration) -> Output {
        ending(self.0.take().unwrap(), patience)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Shows a still on that display, which stays until Esc.
fn show(fake: &Fake, authority: &Path) -> Running {
    // The packed file knows no scene by its name.
    start(paprsek().args(&STILL[usize::from(!PLAIN)..]), fake, authority)
}

/// Starts the program on that display.
fn start(command: &mut Command, fake: &Fake, authority: &Path) -> Running {
    command.env("DISPLAY", &fake.name).env("XAUTHORITY", authority).env_remove("XMODIFIERS");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    Running(Some(command.spawn().unwrap()))
}

/// Shows it on a display whose server talks like that.
fn against(talk: impl Fn(Client) -> Result<()> + Clone + Send + 'static) -> (Running, Fake) {
    let fake = Fake::open(talk);
    (show(&fake, NONE.as_ref()), fake)
}

/// The one line of a run that had no window: of the 64 kB build an error, of the plain build why the benchmark follows.
#[track_caller]
fn has_no_window(output: &Output) -> String {
    let said = fails(output, if PLAIN { 0 } else { 1 });
    assert!(said.starts_with("paprsek: no display"), "{said}");
    said
}

/// The same against a server that talks like that, once it is there: each is left to itself in 5 s.
fn is_left(talk: impl Fn(&mut Client) -> Result<()> + Clone + Send + 'static) {
    let (sender, over) = channel();
    let (child, _fake) = against(move |mut client| {
        let began = Instant::now();
        let _ = client.hello().and_then(|_| talk(&mut client));
        // Until it hangs up.
        while client.request().is_ok() {}
        let _ = sender.send(began.elapsed());
        Ok(())
    });
    has_no_window(&child.end(PATIENCE));
    let took = over.recv_timeout(PATIENCE).unwrap();
    assert!(took < OVER, "{took:?}");
}

#[test]
fn a_polite_server_gets_a_window() {
    if !has_a_window_system() {
        return;
    }
    let (child, _fake) = against(|mut client| {
        client.agree()?;
        client.serve_until_shown()?;
        client.press(ESC)?;
        client.serve_until(0)
    });
    assert!(succeeds(child.end(PATIENCE)).is_empty());
}

#[test]
fn silence_is_left() {
    if !has_a_window_system() {
        return;
    }
    // How much of the set-up is said, and how many answers follow.
    let cases = [(0, 0), (9, 0), (usize::MAX, 0), (usize::MAX, 1)];
    thread::scope(|scope| {
        for (bytes, answers) in cases {
            scope.spawn(move || {
                is_left(move |client| {
                    let setup = set_up(24, 32);
                    client.say(&setup[..setup.len().min(bytes)])?;
                    for _ in 0..answers {
                        let request = client.request()?;
                        client.answer(&request)?;
                    }
                    Ok(())
                });
            });
        }
    });
}

#[test]
fn a_set_up_in_drops_is_left() {
    if !has_a_window_system() {
        return;
    }
    is_left(|client| {
        for byte in set_up(24, 32) {
            client.say(&[byte])?;
            sleep(Duration::from_millis(200));
        }
        Ok(())
    });
}

#[test]
fn a_server_that_does_not_take_us_up_is_left() {
    if !has_a_window_system() {
        return;
    }
    let (fake, _listener) = Fake::deaf();
    has_no_window(&show(&fake, NONE.as_ref()).end(PATIENCE));
}

#[test]
fn odd_set_ups_are_said_in_one_line() {
    if !has_a_window_system() {
        return;
    }
    let good = set_up(24, 32);
    let words: Vec<u32> = good[8..].chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    let mut replies = vec![vec![], set_up(16, 16), vec![0; 8], vec![0xff; 8], agreed(&[u32::MAX; 0xffff])];
    // Cut off: it ends there, or says so. Before the lengths, the formats, the first screen, its depth.
    for count in [0, 4, 8, 9, 11, 20] {
        replies.push(agreed(&words[..count]));
    }
    replies.push(good[..60].to_vec());
    // More of the vendor's name, more formats; all that can be said; no screen and no format.
    for counts in [[u32::MAX, words[5]], [words[4], 0xffff], [u32::MAX, u32::MAX], [words[4], 0]] {
        replies.push(agreed(&[&words[..4], &counts, &words[6..]].concat()));
    }
    for reply in replies {
        let (child, _fake) = against(move |mut client| {
            client.hello()?;
            client.say(&reply)?;
            client.serve_until(0)
        });
        has_no_window(&child.end(PATIENCE));
    }
}

#[test]
fn the_length_of_an_answer_is_not_believed() {
    if !has_a_window_system() {
        return;
    }
    // minifb's keyboard is Xlib's.
    if PLAIN {
        return;
    }
    let (child, _fake) = against(|mut client| {
        client.agree()?;
        loop {
            let request = client.request()?;
            if request[0] == KEYBOARD_MAPPING {
                client.say(&[&[1, 1, 0, 0][..], &[0xff; 4], &[0; 24]].concat())?;
            } else {
                client.answer(&request)?;
            }
        }
    });
    has_no_window(&child.end(PATIENCE));
}

#[test]
fn a_server_that_falls_silent_later_is_a_lost_display() {
    if !has_a_window_system() {
        return;
    }
    let (sender, over) = channel();
    let (child, _fake) = against(move |mut client| {
        client.agree()?;
        client.serve_until(MAP_WINDOW)?;
        // What it draws is more than a socket holds.
        client.resize(1600, 900)?;
        sender.send(Instant::now()).unwrap();
        // Kept, but neither read nor answered any more.
        sleep(2 * PATIENCE);
        Ok(())
    });
    let began = over.recv_timeout(PATIENCE).unwrap();
    assert!(fails(&child.end(PATIENCE), 1).contains("the display"));
    assert!(began.elapsed() < OVER, "{:?}", began.elapsed());
}

#[test]
fn a_server_that_says_no_more_is_a_lost_display() {
    if !has_a_window_system() {
        return;
    }
    let (child, _fake) = against(|mut client| {
        client.agree()?;
        client.serve_until(MAP_WINDOW)?;
        client.stream.shutdown(Shutdown::Write)?;
        client.serve_until(0)
    });
    assert!(fails(&child.end(PATIENCE), 1).contains("the display"));
}

#[test]
fn esc_is_heard_while_the_server_does_not_read() {
    if !has_a_window_system() {
        return;
    }
    let busy = |client: &mut Client| {
        if PLAIN {
            // To open its window Xlib waits for answers.
            client.serve_until_shown()?;
        }
        client.resize(1600, 900)
    };
    let after = |_: &mut Client| {
        sleep(2 * PATIENCE);
        Ok(())
    };
    esc_ends(2 * AT_ONCE, busy, after);
}

/// Plays against a server that does something to the program's window, presses Esc after a pause, and then goes on. The
/// program has to end at once.
///
/// minifb hears nothing while Xlib waits or draws, so the plain build listens over a connection of its own too. A true
/// server gives a key to every client that listens to the window.
fn esc_ends(
    pause: Duration,
    busy: impl Fn(&mut Client) -> Result<()> + Clone + Send + 'static,
    after: impl Fn(&mut Client) -> Result<()> + Clone + Send + 'static,
) {
    let (sender, pressed) = channel();
    let (child, _fake) = against(move |mut client| {
        client.agree()?;
        let draws = client.serve_until_mapped()?;
        if draws {
            busy(&mut client)?;
        }
        if draws != PLAIN {
            sleep(pause);
            client.press(ESC)?;
            sender.send(()).unwrap();
        }
        after(&mut client)
    });
    pressed.recv_timeout(PATIENCE).unwrap();
    succeeds(child.end(AT_ONCE));
}

#[test]
fn esc_lets_a_still_be_saved_while_the_server_does_not_read() {
    if !has_a_window_system() {
        return;
    }
    let blocked = Arc::new(AtomicBool::new(false));
    let fake = Fake::open(move |mut client| {
        client.agree()?;
        let draws = client.serve_until_mapped()?;
        if draws {
            // A frame, and not the light that comes before it.
            client.serve_until_shows(|request| request[24..].iter().any(|byte| *byte > 0x40))?;
            client.press(S)?;
            // It has been heard when the next picture begins, whose first rows are at 0.
            client.serve_until_shows(|request| request[18..20] == [0; 2])?;
            blocked.store(true, Ordering::Relaxed);
        }
        if draws != PLAIN {
            while !blocked.load(Ordering::Relaxed) {
                sleep(Duration::from_millis(1));
            }
            client.press(ESC)?;
        }
        sleep(2 * PATIENCE);
        Ok(())
    });
    let directory = tempfile::tempdir().unwrap();
    // A still that takes longer than the process waits for Xlib.
    let quality = if PLAIN { "reference" } else { "default" };
    let words = ["--size", "640x360", "--quality", quality, "--at", "12.345", "--threads", "1"];
    let child = start(paprsek().args(words).current_dir(directory.path()), &fake, NONE.as_ref());
    assert!(succeeds(child.end(PATIENCE)).is_empty());
    let still = fs::read(directory.path().join("paprsek-intro-12.345.ppm")).unwrap();
    assert_eq!(still.len(), "P6\n640 360\n255\n".len() + 3 * 640 * 360);
}

#[test]
fn esc_is_heard_once_though_the_window_does_not_close() {
    if !has_a_window_system() {
        return;
    }
    // To close its display Xlib waits for an answer, which it would do for ever.
    let (child, _fake) = against(|mut client| {
        client.agree()?;
        if client.serve_until_mapped()? {
            client.serve_until_shown()?;
            client.press(ESC)?;
            if PLAIN {
                client.serve_until(DESTROY_WINDOW)?;
            }
        }
        sleep(2 * PATIENCE);
        Ok(())
    });
    let output = child.end(PATIENCE);
    // Only minifb has heard Esc here.
    if PLAIN { assert!(fails(&output, 1).contains("does not answer")) } else { assert!(succeeds(output).is_empty()) }
}

/// The places of the first `count` pictures of a window of that size, as left, top, width and height. Then Esc ends at
/// once. The program has less memory than minifb would take for a picture of such a window.
fn places(size: [u16; 2], count: usize) -> Vec<[usize; 4]> {
    let (tell, told) = channel();
    let enough = Arc::new(AtomicBool::new(false));
    let fake = Fake::open(move |mut client| {
        client.agree()?;
        let (mut rest, mut made) = (count, false);
        loop {
            let request = client.request()?;
            client.answer(&request)?;
            // What was put before the new size had been heard does not count.
            let number = |at: usize| usize::from(u16::from_le_bytes([request[at], request[at + 1]]));
            match request[0] {
                CREATE_WINDOW => made = true,
                MAP_WINDOW => client.resize(size[0], size[1])?,
                // The plain build draws over another connection than minifb's, and hears Esc over a third.
                CHANGE_WINDOW_ATTRIBUTES if PLAIN && !made => {
                    while !enough.load(Ordering::Relaxed) {
                        sleep(Duration::from_millis(1));
                    }
                    client.press(ESC)?;
                }
                PUT_IMAGE if request[21] == DEPTH && number(12) > 16 => {
                    let _ = tell.send((number(2), [number(16), number(18), number(12), number(14)]));
                    rest = rest.saturating_sub(1);
                    if rest == 0 {
                        enough.store(true, Ordering::Relaxed);
                        if !PLAIN {
                            client.press(ESC)?;
                        }
                    }
                }
                _ => {}
            }
        }
    });
    // The packed file knows no scene by its name.
    let child = start(crate::after("ulimit -v 1500000").args(&STILL[usize::from(!PLAIN)..]), &fake, NONE.as_ref());
    let mut places = Vec::new();
    for _ in 0..count {
        let (words, [left, top, width, height]) = told.recv_timeout(PATIENCE).unwrap();
        assert_eq!(words, 6 + width * height);
        places.push([left, top, width, height]);
    }
    let output = child.end(AT_ONCE);
    assert!(succeeds(output).is_empty());
    places
}

#[test]
fn the_largest_windows_get_a_scaled_picture_and_esc_ends_at_once() {
    if !has_a_window_system() {
        return;
    }
    // A frame has at most 16,384 pixels a side, and X counts them up to 32,767.
    for (size, [left, top, width]) in [
        ([20_000, 20_000], [0, 4375, 20_000]),
        ([20_000, 9_000], [2_000, 0, 16_000]),
        ([32_000, 9_000], [8_000, 0, 16_000]),
        ([40_000, 30_000], [0, 5784, MAX_SIDE]),
        ([u16::MAX, u16::MAX], [0, 7168, MAX_SIDE]),
    ] {
        let mut row = top;
        for place in places(size, 20) {
            assert_eq!([place[0], place[1], place[2]], [left, row, width]);
            row += place[3];
            assert!(place[3] > 0 && left + width <= MAX_SIDE && row <= MAX_SIDE);
        }
    }
}

#[test]
fn a_window_may_be_large_for_a_while() {
    if !has_a_window_system() {
        return;
    }
    // Too large for minifb from the start, then not, then twice in turn.
    const SIZES: [[u16; 2]; 5] = [[u16::MAX, 180], [160, 90], [20_000, 270], [u16::MAX, 360], [320, 180]];
    let (tell, told) = channel();
    let shown = Arc::new(AtomicUsize::new(0));
    let (child, _fake) = against(move |mut client| {
        client.agree()?;
        let (mut is_mapped, mut sizes) = (false, SIZES.iter().enumerate().peekable());
        loop {
            // minifb asks where the pointer is all the time, so this goes on whoever draws.
            let request = client.request()?;
            client.answer(&request)?;
            is_mapped |= request[0] == MAP_WINDOW;
            // Each size once the one before has been drawn.
            if is_mapped && let Some((_, size)) = sizes.next_if(|(at, _)| *at == shown.load(Ordering::Relaxed)) {
                client.resize(size[0], size[1])?;
            }
            if request[0] == PUT_IMAGE && request[21] == DEPTH {
                let width = u16::from_le_bytes([request[12], request[13]]);
                let at = shown.load(Ordering::Relaxed);
                // All have the aspect of the frame, or are too wide.
                if SIZES.get(at).is_some_and(|size| width == size[0].min(size[1] * 16 / 9)) {
                    shown.store(at + 1, Ordering::Relaxed);
                    tell.send(width).unwrap();
                }
            }
        }
    });
    let widths = SIZES.map(|_| told.recv_timeout(PATIENCE).unwrap());
    assert_eq!(widths, [320, 160, 480, 640, 320]);
    drop(child);
}

#[test]
fn esc_is_heard_while_a_large_window_is_drawn() {
    if !has_a_window_system() {
        return;
    }
    // 16,384 pixels a side, which take minifb a while: a gigabyte.
    esc_ends(AT_ONCE, |client| client.resize(16_384, 16_384), |client| client.serve_until(0));
}

/// Plays against a server that wants the cookie of that byte, with such a file of cookies.
fn with_authority(prepare: impl Fn(&Path, &str)) -> Output {
    let fake = Fake::open(|mut client| {
        if client.hello()? != [7; 16] {
            return client.say(&refusal());
        }
        client.say(&set_up(24, 32))?;
        client.serve_until_shown()?;
        client.press(ESC)?;
        client.serve_until(0)
    });
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("authority");
    prepare(&path, fake.number());
    show(&fake, &path).end(PATIENCE)
}

#[test]
fn a_cookie_that_names_no_display_fits() {
    if !has_a_window_system() {
        return;
    }
    for display in ["", "own"] {
        let output = with_authority(|path, own| {
            let number = if display == "own" { own } else { display };
            let others = [entry(number, "XDM-AUTHORIZATION-1", &[7; 16]), entry("1", COOKIES, &[1; 16])].concat();
            // Of two that fit the later may be the right one.
            let more = [entry(number, COOKIES, &[2; 16]), entry(number, COOKIES, &[7; 16])].concat();
            fs::write(path, if PLAIN { entry(number, COOKIES, &[7; 16]) } else { [others, more].concat() }).unwrap();
        });
        succeeds(output);
    }
}

#[test]
fn a_refusal_is_said() {
    if !has_a_window_system() {
        return;
    }
    let output = with_authority(|path, own| fs::write(path, entry(own, COOKIES, &[1; 16])).unwrap());
    assert!(has_no_window(&output).contains("the display refused access"));
    // Another display's cookie is not shown to this one, and one that is cut off is none.
    let output = with_authority(|path, own| {
        let cut = entry(own, COOKIES, &[7; 16]);
        fs::write(path, [&entry("1", COOKIES, &[7; 16])[..], &cut[..cut.len() - 1]].concat()).unwrap();
    });
    assert!(has_no_window(&output).contains("the display refused access"));
}

#[test]
fn an_authority_of_any_kind_is_read_in_bounded_time() {
    if !has_a_window_system() {
        return;
    }
    let fifo = |path: &Path| assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    let many = |number: &str| (0..30_000).flat_map(|_| entry(number, COOKIES, &[1; 16])).collect::<Vec<_>>();
    has_no_window(&with_authority(|path, _| fifo(path)));
    has_no_window(&with_authority(|path, _| symlink("/dev/zero", path).unwrap()));
    has_no_window(&with_authority(|path, _| fs::create_dir(path).unwrap()));
    has_no_window(&with_authority(|path, own| fs::write(path, many(own)).unwrap()));
}
