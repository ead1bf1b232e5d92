//! What the page shows, and what its keys and lists do.

use crate::chrome::Chrome;
use crate::site::{address, open, show, start};
use paprsek::frame::{Frame, Options, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::fs;
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

/// The picture; only equality counts.
const PICTURE: &str = "document.getElementById('picture').toDataURL()";

/// The frame that is shown is that of the clock's time, and no other is on its way.
const AT_REST: &str = "Math.abs(paprsek.player.shownTime - paprsek.player.time) < 1e-9 && paprsek.player.atRest";

fn number(chrome: &mut Chrome, expression: &str) -> f64 {
    chrome.evaluate(expression).as_f64().unwrap_or_else(|| panic!("{expression} is no number"))
}

/// Stops time, and waits for the frame.
fn pause(chrome: &mut Chrome) {
    chrome.evaluate("paprsek.player.pause()");
    chrome.until(AT_REST);
}

#[test]
fn it_plays_after_loading_without_a_word_in_the_console() {
    let Some((mut chrome, _turn)) = open(960, 600) else { return };
    // The show fades in, so that it is not always the same black.
    chrome.until("paprsek.player.shownTime > 1.5");
    let (picture, time) = (chrome.evaluate(PICTURE), number(&mut chrome, "paprsek.player.shownTime"));
    chrome.until(&format!("paprsek.player.shownTime > {time} + 1"));
    assert_ne!(chrome.evaluate(PICTURE), picture);
    assert!(number(&mut chrome, "paprsek.player.rate") >= 1.0);
    let figures = chrome.evaluate("document.getElementById('figures').textContent");
    assert!(figures.as_str().unwrap().contains("fps") && figures.as_str().unwrap().contains("worker"), "{figures}");
    // Controls go where nobody touches anything, and come back.
    chrome.until("document.body.classList.contains('quiet')");
    chrome.press("c", "c");
    chrome.until("!document.body.classList.contains('quiet')");
    assert_eq!(chrome.errors, [""; 0]);
}

/// From the page's address to its first frame the browser takes at most three quarters of what two cores have in a second.
/// Time on the clock would depend on what else the machine does.
#[test]
fn the_first_frame_takes_two_cores_less_than_a_second() {
    let Some((mut chrome, _turn)) = start(1280, 720) else { return };
    let before = chrome.work();
    show(&mut chrome);
    let work = chrome.work() - before;
    let waited = number(&mut chrome, "paprsek.firstFrame");
    println!("{work:.2} s of work; on the clock, {waited:.0} ms after the module's arrival");
    assert!(work < 1.5, "{work} s");
}

#[test]
fn keys_do_what_the_program_s_do() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.evaluate("paprsek.player.go(100)");
    chrome.press(" ", " ");
    chrome.until("!paprsek.player.playing");
    chrome.until(AT_REST);
    let rests = number(&mut chrome, "paprsek.player.time");
    assert!((100.0..120.0).contains(&rests), "{rests}");
    thread::sleep(Duration::from_millis(300));
    assert_eq!(number(&mut chrome, "paprsek.player.time"), rests);
    let before = chrome.evaluate(PICTURE);
    for (key, moved) in [("ArrowRight", 5.0), ("ArrowRight", 10.0), ("ArrowLeft", 5.0), ("ArrowLeft", 0.0)] {
        chrome.press(key, "");
        assert!((number(&mut chrome, "paprsek.player.time") - rests - moved).abs() < 1e-9, "{key}");
    }
    chrome.until(AT_REST);
    assert_eq!(chrome.evaluate(PICTURE), before, "there and back again");
    for (key, part) in [("2", 21.0), ("6", 113.0), ("1", 0.0), ("9", 0.0)] {
        chrome.press(key, key);
        assert_eq!(number(&mut chrome, "paprsek.player.time"), part, "{key}");
    }
    // Back from the start is the end of the loop.
    chrome.press("ArrowLeft", "");
    assert_eq!(number(&mut chrome, "paprsek.player.time"), 149.0);
    chrome.press("f", "f");
    chrome.until("document.fullscreenElement !== null");
    chrome.press("f", "f");
    chrome.until("document.fullscreenElement === null");
    chrome.press(" ", " ");
    chrome.until("paprsek.player.playing && paprsek.player.shownTime > 149.2");
    assert_eq!(chrome.errors, [""; 0]);
}

