//! The error of frames against the reference.

use super::parts::Part;
use super::{Effort, render};
use crate::likeness;
use paprsek::frame::Renderer;
use paprsek::settings::Quality;
use testkit::metrics::Difference;

/// The table of all parts, as Markdown.
pub fn report(renderer: &mut Renderer, parts: &[Part], effort: &Effort) -> String {
    let (width, height) = effort.compared;
    let mut text = format!(
        "## Error\n\n\
         `default` against `reference`, 64 traced samples per pixel, at {width}x{height}. Pictures are taken in the middle of \
         each shot; shots longer than {} s are cut into equal pieces. PSNR over 8-bit RGB is that of all these pictures \
         together, and in brackets that of the worst.\n\n\
         | part | instants | {} | worst at, s |\n|---|--:|--:|--:|--:|\n",
        effort.piece,
        likeness::head(),
    );
    for part in parts {
        let instants: Vec<_> = part.instants(effort.piece).collect();
        let mut compare = |at: &f64| {
            let [ours, truth] =
                [Quality::DEFAULT, Quality::REFERENCE].map(|quality| render(renderer, effort.compared, *at, &quality));
            Difference::between(&ours, &truth)
        };
        let differences: Vec<_> = instants.iter().map(&mut compare).collect();
        let pairs = differences.iter().zip(&instants);
        let worst = pairs.max_by(|a, b| a.0.mean_square.total_cmp(&b.0.mean_square)).map_or(0.0, |(_, at)| *at);
        let columns = likeness::columns(&differences);
        text += &format!("| {} | {} | {columns} | {worst:.2} |\n", part.name(), instants.len());
        eprintln!("{}: compared", part.name());
    }
    text
}
