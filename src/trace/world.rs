//! What is traced: shapes with materials, lights, and the sky behind them.

use super::shape::Shape;
use crate::texture::{Pattern, Texture};
use glam::Vec3;

/// How a surface answers light: Phong over a texture, a mirror on top, or clear glass.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Base colour by position, linear.
    pub albedo: Texture,
    /// Mirror: share of each colour that is reflected, the rest is shaded locally. Ignored by glass.
    pub reflectance: Vec3,
    /// What Fresnel (Schlick's fifth power) adds to `reflectance` towards grazing angles: 0 none, 1 a full mirror.
    pub fresnel: f32,
    /// Weight of the Phong highlight.
    pub specular: f32,
    /// Exponent of the Phong highlight.
    pub exponent: f32,
    /// Index of refraction; 0: opaque.
    pub ior: f32,
    /// What one crossing of the surface leaves of each colour. Only glass.
    pub filter: Vec3,
}

/// How many numbers of a material the shading of a hit needs.
pub const SURFACE: usize = 14;
/// Where the mean colour stands among them, three numbers;
pub const ALBEDO: usize = 0;
/// the mirror, three;
pub const REFLECTANCE: usize = 3;
/// the tint of glass, three;
pub const FILTER: usize = 6;
/// what Fresnel adds to the mirror;
pub const FRESNEL: usize = 9;
/// the weight of the highlight;
pub const SPECULAR: usize = 10;
/// and its exponent;
pub const EXPONENT: usize = 11;
/// the index of refraction;
pub const IOR: usize = 12;
/// and 1 where there is a texture.
pub const TEXTURED: usize = 13;

impl Material {
    /// A matt surface.
    pub const fn matt(albedo: Texture) -> Material {
        let black = Vec3::ZERO;
        Material { albedo, reflectance: black, fresnel: 0.0, specular: 0.0, exponent: 1.0, ior: 0.0, filter: Vec3::ONE }
    }

    /// Clear glass of index `ior`, each crossing tinted by `filter`.
    pub const fn glass(ior: f32, filter: Vec3) -> Material {
        Material { ior, filter, ..Material::matt(Texture::plain(Vec3::ZERO)) }
    }

    /// With a mirror of one grey and a highlight.
    pub const fn polished(self, reflectance: f32, specular: f32, exponent: f32) -> Material {
        Material { reflectance: Vec3::splat(reflectance), specular, exponent, ..self }
    }

    /// What the shading of a hit needs of it.
    pub fn numbers(&self) -> [f32; SURFACE] {
        let mut numbers = [0.0; SURFACE];
        for (at, color) in [(ALBEDO, self.albedo.mean()), (REFLECTANCE, self.reflectance), (FILTER, self.filter)] {
            numbers[at..at + 3].copy_from_slice(&color.to_array());
        }
        numbers[FRESNEL] = self.fresnel;
        numbers[SPECULAR] = self.specular;
        numbers[EXPONENT] = self.exponent;
        numbers[IOR] = self.ior;
        numbers[TEXTURED] = if self.albedo.pattern == Pattern::Plain { 0.0 } else { 1.0 };
        numbers
    }

    /// Does light pass through?
    pub const fn is_glass(&self) -> bool {
        self.ior > 0.0
    }
}

/// A convex body.
#[derive(Clone, Copy, Debug)]
pub struct Object {
    /// Where it is.
    pub shape: Shape,
    /// What it is made of.
    pub material: Material,
    /// Does it keep light from others? Glass should not; a floor below all lights need not.
    pub casts_shadow: bool,
}

/// Where light comes from.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// A point in space, no falloff (thesis A).
    Point(Vec3),
    /// The unit direction towards a light without distance.
    Directional(Vec3),
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Where it is.
    pub source: Source,
    /// Linear colour times intensity.
    pub color: Vec3,
    /// Radius of the luminous ball (metres; for a directional light the sine of its angular radius): 0 for hard shadows.
    pub radius: f32,
}

/// What a ray meets that meets nothing.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// Colour at and below the horizon.
    pub horizon: Vec3,
    /// Colour straight up; between, linear in the direction's y.
    pub zenith: Vec3,
    /// Unit direction, colour and exponent of a glow; exponent 0: none.
    pub glow: (Vec3, Vec3, f32),
}

/// Everything that the tracer needs of one instant.
#[derive(Clone, Debug)]
pub struct World {
    /// Bodies; the index is the object's identity within a frame.
    pub objects: Vec<Object>,
    /// At most [`World::MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// Light from everywhere.
    pub ambient: Vec3,
    /// Background.
    pub sky: Sky,
    /// Longest chain: 1 is the eye ray alone.
    pub max_level: u32,
}

impl World {
    /// Lights whose state a corner can remember.
    pub const MAX_LIGHTS: usize = 8;
}
