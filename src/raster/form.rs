//! Surfaces from small tables: grids, and bodies of rings. A box is one of these.

use super::mesh::{Face, Mesh, Paint};
use crate::noise;
use glam::{Mat3, Vec3, vec3};
use std::f32::consts::{PI, TAU};

/// A body of rings, one a row, and the outline that they share.
///
/// In local coordinates the rings lie across y. At angle `t`, x is
/// `thickness sin t (1 + swell cos^2 t) (1 - taper cos t)`, and z is `middle + reach cos t (1 + swell sin^2 t)`.
/// A row without size is a pole; two equal rows are a crease, since they share no point.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Along, middle, reach, thickness, and what the strip to the next row is painted with: in the upper digit
    /// (hexadecimal) the first two columns, next to the greatest z, in the lower one the rest.
    pub rows: &'static [[i8; 5]],
    /// Strips around.
    pub sides: u8,
    /// Only where x is positive; open where it is 0.
    pub half: bool,
    /// From an ellipse, 0, to [`SQUARE`].
    pub swell: f32,
    /// 0 for a symmetric outline; near 1 it is sharp at the greatest z, as wings are.
    pub taper: f32,
}

/// The swell at which four sides are a rectangle with its full reach and thickness.
pub const SQUARE: f32 = 0.828_427_1;

/// From -1 to 1 along each axis. Its ends are rows that have shrunk to one side of the ring.
const CUBE: Body = Body {
    rows: &[[-1, 1, 0, 1, 0], [-1, 0, 1, 1, 0], [1, 0, 1, 1, 0], [1, 1, 0, 1, 0]],
    sides: 4,
    half: false,
    swell: SQUARE,
    taper: 0.0,
};

impl Mesh {
    /// No surface yet.
    #[inline(never)]
    pub fn painted(paints: &[Paint]) -> Mesh {
        Mesh { paints: paints.to_vec(), ..Mesh::default() }
    }

    /// Joins the points from `first` on, rows of `columns`: outside is where rows follow counter-clockwise columns
    /// upwards. Triangles with two corners in one place are left out, so a row may shrink to fewer points, or to one.
    ///
    /// To `paint` is added what a body's rows say, if there are any.
    #[inline(never)]
    pub fn loft(&mut self, first: usize, columns: usize, paint: u16, rows: &[[i8; 5]]) {
        for i in first..self.points.len() - columns {
            let (row, column) = ((i - first) / columns, (i - first) % columns);
            let both = rows.get(row).map_or(0, |row| row[4] as u8 as u16);
            let paint = paint + if column < 2 { both >> 4 } else { both & 15 };
            if column + 1 < columns {
                self.face(i, i + 1, i + columns + 1, paint);
                self.face(i, i + columns + 1, i + columns, paint);
            }
        }
    }

    /// A triangle, if it is one.
    #[inline(never)]
    fn face(&mut self, a: usize, b: usize, c: usize, paint: u16) {
        let at = |i: usize| self.points[i];
        if at(a) != at(b) && at(b) != at(c) && at(c) != at(a) {
            self.faces.push(Face { corners: [a as u16, b as u16, c as u16], paint });
        }
    }

    /// A body, its local coordinates multiplied by `turn`, which may scale and shear, and moved to `at`.
    #[inline(never)]
    pub fn body(&mut self, body: &Body, turn: &Mat3, at: Vec3, paint: u16) {
        let first = self.points.len();
        let sides = body.sides as u32;
        // A rectangle has corners, not the middles of its sides, on the diagonals.
        let offset = if body.swell == SQUARE { 0.5 } else { 0.0 };
        for row in body.rows {
            for k in 0..=sides {
                let part = if body.half { k } else { k % sides };
                let angle = (part as f32 + offset) / sides as f32 * if body.half { PI } else { TAU };
                let (sin, cos) = angle.sin_cos();
                // Rounded to a millionth, so that half a turn ends at 0, and a rectangle at 1.
                let round = |x: f32| (x + 8.0) - 8.0;
                let x = round(sin * (1.0 + body.swell * cos * cos) * (1.0 - body.taper * cos));
                let z = round(cos * (1.0 + body.swell * sin * sin));
                let p = vec3(row[3] as f32 * x, row[0] as f32, row[1] as f32 + row[2] as f32 * z);
                self.points.push(at + *turn * p);
            }
        }
        self.loft(first, sides as usize + 1, paint, body.rows);
    }

    /// A box of 12 triangles: `half` has its half axes, a right-handed system, as columns.
    pub fn block(&mut self, half: &Mat3, at: Vec3, paint: u16) {
        self.body(&CUBE, half, at, paint);
    }

    /// Adds the mirror image at the plane x = 0, before there are normals.
    #[inline(never)]
    pub fn mirror(&mut self) {
        let (points, faces) = (self.points.len(), self.faces.len());
        for i in 0..points {
            let Vec3 { x, y, z } = self.points[i];
            self.points.push(vec3(0.0 - x, y, z));
        }
        for i in 0..faces {
            let Face { corners, paint } = self.faces[i];
            let [a, b, c] = corners.map(|i| i as usize + points);
            self.face(a, c, b, paint);
        }
    }

    /// Moves the points from `first` on by up to `amount` metres each way, by noise of `scale` cells a metre: equal points alike, so
    /// nothing tears.
    #[inline(never)]
    pub fn weather(&mut self, first: usize, amount: f32, scale: f32) {
        for p in &mut self.points[first..] {
            let q = *p * scale;
            let by = |away: f32| 2.0 * noise::octaves(q + away, 1, false);
            *p += amount * vec3(by(0.0), by(17.3), by(31.7));
        }
    }

    /// Normals of a smooth surface: of the faces around each point, by the sines of their angles there.
    ///
    /// Weighed by area, the faces of long strips would lean to the side that their diagonals take. A point on the
    /// plane x = 0 is taken to have a mirror image on the other side.
    #[inline(never)]
    pub fn smooth(&mut self) {
        self.normals = vec![Vec3::ZERO; self.points.len()];
        for i in 0..3 * self.faces.len() {
            let corner = |k: usize| self.faces[i / 3].corners[(i + k) % 3] as usize;
            let side = |k: usize| self.points[corner(k)] - self.points[corner(0)];
            let (u, v) = (side(1), side(2));
            let n = u.cross(v) / (u.length_squared() * v.length_squared()).sqrt();
            self.normals[corner(0)] += n;
        }
        for (n, p) in self.normals.iter_mut().zip(&self.points) {
            if p.x == 0.0 {
                n.x = 0.0;
            }
            // Points that no face has get one too.
            *n = (*n + Vec3::Y * 1e-9).normalize();
        }
    }
}
