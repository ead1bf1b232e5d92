//! The size of frames while a slow machine plays, by the program's rule.

use crate::chrome::Chrome;
use crate::site::{show, start};
use governor::{EIGHTHS, Governor};

/// The program's own file, compiled natively: what the page does is compared with it.
#[path = "../../../../src/bin/paprsek/governor.rs"]
mod governor;

/// Workers of a slower machine: each answer comes later, and says that it has taken longer, by `load` milliseconds for the
/// whole size, and less for fewer pixels. What the page asks of the rule, and is told, is kept in `asked`.
const SLOWER: &str = "
    globalThis.load = 0;
    globalThis.Worker = class extends Worker {
        set onmessage(hear) {
            super.onmessage = event => {
                if (event.data.took === undefined) return hear(event);
                const more = load * event.data.pixels.byteLength / (4 * 320 * 180);
                event.data.took += more;
                setTimeout(() => hear(event), more);
            };
        }
    };
    globalThis.asked = [];
    globalThis.listen = () => {
        const { instance } = paprsek, { govern, forget } = instance;
        instance.govern = share => {
            const eighths = govern.call(instance, share);
            asked.push([share, eighths]);
            return eighths;
        };
        instance.forget = () => { asked = []; forget.call(instance); };
        paprsek.player.setQuality('fast');
    };";

/// The page with slower workers, in a window for frames of 320x180.
fn slower(chrome: &mut Chrome) {
    chrome.before(SLOWER);
    show(chrome);
    chrome.evaluate("paprsek.player.choose('shadow'); listen()");
}

/// Late frames take the size down as far as it takes, and light ones up again, each after the very frame that the native
/// rule says.
#[test]
fn late_frames_get_smaller_and_grow_again() {
    let Some((mut chrome, _turn)) = start(320, 200) else { return };
    slower(&mut chrome);
    let width = "paprsek.player.shownSize[0]";
    chrome.until(&format!("{width} === 320 && asked.length > 3"));
    // Frames that take three times as long as they may; at half the size they fit on an idle machine.
    chrome.evaluate("globalThis.load = 3 * 1000 / 30 * paprsek.player.pool.workers; 0");
    chrome.until(&format!("{width} <= 160"));
    // The ones at the lesser sizes have come that late, and the machine is fast from now on.
    chrome.evaluate("globalThis.load = 0");
    let least = chrome.evaluate("Math.min(...asked.map(([, eighths]) => eighths))").as_u64().unwrap();
    chrome.until(&format!("asked.at(-1)[1] > {least}"));
    chrome.until(&format!("{width} > 40 * {least}"));
    let asked = chrome.evaluate("asked");
    let mut native = Governor::new();
    for (frame, row) in asked.as_array().unwrap().iter().enumerate() {
        native.record(row[0].as_f64().unwrap());
        assert_eq!(row[1], EIGHTHS[native.step], "frame {frame} of {asked}");
    }
    // A frame at rest is whole however slow the machine is.
    chrome.evaluate("globalThis.load = 300; paprsek.player.pause()");
    chrome.until(&format!("paprsek.player.atRest && {width} === 320"));
    assert_eq!(chrome.errors, [""; 0]);
}

/// Whoever asks for a size gets it, however late it comes.
#[test]
fn a_size_that_is_asked_for_stays() {
    let Some((mut chrome, _turn)) = start(320, 200) else { return };
    slower(&mut chrome);
    chrome.evaluate(
        "paprsek.player.setSize([320, 180]); globalThis.load = 400; globalThis.seen = new Set(); globalThis.frames = 0",
    );
    chrome.evaluate(
        "paprsek.player.addEventListener('frame', () => { seen.add(paprsek.player.shownSize[0]); frames += 1 })",
    );
    chrome.until("frames > 12");
    assert_eq!(chrome.evaluate("[...seen].join()"), "320");
}
