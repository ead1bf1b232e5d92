//! The parameters of scenes on the command line: `--set` reads them, `--parameters` prints them.

use crate::io::print;
use crate::text::{decimal, fill};
use paprsek::frame::{Parameter, Scene};
use paprsek::scenes;
use std::fmt::Write;
use std::slice;

/// The parameter of the scene that has this name, and the number that is its value.
pub fn parse(scene: &Scene, name: &[u8], value: &[u8]) -> Result<(&'static str, f64), Vec<u8>> {
    let known = scene.parameters.iter().find(|parameter| parameter.name.as_bytes() == name);
    let Some(parameter) = known else {
        if scene.parameters.is_empty() {
            return Err(fill("scene '%' has no parameters to --set", &[scene.name.as_bytes()]));
        }
        let mut why = fill("scene '%' has no parameter '%'; its parameters are", &[scene.name.as_bytes(), name]);
        for parameter in scene.parameters {
            why = fill("% %", &[&why, parameter.name.as_bytes()]);
        }
        return Err(why);
    };
    let (digits, sign) = value.strip_prefix(b"-").map_or((value, 1.0), |digits| (digits, -1.0));
    match decimal(digits).map(|number| sign * number).filter(|number| parameter.takes(*number)) {
        Some(number) => Ok((parameter.name, number)),
        None => {
            let Parameter { range: (least, most), unit, .. } = parameter;
            let takes = format!("a number from {least} to {most}, unit {unit}");
            Err(fill("--set % does not take '%': %", &[name, value, takes.as_bytes()]))
        }
    }
}

/// Prints the parameters of a scene, or of every scene: a table, or a JSON object per scene.
pub fn list(scene: Option<&'static Scene>, json: bool) -> Result<(), Vec<u8>> {
    let scenes = scene.map_or(scenes::ALL, slice::from_ref);
    let text: String = if json { scenes.iter().map(object).collect() } else { table(scenes) };
    print(text.as_bytes())
}

/// Columns are as wide as their longest word, over all scenes.
fn table(scenes: &[Scene]) -> String {
    let row = |parameter: &Parameter| {
        let Parameter { name, unit, range: (least, most), default, about } = parameter;
        [(*name).to_owned(), default.to_string(), format!("{least} to {most}"), (*unit).to_owned(), (*about).to_owned()]
    };
    let head = ["  name", "default", "range", "unit", "meaning"].map(str::to_owned);
    let mut rows = vec![head];
    for scene in scenes {
        rows.push([scene.name, "", "", "", scene.about].map(str::to_owned));
        rows.extend(scene.parameters.iter().map(row).map(|mut row| {
            row[0].insert_str(0, "  ");
            row
        }));
    }
    let widths: Vec<usize> = (0..5).map(|k| rows.iter().map(|row| row[k].len()).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for [name, default, range, unit, about] in rows {
        let [a, b, c, d] = [widths[0], widths[1], widths[2], widths[3]];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:a$}  {default:>b$}  {range:>c$}  {unit:d$}  {about}");
    }
    text
}

/// One line of JSON.
fn object(scene: &Scene) -> String {
    let parameter = |parameter: &Parameter| {
        let Parameter { name, unit, range: (least, most), default, about } = parameter;
        format!(
            r#"{{"name":"{name}","unit":"{unit}","least":{least},"most":{most},"default":{default},"about":"{about}"}}"#
        )
    };
    let parameters: Vec<String> = scene.parameters.iter().map(parameter).collect();
    let Scene { name, about, duration, .. } = scene;
    format!(
        "{{\"scene\":\"{name}\",\"about\":\"{about}\",\"duration\":{duration},\"parameters\":[{}]}}\n",
        parameters.join(",")
    )
}
