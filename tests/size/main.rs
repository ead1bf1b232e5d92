//! What the source and its products must keep to: budgets of bytes, the packed intro, and floors of modules.

mod budget;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod intro;
