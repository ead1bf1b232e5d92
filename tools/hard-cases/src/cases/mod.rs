//! The cases by renderer.

mod color;
mod noise;
mod rays;
mod reflectance;

use crate::case::Case;

/// The chapters of the page with their cases.
pub const CHAPTERS: &[(&str, &[Case])] = &[
    ("Rays: where lines meet bodies", rays::CASES),
    ("Rays: reflectance", reflectance::CASES),
    ("Noise", noise::CASES),
    ("Colour and elementary functions", color::CASES),
];
