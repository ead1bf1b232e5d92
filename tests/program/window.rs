//! The window, on a display of the test's own.

use crate::paprsek;
use paprsek::scenes::show::intro::PARTS;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use testkit::run::{ending, fails, succeeds};
use testkit::{Tool, needs};

/// Longest wait for anything but the end.
const PATIENCE: Duration = Duration::from_secs(20);
/// Esc ends at once: within this, on a loaded machine.
const AT_ONCE: Duration = Duration::from_secs(1);

/// A virtual display; it ends with the test.
pub struct Display(Child, pub String);

impl Display {
    /// `None` where the machine lacks what it takes.
    pub fn open() -> Option<Display> {
        Display::of("640x480x24")
    }

    /// The same with a screen of that size and depth.
    fn of(screen: &str) -> Option<Display> {
        if !(needs(&[Tool::Xvfb, Tool::Xdotool, Tool::Import]) && (!PLAIN || needs(&[Tool::Xlib]))) {
            return None;
        }
        let mut xvfb = Command::new("Xvfb");
        xvfb.args(["-displayfd", "1", "-screen", "0", screen, "-nolisten", "tcp", "-noreset"]);
        let mut child = xvfb.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut number = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb does not start");
        Some(Display(child, format!(":{}", number.trim())))
    }

    /// Plays on this display, and waits until the window shows something.
    fn play(&self, words: &[&str]) -> Child {
        self.play_in(Path::new("."), words)
    }

    /// The same in a directory.
    fn play_in(&self, directory: &Path, words: &[&str]) -> Child {
        let mut command = paprsek();
        command.args(["--size", "320x180"]).args(words).env("DISPLAY", &self.1).current_dir(directory);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let began = Instant::now();
        while self.colours() < 3 {
            assert!(child.try_wait().unwrap().is_none(), "ended before it showed anything");
            assert!(began.elapsed() < PATIENCE, "nothing to see");
            sleep(Duration::from_millis(50));
        }
        child
    }

    /// How many colours are on the screen.
    fn colours(&self) -> usize {
        let pixels = self.picture();
        let mut colours: Vec<_> = pixels.chunks_exact(3).collect();
        colours.sort();
        colours.dedup();
        colours.len()
    }

    /// The screen as bytes.
    fn picture(&self) -> Vec<u8> {
        let mut import = Command::new("import");
        let output = import.args(["-window", "root", "-depth", "8", "rgb:-"]).env("DISPLAY", &self.1).output();
        output.unwrap().stdout
    }

