//! The page of hard cases.

use crate::case::{Outcome, Runs};
use crate::tally::WALKS;
use std::fmt::Write;

const HEAD: &str = "\
# Hard cases

Inputs at which renderers go wrong, the truth that each is held against, and the worst error found among all inputs.
Written by `cargo run --release -p hard-cases`, which fails where an error is beyond its target; `-- --quick` tries a
twentieth of the inputs, in `.ci/run` and as a test.

- *Roundings* are of f32, 2^-24 of the lengths that take part: a backward error.
- *Failures* are counted: answers of the wrong kind, such as a miss for a hit. Their target is 0.
- *Of the bound* is the error over what the conditioning of the input allows.
- An error of 0 is one below the last digit of the oracle, or bits that are equal.
- Keys in brackets are those of [references.md](references.md).

";

const WALK: &str = "
## A walk of random frames

`cargo run --release -p hard-cases -- walk --frames 100000 --keep` renders frames of every scene, at any time, size, quality,
parameters, eye and level, on one thread, and fails

- where light is no finite number before it is encoded, or anything panics;
- where a frame takes 2.5 times the samples (eye rays and shaded fragments) of both its neighbours, a sixtieth of a second
  before and behind;
- where it takes 2.5 times their processor time, at the least of seven rounds at its own size, and again of three rounds at
  1280x720. Most of the frames have some hundred pixels, so that what is done once for a frame weighs a thousand times as
  much as it does in the show: a sun that moves has one of the six shapes of clouds lit anew in some frames.

Frames are counted once, and only if they have pixels. The seed and the number of a request decide all of it, so a walk can be
walked in slices: `--first` says where to go on. Each row was one run, with its code as of then.

| seed | requests | frames | pixels | most samples by the neighbours' | suspected by time | spikes at their own size | failures |
|--:|---|--:|--:|--:|--:|--:|--:|
";

/// The page, of chapters with their outcomes.
pub fn page(chapters: &[(&str, Vec<Outcome>)], levels: &[&str]) -> String {
    let mut page = HEAD.to_string();
    let cases: usize = chapters.iter().map(|chapter| chapter.1.len()).sum();
    let inputs: u64 = chapters.iter().flat_map(|chapter| &chapter.1).map(|outcome| outcome.found.inputs).sum();
    let levels = levels.join(", ");
    writeln!(
        page,
        "{cases} cases, {} inputs. *All* levels are the scalar reference and the kernels at {levels}; *each* is",
        grouped(inputs)
    )
    .unwrap();
    writeln!(page, "the kernels at {levels}; *best* is the first of these.").unwrap();
    for (name, outcomes) in chapters {
        write!(page, "\n## {name}\n\n").unwrap();
        page += "| case | source | oracle | inputs | worst error | target | levels |\n|---|---|---|--:|--:|--:|---|\n";
        for Outcome { case, found, .. } in outcomes {
            let levels = match case.runs {
                Runs::Scalar => "scalar",
                Runs::All => "all",
                Runs::Levels => "each",
                Runs::Best => "best",
            };
            writeln!(
                page,
                "| {} | {} | {} | {} | {} | {} | {levels} |",
                case.name,
                case.source,
                case.oracle,
                grouped(found.inputs),
                amount(found.worst, case.unit),
                amount(case.target, case.unit),
            )
            .unwrap();
        }
    }
    page += WALK;
    page += &std::fs::read_to_string(WALKS).unwrap_or_default();
    page
}

/// A number with commas between thousands.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// A number with two or three digits and its unit.
fn amount(number: f64, unit: &str) -> String {
    let number = if number == 0.0 {
        "0".into()
    } else if number.abs() < 1e-3 || number.abs() >= 1e5 {
        format!("{number:.1e}")
    } else if number == number.trunc() {
        format!("{number}")
    } else if number.abs() < 1.0 {
        format!("{number:.3}")
    } else {
        format!("{number:.2}")
    };
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!([0, 999, 1000, 12_345_678].map(grouped), ["0", "999", "1,000", "12,345,678"]);
        assert_eq!(amount(0.0, "failures"), "0 failures");
        assert_eq!(amount(3.456e-7, ""), "3.5e-7");
        assert_eq!(amount(2.5, "roundings"), "2.50 roundings");
    }
}
