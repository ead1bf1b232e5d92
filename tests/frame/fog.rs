//! Fog against Beer and Lambert's law in f64.

use fearless_simd::Level;
use glam::{DVec3, Vec3A, vec3a};
use paprsek::effects::{Fog, FogLayer};
use paprsek::frame::{Layer, Tile};
use paprsek::view::Camera;
use paprsek::view::View;
use testkit::random::Random;

const SIZE: [usize; 2] = [150, 100];

fn camera() -> Camera {
    Camera::look_at(vec3a(3.0, 2.0, -1.0), vec3a(4.0, 2.7, 5.0), 0.9, 0.1)
}

fn fog(density: f32, end: f32) -> Fog {
    let light = vec3a(0.5, 0.6, 0.8);
    Fog { light, density, end }
}

/// The third tile of the second row, which is cut at both ends: solids from 0.3 m to 30 km, sky, and edges.
fn tile() -> Tile {
    let mut random = Random(4);
    let mut tile = Tile::at(2, 1, SIZE[0], SIZE[1]);
    for at in 0..Tile::AREA {
        let covered = [0.0, 0.25, 0.75, 1.0][at % 4];
        tile.coverage[at] = covered;
        tile.inv_depth[at] = if covered > 0.0 { random.log(1.0 / 3e4, 3.0) as f32 } else { 0.0 };
        for plane in [&mut tile.red, &mut tile.green, &mut tile.blue] {
            plane[at] = random.range(0.0, 1.5) as f32;
        }
    }
    tile
}

fn drawn(fog: Fog, level: Level) -> Tile {
    let mut tile = tile();
    FogLayer::new(fog, &View::new(camera(), SIZE[0], SIZE[1])).draw(level, &mut tile);
    tile
}

fn bits(tile: &Tile) -> Vec<u32> {
    let planes = [&tile.red, &tile.green, &tile.blue, &tile.coverage, &tile.inv_depth];
    planes.iter().flat_map(|plane| plane.iter().map(|x| x.to_bits())).collect()
}

/// The exponent is at most some 1e-6 of itself off, by which `x exp(-x)` changes by a third of that; then come the
/// roundings of a mean of light up to 1.5.
const EXACT: f64 = 2e-6;

#[test]
fn light_fades_into_fog_by_distance() {
    let before = tile();
    let camera = camera();
    for (density, end) in [(1e-5, 1e4), (1e-3, 500.0), (1e-3, 1e5), (0.05, 3000.0), (2.0, 10.0), (1e3, 1e3)] {
        let fog = fog(density, end);
        let found = drawn(fog, Level::new());
        for row in 0..found.height {
            for column in 0..found.width {
                let at = row * Tile::SIZE + column;
                let (x, y) = ((found.x + column) as f64 + 0.5, (found.y + row) as f64 + 0.5);
                let [w, h] = SIZE.map(|n| n as f64);
                let ray = camera.forward.as_dvec3()
                    + camera.right.as_dvec3() * ((2.0 * x - w) / h)
                    + camera.up.as_dvec3() * ((h - 2.0 * y) / h);
                let through = |metres: f64| (-(density as f64) * metres.min(end as f64)).exp();
                let covered = before.coverage[at] as f64;
                let solid = through(ray.length() / before.inv_depth[at] as f64);
                let clear = covered * solid + (1.0 - covered) * through(f64::INFINITY);
                let light = fog.light.as_dvec3();
                let of = |tile: &Tile| Vec3A::new(tile.red[at], tile.green[at], tile.blue[at]).as_dvec3();
                let truth: DVec3 = of(&before) * clear + light * (1.0 - clear);
                let gap = (of(&found) - truth).abs().max_element();
                assert!(gap <= EXACT, "{density} a metre, ({x}, {y}): off by {gap}");
            }
        }
        assert!(found.coverage == before.coverage && found.inv_depth == before.inv_depth);
    }
}

#[test]
fn no_fog_leaves_the_picture_as_it_is() {
    let before = bits(&tile());
    for (name, level) in testkit::levels() {
        for end in [1.0, 5e4] {
            assert!(bits(&drawn(fog(0.0, end), level)) == before, "{name}");
        }
    }
}

#[test]
fn every_level_gives_the_same_bits() {
    let truth = bits(&drawn(fog(0.004, 2e3), testkit::levels()[0].1));
    for (name, level) in testkit::levels() {
        assert!(bits(&drawn(fog(0.004, 2e3), level)) == truth, "{name}");
    }
}

/// Nothing is darker behind more fog of a light that is brighter than all, and nothing is lighter than that.
#[test]
fn more_fog_is_nearer_to_its_light() {
    let white = |density: f32| Fog { light: Vec3A::splat(2.0), ..fog(density, 4e3) };
    let mut last = tile();
    for density in [1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 10.0] {
        let next = drawn(white(density), Level::new());
        for row in 0..next.height {
            let at = row * Tile::SIZE..row * Tile::SIZE + next.width;
            for (before, after) in last.red[at.clone()].iter().zip(&next.red[at]) {
                assert!(after >= before && *after <= 2.0, "{density}: {before} {after}");
            }
        }
        last = next;
    }
}