    pub fn xdotool(&self, words: &[&str]) -> String {
        let output = Command::new("xdotool").args(words).env("DISPLAY", &self.1).output().unwrap();
        assert!(output.status.success(), "xdotool {words:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    }

    fn window(&self) -> String {
        self.xdotool(&["search", "--name", "^Paprsek$"])
    }

    /// Waits until the window has that size.
    fn expect_size(&self, width: usize, height: usize) {
        let began = Instant::now();
        loop {
            let geometry = self.xdotool(&["getwindowgeometry", "--shell", &self.window()]);
            if geometry.contains(&format!("WIDTH={width}\nHEIGHT={height}\n")) {
                return;
            }
            assert!(began.elapsed() < PATIENCE, "{geometry}");
            sleep(Duration::from_millis(20));
        }
    }

    /// Waits until the screen shows something else, and gives it.
    fn after(&self, picture: &[u8]) -> Vec<u8> {
        let began = Instant::now();
        loop {
            let now = self.picture();
            if now != picture {
                return now;
            }
            assert!(began.elapsed() < PATIENCE, "nothing happens");
        }
    }

    /// Closes the window as a window manager does: with a message that asks it to close.
    fn ask_to_close(&self) {
        let server = UnixStream::connect(format!("/tmp/.X11-unix/X{}", &self.1[1..])).unwrap();
        (&server).write_all(&[b'l', 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0]).unwrap();
        let mut head = [0; 8];
        (&server).read_exact(&mut head).unwrap();
        assert_eq!(head[0], 1, "the display refuses");
        let mut rest = vec![0; 4 * usize::from(u16::from_le_bytes([head[6], head[7]]))];
        (&server).read_exact(&mut rest).unwrap();
        let atom = |name: &[u8]| {
            let length = name.len() as u16;
            let words = 2 + length.div_ceil(4);
            let mut request = [&[16, 0][..], &words.to_le_bytes(), &length.to_le_bytes(), &[0, 0], name].concat();
            request.resize(4 * usize::from(words), 0);
            (&server).write_all(&request).unwrap();
            let mut reply = [0; 32];
            (&server).read_exact(&mut reply).unwrap();
            <[u8; 4]>::try_from(&reply[8..12]).unwrap()
        };
        let (protocols, delete) = (atom(b"WM_PROTOCOLS"), atom(b"WM_DELETE_WINDOW"));
        let window = self.window().parse::<u32>().unwrap().to_le_bytes();
        // SendEvent of a ClientMessage (33) of 32-bit words, to this window alone.
        let event = [&[33, 32, 0, 0][..], &window, &protocols, &delete, &[0; 16]].concat();
        (&server).write_all(&[&[25, 0, 11, 0][..], &window, &[0; 4], &event].concat()).unwrap();
        // The answer to any request says that the message went out.
        atom(b"WM_PROTOCOLS");
    }

    fn kill(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        self.kill();
    }
}

#[test]
fn esc_ends_at_once() {
    let Some(display) = Display::open() else { return };
    let child = display.play(&[]);
    display.xdotool(&["key", "Escape"]);
    assert!(succeeds(ending(child, AT_ONCE)).is_empty());
}

/// A first frame that takes seconds: 21 million pixels on one thread.
const SLOW: [&str; 4] = ["--size", "1280x16384", "--threads", "1"];

#[test]
fn until_the_first_frame_a_light_runs_and_esc_ends() {
    let Some(display) = Display::open() else { return };
    let mut command = paprsek();
    command.args(SLOW).env("DISPLAY", &display.1);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let began = Instant::now();
    // xdotool reports a search that finds nothing as a failure.
    while !Command::new("xdotool")
        .args(["search", "--onlyvisible", "--name", "^Paprsek$"])
        .env("DISPLAY", &display.1)
        .output()
        .unwrap()
        .status
        .success()
    {
        assert!(began.elapsed() < PATIENCE, "no window");
        sleep(Duration::from_millis(20));
    }
    // The middle line to the middle of the screen.
    display.xdotool(&["windowmove", &display.window(), "0", "-7952"]);
    let mut picture = display.picture();
    for _ in 0..2 {
        picture = display.after(&picture);
    }
    // Black and the light.
    assert!(display.colours() <= 2);
    display.xdotool(&["key", "Escape"]);
    assert!(succeeds(ending(child, AT_ONCE)).is_empty());
}

#[test]
fn digits_jump_to_parts() {
    let Some(display) = Display::open() else { return };
    let directory = tempfile::tempdir().unwrap();
    let child = display.play_in(directory.path(), &["--at", "2"]);
    let mut before = display.picture();
    for (number, (start, _)) in PARTS.iter().enumerate().take(9).rev() {
        display.xdotool(&["key", &(number + 1).to_string()]);
        // From black to black there is no sign of it but the still's name.
        if *start == 0.0 || before.iter().any(|byte| *byte != 0) {
            before = display.after(&before);
        }
        // A jump that has not been shown yet has no still, so S is pressed until it has.
        let path = directory.path().join(format!("paprsek-intro-{start}.ppm"));
        let began = Instant::now();
        while !path.exists() {
            assert!(began.elapsed() < PATIENCE, "no {}", path.display());
            display.xdotool(&["key", "s"]);
            sleep(Duration::from_secs(1));
        }
    }
    // The last picture may have been seen while it was being put there.
    let began = Instant::now();
    loop {
        let seen = display.picture();
        sleep(Duration::from_millis(300));
        if display.picture() == seen {
            before = seen;
            break;
        }
        assert!(began.elapsed() < PATIENCE, "a still that moves");
    }
    // There is no such part.
    display.xdotool(&["key", "9"]);
    sleep(Duration::from_millis(300));
    assert!(PARTS.len() >= 9 || display.picture() == before);
    display.xdotool(&["key", "Escape"]);
    let output = ending(child, AT_ONCE);
    assert!(output.status.success());
    // All that it says is of stills that were asked for again: that they are there.
    let said = String::from_utf8_lossy(&output.stderr);
    let refused =
        |line: &str| line.starts_with("paprsek: cannot write paprsek-intro-") && line.contains("(os error 17)");
    assert!(said.lines().all(refused), "{said}");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), PARTS.len().min(9));
}

