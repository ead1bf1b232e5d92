//! The command line: what was asked for, or the one line that says why not.
//!
//! Words are bytes, as a directory need not be Unicode.

#[cfg(target_os = "linux")]
use crate::io::contents;
use crate::io::fill;
use crate::text::{decimal, whole};
use paprsek::frame::pool::cores;
use paprsek::frame::{Options, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::view::Stereo;
use std::ops::Range;

/// The text of `--help`, which is the table of options too. From its second line on each has an option and what its
/// value is, where it takes one; from column [`ABOUT`] on what it does. The order is that of [`Args::read`].
macro_rules! help {
    ($play:literal, $exact:literal, $own:literal) => {
        concat!(
            $play,
            " in a window
  --at SECONDS                one instant, up to 10^12
  --from SECONDS              start there, up to 10^12
  --to SECONDS                end there, up to 10^12
  --fps N                     frames per second of a capture, or held while playing: up to 1000; default 30
  --threads N                 1 to 1024, cores at most; default: all cores
  --size WxH                  pixels: 1 to 16384 each, up to 67108864; default 1280x720, fewer if that plays too slowly
  --quality NAME              fast: every shortcut; default: anti-aliased too",
            $exact,
            "
  --capture DIR               no window: frame-N.ppm in DIR, N = seconds x fps, or a stream to stdout for -
  --fullscreen                fill the screen
  --help                      print this
",
            $own,
            "\
keys: Esc ends, Space pauses, Left and Right seek 5 s, 1 to 9 jump to a part, S saves a still, F fills the screen
"
        )
    };
}

/// With what is there to be measured, and for two eyes,
#[cfg(feature = "full")]
pub const HELP: &str = help!(
    "paprsek [SCENE] [OPTION]...   play the intro, or loop one SCENE,",
    "; exact: no shortcut; reference: 64 samples a pixel",
    "  --version                   print name and version
  --eye-distance METRES       with --stereo: 0 to 100; default 0.065
  --convergence METRES        with --stereo: 0.01 to 10000; default 5
  --stereo                    two eyes side by side
  --list                      print the scenes
  --bench                     no window: time SCENE, or every scene
  --json                      with --bench: JSON lines
"
);
/// and without them.
#[cfg(not(feature = "full"))]
pub const HELP: &str = help!("paprsek [OPTION]...           play the intro", "", "");
const ABOUT: usize = 30;
/// Options in [`HELP`].
const OPTIONS: usize = if BENCH { 17 } else { 10 };
/// Is there more to ask for than the show? Not in the 64 kB build.
pub const BENCH: bool = cfg!(feature = "full");
/// Places of the whole numbers among them.
const THREADS: usize = 4;
const SIZE: usize = 5;
const QUALITY: usize = 6;
const CAPTURE: usize = 7;

/// What goes against what, in the order in which [`Args::read`] looks.
const CLASHES: &str = "\
--at goes without --from and --to
--from lies after --to
--from lies after the end: give --to
--to or --fps is too high: frames end at 1000000
";

/// Options that take a decimal number, with the least, the largest and the usual one.
///
/// Up to some 10^12 a time in milliseconds is exact, and so is the name of its still.
/// A lens shifted much farther than its picture is wide, or eyes farther apart than a street, show nothing. The mean
/// distance of adults' eyes is 0.063 (Dodgson, "Variation and extrema of human interpupillary distance", 2004); the
/// show's subjects are at 3 to 10 metres.
const RANGES: [(usize, f64, f64, f64); 6] = [
    (0, 0.0, 1e12, 0.0),
    (1, 0.0, 1e12, 0.0),
    (2, 0.0, 1e12, f64::INFINITY),
    (3, f64::MIN_POSITIVE, 1000.0, 30.0),
    (11, 0.0, 100.0, 0.065),
    (12, 0.01, 10000.0, 5.0),
];

/// Longest side of a picture, pixels.
const MAX_SIDE: usize = 16384;
/// Most pixels of a picture: 256 MB at four bytes.
const MAX_PIXELS: usize = 1 << 26;
/// Most threads.
const MAX_THREADS: usize = 1024;
/// Where the numbers of frames end: those in the file names have six digits.
const MAX_FRAMES: usize = 1_000_000;

/// What the executable does.
pub enum Mode {
    /// Plays in a window, or the best that there is instead.
    Play,
    /// Times scenes; JSON lines instead of a table where `json`.
    #[cfg(feature = "full")]
    Bench {
        /// One JSON object a line instead of a table.
        json: bool,
    },
    /// Writes PPM files into a directory, or a stream of them to stdout where it is `-`.
    Capture(&'static [u8]),
    /// Prints a text.
    Print(&'static str),
    /// Prints the scenes.
    List,
}

/// A command line, checked.
pub struct Args {
    /// What to do.
    pub mode: Mode,
    /// The scene, where one was named.
    pub scene: Option<&'static Scene>,
    /// Pixels in a row, and rows.
    pub size: (usize, usize),
    /// Threads; 0 is all cores.
    pub threads: usize,
    /// The first instant to show, seconds of scene time; none shows the scene as it comes.
    pub start: Option<f64>,
    /// Where a range ends (`--to`).
    pub end: Option<f64>,
    /// The first instant alone (`--at`).
    pub still: bool,
    /// Frames per second of a capture, and those that playing holds.
    pub fps: f64,
    /// The window fills the screen.
    pub full: bool,
    /// Quality, eyes and parameters.
    pub options: Options<'static>,
    /// The name of the quality.
    #[cfg(feature = "full")]
    pub quality_name: &'static str,
    /// Frames may be smaller while they come late: neither size nor quality was asked for.
    pub governed: bool,
}

impl Args {
    /// The scene to play: the intro where none was named.
    pub fn scene(&self) -> &'static Scene {
        self.scene.unwrap_or(&scenes::ALL[0])
    }

    /// Reads the command line of this process; the error is one line without the program's name.
    #[inline(never)]
    pub fn from_env() -> Result<Args, Vec<u8>> {
        let mut words = words();
        let (mut scene, mut values) = (None, [None; OPTIONS]);
        // The first is the program's own name.
        words.next();
        while let Some(word) = words.next() {
            if !word.starts_with(b"-") {
                if BENCH && scene.is_none() {
                    scene = Some(named(word)?);
                    continue;
                }
                return Err(fill("there is no option '%'; see --help", &[word]));
            }
            let (name, given) = cut(word, b'=');
            let Some((option, (_, what))) = (0..OPTIONS).map(|at| (at, cut(help(at).0, b' '))).find(|o| o.1.0 == name)
            else {
                return Err(fill("there is no option '%'; see --help", &[name]));
            };
            let value = match given {
                None if what.is_some() => words.next().unwrap_or_default(),
                _ => given.unwrap_or_default(),
            };
            // Another option in its place is a forgotten value, not a strange one.
            let lacks = what.is_some() && (value.is_empty() || value.starts_with(b"--"));
            if lacks || what.is_none() && given.is_some() {
                return Err(refuse(option, value));
            }
            values[option] = Some(value);
        }
        Args::read(scene, values)
    }

    #[inline(never)]
    fn read(scene: Option<&'static Scene>, values: [Option<&'static [u8]>; OPTIONS]) -> Result<Args, Vec<u8>> {
        let refused = |option| refuse(option, values[option].unwrap_or_default());
        let (numbers, threads, size, (_quality_name, quality)) = understood(&values).map_err(refused)?;
        let [instant, from, until, fps, eye_distance, convergence] = numbers;
        let mut is = [false; 17];
        for (is, value) in is.iter_mut().zip(values) {
            *is = value.is_some();
        }
        let [at, since, to, _, _, sized, rated, capture, full, help, version, apart, agree, two, list, bench, json] =
            is;
        let (two, bench, json, target) = (BENCH && two, BENCH && bench, BENCH && json, values[CAPTURE]);
        let mode = match target {
            _ if help => Mode::Print(HELP),
            _ if BENCH && version => Mode::Print(concat!("paprsek ", env!("CARGO_PKG_VERSION"), "\n")),
            _ if BENCH && list => Mode::List,
            Some(target) => Mode::Capture(target),
            #[cfg(feature = "full")]
            None if bench => Mode::Bench { json },
            None => Mode::Play,
        };
        let stereo = two.then_some(Stereo { eye_distance: eye_distance as f32, convergence: convergence as f32 });
        let start = (at || since || to).then_some(if at { instant } else { from });
        let end = to.then_some(until);
        let (still, governed) = (at, !sized && !rated);
        let args = Args {
            mode,
            scene,
            size,
            threads,
            start,
            end,
            still,
            fps,
            full,
            options: Options { quality, stereo, values: &[] },
            #[cfg(feature = "full")]
            quality_name: _quality_name,
            governed,
        };
        // A benchmark of all scenes has no one end; it times single instants past an end without harm.
        let endless = to || bench && scene.is_none();
        let clashes = [
            at && (since || to),
            from > until,
            !endless && from >= args.scene().duration,
            capture && args.frames().end > MAX_FRAMES,
        ];
        if BENCH && (apart || agree) && !two {
            return Err(b"--eye-distance and --convergence go with --stereo".to_vec());
        }
        if two && size.0 < 2 {
            return Err(b"--stereo needs a width of 2 or more".to_vec());
        }
        if bench && capture {
            return Err(b"--bench and --capture: choose one".to_vec());
        }
        if json && !bench {
            return Err(b"--json goes with --bench".to_vec());
        }
        match clashes.into_iter().position(|clash| clash) {
            Some(clash) => Err(line(CLASHES, clash).to_vec()),
            None => Ok(args),
        }
    }

    /// Where what is shown of a scene ends, seconds.
    pub fn end(&self, scene: &Scene) -> f64 {
        if self.still { self.start } else { self.end }.unwrap_or(scene.duration)
    }

    /// The numbers of a capture's frames: number 0 for one instant, else those of the whole film, of which the n-th is at
    /// n / `fps` seconds, that are not before the start of the range but before its end. So pieces of a film share none.
    pub fn frames(&self) -> Range<usize> {
        if self.still {
            return 0..1;
        }
        // A millionth of a frame is rounding of the product.
        let [first, end] =
            [self.start.unwrap_or(0.0), self.end(self.scene())].map(|time| (time * self.fps - 1e-6).ceil() as usize);
        first..end
    }
}

/// The values of the options that have one: decimal numbers, threads, size, quality. Those that were not given are the
/// usual ones; the error is the option whose value will not do.
#[allow(clippy::type_complexity)]
#[inline(never)]
fn understood(
    values: &[Option<&[u8]>],
) -> Result<([f64; RANGES.len()], usize, (usize, usize), &'static (&'static str, Quality)), usize> {
    let mut numbers = [0.0; RANGES.len()];
    for (number, (option, least, most, usual)) in numbers.iter_mut().zip(&RANGES) {
        *number = match values.get(*option).copied().flatten() {
            Some(value) => decimal(value).filter(|number| number >= least && number <= most).ok_or(*option)?,
            None => *usual,
        };
    }
    let within = |text: &[u8], most| whole(text).filter(|number| (1..=most).contains(number));
    let threads = match values[THREADS] {
        // Threads without a core would wait for the others, and each takes memory.
        Some(value) => within(value, MAX_THREADS).ok_or(THREADS)?.min(cores()),
        None => 0,
    };
    let size = match values[SIZE] {
        Some(value) => {
            let (width, height) = cut(value, b'x');
            let sides = within(width, MAX_SIDE).zip(within(height.unwrap_or_default(), MAX_SIDE));
            sides.filter(|(width, height)| width * height <= MAX_PIXELS).ok_or(SIZE)?
        }
        None => (1280, 720),
    };
    let name = values[QUALITY].unwrap_or(b"default");
    let quality = Quality::NAMED.iter().find(|named| named.0.as_bytes() == name).ok_or(QUALITY)?;
    Ok((numbers, threads, size, quality))
}

