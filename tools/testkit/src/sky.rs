//! Skies, and what their air scatters once, in f64 by brute force.

use glam::{DVec3, Mat3A, Vec3A, vec3a};
use paprsek::sky::air::Air;
use paprsek::sky::dome::Sky;

/// A sky without moon, the sun in the north.
pub fn sky(altitude: f32) -> Sky {
    let a = altitude.to_radians();
    Sky {
        sun: vec3a(0.0, a.sin(), -a.cos()),
        moon: -Vec3A::Y,
        moon_to_sun: Vec3A::X,
        lit: 0.0,
        moon_radius: 0.0045,
        turn: Mat3A::IDENTITY,
        air: Air { haze: 1.3, ozone: 1.1, again: 0.7 },
    }
}

/// The unit direction at an altitude and an azimuth, degrees.
pub fn toward(altitude: f32, azimuth: f32) -> Vec3A {
    let ((y, level), (x, z)) = (altitude.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    vec3a(level * x, y, -level * z)
}

/// Light scattered once, in f64 by brute force: every optical depth is summed, the earth is opaque.
pub fn once(air: &Air, sun: DVec3, d: DVec3) -> [f64; 3] {
    const GAS: [f64; 3] = [5.802e-3, 13.558e-3, 33.1e-3];
    const OZONE: [f64; 3] = [0.650e-3, 1.881e-3, 0.085e-3];
    const R: f64 = 6360.0;
    let densities = |p: DVec3| {
        let h = p.length() - R;
        [(-h / 8.0).exp(), (-h / 1.2).exp(), if (17.5..32.5).contains(&h) { 1.0 } else { 0.0 }]
    };
    let reach = |p: DVec3, d: DVec3, r: f64| {
        let b = p.dot(d);
        -b + (b * b + r * r - p.length_squared()).max(0.0).sqrt()
    };
    let columns = |p: DVec3, d: DVec3, length: f64, n: usize| {
        let mut sum = [0.0; 3];
        for i in 0..n {
            // Quadratic from the denser end.
            let s = (i as f64 + 0.5) / n as f64;
            let found = densities(p + d * (length * s * s));
            for k in 0..3 {
                sum[k] += found[k] * length * 2.0 * s / n as f64;
            }
        }
        sum
    };
    let depth = |c: [f64; 3], k: usize| {
        GAS[k] * c[0] + 3.996e-3 * 1.11 * air.haze as f64 * c[1] + OZONE[k] * air.ozone as f64 * c[2]
    };
    let eye = DVec3::new(0.0, R + 0.2, 0.0);
    let far = reach(eye, d, R + 100.0);
    let cosine = d.dot(sun);
    let gas = 3.0 / (16.0 * std::f64::consts::PI) * (1.0 + cosine * cosine);
    let g = 0.76f64;
    let haze = 3.0 / (8.0 * std::f64::consts::PI) * (1.0 - g * g) * (1.0 + cosine * cosine)
        / ((2.0 + g * g) * (1.0 + g * g - 2.0 * g * cosine).powf(1.5));
    let mut light = [0.0; 3];
    let n = 600;
    let mut seen = [0.0; 3];
    for i in 0..n {
        let s = (i as f64 + 0.5) / n as f64;
        let (t, dt) = (far * s * s, far * 2.0 * s / n as f64);
        let p = eye + d * t;
        let here = densities(p);
        let before = seen.map(|x: f64| x);
        for k in 0..3 {
            seen[k] += here[k] * dt;
        }
        let b = p.dot(sun);
        if b < 0.0 && (p - sun * b).length() < R {
            continue;
        }
        // From the lowest point of the ray both ways, so that the sum is dense where the air is.
        let out = reach(p, sun, R + 150.0);
        let inward = if b < 0.0 {
            let low = p - sun * b;
            let (back, on) = (columns(low, -sun, -b, 300), columns(low, sun, out + b, 600));
            std::array::from_fn(|k| on[k] + if -b > 0.0 { back[k] } else { 0.0 })
        } else {
            columns(p, sun, out, 600)
        };
        for k in 0..3 {
            let way: [f64; 3] = std::array::from_fn(|j| inward[j] + 0.5 * (before[j] + seen[j]));
            let scattered = GAS[k] * here[0] * gas + 3.996e-3 * air.haze as f64 * here[1] * haze;
            light[k] += scattered * (-depth(way, k)).exp() * dt;
        }
    }
    light
}
