//! Paprsek's hard cases: inputs at which renderers go wrong, held against what is known of them.
//!
//! `cargo run --release -p hard-cases` tries them all, writes `docs/hard-cases.md`, and fails where an error is beyond its
//! target; `-- --quick` tries a few inputs of each and writes nothing; `-- walk` renders random frames.

mod case;
mod cases;
mod page;
mod probe;
mod request;
mod tally;
pub mod walk;

pub use case::{Case, Effort, Outcome, Runs};
pub use cases::CHAPTERS;
pub use page::page;
