//! The same bytes as the native build: the table of kept frames, in the browser.

use crate::hashes::{HASH, STEP, kept};
use crate::site::open;
use serde_json::{Value, json};

/// Frames per call of the browser.
const CALL: usize = 24;

/// Bands of frames by all workers, put together as the player does for a frame at rest; two frames at a time, so that a
/// frame of one band does not leave the other workers idle.
#[test]
fn the_page_s_frames_are_the_native_ones() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.evaluate("paprsek.player.pause()");
    chrome.evaluate(&format!(
        "globalThis.frameHashes = async rows => {{
            const {{ scenes, qualities }} = paprsek.player.description, found = [];
            const lane = async () => {{
                for (let place = next++; place < rows.length; place = next++) {{
                    const row = rows[place], scene = scenes.findIndex(({{ scene }}) => scene === row.name);
                    const request = {{ ...row, scene, quality: qualities.indexOf(row.quality) }};
                    found[place] = ({HASH})((await paprsek.player.render(request)).data);
                }}
            }};
            let next = 0;
            await Promise.all([lane(), lane()]);
            return found;
        }}; 0"
    ));
    let mut differ = Vec::new();
    // A call's answer is not waited for without end.
    for rows in kept(STEP).chunks(CALL) {
        let asked: Vec<&Value> = rows.iter().map(|(row, _)| row).collect();
        let found = chrome.evaluate(&format!("frameHashes({})", json!(asked)));
        let pairs = rows.iter().zip(found.as_array().unwrap());
        differ.extend(pairs.filter(|((_, hash), found)| **found != **hash).map(|((row, _), _)| row.to_string()));
    }
    assert!(differ.is_empty(), "{differ:#?}");
    assert_eq!(chrome.errors, [""; 0]);
}
