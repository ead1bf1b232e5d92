//! How far the air bends light from the sky: rays followed through an atmosphere whose index falls with its density.

use super::{Row, told};
use crate::dome;
use crate::metrics::Error;
use glam::{Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::settings::Quality;
use paprsek::sky::{Dome, SkyLayer};
use paprsek::view::{Camera, View};

/// The earth's radius, metres, and the air's refractivity on the ground at 10 degrees Celsius and 1010 hPa.
const EARTH: f64 = 6.371e6;
const REFRACTIVITY: f64 = 2.824e-4;
/// Temperature on the ground, kelvin, and its fall with height up to the tropopause, kelvin per metre.
const GROUND: f64 = 283.15;
const LAPSE: f64 = 0.0065;
const TROPOPAUSE: f64 = 11_000.0;
/// Kelvin per metre at which the weight of dry air is in balance.
const BALANCE: f64 = 0.034_163;

/// Refractivity at a height, by the density of the standard atmosphere.
fn refractivity(height: f64) -> f64 {
    let below = height.min(TROPOPAUSE);
    let troposphere = (1.0 - LAPSE * below / GROUND).powf(BALANCE / LAPSE - 1.0);
    let cold = GROUND - LAPSE * TROPOPAUSE;
    REFRACTIVITY * troposphere * (-(height - below) * BALANCE / cold).exp()
}

/// Degrees by which a ray is bent on its way out, that leaves the ground at this apparent height in degrees.
fn bending(apparent: f64) -> f64 {
    let (mut height, mut zenith, mut bent) = (0.0, (90.0 - apparent).to_radians(), 0.0);
    let step = 50.0;
    // The midpoint method, along the ray.
    let rates = |height: f64, zenith: f64| {
        let fall = (refractivity(height + 0.5) - refractivity(height - 0.5)) / (1.0 + refractivity(height));
        let turn = -fall * zenith.sin();
        [zenith.cos(), turn - zenith.sin() / (EARTH + height), turn]
    };
    while height < 90_000.0 {
        let [up, turn, _] = rates(height, zenith);
        let [up, turn, bend] = rates(height + 0.5 * step * up, zenith + 0.5 * step * turn);
        height += step * up;
        zenith += step * turn;
        bent += step * bend;
    }
    bent.to_degrees()
}

/// Bennett's formula, degrees, for an apparent height in degrees: within 0.07' of the tables `[Bennett82]`.
fn bennett(apparent: f64) -> f64 {
    1.0 / (apparent + 7.31 / (apparent + 4.4)).to_radians().tan() / 60.0
}

/// The sky towards the sun at a height.
fn sky(renderer: &mut Renderer, altitude: f64) -> Frame {
    let quality = Quality::EXACT;
    let mut frame = Frame::new(640, 360);
    let camera = Camera::look_at(Vec3A::ZERO, vec3a(0.0, 0.1, -1.0), 50f32.to_radians(), 0.0);
    let view = View::new(camera, frame.width, frame.height);
    let layer = SkyLayer::new(Dome::new(dome::sky(altitude as f32, dome::HAZE), &quality.sky), &view, &quality.sky);
    renderer.draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame);
    frame
}

/// At the horizon, and higher.
pub fn rows() -> Vec<Row> {
    let mut renderer = Renderer::new(0).expect("threads can be started");
    let mut row = |apparent: f64| {
        let bent = bending(apparent);
        // Pixels at the middle of 720 rows of 50 degrees.
        let pixels = bent.to_radians() * 360.0 / 25f64.to_radians().tan();
        let ours = sky(&mut renderer, apparent - bent);
        let truth = sky(&mut renderer, apparent);
        Row {
            what: "sky: refraction of the air",
            scene: format!("the sun seen at {apparent} degrees"),
            reference: format!(
                "a ray through the standard atmosphere; Bennett's formula has {:.3} degrees",
                bennett(apparent)
            ),
            error: format!("{bent:.3} degrees, {pixels:.1} rows of 720; {}", told(&Error::between(&ours, &truth))),
            cost: "0 (a formula per frame)".into(),
            bytes: "60 (Bennett's formula)",
        }
    };
    [0.0, 2.0, 10.0, 45.0].map(&mut row).into()
}
