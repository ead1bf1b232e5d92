//! Bytes to stdout, stderr and files, and from files.
//!
//! The standard library's locks, buffers and texts of errors for this take 1 kB packed. So on Unix these are calls of
//! the system, and an error is its number.

use crate::text::{digits, fill};
#[cfg(target_os = "linux")]
use rustix::rand::{GetRandomFlags, getrandom};

#[cfg(unix)]
mod system {
    use rustix::event::{PollFd, PollFlags, poll};
    use rustix::fs::{self, Mode, OFlags};
    use rustix::io::{Errno, read, write};
    use rustix::stdio::{stderr, stdout};
    use std::ffi::CStr;
    use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
    #[cfg(feature = "minifb")]
    use std::{fs::File, io, sync::OnceLock};

    /// Permissions before the umask: a directory's, and a file's.
    const DIRECTORY_MODE: rustix::fs::RawMode = 0o777;
    const FILE_MODE: rustix::fs::RawMode = 0o666;
    /// Most bytes that [`contents`] reads.
    const MAX_CONTENTS: usize = 1 << 20;

    /// Writes all bytes, however slowly their reader takes them.
    pub fn write_all(to: BorrowedFd<'_>, mut bytes: &[u8]) -> Result<(), i32> {
        while !bytes.is_empty() {
            match write(to, bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(Errno::INTR) => {}
                // A full pipe that somebody has set to non-blocking.
                Err(Errno::AGAIN) => _ = poll(&mut [PollFd::new(&to, PollFlags::OUT)], None),
                Err(error) => return Err(error.raw_os_error()),
            }
        }
        Ok(())
    }

    /// A path with the zero at its end that the system wants. A word of the command line has none inside.
    fn path(bytes: &[u8]) -> Vec<u8> {
        super::fill("%\0", &[bytes])
    }

    /// A path that ends with a zero, as the system takes it.
    pub fn c_path(path: &[u8]) -> &CStr {
        CStr::from_bytes_until_nul(path).unwrap_or_default()
    }

    /// The first megabyte of a file, which is all of any file that is read here. Nothing where it cannot be read; of a
    /// pipe or a device what is there at this moment. The path ends with a zero.
    pub fn contents(path: &[u8]) -> Vec<u8> {
        let mut bytes = vec![0; MAX_CONTENTS];
        let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
        let file = fs::open(c_path(path), flags, Mode::empty());
        let length = file.and_then(|file| read(file, &mut *bytes)).unwrap_or(0);
        bytes.truncate(length);
        bytes
    }

    #[inline(never)]
    fn write_pieces(to: BorrowedFd<'_>, mut pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), i32> {
        pieces.try_for_each(|piece| write_all(to, &piece))
    }

    pub fn write_out(bytes: &[u8]) -> Result<(), i32> {
        #[cfg(all(target_os = "linux", feature = "minifb"))]
        check_stdout()?;
        write_all(stdout(), bytes)
    }

    pub fn stream(pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), i32> {
        #[cfg(all(target_os = "linux", feature = "minifb"))]
        check_stdout()?;
        write_pieces(stdout(), pieces)
    }

    /// The error of a stdout that was closed when the program started, and that leads to `/dev/null` by now. The 64 kB
    /// build leaves it closed.
    #[cfg(all(target_os = "linux", feature = "minifb"))]
    fn check_stdout() -> Result<(), i32> {
        if crate::raw::stdout_was_closed() { Err(Errno::BADF.raw_os_error()) } else { Ok(()) }
    }

    /// A copy of stderr from the time before calls into Xlib redirect it.
    #[cfg(feature = "minifb")]
    static KEPT_STDERR: OnceLock<File> = OnceLock::new();

    /// Keeps a copy of stderr, to which [`write_error`] writes from now on, wherever stderr itself is redirected later.
    #[cfg(feature = "minifb")]
    pub fn keep_stderr() -> io::Result<&'static File> {
        let copy = io::stderr().as_fd().try_clone_to_owned()?;
        Ok(KEPT_STDERR.get_or_init(|| copy.into()))
    }

    pub fn write_error(bytes: &[u8]) {
        #[cfg(feature = "minifb")]
        let to = KEPT_STDERR.get().map_or(stderr(), File::as_fd);
        #[cfg(not(feature = "minifb"))]
        let to = stderr();
        let _ = write_all(to, bytes);
    }

    pub fn make_directory(name: &[u8]) {
        let _ = fs::mkdir(c_path(&path(name)), Mode::from_raw_mode(DIRECTORY_MODE));
    }

    /// Creates a file that did not exist, so it is nobody else's: a link is not followed. The path ends with a zero.
    fn create(path: &[u8]) -> Result<OwnedFd, i32> {
        let flags = OFlags::CREATE | OFlags::EXCL | OFlags::WRONLY | OFlags::CLOEXEC;
        fs::open(c_path(path), flags, Mode::from_raw_mode(FILE_MODE)).map_err(Errno::raw_os_error)
    }

    pub fn save(part: &[u8], name: &[u8], pieces: impl Iterator<Item = Vec<u8>>, fresh: bool) -> Result<(), i32> {
        let (part, name) = (path(part), path(name));
        let file = create(&part)?;
        let put = || {
            write_pieces(file.as_fd(), pieces)?;
            if fresh {
                if fs::link(c_path(&part), c_path(&name)).is_ok() {
                    return Ok(());
                }
                // Either the name is taken, and this fails; or the file system has no links, and this reserves the
                // name.
                create(&name)?;
            }
            fs::rename(c_path(&part), c_path(&name)).map_err(Errno::raw_os_error)
        };
        let done = put();
        // If the part is still there it is of no use. The first error is the one to report.
        let _ = fs::unlink(c_path(&part));
        done
    }
}

