//! What the algorithms do, made visible: a number per pixel of a tile. Layers answer for what they know.

use super::tile::Tile;
use crate::simd::block::BLOCK;
use crate::texture::{self, Texture};

/// What a layer can be asked about the pixels of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// Samples: eye rays traced in the pixel, or fragments shaded. What has none is interpolated.
    Samples,
    /// Edge of the square of the corner grid that the pixel lies in, pixels; 1/2 where samples lie within the pixel. The
    /// squares lie on multiples of their edges.
    Squares,
    /// Rays in the longest path that begins with the eye ray, without thresholds; of each 2x2 pixels, one.
    RayDepth,
    /// Bodies that eye rays through the tile may meet.
    Candidates,
    /// Triangles that cover the middle of the pixel, hidden ones too.
    Overdraw,
    /// Triangles that are listed for the tile.
    Triangles,
    /// Octaves of noise that are evaluated for the pixel's textures, of all its samples and all surfaces on their paths.
    /// Tracer: without the hits beyond those that a sample remembers.
    Octaves,
    /// Which map the shadow of the first light that has maps is looked up in: the cascade or the face of the cube, from
    /// 1; 0 for none.
    ShadowView,
    /// The maps of the first light that has them, side by side over the whole picture: 0 for the farthest depth of a map,
    /// 1 for the nearest.
    ShadowMap,
    /// Clouds that eye rays through the tile may meet.
    Clouds,
    /// Steps that a ray through the middle of the pixel takes in clouds, as far as the end of each, without imposters.
    CloudSteps,
    /// Imposters in which the ray through the middle of the pixel meets a cloud.
    Imposters,
    /// Frames since these imposters were drawn, each weighted by what it hides; NaN where there are none.
    ImposterAge,
    /// Sprites of particles that are listed for the tile.
    Particles,
    /// Sprites of particles over the middle of the pixel.
    Sprites,
}

impl Aspect {
    /// All of them: name, and what the number is.
    pub const ALL: [(Aspect, &'static str, &'static str); 15] = [
        (Aspect::Samples, "samples", "eye rays or fragments per pixel"),
        (Aspect::Squares, "squares", "edge of the square, pixels"),
        (Aspect::RayDepth, "ray depth", "rays in the longest path"),
        (Aspect::Candidates, "candidates", "bodies that a tile's rays may meet"),
        (Aspect::Overdraw, "overdraw", "triangles over the pixel"),
        (Aspect::Triangles, "triangles", "triangles of the tile"),
        (Aspect::Octaves, "octaves", "octaves of noise per pixel"),
        (Aspect::ShadowView, "shadow view", "cascade or face of the cube"),
        (Aspect::ShadowMap, "shadow maps", "depth from far to near"),
        (Aspect::Clouds, "clouds", "clouds that a tile's rays may meet"),
        (Aspect::CloudSteps, "cloud steps", "steps of the ray in clouds"),
        (Aspect::Imposters, "imposters", "imposters over the pixel"),
        (Aspect::ImposterAge, "imposter age", "frames since they were drawn"),
        (Aspect::Particles, "particles", "sprites of the tile"),
        (Aspect::Sprites, "sprites", "sprites over the pixel"),
    ];
}

/// A number for each pixel in use of a tile, in rows of [`Tile::SIZE`]: what `number` gives for the pixel at that column
/// and row of the picture.
pub fn each(tile: &Tile, mut number: impl FnMut(usize, usize) -> f32) -> Vec<f32> {
    let mut numbers = vec![0.0; Tile::AREA];
    for y in 0..tile.height {
        for x in 0..tile.width {
            numbers[y * Tile::SIZE + x] = number(tile.x + x, tile.y + y);
        }
    }
    numbers
}

/// Counts the octaves of noise that a texture evaluates for a block's pixels, given by their index in the tile.
#[cold]
#[inline(never)]
pub(crate) fn count_octaves(
    tile: &mut Tile,
    texture: &Texture,
    footprint: Option<&[f32; BLOCK]>,
    pixels: &mut dyn Iterator<Item = usize>,
) {
    let octaves = texture::octaves(texture, footprint) as f32;
    for pixel in pixels {
        tile.octaves[pixel] += octaves;
    }
}
