//! The command line: what was asked for, or the one line that says why not.

use crate::number::decimal;
use paprsek::camera::Stereo;
use paprsek::quality::Quality;
use paprsek::scenes::{self, Scene};
use std::ffi::{OsStr, OsString};
use std::path::PathBuf;

/// The text of `--help`.
pub const HELP: &str = "\
paprsek [SCENE] [options]      play the intro (or loop one SCENE) in a window; Esc or closing it ends
  --size WxH                   render size, default 1280x720          --threads N    default: all cores
  --at S | --from S --to S     one instant, or a range, in seconds     --fps N        frames per second of a capture, default 30
  --bench                      no window: time every scene (or SCENE); a table, or JSON lines with --json
  --capture DIR | -            no window: PPM files frame-000000.ppm ... in DIR, or one stream of PPMs to stdout
  --quality fast|default|exact|reference
                               fast: every shortcut, one sample a pixel; default: what the intro plays, anti-aliased;
                               exact: no shortcut, one sample at each pixel centre;
                               reference: no shortcut, 64 samples a pixel
  --stereo                     two eyes side by side; --eye-distance METRES, default 0.065; --convergence METRES, default 5
  --list  --help  --version
keys: Esc ends, Space pauses, Left and Right seek 5 s
";

/// Options that take a value, and what that is: first those of [`RANGES`], then the others; the order is that of
/// [`Args::read`].
const VALUED: [(&str, &str); 10] = [
    ("at", "seconds, 0 or more"),
    ("from", "seconds, 0 or more"),
    ("to", "seconds, 0 or more"),
    ("fps", "a number above 0, up to 1000"),
    ("eye-distance", "metres, 0 to 100"),
    ("convergence", "metres, 0.01 to 10000"),
    ("size", "WIDTHxHEIGHT, each 1 to 16384 and 67108864 pixels in all"),
    ("threads", "a number from 1 to 1024"),
    ("quality", "a name"),
    ("capture", "a directory or -"),
];
/// Places of the options in [`VALUED`] that have functions of their own.
const SIZE: usize = 6;
const THREADS: usize = 7;

/// The least and the largest value of each option that takes a decimal number. A lens shifted much farther than its
/// picture is wide, or eyes farther apart than a street, show nothing.
const RANGES: [(f64, f64); 6] =
    [(0.0, f64::MAX), (0.0, f64::MAX), (0.0, f64::MAX), (f64::MIN_POSITIVE, 1000.0), (0.0, 100.0), (0.01, 10000.0)];

/// Options that take none, in the same way.
const FLAGS: [&str; 6] = ["help", "version", "list", "bench", "json", "stereo"];

/// Metres between the eyes: the mean of adults is 0.063 (Dodgson, "Variation and extrema of human interpupillary
/// distance", 2004).
const EYE_DISTANCE: f64 = 0.065;
/// Metres to what both eyes see at the same place: the show's subjects are at 3 to 10.
const CONVERGENCE: f64 = 5.0;

/// Longest side of a picture, pixels.
const MAX_SIDE: usize = 16384;
/// Most pixels of a picture: 256 MB at four bytes.
const MAX_PIXELS: usize = 1 << 26;
/// Most frames of a capture: the numbers in the file names have six digits.
const MAX_FRAMES: usize = 1_000_000;

/// What the executable does.
#[derive(Debug, PartialEq)]
pub enum Mode {
    /// Plays in a window, or the best that there is instead.
    Play,
    /// Times scenes; JSON lines instead of a table where `json`.
    Bench {
        /// One JSON object a line instead of a table.
        json: bool,
    },
    /// Writes PPM files into a directory, or a stream of them to stdout where `None`.
    Capture(Option<PathBuf>),
    /// Prints [`HELP`].
    Help,
    /// Prints name and version.
    Version,
    /// Prints the scenes.
    List,
}

/// The instants to show, seconds of scene time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// One instant (`--at`).
    At(f64),
    /// From an instant to an end; without `--to` the end is `None`.
    Range(f64, Option<f64>),
    /// The scene as it comes.
    Whole,
}

