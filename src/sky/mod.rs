//! The sky through the day and the year: sun, moon and stars by time and place, and the light of the air between.

pub mod air;
pub mod disc;
pub mod dome;
pub mod grid;
pub mod layer;
pub mod light;
pub mod moon;
pub mod place;
pub mod stars;
pub mod sun;
pub mod time;
