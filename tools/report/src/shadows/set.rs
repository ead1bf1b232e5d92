//! The scenes in which shadows are judged: everything is white and matt under one sun, so that a pixel shows its light.

use fearless_simd::Level;
use glam::{Affine3A, Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Cache, Frame, Layer, Picture, Renderer, Stats, Tile, Workers};
use paprsek::raster::{Bias, Body, Light, Mesh, Paint, Projection, RasterLayer, ShadowViews, World, fit};
use paprsek::scenes::bench::shadow_set;
use paprsek::scenes::models::{chapel, land, tree};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// Bodies before a camera, and the sun's maps of their scene.
pub struct Set {
    pub name: &'static str,
    pub meshes: Vec<Arc<Mesh>>,
    bodies: Vec<Body>,
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// The ends of the nearest and of the farthest cascade, metres along the view axis.
    pub range: (f32, f32),
    /// The ends of its own cascades, metres; if there are none, it has one map of 72 metres.
    pub ends: &'static [f32],
    pub bias: Bias,
    pub smooth: bool,
}

fn set(meshes: Vec<Mesh>) -> (Vec<Arc<Mesh>>, Vec<Body>) {
    let white = Paint { albedo: Vec3A::ONE, texture: None, gloss: 0.0 };
    let whiten = |mesh: Mesh| Arc::new(Mesh { paints: vec![white; mesh.paints.len()], ..mesh });
    let meshes: Vec<_> = meshes.into_iter().map(whiten).collect();
    let bodies = meshes.iter().map(|mesh| Body::new(mesh.clone(), Affine3A::IDENTITY)).collect();
    (meshes, bodies)
}

/// The set by which rasterizers are compared, and the land of `day` in the afternoon.
pub fn both(size: (usize, usize)) -> [Set; 2] {
    let (meshes, bodies) = set(shadow_set::meshes());
    let camera = Camera::look_at(shadow_set::eye(2.0).as_vec3a(), vec3a(0.0, 0.5, 0.0), 50f32.to_radians(), 0.0);
    let bench = Set {
        name: "bench",
        meshes,
        bodies,
        camera,
        size,
        range: (8.0, 56.0),
        ends: &[],
        bias: Bias { constant: 0.03, slope: 0.15 * 1024.0 / 72.0, normal: 0.0 },
        smooth: false,
    };
    let mut meshes = land::ground();
    meshes.extend(tree::woods(&tree::trees()));
    meshes.push(chapel::chapel());
    meshes.push(land::lake());
    let (meshes, bodies) = set(meshes);
    let camera = Camera::look_at(vec3a(30.0, 16.0, 40.0), vec3a(0.0, 14.0, -2.0), 50f32.to_radians(), 0.0);
    let day = Set {
        name: "day",
        meshes,
        bodies,
        camera,
        size,
        range: (10.0, 6000.0),
        ends: &[24.0, 80.0, 500.0, 6000.0],
        bias: Bias::SHOW,
        smooth: true,
    };
    [bench, day]
}

/// The direction of a sun this high above the horizon, degrees: from the left of the camera and a little behind it.
pub fn sun(set: &Set, elevation: f32) -> Vec3A {
    let (sin, cos) = elevation.to_radians().sin_cos();
    let side = vec3a(-set.camera.right.x, 0.0, -set.camera.right.z).normalize();
    let back = vec3a(-set.camera.forward.x, 0.0, -set.camera.forward.z).normalize();
    (side * 0.9 + back * 0.436).normalize() * cos + Vec3A::Y * sin
}

/// A picture: red, green, blue and inverse depth of every pixel (0 without a surface), the milliseconds before the tiles, and
/// those of the whole frame.
pub struct Shot {
    pub pixels: Vec<[f32; 4]>,
    pub maps: f64,
    pub all: f64,
}

/// A layer that keeps the light that another one draws.
struct Probe {
    drawn: RasterLayer,
    width: usize,
    kept: Arc<Mutex<(Vec<[f32; 4]>, f64)>>,
}

impl Layer for Probe {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        let began = Instant::now();
        self.drawn.prepare(workers, _cache);
        self.kept.lock().unwrap().1 = began.elapsed().as_secs_f64() * 1e3;
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let stats = self.drawn.draw(level, tile);
        let pixels = &mut self.kept.lock().unwrap().0;
        for (y, x) in (0..tile.height).flat_map(|y| (0..tile.width).map(move |x| (y, x))) {
            let at = y * Tile::SIZE + x;
            pixels[(tile.y + y) * self.width + tile.x + x] =
                [tile.red[at], tile.green[at], tile.blue[at], tile.inv_depth[at]];
        }
        stats
    }
}

impl Set {
    pub fn view(&self) -> View {
        View::new(self.camera, self.size.0, self.size.1)
    }

    fn aspect(&self) -> f32 {
        self.size.0 as f32 / self.size.1 as f32
    }

    /// The sun's maps of `size` texels as the scene has them, or a number of cascades whose ends grow by equal ratios.
    pub fn views(&self, towards: Vec3A, cascades: Option<usize>, size: u32) -> Vec<Projection> {
        let (near, far) = self.range;
        let grown = |n: usize| (1..=n).map(|i| near * (far / near).powf(i as f32 / n as f32)).collect::<Vec<_>>();
        match cascades {
            Some(n) => fit::cascades(&self.camera, self.aspect(), towards, &grown(n), size),
            None if self.ends.is_empty() => vec![Projection::parallel(towards, Vec3A::ZERO, 72.0, size)],
            None => fit::cascades(&self.camera, self.aspect(), towards, self.ends, size),
        }
    }

    /// Shadow views with the scene's bias.
    pub fn shadow_views(&self, views: Vec<Projection>) -> ShadowViews {
        ShadowViews { smooth: self.smooth, ..ShadowViews::new(views, self.bias) }
    }

    /// Draws the set under suns, given by direction, colour and shadow views.
    pub fn draw(&self, renderer: &mut Renderer, suns: &[(Vec3A, Vec3A, Option<ShadowViews>)]) -> Shot {
        let light = |(towards, color, shadow): &(Vec3A, Vec3A, Option<ShadowViews>)| Light {
            shadow: shadow.clone(),
            ..Light::sun(*towards, *color)
        };
        let lights = suns.iter().map(light).collect();
        let world = World { lights, ..World::new(self.bodies.clone()) };
        let (width, height) = self.size;
        let kept = Arc::new(Mutex::new((vec![[0.0; 4]; width * height], 0.0)));
        let drawn = RasterLayer::new(world, &self.view(), &Quality::FAST.raster);
        let layer = Probe { drawn, width, kept: kept.clone() };
        let picture = Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb };
        let mut frame = Frame::new(width, height);
        testkit::drawn::forget_maps(renderer);
        let began = Instant::now();
        renderer.draw(picture, &mut frame);
        let all = began.elapsed().as_secs_f64() * 1e3;
        let (pixels, maps) = std::mem::take(&mut *kept.lock().unwrap());
        Shot { pixels, maps, all }
    }
}
