//! The sky: where sun and moon are, the calendar, rise and set, and the light of the air.
//!
//! The truths of `sky/oracle.toml` are NREL's SPA and libastro; what air scatters is held against an integral in f64.

#[path = "sky/calendar.rs"]
mod calendar;
mod common;
#[path = "sky/dome.rs"]
mod dome;
#[path = "sky/ephemeris.rs"]
mod ephemeris;
