//! The command line: what was asked for, or one line that says what is wrong with it.
//!
//! The text of `--help` is the table of options too, so the two cannot disagree and the 64 kB build holds one of them.
//! Words are bytes, because the name of a directory need not be Unicode.

#[cfg(target_os = "linux")]
use crate::io::contents;
#[cfg(feature = "full")]
use crate::parameters;
use crate::text::{decimal, fill, whole};
#[cfg(feature = "full")]
use fearless_simd::Level;
use paprsek::cuts;
#[cfg(feature = "full")]
use paprsek::frame::knobs::Knob;
use paprsek::frame::pool::cores;
use paprsek::frame::{Options, Scene, Values};
use paprsek::scenes;
use paprsek::scenes::show::intro::INTRO;
use paprsek::settings::Quality;
#[cfg(feature = "full")]
use paprsek::simd::level;
use paprsek::view::Stereo;
use std::ops::Range;

/// The text of `--help`, which is the table of options too. Each line from the second on has an option and the name of
/// its value, if it takes one, and from column [`ABOUT`] on what it does. The order is that of [`Args::read`].
macro_rules! help {
    ($play:literal, $exact:literal, $own:literal) => {
        concat!(
            $play,
            " in a window
  --at SECONDS                show one instant, up to 10^12
  --from SECONDS              start at this time, up to 10^12
  --to SECONDS                end at this time, up to 10^12
  --fps N                     frames per second, up to 1000; default 30
  --threads N                 1 to 1024; default and most: one per core
  --size WxH                  up to 16384 pixels each, 67108864 in all; default 1280x720, less if too slow
  --quality NAME              fast: every shortcut; default: anti-aliased too",
            $exact,
            "
  --capture DIR               write DIR/frame-N.ppm, N = seconds x fps; DIR - is stdout
  --fullscreen                fill the screen
  --no-sound                  play in silence
  --once                      end after the credits
  --help                      print this help
",
            $own,
            "\
keys: Esc quit, Space pause, Left and Right 5 s, 1 to 9 parts, S still, F full screen
"
        )
    };
}

/// The help, with what measures and what is for two eyes.
#[cfg(feature = "full")]
pub const HELP: &str = help!(
    "paprsek [SCENE] [OPTION]...   play the intro, or loop one SCENE,",
    "; exact: no shortcuts; reference: 64 samples per pixel",
    "  --version                   print name and version
  --eye-distance METRES       with --stereo: between the eyes, 0 to 100; default 0.065
  --convergence METRES        with --stereo: from the eyes to the plane of the screen, 0.01 to 10000; default 5
  --stereo                    render for two eyes, side by side
  --list                      list the scenes
  --bench                     time SCENE, or every scene, without a window
  --json                      with --bench or --parameters: print JSON lines
  --parameters                print the parameters of SCENE, or of every scene
  --set NAME=VALUE            set a parameter of SCENE, its camera or a setting; may be given several times
  --simd LEVEL                avx512, avx2, sse4.2, sse2, as this machine has them; default: the best
  --pixel X,Y                 tell how this pixel of the frame --at SECONDS comes to be; 0,0 is the top left one
  --sound FILE                write the intro's sound as a WAV file, beside a capture or alone
"
);
/// The help of the 64 kB build, which plays and captures only.
#[cfg(not(feature = "full"))]
pub const HELP: &str = help!("paprsek [OPTION]...           play the intro", "", "");
/// The column of [`HELP`] at which the text about an option begins.
const ABOUT: usize = 30;
/// The number of options where none is left out, but for `--pixel` and what follows it.
const ALL_OPTIONS: usize = 22;
/// The number of options in [`HELP`].
const OPTIONS: usize = if cuts::ALL_OPTIONS { ALL_OPTIONS + 2 } else { 12 };

// The places of options with a value in [`HELP`].
const AT: usize = 0;
const FROM: usize = 1;
const TO: usize = 2;
const FPS: usize = 3;
const THREADS: usize = 4;
const SIZE: usize = 5;
const QUALITY: usize = 6;
const CAPTURE: usize = 7;
#[cfg(feature = "full")]
const EYE_DISTANCE: usize = 13;
#[cfg(feature = "full")]
const CONVERGENCE: usize = 14;
const SET: usize = 20;
#[cfg(feature = "full")]
const SIMD: usize = 21;
#[cfg(feature = "full")]
const PIXEL: usize = 22;
#[cfg(feature = "full")]
const SOUND: usize = 23;

