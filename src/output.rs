//! Bytes to stdout, stderr and files.
//!
//! Locks, buffers and names of errors, which the standard library brings for them, take 1 kB packed; so these are calls of
//! the system, and an error is its number.

use crate::number::digits;

/// What the first column of a table is filled up with.
pub const SPACES: &[u8] = &[b' '; 16];

#[cfg(unix)]
mod system {
    use rustix::fs::{self, Mode, OFlags};
    use rustix::io::{Errno, read, retry_on_intr, write};
    use rustix::stdio::{stderr, stdout};
    use std::ffi::CStr;
    use std::os::fd::{AsFd, BorrowedFd};

    fn write_all(to: BorrowedFd<'_>, mut bytes: &[u8]) -> Result<(), Errno> {
        while !bytes.is_empty() {
            let count = retry_on_intr(|| write(to, bytes))?;
            bytes = &bytes[count..];
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

    pub fn write_out(bytes: &[u8]) -> Result<(), i32> {
        write_all(stdout(), bytes).map_err(Errno::raw_os_error)
    }

    pub fn write_error(bytes: &[u8]) {
        let _ = write_all(stderr(), bytes);
    }

    pub fn make_directory(name: &[u8]) {
        let _ = fs::mkdir(named(&path(name)), Mode::from_raw_mode(0o777));
    }

    pub fn save(part: &[u8], name: &[u8], bytes: &[u8], fresh: bool) -> Result<(), i32> {
        let (part, name) = (path(part), path(name));
        let old = if fresh { OFlags::EXCL } else { OFlags::TRUNC };
        let flags = OFlags::CREATE | OFlags::WRONLY | OFlags::CLOEXEC | old;
        let (part, name) = (named(&part), named(&name));
        let file = fs::open(part, flags, Mode::from_raw_mode(0o666)).map_err(Errno::raw_os_error)?;
        write_all(file.as_fd(), bytes).and_then(|()| fs::rename(part, name)).map_err(|error| {
            // The first error is the one to report.
            let _ = fs::unlink(part);
            error.raw_os_error()
        })
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

    pub fn write_error(bytes: &[u8]) {
        let _ = io::stderr().write_all(bytes);
    }

    pub fn make_directory(name: &[u8]) {
        let _ = fs::create_dir(path(name));
    }

    pub fn save(part: &[u8], name: &[u8], bytes: &[u8], fresh: bool) -> Result<(), i32> {
        let (part, name) = (path(part), path(name));
        let mut open = fs::OpenOptions::new();
        let open = open.write(true).create(true).truncate(!fresh).create_new(fresh);
        let mut file = open.open(&part).map_err(number)?;
        file.write_all(bytes).and_then(|()| fs::rename(&part, &name)).map_err(|error| {
            let _ = fs::remove_file(&part);
            number(error)
        })
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

/// Writes a file under the name `part` first, so that the other name always holds a whole file. A `fresh` part is not
/// written over another file.
pub fn save(part: &[u8], name: &[u8], bytes: &[u8], fresh: bool) -> Result<(), Vec<u8>> {
    system::save(part, name, bytes, fresh).map_err(|error| failed(name, error))
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