#[test]
fn a_still_is_the_capture_of_its_instant_and_is_never_overwritten() {
    let Some(display) = Display::open() else { return };
    let directory = tempfile::tempdir().unwrap();
    let child = display.play_in(directory.path(), &["--at", "12.345"]);
    let path = directory.path().join("paprsek-intro-12.345.ppm");
    display.xdotool(&["key", "s"]);
    wait_for(&path);
    let words = ["--at", "12.345", "--size", "320x180", "--capture", "-"];
    let expected = succeeds(paprsek().args(words).output().unwrap());
    let began = Instant::now();
    while fs::read(&path).unwrap() != expected {
        assert!(began.elapsed() < PATIENCE, "another picture");
    }
    fs::write(&path, "mine").unwrap();
    let before = display.picture();
    display.xdotool(&["key", "s"]);
    sleep(Duration::from_secs(1));
    // It is said, and playing goes on.
    display.xdotool(&["key", "Right"]);
    display.after(&before);
    display.xdotool(&["key", "Escape"]);
    let said = fails(&ending(child, AT_ONCE), 0);
    assert!(said.contains("paprsek-intro-12.345.ppm"), "{said}");
    assert_eq!(fs::read(&path).unwrap(), b"mine");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}

/// A still that takes a while.
const LARGE: [&str; 6] = ["--size", "2400x1600", "--at", "12.345", "--threads", "2"];

#[test]
fn esc_lets_a_still_be_saved() {
    let Some(display) = Display::open() else { return };
    let words = [&LARGE[..], &["--capture", "-"]].concat();
    let expected = succeeds(paprsek().args(words).output().unwrap());
    // While it is drawn, and while it is written.
    for pause in ["0", "0.2", "0.4", "0.6"] {
        let directory = tempfile::tempdir().unwrap();
        let child = display.play_in(directory.path(), &LARGE);
        display.xdotool(&["key", "s", "sleep", pause, "key", "Escape"]);
        assert!(succeeds(ending(child, PATIENCE)).is_empty());
        let still = fs::read(directory.path().join("paprsek-intro-12.345.ppm")).unwrap();
        assert!(still == expected, "Esc after {pause} s");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }
}

#[test]
fn a_still_has_its_name_once_it_is_whole() {
    let Some(display) = Display::open() else { return };
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("paprsek-intro-12.345.ppm");
    let child = display.play_in(directory.path(), &LARGE);
    display.xdotool(&["key", "s"]);
    let began = Instant::now();
    while !path.exists() {
        assert!(began.elapsed() < PATIENCE, "no still");
    }
    assert_eq!(fs::metadata(&path).unwrap().len(), 17 + 3 * 2400 * 1600);
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
}

#[test]
fn a_still_that_cannot_be_saved_is_said_while_the_display_hangs() {
    let Some(display) = Display::open() else { return };
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("paprsek-intro-12.345.ppm"), "mine").unwrap();
    let child = display.play_in(directory.path(), &LARGE);
    display.xdotool(&["key", "s"]);
    // So the window waits for the display while the renderer speaks.
    let signal = |name: &str| {
        let kill = Command::new("kill").args([name, &display.0.id().to_string()]).status();
        assert!(kill.unwrap().success());
    };
    signal("-STOP");
    sleep(Duration::from_secs(4));
    signal("-CONT");
    display.xdotool(&["key", "Escape"]);
    let said = fails(&ending(child, PATIENCE), 0);
    assert!(said.contains("paprsek-intro-12.345.ppm"), "{said}");
}

