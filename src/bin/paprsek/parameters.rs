//! The parameters of scenes on the command line: `--set` reads them, `--parameters` prints them. `--set` takes the fields
//! of the settings too, and where the camera and the aeroplane are.

use crate::io::print;
use crate::text::{decimal, digits, fill};
use paprsek::frame::knobs::Knob;
use paprsek::frame::placement::{CAMERA, PLANE};
use paprsek::frame::{Parameter, Scene};
use paprsek::scenes;
use std::slice;
use std::str;

/// The parameter of this name, and the number that is its value. Besides the scene's own there are the settings' and
/// those that place its camera and its aeroplane.
pub fn parse(scene: &Scene, name: &[u8], value: &[u8]) -> Result<(&'static str, f64), Vec<u8>> {
    let knob = str::from_utf8(name).ok().and_then(Knob::named);
    let mut known = scene.parameters.iter().chain(&CAMERA).chain(&PLANE).chain(knob.map(|knob| &knob.parameter));
    let Some(parameter) = known.find(|parameter| parameter.name.as_bytes() == name) else {
        if scene.parameters.is_empty() {
            return Err(fill("scene '%' has no parameters to --set", &[scene.name.as_bytes()]));
        }
        let mut why = fill("scene '%' has no parameter '%'; its parameters are", &[scene.name.as_bytes(), name]);
        for parameter in scene.parameters {
            why = fill("% %", &[&why, parameter.name.as_bytes()]);
        }
        return Err(why);
    };
    let (magnitude, sign) = value.strip_prefix(b"-").map_or((value, 1.0), |magnitude| (magnitude, -1.0));
    match decimal(magnitude).map(|magnitude| sign * magnitude).filter(|number| parameter.takes(*number)) {
        Some(number) => Ok((parameter.name, number)),
        None => {
            let takes = [&range(parameter)[..], parameter.unit.as_bytes()];
            Err(fill("--set % does not take '%': a number from %, unit %", &[name, value, takes[0], takes[1]]))
        }
    }
}

/// Prints the parameters of a scene, or of every scene: a table, or a JSON object per scene.
pub fn list(scene: Option<&'static Scene>, json: bool) -> Result<(), Vec<u8>> {
    let scenes = scene.map_or(scenes::ALL, slice::from_ref);
    if json { scenes.iter().try_for_each(|scene| print(&object(scene))) } else { print(&table(scenes)) }
}

/// A line per scene and per parameter. Columns are as wide as their longest word over all scenes.
fn table(scenes: &[Scene]) -> Vec<u8> {
    let mut rows = vec![["  name", "default", "range", "unit", "meaning"].map(|word| word.as_bytes().to_vec())];
    for Scene { name, about, parameters, .. } in scenes {
        rows.push([name, "", "", "", about].map(|word| word.as_bytes().to_vec()));
        for parameter in *parameters {
            let Parameter { name, unit, default, about, .. } = parameter;
            let name = fill("  %", &[name.as_bytes()]);
            rows.push([name, number(*default), range(parameter), unit.as_bytes().to_vec(), about.as_bytes().to_vec()]);
        }
    }
    let widths = [0, 1, 2, 3].map(|column| rows.iter().map(|row| row[column].len()).max().unwrap_or(0));
    let mut text = Vec::new();
    for row in &rows {
        for (column, (word, width)) in row.iter().zip(widths).enumerate() {
            let space = vec![b' '; width - word.len()];
            // Numbers are aligned to the right.
            let parts = if column == 1 || column == 2 { [&space, word] } else { [word, &space] };
            text.extend(fill("%%  ", &parts.map(|part| &part[..])));
        }
        text.extend(fill("%\n", &[&row[4]]));
    }
    text
}

/// A line of JSON. No text in it has characters that JSON would escape, which a test holds.
fn object(scene: &Scene) -> Vec<u8> {
    let mut list = Vec::new();
    for (place, Parameter { name, unit, range: (least, most), default, about }) in scene.parameters.iter().enumerate() {
        const ROW: &str = r#"%{"name":"%","unit":"%","least":%,"most":%,"default":%,"about":"%"}"#;
        let comma = if place > 0 { "," } else { "" };
        let [name, unit, about, comma] = [name, unit, about, comma].map(str::as_bytes);
        let [least, most, default] = &[least, most, default].map(|value| number(*value));
        list.extend(fill(ROW, &[comma, name, unit, least, most, default, about]));
    }
    let (name, about, duration) = (scene.name.as_bytes(), scene.about.as_bytes(), number(scene.duration));
    fill("{\"scene\":\"%\",\"about\":\"%\",\"duration\":%,\"parameters\":[%]}\n", &[name, about, &duration, &list])
}

/// A range as words.
fn range(parameter: &Parameter) -> Vec<u8> {
    let (least, most) = parameter.range;
    fill("% to %", &[&number(least), &number(most)])
}

/// A number with as many decimals as it has, up to six: those of all tables have no more.
fn number(value: f64) -> Vec<u8> {
    const PLACES: usize = 6;
    let parts = (value.abs() * 1e6).round() as usize;
    let (whole, part) = (parts / 1_000_000, parts % 1_000_000);
    // The one before them keeps the zeros.
    let decimals = &digits(1_000_000 + part)[1..];
    let length = (0..PLACES).rev().find(|&place| decimals[place] != b'0').map_or(0, |place| place + 1);
    let sign = if value < 0.0 { "-" } else { "" };
    let point = if length > 0 { "." } else { "" };
    fill("%%%%", &[sign.as_bytes(), &digits(whole), point.as_bytes(), &decimals[..length]])
}
