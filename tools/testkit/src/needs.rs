//! What a bare machine may lack: tests that need it are left out there, which one line on stderr says.
//!
//! Where the environment's `PAPRSEK_LEAVE_NOTHING_OUT` is set, as the gate sets it, such a test fails instead.

use std::env;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::Command;
use std::thread;

/// A program or library that is neither of Rust nor of a C compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// An X server without a screen.
    Xvfb,
    /// Presses keys and moves windows.
    Xdotool,
    /// ImageMagick's: takes a picture of the screen.
    Import,
    /// Runs a program on a pseudo-terminal.
    Script,
    /// Prints the tables of an executable.
    Readelf,
    /// Runs a program on a processor that it makes up.
    Qemu,
    /// The libraries that minifb loads at run time.
    Xlib,
    /// A browser that runs without a screen.
    Chromium,
    /// Runs JavaScript and WebAssembly.
    Node,
    /// A sound server.
    PulseAudio,
    /// Records what it plays.
    Parec,
}

impl Tool {
    /// What it is called, and the Debian packages that bring it.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Tool::Xvfb => ("Xvfb", "xvfb"),
            Tool::Xdotool => ("xdotool", "xdotool"),
            Tool::Import => ("ImageMagick's import", "imagemagick"),
            Tool::Script => ("script", "bsdutils"),
            Tool::Readelf => ("readelf", "binutils"),
            Tool::Qemu => ("qemu-x86_64", "qemu-user"),
            Tool::Xlib => ("libX11 and libXcursor", "libx11-6 libxcursor1"),
            Tool::Chromium => ("chromium", "chromium"),
            Tool::Node => ("node", "nodejs"),
            Tool::PulseAudio => ("pulseaudio", "pulseaudio"),
            Tool::Parec => ("parec", "pulseaudio-utils"),
        }
    }

    /// Whether this machine has it.
    fn is_there(self) -> bool {
        match self {
            // Other programs are called import too.
            Tool::Import => Command::new("import")
                .arg("-version")
                .output()
                .is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains("ImageMagick")),
            Tool::Xlib => ["libX11.so.6", "libXcursor.so.1"].iter().all(|name| is_in(name, &library_directories())),
            Tool::Xvfb
            | Tool::Xdotool
            | Tool::Script
            | Tool::Readelf
            | Tool::Qemu
            | Tool::Chromium
            | Tool::Node
            | Tool::PulseAudio
            | Tool::Parec => {
                let path = env::var_os("PATH").unwrap_or_default();
                is_in(self.names().0, &env::split_paths(&path).collect::<Vec<_>>())
            }
        }
    }
}

fn is_in(name: &str, directories: &[PathBuf]) -> bool {
    directories.iter().any(|directory| directory.join(name).is_file())
}

/// Where the loader looks by default on the usual distributions, and where it is told to.
fn library_directories() -> Vec<PathBuf> {
    let told = env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    let debian = format!("/usr/lib/{}-linux-gnu", env::consts::ARCH);
    let usual = [&*debian, "/usr/lib64", "/usr/lib", "/usr/local/lib", "/lib64", "/lib"];
    env::split_paths(&told).chain(usual.map(PathBuf::from)).collect()
}

/// Whether all of these are there. If not, the test that asks is to return: this says so.
#[must_use]
pub fn needs(tools: &[Tool]) -> bool {
    match tools.iter().find(|tool| !tool.is_there()) {
        Some(tool) => {
            let (name, packages) = tool.names();
            left_out(name, packages);
            false
        }
        None => true,
    }
}

/// Says that the calling test is left out for want of something, and which Debian packages bring it.
pub fn left_out(what: &str, packages: &str) {
    let thread = thread::current();
    let test = thread.name().filter(|name| *name != "main").unwrap_or("a test");
    let line = format!("left out: {test} needs {what} (apt install {packages})");
    assert!(env::var_os("PAPRSEK_LEAVE_NOTHING_OUT").is_none(), "{line}");
    // Not eprintln!, whose lines the test runner shows of failing tests alone. Whether anybody reads it is not ours.
    let _ = writeln!(io::stderr(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_no_directory_is_missing() {
        assert!(is_in("Cargo.toml", &[PathBuf::from("/nowhere"), PathBuf::from(env!("CARGO_MANIFEST_DIR"))]));
        assert!(!is_in("Cargo.toml", &[PathBuf::from("/nowhere")]));
        // A directory of that name is no program.
        assert!(!is_in("src", &[PathBuf::from(env!("CARGO_MANIFEST_DIR"))]));
    }
}
