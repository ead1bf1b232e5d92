//! The command line.

use clap::Parser;
use paprsek::frame::Scene;
use paprsek::scenes;
use std::path::PathBuf;

/// Walk through a scene of Paprsek and turn every knob. F1 shows the keys.
#[derive(Parser)]
#[command(name = "explorer", version)]
pub struct Args {
    /// The scene to start with; `paprsek --list` has them
    #[arg(default_value = "snowfall", value_parser = scene)]
    pub scene: Scene,
    /// Width and height of the window, pixels: at least 320x180
    #[arg(long, default_value = "1280x720", value_parser = size)]
    pub size: (usize, usize),
    /// Threads that render; 0 for one per core
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Second of the scene at which to start, standing still
    #[arg(long)]
    pub at: Option<f64>,
    /// File that the panel has saved
    #[arg(long)]
    pub load: Option<PathBuf>,
    /// Directory for pictures, recordings, and saved settings
    #[arg(long, default_value = ".")]
    pub out: PathBuf,
    /// Program that takes what F9 records, as raw RGB frames on its standard input; {size} is their size. Without it
    /// recordings are numbered PNGs
    #[arg(long)]
    pub pipe: Option<String>,
    /// Write a line about each picture that is shown into this file, or to stdout where it is -
    #[arg(long)]
    pub state: Option<PathBuf>,
    /// Open no window: time the panel at rest and in use, at this size, and print the medians
    #[arg(long)]
    pub time_panel: bool,
}

/// Smallest window, pixels.
pub const LEAST: (usize, usize) = (320, 180);

fn scene(name: &str) -> Result<Scene, String> {
    scenes::named(name).ok_or_else(|| {
        let names: Vec<_> = scenes::all().iter().map(|scene| scene.name).collect();
        format!("the scenes are {}", names.join(", "))
    })
}

fn size(text: &str) -> Result<(usize, usize), String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match sides {
        Some((width, height)) if (LEAST.0..=16384).contains(&width) && (LEAST.1..=16384).contains(&height) => {
            Ok((width, height))
        }
        _ => Err("WxH, from 320x180 to 16384x16384".into()),
    }
}
