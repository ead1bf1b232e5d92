//! The show and its parts.

pub mod clouds;
pub mod day;
pub mod intro;
pub mod letters;
pub mod lumen;
pub mod snowfall;
pub mod torches;
