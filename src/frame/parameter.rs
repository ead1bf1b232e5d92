//! What scenes can be changed by: named numbers.

/// A number that a scene can be changed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name on the command line.
    pub name: &'static str,
    /// Unit of its values: `m`, `m/s`, `s`, `degrees`, `1` for a plain number, `count` for a whole one: others are
    /// rounded.
    pub unit: &'static str,
    /// The least and the largest value.
    pub range: (f64, f64),
    /// The value that makes the scene as it is shown.
    pub default: f64,
    /// What it does, in one line.
    pub about: &'static str,
}

impl Parameter {
    /// A parameter as a row of a table: name, unit, range, default, and what it does.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        range: (f64, f64),
        default: f64,
        about: &'static str,
    ) -> Parameter {
        Parameter { name, unit, range, default, about }
    }

    /// Whether it takes that value: a number within its range.
    pub fn takes(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }
}

/// Values of parameters by name; those that are not among them have their defaults.
pub type Values<'a> = &'a [(&'static str, f64)];