/// Everything can be reached by Tab, and lists and sliders keep their own keys.
#[test]
fn the_keyboard_alone_reaches_everything() {
    let Some((mut chrome, _turn)) = open(960, 600) else { return };
    pause(&mut chrome);
    chrome.evaluate("paprsek.player.choose('snowfall'); paprsek.player.pause()");
    chrome.press("p", "p");
    let every = "[...document.querySelectorAll('button, select, input')].filter(e => e.checkVisibility()).length";
    let count = number(&mut chrome, every) as usize;
    assert!(count > 15, "{count}");
    chrome.evaluate(
        "globalThis.reached = new Set(); document.addEventListener('focusin', e => reached.add(e.target)); 0",
    );
    for _ in 0..count + 4 {
        chrome.press("Tab", "");
        let outline =
            "document.activeElement === document.body || getComputedStyle(document.activeElement).outlineStyle";
        let outline = chrome.evaluate(outline);
        assert!(outline == "solid" || outline == true, "{outline}: no ring of the focus");
    }
    assert_eq!(number(&mut chrome, "reached.size") as usize, count);
    let names = "[...reached].every(e => e.ariaLabel || e.labels?.length || e.textContent.trim())";
    assert_eq!(chrome.evaluate(names), true, "something has no name");
    // A slider's arrows turn it, and time stays.
    chrome.evaluate("document.getElementById('parameter-fall').focus()");
    let time = number(&mut chrome, "paprsek.player.time");
    let value = "paprsek.player.values.get('fall') ?? -1";
    chrome.press("ArrowRight", "");
    let turned = number(&mut chrome, value);
    assert!(turned > 0.0, "{turned}");
    assert_eq!(number(&mut chrome, "paprsek.player.time"), time);
    chrome.press("Escape", "");
    assert_eq!(chrome.evaluate("document.getElementById('drawer').hidden"), true);
}

#[test]
fn sizes_follow_what_is_asked_for() {
    let Some((mut chrome, _turn)) = open(1280, 720) else { return };
    let shown = "paprsek.player.shownSize.join('x')";
    pause(&mut chrome);
    assert_eq!(chrome.evaluate(shown), "1280x720", "a frame at rest has the whole size");
    chrome.size(500, 700);
    chrome.until(&format!("{shown} === '640x360'"));
    for size in ["320x180", "640x360", "960x540", "1920x1080"] {
        chrome.evaluate(&format!(
            "document.getElementById('size').value = '{size}'; document.getElementById('size').dispatchEvent(new Event('change'))"
        ));
        chrome.until(&format!("{shown} === '{size}'"));
    }
    assert_eq!(chrome.errors, [""; 0]);
}

/// A file that has been downloaded.
fn download(chrome: &Chrome) -> PathBuf {
    let directory = chrome.directory.path().join("downloads");
    let began = Instant::now();
    loop {
        let files = fs::read_dir(&directory).unwrap().map(|entry| entry.unwrap().path());
        if let Some(file) = files.into_iter().find(|file| file.extension().is_some_and(|kind| kind == "png")) {
            return file;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "no still in {}", directory.display());
        thread::sleep(Duration::from_millis(50));
    }
}

/// The frame that a command line of the program asks for, by the library.
fn native(line: &str) -> Frame {
    let words: Vec<_> = line.split(' ').collect();
    let after = |option: &str| {
        let found = words.iter().zip(&words[1..]).filter(move |(word, _)| **word == option);
        found.map(|(_, value)| *value).collect::<Vec<_>>()
    };
    assert_eq!(words[0], "paprsek");
    let scene = scenes::named(words[1]).unwrap();
    let set = after("--set").into_iter().map(|word| word.split_once('=').unwrap());
    let values: Vec<_> =
        set.map(|(name, value)| (scene.parameter(name).unwrap().name, value.parse().unwrap())).collect();
    let (width, height) = after("--size")[0].split_once('x').unwrap();
    let mut frame = Frame::new(width.parse().unwrap(), height.parse().unwrap());
    let quality = &Quality::named(after("--quality")[0]).unwrap();
    let options = Options { quality, stereo: None, values: &values };
    Renderer::new(0).unwrap().render_with(&scene, after("--at")[0].parse().unwrap(), &options, &mut frame);
    frame
}

/// S while it plays saves what the copied command line renders, pixel by pixel.
#[test]
fn a_still_is_what_its_command_line_renders() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.evaluate(
        "paprsek.player.choose('snowfall'); paprsek.player.setValue('fall', 0.3); paprsek.player.setQuality('fast')",
    );
    chrome.until("paprsek.player.scene.scene === 'snowfall' && paprsek.player.shownTime > 0.4");
    pause(&mut chrome);
    chrome.press("s", "s");
    let file = download(&chrome);
    let line = chrome.evaluate("paprsek.controls.commandLine()").as_str().unwrap().to_owned();
    let time = line.split(' ').nth(3).unwrap();
    let wanted = format!("paprsek-snowfall-{:.3}.png", time.parse::<f64>().unwrap());
    assert_eq!(file.file_name().unwrap().to_str(), Some(&*wanted), "{line}");
    assert!(line.ends_with(" --size 640x360 --quality fast --set fall=0.3"), "{line}");
    let saved = image::open(&file).unwrap().into_rgb8();
    let native = native(&line);
    assert_eq!(saved.dimensions(), (640, 360));
    assert!(saved.as_raw() == &native.to_rgb(), "{line}: the still differs");
    assert_eq!(chrome.errors, [""; 0]);
}

#[test]
fn a_browser_without_simd_is_told_so() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.before("WebAssembly.validate = () => false");
    chrome.open(address().unwrap());
    chrome.until("document.getElementById('trouble')?.hidden === false");
    let said = chrome.evaluate("document.getElementById('trouble').textContent");
    assert!(said.as_str().unwrap().contains("WebAssembly SIMD"), "{said}");
}
