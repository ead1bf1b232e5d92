//! The explorer, driven by a script of keys, drags and the wheel, whose effects are read from its lines of state.

mod display;
mod robust;

use display::{Explorer, number, numbers, paprsek};
use std::fs;
use std::process::Command;
use testkit::run::ending;

const SMALL: [&str; 5] = ["shadow", "--size", "640x360", "--at", "3"];

#[test]
fn one_walks_looks_and_comes_home() {
    let Some(explorer) = Explorer::start(&SMALL) else { return };
    let own = numbers(&explorer.state(), "camera");
    assert_eq!(explorer.state()["own"], "1");
    // Ahead, along the heading.
    explorer.xdotool("keydown w sleep 0.5 keyup w");
    let walked = explorer.expect("step", |state| state["own"] == "0" && numbers(state, "camera")[0] != own[0]);
    explorer.xdotool("sleep 0.2");
    let there = numbers(&explorer.state(), "camera");
    let heading = own[3].to_radians();
    let ahead = (there[0] - own[0]) * heading.sin() - (there[2] - own[2]) * heading.cos();
    assert!(ahead > 0.05 && walked["scene"] == "shadow", "{own:?} {there:?}");
    // The scene follows the mouse: the eye turns left as it is dragged to the right.
    explorer.xdotool("mousemove 400 180 mousedown 3 sleep 0.2 mousemove 500 180 sleep 0.2 mouseup 3");
    explorer.expect("turn", |state| {
        let turned = (numbers(state, "camera")[3] - there[3] + 540.0).rem_euclid(360.0) - 180.0;
        // 100 pixels of 360 rows are 50 degrees x 100 / 360.
        (turned + 50.0 * 100.0 / 360.0).abs() < 0.1
    });
    // The wheel: faster, and with Ctrl a narrower view.
    let speed = number(&explorer.state(), "speed");
    explorer.xdotool("click 4 sleep 0.2 click 4");
    explorer.expect("faster walk", |state| number(state, "speed") > 1.2 * speed);
    explorer.xdotool("keydown Control_L sleep 0.2 click 4 sleep 0.3 keyup Control_L");
    explorer.expect("narrower view", |state| numbers(state, "camera")[6] < own[6] - 1.0);
    explorer.xdotool("key semicolon");
    explorer.expect("key of the camera", |state| state["keys"] == "1");
    explorer.xdotool("key Home");
    explorer.expect("way home", |state| state["own"] == "1" && numbers(state, "camera") == own);
}

#[test]
fn keys_and_sliders_turn_parameters_and_time() {
    let Some(explorer) = Explorer::start(&SMALL) else { return };
    explorer.xdotool("key t");
    explorer.expect("steeper sun", |state| state["words"].contains("--set slope="));
    explorer.xdotool("key Delete");
    explorer.expect("reset", |state| !state["words"].contains("--set"));
    // The first slider of the panel, which is the sun's speed.
    let place = numbers(&explorer.expect("slider", |state| !state["slider"].is_empty()), "slider");
    let (left, y, right) = (place[0] + 0.55 * place[2], place[1], place[0] + 0.8 * place[2]);
    explorer.xdotool(&format!(
        "mousemove {left:.0} {y:.0} sleep 0.2 mousedown 1 sleep 0.2 mousemove {right:.0} {y:.0} sleep 0.3 mouseup 1"
    ));
    explorer.expect("another speed", |state| {
        let value = state["words"].split("--set speed=").nth(1).and_then(|rest| rest.split(' ').next());
        value.is_some_and(|value| value.parse::<f64>().unwrap() > 4.0)
    });
    // What is typed into the search does not walk, and finds.
    explorer.xdotool("mousemove 150 20 sleep 0.3 mousedown 1 sleep 0.5 mouseup 1 sleep 0.5 type --delay 60 texels");
    explorer.expect("search", |state| !state["slider"].is_empty() && numbers(state, "slider")[1] != place[1]);
    explorer.xdotool("sleep 0.5 mousemove 500 200 mousedown 1 sleep 0.5 mouseup 1 sleep 0.3");
    assert_eq!(explorer.state()["own"], "1");
    explorer.xdotool("key space");
    explorer.expect("playing", |state| state["playing"] == "1" && number(state, "time") > 3.05);
    explorer.xdotool("key space sleep 0.2 key bracketright key bracketright");
    explorer.expect("pause", |state| state["playing"] == "0" && state["rate"] == "4");
    let time = number(&explorer.expect("rest", |state| state["playing"] == "0"), "time");
    explorer.xdotool("key Right");
    explorer.expect("seek", |state| number(state, "time") >= time + 4.9);
    explorer.xdotool("key F1 sleep 0.2 key Tab sleep 0.2 key F2");
    explorer.expect("help", |state| state["help"] == "1" && state["panel"] == "0" && state["times"] == "1");
    explorer.xdotool("key Escape");
    explorer.expect("picture alone", |state| state["help"] == "0");
    explorer.xdotool("key x");
    explorer.expect("next scene", |state| state["scene"] == "shadow-cube" && state["words"].starts_with("shadow-cube"));
}

