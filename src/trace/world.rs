//! What the ray tracer is given: convex bodies with their materials, lights, and the background behind them.
//!
//! Light is linear; a colour is light per channel (red, green, blue) and may exceed 1. Lengths are metres, y points up.
//! Nothing is validated: directions and axes that are called unit have to be of length 1, and numbers that are not finite
//! give unspecified light.

use super::shape::Shape;
use crate::texture::Texture;
use glam::Vec3A;

/// The index that stands for no body.
pub const NOWHERE: u32 = u32::MAX;

/// How a surface answers light: Phong's model over a solid texture with a mirror on top, or clear glass.
///
/// A matte surface reflects `albedo` times the light that falls on it by Lambert's law, and adds a highlight
/// `[Phong75]`. The mirror takes its share of both and replaces it by the mirrored light. Glass has neither texture nor
/// mirror: it splits light by Fresnel's law for unpolarised light, and adds a highlight.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Colour of the surface by position. Glass ignores it.
    pub albedo: Texture,
    /// Share of each colour that is mirrored at normal incidence, 0 to 1; the rest is shaded locally. Glass ignores it.
    pub reflectance: Vec3A,
    /// How much of what lacks to a full mirror is added at grazing angles, 0 to 1, by the fifth power of Schlick's
    /// approximation `[Schlick94]`. Glass ignores it.
    pub fresnel: f32,
    /// Weight of the highlight; 0 for none.
    pub specular: f32,
    /// Exponent of the highlight: the larger, the smaller and sharper it is.
    pub exponent: f32,
    /// Index of refraction, relative to what surrounds the body; 0 for an opaque surface.
    pub ior: f32,
    /// Share of each colour that one crossing of a glass surface leaves, 0 to 1. Opaque surfaces ignore it.
    pub filter: Vec3A,
}

impl Material {
    /// A surface that scatters light evenly: no mirror, no highlight.
    pub const fn matte(albedo: Texture) -> Material {
        let black = Vec3A::ZERO;
        Material {
            albedo,
            reflectance: black,
            fresnel: 0.0,
            specular: 0.0,
            exponent: 1.0,
            ior: 0.0,
            filter: Vec3A::ONE,
        }
    }

    /// A matte surface of one colour.
    pub const fn plain(color: Vec3A) -> Material {
        Material::matte(Texture::plain(color))
    }

    /// A mirror over black: it shows nothing but `reflectance` times what it mirrors.
    pub const fn mirror(reflectance: Vec3A) -> Material {
        Material { reflectance, ..Material::plain(Vec3A::ZERO) }
    }

    /// Clear glass with the index of refraction `ior`, above 0. Each crossing of the surface leaves `filter` of the light.
    pub const fn glass(ior: f32, filter: Vec3A) -> Material {
        Material { ior, filter, ..Material::plain(Vec3A::ZERO) }
    }

    /// The same material with a colourless mirror and a highlight.
    pub const fn polished(self, reflectance: f32, specular: f32, exponent: f32) -> Material {
        Material { reflectance: Vec3A::splat(reflectance), ..self.shiny(specular, exponent) }
    }

    /// The same material with a highlight of the weight `specular`.
    pub const fn shiny(self, specular: f32, exponent: f32) -> Material {
        Material { specular, exponent, ..self }
    }

    /// The same material with a lacquer: a mirror that grows by `fresnel` (0 to 1) towards grazing angles.
    pub const fn lacquered(self, fresnel: f32) -> Material {
        Material { fresnel, ..self }
    }

    /// Whether light passes through.
    pub const fn is_glass(&self) -> bool {
        self.ior > 0.0
    }
}

/// A convex body.
#[derive(Clone, Copy, Debug)]
pub struct Object {
    /// Shape and place.
    pub shape: Shape,
    /// What it is made of.
    pub material: Material,
    /// Whether it keeps light from other bodies. A ball of glass gathers behind it what it lets through, as one with an
    /// index of 1.5 does, in the light's own colour; all else casts the shadow of a solid, so other glass usually should
    /// not. A floor below all lights need not.
    pub casts_shadow: bool,
}

