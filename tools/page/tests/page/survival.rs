//! What the page survives.

use crate::chrome::Chrome;
use crate::site::open;
use serde_json::json;
use std::thread;
use std::time::Duration;

/// Waits for a frame later than the present one.
fn goes_on(chrome: &mut Chrome) {
    chrome.evaluate("globalThis.before = paprsek.player.shownTime");
    chrome.until("paprsek.player.shownTime > before + 0.2");
}

/// One worker dies with an error, then each ends without a word: all are replaced, and it plays on.
#[test]
fn workers_that_die_are_replaced() {
    let Some((mut chrome, _turn)) = open(480, 300) else { return };
    chrome.evaluate("paprsek.player.setQuality('fast')");
    goes_on(&mut chrome);
    // A frame for which there is no memory ends the module.
    let huge = "{ scene: 0, time: 0, width: 1e5, height: 1e5, quality: 0, values: [], first: 0, last: 1e5 }";
    chrome.evaluate(&format!("paprsek.player.pool.raw[0].postMessage({huge})"));
    chrome.until("paprsek.player.pool.replaced === 1");
    goes_on(&mut chrome);
    chrome.evaluate("paprsek.player.pool.raw.forEach(worker => worker.terminate())");
    chrome.until("paprsek.player.pool.replaced > paprsek.player.pool.workers");
    goes_on(&mut chrome);
    assert_eq!(chrome.evaluate("document.getElementById('trouble').hidden"), true);
    // The console has the end that was an error, and that of whatever its worker still had to do.
    let others: Vec<_> = chrome.errors.iter().filter(|error| !error.contains("RuntimeError: unreachable")).collect();
    assert!(!chrome.errors.is_empty() && others.is_empty(), "{others:?}");
}

#[test]
fn a_hidden_page_rests_and_plays_on() {
    let Some((mut chrome, _turn)) = open(480, 300) else { return };
    goes_on(&mut chrome);
    let other = chrome.browser("Target.createTarget", json!({ "url": "about:blank" }));
    chrome.browser("Target.activateTarget", json!({ "targetId": other["targetId"] }));
    chrome.until("document.hidden");
    let time = |chrome: &mut Chrome| chrome.evaluate("paprsek.player.time").as_f64().unwrap();
    let hidden = time(&mut chrome);
    thread::sleep(Duration::from_secs(1));
    assert_eq!(time(&mut chrome), hidden);
    let page = chrome.target.clone();
    chrome.browser("Target.activateTarget", json!({ "targetId": page }));
    chrome.until("!document.hidden");
    goes_on(&mut chrome);
    let seen = time(&mut chrome);
    assert!(seen > hidden && seen < hidden + 60.0, "{hidden}, {seen}");
    assert_eq!(chrome.errors, [""; 0]);
}

/// Nothing overlaps or sticks out of a window of 200 pixels.
#[test]
fn a_window_of_200_pixels_has_room_for_all_controls() {
    let Some((mut chrome, _turn)) = open(200, 400) else { return };
    goes_on(&mut chrome);
    for (width, height) in [(200, 400), (200, 300), (320, 200)] {
        chrome.size(width, height);
        chrome.until(&format!("innerWidth === {width} && innerHeight === {height}"));
        goes_on(&mut chrome);
        let outside = "[...document.querySelectorAll('#controls button, #controls select, #controls input, #picture')]
            .filter(e => e.checkVisibility()).map(e => [e.id, e.getBoundingClientRect()])
            .filter(([, { left, right, top, bottom }]) => left < -0.5 || right > innerWidth + 0.5 || top < -0.5 || bottom > innerHeight + 0.5)
            .map(([id]) => id).join(' ')";
        assert_eq!(chrome.evaluate(outside), "", "at {width}x{height}");
        assert_eq!(chrome.evaluate("document.documentElement.scrollWidth"), width);
    }
    // What is seen of a frame is what there is room for.
    let (whole, width) =
        ("paprsek.player.wholeSize[0]", chrome.evaluate("document.getElementById('picture').clientWidth"));
    assert!(chrome.evaluate(whole).as_f64().unwrap() < width.as_f64().unwrap() + 160.0);
    assert_eq!(chrome.errors, [""; 0]);
}
