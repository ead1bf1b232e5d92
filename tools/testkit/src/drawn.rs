//! What the rasterizer makes of a world, in linear light, and simple worlds.

use fearless_simd::Level;
use glam::{Affine3A, DVec3, Mat3A, Vec3A};
use paprsek::frame::{Cache, Layer, Renderer, Tile};
use paprsek::raster::{Body, Face, Mesh, Paint, RasterLayer, RasterMemory, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;
use std::sync::Arc;

/// A picture before it becomes codes, row by row from the top left.
#[derive(Clone)]
pub struct Planes {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Linear light.
    pub color: Vec<Vec3A>,
    /// 1 / distance along the axis; 0 for nothing.
    pub inv_depth: Vec<f32>,
    /// Share of the pixel that something covers, 0 to 1.
    pub coverage: Vec<f32>,
}

impl Planes {
    /// The first pixel that has other bits, if any.
    pub fn differs(&self, other: &Planes) -> Option<usize> {
        let bits = |p: &Planes, i: usize| {
            let [x, y, z] = p.color[i].to_array();
            [x, y, z, p.inv_depth[i], p.coverage[i]].map(f32::to_bits)
        };
        (0..self.color.len().max(other.color.len())).find(|&i| bits(self, i) != bits(other, i))
    }
}

/// Draws a world on one thread.
pub fn draw(world: &World, camera: Camera, size: [usize; 2], quality: Quality, level: Level) -> Planes {
    draw_with(&Cache::default(), world, camera, size, quality, level)
}

/// The same as a renderer does that keeps `cache` from frame to frame.
pub fn draw_with(
    cache: &Cache,
    world: &World,
    camera: Camera,
    [width, height]: [usize; 2],
    quality: Quality,
    level: Level,
) -> Planes {
    let n = width * height;
    let mut planes =
        Planes { width, height, color: vec![Vec3A::NAN; n], inv_depth: vec![f32::NAN; n], coverage: vec![f32::NAN; n] };
    let renderer = Renderer::new(1).unwrap().at_level(level);
    let mut layer = RasterLayer::new(world.clone(), &View::new(camera, width, height), &quality.raster);
    layer.prepare(renderer.workers(), cache);
    for (row, column) in
        (0..height.div_ceil(Tile::SIZE)).flat_map(|y| (0..width.div_ceil(Tile::SIZE)).map(move |x| (y, x)))
    {
        let mut tile = Tile::at(column, row, width, height);
        layer.draw(level, &mut tile);
        for (y, x) in (0..tile.height).flat_map(|y| (0..tile.width).map(move |x| (y, x))) {
            let (from, to) = (y * Tile::SIZE + x, (tile.y + y) * width + tile.x + x);
            planes.color[to] = Vec3A::new(tile.red[from], tile.green[from], tile.blue[from]);
            planes.inv_depth[to] = tile.inv_depth[from];
            planes.coverage[to] = tile.coverage[from];
        }
    }
    planes
}

/// The eye ray through a point of the picture, pixels from its top left: its axial part is 1.
pub fn ray(camera: &Camera, size: [usize; 2], x: f64, y: f64) -> DVec3 {
    let [w, h] = size.map(|n| n as f64);
    let (px, py) = ((2.0 * x - w) / h, (h - 2.0 * y) / h);
    camera.forward.as_dvec3() + camera.right.as_dvec3() * px + camera.up.as_dvec3() * py
}

/// No ambient light, no haze, nothing behind.
pub fn dark(bodies: Vec<Body>) -> World {
    World::new(bodies)
}

/// A body that stands where its mesh is.
pub fn body(mesh: Mesh) -> Body {
    Body::new(Arc::new(mesh), Affine3A::IDENTITY)
}

/// A mesh without triangles whose one paint is white.
pub fn blank() -> Mesh {
    Mesh::painted(&[Paint { albedo: Vec3A::ONE, texture: None, gloss: 0.0 }])
}

/// Flat triangles.
pub fn triangles(faces: &[[Vec3A; 3]]) -> Mesh {
    let mut mesh = blank();
    for face in faces {
        let first = mesh.points.len() as u16;
        mesh.points.extend(face);
        mesh.faces.push(Face { corners: [first, first + 1, first + 2], paint: 0 });
    }
    mesh
}

/// A box along the axes.
pub fn block(low: Vec3A, high: Vec3A) -> Mesh {
    let mut mesh = blank();
    mesh.block(&Mat3A::from_diagonal((0.5 * (high - low)).into()), 0.5 * (low + high), 0);
    mesh
}

/// Level ground of `cells` x `cells` squares, `half` metres to each side of the origin, that looks up.
pub fn ground(half: f32, height: f32, cells: usize) -> Mesh {
    let mut mesh = blank();
    for j in 0..=cells {
        for i in 0..=cells {
            let at = |k: usize| (2.0 * k as f32 / cells as f32 - 1.0) * half;
            mesh.points.push(Vec3A::new(at(i), height, -at(j)));
        }
    }
    mesh.loft(0, cells + 1, 0, &[]);
    mesh
}

/// Where a ray enters a box, and through which axis.
pub fn enters(o: DVec3, d: DVec3, (low, high): (Vec3A, Vec3A)) -> Option<(f64, usize)> {
    let (a, b) = ((low.as_dvec3() - o) / d, (high.as_dvec3() - o) / d);
    let first = a.min(b);
    let (enter, leave) = (first.max_element(), a.max(b).min_element());
    (enter < leave && leave > 0.0).then(|| (enter, (0..3).find(|&k| first[k] == enter).unwrap_or(0)))
}

/// Points of shadows: acne is dark instead of lit, leaks are lit instead of dark.
#[derive(Default, Debug, Clone, Copy)]
pub struct Count {
    /// All that were judged.
    pub pixels: u32,
    /// Those that are in shadow.
    pub dark: u32,
    /// Those that are dark instead of lit.
    pub acne: u32,
    /// Those that are lit instead of dark.
    pub leaks: u32,
    /// Misclassified, but farther from a true edge than a map may err.
    pub far: u32,
}

impl Count {
    /// Counts a point that is lit in truth or not, that was found lit or not, and whether it lies far from an edge.
    pub fn add(&mut self, truth: bool, found: bool, far: bool) {
        self.pixels += 1;
        self.dark += !truth as u32;
        self.acne += (truth && !found) as u32;
        self.leaks += (!truth && found) as u32;
        self.far += (truth != found && far) as u32;
    }

    /// The share of the points that are misclassified.
    pub fn share(&self) -> f64 {
        (self.acne + self.leaks) as f64 / self.pixels as f64
    }
}

/// Has the next frame draw the first light's map, as if that light had moved, as sun and torch do in every frame of a show:
/// maps are kept while a light rests, which would spare whoever comes second in a comparison his own.
pub fn forget_maps(renderer: &Renderer) {
    renderer.cache().get::<RasterMemory>().lock().maps.forget(0);
}