#[test]
fn a_frame_that_is_copied_has_the_same_bytes() {
    let Some(mut explorer) = Explorer::start(&["clouds", "--size", "480x270", "--at", "7.25"]) else { return };
    // Flown by hand, from the pilot's eyes, with a parameter and a setting changed.
    explorer.xdotool("key b sleep 0.3 keydown Right sleep 0.4 keyup Right sleep 0.2 key v");
    explorer.expect("flight", |state| state["flight"] == "1" && state["words"].contains("--set plane.roll="));
    explorer.xdotool("key b");
    explorer.expect("landing", |state| state["flight"] == "0" && state["words"].contains("--set camera.roll="));
    explorer.xdotool("key g key shift+r key w");
    explorer.expect("parameters", |state| {
        state["words"].contains("--set share=") && state["words"].contains("--set wind-east=")
    });
    explorer.xdotool("sleep 1 key c sleep 0.3 key F12");
    let png = explorer.file(".png");
    explorer.xdotool("sleep 0.5 key Escape");
    let child = std::mem::replace(&mut explorer.child, Command::new("true").spawn().unwrap());
    let output = ending(child, display::PATIENCE);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8(output.stdout).unwrap();
    let words = said.lines().next().unwrap().strip_prefix("paprsek ").expect("a command line");
    assert!(words.contains("--set camera.x="), "{words}");
    let mut program = paprsek();
    program.args(words.split(' ')).current_dir(explorer.out.path()).env_remove("DISPLAY");
    assert!(program.status().unwrap().success(), "{words}");
    let ppm = fs::read(explorer.out.path().join("still/frame-000000.ppm")).unwrap();
    let shown = image::open(png).unwrap().into_rgb8();
    assert_eq!((shown.width(), shown.height()), (480, 270));
    assert!(ppm.ends_with(shown.as_raw()) && ppm.len() < shown.as_raw().len() + 20, "other bytes: {words}");
    // And not because every frame has these bytes.
    let other = words.replace("--set share=", "--set wind-south=0 --set share=");
    let mut program = paprsek();
    program.args(other.split(' ')).current_dir(explorer.out.path()).env_remove("DISPLAY");
    assert!(program.status().unwrap().success());
    assert!(fs::read(explorer.out.path().join("still/frame-000000.ppm")).unwrap() != ppm);
}

