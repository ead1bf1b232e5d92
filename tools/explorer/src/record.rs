//! Recording: frames on their way to numbered PNGs or to another program, by a thread of their own.

use crate::still;
use paprsek::frame::Frame;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle, sleep};
use std::time::{Duration, Instant};

/// Frames per second of the scene.
pub const RATE: f64 = 30.0;
/// Frames that wait to be written at most; then time waits too, since none may be missing.
const WAITING: usize = 4;
/// Longest wait for a program that does not read what is left, when the explorer ends.
const PATIENCE: Duration = Duration::from_secs(10);

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
    frames: Sender<Frame>,
    /// Frames that are not written yet.
    waiting: Arc<AtomicUsize>,
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
                let made = fs::create_dir_all(&directory);
                made.map_err(|error| format!("{}: {error}", directory.display()))?;
                (directory.display().to_string(), Target::Directory(directory))
            }
        };
        let (frames, received) = channel();
        let waiting = Arc::new(AtomicUsize::new(0));
        let own = waiting.clone();
        let write = move || write(target, &received, &own);
        let thread = thread::Builder::new().spawn(write).map_err(|error| error.to_string())?;
        Ok(Recording { size, count: 0, name, frames, waiting, thread })
    }

    /// Whether there is room for the next frame: who has none is asked again, and nothing waits for him.
    pub fn has_room(&self) -> bool {
        self.waiting.load(Ordering::Relaxed) < WAITING
    }

    /// Whether the target has failed: then the recording is to be ended, which says why.
    pub fn has_failed(&self) -> bool {
        self.thread.is_finished()
    }

    /// Takes a frame.
    pub fn take(&mut self, frame: &Frame) {
        self.count += 1;
        self.waiting.fetch_add(1, Ordering::Relaxed);
        // Who no longer receives has failed, and says so in the end.
        let _ = self.frames.send(frame.clone());
    }

    /// Ends the recording: what is left is still written.
    pub fn end(self) -> Ending {
        Ending { count: self.count, name: self.name, thread: self.thread }
    }
}

/// A recording that takes no more frames, and may still be writing.
pub struct Ending {
    count: usize,
    name: String,
    thread: JoinHandle<Result<(), String>>,
}

impl Ending {
    /// Whether all is written, or has failed.
    pub fn is_over(&self) -> bool {
        self.thread.is_finished()
    }

    /// What became of it.
    pub fn told(self) -> Result<String, String> {
        let written = self.thread.join().unwrap_or_else(|_| Err("the recording failed".into()));
        written.map(|()| format!("recorded {} frames: {}", self.count, self.name))
    }

    /// Waits for it, but not for ever.
    pub fn wait(self) -> Result<String, String> {
        let began = Instant::now();
        while !self.is_over() {
            if began.elapsed() > PATIENCE {
                return Err(format!("{} does not read what is left of the recording", self.name));
            }
            sleep(Duration::from_millis(10));
        }
        self.told()
    }
}

/// Writes frames until there are no more.
fn write(target: Target, frames: &Receiver<Frame>, waiting: &AtomicUsize) -> Result<(), String> {
    match target {
        Target::Directory(directory) => {
            for (number, frame) in frames.iter().enumerate() {
                still::write(&directory.join(format!("frame-{number:06}.png")), &frame)?;
                waiting.fetch_sub(1, Ordering::Relaxed);
            }
            Ok(())
        }
        Target::Program(mut child) => {
            let mut input = child.stdin.take().ok_or("the program reads nothing")?;
            let mut write = || {
                for frame in frames {
                    input.write_all(&frame.to_rgb())?;
                    waiting.fetch_sub(1, Ordering::Relaxed);
                }
                Ok(())
            };
            let written: Result<(), std::io::Error> = write();
            drop(input);
            let status = child.wait().map_err(|error| error.to_string())?;
            written.map_err(|error| format!("the program reads no more ({error}) and ends with {status}"))?;
            if status.success() { Ok(()) } else { Err(format!("the program ends with {status}")) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(pipe: &str, frames: usize) -> Recording {
        let mut recording = Recording::start(Path::new("."), Some(pipe), (64, 36)).unwrap();
        for _ in 0..frames {
            recording.take(&Frame::new(64, 36));
        }
        recording
    }

    #[test]
    fn a_program_that_fails_or_goes_is_told_of() {
        assert!(record("cat > /dev/null", 3).end().wait().unwrap().starts_with("recorded 3 frames"));
        assert!(record("cat > /dev/null; exit 3", 3).end().wait().unwrap_err().contains("exit status: 3"));
        // 100 frames of 7 kB fill any pipe.
        assert!(record("head -c 100 > /dev/null", 100).end().wait().unwrap_err().contains("Broken pipe"));
        assert!(record("cat > /dev/full 2> /dev/null", 100).end().wait().unwrap_err().contains("the program"));
    }

    #[test]
    fn a_program_that_reads_nothing_stops_time_and_no_more() {
        let recording = record("exec sleep 30", 100);
        sleep(Duration::from_millis(200));
        assert!(!recording.has_room() && !recording.has_failed());
        let began = Instant::now();
        assert!(!recording.end().is_over() && began.elapsed() < Duration::from_secs(1));
    }
}
