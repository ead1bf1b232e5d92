//! The module in node, without a page.

use crate::hashes::{STEP, differing, kept, large};
use crate::site::site;
use testkit::{Tool, needs};

#[test]
fn the_module_s_frames_are_the_native_ones() {
    if !needs(&[Tool::Node]) {
        return;
    }
    let Some(site) = site() else { return };
    for frames in [kept(STEP), large()] {
        let differ = differing(site, &frames);
        assert!(differ.is_empty(), "{differ:#?}");
    }
}
