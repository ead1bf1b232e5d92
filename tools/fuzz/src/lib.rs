//! What is fed to Paprsek to break it, and what has to hold then.
//!
//! A target takes any bytes, makes an input of them, and panics where something that must hold does not. `cargo fuzz` calls
//! targets with inputs that reach new code (`fuzz/`), the program `replay` with the kept ones and with mutations of those.
//! The README beside says which targets there are.

mod authority;
mod cloud;
mod command_line;
mod display;
mod input;
mod listener;
pub mod mutate;
mod numbers;
mod particles;
mod pixels;
mod raster;
mod scripts;
mod server;
mod solid;
mod sound_server;
mod trace;
mod unpacker;

// The intro is a program and no library, so its files are modules here too.
#[allow(dead_code, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/args.rs"]
mod args;
#[allow(dead_code, unused_imports, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/io.rs"]
mod io;
#[allow(dead_code, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/parameters.rs"]
mod parameters;
#[allow(dead_code, unused_imports, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/sound/mod.rs"]
mod sound;
#[allow(dead_code, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/text.rs"]
mod text;
#[allow(dead_code, reason = "the program uses the rest")]
#[path = "../../../src/bin/paprsek/window"]
mod window {
    mod common;
    pub mod protocol;
    mod put;
    pub mod x11;
}
// So is the machine of scripts, which the library keeps to itself.
#[allow(dead_code, unused_imports, unused_macros, reason = "scenes use the rest")]
#[path = "../../../src/scenes"]
mod scenes {
    pub mod script;
}
use paprsek::{angle, texture};

/// A target: what is done with an input.
pub type Target = fn(&[u8]);

/// The targets by name.
pub const TARGETS: [(&str, Target); 11] = [
    ("command_line", command_line::run),
    ("numbers", numbers::run),
    ("server", server::run),
    ("authority", authority::run),
    ("sound", sound_server::run),
    ("unpacker", unpacker::run),
    ("scripts", scripts::run),
    ("raster", raster::run),
    ("trace", trace::run),
    ("particles", particles::run),
    ("cloud", cloud::run),
];

/// Does with an input what the target of that name does. Panics where there is no such target.
pub fn run(target: &str, input: &[u8]) {
    let found = TARGETS.iter().find(|(name, _)| *name == target);
    let (_, run) = found.unwrap_or_else(|| panic!("no target {target}"));
    run(input);
}
