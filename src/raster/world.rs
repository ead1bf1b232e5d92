//! The content of a raster layer: bodies, lights, and the air between.

use super::cloud_shadow::CloudShadow;
use super::haze::Haze;
use super::light::Light;
use super::mesh::Mesh;
use super::snow_cover::SnowCover;
use crate::texture::Texture;
use glam::{Affine3A, Vec3A};
use std::sync::Arc;

/// A mesh in the world.
#[derive(Clone)]
pub struct Body {
    /// Its surface.
    pub(super) mesh: Arc<Mesh>,
    /// From its own space to the world.
    pub(super) place: Affine3A,
    /// Centre and radius of a bounding sphere in the world, metres.
    pub(super) bound: (Vec3A, f32),
}

impl Body {
    /// A mesh at `place`, which may turn and move it, and scale it by the same factor along all axes.
    pub fn new(mesh: Arc<Mesh>, place: Affine3A) -> Body {
        let mut body = Body { mesh, place, bound: (Vec3A::ZERO, 0.0) };
        body.put(place);
        body
    }

    /// Moves it to another place.
    pub fn put(&mut self, place: Affine3A) {
        let (center, radius) = self.mesh.bound();
        let scale = place.matrix3.x_axis.length();
        (self.bound, self.place) = ((place.transform_point3a(center), radius * scale), place);
    }
}

/// Bodies are equal if they are the same mesh in the same place.
impl PartialEq for Body {
    fn eq(&self, other: &Body) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh) && self.place == other.place
    }
}

/// All that a raster layer draws.
#[derive(Clone)]
pub struct World {
    /// The surfaces. Those after the first 16,384 are left out.
    pub bodies: Vec<Body>,
    /// The textures that paints refer to: at most 15.
    pub textures: Vec<Texture>,
    /// The lights.
    pub lights: Vec<Light>,
    /// Shadows of clouds, which dim suns.
    pub cloud_shadow: Option<CloudShadow>,
    /// Snow that lies on surfaces.
    pub snow: Option<SnowCover>,
    /// Light from all around, linear: that on a vertical surface, and what is added to it for one that faces the zenith
    /// and subtracted for one that faces the ground.
    pub ambient: [Vec3A; 2],
    /// The air between the eye and surfaces, and the sky at the horizon that glossy surfaces mirror.
    pub haze: Haze,
    /// Light of the sky at the zenith, for glossy surfaces.
    pub zenith: Vec3A,
    /// Whether light is compressed by `1 - exp(-light)`, as on film. Haze and zenith are taken to be compressed already.
    /// Always so in the 64 kB build.
    pub film: bool,
    /// Light behind everything, linear; `None` leaves open pixels to later layers, as the 64 kB build always does.
    pub background: Option<Vec3A>,
}

impl World {
    /// Bodies in the dark: without lights, ambient light, haze or background, and without film.
    #[inline(always)] // So that fields which a caller sets at once are not made and dropped before.
    pub fn new(bodies: Vec<Body>) -> World {
        World {
            bodies,
            textures: Vec::new(),
            lights: Vec::new(),
            cloud_shadow: None,
            snow: None,
            ambient: [Vec3A::ZERO; 2],
            haze: Haze::default(),
            zenith: Vec3A::ZERO,
            film: false,
            background: None,
        }
    }
}

/// Nothing in the dark.
impl Default for World {
    fn default() -> World {
        World::new(Vec::new())
    }
}
