//! The bench scenes `snow` and `fire` as their text has them: planes in f64, all particles one after another, and time as
//! a fraction of whole numbers. Nothing here is the renderer's.

use glam::{DVec3, dvec3};

/// Flakes of `snow`.
pub const FLAKES: u32 = 254_648;
/// Sprites of `fire`.
pub const SPARKS: u32 = 10_000;
/// A turn, with the digits of the text.
#[allow(clippy::approx_constant)] // So that it is the text's.
const TURN: f64 = 6.2831853;

/// Steps of a random number: 2^24.
const ONE: i128 = 1 << 24;

/// The random number of the text, in steps of 2^-24.
fn steps(s: u32, i: u32, k: u32) -> i128 {
    let n = (u64::from(s) << 24) + 8 * u64::from(i) + u64::from(k);
    let mask = u64::from(u32::MAX);
    // In 64 bits, cut to 32 after each product.
    let s = ((n & mask) * 747_796_405 + 2_891_336_453) & mask;
    let w = ((((s >> ((s >> 28) + 4)) ^ s) * 277_803_737) & mask) as u32;
    i128::from(((w >> 22) ^ w) >> 8)
}

/// The same, 0 to 1, which is exact.
pub fn random(s: u32, i: u32, k: u32) -> f64 {
    steps(s, i, k) as f64 / ONE as f64
}

fn mix(a: DVec3, b: DVec3, x: f64) -> DVec3 {
    a + (b - a) * x
}

