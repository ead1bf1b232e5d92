//! The truth about shadows: rays towards the sun in f64, and whether a pixel is far from any shadow edge.

use super::set::Set;
use glam::{Affine3A, DMat4, DVec3, Vec3A};
use paprsek::frame::{Renderer, Tile};
use paprsek::raster::setup::{SetupMesh, TriangleSetup};
use paprsek::raster::triangle::SUB;
use paprsek::raster::{Bias, Projection, ShadowViews};

/// Edge of the rasters that sort triangles, texels. Corners are snapped to 1/256 texel.
const SIZE: u32 = 4096;
/// The least cosine between normal and sun of the pixels that are judged.
const LEAST: f32 = 0.02;

/// A pixel that faces the sun.
pub struct Pixel {
    pub point: Vec3A,
    pub normal: Vec3A,
    pub cosine: f32,
    /// Whether the sun shines on it.
    pub lit: bool,
    /// Whether it is farther than 1.5 texels from any shadow edge.
    pub far: bool,
    /// Its index in the picture.
    pub index: usize,
}

/// Triangles in the sun's rasters.
pub struct Tracer {
    views: Vec<(DMat4, Vec<SetupMesh>)>,
}

impl Tracer {
    fn new(set: &Set, views: Vec<Projection>) -> Tracer {
        let view = |projection: Projection| {
            let setup = TriangleSetup { projection, back_faces: false, shaded: false };
            let pieces: Vec<_> = set.meshes.iter().map(|mesh| setup.set_up(mesh, &Affine3A::IDENTITY)).collect();
            (projection.matrix().as_dmat4(), pieces)
        };
        Tracer { views: views.into_iter().map(view).collect() }
    }

    /// Whether something stands between the sun and the point, which is lifted towards it by `lift` metres.
    fn hidden(&self, point: DVec3, lift: f64) -> bool {
        let end = SIZE as f64 - 1.0;
        for (matrix, pieces) in &self.views {
            let h = *matrix * point.extend(1.0);
            if h.x < 1.0 || h.y < 1.0 || h.x > end || h.y > end {
                continue;
            }
            let tile = [h.x, h.y].map(|n| n as usize / Tile::SIZE);
            return pieces.iter().flat_map(|mesh| mesh.in_tile(tile)).any(|(_, t)| {
                let (x, y) = (h.x * SUB as f64, h.y * SUB as f64);
                t.edges.iter().all(|&(a, b, c)| a as f64 * x + b as f64 * y + c as f64 >= 0.0) && {
                    let (dx, dy) = (h.x - t.anchor[0] as f64, h.y - t.anchor[1] as f64);
                    let near = t.at.w as f64 + t.by[0].w as f64 * dx + t.by[1].w as f64 * dy;
                    near.clamp(t.range[0] as f64, t.range[1] as f64) > h.z + lift
                }
            });
        }
        false
    }
}

/// The pixels that face the sun, judged by traced shadows, and what traces them.
pub fn pixels(set: &Set, renderer: &mut Renderer, towards: Vec3A) -> (Vec<Pixel>, Tracer) {
    let axes = |sign: f32| Vec3A::AXES.map(|axis| (axis * sign, axis, None));
    let (plus, minus) = (set.draw(renderer, &axes(1.0)), set.draw(renderer, &axes(-1.0)));
    // Traced shadows keep a 32nd of the bias, here a centimetre. That is more than the rounding of f32 some kilometres away,
    // while a millimetre would be less.
    let bias = Bias { constant: 0.32, slope: 1.0, normal: 1.0 };
    let shadow_views = ShadowViews { bias, traced: true, ..set.shadow_views(set.views(towards, None, SIZE)) };
    let traced = set.draw(renderer, &[(towards, Vec3A::ONE, Some(shadow_views.clone()))]);
    let view = set.view();
    let mut pixels = Vec::new();
    for (index, light) in traced.pixels.iter().enumerate() {
        let normal = Vec3A::from_array([0, 1, 2].map(|k| plus.pixels[index][k] - minus.pixels[index][k]));
        let cosine = normal.dot(towards);
        if light[3] > 0.0 && cosine > LEAST {
            let ray = view.ray((index % set.size.0) as f32 + 0.5, (index / set.size.0) as f32 + 0.5);
            let point = set.camera.eye + ray / light[3];
            pixels.push(Pixel { point, normal, cosine, lit: light[0] > 0.5 * cosine, far: false, index });
        }
    }
    (pixels, Tracer::new(set, shadow_views.views))
}

/// Marks the pixels that are farther than 1.5 texels of their view from a shadow's edge.
pub fn mark(pixels: &mut [Pixel], tracer: &Tracer, towards: Vec3A, views: &[Projection]) {
    let half = pixels.len().div_ceil(2).max(1);
    std::thread::scope(|scope| {
        for part in pixels.chunks_mut(half) {
            scope.spawn(|| part.iter_mut().for_each(|pixel| pixel.far = far(tracer, pixel, towards, views)));
        }
    });
}

/// The size of a texel of the map that a point is looked up in, metres.
fn texel(views: &[Projection], point: Vec3A) -> Option<f32> {
    let inside = |view: &&Projection| {
        let h = view.matrix() * point.extend(1.0);
        h.x.min(h.y) >= 2.0 && h.x.max(h.y) <= view.size[0] as f32 - 2.0
    };
    views.iter().find(inside).map(|view| 1.0 / view.rows[0].truncate().length())
}

/// Whether the points 1.5 texels around on the pixel's own plane all see the sun as the pixel does.
fn far(tracer: &Tracer, pixel: &Pixel, towards: Vec3A, views: &[Projection]) -> bool {
    let Some(texel) = texel(views, pixel.point) else { return false };
    let (n, t) = (pixel.normal.as_dvec3(), towards.as_dvec3());
    let right = t.any_orthonormal_vector();
    let up = t.cross(right);
    // Enough for rounding, and for curved surfaces, which leave their tangent plane.
    let lift = 0.002 + 0.05 * texel as f64;
    (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))).all(|(i, j)| {
        let across = (right * i as f64 + up * j as f64) * (1.5 * texel as f64);
        let along = t * (-n.dot(across) / n.dot(t));
        tracer.hidden(pixel.point.as_dvec3() + across + along, lift) != pixel.lit
    })
}
