//! `--set` and `--parameters`: what is refused, that a value is used, and what is printed.

use super::paprsek;
use paprsek::frame::Parameter;
use paprsek::scenes;
use serde_json::Value;
use std::process::Output;
use testkit::run::{fails, succeeds};

fn run(words: &str) -> Output {
    paprsek().args(words.split(' ')).output().unwrap()
}

const STILL: &str = "--at 2 --size 32x18 --capture -";

#[test]
fn bad_values_are_one_line_and_exit_2() {
    for words in [
        "snow --set",
        "snow --set height",
        "snow --set =",
        "snow --set =3",
        "snow --set height=",
        "snow --set height=tall",
        "snow --set height=NaN",
        "snow --set height=nan",
        "snow --set height=inf",
        "snow --set height=-inf",
        "snow --set height=1e1",
        "snow --set height=0",
        "snow --set height=-16",
        "snow --set height=101",
        "snow --set height=16=16",
        "snow --set height=--16",
        "snow --set height=+16",
        "snow --set Height=16",
        "snow --set nosuch=1",
        "snow --set height=16 --set nosuch=1",
        "snow --set --at",
        "--set height=16",
        "intro --set height=16",
        "--bench --set height=16",
        "snow --parameters --set height=16",
        "nosuchscene --parameters",
        "--parameters=1",
        "snow --json --set height=16",
    ] {
        let said = fails(&run(&format!("{words} --at 1 --capture - --size 8x8")), 2);
        let said_too = fails(&run(words), 2);
        assert!(said.len() > 20 && said_too.len() > 20, "{words}: {said} {said_too}");
    }
}

#[test]
fn a_wrong_value_is_answered_with_the_right_ones() {
    let said = fails(&run("snow --set nosuch=1"), 2);
    let snow = scenes::named("snow").unwrap();
    assert!(snow.parameters.iter().all(|parameter| said.contains(parameter.name)), "{said}");
    let said = fails(&run("snow --set height=1000"), 2);
    assert!(said.contains("from 2 to 100") && said.contains("height") && said.contains("1000"), "{said}");
}

#[test]
fn a_value_that_is_set_is_used() {
    let picture = |words: &str| succeeds(run(&format!("snow {STILL} {words}").trim().replace("  ", " ")));
    let plain = picture("");
    assert!(picture("--set count=254648") == plain);
    let few = picture("--set count=10000");
    assert!(few != plain);
    assert!(picture("--set=count=10000") == few);
    assert!(picture("--set count=254648 --set count=10000") == few, "the last one counts");
    assert!(picture("--set wind-east=-3.5 --set count=10000") != few);
    let bench = succeeds(run("snow --bench --json --at 1 --size 32x18 --set count=100"));
    assert!(serde_json::from_slice::<Value>(&bench).is_ok());
}

#[test]
fn the_camera_and_settings_are_set_too() {
    let picture = |words: &str| succeeds(run(&format!("spheres {STILL} {words}").trim().replace("  ", " ")));
    let plain = picture("");
    assert!(picture("--set trace.antialias=0") != plain);
    // All that `fast` and `default` differ by in the tracer.
    assert!(
        picture("--set trace.antialias=0 --set trace.min_detail=0.2 --set trace.min_weight=0.015625")
            == picture("--quality fast")
    );
    assert!(picture("--set camera.fov=70") != plain);
    // From straight above the floor nothing is sky.
    let above = "--set camera.x=0 --set camera.y=30 --set camera.z=0 --set camera.heading=0 --set camera.pitch=-90";
    assert!(picture(above) != plain && picture(&format!("{above} --set camera.heading=90")) != picture(above));
    for words in ["--set trace.cell=0", "--set camera.pitch=91", "--set trace.nothing=1", "--pixel 32,0", "--pixel 3"] {
        fails(&run(&format!("spheres {STILL} {words}")), 2);
    }
}

#[test]
fn a_pixel_is_told_of() {
    let told = String::from_utf8(succeeds(run("spheres --at 2 --size 32x18 --pixel 16,9"))).unwrap();
    let frame = succeeds(run(&format!("spheres {STILL}")));
    let pixel = &frame[frame.len() - 3 * 32 * 18 + 3 * (9 * 32 + 16)..][..3];
    let code = format!("code {} {} {}, Gamma22", pixel[0], pixel[1], pixel[2]);
    assert!(told.starts_with("spheres at 2 s, 32x18, pixel 16,9\n") && told.trim_end().ends_with(&code), "{told}");
    assert!(told.contains("TraceLayer: light") && told.contains("ray 1, from the eye: body "), "{told}");
}

#[test]
fn parameters_are_listed() {
    let all = String::from_utf8(succeeds(run("--parameters"))).unwrap();
    let head: Vec<_> = all.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(head, ["name", "default", "range", "unit", "meaning"]);
    for scene in scenes::all() {
        let own = String::from_utf8(succeeds(run(&format!("{} --parameters", scene.name)))).unwrap();
        assert_eq!(own.lines().count(), 2 + scene.parameters.len(), "{own}");
        assert!(all.lines().any(|line| line.starts_with(&format!("{} ", scene.name))), "{all}");
        for (line, parameter) in own.lines().skip(2).zip(scene.parameters) {
            let words: Vec<_> = line.split_whitespace().collect();
            let (least, most) = parameter.range;
            assert_eq!(words[0], parameter.name);
            assert_eq!(words[1].parse(), Ok(parameter.default));
            assert_eq!((words[2].parse(), words[3], words[4].parse()), (Ok(least), "to", Ok(most)), "{line}");
            assert!(words[5] == parameter.unit && line.ends_with(parameter.about), "{line}");
        }
    }
}

#[test]
fn parameters_are_printed_for_programs() {
    let lines = String::from_utf8(succeeds(run("--parameters --json"))).unwrap();
    assert_eq!(lines.lines().count(), scenes::all().len());
    for (line, scene) in lines.lines().zip(scenes::all()) {
        let object: Value = serde_json::from_str(line).unwrap();
        assert_eq!((&object["scene"], &object["about"]), (&scene.name.into(), &scene.about.into()));
        assert_eq!(object["duration"], scene.duration);
        let parameters = object["parameters"].as_array().unwrap();
        assert_eq!(parameters.len(), scene.parameters.len());
        for (object, &Parameter { name, unit, range, default, about }) in parameters.iter().zip(scene.parameters) {
            assert_eq!(
                (&object["name"], &object["unit"], &object["about"]),
                (&name.into(), &unit.into(), &about.into())
            );
            let number = |key: &str| object[key].as_f64().unwrap();
            assert_eq!([number("least"), number("most"), number("default")], [range.0, range.1, default], "{line}");
        }
    }
    let one = succeeds(run("snow --parameters --json"));
    assert_eq!(serde_json::from_slice::<Value>(&one).unwrap()["scene"], "snow");
}
