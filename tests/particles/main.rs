//! Particles against a drawing of the same text in f64, with time that is never rounded.

mod fire_detail;
mod flicker;
mod history;
mod life;
mod sprites;
mod streaks;
mod truth;