/// The same by the standard library, where the 64 kB build does not run.
#[cfg(not(unix))]
mod system {
    use std::fs;
    use std::io::{self, Write};

    fn number(error: io::Error) -> i32 {
        error.raw_os_error().unwrap_or(0)
    }

    fn path(bytes: &[u8]) -> String {
        String::from_utf8_lossy(bytes).into_owned()
    }

    pub fn write_out(bytes: &[u8]) -> Result<(), i32> {
        let mut out = io::stdout().lock();
        out.write_all(bytes).and_then(|()| out.flush()).map_err(number)
    }

    pub fn stream(mut pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), i32> {
        pieces.try_for_each(|piece| write_out(&piece))
    }

    pub fn write_error(bytes: &[u8]) {
        let _ = io::stderr().write_all(bytes);
    }

    pub fn make_directory(name: &[u8]) {
        let _ = fs::create_dir(path(name));
    }

    fn create(path: &str) -> Result<fs::File, i32> {
        fs::OpenOptions::new().write(true).create_new(true).open(path).map_err(number)
    }

    pub fn save(part: &[u8], name: &[u8], mut pieces: impl Iterator<Item = Vec<u8>>, fresh: bool) -> Result<(), i32> {
        let (part, name) = (path(part), path(name));
        let mut file = create(&part)?;
        let mut put = || {
            pieces.try_for_each(|piece| file.write_all(&piece)).map_err(number)?;
            if fresh {
                if fs::hard_link(&part, &name).is_ok() {
                    return Ok(());
                }
                create(&name)?;
            }
            fs::rename(&part, &name).map_err(number)
        };
        let done = put();
        let _ = fs::remove_file(&part);
        done
    }
}

#[cfg(unix)]
pub use system::c_path;
#[cfg(unix)]
pub use system::contents;
#[cfg(all(unix, feature = "minifb"))]
pub use system::keep_stderr;
/// Makes a directory, unless it exists or cannot be made.
pub use system::make_directory;
#[cfg(unix)]
pub use system::write_all;

/// The environment as this process got it, kept for the whole run.
#[cfg(unix)]
pub fn environment() -> &'static [u8] {
    // What is read here is leaked: dropping it would be code.
    contents(b"/proc/self/environ\0").leak()
}

/// The value of a variable of the environment, given its name with `=`.
#[cfg(unix)]
pub fn variable(environment: &'static [u8], name: &[u8]) -> Option<&'static [u8]> {
    environment.split(|byte| *byte == 0).find_map(|entry| entry.strip_prefix(name))
}

/// Writes to stdout.
pub fn print(bytes: &[u8]) -> Result<(), Vec<u8>> {
    system::write_out(bytes).map_err(|error| failed(b"to stdout", error))
}

/// Writes pieces to stdout, one after the other.
pub fn stream(pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), Vec<u8>> {
    system::stream(pieces).map_err(|error| failed(b"to stdout", error))
}

/// Writes a file in pieces. It has another name until it is complete, so whatever bears its own name is a whole file. A
/// `fresh` file never replaces another.
pub fn save(name: &[u8], pieces: impl Iterator<Item = Vec<u8>>, fresh: bool) -> Result<(), Vec<u8>> {
    let part = fill("%.%", &[name, &digits(random())]);
    system::save(&part, name, pieces, fresh).map_err(|error| failed(name, error))
}

/// A number that nobody can predict: in a directory that others may write to, nobody can have put a file or a link in
/// the way of a name with it.
#[cfg(target_os = "linux")]
fn random() -> usize {
    let mut bytes = [0; 8];
    // If this fails the name can be predicted, but a file that has it is still not overwritten.
    let _ = getrandom(&mut bytes, GetRandomFlags::empty());
    usize::from_le_bytes(bytes)
}

#[cfg(not(target_os = "linux"))]
fn random() -> usize {
    use std::hash::{BuildHasher, RandomState};
    RandomState::new().hash_one(0) as usize
}

/// Writes one line to stderr, whatever bytes the message quotes. If that fails there is no place left to say so.
pub fn complain(why: &[u8]) {
    let mut line = fill("paprsek: %", &[why]);
    for byte in &mut line {
        if byte.is_ascii_control() {
            *byte = b'?';
        }
    }
    line.push(b'\n');
    system::write_error(&line);
}

fn failed(place: &[u8], error: i32) -> Vec<u8> {
    fill("cannot write % (os error %)", &[place, &digits(error as usize)])
}
