//! The reference: each cell of the grid in a pixel is drawn as a pixel of its own would be, textures included.

use glam::{Mat3A, Vec3A, vec3a};
use paprsek::raster::World;
use paprsek::settings::{Quality, RasterSettings};
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::view::Camera;
use testkit::drawn::{body, dark, draw, ground};

const SIZE: [usize; 2] = [40, 24];
const GRID: usize = 8;

#[test]
fn a_pixel_is_the_mean_of_its_cells() {
    // Its octaves have cells of a tenth of a pixel to some pixels.
    let clouds = Texture {
        pattern: Pattern::Clouds { octaves: 6 },
        palette: Palette::Mix(Vec3A::ZERO, Vec3A::ONE),
        turn: Mat3A::from_diagonal(glam::Vec3::splat(1.5)),
        origin: Vec3A::ZERO,
    };
    let mut mesh = ground(30.0, 0.0, 4);
    mesh.paints[0].texture = Some(0);
    let world = World { ambient: [Vec3A::ONE, Vec3A::ZERO], textures: vec![clouds], ..dark(vec![body(mesh)]) };
    let camera = Camera::look_at(vec3a(0.0, 6.0, 9.0), Vec3A::ZERO, 0.6, 0.0);
    let at = |grid: usize, size: [usize; 2]| {
        let raster = RasterSettings { grid, ..Quality::EXACT.raster };
        draw(&world, camera, size, Quality { raster, ..Quality::EXACT }, testkit::levels()[0].1)
    };
    let (whole, cells) = (at(GRID, SIZE), at(1, SIZE.map(|n| n * GRID)));
    let mut varies = 0.0f32;
    for pixel in 0..SIZE[0] * SIZE[1] {
        let (x, y) = (pixel % SIZE[0] * GRID, pixel / SIZE[0] * GRID);
        let within = (0..GRID * GRID).map(|k| cells.color[(y + k / GRID) * cells.width + x + k % GRID]);
        let mean = within.clone().sum::<Vec3A>() / (GRID * GRID) as f32;
        varies = within.map(|light| (light.x - mean.x).abs()).fold(varies, f32::max);
        // Corners are snapped to steps of a pixel, which are smaller in the larger picture.
        assert!((whole.color[pixel] - mean).abs().max_element() < 2e-3, "{pixel}: {} and {mean}", whole.color[pixel]);
    }
    assert!(varies > 0.1, "the cells of a pixel hardly differ: {varies}");
}