/// What contradicts what, in the order in which [`Args::read`] checks it.
const CLASHES: &str = "\
--at excludes --from and --to
--from is later than --to
--from is later than the end: give --to
--to or --fps is too high: frame numbers have six digits
";

/// The options that take a decimal number: their place, least value, largest value and default.
///
/// A time in milliseconds is exact up to more than 10^12 seconds, and so is the name of its still. A lens that is
/// shifted much farther than its picture is wide, or eyes farther apart than a street, show nothing. The mean distance
/// of adults' eyes is 0.063 m (Dodgson, "Variation and extrema of human interpupillary distance", 2004); the show's
/// subjects are 3 to 10 m away.
const RANGES: [(usize, f64, f64, f64); NUMBERS] = [
    (AT, 0.0, MAX_TIME, 0.0),
    (FROM, 0.0, MAX_TIME, 0.0),
    (TO, 0.0, MAX_TIME, f64::INFINITY),
    (FPS, f64::MIN_POSITIVE, 1000.0, 30.0),
    #[cfg(feature = "full")]
    (EYE_DISTANCE, 0.0, 100.0, 0.065),
    #[cfg(feature = "full")]
    (CONVERGENCE, 0.01, 10000.0, 5.0),
];
/// How many they are.
const NUMBERS: usize = if cuts::STEREO { 6 } else { 4 };

/// Latest time, seconds.
const MAX_TIME: f64 = 1e12;
/// Width and height of a frame where none are given, pixels.
const USUAL_SIZE: (usize, usize) = (1280, 720);
/// Longest side of a frame, pixels.
const MAX_SIDE: usize = 16384;
/// Most pixels of a frame, 256 MB at four bytes each.
const MAX_PIXELS: usize = 1 << 26;
/// Most threads.
const MAX_THREADS: usize = 1024;
/// Where the numbers of frames end: in the names of files they have six digits.
const MAX_FRAMES: usize = 1_000_000;

