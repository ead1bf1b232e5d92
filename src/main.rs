//! The intro executable.
fn main() {}
