//! Fresnel's reflectance.

use super::rays::any;
use crate::case::{Case, Effort, Runs};
use fearless_simd::dispatch;
use paprsek::trace::reference;
use testkit::fresnel::{ROUNDING, cases, truth, wide, worst};
use testkit::random::Random;
use testkit::{Found, levels};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::All,
        "indices from equal to apart by 3, cosines from 1e-5, the critical angle +- 1e-7",
        "1 - n^2 (1 - c^2) cancels",
        "f64 without cancellation",
        1.0,
        ratios,
    )
    .unit("of the bound"),
    Case::new(Runs::All, "equal indices, cosines from 1e-5 to 1", "grazing light", "closed form: 0", 1e-12, equal),
    Case::new(
        Runs::All,
        "straight on, indices of 0.1 to 10",
        "Hecht, Optics, 4.6",
        "((n - 1) / (n + 1))^2",
        ROUNDING,
        straight,
    ),
    Case::new(
        Runs::All,
        "Brewster's angle, indices of 1.01 to 4",
        "Hecht, Optics, 4.6",
        "((n^2 - 1) / (n^2 + 1))^2 / 2",
        ROUNDING,
        brewster,
    ),
    Case::new(Runs::All, "there and back through a surface", "Stokes' relations", "reflectances are equal", 2e-6, back),
    Case::new(
        Runs::All,
        "any ratio, any cosine: a share from 0 to 1; NaN reflects totally",
        "1e-8 to 1e8 with specials",
        "range; levels have the reference's bits",
        0.0,
        shares,
    )
    .unit("failures"),
];

fn ratios(effort: &Effort) -> Found {
    let mut found = Found::default();
    for (low, high) in [(1e-7, 1e-5), (1e-5, 1e-3), (1e-3, 1e-1), (0.1, 1.0), (1.0, 3.0)] {
        let [eta, cosine] = cases(effort.of(1 << 18) as usize / 64 * 64 + 64, low, high, 1e-5);
        let plain: Vec<_> = eta.iter().zip(&cosine).map(|(&eta, &cosine)| reference::fresnel(eta, cosine)).collect();
        found.inputs += eta.len() as u64;
        found.more(worst(&eta, &cosine, &plain).0, || format!("|eta - 1| of {low} to {high}"));
        for (name, level) in levels() {
            let same = dispatch!(level, simd => wide(simd, &eta, &cosine)) == plain;
            found.more(if same { 0.0 } else { f64::INFINITY }, || format!("{name} is not the reference"));
        }
    }
    found
}

/// The reflectance of every implementation.
fn all(eta: f32, cosine: f32) -> Vec<f64> {
    let share = |found: Option<(f32, f32)>| found.map_or(1.0, |found| found.0 as f64);
    let mut all = vec![share(reference::fresnel(eta, cosine))];
    for (_, level) in levels() {
        all.push(share(dispatch!(level, simd => wide(simd, &[eta; 16], &[cosine; 16]))[0]));
    }
    all
}

fn compare(found: &mut Found, eta: f32, cosine: f32, truth: f64) {
    let error = all(eta, cosine)
        .into_iter()
        .map(|share| (share - truth).abs())
        .fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a });
    found.see(error, || format!("eta {eta}, cosine {cosine}: {truth} is due"));
}

fn equal(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(50);
    for _ in 0..effort.of(20_000) {
        compare(&mut found, 1.0, random.log(1e-5, 1.0) as f32, 0.0);
    }
    found
}

fn straight(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(51);
    for _ in 0..effort.of(20_000) {
        let eta = random.log(0.1, 10.0) as f32;
        let n = eta as f64;
        compare(&mut found, eta, 1.0, ((n - 1.0) / (n + 1.0)).powi(2));
    }
    found
}

fn brewster(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(52);
    for _ in 0..effort.of(20_000) {
        let eta = (1.0 / random.range(1.01, 4.0)) as f32;
        // The tangent of the angle is the index behind over the one before.
        let n = 1.0 / eta as f64;
        let cosine = n.atan().cos() as f32;
        compare(&mut found, eta, cosine, 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2));
    }
    found
}

/// Light that comes out of a surface is reflected as much as what went in: the way back has the other ratio, and the
/// cosine that was found behind. Away from grazing, where the reflectance is steep.
fn back(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(53);
    for _ in 0..effort.of(100_000) {
        let (eta, cosine) = ((1.0 / random.range(1.0, 4.0)) as f32, random.range(0.3, 1.0) as f32);
        let Some((share, through)) = reference::fresnel(eta, cosine) else {
            found.see(f64::INFINITY, || format!("{eta} {cosine}: total reflection into the denser side"));
            continue;
        };
        let behind = through.min(1.0);
        // Both roundings of the ratio and of the cosine shift the way back; f64 says by how much that may be.
        let due = truth(1.0 / eta as f64, behind as f64).1;
        let other = reference::fresnel(1.0 / eta, behind).map_or(1.0, |found| found.0);
        found.see((share as f64 - other as f64).abs() - (due - share as f64).abs(), || {
            format!("{eta} {cosine}: {share} and {other}")
        });
    }
    found
}

fn shares(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(54);
    for _ in 0..effort.of(200_000) {
        let (eta, cosine) = (any(&mut random), any(&mut random));
        let physical =
            eta.is_finite() && eta.abs() > 1e-15 && eta.abs() < 1e15 && eta > 0.0 && cosine > 0.0 && cosine <= 1.0;
        let plain = reference::fresnel(eta, cosine);
        let fits = !physical
            || plain.is_none_or(|(share, through)| {
                (0.0..=1.0 + 1e-6).contains(&share) && (0.0..=1.0 + 1e-6).contains(&through)
            });
        let total = !(eta.is_nan() || cosine.is_nan()) || plain.is_none();
        let bits = |found: Option<(f32, f32)>| {
            found.map(|(a, b)| (if a.is_nan() { 0 } else { a.to_bits() }, if b.is_nan() { 0 } else { b.to_bits() }))
        };
        let same = levels().into_iter().all(|(_, level)| {
            // The wide one gives 1 for a total reflection, and its mask says so.
            let (eta, cosine) = ([eta; 16], [cosine; 16]);
            bits(dispatch!(level, simd => testkit::fresnel::lanes(simd, &eta, &cosine))[0]) == bits(plain)
        });
        found.judge(fits && total && same, || {
            format!("eta {eta:e}, cosine {cosine:e}: {plain:?}, levels agree: {same}")
        });
    }
    found
}