/// What the executable does.
pub enum Mode {
    /// Plays in a window, or in the next best place that there is.
    Play,
    /// Times scenes.
    #[cfg(feature = "full")]
    Bench {
        /// Whether to print one JSON object per line instead of a table.
        json: bool,
    },
    /// Writes PPM files into this directory, or a stream of them to stdout where it is `-`.
    Capture(&'static [u8]),
    /// Writes the sound of the intro into this file.
    #[cfg(feature = "full")]
    Sound(&'static [u8]),
    /// Prints a text.
    Print(&'static str),
    /// Lists the scenes.
    List,
    /// Tells how the pixel at this column and row comes to be.
    #[cfg(feature = "full")]
    Pixel((usize, usize)),
    /// Prints the parameters of the scene, or of every scene.
    #[cfg(feature = "full")]
    Parameters {
        /// Whether to print one JSON object per line instead of a table.
        json: bool,
    },
}

/// A checked command line.
pub struct Args {
    /// What to do.
    pub mode: Mode,
    /// The scene, if one was named.
    pub scene: Option<&'static Scene>,
    /// Width and height of frames, pixels.
    pub size: (usize, usize),
    /// The number of threads; 0 for all cores.
    pub threads: usize,
    /// The first instant to show, seconds of the scene. Without it the scene plays from its start.
    pub start: Option<f64>,
    /// Where a range ends (`--to`), seconds of the scene.
    pub end: Option<f64>,
    /// Whether to show the first instant alone (`--at`).
    pub still: bool,
    /// Whether to end with the scene instead of looping.
    pub once: bool,
    /// Frames per second: of a capture, or to hold while playing.
    pub fps: f64,
    /// Whether the window fills the screen.
    pub fullscreen: bool,
    /// The file for the sound of a capture.
    #[cfg(feature = "full")]
    pub sound: Option<&'static [u8]>,
    /// Whether to play in silence.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code))]
    silent: bool,
    /// Quality, eyes and parameters.
    pub options: Options<'static>,
    /// The SIMD level of the kernels.
    #[cfg(feature = "full")]
    pub level: Level,
    /// The name of the quality.
    #[cfg(feature = "full")]
    pub quality_name: &'static str,
    /// Whether frames may be smaller while they come late: not where a size or a quality was asked for.
    pub governed: bool,
}

impl Args {
    /// The scene to play: the intro if none was named.
    pub fn scene(&self) -> &'static Scene {
        self.scene.unwrap_or(&scenes::ALL[0])
    }

    /// Reads the command line of this process. An error is one line without the program's name.
    #[inline(never)]
    pub fn from_env() -> Result<Args, Vec<u8>> {
        Args::from_words(words())
    }

    /// Reads the words of a command line.
    pub fn from_words(mut words: impl Iterator<Item = &'static [u8]>) -> Result<Args, Vec<u8>> {
        let (mut scene, mut values, mut settings) = (None, [None; OPTIONS], Vec::new());
        // The first is the program's own name.
        words.next();
        while let Some(word) = words.next() {
            if !word.starts_with(b"-") {
                if cuts::SCENES && scene.is_none() {
                    scene = Some(scene_named(word)?);
                    continue;
                }
                return Err(fill("unknown option '%'; see --help", &[word]));
            }
            let (name, given) = cut(word, b'=');
            let Some((option, (_, what))) = (0..OPTIONS).map(|at| (at, cut(help(at).0, b' '))).find(|o| o.1.0 == name)
            else {
                return Err(fill("unknown option '%'; see --help", &[name]));
            };
            let value = match given {
                None if what.is_some() => words.next().unwrap_or_default(),
                _ => given.unwrap_or_default(),
            };
            // Where another option is in its place, the value was forgotten.
            let lacks = what.is_some() && (value.is_empty() || value.starts_with(b"--"));
            if lacks || what.is_none() && given.is_some() {
                return Err(refuse(option, value));
            }
            values[option] = Some(value);
            if cuts::PARAMETERS && option == SET {
                settings.push(value);
            }
        }
        Args::read(scene, values, &settings)
    }

    /// Checks the values of options against their ranges and against each other. `settings` are those of all `--set`.
    #[inline(never)]
    fn read(
        scene: Option<&'static Scene>,
        values: [Option<&'static [u8]>; OPTIONS],
        settings: &[&[u8]],
    ) -> Result<Args, Vec<u8>> {
        let refused = |option| refuse(option, values[option].unwrap_or_default());
        let (numbers, threads, size, (_quality_name, quality)) = parse(&values).map_err(refused)?;
        let [instant, from, until, fps, eyes @ ..] = numbers;
        let mut is = [false; ALL_OPTIONS];
        for (is, value) in is.iter_mut().zip(values) {
            *is = value.is_some();
        }
        let [
            at,
            since,
            to,
            _,
            _,
            sized,
            rated,
            capture,
            fullscreen,
            silent,
            once,
            help,
            version,
            apart,
            agree,
            two,
            list,
            bench,
            json,
            parameters,
            set,
            _,
        ] = is;
        let (two, bench, json) = (cuts::STEREO && two, cuts::BENCH && bench, cuts::BENCH && json);
        let target = values[CAPTURE];
        let mode = match target {
            _ if help => Mode::Print(HELP),
            _ if cuts::ALL_OPTIONS && version => Mode::Print(concat!("paprsek ", env!("CARGO_PKG_VERSION"), "\n")),
            _ if cuts::SCENES && list => Mode::List,
            #[cfg(feature = "full")]
            _ if parameters => Mode::Parameters { json },
            #[cfg(feature = "full")]
            _ if values[PIXEL].is_some() => Mode::Pixel(pixel_of(values[PIXEL], size).ok_or_else(|| refused(PIXEL))?),
            Some(target) => Mode::Capture(target),
            #[cfg(feature = "full")]
            None if values[SOUND].is_some() => Mode::Sound(values[SOUND].unwrap_or_default()),
            #[cfg(feature = "full")]
            None if bench => Mode::Bench { json },
            None => Mode::Play,
        };
        let stereo = match eyes[..] {
            [eye_distance, convergence] if two => {
                Some(Stereo { eye_distance: eye_distance as f32, convergence: convergence as f32 })
            }
            _ => None,
        };
        let start = (at || since || to).then_some(if at { instant } else { from });
        let end = to.then_some(until);
        let (still, governed) = (at, !sized && !rated);
        #[cfg(feature = "full")]
        let changes = set_values(scene, settings)?;
        #[cfg(not(feature = "full"))]
        let (changes, _): (Values, _) = (&[], settings);
        #[cfg(feature = "full")]
        let (governed, _quality_name, quality) = turned(changes, governed, _quality_name, quality);
        let args = Args {
            mode,
            scene,
            size,
            threads,
            start,
            end,
            still,
            once,
            fps,
            fullscreen,
            #[cfg(feature = "full")]
            sound: values[SOUND],
            silent,
            options: Options { quality, stereo, values: changes },
            #[cfg(feature = "full")]
            level: simd_level(values[SIMD]).ok_or_else(|| refused(SIMD))?,
            #[cfg(feature = "full")]
            quality_name: _quality_name,
            governed,
        };
        // A benchmark of all scenes has no single end, and can time instants past the end of some.
        let endless = to || bench && scene.is_none();
        let clashes = [
            at && (since || to),
            from > until,
            !endless && from >= args.scene().duration,
            capture && args.frames().end > MAX_FRAMES,
        ];
        if cuts::STEREO && (apart || agree) && !two {
            return Err(b"--eye-distance and --convergence need --stereo".to_vec());
        }
        if two && size.0 < 2 {
            return Err(b"--stereo needs a width of at least 2".to_vec());
        }
        #[cfg(feature = "full")]
        if args.sound.is_some() && (at || bench || !args.is_show()) {
            return Err(b"--sound is of the intro as it plays: it excludes SCENE, --at and --bench".to_vec());
        }
        if bench && capture {
            return Err(b"--bench excludes --capture".to_vec());
        }
        if json && !bench && !(cuts::PARAMETERS && parameters) {
            return Err(b"--json needs --bench or --parameters".to_vec());
        }
        if cuts::PARAMETERS && set && (parameters || list) {
            return Err(b"--set excludes --parameters and --list".to_vec());
        }
        match clashes.into_iter().position(|clash| clash) {
            Some(clash) => Err(line(CLASHES, clash).to_vec()),
            None => Ok(args),
        }
    }

    /// Whether the scene is the show, which alone has sound.
    fn is_show(&self) -> bool {
        !cuts::SCENES || self.scene().name == INTRO.name
    }

    /// Whether sound is to be heard.
    #[cfg(target_os = "linux")]
    pub fn sounds(&self) -> bool {
        self.is_show() && !self.still && !self.silent
    }

    /// Where the range to show of a scene ends, seconds.
    pub fn end_of(&self, scene: &Scene) -> f64 {
        if self.still { self.start } else { self.end }.unwrap_or(scene.duration)
    }

    /// The numbers of the frames to capture. For one instant that is 0. Otherwise the n-th frame of the whole film is
    /// at n / `fps` seconds, and those from the start of the range, but before its end, are captured. So pieces of a
    /// film share no frame.
    pub fn frames(&self) -> Range<usize> {
        if self.still {
            return 0..1;
        }
        // Less than a millionth of a frame is rounding of the product.
        let [first, end] =
            [self.start.unwrap_or(0.0), self.end_of(self.scene())].map(|time| (time * self.fps - 1e-6).ceil() as usize);
        first..end
    }
}

/// What `--set` has set parameters of the scene to. Of several values for one parameter the last one counts.
#[cfg(feature = "full")]
fn set_values(scene: Option<&'static Scene>, settings: &[&[u8]]) -> Result<Values<'static>, Vec<u8>> {
    let mut values: Vec<(&str, f64)> = Vec::new();
    for setting in settings {
        let scene = scene.ok_or(b"--set needs a SCENE")?;
        let (name, Some(value)) = cut(setting, b'=') else { return Err(refuse(SET, setting)) };
        let value = parameters::parse(scene, name, value)?;
        values.retain(|other| other.0 != value.0);
        values.push(value);
    }
    Ok(values.leak())
}

/// The quality with the fields that are among `values` set, its name, and whether frames may be smaller while they come
/// late: as with a quality that is asked for, not where a field is set.
#[cfg(feature = "full")]
fn turned(
    values: Values,
    governed: bool,
    name: &'static str,
    quality: &'static Quality,
) -> (bool, &'static str, &'static Quality) {
    let (mut own, mut said) = (*quality, name.to_owned());
    for (name, value) in values {
        if let Some(knob) = Knob::named(name) {
            (knob.set)(&mut own, *value);
            said += &format!(", {name}={value}");
        }
    }
    if said == name { (governed, name, quality) } else { (false, said.leak(), Box::leak(Box::new(own))) }
}

/// The SIMD level of that name, or the best one without a name; none where this machine lacks it.
#[cfg(feature = "full")]
fn simd_level(name: Option<&[u8]>) -> Option<Level> {
    let mut levels = level::all().into_iter();
    levels.find(|level| name.is_none_or(|name| name == level.0.as_bytes())).map(|level| level.1)
}

/// Column and row of a pixel of a frame of that size.
#[cfg(feature = "full")]
fn pixel_of(value: Option<&[u8]>, (width, height): (usize, usize)) -> Option<(usize, usize)> {
    let (x, y) = cut(value?, b',');
    let (x, y) = (whole(x)?, whole(y?)?);
    (x < width && y < height).then_some((x, y))
}

/// The values of the options that take one, or their defaults: decimal numbers in the order of [`RANGES`], threads,
/// size, and quality. The error is the place of an option whose value will not do.
#[allow(clippy::type_complexity)]
#[inline(never)]
fn parse(
    values: &[Option<&[u8]>],
) -> Result<([f64; NUMBERS], usize, (usize, usize), &'static (&'static str, Quality)), usize> {
    let mut numbers = [0.0; NUMBERS];
    for (number, (option, least, most, usual)) in numbers.iter_mut().zip(&RANGES) {
        *number = match values.get(*option).copied().flatten() {
            Some(value) => decimal(value).filter(|number| number >= least && number <= most).ok_or(*option)?,
            None => *usual,
        };
    }
    let within = |text: &[u8], most| whole(text).filter(|number| (1..=most).contains(number));
    let threads = match values[THREADS] {
        // Threads without a core would only wait for the others, and each takes memory.
        Some(value) => within(value, MAX_THREADS).ok_or(THREADS)?.min(cores()),
        None => 0,
    };
    let size = match values[SIZE] {
        Some(value) => {
            let (width, height) = cut(value, b'x');
            let sides = within(width, MAX_SIDE).zip(within(height.unwrap_or_default(), MAX_SIDE));
            sides.filter(|(width, height)| width * height <= MAX_PIXELS).ok_or(SIZE)?
        }
        None => USUAL_SIZE,
    };
    let name = values[QUALITY].unwrap_or(b"default");
    let quality = Quality::NAMED.iter().find(|named| named.0.as_bytes() == name).ok_or(QUALITY)?;
    Ok((numbers, threads, size, quality))
}

/// The words of this process's command line, which are kept for the whole run.
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

/// A line of a text, counted from 0.
fn line(text: &'static str, number: usize) -> &'static [u8] {
    pieces(text.as_bytes(), b'\n').nth(number).unwrap_or_default()
}

/// The pieces of a text between separators.
fn pieces(text: &'static [u8], by: u8) -> impl Iterator<Item = &'static [u8]> {
    text.split(move |&byte| byte == by)
}

/// What [`HELP`] has about an option: its name and the name of its value, and what it does.
fn help(option: usize) -> (&'static [u8], &'static [u8]) {
    let (head, about) = line(HELP, option + 1).split_at(ABOUT);
    (head.trim_ascii(), about)
}

/// What is before the first byte of this kind, and what is after it.
fn cut(text: &[u8], at: u8) -> (&[u8], Option<&[u8]>) {
    match text.iter().position(|&byte| byte == at) {
        Some(place) => (&text[..place], Some(&text[place + 1..])),
        None => (text, None),
    }
}

/// The error about a value that will not do.
fn refuse(option: usize, value: &[u8]) -> Vec<u8> {
    let (head, about) = help(option);
    fill("% does not take '%': %", &[head, value, about])
}

/// The scene of that name; the error lists those that there are.
fn scene_named(name: &[u8]) -> Result<&'static Scene, Vec<u8>> {
    scenes::ALL.iter().find(|scene| scene.name.as_bytes() == name).ok_or_else(|| {
        let mut why = fill("unknown scene '%'; the scenes are", &[name]);
        for scene in scenes::ALL {
            why = fill("% %", &[&why, scene.name.as_bytes()]);
        }
        why
    })
}
