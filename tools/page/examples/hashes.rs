//! All of the kept frames with one eye, by the page's module in node: `cargo run -p page --example hashes`. The tests take
//! every third.

#[path = "../tests/page/chrome.rs"]
mod chrome;
#[path = "../tests/page/hashes.rs"]
mod hashes;
#[path = "../tests/page/site.rs"]
mod site;

fn main() {
    let Some(site) = site::site() else { return };
    let kept = hashes::kept(1);
    let differ = hashes::differing(site, &kept);
    assert!(differ.is_empty(), "{differ:#?}");
    println!("{} frames in node have the hashes of the native ones", kept.len());
}
