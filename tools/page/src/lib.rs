//! The page: builds it into one directory of plain files, and serves such a directory on this machine.

pub mod build;
pub mod serve;

use std::path::Path;

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
