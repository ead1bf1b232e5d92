//! The report's text.

use crate::measure::{Effort, Row, Table};
use crate::sweep::Sweep;
use paprsek::scenes::Scene;
use std::fmt::Write;

/// What the theses got: eye rays cut 7 times; Akimoto and others 2.6 to 8.2 times.
const OTHERS: &str = "the thesis drew with up to 7 times fewer, Akimoto et al. with 2.6 to 8.2 times fewer";

/// What every figure depends on.
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
pub fn report(setting: &Setting, results: &[(Sweep, Vec<(Scene, Table)>)]) -> String {
    let Setting { machine, simd, command, effort } = setting;
    let (width, height) = effort.size;
    let shares: Vec<_> = effort.instants.iter().map(|share| format!("{share}")).collect();
    let mut text = format!(
        "# Speed against error\n\n\
         Written by `{command}`; not edited by hand.\n\n\
         {machine}; {width}x{height}, {threads} threads, SIMD level {simd} unless said otherwise. \
         Instants of each scene, as shares of its length: {}. One knob moves at a time, from the quality named. \
         The default is **bold** here and ringed in the curves.\n\n\
         * **ms**: median frame of {rounds}. Every point of a sweep is drawn once a round, so that whatever else the \
         machine does hits all alike. **x exact**: how many times as fast as `exact` on {threads} threads, median over \
         the rounds: trust this before the milliseconds.\n\
         * **samples**: eye rays a pixel. **fewer**: how many times fewer than one a pixel; {OTHERS}.\n\
         * **RMSE** of 255, **PSNR** in dB: over all channels. **SSIM**: blocks of 8x8, worst channel. **FLIP**: mean \
         and 99th percentile, 67 pixels a degree. **bad**: pixels off by more than 8 of 255 in a channel.\n\
         * Targets against `exact`: PSNR 40, SSIM 0.98, FLIP 0.02 and 0.2, bad 0.5 %.\n",
        shares.join(", "),
        threads = effort.threads,
        rounds = effort.rounds,
    );
    text += "\n## Where the defaults stand\n\n";
    text += &head("quality");
    for base in ["fast", "default"] {
        for (sweep, tables) in results.iter().filter(|(sweep, _)| sweep.base == base).take(1) {
            for (scene, table) in tables {
                for found in table.rows.iter().filter(|row| row.point.default) {
                    let name = format!("{base}, {}, against {}", scene.name, sweep.truth.name());
                    text += &row(&name, found);
                }
            }
        }
    }
    for (sweep, tables) in results {
        let Sweep { file, knob, base, truth, .. } = sweep;
        let truth = truth.name();
        write!(text, "\n## `{knob}` from `{base}`, against `{truth}`\n\n![{knob}]({file}.svg)\n").expect("memory");
        for (scene, table) in tables {
            write!(text, "\n{}, `exact` {:.1} ms:", scene.name, table.exact_ms).expect("memory");
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

fn row(label: &str, Row { ms, ratio, samples, error, .. }: &Row) -> String {
    let psnr = if error.square > 0.0 { format!("{:.1}", error.psnr()) } else { "equal".into() };
    format!(
        "| {label} | {ms:.1} | {ratio:.2} | {samples:.3} | {:.1} | {:.2} | {psnr} | {:.4} | {:.4} | {:.3} | {:.2} % |\n",
        1.0 / samples,
        error.rmse(),
        error.ssim,
        error.flip,
        error.flip99,
        100.0 * error.bad,
    )
}
