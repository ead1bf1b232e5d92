//! Whether anything pops: how much frames differ from the ones before them.

use crate::difference::Difference;
use crate::parts::{Part, is_lit};
use crate::{Effort, render};
use paprsek::quality::Quality;
use paprsek::tile::{Frame, Renderer};

/// Frames a second.
const FPS: f64 = 60.0;

/// The change from one frame to the next.
#[derive(Clone, Copy)]
struct Change {
    /// Number of the first of the two, and of the shot that both are in.
    frame: usize,
    shot: Option<usize>,
    /// Root of the mean square of the difference, codes of 255.
    rms: f64,
}

/// The table of all parts, Markdown.
pub fn report(renderer: &mut Renderer, parts: &[Part], effort: &Effort) -> String {
    let (width, height) = effort.half;
    let mut text = format!(
        "## Popping\n\n\
         How much a frame at `default` and {width}x{height} differs from the one before it at {FPS} frames a second: the \
         root of the mean square over 8-bit RGB, codes of 255. Frames on two sides of a cut are not compared, nor any \
         while the show fades. A pan makes all of a shot's differences large, so what pops is looked for where one \
         exceeds the mean of those before and after it: of the {} that do most in each part, and the largest one, the \
         one that exceeds the reference's difference by most.\n\n\
         | part | pairs | largest | at, s | reference | exceeds most | at, s | beside it | reference | ours - reference |\n\
         |---|{}\n",
        effort.candidates,
        "--:|".repeat(9),
    );
    for part in parts {
        let changes = changes(renderer, part, effort);
        if let Some(largest) = changes.iter().max_by(|a, b| a.rms.total_cmp(&b.rms)) {
            let row = row(renderer, &changes, largest, effort);
            text += &format!("| {} | {} | {row} |\n", part.name(), changes.len());
        }
        eprintln!("{}: changes measured", part.name());
    }
    text
}

/// The changes within a part's shots, in the order of time.
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
        let picture = render(renderer, effort.half, time, &Quality::DEFAULT);
        if let Some((_, before)) = last.filter(|_| same) {
            changes.push(Change { frame: frame - 1, shot, rms: Difference::between(&before, &picture).square.sqrt() });
        }
        last = Some((shot, picture));
    }
    changes
}

/// The mean of the changes before and after each that has both in its shot.
fn peaks(changes: &[Change]) -> impl Iterator<Item = (Change, f64)> {
    let inside = changes.windows(3).filter(|three| three[0].shot == three[2].shot);
    inside.map(|three| (three[1], 0.5 * (three[0].rms + three[2].rms)))
}

/// The columns from the largest change on.
fn row(renderer: &mut Renderer, changes: &[Change], largest: &Change, effort: &Effort) -> String {
    let mut reference = |change: &Change| {
        let [before, after] = [change.frame, change.frame + 1]
            .map(|frame| render(renderer, effort.half, frame as f64 / FPS, &Quality::REFERENCE));
        Difference::between(&before, &after).square.sqrt()
    };
    let seconds = |change: &Change| change.frame as f64 / FPS;
    let largest_truth = reference(largest);
    let mut peaks: Vec<_> = peaks(changes).collect();
    peaks.sort_by(|a, b| (b.0.rms - b.1).total_cmp(&(a.0.rms - a.1)));
    let place = peaks.iter().position(|peak| peak.0.frame == largest.frame);
    let mut judged = Vec::new();
    for (number, (change, beside)) in peaks.into_iter().enumerate() {
        if place == Some(number) {
            judged.push((change, beside, largest_truth));
        } else if number < effort.candidates {
            judged.push((change, beside, reference(&change)));
        }
    }
    let worst = judged.iter().max_by(|a, b| (a.0.rms - a.2).total_cmp(&(b.0.rms - b.2)));
    let worst = worst.map_or(" | | | | ".into(), |(change, beside, truth)| {
        let ours = change.rms;
        format!("{ours:.2} | {:.2} | {beside:.2} | {truth:.2} | {:+.2}", seconds(change), ours - truth)
    });
    format!("{:.2} | {:.2} | {largest_truth:.2} | {worst}", largest.rms, seconds(largest))
}
