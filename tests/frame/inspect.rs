//! What layers tell of themselves is what they do.

use glam::{DVec3, Vec3A, vec3a};
use paprsek::frame::inspect::Aspect;
use paprsek::frame::probe::probe;
use paprsek::frame::{Frame, Layer, Options, Renderer, Tile};
use paprsek::raster::{self, RasterLayer};
use paprsek::settings::CloudSettings;
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::trace::{Material, Object, Shape, TraceLayer, World};
use paprsek::view::{Camera, View};
use paprsek::{Quality, scenes};
use testkit::drawn::{body, ray, triangles};

/// What a layer tells of every pixel of a picture, in rows.
fn told(layer: &dyn Layer, aspect: Aspect, renderer: &Renderer, (width, height): (usize, usize)) -> Vec<f32> {
    let mut all = vec![f32::NAN; width * height];
    for (column, row) in
        (0..width.div_ceil(64)).flat_map(|column| (0..height.div_ceil(64)).map(move |row| (column, row)))
    {
        let mut tile = Tile::at(column, row, width, height);
        let numbers = layer.inspect(aspect, renderer.level(), &mut tile).expect("a layer that knows");
        for y in 0..tile.height {
            let at = (tile.y + y) * width + tile.x;
            all[at..at + tile.width].copy_from_slice(&numbers[y * Tile::SIZE..][..tile.width]);
        }
    }
    all
}

/// Seen straight from above, every pixel of a level ground is as long as the next: octaves of cells that are less than a
/// quarter of it are not evaluated, and without a filter all are.
#[test]
fn octaves_are_those_that_the_pixel_is_worth() {
    const OCTAVES: u32 = 6;
    let size = (150, 100);
    let pattern = Pattern::Clouds { octaves: OCTAVES };
    let texture = Texture::new(pattern, Palette::Mix(Vec3A::ZERO, Vec3A::ONE), 1.0);
    let mut renderer = Renderer::new(1).unwrap();
    for (height, worth) in [(10.0, 6), (40.0, 5), (80.0, 4), (200.0, 2), (600.0, 1), (5000.0, 0)] {
        let camera = Camera::look_at(vec3a(0.0, height, 0.0), Vec3A::ZERO, 0.5, 0.0);
        let view = View::new(camera, size.0, size.1);
        // A pixel is 2 tan(fov / 2) / rows of the height long.
        let length = f64::from(height) * 2.0 * 0.25f64.tan() / size.1 as f64;
        assert_eq!((0..OCTAVES).filter(|k| length * 2f64.powi(*k as i32) < 4.0).count(), worth);
        let ground = Shape::Plane { normal: Vec3A::Y, offset: 0.0 };
        let world = World { ambient: Vec3A::ONE, ..World::new(vec![Object::new(ground, Material::matte(texture))]) };
        let far = 3.0 * height;
        let mut mesh = triangles(&[[vec3a(-far, 0.0, far), vec3a(far, 0.0, far), vec3a(0.0, 0.0, -far)]]);
        mesh.paints[0].texture = Some(0);
        let drawn =
            raster::World { textures: vec![texture], ambient: [Vec3A::ONE; 2], ..raster::World::new(vec![body(mesh)]) };
        for (quality, worth) in [(Quality::DEFAULT, worth), (Quality::FAST, OCTAVES as usize)] {
            let mut layer = TraceLayer::new(world.clone(), &view, &quality.trace);
            layer.prepare(renderer.workers(), renderer.cache());
            let octaves = told(&layer, Aspect::Octaves, &renderer, size);
            assert!(octaves.iter().all(|octaves| *octaves == worth as f32), "{height}: {worth} {octaves:?}");
        }
        // The rasterizer always filters.
        let mut layer = RasterLayer::new(drawn, &view, &Quality::DEFAULT.raster);
        layer.prepare(renderer.workers(), renderer.cache());
        let octaves = told(&layer, Aspect::Octaves, &renderer, size);
        assert!(octaves.iter().all(|octaves| *octaves == worth as f32), "{height}: {worth} {octaves:?}");
    }
    // And counting changes no frame.
    let scene = scenes::named("spheres").unwrap();
    let mut frame = Frame::new(200, 120);
    renderer.render(&scene, 2.0, &Quality::DEFAULT, &mut frame);
    let picture = (scene.picture)(&renderer.spec(2.0, &Quality::DEFAULT, (200, 120)));
    let layer = &picture.layers[0];
    let (mut plain, mut counted) = (Tile::at(1, 0, 200, 120), Tile::at(1, 0, 200, 120));
    counted.octaves = vec![0.0; Tile::AREA];
    layer.draw(renderer.level(), &mut plain);
    layer.draw(renderer.level(), &mut counted);
    assert!(plain.red == counted.red && plain.green == counted.green && plain.blue == counted.blue);
    assert!(counted.octaves.iter().any(|octaves| *octaves > 0.0));
}