/// 0 below `a`, 1 above `b`, with no slope at either.
pub fn smoothstep(a: f64, b: f64, x: f64) -> f64 {
    let u = ((x - a) / (b - a)).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// Seconds without rounding: `n / 2^k`.
#[derive(Clone, Copy)]
pub struct Time {
    n: i128,
    k: u32,
}

impl Time {
    /// What an f64 stands for. Panics where that is no multiple of 2^-64 or above 2^53.
    pub fn new(seconds: f64) -> Time {
        let (mut m, mut k) = (seconds, 0);
        while m != m.trunc() {
            (m, k) = (m * 2.0, k + 1);
        }
        assert!(k <= 64 && m.abs() <= (1u64 << 53) as f64, "{seconds}");
        Time { n: m as i128, k }
    }

    /// So many parts of `parts` times the time: the whole number below it, and what is left, 0 to 1.
    fn times(self, share: i128, parts: i128) -> (i128, f64) {
        let (above, below) = (self.n * share, parts << self.k);
        (above.div_euclid(below), above.rem_euclid(below) as f64 / below as f64)
    }

    /// The same wrapped to 0 to `period`, in which what comes later can be added without loss.
    fn wrapped(self, share: i128, parts: i128, period: i128) -> f64 {
        let (whole, rest) = self.times(share, parts);
        whole.rem_euclid(period) as f64 + rest
    }

    /// Sine and cosine of so much of the time and an angle more. The library reduces whole angles without error, and the
    /// rest is small.
    fn sin_cos(self, share: i128, parts: i128, more: f64) -> (f64, f64) {
        let (whole, rest) = self.times(share, parts);
        let ((s, c), (t, d)) = ((whole as f64).sin_cos(), (rest + more).sin_cos());
        (s * d + c * t, c * d - s * t)
    }
}

/// Who looks: axes, and the picture in pixels.
pub struct Camera {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    width: usize,
    height: usize,
}

/// A sprite on the screen: its middle and radius in pixels from the top left, before anything clamps it, and its depth.
pub struct Spot {
    /// Column of the middle, pixels.
    pub x: f64,
    /// Row of the middle, pixels.
    pub y: f64,
    /// Pixels.
    pub radius: f64,
    /// Metres along the view axis.
    pub depth: f64,
}

impl Camera {
    /// Looks along `forward`, with the text's field of view.
    pub fn new(forward: DVec3, (width, height): (usize, usize)) -> Camera {
        let forward = forward.normalize();
        let right = forward.cross(DVec3::Y).normalize();
        Camera { forward, right, up: right.cross(forward), width, height }
    }

    /// A ball around a place from the eye; none where it is nearer than a sprite may be.
    pub fn spot(&self, place: DVec3, radius: f64) -> Option<Spot> {
        let depth = place.dot(self.forward);
        if depth <= 0.25 {
            return None;
        }
        let [w, h] = [self.width, self.height].map(|n| n as f64);
        // For 720 rows the text has 360 / tan 25 degrees.
        let focal = 0.5 * h / 25f64.to_radians().tan();
        let x = 0.5 * w + focal * place.dot(self.right) / depth;
        let y = 0.5 * h - focal * place.dot(self.up) / depth;
        Some(Spot { x, y, radius: focal * radius / depth, depth })
    }

    /// Every pixel whose centre is in a disc, and the disc's weight there.
    pub fn cover(&self, spot: &Spot, mut pixel: impl FnMut(usize, f64)) {
        let range = |middle: f64, end: usize| {
            let first = (middle - spot.radius - 0.5).ceil().max(0.0) as usize;
            let last = (middle + spot.radius - 0.5).floor().min(end as f64 - 1.0);
            first..(last + 1.0).max(0.0) as usize
        };
        for row in range(spot.y, self.height) {
            for column in range(spot.x, self.width) {
                let (dx, dy) = (column as f64 + 0.5 - spot.x, row as f64 + 0.5 - spot.y);
                let rho2 = (dx * dx + dy * dy) / (spot.radius * spot.radius);
                if rho2 < 1.0 {
                    pixel(row * self.width + column, (1.0 - rho2).powi(2));
                }
            }
        }
    }

    /// The background by the row: from the bottom to the top.
    fn background(&self, low: DVec3, high: DVec3) -> Vec<DVec3> {
        let above = |row: usize| (self.height as f64 - row as f64 - 0.5) / self.height as f64;
        (0..self.width * self.height).map(|at| mix(low, high, above(at / self.width))).collect()
    }
}

/// A flake of `snow`: where it is from an eye that far beside the text's, its radius, and `g`, its squared distance from the
/// eye's axis as a share of the cylinder's.
pub fn flake(time: Time, i: u32, beside: DVec3) -> (DVec3, f64, f64) {
    let [r0, r1, r2, _, r4, r5, _, r7] = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| random(3, i, k));
    let swing = 0.15 + 0.25 * r4;
    let (sin, cos) = time.sin_cos(8 * ONE + 8 * steps(3, i, 6), 10 * ONE, TURN * r5);
    // The wind and the fall less the way of the eye: .8 - 1.5, -(.9 + .7 rho) and .35 + 2 metres a second.
    let way = dvec3(
        time.wrapped(-7, 10, 30),
        time.wrapped(-(9 * ONE + 7 * steps(3, i, 3)), 10 * ONE, 16),
        time.wrapped(235, 100, 30),
    );
    let size = dvec3(30.0, 16.0, 30.0);
    let q = size * dvec3(r0, r1, r2) + way + dvec3(swing * sin, -1.7, swing * cos) - beside;
    let q = q - size * (q / size + 0.5).floor();
    (q, 0.008 + 0.010 * r7, (q.x * q.x + q.z * q.z) / 225.0)
}

/// How many flakes are in the cylinder that is drawn.
pub fn flakes_in_the_cylinder(seconds: f64) -> usize {
    let time = Time::new(seconds);
    (0..FLAKES).filter(|i| flake(time, *i, DVec3::ZERO).2 < 1.0).count()
}

/// The picture of `snow`, 0 to 1, with its flakes in that order.
pub fn snow(seconds: f64, size: (usize, usize), order: impl Iterator<Item = u32>) -> Vec<DVec3> {
    snow_beside(seconds, size, order, DVec3::ZERO)
}