/// A command line, checked.
#[derive(Debug)]
pub struct Args {
    /// What to do.
    pub mode: Mode,
    /// The scene, where one was named.
    pub scene: Option<Scene>,
    /// Pixels in a row, and rows.
    pub size: (usize, usize),
    /// Threads; 0 is all cores.
    pub threads: usize,
    /// Which instants.
    pub when: When,
    /// Frames per second of a capture.
    pub fps: f64,
    /// Two eyes instead of one.
    pub stereo: Option<Stereo>,
    /// Speed against error.
    pub quality: Quality,
    /// What `quality` is called.
    pub quality_name: &'static str,
}

impl Args {
    /// The scene to play: the intro where none was named.
    pub fn scene(&self) -> Scene {
        self.scene.unwrap_or(scenes::INTRO)
    }

    /// Reads the command line of this process; the error is one line without the program's name.
    pub fn from_env() -> Result<Args, String> {
        Args::read(&Words::from_env()?)
    }

    fn read(words: &Words) -> Result<Args, String> {
        let [.., size, threads, quality, capture] = &words.values;
        let [help, version, list, bench, json, stereo] = words.flags;
        let [at, from, to, fps, apart, agree] = words.numbers()?;
        let mut args = Args {
            mode: Mode::Play,
            scene: words.scene.as_deref().map(scene).transpose()?,
            size: size.as_deref().map_or(Ok((1280, 720)), self::size)?,
            threads: threads.as_deref().map_or(Ok(0), self::threads)?,
            when: when(at, from, to)?,
            fps: fps.unwrap_or(30.0),
            stereo: stereo.then_some(Stereo {
                eye_distance: apart.unwrap_or(EYE_DISTANCE) as f32,
                convergence: agree.unwrap_or(CONVERGENCE) as f32,
            }),
            quality: Quality::DEFAULT,
            quality_name: "default",
        };
        if let Some(name) = quality {
            (args.quality_name, args.quality) = self::quality(name)?;
        }
        args.mode = match capture {
            _ if help => Mode::Help,
            _ if version => Mode::Version,
            _ if list => Mode::List,
            Some(_) if bench => return Err("--bench and --capture: choose one".into()),
            _ if json && !bench => return Err("--json goes with --bench".into()),
            _ if !stereo && apart.or(agree).is_some() => {
                return Err("--eye-distance and --convergence go with --stereo".into());
            }
            _ if stereo && args.size.0 < 2 => return Err("--stereo needs a width of 2 or more".into()),
            Some(target) if target == "-" => Mode::Capture(None),
            Some(directory) => Mode::Capture(Some(directory.into())),
            None if bench => Mode::Bench { json },
            None => Mode::Play,
        };
        args.check_range()?;
        Ok(args)
    }

    /// A range must not end before it starts, and its frames must fit the file names.
    fn check_range(&self) -> Result<(), String> {
        let end = match self.mode {
            // A benchmark of all scenes has no one end; it times single instants past an end without harm.
            Mode::Bench { .. } if self.scene.is_none() => f64::INFINITY,
            _ => self.scene().duration,
        };
        match self.when {
            When::Range(from, None) if from >= end => {
                Err("--from lies after the end of the scene: give --to as well".into())
            }
            _ if matches!(self.mode, Mode::Capture(_)) && self.frames() > MAX_FRAMES => {
                Err("a capture has at most 1000000 frames".into())
            }
            _ => Ok(()),
        }
    }

    /// The first instant to show.
    pub fn start(&self) -> f64 {
        match self.when {
            When::At(at) => at,
            When::Range(from, _) => from,
            When::Whole => 0.0,
        }
    }

    /// How many frames a capture has: those before the end of its range, but at least one.
    pub fn frames(&self) -> usize {
        let end = match self.when {
            When::At(at) => at,
            When::Range(_, Some(to)) => to,
            When::Range(_, None) | When::Whole => self.scene().duration,
        };
        // A millionth of a frame is rounding of the product, not one frame more.
        (((end - self.start()) * self.fps - 1e-6).ceil() as usize).max(1)
    }
}

/// The words of a command line, sorted but not yet read.
#[derive(Default)]
struct Words {
    scene: Option<OsString>,
    /// One for each of [`VALUED`].
    values: [Option<OsString>; VALUED.len()],
    /// One for each of [`FLAGS`].
    flags: [bool; FLAGS.len()],
}

