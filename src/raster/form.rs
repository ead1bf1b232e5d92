//! Meshes from small tables: grids of points, and closed forms of rings stacked along an axis. A box is one of these.
//!
//! Everything is built by lofting: consecutive rows of points are joined by strips of triangles. Rings are
//! tables of bytes, which take little room in the 64 kB build.

use super::mesh::{Face, Mesh, Paint};
use crate::angle;
use crate::noise;
use crate::vector::{cross, unit};
use glam::{Mat3A, Vec3A, vec3a};
use std::f32::consts::{PI, TAU};

/// A stack of rings of one outline, one ring per row.
///
/// In local coordinates the rings lie across y. At angle `t`, x is
/// `thickness sin t (1 + swell cos^2 t) (1 - taper cos t)` and z is `middle + reach cos t (1 + swell sin^2 t)`.
/// A row of size 0 is a pole. Two equal rows are a crease, since they share no points.
#[derive(Clone, Copy, Debug)]
pub struct Rings {
    /// For each ring its y, middle, reach and thickness, and the paints of the strip to the next ring: the upper
    /// hexadecimal digit for the first two columns, next to the greatest z, the lower digit for the others.
    pub rows: &'static [[i8; 5]],
    /// Number of strips around the axis.
    pub sides: u8,
    /// Whether only the half where x is positive is built; it is open at x = 0.
    pub half: bool,
    /// Shape of the outline, from 0 for an ellipse to [`SQUARE`].
    pub swell: f32,
    /// Asymmetry of the outline: 0 for none; near 1 it is sharp at the greatest z, as wings are.
    pub taper: f32,
}

/// The swell at which four sides form a rectangle of full reach and thickness.
pub const SQUARE: f32 = 0.828_427_1;

/// The cube from -1 to 1 along each axis. Its ends are rows that have shrunk to one side of the ring.
const CUBE: Rings = Rings {
    rows: &[[-1, 1, 0, 1, 0], [-1, 0, 1, 1, 0], [1, 0, 1, 1, 0], [1, 1, 0, 1, 0]],
    sides: 4,
    half: false,
    swell: SQUARE,
    taper: 0.0,
};

// Building a mesh is never hot: out of line, each of these functions is in the 64 kB build once.
impl Mesh {
    /// A mesh with paints and no surface yet.
    #[inline(never)]
    pub fn painted(paints: &[Paint]) -> Mesh {
        Mesh { paints: paints.to_vec(), ..Mesh::default() }
    }

    /// Joins the points from `first` on, which are rows of `columns` points, by two triangles per cell. The outside is
    /// where rows follow each other upwards and columns counter-clockwise. Triangles with two corners in one place are
    /// left out, so a row may shrink to fewer points, or to one.
    ///
    /// Faces get paint number `paint` plus the digit of their row in `rows` (see [`Rings::rows`]), which may be empty.
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

    /// Adds a triangle, unless two of its corners coincide.
    #[inline(never)]
    fn face(&mut self, a: usize, b: usize, c: usize, paint: u16) {
        let at = |i: usize| self.points[i];
        if at(a) != at(b) && at(b) != at(c) && at(c) != at(a) {
            self.faces.push(Face { corners: [a as u16, b as u16, c as u16], paint });
        }
    }

    /// Adds a stack of rings, its local coordinates multiplied by `turn`, which may scale and shear, and moved to `at`.
    /// `paint` is the number that its rows' digits are added to.
    #[inline(never)]
    pub fn rings(&mut self, rings: &Rings, turn: &Mat3A, at: Vec3A, paint: u16) {
        let first = self.points.len();
        let sides = rings.sides as u32;
        // A rectangle has its corners on the diagonals, not the middles of its sides.
        let offset = if rings.swell == SQUARE { 0.5 } else { 0.0 };
        for row in rings.rows {
            for k in 0..sides + 1 {
                let part = if rings.half { k } else { k % sides };
                let angle = (part as f32 + offset) / sides as f32 * if rings.half { PI } else { TAU };
                let (sin, cos) = angle::sin_cos(angle);
                // Rounded to a millionth, so that half a turn ends at exactly 0, and a rectangle at exactly 1.
                let round = |x: f32| (x + 8.0) - 8.0;
                let x = round(sin * (1.0 + rings.swell * cos * cos) * (1.0 - rings.taper * cos));
                let z = round(cos * (1.0 + rings.swell * sin * sin));
                let p = vec3a(row[3] as f32 * x, row[0] as f32, row[1] as f32 + row[2] as f32 * z);
                self.points.push(at + *turn * p);
            }
        }
        self.loft(first, sides as usize + 1, paint, rings.rows);
    }

    /// Adds a box of 12 triangles around `at`. The columns of `half` are its half axes, a right-handed system.
    pub fn block(&mut self, half: &Mat3A, at: Vec3A, paint: u16) {
        self.rings(&CUBE, half, at, paint);
    }

    /// Adds the mirror image in the plane x = 0. To be called before the mesh has normals.
    #[inline(never)]
    pub fn mirror(&mut self) {
        let (points, faces) = (self.points.len(), self.faces.len());
        for i in 0..points {
            let [x, y, z] = self.points[i].to_array();
            self.points.push(vec3a(0.0 - x, y, z));
        }
        for i in 0..faces {
            let Face { corners, paint } = self.faces[i];
            let [a, b, c] = corners.map(|i| i as usize + points);
            self.face(a, c, b, paint);
        }
    }

    /// Displaces the points from `first` on by up to `amount` metres along each axis, by noise of `scale` cells per
    /// metre. Equal points move alike, so nothing tears.
    #[inline(never)]
    pub fn weather(&mut self, first: usize, amount: f32, scale: f32) {
        for p in &mut self.points[first..] {
            let q = *p * scale;
            let by = |away: f32| 2.0 * noise::octaves(q + away, 1, false);
            *p += amount * vec3a(by(0.0), by(17.3), by(31.7));
        }
    }

    /// Makes the surface smooth: the normal at a point is the sum of the unit normals of its faces, each weighted by the
    /// sine of the face's angle there.
    ///
    /// Weighted by area, the faces of long strips would lean to the side that their diagonals take. A point on the plane
    /// x = 0 is taken to have a mirror image on the other side.
    #[inline(never)]
    pub fn smooth(&mut self) {
        self.normals = vec![Vec3A::ZERO; self.points.len()];
        for i in 0..3 * self.faces.len() {
            let corner = |k: usize| self.faces[i / 3].corners[(i + k) % 3] as usize;
            let side = |k: usize| self.points[corner(k)] - self.points[corner(0)];
            let (u, v) = (side(1), side(2));
            let n = cross(u, v) / (u.length_squared() * v.length_squared()).sqrt();
            self.normals[corner(0)] += n;
        }
        for (n, p) in self.normals.iter_mut().zip(&self.points) {
            if p.x == 0.0 {
                n.x = 0.0;
            }
            // A point without a face gets a normal too.
            *n = unit(*n + Vec3A::Y * 1e-9);
        }
    }
}