/// The same from an eye that far beside the text's.
pub fn snow_beside(seconds: f64, size: (usize, usize), order: impl Iterator<Item = u32>, beside: DVec3) -> Vec<DVec3> {
    let time = Time::new(seconds);
    let ((sx, cx), (sy, _)) = (time.sin_cos(3, 10, 0.0), time.sin_cos(5, 10, 0.0));
    let camera = Camera::new(dvec3(sx, 0.08 * sy, cx), size);
    let mut light = camera.background(dvec3(0.58, 0.63, 0.70), dvec3(0.16, 0.20, 0.30));
    for i in order {
        let (place, radius, g) = flake(time, i, beside);
        let Some(mut spot) = camera.spot(place, radius).filter(|_| g < 1.0) else { continue };
        let alpha = 0.85 * (1.0 - g) * smoothstep(0.25, 1.0, spot.depth) * (spot.radius * spot.radius).min(1.0);
        spot.radius = spot.radius.clamp(1.0, 24.0);
        camera.cover(&spot, |at, weight| light[at] = mix(light[at], dvec3(0.95, 0.97, 1.0), alpha * weight));
    }
    light
}

/// A spark of `fire`: where it is, its radius, its light.
fn spark(time: Time, i: u32) -> (DVec3, f64, DVec3) {
    let [r0, r1, r2, r3, r4, r5, r6] = [0, 1, 2, 3, 4, 5, 6].map(|k| random(4, i, k));
    // t / life is ten steps over eight and seven of them, of 2^-24.
    let phase = time.times(10 * ONE, 8 * ONE + 7 * steps(4, i, 0)).1 + r1;
    let x = phase - phase.floor();
    let life = 0.8 + 0.7 * r0;
    let torch = 1.25663706 * f64::from(i / 2000);
    let (gamma, wide) = (TURN * r5, 0.14 * r4.sqrt());
    let start = dvec3(3.0 * torch.cos() + wide * gamma.cos(), 1.2, 3.0 * torch.sin() + wide * gamma.sin());
    let (phi, theta) = (TURN * r2, 0.35 * r3.sqrt());
    let direction = dvec3(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
    let first = 0.9 + 0.7 * r6;
    let last = 0.25 * first;
    let way = life * (first * x + (last - first) * x * x / 2.0);
    let place = start + direction * way + DVec3::Y * (0.55 * (x * life).powi(2));
    let light = mix(dvec3(1.0, 0.62, 0.20), dvec3(0.80, 0.10, 0.02), x);
    (place, 0.15 + (0.035 - 0.15) * x, light * (0.008 * 30.0 * x * (1.0 - x).powi(2)))
}

/// The picture of `fire`, 0 to 1, with its sparks in that order.
pub fn fire(seconds: f64, size: (usize, usize), order: impl Iterator<Item = u32>) -> Vec<DVec3> {
    let time = Time::new(seconds);
    let (sin, cos) = time.sin_cos(3, 10, 0.0);
    let eye = dvec3(7.0 * sin, 2.2, 7.0 * cos);
    let camera = Camera::new(dvec3(0.0, 1.8, 0.0) - eye, size);
    let mut sum = vec![DVec3::ZERO; size.0 * size.1];
    for i in order {
        let (place, radius, light) = spark(time, i);
        if let Some(spot) = camera.spot(place - eye, radius) {
            camera.cover(&spot, |at, weight| sum[at] += light * weight);
        }
    }
    let background = camera.background(dvec3(0.05, 0.05, 0.07), dvec3(0.01, 0.015, 0.05));
    background.iter().zip(&sum).map(|(behind, e)| 1.0 - (1.0 - *behind) * (-1.6 * *e).exp()).collect()
}

/// A scene by its name, in the text's order.
pub fn scene(name: &str, seconds: f64, size: (usize, usize)) -> Vec<DVec3> {
    match name {
        "snow" => snow(seconds, size, 0..FLAKES),
        "fire" => fire(seconds, size, 0..SPARKS),
        _ => panic!("{name} has no text here"),
    }
}
