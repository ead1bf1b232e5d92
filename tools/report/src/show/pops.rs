//! Whether anything pops: the differences between frames and those before them.

use super::parts::{Part, is_lit};
use super::{Effort, render};
use paprsek::frame::{Frame, Renderer};
use paprsek::settings::Quality;
use testkit::metrics::Difference;

/// Frames per second.
const FPS: f64 = 60.0;

/// The change from one frame to the next.
#[derive(Clone, Copy)]
struct Change {
    /// The number of the first frame, and of the shot that both frames are in.
    frame: usize,
    shot: Option<usize>,
    /// Root mean square of the difference, codes of 255.
    rms: f64,
}

/// The table of all parts, as Markdown.
pub fn report(renderer: &mut Renderer, parts: &[Part], effort: &Effort) -> String {
    let (width, height) = effort.changing;
    let mut text = format!(
        "## Popping\n\n\
         The difference between a frame at `default` and {width}x{height} and the frame before it, at {FPS} frames per \
         second: root mean square over 8-bit RGB, in codes of 255. Frames on two sides of a cut are not compared, nor any \
         while the show fades. The **largest** change of each part comes first. A pan makes all changes of a shot large, so \
         pops are sought where a change exceeds the mean of those before and after it, which stands beside it; the {} that \
         exceed it most follow. What the reference does too is not the fault of a shortcut, but may still pop.\n\n\
         | part | pairs | at, s | change | beside it | reference | ours - reference |\n|---|{}\n",
        effort.candidates,
        "--:|".repeat(6),
    );
    for part in parts {
        let changes = changes(renderer, part, effort);
        let judged = judged(&changes, effort.candidates);
        for (number, (change, beside)) in judged.into_iter().enumerate() {
            let [before, after] = [change.frame, change.frame + 1]
                .map(|frame| render(renderer, effort.changing, frame as f64 / FPS, &Quality::REFERENCE));
            let truth = Difference::between(&before, &after).rmse();
            let (rms, bold) = (change.rms, if number == 0 { "**" } else { "" });
            text += &format!(
                "| {} | {} | {:.2} | {bold}{rms:.2}{bold} | {beside:.2} | {truth:.2} | {:+.2} |\n",
                part.name(),
                changes.len(),
                change.frame as f64 / FPS,
                rms - truth
            );
        }
        eprintln!("{}: changes measured", part.name());
    }
    text
}

/// The changes within a part's shots, in order of time.
fn changes(renderer: &mut Renderer, part: &Part, effort: &Effort) -> Vec<Change> {
    let mut changes = Vec::new();
    let mut last: Option<(Option<usize>, Frame)> = None;
    let mut pairs = 0;
    for frame in part.frames(FPS) {
        let time = frame as f64 / FPS;
        let shot = part.shot(time);
        let same = last.as_ref().is_some_and(|last| last.0 == shot);
        pairs = if same { pairs + 1 } else { 0 };
        if !is_lit(time) || pairs > effort.pairs {
            continue;
        }
        let picture = render(renderer, effort.changing, time, &Quality::DEFAULT);
        if let Some((_, before)) = last.filter(|_| same) {
            changes.push(Change { frame: frame - 1, shot, rms: Difference::between(&before, &picture).rmse() });
        }
        last = Some((shot, picture));
    }
    changes
}

/// The largest change, then those that exceed the mean of their neighbours in the shot by the most; each with that mean.
fn judged(changes: &[Change], candidates: usize) -> Vec<(Change, f64)> {
    let inside = changes.windows(3).filter(|three| three[0].shot == three[2].shot);
    let mut peaks: Vec<_> = inside.map(|three| (three[1], 0.5 * (three[0].rms + three[2].rms))).collect();
    peaks.sort_by(|a, b| (b.0.rms - b.1).total_cmp(&(a.0.rms - a.1)));
    let largest = (0..peaks.len()).max_by(|a, b| peaks[*a].0.rms.total_cmp(&peaks[*b].0.rms));
    let largest: Vec<_> = largest.map(|index| peaks.remove(index)).into_iter().collect();
    largest.into_iter().chain(peaks).take(1 + candidates).collect()
}
