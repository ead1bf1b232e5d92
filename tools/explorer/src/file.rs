//! What the panel saves and loads: a text file with a name and a value per line.

use crate::model::Model;
use crate::request::rounded;
use paprsek::frame::knobs::{KNOBS, Knob};
use paprsek::frame::placement::{self, CAMERA};
use paprsek::{Quality, scenes};
use std::fmt::Write;

/// The model as text.
pub fn write(model: &Model) -> String {
    let Model { scene, time, base, .. } = model;
    let mut text = format!("scene {}\ntime {time:.3}\nquality {base}\n", scene.name);
    let start = Quality::named(base).unwrap_or_default();
    for knob in KNOBS {
        let value = (knob.get)(&model.quality);
        if value != (knob.get)(&start) {
            let _ = writeln!(text, "{} {}", knob.parameter.name, value as f32);
        }
    }
    for (name, value) in &model.values {
        let _ = writeln!(text, "{name} {value}");
    }
    if let Some(pose) = &model.pose {
        for (parameter, number) in CAMERA.iter().zip(placement::numbers(pose)) {
            let _ = writeln!(text, "{} {}", parameter.name, rounded(number));
        }
    }
    text
}

/// Sets the model to what such a text says; the error names the line that says nothing. The model is left as it was
/// then.
pub fn read(model: &mut Model, text: &str) -> Result<(), String> {
    let mut new = Model::new(model.scene, model.threads, model.simd);
    (new.playing, new.rate, new.speed, new.cap) = (false, model.rate, model.speed, model.cap);
    let mut camera = [None; 7];
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = || format!("line {}: {line}", number + 1);
        let (name, word) = line.trim().split_once(' ').ok_or_else(wrong)?;
        match name {
            "scene" => new.scene = scenes::named(word).ok_or_else(wrong)?,
            "quality" => {
                new.base = Quality::NAMES.into_iter().find(|name| *name == word).ok_or_else(wrong)?;
                new.start_from(new.base);
            }
            _ => {
                let value = word.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(wrong)?;
                let place = CAMERA.iter().position(|parameter| parameter.name == name);
                if name == "time" {
                    new.time = value;
                } else if let Some(place) = place.filter(|place| CAMERA[*place].takes(value)) {
                    camera[place] = Some(value);
                } else if let Some(knob) = Knob::named(name).filter(|knob| knob.parameter.takes(value)) {
                    (knob.set)(&mut new.quality, value);
                } else {
                    let parameter = new.scene.parameter(name).filter(|parameter| parameter.takes(value));
                    new.set(parameter.ok_or_else(wrong)?, value);
                }
            }
        }
    }
    if let [Some(x), Some(y), Some(z), Some(heading), Some(pitch), Some(roll), Some(fov)] = camera {
        new.pose = Some(placement::pose([x, y, z, heading, pitch, roll, fov]));
    }
    new.seek(0.0);
    *model = new;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use paprsek::view::Pose;

    #[test]
    fn what_is_saved_is_loaded() {
        let mut model = Model::new(scenes::named("clouds").unwrap(), 2, "sse2");
        model.time = 12.345;
        model.start_from("fast");
        model.turn(Knob::named("cloud.threshold").unwrap(), 0.07);
        model.set(model.scene.parameter("wind-east").unwrap(), -3.5);
        let eye = glam::dvec3(1.5, 800.25, -3.0);
        model.pose = Some(Pose { eye, heading: 12.0, pitch: -3.0, roll: 1.0, fov: 44.0 });
        let text = write(&model);
        let mut other = Model::new(scenes::named("lumen").unwrap(), 2, "sse2");
        read(&mut other, &text).unwrap();
        assert_eq!(other.request((64, 36)), model.request((64, 36)));
        assert_eq!(write(&other), text);
        // What says nothing is refused, and changes nothing.
        for bad in ["scene nowhere", "wind-east 1e9", "time soon", "cloud.steps", "nosuch 1"] {
            assert!(read(&mut other, bad).unwrap_err().contains(bad), "{bad}");
            assert_eq!(write(&other), text);
        }
    }
}