fn wait_for(path: &Path) {
    let began = Instant::now();
    while !path.exists() {
        assert!(began.elapsed() < PATIENCE, "no {}", path.display());
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn f_fills_the_screen_and_back() {
    let Some(display) = Display::open() else { return };
    let child = display.play(&["--at", "12"]);
    display.expect_size(320, 180);
    display.xdotool(&["key", "f"]);
    display.expect_size(640, 480);
    sleep(Duration::from_millis(500));
    // 640x360 in the middle of 640x480.
    let picture = display.picture();
    let lit = |y: usize| picture[3 * 640 * y..3 * 640 * (y + 1)].iter().any(|byte| *byte > 0);
    assert!(!lit(50) && lit(70) && lit(240) && lit(410) && !lit(430));
    display.xdotool(&["key", "f"]);
    display.expect_size(320, 180);
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
    let child = display.play(&["--at", "12", "--fullscreen"]);
    display.expect_size(640, 480);
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
}

#[test]
fn closing_ends_well() {
    let Some(display) = Display::open() else { return };
    let child = display.play(&[]);
    display.ask_to_close();
    assert!(succeeds(ending(child, AT_ONCE)).is_empty());
    let child = display.play(&[]);
    display.xdotool(&["windowclose", &display.window()]);
    assert!(succeeds(ending(child, AT_ONCE)).is_empty());
}

#[test]
fn a_lost_display_is_said_in_one_line() {
    let Some(mut display) = Display::open() else { return };
    let child = display.play(&[]);
    display.kill();
    let said = fails(&ending(child, PATIENCE), 1);
    assert!(said.contains("display"), "{said}");
}

#[test]
fn a_range_ends_by_itself() {
    let Some(display) = Display::open() else { return };
    let began = Instant::now();
    let child = display.play(&["--from", "1", "--to", "3"]);
    assert!(succeeds(ending(child, PATIENCE)).is_empty());
    assert!(began.elapsed() >= Duration::from_secs(2));
}

#[test]
fn the_show_ends_once_it_is_asked_to() {
    let Some(display) = Display::open() else { return };
    let began = Instant::now();
    // The credits end at 154 s.
    let child = display.play(&["--from", "152", "--once"]);
    assert!(succeeds(ending(child, PATIENCE)).is_empty());
    assert!(began.elapsed() >= Duration::from_secs(2));
    // A still has no end.
    let child = display.play(&["--once", "--at", "2"]);
    display.picture();
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
}

#[test]
fn a_still_stays_and_keys_move_it() {
    let Some(display) = Display::open() else { return };
    let child = display.play(&["--at", "2"]);
    let still = display.picture();
    sleep(Duration::from_millis(500));
    assert!(display.picture() == still, "a still moves");
    // A tap is over before the next frame; it counts all the same.
    display.xdotool(&["key", "--delay", "0", "Right"]);
    let began = Instant::now();
    while display.picture() == still {
        assert!(began.elapsed() < PATIENCE, "the arrow key does nothing");
    }
    display.xdotool(&["key", "--delay", "0", "Left"]);
    while display.picture() != still {
        assert!(began.elapsed() < PATIENCE, "the way back is another");
    }
    display.xdotool(&["key", "space"]);
    while display.picture() == still {
        assert!(began.elapsed() < PATIENCE, "the space bar does nothing");
    }
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
}

#[test]
fn a_window_keeps_the_aspect_when_resized() {
    let Some(display) = Display::open() else { return };
    let child = display.play(&["--at", "2"]);
    display.xdotool(&["windowsize", "--sync", &display.window(), "320", "300"]);
    sleep(Duration::from_millis(500));
    let picture = display.picture();
    let window = display.xdotool(&["getwindowgeometry", "--shell", &display.window()]);
    let side = |name: &str| -> usize {
        window.lines().find_map(|line| line.strip_prefix(name)).and_then(|text| text.parse().ok()).unwrap()
    };
    let lit = |y: usize| {
        let row = 3 * (640 * (side("Y=") + y) + side("X="));
        picture[row..row + 3 * 320].iter().any(|byte| *byte > 0)
    };
    // 320x180 in the middle of 320x300: bars of 60 rows.
    assert!(!lit(30) && lit(150) && !lit(270));
    display.xdotool(&["key", "Escape"]);
    succeeds(ending(child, AT_ONCE));
}

/// Most memory that a process may have had at once in a window of any size, MB.
const MEMORY: usize = 500;
/// Longest wait for a picture of gigabytes.
const LONG: Duration = Duration::from_secs(120);

/// Plays in a window of that size, whose middle is on the screen: the middle of what X can draw.
fn play_large(display: &Display, [width, height]: [i32; 2]) -> Child {
    let child = display.play(&["--at", "12"]);
    let window = display.window();
    display.xdotool(&["windowsize", &window, &width.to_string(), &height.to_string()]);
    let [left, top] = [width, height].map(|side| 240 - side.min(32_767) / 2);
    display.xdotool(&["windowmove", &window, &left.to_string(), &top.to_string()]);
    let began = Instant::now();
    while display.colours() < 3 {
        assert!(began.elapsed() < LONG, "nothing to see at {width}x{height}");
    }
    child
}

#[test]
fn a_window_of_any_size_has_pictures_and_esc_ends_at_once() {
    let Some(display) = Display::open() else { return };
    for size in [[16_400, 200], [40_000, 30_000], [65_535, 65_535]] {
        let child = play_large(&display, size);
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
        let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.strip_suffix("kB")?.trim().parse().ok());
        let most: usize = most.unwrap();
        assert!(most < 1000 * MEMORY, "{most} kB at {size:?}");
        display.xdotool(&["key", "Escape"]);
        assert!(succeeds(ending(child, AT_ONCE)).is_empty());
    }
}

#[test]
fn in_a_large_window_keys_are_heard_and_it_may_be_small_again() {
    let Some(display) = Display::open() else { return };
    let child = play_large(&display, [20_000, 9_000]);
    let began = Instant::now();
    let mut seen = Vec::new();
    // Until a picture is whole.
    while display.picture() != seen {
        assert!(began.elapsed() < LONG, "a still that moves");
        seen = display.picture();
        sleep(Duration::from_millis(300));
    }
    display.xdotool(&["key", "Right"]);
    while display.picture() == seen {
        assert!(began.elapsed() < LONG, "no key is heard");
    }
    let window = display.window();
    display.xdotool(&["windowsize", &window, "320", "180", "windowmove", &window, "160", "150"]);
    let lit = |x: usize, y: usize| {
        let picture = display.picture();
        picture[3 * (640 * y + x)..][..3 * 20].iter().any(|byte| *byte > 0)
    };
    while !lit(170, 160) || !lit(450, 320) || lit(100, 240) || lit(320, 120) {
        assert!(began.elapsed() < LONG, "nothing to see in an ordinary window again");
    }
    display.xdotool(&["key", "Escape"]);
    assert!(succeeds(ending(child, AT_ONCE)).is_empty());
}

/// Has it minifb, a terminal and the benchmark?
const PLAIN: bool = cfg!(feature = "minifb");

/// Ends by itself, on that display or without one.
fn short(display: &Display) -> Command {
    let mut command = paprsek();
    command.args(PLAIN.then_some("lumen")).args(["--size", "16x9", "--from", "1", "--to", "1.2"]);
    command.env("DISPLAY", &display.1).stdin(Stdio::null());
    command
}

#[test]
fn an_input_method_is_not_asked_for() {
    let Some(display) = Display::open() else { return };
    for method in ["@im=ibus", "@im=fcitx", "@im=uim", "none of these", "", "@im=none"] {
        assert!(succeeds(short(&display).env("XMODIFIERS", method).output().unwrap()).is_empty(), "{method}");
    }
}

#[test]
fn a_screen_of_other_depths_is_no_window() {
    for depth in ["8", "16"] {
        let Some(display) = Display::of(&format!("640x480x{depth}")) else { return };
        let said = fails(&short(&display).output().unwrap(), if PLAIN { 0 } else { 1 });
        assert!(said.contains("no X server with 32 bits per pixel"), "{said}");
    }
}

#[test]
fn too_few_descriptors_are_no_signal() {
    let Some(display) = Display::open() else { return };
    let command = short(&display);
    // The packed file takes a second each time.
    for limit in (4..=40).step_by(if PLAIN { 1 } else { 9 }) {
        // Standard input, output and error, and whatever else the test has left open, are among them.
        let mut shell = Command::new("sh");
        shell.args(["-c", "ulimit -n $0 && exec \"$@\"", &limit.to_string()]).arg(command.get_program());
        shell.args(command.get_args()).env_remove("XMODIFIERS").env("DISPLAY", &display.1).stdin(Stdio::null());
        let output = shell.output().unwrap();
        // A window, or what comes without one; below some limit not even a shared library can be loaded.
        assert!(output.status.code().is_some(), "{limit}: {:?}", output.status);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.lines().count() <= 1, "{limit}: {said}");
    }
}
