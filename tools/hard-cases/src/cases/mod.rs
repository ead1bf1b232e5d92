//! The cases by renderer.

mod adaptive;
mod clouds;
mod color;
mod ephemeris;
mod frames;
mod noise;
mod octaves;
mod particles;
mod pictures;
mod rays;
mod reflectance;
mod shadows;
mod sky;
mod time;
mod triangles;
mod voxels;

use crate::case::Case;

/// The chapters of the page with their cases.
pub const CHAPTERS: &[(&str, &[Case])] = &[
    ("Rays: where lines meet bodies", rays::CASES),
    ("Rays: reflectance", reflectance::CASES),
    ("Rays: light that is known", pictures::CASES),
    ("Rays: the adaptive picture", adaptive::CASES),
    ("Noise: point by point", noise::CASES),
    ("Noise: parts, sums, distribution", octaves::CASES),
    ("Clouds: closed forms", clouds::CASES),
    ("Clouds: rays through voxels", voxels::CASES),
    ("Particles", particles::CASES),
    ("Triangles", triangles::CASES),
    ("Shadow maps and lamps", shadows::CASES),
    ("Sky: sun, moon, calendar", ephemeris::CASES),
    ("Sky: light of the air", sky::CASES),
    ("Colour and elementary functions", color::CASES),
    ("Time and random numbers", time::CASES),
    ("Frames", frames::CASES),
];
