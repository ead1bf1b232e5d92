//! What minifb needs for a window on an X server, looked for beforehand.
//!
//! Where minifb 0.29 has reached the display and then finds anything amiss, it frees a graphics context that is Xlib's own
//! and dies of it without a word. Xlib in its turn reads whatever the authority's name leads to, and asks an input method
//! that nobody needs here.

use super::protocol::{Server, UNFIT};
use nix::unistd::execve;
use std::env;
use std::ffi::{CString, OsStr, OsString};
use std::fs;
use std::io;
use std::os::fd::AsFd;
use std::os::unix::ffi::OsStringExt;
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};

/// More descriptors than Xlib's connection, its libraries and files, and our own use at a time.
const DESCRIPTORS: usize = 16;
/// The variable that names an input method, and what names none.
const METHOD: &str = "XMODIFIERS";
const NONE: &str = "@im=none";

/// Is there nothing that keeps minifb from opening a window, or ends it? The error says what does.
pub fn look() -> Result<(), String> {
    descriptors()?;
    authority()?;
    server()?;
    input_method()
}

fn descriptors() -> Result<(), String> {
    let copies: io::Result<Vec<_>> = (0..DESCRIPTORS).map(|_| io::stderr().as_fd().try_clone_to_owned()).collect();
    copies.map(drop).map_err(|error| error.to_string())
}

/// Xlib waits for what a pipe says, and reads a device to the end that it does not have.
fn authority() -> Result<(), String> {
    let named = env::var_os("XAUTHORITY").map(PathBuf::from);
    let path = named.or_else(|| Some(Path::new(&env::var_os("HOME")?).join(".Xauthority")));
    let Some(path) = path.and_then(|path| path.canonicalize().ok()) else { return Ok(()) };
    let endless =
        fs::metadata(&path).is_ok_and(|about| about.file_type().is_fifo() || about.file_type().is_char_device());
    if endless && path != Path::new("/dev/null") { Err("the X authority is no file".into()) } else { Ok(()) }
}

/// A server that we do not find may be one of another machine: Xlib's error for that is a safe one.
fn server() -> Result<(), String> {
    let mut why = "";
    match Server::find(&mut why) {
        Some(server) => server.screen().map(drop).ok_or(UNFIT.into()),
        None if why.is_empty() => Ok(()),
        None => Err(why.into()),
    }
}

/// Starts the program again without an input method where the environment names one: to change it here would be unsafe code.
fn input_method() -> Result<(), String> {
    if env::var_os(METHOD).is_none_or(|named| named == NONE) {
        return Ok(());
    }
    // What came as such a string has no zero in it.
    let text = |word: OsString| CString::new(word.into_vec()).unwrap_or_default();
    let program = env::current_exe().map_err(|error| error.to_string())?;
    let words: Vec<_> = env::args_os().map(text).collect();
    let rest = env::vars_os().filter(|(name, _)| name != METHOD);
    let variables = rest.chain([(METHOD.into(), NONE.into())]).map(|(name, value)| [name, value].join(OsStr::new("=")));
    match execve(&text(program.into()), &words, &variables.map(text).collect::<Vec<_>>()) {
        Ok(never) => match never {},
        // As a number: nix has a text for each, which is 21 kB.
        Err(error) => Err(format!("cannot do without the input method (os error {})", error as i32)),
    }
}
