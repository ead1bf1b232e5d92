//! Bytes to stdout, stderr and files.
//!
//! Locks, buffers and names of errors, which the standard library brings for them, take 1 kB packed; so these are calls of
//! the system, and an error is its number.

use crate::text::digits;
#[cfg(target_os = "linux")]
use rustix::rand::{GetRandomFlags, getrandom};

/// What the first column of a table is filled up with.
pub const SPACES: &[u8] = &[b' '; 16];

#[cfg(unix)]
mod system {
    #[cfg(feature = "minifb")]
    use crate::window::xlib_exit::stderr;
    use rustix::event::{PollFd, PollFlags, poll};
    use rustix::fs::{self, Mode, OFlags};
    use rustix::io::{Errno, read, write};
    #[cfg(not(feature = "minifb"))]
    use rustix::stdio::stderr;
    use rustix::stdio::stdout;
    use std::ffi::CStr;
    use std::os::fd::{AsFd, BorrowedFd, OwnedFd};

    fn write_all(to: BorrowedFd<'_>, mut bytes: &[u8]) -> Result<(), i32> {
        while !bytes.is_empty() {
            match write(to, bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(Errno::INTR) => {}
                // A pipe that is full and was told not to wait: its reader is slow.
                Err(Errno::AGAIN) => _ = poll(&mut [PollFd::new(&to, PollFlags::OUT)], None),
                Err(error) => return Err(error.raw_os_error()),
            }
        }
        Ok(())
    }

    /// A path with the zero behind it that the system wants. A word of the command line has none.
    fn path(bytes: &[u8]) -> Vec<u8> {
        super::fill("%\0", &[bytes])
    }

    /// Such a path, as the system takes it.
    pub fn named(path: &[u8]) -> &CStr {
        CStr::from_bytes_until_nul(path).unwrap_or_default()
    }

    /// A file's first megabyte, which is all; nothing where it cannot be read, and what a pipe or a device has just now. Its
    /// path ends with a zero.
    pub fn contents(path: &[u8]) -> Vec<u8> {
        let mut bytes = vec![0; 1 << 20];
        let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
        let file = fs::open(named(path), flags, Mode::empty());
        let length = file.and_then(|file| read(file, &mut *bytes)).unwrap_or(0);
        bytes.truncate(length);
        bytes
    }

    #[inline(never)]
    fn write_pieces(to: BorrowedFd<'_>, mut pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), i32> {
        pieces.try_for_each(|piece| write_all(to, &piece))
    }

    pub fn write_out(bytes: &[u8]) -> Result<(), i32> {
        write_all(stdout(), bytes)
    }

    pub fn stream(pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), i32> {
        write_pieces(stdout(), pieces)
    }

    pub fn write_error(bytes: &[u8]) {
        let _ = write_all(stderr(), bytes);
    }

    pub fn make_directory(name: &[u8]) {
        let _ = fs::mkdir(named(&path(name)), Mode::from_raw_mode(0o777));
    }

    /// A new file, which is nobody else's: a link is not followed. Its path ends with a zero.
    fn create(path: &[u8]) -> Result<OwnedFd, i32> {
        let flags = OFlags::CREATE | OFlags::EXCL | OFlags::WRONLY | OFlags::CLOEXEC;
        fs::open(named(path), flags, Mode::from_raw_mode(0o666)).map_err(Errno::raw_os_error)
    }

    pub fn save(part: &[u8], name: &[u8], pieces: impl Iterator<Item = Vec<u8>>, fresh: bool) -> Result<(), i32> {
        let (part, name) = (path(part), path(name));
        let file = create(&part)?;
        let put = || {
            write_pieces(file.as_fd(), pieces)?;
            if fresh {
                if fs::link(named(&part), named(&name)).is_ok() {
                    return Ok(());
                }
                // The name is taken, or the file system has no links: then it is taken now.
                create(&name)?;
            }
            fs::rename(named(&part), named(&name)).map_err(Errno::raw_os_error)
        };
        let done = put();
        // Where it is still there it is of no use. The first error is the one to report.
        let _ = fs::unlink(named(&part));
        done
    }
}

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

/// Makes a directory where there is none yet and it can be made.
pub use system::make_directory;
#[cfg(unix)]
pub use system::{contents, named};

/// The template with a word for each `%`, and for each `#` one that ends where it stands, over the spaces before it.
pub fn fill(template: &str, words: &[&[u8]]) -> Vec<u8> {
    let (mut text, mut words) = (Vec::new(), words.iter());
    for byte in template.bytes() {
        if byte == b'%' || byte == b'#' {
            let word = words.next().copied().unwrap_or_default();
            if byte == b'#' {
                text.truncate(text.len() - word.len());
            }
            text.extend_from_slice(word);
        } else {
            text.push(byte);
        }
    }
    text
}

/// Writes to stdout.
pub fn print(bytes: &[u8]) -> Result<(), Vec<u8>> {
    system::write_out(bytes).map_err(|error| failed(b"to stdout", error))
}

/// The same in pieces.
pub fn stream(pieces: impl Iterator<Item = Vec<u8>>) -> Result<(), Vec<u8>> {
    system::stream(pieces).map_err(|error| failed(b"to stdout", error))
}

/// Writes a file, in pieces, under another name first, so that its own always is a whole file's. A `fresh` one is not put
/// in place of another.
pub fn save(name: &[u8], pieces: impl Iterator<Item = Vec<u8>>, fresh: bool) -> Result<(), Vec<u8>> {
    let part = fill("%.%", &[name, &digits(chance())]);
    system::save(&part, name, pieces, fresh).map_err(|error| failed(name, error))
}

/// A number that nobody can foretell: others may write in the same directory, and their names are not to be met.
#[cfg(target_os = "linux")]
fn chance() -> usize {
    let mut bytes = [0; 8];
    // Without it a name can be foretold, but what has it is still not written over.
    let _ = getrandom(&mut bytes, GetRandomFlags::empty());
    usize::from_le_bytes(bytes)
}

#[cfg(not(target_os = "linux"))]
fn chance() -> usize {
    use std::hash::{BuildHasher, RandomState};
    RandomState::new().hash_one(0) as usize
}

/// One line on stderr, whatever the message quotes. Where that fails there is no place left to say so.
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