impl Object {
    /// A body that casts a shadow.
    pub const fn new(shape: Shape, material: Material) -> Object {
        Object { shape, material, casts_shadow: true }
    }

    /// The same body without a shadow.
    pub const fn without_shadow(self) -> Object {
        Object { casts_shadow: false, ..self }
    }
}

/// Where light comes from.
#[derive(Clone, Copy, Debug)]
pub enum Emitter {
    /// A point in space. Its light does not fall off with distance `[Intro07]`.
    Point(Vec3A),
    /// The unit direction towards a light that is infinitely far away.
    Directional(Vec3A),
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Where it is.
    pub emitter: Emitter,
    /// Light on a white surface that faces it.
    pub color: Vec3A,
    /// Radius of the luminous ball, for soft shadows: metres, or for a directional light the sine of its angular radius.
    /// 0 for hard shadows. The 64 kB build takes every light as a point.
    pub radius: f32,
}

impl Light {
    /// A light at a point, with hard shadows.
    pub const fn point(position: Vec3A, color: Vec3A) -> Light {
        Light { emitter: Emitter::Point(position), color, radius: 0.0 }
    }

    /// A light in a unit direction, with hard shadows. It is not normalised: a longer one is a brighter light.
    pub const fn directional(towards: Vec3A, color: Vec3A) -> Light {
        Light { emitter: Emitter::Directional(towards), color, radius: 0.0 }
    }

    /// The same light with a radius (see [`Light::radius`]).
    pub const fn with_radius(self, radius: f32) -> Light {
        Light { radius, ..self }
    }
}

/// A lobe of light in the background, around the sun for example.
#[derive(Clone, Copy, Debug)]
pub struct Glow {
    /// Unit direction of its middle.
    pub direction: Vec3A,
    /// Light that it adds in its middle.
    pub color: Vec3A,
    /// How often the cosine of the angle to it is squared, at most 30 times: 3 means the eighth power.
    pub squarings: u32,
}

impl Glow {
    /// No glow.
    pub const NONE: Glow = Glow { direction: Vec3A::Y, color: Vec3A::ZERO, squarings: 0 };
}

/// What a ray sees that meets no body: a vertical gradient, and a glow on top.
#[derive(Clone, Copy, Debug)]
pub struct Background {
    /// Light at the horizon and below.
    pub horizon: Vec3A,
    /// Light straight up. In between, light is linear in the y of the direction.
    pub zenith: Vec3A,
    /// What is added around one direction.
    pub glow: Glow,
}

impl Background {
    /// The same light from everywhere.
    pub const fn even(color: Vec3A) -> Background {
        Background::gradient(color, color)
    }

    /// From the light at the horizon to that at the zenith.
    pub const fn gradient(horizon: Vec3A, zenith: Vec3A) -> Background {
        Background { horizon, zenith, glow: Glow::NONE }
    }
}

/// Everything that the ray tracer shows at one instant.
#[derive(Clone, Debug)]
pub struct World {
    /// The bodies. A body's index is its identity within a frame.
    pub objects: Vec<Object>,
    /// The lights, at most [`World::MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// Light that reaches every point from everywhere.
    pub ambient: Vec3A,
    /// What lies behind the bodies.
    pub background: Background,
    /// Number of rays in the longest path: 1 for eye rays alone, 2 with one reflection or refraction, and so on.
    pub max_level: u32,
}

impl World {
    /// The number of lights whose state the path signature of a sample can tell apart.
    pub const MAX_LIGHTS: usize = 8;

    /// Nothing under a black sky, for paths of up to five rays.
    pub const EMPTY: World = World {
        objects: Vec::new(),
        lights: Vec::new(),
        ambient: Vec3A::ZERO,
        background: Background::even(Vec3A::ZERO),
        max_level: 5,
    };

    /// Bodies under a black sky, without lights, for paths of up to five rays.
    pub fn new(objects: Vec<Object>) -> World {
        World { objects, ..World::EMPTY }
    }
}

impl Default for World {
    /// [`World::EMPTY`].
    fn default() -> World {
        World::EMPTY
    }
}
