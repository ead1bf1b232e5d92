//! The show's score.

use crate::sound::Score;

/// The score.
pub fn score() -> Score {
    Score { length: 154 * 44_100 }
}
