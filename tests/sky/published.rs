//! The air against published tables of real air: how far the model is from nature, which README.md of the sky says.
//! What is left out (refraction, the change of temperature with height) bounds it, not
//! the arithmetic.

use glam::Vec3A;
use paprsek::settings::SkySettings;
use paprsek::sky::dome::Dome;
use std::f64::consts::PI;
use testkit::sky::{sky, toward};

const EXACT: SkySettings = SkySettings { steps: 100, cell: 0.0, grid: 1 };

/// Optical depth of gas, haze and ozone together from the eye towards an altitude, at 680, 550 and 440 nm.
fn depth(haze: f32, ozone: f32, altitude: f64) -> [f64; 3] {
    let mut sky = sky(40.0);
    (sky.air.haze, sky.air.ozone) = (haze, ozone);
    Dome::new(sky, &EXACT).through(toward(altitude as f32, 0.0)).to_array().map(|left| -f64::from(left).ln())
}

/// Rayleigh's optical depth at sea level, `[Bodhaine99]`, equation 30, by the wavelength in micrometres.
fn bodhaine(wavelength: f64) -> f64 {
    let (above, below) = (wavelength.powi(-2), wavelength.powi(2));
    0.002_152_0 * (1.045_599_6 - 341.290_61 * above - 0.902_308_50 * below)
        / (1.0 + 0.002_705_988_9 * above - 85.968_563 * below)
}

#[test]
fn gas_is_a_tenth_thicker_than_the_table() {
    // At the eye, 200 m above the sea, where pressure is 0.976 of that at sea level.
    for (found, wavelength) in depth(0.0, 0.0, 90.0).into_iter().zip([0.68, 0.55, 0.44]) {
        let ratio = found / (0.976 * bodhaine(wavelength));
        println!("{wavelength} um: {found:.4}, {ratio:.3} of the table");
        assert!((1.08..1.14).contains(&ratio), "{wavelength}: {ratio}");
    }
}

#[test]
fn air_masses_are_those_of_the_table_down_to_the_horizon() {
    let zenith = depth(0.0, 0.0, 90.0)[1];
    // `[KastenYoung89]`: 2 % down to 5 degrees, 7 % at the horizon, where refraction bends light into denser air.
    for (altitude, allowed) in [(60.0, 0.003), (30.0, 0.003), (10.0, 0.008), (5.0, 0.02), (2.0, 0.045), (0.0, 0.07)] {
        let table = 1.0 / ((altitude * PI / 180.0).sin() + 0.505_72 * (altitude + 6.079_95f64).powf(-1.6364));
        let found = depth(0.0, 0.0, altitude)[1] / zenith;
        println!("{altitude} degrees: {found:.3}, table {table:.3}, {:+.2} %", (found / table - 1.0) * 100.0);
        assert!((found / table - 1.0).abs() < allowed, "{altitude}: {found} {table}");
    }
}

/// Share of the sky's light in all light that falls on level ground under a sun 60 degrees high, by colour.
fn diffuse(haze: f32) -> [f32; 3] {
    let mut at = sky(60.0);
    (at.air.haze, at.air.ozone) = (haze, 1.0);
    let sun = at.sun;
    let dome = Dome::new(at, &EXACT);
    let mut diffuse = Vec3A::ZERO;
    let (rings, turns) = (45, 60);
    for ring in 0..rings {
        let [low, high] = [ring, ring + 1].map(|ring| (ring as f32 * PI as f32 / 90.0).sin().powi(2));
        // The direction that halves the ring as level ground sees it.
        let altitude = (0.5 * (low + high)).sqrt().asin().to_degrees();
        for turn in 0..turns {
            let d = toward(altitude, 360.0 * (turn as f32 + 0.5) / turns as f32);
            diffuse += dome.light(d) * ((high - low) * PI as f32 / turns as f32);
        }
    }
    (diffuse / (diffuse + dome.through(sun) * sun.y)).to_array()
}

#[test]
fn the_sky_is_as_bright_as_one_of_so_much_haze() {
    // Haze of amount 1 has an optical depth of 0.0053, a twentieth of what the clear air of most places has. So the
    // sky's share is half of the 0.12 that the Solis model gives such air `[Ineichen08]`; with its haze it is that of Solis.
    for (haze, low, high) in [(1.0, 0.06, 0.075), (10.0, 0.09, 0.12), (20.0, 0.12, 0.15)] {
        let share = diffuse(haze);
        println!("haze {haze}: share {share:?}");
        assert!((low..high).contains(&share[1]), "{haze}: {share:?}");
    }
}
