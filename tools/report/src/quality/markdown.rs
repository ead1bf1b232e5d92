//! The text of the report.

use super::measure::{Effort, Row, Table};
use super::subject::SHARES;
use super::sweep::{Sweep, Truth};
use std::fmt::Write;

/// What others saved of eye rays: `[Intro07]`, which the tracer follows, and `[Akimoto91]`.
const OTHERS: &str = "the thesis traced up to 7 times fewer, Akimoto et al. 2.6 to 8.2 times fewer";

/// The circumstances of every figure.
pub struct Setting<'a> {
    /// Name of the processor.
    pub machine: String,
    /// The SIMD level in use.
    pub simd: &'static str,
    /// The command line that writes this again.
    pub command: String,
    /// Size, threads, instants.
    pub effort: &'a Effort,
}

/// The whole report.
pub fn report(setting: &Setting, results: &[(Sweep, Vec<(&'static str, Table)>)]) -> String {
    let Setting { machine, simd, command, effort } = setting;
    let (width, height) = effort.size;
    let shares: Vec<_> = SHARES.iter().take(effort.instants).map(|share| format!("{share}")).collect();
    let mut text = format!(
        "# Speed against error\n\n\
         Written by `{command}`; not edited by hand.\n\n\
         {machine}; {width}x{height}, {threads} threads, SIMD level {simd} unless said otherwise. \
         Each scene is drawn at these shares of its length: {}. One knob moves at a time; the others stay where the named \
         quality has them. The default is **bold** in the tables and ringed in the curves; a triangle marks the \
         curve's knee, the point farthest from the line between its ends (logarithm of the time, error).\n\n\
         * **ms**: median time of {rounds} frames. Each round draws every point of a sweep once, so that other load on the \
         machine affects all points alike. In brackets the interval that holds the median with 95 %, by order statistics of \
         the rounds, each relative to its instant. **x exact**: how many times as fast as `exact` on {threads} threads, median over \
         the rounds. Trust this ratio before the milliseconds.\n\
         * **samples**: eye rays per pixel or, for triangles, shaded fragments per pixel. **fewer**: how many times fewer \
         than one per pixel; {OTHERS}.\n\
         * Every frame draws the first light's shadow map anew, as in a show where sun and torch move. `day` with a low sun \
         is at 4:54, 19:24 and 5:00, with a high sun at 12:00, 10:30 and 13:30. The sky by day has the sun 30, 10 and 60 \
         degrees above the horizon, at sunset 0, 2 and -1, at dusk -6, -4 and -9. The quick report takes the first of \
         each.\n\
         * **RMSE**, in codes of 255, and **PSNR**, in dB, are over all channels. **SSIM**: blocks of 8x8 pixels, the worst \
         channel. **FLIP**: mean and 99th percentile, at 67 pixels per degree. **bad**: share of the pixels that are off by \
         more than 8 codes in a channel.\n\
         * Targets against `exact`: PSNR 40 dB, SSIM 0.98, FLIP 0.02 in the mean and 0.2 at the 99th percentile, bad 0.5 \
         %.\n",
        shares.join(", "),
        threads = effort.threads,
        rounds = effort.rounds,
    );
    text += "\n## Where the defaults stand\n\n";
    text += &head("quality");
    for base in ["fast", "default"] {
        let mut seen = Vec::new();
        for (sweep, tables) in results.iter().filter(|(sweep, _)| sweep.base == base) {
            for (name, table) in tables {
                let whole = matches!(sweep.truth, Truth::Exact | Truth::Reference);
                if !whole || seen.contains(name) {
                    continue;
                }
                seen.push(*name);
                for found in table.rows.iter().filter(|row| row.point.default) {
                    let name = format!("{base}, {name}, against {}", sweep.truth.name());
                    text += &row(&name, found);
                }
            }
        }
    }
    for (sweep, tables) in results {
        let Sweep { file, knob, base, truth, .. } = sweep;
        let truth = truth.name();
        write!(text, "\n## `{knob}` from `{base}`, against `{truth}`\n\n![{knob}]({file}.svg)\n").expect("memory");
        for (name, table) in tables {
            let whole = if sweep.truth == Truth::Dome { "every pixel" } else { "`exact`" };
            write!(text, "\n{name}, {whole} {:.1} ms:", table.exact_ms).expect("memory");
            if !table.matters() {
                text += " nothing changes.\n";
                continue;
            }
            text += "\n\n";
            text += &head(knob);
            for found in &table.rows {
                let label = &found.point.label;
                text += &row(&if found.point.default { format!("**{label}**") } else { label.clone() }, found);
            }
        }
    }
    text
}

fn head(first: &str) -> String {
    let columns = ["ms", "x exact", "samples", "fewer", "RMSE", "PSNR", "SSIM", "FLIP", "FLIP 99 %", "bad"];
    format!("| {first} | {} |\n|---|{}\n", columns.join(" | "), "--:|".repeat(columns.len()))
}

fn row(label: &str, Row { ms, interval: [low, high], ratio, samples, error, .. }: &Row) -> String {
    let psnr = if error.square > 0.0 { format!("{:.1}", error.psnr()) } else { "equal".into() };
    // The sky has no samples to count.
    let samples = if *samples > 0.0 { format!("{samples:.3} | {:.1}", 1.0 / samples) } else { "| ".into() };
    format!(
        "| {label} | {ms:.1} ({low:.1} to {high:.1}) | {ratio:.2} | {samples} | {:.2} | {psnr} | {:.4} | {:.4} | {:.3} | {:.2} % |\n",
        error.rmse(),
        error.ssim,
        error.flip,
        error.flip99,
        100.0 * error.bad,
    )
}
