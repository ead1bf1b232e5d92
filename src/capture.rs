//! Frames to PPM files or a pipe.

use crate::args::Args;
use crate::canvas;
use paprsek::tile::{Frame, Renderer};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Pixels converted at a time: their bytes stay in the first-level cache.
const PIECE: usize = 4096;

/// Writes the frames that `args` ask for into `directory`, or to stdout where there is none.
pub fn run(args: &Args, directory: Option<&Path>) -> Result<(), String> {
    if let Some(directory) = directory {
        make(directory);
    }
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let scene = args.scene();
    for number in 0..args.frames() {
        // Divided, not accumulated: frame k is the same instant whatever was captured before it.
        let time = args.start() + number as f64 / args.fps;
        renderer.render_eyes(&scene, time, &args.quality, args.stereo, &mut frame);
        match directory {
            Some(directory) => write_file(directory, number, &frame)?,
            None => write_stdout(&frame).map_err(|error| format!("cannot write to stdout: {error}"))?,
        }
    }
    Ok(())
}

/// Makes a directory and those above it. Most exist; what fails is said by the first file that cannot be written.
fn make(directory: &Path) {
    // The standard `create_dir_all` is 3 kB with what it needs of paths.
    let path = directory.to_str().unwrap_or_default();
    for end in path.match_indices('/').map(|(at, _)| at).chain([path.len()]) {
        let _ = fs::create_dir(&path[..end]);
    }
}

/// Writes under another name first, so that a frame's own name always holds a whole frame.
fn write_file(directory: &Path, number: usize, frame: &Frame) -> Result<(), String> {
    let path = directory.join(format!("frame-{number:06}.ppm"));
    let part = directory.join(format!("frame-{number:06}.{}.part", std::process::id()));
    let written = create(&part).and_then(|mut file| write_ppm(&mut file, frame));
    written.and_then(|()| fs::rename(&part, &path)).map_err(|error| {
        // The first error is the one to report; the part may not even exist.
        let _ = fs::remove_file(&part);
        format!("cannot write {}: {error}", name(&path))
    })
}

/// An empty file. `File::create` names its errors in words, and brings the tables of Unicode for that.
#[cfg(unix)]
fn create(path: &Path) -> io::Result<File> {
    use rustix::fs::{CWD, Mode, OFlags, openat};
    let flags = OFlags::CREATE | OFlags::TRUNC | OFlags::WRONLY | OFlags::CLOEXEC;
    Ok(openat(CWD, path, flags, Mode::from_raw_mode(0o666))?.into())
}

#[cfg(not(unix))]
fn create(path: &Path) -> io::Result<File> {
    File::create(path)
}

/// What an error calls a path.
fn name(path: &Path) -> &str {
    path.to_str().unwrap_or("the file")
}

fn write_stdout(frame: &Frame) -> io::Result<()> {
    let mut out = io::stdout().lock();
    write_ppm(&mut out, frame)?;
    out.flush()
}

/// A binary PPM (P6).
fn write_ppm(out: &mut dyn Write, frame: &Frame) -> io::Result<()> {
    let mut bytes = format!("P6\n{} {}\n255\n", frame.width, frame.height).into_bytes();
    for piece in frame.pixels.chunks(PIECE) {
        for pixel in piece {
            bytes.extend_from_slice(&pixel.to_be_bytes()[1..]);
        }
        out.write_all(&bytes)?;
        bytes.clear();
    }
    Ok(())
}
