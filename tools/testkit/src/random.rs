//! The same cases in every run: a generator of one line and what is drawn from it.

use glam::{Mat3A, Quat, Vec3A};

/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
pub struct Random(
    /// The seed, then the state.
    pub u64,
);

impl Random {
    /// Uniform, 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ z >> 31) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Every order of magnitude as often as another.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.unit()).exp()
    }

    /// Uniform over the sphere, normalised in f32.
    pub fn direction(&mut self) -> Vec3A {
        let (z, a) = (self.range(-1.0, 1.0), self.range(0.0, std::f64::consts::TAU));
        let r = (1.0 - z * z).sqrt();
        Vec3A::new((r * a.cos()) as f32, (r * a.sin()) as f32, z as f32).normalize()
    }

    /// A direction across `d`.
    pub fn across(&mut self, d: Vec3A) -> Vec3A {
        d.cross(self.direction()).try_normalize().unwrap_or_else(|| d.any_orthonormal_vector())
    }

    /// A rotation.
    pub fn turn(&mut self) -> Mat3A {
        Mat3A::from_quat(Quat::from_axis_angle(self.direction().into(), self.range(0.0, 6.3) as f32))
    }
}
