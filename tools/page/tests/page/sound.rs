//! The show's sound on the page: the native samples, heard with the picture.

use crate::site::open;
use paprsek::scenes::show::score::score;
use std::thread::sleep;
use std::time::Duration;

#[test]
fn samples_are_the_native_ones() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.evaluate("paprsek.player.pause()");
    let mut score = score();
    // At dawn, in the flight, at the fires, and back; pieces that end within blocks.
    for (first, count) in [(44_100, 1000), (2_700_123, 8192), (5_900_000, 777), (44_100, 1000)] {
        let mut samples = vec![[0; 2]; count];
        score.samples(first, &mut samples);
        let found = chrome.evaluate(&format!("Array.from(paprsek.instance.sound({first}, {count}))"));
        let found: Vec<i16> = found.as_array().unwrap().iter().map(|code| code.as_i64().unwrap() as i16).collect();
        assert!(found == samples.as_flattened(), "{count} samples from {first} on");
    }
}

#[test]
fn it_is_heard_with_the_show() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    // Nobody has touched the page yet.
    chrome.until("paprsek.player.runs");
    assert_eq!(chrome.evaluate("paprsek.sound.sounds"), false);
    chrome.press("ArrowRight", "");
    chrome.until("paprsek.sound.sounds");
    let jumps = chrome.evaluate("paprsek.sound.jumps").as_f64().unwrap();
    sleep(Duration::from_secs(4));
    // It has gone on; on a loaded machine the page may have been too busy for it once.
    assert!(chrome.evaluate("paprsek.sound.jumps").as_f64().unwrap() <= jumps + 1.0);
    // Less than two frames.
    chrome.until("Math.abs(paprsek.sound.apart) < 0.03");
    // As long as time rests, while another scene is shown, and where silence is asked for there is none.
    chrome.evaluate("paprsek.player.pause()");
    chrome.until("!paprsek.sound.sounds");
    chrome.evaluate("paprsek.player.go(60)");
    chrome.evaluate("paprsek.player.play()");
    chrome.until("paprsek.sound.sounds");
    chrome.press("m", "m");
    chrome.until("!paprsek.sound.sounds && paprsek.sound.silent");
    assert_eq!(chrome.evaluate("document.getElementById('sound').title"), "Sound (M)");
    chrome.press("m", "m");
    chrome.until("paprsek.sound.sounds");
    chrome.evaluate("paprsek.player.choose('lumen')");
    chrome.until("!paprsek.sound.sounds");
    assert_eq!(chrome.errors, [""; 0]);
}
