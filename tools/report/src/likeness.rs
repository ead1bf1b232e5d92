//! Columns of a table: how far pictures are from the exact ones.

use testkit::metrics::{BAD, Difference, psnr};

/// The head of [`columns`].
pub fn head() -> String {
    format!("PSNR, dB (worst) | pixels off by more than {BAD}")
}

/// PSNR over all pixels of all pictures, that of the worst picture, and the share of bad pixels.
pub fn columns(differences: &[Difference]) -> String {
    let mean = |of: fn(&Difference) -> f64| differences.iter().map(of).sum::<f64>() / differences.len() as f64;
    let worst = differences.iter().map(|difference| difference.mean_square).fold(0.0, f64::max);
    let likeness = if worst > 0.0 {
        format!("{:.1} ({:.1})", psnr(mean(|difference| difference.mean_square)), psnr(worst))
    } else {
        "equal".to_string()
    };
    format!("{likeness} | {:.2} %", 100.0 * mean(|difference| difference.bad))
}
