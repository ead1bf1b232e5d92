//! Surfaces from small tables: grids, bodies of rings, boxes, arches.

use super::mesh::{Face, Mesh, Paint};
use glam::{Mat3, Vec3, vec3};
use std::f32::consts::{PI, TAU};

/// A body of rings, one a row, and the outline that they share.
///
/// In local coordinates the rings lie across y, and point `k` of `n` at angle `t` is
/// `(thickness sin t (1 + swell cos^2 t) (1 - taper cos t), along, middle + reach cos t (1 + swell sin^2 t))`.
/// A row of no size is a pole; two equal rows are a crease, since they share no point.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Along, middle, reach, thickness, and what the strip to the next row is painted with: in the upper digit
    /// (hexadecimal) the two columns next to the greatest z, in the lower one the rest.
    pub rows: &'static [[i8; 5]],
    /// Strips around.
    pub sides: u8,
    /// Only where x is positive; open where it is 0.
    pub half: bool,
    /// From an ellipse, 0, to [`SQUARE`].
    pub swell: f32,
    /// 0 for a symmetric outline; at 1 it ends in a cusp at the greatest z, as wings do.
    pub taper: f32,
}

/// The swell at which four sides are a rectangle with its full reach and thickness.
pub const SQUARE: f32 = 0.828_427_1;

/// The middle of one side, not a corner, points along z.
const fn offset(body: &Body) -> f32 {
    if body.swell == SQUARE { 0.5 } else { 0.0 }
}

impl Mesh {
    /// No surface yet.
    pub fn painted(paints: &[Paint]) -> Mesh {
        Mesh { paints: paints.to_vec(), ..Mesh::default() }
    }

    /// Joins the points from `first` on, rows of `columns`: outside is where rows follow counter-clockwise columns
    /// upwards. Triangles with two corners in one place are left out, so a row may shrink to fewer points, or to one.
    ///
    /// The paint is `paint(row, column)`, both from 0.
    #[inline(never)]
    pub fn loft(&mut self, first: usize, columns: usize, paint: &dyn Fn(usize, usize) -> u16) {
        for i in first..self.points.len() - columns {
            let (row, column) = ((i - first) / columns, (i - first) % columns);
            if column + 1 < columns {
                self.face([i, i + 1, i + columns + 1], paint(row, column));
                self.face([i, i + columns + 1, i + columns], paint(row, column));
            }
        }
    }

    /// A triangle, if it is one.
    #[inline(never)]
    fn face(&mut self, corners: [usize; 3], paint: u16) {
        let [a, b, c] = corners.map(|i| self.points[i]);
        if a != b && b != c && c != a {
            self.faces.push(Face { corners: corners.map(|i| i as u16), paint });
        }
    }

    /// A body, its local coordinates multiplied by `turn`, which may scale and shear, and moved to `at`.
    #[inline(never)]
    pub fn body(&mut self, body: &Body, turn: &Mat3, at: Vec3) {
        let first = self.points.len();
        let sides = body.sides as u32;
        for row in body.rows {
            let [along, middle, reach, thickness] = [0, 1, 2, 3].map(|i| row[i] as f32);
            for k in 0..=sides {
                let part = if body.half { k } else { k % sides };
                let angle = (part as f32 + offset(body)) / sides as f32 * if body.half { PI } else { TAU };
                // Rounded to a millionth, so that half a turn ends where it should.
                let (sin, cos) = ((angle.sin() + 8.0) - 8.0, (angle.cos() + 8.0) - 8.0);
                let x = thickness * sin * (1.0 + body.swell * cos * cos) * (1.0 - body.taper * cos);
                let z = middle + reach * cos * (1.0 + body.swell * sin * sin);
                self.points.push(at + *turn * vec3(x, along, z));
            }
        }
        let rim = sides as usize - 2;
        self.loft(first, sides as usize + 1, &|row, column| {
            let paint = body.rows[row][4] as u8 as u16;
            let on_rim = column < 2 || !body.half && column >= rim;
            if on_rim { paint >> 4 } else { paint & 15 }
        });
    }

    /// A box: `half` has its half axes, a right-handed system, as columns.
    #[inline(never)]
    pub fn block(&mut self, half: &Mat3, at: Vec3, paint: u16) {
        let first = self.points.len();
        for i in 0..8 {
            let side = |bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
            self.points.push(at + *half * vec3(side(1), side(2), side(4)));
        }
        for i in 0..6 {
            // Both directions across the axis, in the order that turns the face outwards.
            let (axis, up) = (i / 2, i & 1);
            let (u, v) = (1 << ((axis + 2 - up) % 3), 1 << ((axis + 1 + up) % 3));
            let w = first + (up << axis);
            self.face([w, w + u, w + u + v], paint);
            self.face([w, w + u + v, w + v], paint);
        }
    }

    /// A wall over a round arch of radius 1 around z: from -1.25 to 1.25, 1.25 high, 1 thick to both sides.
    /// Open below, where it stands on its pillars.
    #[inline(never)]
    pub fn arch(&mut self, turn: &Mat3, at: Vec3, paint: u16) {
        const PARTS: i32 = 6;
        let first = self.points.len();
        for i in -1..=PARTS + 1 {
            let angle = PI / PARTS as f32 * i.clamp(0, PARTS) as f32;
            let (x, y) = (angle.cos(), angle.sin());
            let outer = vec3(1.25 * x, if !(0..=PARTS).contains(&i) { 0.0 } else { 1.25 }, 0.0);
            let inner = vec3(x, y, 0.0);
            for (p, z) in [(inner, -1.0), (inner, 1.0), (outer, 1.0), (outer, -1.0), (inner, -1.0)] {
                self.points.push(at + *turn * (p + z * Vec3::Z));
            }
        }
        self.loft(first, 5, &|_, _| paint);
    }

    /// Moves the points from `first` on by up to `amount` metres each way, by noise of `scale` cells a metre: equal
    /// points alike, so nothing tears.
    #[inline(never)]
    pub fn weather(&mut self, first: usize, amount: f32, scale: f32) {
        for p in &mut self.points[first..] {
            let q = *p * scale;
            *p += amount * vec3(crate::noise::noise(q), crate::noise::noise(q + 17.3), crate::noise::noise(q + 31.7));
        }
    }

    /// Normals of a smooth surface: of the faces around each point, by area.
    ///
    /// A point on the plane x = 0 is taken to have a mirror image on the other side.
    pub fn smooth(&mut self) {
        self.normals = vec![Vec3::ZERO; self.points.len()];
        for face in &self.faces {
            let [a, b, c] = face.corners.map(|i| self.points[i as usize]);
            for i in face.corners {
                self.normals[i as usize] += (b - a).cross(c - a);
            }
        }
        for (n, p) in self.normals.iter_mut().zip(&self.points) {
            if p.x == 0.0 {
                n.x = 0.0;
            }
            *n = n.normalize_or(Vec3::Y);
        }
    }

    /// Adds another surface with the same paints, turned, which may scale alike in all directions or mirror, and moved.
    pub fn append(&mut self, other: &Mesh, turn: &Mat3, at: Vec3) {
        let first = self.points.len() as u16;
        let mirrored = turn.determinant() < 0.0;
        self.points.extend(other.points.iter().map(|&p| *turn * p + at));
        self.normals.extend(other.normals.iter().map(|&n| (*turn * n).normalize()));
        for &Face { corners: [a, b, c], paint } in &other.faces {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            self.faces.push(Face { corners: corners.map(|i| i + first), paint });
        }
    }
}
