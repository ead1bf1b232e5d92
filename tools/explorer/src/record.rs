//! Recording: frames on their way to numbered PNGs or to another program, by a thread of their own.

use crate::still;
use paprsek::frame::Frame;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

/// Frames per second of the scene.
pub const RATE: f64 = 30.0;
/// Frames that wait to be written at most; then the explorer waits too, since none may be missing.
const WAITING: usize = 4;

/// Where frames go.
enum Target {
    Directory(PathBuf),
    Program(Child),
}

/// A recording under way.
pub struct Recording {
    /// The size of its frames, pixels.
    pub size: (usize, usize),
    /// Frames so far.
    pub count: usize,
    /// What it is called: the directory or the command.
    pub name: String,
    frames: SyncSender<Frame>,
    thread: JoinHandle<Result<(), String>>,
}

impl Recording {
    /// Begins to record frames of that size, into a new directory of `out` or into a program.
    pub fn start(out: &Path, pipe: Option<&str>, size: (usize, usize)) -> Result<Recording, String> {
        let (name, target) = match pipe {
            Some(command) => {
                let command = command.replace("{size}", &format!("{}x{}", size.0, size.1));
                let mut shell = Command::new("sh");
                // What the program says is nobody's picture.
                let child = shell.args(["-c", &command]).stdin(Stdio::piped()).stdout(Stdio::null()).spawn();
                (command, Target::Program(child.map_err(|error| error.to_string())?))
            }
            None => {
                let names = (1..).map(|number| out.join(format!("recording-{number}")));
                let directory = names.into_iter().find(|path| !path.exists()).ok_or("no name is free")?;
                fs::create_dir_all(&directory).map_err(|error| error.to_string())?;
                (directory.display().to_string(), Target::Directory(directory))
            }
        };
        let (frames, received) = sync_channel(WAITING);
        let write = move || write(target, &received);
        let thread = thread::Builder::new().spawn(write).map_err(|error| error.to_string())?;
        Ok(Recording { size, count: 0, name, frames, thread })
    }

    /// Takes a frame. Gives whether it was wanted: not after the target has failed.
    pub fn take(&mut self, frame: &Frame) -> bool {
        self.count += 1;
        self.frames.send(frame.clone()).is_ok()
    }

    /// Ends the recording once all frames are written.
    pub fn end(self) -> Result<String, String> {
        drop(self.frames);
        let written = self.thread.join().unwrap_or_else(|_| Err("the recording failed".into()));
        written.map(|()| format!("recorded {} frames: {}", self.count, self.name))
    }
}

/// Writes frames until there are no more.
fn write(target: Target, frames: &Receiver<Frame>) -> Result<(), String> {
    match target {
        Target::Directory(directory) => {
            for (number, frame) in frames.iter().enumerate() {
                still::write(&directory.join(format!("frame-{number:06}.png")), &frame)?;
            }
            Ok(())
        }
        Target::Program(mut child) => {
            let mut input = child.stdin.take().ok_or("the program reads nothing")?;
            for frame in frames {
                input.write_all(&frame.to_rgb()).map_err(|error| error.to_string())?;
            }
            drop(input);
            let status = child.wait().map_err(|error| error.to_string())?;
            if status.success() { Ok(()) } else { Err(format!("the program ends with {status}")) }
        }
    }
}
