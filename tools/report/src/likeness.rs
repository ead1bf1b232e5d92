//! Columns of a table: how like the truth several pictures are.

use super::difference::{Difference, OFF, psnr};

/// The head of [`columns`].
pub fn head() -> String {
    format!("PSNR, dB (worst) | pixels off by more than {OFF}")
}

/// PSNR of all pixels of all pictures and of the worst picture; share of pixels that are off.
pub fn columns(differences: &[Difference]) -> String {
    let mean = |of: fn(&Difference) -> f64| differences.iter().map(of).sum::<f64>() / differences.len() as f64;
    let worst = differences.iter().map(|difference| difference.square).fold(0.0, f64::max);
    let likeness = if worst > 0.0 {
        format!("{:.1} ({:.1})", psnr(mean(|difference| difference.square)), psnr(worst))
    } else {
        "equal".to_string()
    };
    format!("{likeness} | {:.2} %", 100.0 * mean(|difference| difference.off))
}
