//! What there is to choose from, as JSON.

use paprsek::frame::{Parameter, Scene};
use paprsek::scenes;
use paprsek::scenes::show::intro::{INTRO, PARTS};
use paprsek::settings::Quality;
use serde_json::{Value, json};

/// Every scene with its parameters as `paprsek --parameters --json` prints them, the parts of the show, and the names of the
/// qualities, each in the order by which [`crate::rows::Request`] counts.
pub fn description(simd: &str) -> Value {
    let parts: Vec<_> = PARTS.iter().map(|(at, (part, _))| json!({ "at": at, "scene": part.name })).collect();
    let scenes: Vec<_> = scenes::ALL.iter().map(scene).collect();
    json!({ "simd": simd, "show": INTRO.name, "parts": parts, "qualities": Quality::NAMES, "scenes": scenes })
}

/// A scene, in the words of `paprsek --parameters --json`.
fn scene(scene: &Scene) -> Value {
    let parameters: Vec<_> = scene.parameters.iter().map(parameter).collect();
    json!({ "scene": scene.name, "about": scene.about, "duration": scene.duration, "parameters": parameters })
}

fn parameter(parameter: &Parameter) -> Value {
    let Parameter { name, unit, range: (least, most), default, about } = parameter;
    json!({ "name": name, "unit": unit, "least": least, "most": most, "default": default, "about": about })
}
