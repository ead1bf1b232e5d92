//! A hard case: inputs at which renderers go wrong, the truth about them, and the error that is allowed.

use std::time::{Duration, Instant};
use testkit::Found;

/// A hard case, as a row of the page.
#[derive(Clone, Copy)]
pub struct Case {
    /// What is tried, in a few words; unique.
    pub name: &'static str,
    /// Where the case is from: a key of `docs/references.md`, another publication, or what makes it hard.
    pub source: &'static str,
    /// What it is held against.
    pub oracle: &'static str,
    /// What runs: the scalar reference, the kernels at each SIMD level of the machine, or both.
    pub runs: Runs,
    /// The unit of the error.
    pub unit: &'static str,
    /// The largest error that is allowed, in that unit.
    pub target: f64,
    /// Tries the inputs.
    pub run: fn(&Effort) -> Found,
}

/// Which implementations a case asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Runs {
    /// Scalar code, which no level changes.
    Scalar,
    /// The scalar reference and the kernels at every level of the machine.
    All,
    /// Kernels at every level of the machine.
    Levels,
    /// Kernels at the best level of the machine.
    Best,
}

/// How many inputs are tried.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Share of the inputs.
    share: f64,
}

impl Effort {
    /// All inputs, for the page.
    pub const FULL: Effort = Effort { share: 1.0 };
    /// A twentieth of them, for a test: seconds.
    pub const QUICK: Effort = Effort { share: 0.05 };

    /// So many inputs of `all`, at least 1.
    pub fn of(&self, all: u32) -> u32 {
        ((all as f64 * self.share) as u32).max(1)
    }

    /// All of a list, or its first `few` in a quick run.
    pub fn some<'a, T>(&self, list: &'a [T], few: usize) -> &'a [T] {
        if self.share < 1.0 { &list[..few.min(list.len())] } else { list }
    }
}

/// What a case found.
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// Inputs and worst error.
    pub found: Found,
    /// How long it took.
    pub took: Duration,
}

impl Case {
    /// A case whose error has no unit.
    pub const fn new(
        runs: Runs,
        name: &'static str,
        source: &'static str,
        oracle: &'static str,
        target: f64,
        run: fn(&Effort) -> Found,
    ) -> Case {
        Case { name, source, oracle, runs, unit: "", target, run }
    }

    /// The same with a unit of the error.
    pub const fn unit(self, unit: &'static str) -> Case {
        Case { unit, ..self }
    }

    /// Tries the inputs.
    pub fn run(&self, effort: &Effort) -> Outcome {
        let start = Instant::now();
        let found = (self.run)(effort);
        Outcome { case: *self, found, took: start.elapsed() }
    }
}

impl Outcome {
    /// Whether something was tried and no error is beyond the target.
    pub fn holds(&self) -> bool {
        self.found.inputs > 0 && self.found.worst <= self.case.target
    }

    /// One line: the figures, and the input with the worst error where it is beyond the target.
    pub fn line(&self) -> String {
        let Outcome { case, found, took } = self;
        let verdict = if self.holds() { "holds" } else { "FAILS" };
        let mut line = format!(
            "{verdict}  {}: {:.3e} {} of {:.3e} allowed, {} inputs, {:.1} s",
            case.name,
            found.worst,
            case.unit,
            case.target,
            found.inputs,
            took.as_secs_f64()
        );
        if !self.holds() {
            line += &format!("\n       {}", found.at);
        }
        line
    }
}
