//! What minifb needs of an X server, checked before minifb starts.
//!
//! When minifb 0.29 has reached the display and then finds anything amiss, it frees a graphics context that is Xlib's
//! own, and the process dies by a signal without a word. Xlib in its turn reads whatever the name of the authority file
//! leads to, and asks an input method that nobody needs here.

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

/// File descriptors that have to be free: more than Xlib's connection, its libraries and files, and our own use at
/// once.
const DESCRIPTORS: usize = 16;
/// The variable of the environment that names an input method.
const INPUT_METHOD: &str = "XMODIFIERS";
/// Its value that names none.
const NO_INPUT_METHOD: &str = "@im=none";
/// An authority file that is a device, but ends: the usual way to have none.
const NULL: &str = "/dev/null";

/// Checks that nothing keeps minifb from opening a window or ends it, and says whether the X server is one of this
/// machine, which takes a connection of our own too. The error says what would keep minifb or end it.
pub fn check() -> Result<bool, String> {
    descriptors()?;
    authority()?;
    let is_near = server()?;
    input_method()?;
    Ok(is_near)
}

fn descriptors() -> Result<(), String> {
    let copies: io::Result<Vec<_>> = (0..DESCRIPTORS).map(|_| io::stderr().as_fd().try_clone_to_owned()).collect();
    copies.map(drop).map_err(|error| error.to_string())
}

/// Xlib would wait for ever for what a pipe says, and read a device to the end that it does not have.
fn authority() -> Result<(), String> {
    let named = env::var_os("XAUTHORITY").map(PathBuf::from);
    let path = named.or_else(|| Some(Path::new(&env::var_os("HOME")?).join(".Xauthority")));
    let Some(path) = path.and_then(|path| path.canonicalize().ok()) else { return Ok(()) };
    let endless =
        fs::metadata(&path).is_ok_and(|about| about.file_type().is_fifo() || about.file_type().is_char_device());
    if endless && path != Path::new(NULL) { Err("the X authority is not a file".into()) } else { Ok(()) }
}

/// A server that is not found here may be one of another machine, and Xlib's error for that is a safe one.
fn server() -> Result<bool, String> {
    let mut why = "";
    match Server::find(&mut why) {
        Some(server) => server.screen().map(|_| true).ok_or(UNFIT.into()),
        None if why.is_empty() => Ok(false),
        None => Err(why.into()),
    }
}

/// Starts the program again without an input method where the environment names one: changing the environment of a
/// running process is unsafe code.
fn input_method() -> Result<(), String> {
    if env::var_os(INPUT_METHOD).is_none_or(|named| named == NO_INPUT_METHOD) {
        return Ok(());
    }
    // These came as strings that end with a zero, so they have none inside.
    let text = |word: OsString| CString::new(word.into_vec()).unwrap_or_default();
    let program = env::current_exe().map_err(|error| error.to_string())?;
    let words: Vec<_> = env::args_os().map(text).collect();
    let rest = env::vars_os().filter(|(name, _)| name != INPUT_METHOD);
    let all = rest.chain([(INPUT_METHOD.into(), NO_INPUT_METHOD.into())]);
    let variables = all.map(|(name, value)| [name, value].join(OsStr::new("=")));
    match execve(&text(program.into()), &words, &variables.map(text).collect::<Vec<_>>()) {
        Ok(never) => match never {},
        // The error as a number: nix has a text for each, which is 21 kB.
        Err(error) => Err(format!("cannot restart without the input method (os error {})", error as i32)),
    }
}
