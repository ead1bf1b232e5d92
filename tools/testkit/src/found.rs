//! What a hard case found: how many inputs it tried, how large the worst error was, and where.

/// The worst of many errors.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Inputs tried.
    pub inputs: u64,
    /// The largest error, in the unit of the case; infinite where an answer was no number or of the wrong kind.
    pub worst: f64,
    /// The input with that error.
    pub at: String,
}

impl Found {
    /// Counts an input and its error. NaN counts as infinite.
    pub fn see(&mut self, error: f64, at: impl FnOnce() -> String) {
        self.inputs += 1;
        self.more(error, at);
    }

    /// The error of another answer to an input that has been counted.
    pub fn more(&mut self, error: f64, at: impl FnOnce() -> String) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.worst {
            (self.worst, self.at) = (error, at());
        }
    }

    /// Counts an input, and a failure if the answer is wrong: then the worst error is the number of failures.
    pub fn judge(&mut self, right: bool, at: impl FnOnce() -> String) {
        self.inputs += 1;
        self.fail(!right, at);
    }

    /// Counts a failure, without an input.
    pub fn fail(&mut self, wrong: bool, at: impl FnOnce() -> String) {
        if wrong {
            self.worst += 1.0;
            if self.at.is_empty() {
                self.at = at();
            }
        }
    }

    /// Both together: all inputs, and the larger of the errors.
    pub fn and(self, other: Found) -> Found {
        let inputs = self.inputs + other.inputs;
        if other.worst > self.worst { Found { inputs, ..other } } else { Found { inputs, ..self } }
    }

    /// Panics with the input if an error is beyond `target`, or if nothing was tried.
    pub fn within(&self, target: f64) {
        println!("{} inputs, worst {:.3e}: {}", self.inputs, self.worst, self.at);
        assert!(self.inputs > 0, "nothing was tried");
        assert!(self.worst <= target, "{:e} is more than {target:e}: {}", self.worst, self.at);
    }
}
