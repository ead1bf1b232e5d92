//! Rays against triangles in f64, by a hierarchy of boxes that are halved at the median.

use glam::DVec3;
use paprsek::raster::Mesh;

/// What a ray meets.
#[derive(Clone, Copy)]
pub struct Hit {
    pub distance: f64,
    /// Unit normal that faces the ray.
    pub normal: DVec3,
    pub albedo: DVec3,
}

struct Triangle {
    corner: DVec3,
    sides: [DVec3; 2],
    albedo: DVec3,
}

struct Node {
    low: DVec3,
    high: DVec3,
    /// First triangle and count of a leaf; the two children of others, of which the first follows.
    first: usize,
    count: usize,
}

/// Triangles in boxes.
pub struct Triangles {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
}

impl Triangles {
    /// Sorts the meshes' triangles. Textures are left out: a paint is its albedo.
    pub fn new(meshes: &[Mesh]) -> Triangles {
        let mut triangles = Vec::new();
        for mesh in meshes {
            for face in &mesh.faces {
                let [a, b, c] = face.corners.map(|corner| mesh.points[usize::from(corner)].as_dvec3());
                let albedo = mesh.paints[usize::from(face.paint)].albedo.as_dvec3();
                triangles.push(Triangle { corner: a, sides: [b - a, c - a], albedo });
            }
        }
        let mut all = Triangles { nodes: Vec::new(), triangles };
        all.split(0, all.triangles.len());
        all
    }

    fn split(&mut self, first: usize, count: usize) {
        let part = &mut self.triangles[first..first + count];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for Triangle { corner, sides, .. } in &*part {
            for point in [*corner, *corner + sides[0], *corner + sides[1]] {
                (low, high) = (low.min(point), high.max(point));
            }
        }
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, first, count });
        if count > 4 {
            let axis = (high - low).max_position();
            let middle = |t: &Triangle| (3.0 * t.corner + t.sides[0] + t.sides[1])[axis];
            part.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
            self.split(first, count / 2);
            let second = self.nodes.len();
            self.split(first + count / 2, count - count / 2);
            (self.nodes[node].first, self.nodes[node].count) = (second, 0);
        }
    }

    /// The nearest hit between a ten-thousandth of a metre and `far`.
    pub fn hit(&self, origin: DVec3, direction: DVec3, far: f64) -> Option<Hit> {
        let (inverse, mut best, mut found) = (direction.recip(), far, None);
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let Node { low, high, first, count } = self.nodes[index];
            let (a, b) = ((low - origin) * inverse, (high - origin) * inverse);
            if a.min(b).max_element().max(0.0) > a.max(b).min_element().min(best) {
                continue;
            }
            if count == 0 {
                stack.extend([first, index + 1]);
                continue;
            }
            for triangle in &self.triangles[first..first + count] {
                // Moeller and Trumbore.
                let [u, v] = triangle.sides;
                let p = direction.cross(v);
                let (determinant, from) = (u.dot(p), origin - triangle.corner);
                let q = from.cross(u);
                let (x, y, distance) =
                    (from.dot(p) / determinant, direction.dot(q) / determinant, v.dot(q) / determinant);
                if x >= 0.0 && y >= 0.0 && x + y <= 1.0 && distance > 1e-4 && distance < best {
                    best = distance;
                    found = Some((triangle, distance));
                }
            }
        }
        found.map(|(triangle, distance)| {
            let normal = triangle.sides[0].cross(triangle.sides[1]).normalize();
            let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
            Hit { distance, normal, albedo: triangle.albedo }
        })
    }
}
