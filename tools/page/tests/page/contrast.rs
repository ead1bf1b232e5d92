//! Contrast of text and controls over the brightest and the darkest frame that there can be.

use crate::chrome::Chrome;
use crate::site::open;
use image::RgbImage;

/// The least ratios of WCAG 2: text (1.4.3), and what a control is known by (1.4.11).
const TEXT: f64 = 4.5;
const CONTROL: f64 = 3.0;

/// What is seen of text and of controls, but for what an open panel covers: a name, whether it is text, its colour, and left, top, right, bottom in CSS pixels.
const SEEN: &str = "(() => {
    const panel = document.querySelector('dialog[open], .panel:not([hidden], dialog)'), over = panel?.getBoundingClientRect();
    const found = [], rows = (element, name, text, color, rects) => {
        for (const { left, top, right, bottom } of rects) {
            const covers = over && left < over.right && right > over.left && top < over.bottom && bottom > over.top;
            if (covers && !panel.contains(element)) continue;
            const row = [Math.max(left, 0), Math.max(top, 0), Math.min(right, innerWidth), Math.min(bottom, innerHeight)];
            if (row[2] - row[0] >= 1 && row[3] - row[1] >= 1) found.push([name, text, color.match(/[\\d.]+/g).map(Number), ...row]);
        }
    };
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const element = node.parentElement;
        if (!node.data.trim() || !element.checkVisibility() || element.closest('label > span, option, script')) continue;
        const range = document.createRange();
        range.selectNodeContents(node);
        rows(element, `${element.closest('[id]')?.id ?? element.tagName}: ${node.data.trim()}`, true, getComputedStyle(element).color, range.getClientRects());
    }
    for (const element of document.querySelectorAll('svg, input, select')) {
        if (!element.checkVisibility()) continue;
        const style = getComputedStyle(element);
        const color = element.matches('input') ? style.accentColor : style.color;
        rows(element, element.closest('[id]').id, element.matches('select'), color, [element.getBoundingClientRect()]);
    }
    return found;
})()";

/// Takes away what is to be seen, and leaves what it lies on.
const HIDE: &str = "
    globalThis.hiding = Object.assign(document.createElement('style'), { textContent: `
        * { color: transparent !important; transition: none !important; }
        svg, input { opacity: 0 !important; }` });
    document.head.append(hiding);
    0";

/// Relative luminance of a colour of sRGB, by WCAG 2.
fn luminance(color: [f64; 3]) -> f64 {
    let linear = |channel: f64| {
        let share = channel / 255.0;
        if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2])
}

fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// The least contrast of a colour with what lies behind it, in the pixels that are all within.
fn least(behind: &RgbImage, color: [f64; 3], [left, top, right, bottom]: [f64; 4]) -> f64 {
    let (columns, rows) = (left.ceil() as u32..right as u32, top.ceil() as u32..bottom as u32);
    let places = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
    let ratios = places.map(|(x, y)| contrast(color, behind.get_pixel(x, y).0.map(f64::from)));
    ratios.fold(f64::INFINITY, f64::min)
}

/// What has too little contrast with the page as it is, with the picture of one colour.
fn faint(chrome: &mut Chrome, picture: &str) -> Vec<String> {
    chrome.evaluate(&format!(
        "(context => {{ context.fillStyle = '{picture}'; context.fillRect(0, 0, 9999, 9999); }})(document.getElementById('picture').getContext('2d'))"
    ));
    let seen = chrome.evaluate(SEEN);
    chrome.evaluate(HIDE);
    let behind = image::load_from_memory(&chrome.screenshot()).unwrap().into_rgb8();
    chrome.evaluate("hiding.remove()");
    let seen = seen.as_array().unwrap();
    assert!(seen.len() > 12, "{seen:?}");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let rows = seen.iter().map(|row| {
        let color = [0, 1, 2].map(|channel| number(&row[2][channel]));
        let wanted = if row[1] == true { TEXT } else { CONTROL };
        (least(&behind, color, [3, 4, 5, 6].map(|side| number(&row[side]))), wanted, row[0].to_string())
    });
    rows.filter(|(ratio, wanted, _)| ratio < wanted)
        .map(|(ratio, _, name)| format!("{name}: {ratio:.2} over {picture}"))
        .collect()
}

#[test]
fn everything_is_seen_over_white_and_over_black() {
    assert!((contrast([255.0; 3], [0.0; 3]) - 21.0).abs() < 1e-12);
    let Some((mut chrome, _turn)) = open(960, 600) else { return };
    chrome.evaluate("paprsek.player.setQuality('fast'); paprsek.player.pause()");
    chrome.until("paprsek.player.atRest");
    let mut all = Vec::new();
    for (width, height) in [(960, 600), (390, 844), (200, 400), (844, 390)] {
        chrome.size(width, height);
        chrome.until(&format!("innerWidth === {width} && paprsek.player.atRest"));
        for state in [
            "0",
            "paprsek.controls.turn(true)",
            "paprsek.controls.turn(false); paprsek.controls.say('A sentence.')",
            "document.getElementById('help').showModal()",
        ] {
            chrome.evaluate(state);
            for picture in ["#fff", "#000"] {
                all.extend(faint(&mut chrome, picture).into_iter().map(|row| format!("{width}x{height}: {row}")));
            }
        }
        chrome.evaluate("document.getElementById('help').close()");
    }
    assert!(all.is_empty(), "{all:#?}");
    assert_eq!(chrome.errors, [""; 0]);
}
