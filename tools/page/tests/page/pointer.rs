//! Mouse and touch.

use crate::chrome::Chrome;
use crate::site::open;
use serde_json::json;

/// The middle of an element, and a function of a share of its width: places in CSS pixels.
fn place(chrome: &mut Chrome, id: &str, share: f64) -> (f64, f64) {
    let sides = chrome.evaluate(&format!(
        "(({{ left, top, width, height }}) => [left, top, width, height])(document.getElementById('{id}').getBoundingClientRect())"
    ));
    let side = |place: usize| sides[place].as_f64().unwrap();
    (side(0) + share * side(2), side(1) + 0.5 * side(3))
}

fn time(chrome: &mut Chrome) -> f64 {
    chrome.evaluate("paprsek.player.time").as_f64().unwrap()
}

/// The time is that share of the scene, as near as the thumb is placed.
fn at_share(chrome: &mut Chrome, share: f64) {
    let duration = chrome.evaluate("paprsek.player.scene.duration").as_f64().unwrap();
    let time = time(chrome);
    assert!((time / duration - share).abs() < 0.02, "{time} s of {duration}, not {share}");
    assert_eq!(
        chrome.evaluate("Math.abs(document.getElementById('seek').valueAsNumber - paprsek.player.time) < 0.02"),
        true
    );
}

/// Waits until the frame of the clock's time is on the canvas.
fn shown(chrome: &mut Chrome) {
    chrome.until("paprsek.player.atRest && Math.abs(paprsek.player.shownTime - paprsek.player.time) < 1e-9");
}

/// Each place of the drag is a time, the frame of the last one is shown, and it stays paused.
#[test]
fn the_mouse_drags_the_seek_bar() {
    let Some((mut chrome, _turn)) = open(960, 600) else { return };
    chrome.evaluate("paprsek.player.setQuality('fast'); paprsek.player.pause()");
    shown(&mut chrome);
    let start = place(&mut chrome, "seek", 0.2);
    chrome.mouse("mousePressed", start);
    at_share(&mut chrome, 0.2);
    for share in [0.3, 0.5, 0.7, 0.4] {
        let to = place(&mut chrome, "seek", share);
        chrome.mouse("mouseMoved", to);
        at_share(&mut chrome, share);
    }
    let end = place(&mut chrome, "seek", 0.4);
    chrome.mouse("mouseReleased", end);
    // The button is up: what moves now moves nothing.
    let beyond = place(&mut chrome, "seek", 0.9);
    chrome.call(
        "Input.dispatchMouseEvent",
        json!({ "type": "mouseMoved", "x": beyond.0, "y": beyond.1, "button": "none" }),
    );
    at_share(&mut chrome, 0.4);
    shown(&mut chrome);
    assert_eq!(chrome.evaluate("paprsek.player.playing"), false);
    // A click on the picture plays.
    let picture = place(&mut chrome, "picture", 0.5);
    chrome.mouse("mousePressed", picture);
    chrome.mouse("mouseReleased", picture);
    chrome.until("paprsek.player.playing");
    assert_eq!(chrome.errors, [""; 0]);
}

#[test]
fn a_finger_drags_the_seek_bar_and_taps() {
    let Some((mut chrome, _turn)) = open(390, 700) else { return };
    chrome.call("Emulation.setTouchEmulationEnabled", json!({ "enabled": true, "maxTouchPoints": 1 }));
    chrome.evaluate("paprsek.player.setQuality('fast')");
    // While it plays the controls go; the first tap brings them, and it plays on.
    chrome.until("document.body.classList.contains('quiet')");
    let picture = place(&mut chrome, "picture", 0.5);
    let tap = |chrome: &mut Chrome| {
        chrome.touch("touchStart", Some(picture));
        chrome.touch("touchEnd", None);
    };
    tap(&mut chrome);
    chrome.until("!document.body.classList.contains('quiet')");
    assert_eq!(chrome.evaluate("paprsek.player.playing"), true);
    // The second pauses.
    tap(&mut chrome);
    chrome.until("!paprsek.player.playing");
    shown(&mut chrome);
    let start = place(&mut chrome, "seek", 0.25);
    chrome.touch("touchStart", Some(start));
    for share in [0.35, 0.6, 0.8] {
        let to = place(&mut chrome, "seek", share);
        chrome.touch("touchMove", Some(to));
    }
    chrome.touch("touchEnd", None);
    at_share(&mut chrome, 0.8);
    shown(&mut chrome);
    assert_eq!(chrome.evaluate("paprsek.player.playing"), false);
    assert_eq!(chrome.errors, [""; 0]);
}
