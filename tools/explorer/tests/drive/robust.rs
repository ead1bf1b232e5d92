//! What goes wrong around an explorer, and what it may cost while nobody touches it.

use crate::display::{self, Explorer, number, numbers};
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;
use testkit::run::ending;

const SMALL: [&str; 5] = ["shadow", "--size", "640x360", "--at", "3"];

#[test]
fn a_click_without_length_is_heard() {
    let Some(explorer) = Explorer::start(&SMALL) else { return };
    let place = numbers(&explorer.expect("slider", |state| !state["slider"].is_empty()), "slider");
    // Down and up in one go, on places of a slider from left to right: none is lost and none counts twice.
    let mut last = f64::NEG_INFINITY;
    for share in [0.3, 0.5, 0.6, 0.8, 0.95] {
        let (x, y) = (place[0] + share * place[2], place[1]);
        explorer.xdotool(&format!("mousemove {x:.0} {y:.0} sleep 0.2 mousedown 1 mouseup 1"));
        let value = |state: &display::State| {
            let word = state["words"].split("--set speed=").nth(1).and_then(|rest| rest.split(' ').next());
            word.map_or(f64::NEG_INFINITY, |word| word.parse().unwrap())
        };
        last = value(&explorer.expect("click on the slider", |state| value(state) > last));
    }
    // A click over the picture does not look around, and one over another window is another's.
    let camera = explorer.state()["camera"].clone();
    explorer.xdotool(
        "mousemove 500 200 sleep 0.2 mousedown 1 mouseup 1 sleep 0.2 mousemove 1000 600 mousedown 1 mouseup 1",
    );
    sleep(Duration::from_millis(300));
    assert_eq!(explorer.state()["camera"], camera);
}

#[test]
fn frames_keep_to_the_cap_and_nothing_is_rendered_at_rest() {
    let Some(explorer) = Explorer::start(&["shadow", "--size", "320x180", "--at", "3", "--threads", "1"]) else {
        return;
    };
    assert_eq!(explorer.state()["cap"], "60");
    explorer.xdotool("key shift+F6 key shift+F6 key shift+F6 key space");
    explorer.expect("cap", |state| state["cap"] == "15" && state["playing"] == "1");
    let frames = || number(&explorer.state(), "frames");
    let (before, time) = (frames(), number(&explorer.state(), "time"));
    sleep(Duration::from_secs(2));
    let (drawn, seconds) = (frames() - before, number(&explorer.state(), "time") - time);
    // Time goes on as ever.
    assert!(drawn <= 15.0 * seconds + 2.0 && drawn >= 3.0, "{drawn} frames in {seconds} s");
    explorer.xdotool("key F6 key F6 key F6 key F6 key F6 key F6 key F6");
    explorer.expect("around", |state| state["cap"] == "15");
    explorer.xdotool("key space");
    explorer.expect("rest", |state| state["playing"] == "0");
    sleep(Duration::from_millis(700));
    let rests = explorer.state();
    sleep(Duration::from_secs(2));
    let state = explorer.state();
    assert_eq!((&state["picture"], &state["frames"]), (&rests["picture"], &rests["frames"]), "{rests:?} {state:?}");
}

#[test]
fn keys_go_up_when_the_window_loses_them() {
    let Some(explorer) = Explorer::start(&SMALL) else { return };
    let camera = explorer.state()["camera"].clone();
    explorer.xdotool("search --name explorer windowfocus sleep 0.3 keydown w sleep 0.3");
    explorer.expect("step", |state| state["camera"] != camera);
    // Keys go to where the mouse is, which is beside the window: nobody tells the explorer that the key goes up.
    explorer.xdotool("mousemove 1000 600 windowfocus 1 sleep 0.3");
    sleep(Duration::from_millis(500));
    let stands = explorer.state()["camera"].clone();
    sleep(Duration::from_millis(500));
    assert_eq!(explorer.state()["camera"], stands);
    explorer.xdotool("keyup w");
}

#[test]
fn a_window_smaller_than_the_smallest_picture_still_works() {
    let Some(explorer) = Explorer::start(&["shadow", "--size", "400x300", "--at", "3"]) else { return };
    for (width, height) in [(200, 100), (320, 90), (40, 400), (1, 1)] {
        explorer.xdotool(&format!("search --name explorer windowsize {width} {height} sleep 0.2"));
        let size = format!("{}x{}", width.max(320), height.max(180));
        explorer.expect("size", |state| state["size"] == size && state["words"].contains(&size));
    }
    explorer.xdotool("search --name explorer windowsize 500 280 sleep 0.3 mousemove 300 20 sleep 0.2 key space");
    explorer.expect("life", |state| state["size"] == "500x280" && state["playing"] == "1");
}

/// Records until the recording ends by itself, and gives what is told then.
fn fails(explorer: &Explorer) -> String {
    explorer.xdotool("key F9 sleep 0.3 key space");
    let state = explorer.expect("end", |state| state["recorded"] == "off" && state["told"].contains("recording:"));
    state["told"].clone()
}

#[test]
fn a_program_that_stops_reading_ends_the_recording() {
    let words = [&SMALL[..], &["--pipe", "head -c 2000000 > /dev/null"]].concat();
    let Some(mut explorer) = Explorer::start(&words) else { return };
    let told = fails(&explorer);
    assert!(told.contains("Broken_pipe"), "{told}");
    // And the explorer lives.
    explorer.xdotool("key period");
    explorer.expect("step", |state| state["playing"] == "0");
    explorer.xdotool("key Escape");
    let child = std::mem::replace(&mut explorer.child, Command::new("true").spawn().unwrap());
    let output = ending(child, display::PATIENCE);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.lines().count() == 1 && said.contains("Broken pipe"), "{said}");
}

#[test]
fn a_program_that_reads_nothing_hangs_nothing() {
    let words = [&SMALL[..], &["--pipe", "exec sleep 20"]].concat();
    let Some(mut explorer) = Explorer::start(&words) else { return };
    explorer.xdotool("key F9 sleep 0.3 key space");
    // Time waits with it, but keys are heard.
    explorer.expect("recording", |state| state["recorded"].parse().is_ok_and(|count: u32| count >= 4));
    explorer.xdotool("key F1");
    explorer.expect("help", |state| state["help"] == "1");
    explorer.xdotool("key F1 sleep 0.2 key F9");
    explorer.expect("end", |state| state["recorded"] == "off");
    explorer.xdotool("key Escape");
    let child = std::mem::replace(&mut explorer.child, Command::new("true").spawn().unwrap());
    let output = ending(child, display::PATIENCE);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.lines().count() == 1 && said.contains("does not read"), "{said}");
}

#[test]
fn a_full_disk_ends_the_recording() {
    // Files may grow to 200 blocks of 512 bytes, as on a disk that is nearly full; frames are larger.
    let shell = ["sh", "-c", "trap '' XFSZ; ulimit -f 200; exec \"$0\" \"$@\""];
    let words = ["snowfall", "--size", "640x360", "--at", "9"];
    let Some(explorer) = Explorer::start_by(&shell, &words) else { return };
    let told = fails(&explorer);
    assert!(told.contains("frame-000000.png") && told.contains("File_too_large"), "{told}");
    // Half a picture is none.
    assert_eq!(std::fs::read_dir(explorer.file("recording-1")).unwrap().count(), 0);
    explorer.xdotool("key F12");
    explorer.expect("why", |state| state["told"].contains("File_too_large"));
}