/// Squares tile the picture, are cut down to samples within pixels where the outline of a ball runs, to at most the root
/// of its radius in pixels within it, and are left whole far outside of it.
#[test]
fn squares_are_small_along_the_outline_of_a_ball() {
    let (size, cell) = ((200, 130), Quality::DEFAULT.trace.cell as f32);
    let camera = Camera::look_at(vec3a(0.3, 0.2, 5.0), Vec3A::ZERO, 0.8, 0.1);
    let ball = Object::new(Shape::Sphere { center: Vec3A::ZERO, radius: 1.0 }, Material::plain(Vec3A::ONE));
    let world = World { ambient: Vec3A::ONE, ..World::new(vec![ball]) };
    let renderer = Renderer::new(1).unwrap();
    let mut layer = TraceLayer::new(world, &View::new(camera, size.0, size.1), &Quality::DEFAULT.trace);
    layer.prepare(renderer.workers(), renderer.cache());
    let squares = told(&layer, Aspect::Squares, &renderer, size);
    // How many pixels the ray through a point passes outside of the ball's outline, about.
    let outside = |x: f64, y: f64| {
        let d = ray(&camera, [size.0, size.1], x, y).normalize();
        let eye = camera.eye.as_dvec3();
        let miss = (eye - d * eye.dot(d)).distance(DVec3::ZERO);
        (miss - 1.0) / 5.0 / (0.8 / size.1 as f64)
    };
    let (mut edges, mut whole) = (0, 0);
    for (at, &edge) in squares.iter().enumerate() {
        let (x, y) = (at % size.0, at / size.0);
        assert!([0.5, 1.0, 2.0, 4.0, 8.0].contains(&edge), "{edge}");
        // The square's own corner pixel has the same edge, and so has its last pixel.
        let step = edge.ceil() as usize;
        let first = (x / step * step, y / step * step);
        let last = ((first.0 + step - 1).min(size.0 - 1), (first.1 + step - 1).min(size.1 - 1));
        assert!(squares[first.1 * size.0 + first.0] == edge && squares[last.1 * size.0 + last.0] == edge);
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| outside((x + i) as f64, (y + j) as f64));
        if corners.iter().any(|out| *out > 0.05) && corners.iter().any(|out| *out < -0.05) {
            edges += 1;
            assert_eq!(edge, 0.5, "{x},{y} {corners:?}");
        } else if corners.iter().all(|out| out.abs() > 20.0) {
            // The radius is 31 pixels.
            whole += 1;
            assert_eq!(edge, if corners[0] > 0.0 { cell } else { 4.0 }, "{x},{y} {corners:?}");
        }
    }
    assert!(edges > 100 && whole > 5000, "{edges} {whole}");
}

