//! The bodies of a world on the rasters of the camera and of the views of lights.

use super::fill::fill_depths;
use super::id::MESHES;
use super::project::Projection;
use super::setup::{SetupMesh, TriangleSetup};
use super::world::Body;
use crate::frame::{Tile, Workers};
use crate::simd::math::to_f32;
use fearless_simd::Simd;
use std::sync::OnceLock;

/// Bodies on the raster of the camera.
#[derive(Default)]
pub struct Raster {
    /// The triangles of each body.
    pub meshes: Vec<SetupMesh>,
}

impl Raster {
    /// Sets up every body that the camera may see. Bodies after the first 16,384 are left out.
    #[inline(always)]
    pub fn new(workers: &Workers, projection: &Projection, bodies: &[Body]) -> Raster {
        let setup = TriangleSetup { projection: *projection, back_faces: false, shaded: true };
        let mut meshes: Vec<_> = bodies.iter().take(MESHES).map(|_| SetupMesh::default()).collect();
        let seen = meshes.iter_mut().zip(bodies).filter(|(_, body)| !projection.misses(body.bound.0, body.bound.1));
        workers.each(seen, |(mesh, body)| *mesh = setup.set_up(&body.mesh, &body.place));
        Raster { meshes }
    }
}

/// What casts shadows in a view of a light. Nothing is set up before a tile needs it: much of a map is never looked up,
/// and what has been set up once serves all later tiles, also those of later frames.
pub struct LightView {
    setup: TriangleSetup,
    casters: Vec<Caster>,
}

/// A body that may show in the view.
struct Caster {
    body: Body,
    /// First and last column, first and last row of tiles that it may touch.
    bound: [f32; 4],
    mesh: OnceLock<SetupMesh>,
}

impl LightView {
    /// A view of those bodies that may show in it.
    pub fn new(projection: &Projection, back_faces: bool, bodies: &[Body]) -> LightView {
        let setup = TriangleSetup { projection: *projection, back_faces, shaded: false };
        let mut casters = Vec::new();
        for body in bodies {
            let (center, radius) = body.bound;
            if !projection.misses(center, radius) {
                let bound = projection.tiles(center, radius);
                casters.push(Caster { body: body.clone(), bound, mesh: OnceLock::new() });
            }
        }
        LightView { setup, casters }
    }

    /// The meshes that the tile of a column and a row of tiles may show. Sets up those that no tile has needed before.
    #[inline(always)]
    pub fn at(&self, tile: [usize; 2]) -> impl Iterator<Item = &SetupMesh> {
        let [x, y] = tile.map(to_f32);
        self.casters.iter().filter_map(move |caster| {
            let [x0, x1, y0, y1] = caster.bound;
            // Written so that a NaN counts as everywhere.
            if x < x0 || x > x1 || y < y0 || y > y1 {
                return None;
            }
            Some(caster.mesh.get_or_init(|| self.setup.set_up(&caster.body.mesh, &caster.body.place)))
        })
    }

    /// Draws the nearest depths of a tile over what is there.
    #[inline(always)]
    pub fn draw<S: Simd>(&self, simd: S, tile: [usize; 2], depths: &mut [f32; Tile::AREA]) {
        for mesh in self.at(tile) {
            fill_depths(simd, mesh, tile, depths);
        }
    }
}
