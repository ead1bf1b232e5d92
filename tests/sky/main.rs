//! The sky: where sun and moon are, the calendar, rise and set, and the light of the air.
//!
//! The truths of `oracle.toml` are NREL's SPA and libastro; what air scatters is held against an integral in f64.

mod calendar;
mod dome;
mod ephemeris;
mod published;