/// Imposters age by a frame with each frame that still has a use for them; without imposters there are none.
#[test]
fn imposters_age_from_frame_to_frame() {
    let size = (320, 180);
    let scene = scenes::named("sky-of-clouds").unwrap();
    let renderer = Renderer::new(1).unwrap();
    let look = |time: f64, imposter: f32| {
        let quality = Quality { cloud: CloudSettings { imposter, ..Quality::FAST.cloud }, ..Quality::FAST };
        let mut picture = (scene.picture)(&renderer.spec(time, &quality, size));
        let layer = picture.layers.iter_mut().find(|layer| layer.name() == "Cumuli").unwrap();
        layer.prepare(renderer.workers(), renderer.cache());
        let layer = &**layer;
        [Aspect::Imposters, Aspect::ImposterAge].map(|aspect| told(layer, aspect, &renderer, size))
    };
    let ages = |[counts, ages]: &[Vec<f32>; 2]| -> Vec<f32> {
        assert!(counts.iter().zip(ages).all(|(count, age)| (*count > 0.0) == age.is_finite()));
        ages.iter().copied().filter(|age| age.is_finite()).collect()
    };
    for age in 0..3 {
        let found = ages(&look(4.0, 1.0));
        assert!(found.len() > 1000 && found.iter().all(|found| (found - age as f32).abs() < 1e-4), "{age}");
    }
    // Some serve the next frame too, and are a frame older; what is new is as new as can be.
    let later = ages(&look(4.2, 1.0));
    assert!(later.iter().all(|age| (0.0..3.0001).contains(age)));
    assert!(later.iter().any(|age| *age > 2.9999) && later.iter().any(|age| *age < 2.9));
    assert!(ages(&look(4.0, 0.0)).is_empty());
}

/// Fragments that are counted pixel by pixel are those that the rasterizer says it has shaded.
#[test]
fn samples_of_pixels_are_those_of_the_frame() {
    let (width, height) = (210, 120);
    let mut renderer = Renderer::new(2).unwrap();
    for name in ["shadow", "shadow-cube"] {
        let scene = scenes::named(name).unwrap();
        for quality in [Quality::FAST, Quality::DEFAULT] {
            let mut frame = Frame::new(width, height);
            let shaded = renderer.render(&scene, 3.0, &quality, &mut frame).samples;
            let mut picture = (scene.picture)(&renderer.spec(3.0, &quality, (width, height)));
            let layer = &mut picture.layers[0];
            layer.prepare(renderer.workers(), renderer.cache());
            let mut sum = 0.0;
            for (column, row) in (0..4).flat_map(|column| (0..2).map(move |row| (column, row))) {
                let mut tile = Tile::at(column, row, width, height);
                let numbers = layer.inspect(Aspect::Samples, renderer.level(), &mut tile).unwrap();
                sum += numbers.iter().map(|number| f64::from(*number)).sum::<f64>();
            }
            assert!(shaded > 1000);
            assert_eq!(sum, shaded as f64, "{name}");
        }
    }
}

/// The code that the probe ends with is that of the frame's pixel, in every scene.
#[test]
fn a_probe_ends_with_the_pixel() {
    let (width, height) = (160, 90);
    let mut renderer = Renderer::new(2).unwrap();
    for scene in scenes::all() {
        let time = 0.4 * scene.duration;
        let options = Options { quality: &Quality::FAST, ..Options::default() };
        let mut frame = Frame::new(width, height);
        renderer.render_with(scene, time, &options, &mut frame);
        for (x, y) in [(0, 0), (80, 45), (159, 89), (33, 70)] {
            let text = probe(&renderer, scene, time, &options, (width, height), (x, y));
            let [_, red, green, blue] = frame.pixels[y * width + x].to_be_bytes();
            let last = text.lines().last().unwrap();
            assert!(last.starts_with(&format!("code {red} {green} {blue},")), "{} {x},{y}: {text}", scene.name);
            assert!(text.lines().count() >= 3, "{text}");
        }
    }
}
