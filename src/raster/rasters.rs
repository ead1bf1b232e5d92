//! Bodies in the raster of one view: set up, binned and, for a light, drawn into its depth map.

use super::bins::Bins;
use super::depth_map::{DepthMap, EMPTY};
use super::fill::{CENTER, Visible, fill};
use super::project::Projection;
use super::triangle::{SetupMesh, TriangleSetup};
use super::world::Body;
use crate::frame::{Tile, Workers};
use fearless_simd::dispatch;

/// The bodies of a world in one raster.
pub struct Raster {
    /// The projection, and which faces are drawn.
    pub setup: TriangleSetup,
    /// Index of the first body that is drawn.
    pub first: usize,
    /// The triangles of each body.
    pub meshes: Vec<SetupMesh>,
    /// The triangles by tile.
    pub bins: Bins,
}

/// Adds a raster of a projection for `bodies` bodies, of which those before `first` are left out. `shaded` triangles have
/// what shading needs, others only their depth. The raster is empty until [`set_up`].
pub fn add(
    rasters: &mut Vec<Raster>,
    projection: &Projection,
    [back_faces, shaded]: [bool; 2],
    first: usize,
    bodies: usize,
) {
    let setup = TriangleSetup { projection: *projection, back_faces, shaded };
    let meshes = (0..bodies).map(|_| SetupMesh::default()).collect();
    rasters.push(Raster { setup, first, meshes, bins: Bins::default() });
}

/// Sets up every body in every raster that may show it, and sorts its triangles into tiles.
#[inline(always)]
pub fn set_up(workers: &Workers, rasters: &mut [Raster], bodies: &[Body]) {
    let mut tasks = Vec::new();
    for Raster { setup, first, meshes, .. } in rasters.iter_mut() {
        for (mesh, body) in meshes.iter_mut().zip(bodies).skip(*first) {
            if !setup.projection.misses(body.bound.0, body.bound.1) {
                tasks.push((&*setup, mesh, body));
            }
        }
    }
    workers.each(tasks.iter_mut(), |(setup, mesh, body)| **mesh = setup.set_up(&body.mesh, &body.place));
    workers.each(rasters.iter_mut(), |raster| {
        raster.bins = Bins::new(&raster.meshes, raster.setup.projection.size);
    });
}

/// Draws the depths of triangles into a map, one view of which is the size of one raster. Threads take a row of tiles at a
/// time.
pub fn draw_map(workers: &Workers, map: &mut DepthMap, rasters: &[Raster]) {
    let (size, level) = (map.size, workers.level());
    workers.each(map.bands().enumerate(), |(index, texels)| {
        // In 32 bits, as a division of 64 takes several times the code.
        let (index, bands) = (index as u32, (size / Tile::SIZE) as u32);
        let (Raster { meshes, bins, .. }, band) = (&rasters[(index / bands) as usize], (index % bands) as usize);
        let mut visible = Visible::default();
        for x in (0..size).step_by(Tile::SIZE) {
            let ids = bins.of(x / Tile::SIZE, band);
            visible.clear(EMPTY);
            let y = (band * Tile::SIZE) as i32;
            dispatch!(level, simd => fill(simd, meshes, ids, x as i32, y, CENTER, &mut visible));
            for (from, to) in visible.inv_depth.chunks(Tile::SIZE).zip(texels.chunks_mut(size)) {
                to[x..][..Tile::SIZE].copy_from_slice(from);
            }
        }
    });
}
