//! Builds the intro for size and packs it.

fn main() {}
