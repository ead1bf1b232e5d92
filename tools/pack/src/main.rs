//! Builds the intro for size and packs it.

mod build;
mod toolchain;
mod x11;

use std::path::Path;
use std::process::ExitCode;
use toolchain::Toolchain;

fn main() -> ExitCode {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let target = std::env::args_os().nth(1).map_or(root.join("target/intro"), Into::into);
    match Toolchain::find().and_then(|toolchain| build::build(root, &toolchain, &target)) {
        Ok(path) => {
            println!("{}", path.display());
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("pack: {why}");
            ExitCode::FAILURE
        }
    }
}