/// The words of this process's command line, which stay for the whole run.
#[cfg(target_os = "linux")]
fn words() -> impl Iterator<Item = &'static [u8]> {
    let text: &[u8] = contents(b"/proc/self/cmdline\0").leak();
    // Each ends with a zero.
    pieces(&text[..text.len().saturating_sub(1)], 0)
}

#[cfg(not(target_os = "linux"))]
fn words() -> impl Iterator<Item = &'static [u8]> {
    std::env::args_os().map(|word| &*word.into_encoded_bytes().leak())
}

/// A line of a text.
fn line(text: &'static str, number: usize) -> &'static [u8] {
    pieces(text.as_bytes(), b'\n').nth(number).unwrap_or_default()
}

/// What is between such bytes.
fn pieces(text: &'static [u8], by: u8) -> impl Iterator<Item = &'static [u8]> {
    text.split(move |&byte| byte == by)
}

/// What [`HELP`] has about an option: its name and what its value is, then what it does.
fn help(option: usize) -> (&'static [u8], &'static [u8]) {
    let (head, about) = line(HELP, option + 1).split_at(ABOUT);
    (head.trim_ascii(), about)
}

/// What is before the first such byte, and what is after it.
fn cut(text: &[u8], at: u8) -> (&[u8], Option<&[u8]>) {
    match text.iter().position(|&byte| byte == at) {
        Some(place) => (&text[..place], Some(&text[place + 1..])),
        None => (text, None),
    }
}

/// The message about a value that will not do.
fn refuse(option: usize, value: &[u8]) -> Vec<u8> {
    let (head, about) = help(option);
    fill("% does not take '%': %", &[head, value, about])
}

fn named(name: &[u8]) -> Result<&'static Scene, Vec<u8>> {
    scenes::ALL.iter().find(|scene| scene.name.as_bytes() == name).ok_or_else(|| {
        let mut why = fill("there is no scene '%'; the scenes are", &[name]);
        for scene in scenes::ALL {
            why = fill("% %", &[&why, scene.name.as_bytes()]);
        }
        why
    })
}
