//! The page in a real browser, and its module in node: the frames are the native ones, the keys do what they say, and what
//! breaks is mended.

mod browser;
mod bytes;
mod chrome;
mod contrast;
mod hashes;
mod node;
mod pointer;
mod site;
mod slow;
mod sound;
mod survival;
