//! The command line: an error of one line, or values that are all within their ranges.

use crate::args::{Args, Mode};
use paprsek::frame::knobs::Knob;
use paprsek::frame::placement::{CAMERA, PLANE};

/// Words are split where this byte is.
const BETWEEN: u8 = b'\n';
/// Longest side of a picture, and most pixels, as `--help` says.
const MOST_PIXELS: usize = 67_108_864;
const LONGEST_SIDE: usize = 16_384;

pub fn run(bytes: &[u8]) {
    // Words of a command line have no zeros inside, and live as long as the process: so it forgets each.
    let bytes: Vec<u8> = bytes.iter().copied().filter(|byte| *byte != 0).collect();
    let words = bytes.leak().split(|byte| *byte == BETWEEN).filter(|word| !word.is_empty());
    let args = match Args::from_words([&b"paprsek"[..]].into_iter().chain(words)) {
        Ok(args) => args,
        Err(why) => {
            assert!(!why.is_empty(), "an error that says nothing");
            return;
        }
    };
    let (width, height) = args.size;
    assert!((1..=LONGEST_SIDE).contains(&width) && (1..=LONGEST_SIDE).contains(&height));
    assert!(width * height <= MOST_PIXELS);
    assert!(args.threads <= 1024);
    assert!(args.fps > 0.0 && args.fps <= 1000.0);
    let times = [args.start.unwrap_or(0.0), args.end_of(args.scene())];
    assert!(times.iter().all(|time| (0.0..=1e12).contains(time)), "{times:?}");
    if let Some(stereo) = args.options.stereo {
        assert!((0.0..=100.0).contains(&stereo.eye_distance) && (0.0099..=10_000.0).contains(&stereo.convergence));
        assert!(width >= 2);
    }
    for (name, value) in args.options.values {
        let knob = Knob::named(name).map(|knob| &knob.parameter);
        let placed = || CAMERA.iter().chain(&PLANE).find(|parameter| parameter.name == *name);
        let parameter = args.scene().parameter(name).or(knob).or_else(placed).expect("a parameter that there is");
        assert!(parameter.takes(*value), "{name} is {value}");
    }
    match args.mode {
        Mode::Capture(target) => {
            assert!(!target.is_empty());
            let frames = args.frames();
            assert!(frames.end <= 1_000_000 && (!args.still || frames == (0..1)), "{frames:?}");
        }
        Mode::Print(text) => assert!(text.ends_with('\n')),
        Mode::Sound(file) => assert!(!file.is_empty() && !args.still),
        Mode::Pixel((x, y)) => assert!(x < width && y < height),
        Mode::Play | Mode::List | Mode::Bench { .. } | Mode::Parameters { .. } => {}
    }
}
