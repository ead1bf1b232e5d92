//! The show and its parts. [`intro`] plays the others; [`valley`] is what most of them have in common, and `score` is
//! the music.

pub mod clouds;
pub mod day;
pub mod intro;
pub mod letters;
pub mod lumen;
pub mod score;
pub mod snowfall;
pub mod torches;
pub mod valley;
