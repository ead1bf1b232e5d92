//! Particles against a drawing of the same text in f64, with time that is never rounded.
#![cfg(feature = "full")]

mod common;
#[path = "particles/history.rs"]
mod history;
#[path = "particles/layer.rs"]
mod layer;
#[path = "particles/life.rs"]
mod life;
#[path = "particles/oracle.rs"]
mod oracle;
#[path = "particles/sprites.rs"]
mod sprites;
#[path = "particles/streaks.rs"]
mod streaks;
#[path = "particles/truth.rs"]
mod truth;
