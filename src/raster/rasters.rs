//! The bodies of a world on the rasters of the camera and of the views of lights.

use super::bins::Bins;
use super::fill::fill_depths;
use super::id::Id;
use super::project::Projection;
use super::triangle::{SetupMesh, TriangleSetup};
use super::world::Body;
use crate::frame::{Tile, Workers};
use crate::simd::math::to_f32;
use fearless_simd::Simd;
use std::slice;
use std::sync::OnceLock;

/// Bodies on the raster of the camera.
#[derive(Default)]
pub struct Raster {
    /// The triangles of each body.
    pub meshes: Vec<SetupMesh>,
    /// The triangles by tile.
    pub bins: Bins,
}

impl Raster {
    /// Sets up every body that the camera may see, and sorts its triangles into tiles.
    #[inline(always)]
    pub fn new(workers: &Workers, projection: &Projection, bodies: &[Body]) -> Raster {
        let setup = TriangleSetup { projection: *projection, back_faces: false, shaded: true };
        let mut meshes: Vec<_> = bodies.iter().map(|_| SetupMesh::default()).collect();
        let seen = meshes.iter_mut().zip(bodies).filter(|(_, body)| !projection.misses(body.bound.0, body.bound.1));
        workers.each(seen, |(mesh, body)| *mesh = setup.set_up(&body.mesh, &body.place));
        let bins = Bins::new(&meshes, projection.size);
        Raster { meshes, bins }
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
    binned: OnceLock<BinnedMesh>,
}

/// A body that has been set up, and its triangles by tile.
struct BinnedMesh(SetupMesh, Bins);

impl LightView {
    /// A view of those bodies that may show in it.
    pub fn new(projection: &Projection, back_faces: bool, bodies: &[Body]) -> LightView {
        let setup = TriangleSetup { projection: *projection, back_faces, shaded: false };
        let mut casters = Vec::new();
        for body in bodies {
            let (center, radius) = body.bound;
            if !projection.misses(center, radius) {
                let bound = projection.tiles(center, radius);
                casters.push(Caster { body: body.clone(), bound, binned: OnceLock::new() });
            }
        }
        LightView { setup, casters }
    }

    /// The meshes that a tile may show, each with the triangles that do. Sets up those that no tile has needed before.
    #[inline(always)]
    pub fn at(&self, column: usize, row: usize) -> impl Iterator<Item = (&SetupMesh, &[Id])> {
        let [x, y] = [column, row].map(to_f32);
        self.casters.iter().filter_map(move |caster| {
            let [x0, x1, y0, y1] = caster.bound;
            // Written so that a NaN counts as everywhere.
            if x < x0 || x > x1 || y < y0 || y > y1 {
                return None;
            }
            let BinnedMesh(mesh, bins) = caster.binned.get_or_init(|| self.set_up(&caster.body));
            Some((mesh, bins.of(column, row)))
        })
    }

    #[inline(never)] // Not compiled anew for each SIMD level.
    fn set_up(&self, body: &Body) -> BinnedMesh {
        let mesh = self.setup.set_up(&body.mesh, &body.place);
        let bins = Bins::new(slice::from_ref(&mesh), self.setup.projection.size);
        BinnedMesh(mesh, bins)
    }

    /// Draws the nearest depths of a tile over what is there.
    #[inline(always)]
    pub fn draw<S: Simd>(&self, simd: S, column: usize, row: usize, depths: &mut [f32; Tile::AREA]) {
        let corner = [column, row].map(|n| (n * Tile::SIZE) as i32);
        for (mesh, ids) in self.at(column, row) {
            fill_depths(simd, mesh, ids, corner, depths);
        }
    }
}
