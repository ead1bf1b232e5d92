//! The parameters of all scenes: tables that make sense, defaults that change nothing, others that do, and ends of
//! ranges that still give a picture.

use paprsek::frame::knobs::KNOBS;
use paprsek::frame::{Frame, Options, Parameter, Renderer, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::collections::BTreeSet;

/// Small, but with room for what a parameter changes.
const SIZE: (usize, usize) = (48, 27);
/// Shares of a scene's length at which a change may show. A scene in shots shows some bodies in few of them.
const INSTANTS: [f64; 5] = [0.3, 0.55, 0.8, 0.05, 0.93];

fn render(renderer: &mut Renderer, scene: &Scene, share: f64, values: &[(&'static str, f64)]) -> Frame {
    let mut frame = Frame::new(SIZE.0, SIZE.1);
    let options = Options { quality: &Quality::FAST, values, ..Options::default() };
    renderer.render_with(scene, share * scene.duration, &options, &mut frame);
    frame
}

fn every() -> impl Iterator<Item = (&'static Scene, &'static Parameter)> {
    scenes::all().iter().flat_map(|scene| scene.parameters.iter().map(move |parameter| (scene, parameter)))
}

#[test]
fn tables_can_be_read() {
    assert!(scenes::INTRO.parameters.is_empty());
    for scene in scenes::all() {
        let names: BTreeSet<_> = scene.parameters.iter().map(|parameter| parameter.name).collect();
        assert_eq!(names.len(), scene.parameters.len(), "{}: a name twice", scene.name);
        assert!(scene.name == scenes::INTRO.name || !names.is_empty(), "{} has none", scene.name);
    }
    for (scene, &Parameter { name, unit, range: (least, most), default, about }) in every() {
        let place = format!("{} {name}", scene.name);
        assert!(least.is_finite() && most.is_finite() && least < most, "{place}");
        assert!((least..=most).contains(&default), "{place}");
        assert!(!name.is_empty() && name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{place}");
        assert!(!unit.is_empty() && !about.is_empty() && !about.contains(['"', '\\', '\n']), "{place}");
        let whole = [least, most, default].iter().all(|number| number.fract() == 0.0);
        assert!(unit != "count" || whole, "{place}: a count that is not whole");
        assert_eq!(scene.parameter(name).map(|parameter| parameter.name), Some(name));
    }
}

#[test]
fn defaults_change_nothing() {
    let mut renderer = Renderer::new(0).unwrap();
    for scene in scenes::all() {
        let defaults: Vec<_> = scene.parameters.iter().map(|parameter| (parameter.name, parameter.default)).collect();
        for share in INSTANTS {
            let plain = render(&mut renderer, scene, share, &[]);
            assert!(render(&mut renderer, scene, share, &defaults) == plain, "{} at {share}", scene.name);
        }
    }
}

/// Values that are not of the scene, such as another scene's, are passed over.
#[test]
fn the_show_has_its_parts_as_they_are() {
    let mut renderer = Renderer::new(0).unwrap();
    let plain = render(&mut renderer, &scenes::INTRO, 0.3, &[]);
    assert!(render(&mut renderer, &scenes::INTRO, 0.3, &[("no-parameter", 1.0)]) == plain);
}

#[test]
fn each_parameter_changes_the_picture() {
    let mut renderer = Renderer::new(0).unwrap();
    for (scene, parameter) in every() {
        let (least, most) = parameter.range;
        // A step towards the farther end, at least one where it counts.
        let end = if most - parameter.default > parameter.default - least { most } else { least };
        let step = 0.25 * (end - parameter.default);
        let step = if parameter.unit == "count" { step.abs().max(1.0).round() * step.signum() } else { step };
        let values = [parameter.default + step, end];
        let changes = INSTANTS.iter().any(|&share| {
            let plain = render(&mut renderer, scene, share, &[]);
            values.iter().any(|&value| render(&mut renderer, scene, share, &[(parameter.name, value)]) != plain)
        });
        assert!(changes, "{} {}: {values:?} change nothing", scene.name, parameter.name);
    }
}

/// What is not a number becomes black. None of the scenes is all black by default, and at the end of a range no more
/// pixels may be than the parameter explains: bodies, particles or light that are gone leave a sky.
#[test]
fn ends_of_ranges_give_a_picture() {
    /// Without its lights and in the dark a scene may be black, but not all of it.
    const MOST_BLACK: f64 = 0.9;
    let mut renderer = Renderer::new(0).unwrap();
    let mut dark = Vec::new();
    for (scene, parameter) in every() {
        for value in [parameter.range.0, parameter.range.1] {
            for share in INSTANTS {
                let frame = render(&mut renderer, scene, share, &[(parameter.name, value)]);
                let black = frame.pixels.iter().filter(|pixel| **pixel == 0).count() as f64 / frame.pixels.len() as f64;
                if black > MOST_BLACK {
                    dark.push(format!("{} {} = {value} at {share}: {black}", scene.name, parameter.name));
                }
            }
        }
    }
    assert!(dark.is_empty(), "{dark:#?}");
}

/// A frame does not depend on what parameters were before.
#[test]
fn what_was_set_before_leaves_no_trace() {
    let mut renderer = Renderer::new(0).unwrap();
    for scene in scenes::all() {
        let plain = render(&mut renderer, scene, INSTANTS[0], &[]);
        for parameter in scene.parameters {
            render(&mut renderer, scene, INSTANTS[0], &[(parameter.name, parameter.range.1)]);
        }
        assert!(render(&mut renderer, scene, INSTANTS[0], &[]) == plain, "{}", scene.name);
    }
}

/// Each field of the settings renders at both ends of its range, whatever the others are.
#[test]
fn every_setting_renders_at_its_ends() {
    let mut renderer = Renderer::new(2).unwrap();
    let mut frame = Frame::new(40, 24);
    for name in ["spheres-glass", "shadow", "shadow-cube", "sky-of-clouds", "fire", "torches", "clouds"] {
        let scene = scenes::named(name).unwrap();
        for knob in KNOBS {
            for (base, value) in [(Quality::DEFAULT, knob.parameter.range.0), (Quality::FAST, knob.parameter.range.1)] {
                let mut quality = base;
                (knob.set)(&mut quality, value);
                frame.pixels.fill(0);
                renderer.render(&scene, 1.5, &quality, &mut frame);
                let lit = frame.pixels.iter().filter(|pixel| **pixel != 0).count();
                assert!(lit > 40, "{name} with {} = {value}", knob.parameter.name);
            }
        }
    }
}