impl Words {
    fn from_env() -> Result<Words, String> {
        let mut sorted = Words::default();
        let mut words = std::env::args_os().skip(1);
        while let Some(word) = words.next() {
            let Some(option) = text(&word).strip_prefix('-') else {
                if sorted.scene.is_some() {
                    return Err(format!("one scene at a time: '{}' is too many", text(&word)));
                }
                sorted.scene = Some(word);
                continue;
            };
            let (name, given) = match option.split_once('=') {
                Some((name, value)) => (name, Some(value)),
                None => (option, None),
            };
            let is = |known: &str| name.strip_prefix('-') == Some(known);
            if let Some(flag) = FLAGS.iter().position(|known| is(known)) {
                if given.is_some() {
                    return Err(format!("-{name} takes no value"));
                }
                sorted.flags[flag] = true;
            } else if let Some(option) = VALUED.iter().position(|known| is(known.0)) {
                let value = given.map(OsString::from).or_else(|| words.next()).unwrap_or_default();
                // Another option in its place is a forgotten value, not a strange one.
                if value.is_empty() || value.as_encoded_bytes().starts_with(b"--") {
                    return Err(needs(option, &value));
                }
                sorted.values[option] = Some(value);
            } else {
                return Err(format!("there is no option '-{name}'; see --help"));
            }
        }
        Ok(sorted)
    }

    /// The decimal numbers, where they were given.
    fn numbers(&self) -> Result<[Option<f64>; RANGES.len()], String> {
        let mut numbers = [None; RANGES.len()];
        for (option, (least, most)) in RANGES.iter().enumerate() {
            if let Some(value) = &self.values[option] {
                let number = decimal(text(value)).filter(|n| n >= least && n <= most);
                numbers[option] = Some(number.ok_or_else(|| needs(option, value))?);
            }
        }
        Ok(numbers)
    }
}

/// The text of a word. What is not Unicode names nothing, and is quoted as `?`.
fn text(word: &OsStr) -> &str {
    word.to_str().unwrap_or("?")
}

/// The message about a value that will not do.
fn needs(option: usize, value: &OsStr) -> String {
    let (name, what) = VALUED[option];
    format!("--{name} needs {what}, not '{}'", text(value))
}

fn scene(name: &OsStr) -> Result<Scene, String> {
    let name = text(name);
    scenes::named(name).ok_or_else(|| {
        let names: Vec<_> = scenes::all().iter().map(|scene| scene.name).collect();
        format!("there is no scene '{name}'; the scenes are {}", names.join(", "))
    })
}

fn quality(name: &OsStr) -> Result<(&'static str, Quality), String> {
    let name = text(name);
    let known = Quality::NAMES.into_iter().find(|known| *known == name);
    known
        .zip(Quality::named(name))
        .ok_or_else(|| format!("there is no quality '{name}'; the qualities are {}", Quality::NAMES.join(", ")))
}

fn size(value: &OsStr) -> Result<(usize, usize), String> {
    let side = |side: &str| natural(side).filter(|n| (1..=MAX_SIDE).contains(n));
    let size = text(value).split_once('x').and_then(|(width, height)| side(width).zip(side(height)));
    size.filter(|(width, height)| width * height <= MAX_PIXELS).ok_or_else(|| needs(SIZE, value))
}

fn threads(value: &OsStr) -> Result<usize, String> {
    natural(text(value)).filter(|n| (1..=1024).contains(n)).ok_or_else(|| needs(THREADS, value))
}

/// Digits only: the standard parser would take a leading plus sign.
fn natural(text: &str) -> Option<usize> {
    text.parse().ok().filter(|_| !text.starts_with('+'))
}

fn when(at: Option<f64>, from: Option<f64>, to: Option<f64>) -> Result<When, String> {
    match (at, from, to) {
        (Some(_), Some(_), _) | (Some(_), _, Some(_)) => Err("--at is one instant: leave out --from and --to".into()),
        (Some(at), None, None) => Ok(When::At(at)),
        (None, None, None) => Ok(When::Whole),
        (None, from, Some(to)) if from.unwrap_or(0.0) > to => Err("--from lies after --to".into()),
        (None, from, to) => Ok(When::Range(from.unwrap_or(0.0), to)),
    }
}
