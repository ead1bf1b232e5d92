//! The bodies of a world on the rasters of the camera and of the views of lights.

use super::fill::fill;
use super::id::MESHES;
use super::project::Projection;
use super::setup::{SetupMesh, TriangleSetup};
use super::visible::{CENTER, Visible};
use super::world::Body;
use crate::frame::{Tile, Workers};
use crate::simd::math::to_f32;
use fearless_simd::Simd;
use std::sync::OnceLock;

/// Those bodies that may show on a raster, by their numbers, nearest first: with how near their balls come.
fn seen(projection: &Projection, bodies: &[Body]) -> Vec<(usize, f32)> {
    let mut seen: Vec<(usize, f32)> = Vec::new();
    for (number, body) in bodies.iter().enumerate() {
        let (center, radius) = body.bound;
        if !projection.misses(center, radius) {
            let nearness = projection.nearness(center) + radius;
            let mut at = seen.len();
            seen.push((number, nearness));
            while at > 0 && seen[at - 1].1 < nearness {
                seen.swap(at - 1, at);
                at -= 1;
            }
        }
    }
    seen
}

/// Bodies on the raster of the camera.
#[derive(Default)]
pub struct Raster {
    /// The bodies that may be seen, by their numbers in the world, nearest first.
    pub bodies: Vec<(usize, f32)>,
    /// The triangles of each of them.
    pub meshes: Vec<SetupMesh>,
}

impl Raster {
    /// Sets up every body that the camera may see. Those after the nearest 16,384 are left out.
    #[inline(always)]
    pub fn new(workers: &Workers, projection: &Projection, bodies: &[Body]) -> Raster {
        let setup = TriangleSetup { projection: *projection, back_faces: false, shaded: true };
        let seen = seen(projection, bodies);
        let mut meshes: Vec<_> = seen.iter().take(MESHES).map(|_| SetupMesh::default()).collect();
        workers.each(meshes.iter_mut().zip(&seen), |(mesh, (number, _))| {
            let body = &bodies[*number];
            *mesh = setup.set_up(&body.mesh, &body.place);
        });
        Raster { bodies: seen, meshes }
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
        for (number, _) in seen(projection, bodies) {
            let body = &bodies[number];
            let bound = projection.tiles(body.bound.0, body.bound.1);
            casters.push(Caster { body: body.clone(), bound, mesh: OnceLock::new() });
        }
        LightView { setup, casters }
    }

    /// The meshes that the tile of a column and a row of tiles may show, nearest first. Sets up those that no tile has needed before.
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
    pub fn draw<S: Simd>(
        &self,
        simd: S,
        tile: [usize; 2],
        inv_depth: Box<[f32; Tile::AREA]>,
    ) -> Box<[f32; Tile::AREA]> {
        let mut planes = [(Visible { inv_depth, id: Vec::new() }, CENTER)];
        fill(simd, &mut self.at(tile), tile, &mut planes);
        let [(Visible { inv_depth, .. }, _)] = planes;
        inv_depth
    }
}
