//! The command line: what was asked for, or the one line that says why not.

use crate::number::decimal;
use lexopt::{Arg, Error, Parser};
use paprsek::quality::Quality;
use paprsek::scenes::{self, Scene};
use std::ffi::OsString;
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
  --list  --help  --version
keys: Esc ends, Space pauses, Left and Right seek 5 s
";

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
        Args::parse(Parser::from_env())
    }

    fn parse(mut parser: Parser) -> Result<Args, String> {
        let mut args = Args {
            mode: Mode::Play,
            scene: None,
            size: (1280, 720),
            threads: 0,
            when: When::Whole,
            fps: 30.0,
            quality: Quality::DEFAULT,
            quality_name: "default",
        };
        let (mut bench, mut json, mut capture) = (false, false, None);
        let (mut at, mut from, mut to) = (None, None, None);
        while let Some(arg) = parser.next().map_err(explain)? {
            let name = match arg {
                Arg::Value(value) if args.scene.is_none() => {
                    args.scene = Some(scene(&value.to_string_lossy())?);
                    continue;
                }
                Arg::Value(value) => return Err(format!("one scene at a time: '{}' is too many", value.display())),
                Arg::Short(letter) => return Err(format!("there is no option '-{letter}'; see --help")),
                Arg::Long(name) => name.to_owned(),
            };
            match name.as_str() {
                "size" => args.size = size(&value(&mut parser, &name, "WxH")?)?,
                "threads" => args.threads = threads(&value(&mut parser, &name, "a number")?)?,
                "at" => at = Some(seconds(&name, &value(&mut parser, &name, "seconds")?)?),
                "from" => from = Some(seconds(&name, &value(&mut parser, &name, "seconds")?)?),
                "to" => to = Some(seconds(&name, &value(&mut parser, &name, "seconds")?)?),
                "fps" => args.fps = rate(&value(&mut parser, &name, "a number")?)?,
                "quality" => (args.quality_name, args.quality) = quality(&value(&mut parser, &name, "a name")?)?,
                "capture" => capture = Some(path(&mut parser)?),
                "bench" => bench = true,
                "json" => json = true,
                "list" => return Ok(Args { mode: Mode::List, ..args }),
                "help" => return Ok(Args { mode: Mode::Help, ..args }),
                "version" => return Ok(Args { mode: Mode::Version, ..args }),
                _ => return Err(format!("there is no option '--{name}'; see --help")),
            }
        }
        if bench && capture.is_some() {
            return Err("--bench and --capture: choose one".into());
        }
        if json && !bench {
            return Err("--json goes with --bench".into());
        }
        args.mode = match capture {
            Some(target) => Mode::Capture(target),
            None if bench => Mode::Bench { json },
            None => Mode::Play,
        };
        args.when = when(at, from, to)?;
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

/// The message for what lexopt refuses. Written here since its own `Display` quotes through `Debug`, which brings
/// the tables of Unicode into the executable.
fn explain(error: Error) -> String {
    match error {
        Error::MissingValue { option: Some(option) } => format!("{option} needs a value"),
        Error::UnexpectedValue { option, .. } => format!("{option} takes no value"),
        _ => "cannot read the command line; see --help".into(),
    }
}

/// The value of the option just read. Another option in its place is a forgotten value, not a strange one.
fn os_value(parser: &mut Parser, name: &str, what: &str) -> Result<OsString, String> {
    let value = parser.value().map_err(explain)?;
    if value.is_empty() || value.as_encoded_bytes().starts_with(b"--") {
        return Err(format!("--{name} needs {what}, not '{}'", value.display()));
    }
    Ok(value)
}

fn value(parser: &mut Parser, name: &str, what: &str) -> Result<String, String> {
    Ok(os_value(parser, name, what)?.to_string_lossy().into_owned())
}

fn path(parser: &mut Parser) -> Result<Option<PathBuf>, String> {
    let value = os_value(parser, "capture", "a directory or -")?;
    Ok((value != "-").then(|| value.into()))
}

fn scene(name: &str) -> Result<Scene, String> {
    scenes::named(name).ok_or_else(|| {
        let names: Vec<_> = scenes::all().iter().map(|scene| scene.name).collect();
        format!("there is no scene '{name}'; the scenes are {}", names.join(", "))
    })
}

fn quality(name: &str) -> Result<(&'static str, Quality), String> {
    let known = Quality::NAMES.into_iter().find(|known| *known == name);
    known
        .zip(Quality::named(name))
        .ok_or_else(|| format!("there is no quality '{name}'; the qualities are {}", Quality::NAMES.join(", ")))
}

fn size(text: &str) -> Result<(usize, usize), String> {
    let side = |side: &str| natural(side).filter(|n| (1..=MAX_SIDE).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| side(width).zip(side(height)));
    match size {
        None => Err(format!("--size needs WIDTHxHEIGHT, each 1 to {MAX_SIDE}, not '{text}'")),
        Some((width, height)) if width * height > MAX_PIXELS => {
            Err(format!("--size {text} is more than {MAX_PIXELS} pixels"))
        }
        Some(size) => Ok(size),
    }
}

fn threads(text: &str) -> Result<usize, String> {
    natural(text)
        .filter(|n| (1..=1024).contains(n))
        .ok_or_else(|| format!("--threads needs a number from 1 to 1024, not '{text}'"))
}

fn rate(text: &str) -> Result<f64, String> {
    decimal(text)
        .filter(|fps| *fps > 0.0 && *fps <= 1000.0)
        .ok_or_else(|| format!("--fps needs a number above 0, up to 1000, not '{text}'"))
}

fn seconds(name: &str, text: &str) -> Result<f64, String> {
    decimal(text).ok_or_else(|| format!("--{name} needs seconds, 0 or more, not '{text}'"))
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