#[test]
fn overlays_comparison_and_probe_look_at_the_frame() {
    let Some(explorer) = Explorer::start(&["spheres", "--size", "640x360", "--at", "2"]) else { return };
    let plain = explorer.state()["words"].clone();
    for overlay in [
        "tile-times",
        "depth",
        "coverage",
        "samples",
        "squares",
        "ray-depth",
        "candidates",
        "overdraw",
        "triangles",
        "octaves",
    ] {
        explorer.xdotool("key F3");
        explorer.expect(overlay, |state| state["overlay"] == overlay && state["words"] == plain);
    }
    explorer.xdotool("key Escape");
    explorer.expect("picture", |state| state["overlay"] == "none");
    explorer.xdotool("key F5 sleep 0.2 mousemove 500 250");
    explorer.expect("probe", |state| state["probe"].starts_with("500,250,"));
    let mut program = paprsek();
    program.args(plain.split(' ')).args(["--pixel", "500,250"]).env_remove("DISPLAY");
    let told = String::from_utf8(program.output().unwrap().stdout).unwrap();
    assert_eq!(explorer.state()["probe"], format!("500,250,{}", told.lines().count()), "{told}");
    explorer.xdotool("key F5 sleep 0.2 key F4");
    let state = explorer.expect("PSNR", |state| state["compare"].parse::<f64>().is_ok());
    // Between what the default quality is worth and equality.
    assert!((30.0..60.0).contains(&number(&state, "compare")), "{state:?}");
    // Another frame, another comparison.
    explorer.xdotool("key period");
    explorer.expect("another PSNR", |now| {
        now["time"] != state["time"] && now["compare"].parse::<f64>().is_ok() && now["compare"] != state["compare"]
    });
}

#[test]
fn a_recording_has_every_thirtieth_of_a_second() {
    let Some(explorer) = Explorer::start(&["shadow", "--size", "320x180", "--at", "3"]) else { return };
    explorer.xdotool("key F9 sleep 0.3 key space");
    explorer.expect("frames", |state| state["recorded"].parse().is_ok_and(|count: u32| count >= 6));
    explorer.xdotool("key space sleep 0.3 key F9");
    explorer.expect("end", |state| state["recorded"] == "off");
    let directory = explorer.file("recording-1");
    // The frame that stood still, and after it one for each step.
    let mut program = paprsek();
    program.args(["shadow", "--size", "320x180", "--from", "3", "--to", "3.2", "--fps", "30"]).env_remove("DISPLAY");
    assert!(program.args(["--capture", "film"]).current_dir(explorer.out.path()).status().unwrap().success());
    for number in 1..4 {
        let png = image::open(directory.join(format!("frame-{number:06}.png"))).unwrap().into_rgb8();
        let ppm = fs::read(explorer.out.path().join(format!("film/frame-{:06}.ppm", 90 + number))).unwrap();
        let own = &ppm[ppm.len() - png.as_raw().len()..];
        // Times of the explorer are in whole milliseconds: half of one at most.
        let off = own.iter().zip(png.as_raw()).filter(|(a, b)| a.abs_diff(**b) > 8).count();
        assert!(off * 200 < own.len(), "frame {number}: {off} of {} codes", own.len());
    }
}

#[test]
fn a_window_has_any_size() {
    let Some(explorer) = Explorer::start(&["shadow", "--size", "320x180", "--at", "3"]) else { return };
    for (width, height) in [(1100, 620), (333, 201), (320, 180)] {
        explorer.xdotool(&format!("search --name explorer windowsize {width} {height}"));
        let size = format!("{width}x{height}");
        explorer.expect("size", |state| state["size"] == size && state["words"].contains(&size));
    }
}

#[test]
fn a_display_that_goes_or_falls_silent_ends_it() {
    let Some(mut explorer) = Explorer::start(&SMALL) else { return };
    explorer.xvfb.kill().unwrap();
    let child = std::mem::replace(&mut explorer.child, Command::new("true").spawn().unwrap());
    let output = ending(child, display::PATIENCE);
    // Mostly the explorer's own line; Xlib's, of two, where it hears of it first.
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && (1..=2).contains(&said.lines().count()), "{said}");
    drop(explorer);
    let Some(mut explorer) = Explorer::start(&SMALL) else { return };
    let stopped = Command::new("kill").args(["-STOP", &explorer.xvfb.id().to_string()]).status().unwrap();
    assert!(stopped.success());
    let child = std::mem::replace(&mut explorer.child, Command::new("true").spawn().unwrap());
    let output = ending(child, display::PATIENCE);
    assert!(String::from_utf8_lossy(&output.stderr).contains("does not answer"));
}
