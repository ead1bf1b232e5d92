//! Shadow maps of any projection, and lookups of one point at a time in f64: the renderer's method without its lanes.

use super::set::Set;
use super::truth::Pixel;
use fearless_simd::{Level, dispatch};
use glam::{Affine3A, DMat4, DVec3, Vec3A};
use paprsek::frame::Tile;
use paprsek::raster::depth_map::EMPTY;
use paprsek::raster::fill::fill;
use paprsek::raster::setup::{SetupMesh, TriangleSetup};
use paprsek::raster::visible::{CENTER, Visible};
use paprsek::raster::{Bias, Projection};

/// A shadow map.
pub struct Map {
    matrix: DMat4,
    size: usize,
    texels: Vec<f32>,
}

impl Map {
    /// An empty map, which [`Map::draw`] fills.
    pub fn new(projection: Projection) -> Map {
        let size = projection.size[0] as usize;
        Map { matrix: projection.matrix().as_dmat4(), size, texels: vec![0.0; size * size] }
    }

    /// Draws a set into the map on this thread.
    pub fn draw(&mut self, set: &Set, projection: Projection) {
        let setup = TriangleSetup { projection, back_faces: false, shaded: false };
        let pieces: Vec<SetupMesh> = set.meshes.iter().map(|mesh| setup.set_up(mesh, &Affine3A::IDENTITY)).collect();
        let (size, edge, level) = (self.size, Tile::SIZE, Level::new());
        let mut planes = [(Visible::default(), CENTER)];
        for (y, x) in (0..size / edge).flat_map(|y| (0..size / edge).map(move |x| (y, x))) {
            planes[0].0.clear(&[EMPTY; Tile::AREA]);
            dispatch!(level, simd => fill(simd, &mut pieces.iter(), [x, y], &mut planes));
            for (row, from) in planes[0].0.inv_depth.chunks(edge).enumerate() {
                self.texels[(y * edge + row) * size + x * edge..][..edge].copy_from_slice(from);
            }
        }
    }

    /// The share of the sun that reaches a pixel, or none if the pixel lies outside of the map.
    fn light(&self, pixel: &Pixel, towards: DVec3, bias: &Bias, smooth: bool) -> Option<f64> {
        let rows = self.matrix.transpose();
        let (size, p) = (self.size as f64, pixel.point.as_dvec3());
        let at = |p: DVec3| {
            let h = self.matrix * p.extend(1.0);
            (h.x / h.w, h.y / h.w, h.z / h.w, h.w)
        };
        let (x, y, near, w) = at(p);
        if w <= 0.0 {
            return None;
        }
        // The longer side of a texel here in metres, and the inverse depth of one metre towards the sun.
        let step = |row: glam::DVec4, value: f64| ((row - rows.w_axis * value).truncate() / w).length();
        let texel = (1.0 / step(rows.x_axis, x)).max(1.0 / step(rows.y_axis, y));
        let rise = (rows.z_axis - rows.w_axis * near).truncate().dot(towards) / w;
        let cosine = pixel.cosine as f64;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let tangent = (sine / cosine.max(1e-3)).min(4.0);
        let (x, y, near, _) = at(p + pixel.normal.as_dvec3() * (sine * bias.normal as f64 * texel));
        let near = near + (tangent * bias.slope as f64 * texel + bias.constant as f64) * rise;
        if x.min(y) < 2.0 || x.max(y) > size - 2.0 {
            return None;
        }
        let shift = if smooth { 1.5 } else { 1.0 };
        let (x, y) = (x - shift, y - shift);
        let (column, row) = (x.floor(), y.floor());
        let weights = |f: f64| if smooth { [1.0 - f, 1.0, 1.0, f] } else { [1.0, 1.0, 1.0, 0.0] };
        let (across, down) = (weights(x - column), weights(y - row));
        let mut sum = 0.0;
        for (j, down) in down.into_iter().enumerate().filter(|(_, weight)| *weight > 0.0) {
            for (i, across) in across.into_iter().enumerate().filter(|(_, weight)| *weight > 0.0) {
                let (column, row) = ((column as usize + i).min(self.size - 1), (row as usize + j).min(self.size - 1));
                sum += if self.texels[row * self.size + column] as f64 <= near { across * down } else { 0.0 };
            }
        }
        Some(sum / 9.0)
    }
}

/// The share of the sun that reaches a pixel, by the first map that contains it.
pub fn light(maps: &[Map], pixel: &Pixel, towards: Vec3A, bias: &Bias, smooth: bool) -> f32 {
    maps.iter().find_map(|map| map.light(pixel, towards.as_dvec3(), bias, smooth)).unwrap_or(1.0) as f32
}
