//! The light of the air.

use crate::case::{Case, Effort, Runs};
use glam::Vec3A;
use paprsek::frame::encode::srgb_encode;
use paprsek::settings::{Quality, SkySettings};
use paprsek::sky::dome::Dome;
use testkit::Found;
use testkit::sky::{once, sky, toward};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Best,
        "light scattered once, sun at 60 to -6 degrees",
        "[Bruneton08], [Hillaire20]",
        "600 steps in f64 along 600",
        0.03,
        scattered,
    )
    .unit("relative"),
    Case::new(
        Runs::Best,
        "twice the steps: the sky's error falls by the second order",
        "refinement",
        "400 steps, order 2; ozone is a shell with an edge",
        0.5,
        order,
    )
    .unit("orders short"),
    Case::new(
        Runs::Best,
        "colours while the sun sinks by 0.02 degrees, within a degree of each switch",
        "-0.833, -6, -12, -18 degrees",
        "codes from step to step",
        4.0,
        sinking,
    )
    .unit("codes"),
    Case::new(
        Runs::Best,
        "colours across the horizon, by 0.01 degrees",
        "a seam",
        "codes from step to step",
        1.0,
        horizon,
    )
    .unit("codes"),
];

const EXACT: SkySettings = SkySettings { steps: 100, cell: 0.0, grid: 1 };

fn scattered(effort: &Effort) -> Found {
    const NIGHT: f64 = 1e-6;
    let mut found = Found::default();
    for &altitude in effort.some(&[30.0, 0.0, 60.0, 10.0, 5.0, 2.0, -2.0, -4.0, -6.0], 1) {
        let mut sky = sky(altitude);
        sky.air.again = 0.0;
        let dome = Dome::new(sky, &EXACT);
        let directions = [(45.0, 10.0), (90.0, 0.0), (45.0, 170.0), (15.0, 0.0), (15.0, 90.0), (15.0, 180.0)];
        for &(height, azimuth) in effort.some(&directions, 2) {
            let d = toward(height, azimuth);
            let (light, truth) = (dome.light(d), once(&sky.air, sky.sun.as_dvec3(), d.as_dvec3()));
            for k in 0..3 {
                // What is dimmer than night is lost in it.
                let off = ((light[k] as f64 - truth[k]).abs() - NIGHT).max(0.0) / truth[k];
                found.see(off, || format!("sun {altitude}, {height} {azimuth}: {light} for {truth:?}"));
            }
        }
    }
    found
}

fn order(_: &Effort) -> Found {
    let mut found = Found::default();
    let mut errors = [0.0f64; 3];
    for altitude in [40.0, 10.0, 2.0] {
        let light = |steps: u32, d: Vec3A| {
            let mut sky = sky(altitude);
            sky.air.again = 0.0;
            Dome::new(sky, &SkySettings { steps, ..EXACT }).light(d)
        };
        for (height, azimuth) in [(90.0, 0.0), (45.0, 30.0), (20.0, 120.0), (10.0, 180.0)] {
            let d = toward(height, azimuth);
            let truth = light(400, d);
            for (error, steps) in errors.iter_mut().zip([10, 20, 40]) {
                let off = (light(steps, d) - truth) / truth;
                *error += off.length_squared() as f64;
                found.inputs += 1;
            }
        }
    }
    let orders = [0, 1].map(|k| 0.5 * (errors[k] / errors[k + 1]).log2());
    found.more(2.0 - orders[0].min(orders[1]), || format!("orders {orders:?}, squares {errors:?}"));
    found
}

/// Codes of a sky's colours in some directions, and of its light.
fn codes(altitude: f32) -> Vec<f32> {
    let dome = Dome::new(sky(altitude), &Quality::DEFAULT.sky);
    let mut colors = Vec::new();
    for azimuth in [0.0, 60.0, 120.0, 180.0] {
        colors.extend([-3.0, 0.5, 3.0, 10.0, 30.0, 80.0].map(|height| dome.radiance(toward(height, azimuth))));
    }
    let light = dome.lighting();
    colors.extend([light.color * 0.2, light.sky, light.ground]);
    colors.iter().flat_map(|c| c.to_array()).map(|c| 255.0 * srgb_encode(c)).collect()
}

fn sinking(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &middle in effort.some(&[-0.833, -6.0, -12.0, -18.0, 0.0, -3.0, -9.0, -11.0], 4) {
        // A degree to either side of each, by 0.02; a quick run goes less far.
        let reach = effort.of(50).max(5) as i32;
        let at = |k: i32| middle - 0.02 * k as f32;
        let mut last = codes(at(-reach));
        for k in 1 - reach..=reach {
            let next = codes(at(k));
            let jump = last.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            found.see(jump as f64, || format!("sun at {}", at(k)));
            last = next;
        }
    }
    found
}

fn horizon(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &altitude in effort.some(&[3.0, -5.0, 40.0, 0.0, -10.0, -18.0], 2) {
        let dome = Dome::new(sky(altitude), &EXACT);
        for azimuth in [0.0, 90.0, 180.0] {
            let code =
                |k: i32| dome.radiance(toward(k as f32 * 0.01, azimuth)).to_array().map(|c| 255.0 * srgb_encode(c));
            let mut last = code(-100);
            for k in -99..=100 {
                let next = code(k);
                let jump = (0..3).map(|c| (next[c] - last[c]).abs()).fold(0.0, f32::max);
                found.see(jump as f64, || format!("sun {altitude}, azimuth {azimuth}, {k} hundredths of a degree"));
                last = next;
            }
        }
    }
    found
}
