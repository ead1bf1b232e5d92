//! Clouds in a tile: solids before, in and behind them, cells of pixels, and one cloud before another.

use fearless_simd::Level;
use glam::{Vec3A, vec3a};
use paprsek::cloud::{Cloud, CloudLayer, CloudLight};
use paprsek::frame::{Frame, Layer, Renderer, Tile};
use paprsek::scenes;
use paprsek::settings::{CloudSettings, Quality};
use paprsek::view::Camera;
use paprsek::view::View;
use testkit::levels;
use testkit::metrics::Difference;
use testkit::voxels::{DAY, FURNACE, ball, cloud, filled, span, truth};

/// A sum of a hundred roundings, and places that are good to 1e-5.
const EXACT: f64 = 3e-5;

fn view() -> View {
    View::new(Camera::look_at(vec3a(0.0, 0.0, 3.0), Vec3A::ZERO, 0.9, 0.0), 64, 64)
}

/// Every pixel, nothing left out.
fn exact() -> CloudSettings {
    Quality::EXACT.cloud
}

/// Solids by coverage and depth along the view axis, with the clouds over them. They are not all of one colour.
fn tile(clouds: Vec<Cloud>, light: CloudLight, quality: CloudSettings, solid: impl Fn(usize) -> (f32, f32)) -> Tile {
    let layer = CloudLayer::new(clouds, light, &view(), &quality);
    let mut tile = Tile::at(0, 0, 64, 64);
    for at in 0..Tile::AREA {
        let (covers, depth) = solid(at);
        (tile.red[at], tile.green[at], tile.blue[at]) = (0.5 * covers, 0.25 * covers, 3.0 * covers);
        (tile.coverage[at], tile.inv_depth[at]) = (covers, if covers > 0.0 { 1.0 / depth } else { 0.0 });
    }
    layer.draw(Level::new(), &mut tile);
    tile
}

fn bits(tile: &Tile) -> Vec<u32> {
    let planes = [&tile.red, &tile.green, &tile.blue, &tile.coverage, &tile.inv_depth];
    planes.iter().flat_map(|plane| plane.iter().map(|x| x.to_bits())).collect()
}

fn changes_nothing(settings: CloudSettings) {
    let solid = |at: usize| ((at % 5) as f32 * 0.25, 2.0 + (at % 7) as f32 * 0.3);
    let without = bits(&tile(vec![], DAY, settings, solid));
    for empty in [cloud(filled(32, |_| 0), 30.0), cloud(filled(32, |_| 255), 0.0)] {
        assert!(bits(&tile(vec![empty; 2], DAY, settings, solid)) == without, "{settings:?}");
    }
}

/// A thin cloud far away in the air shows the light of that air, as much as it hides: from its depth too.
#[test]
fn thin_clouds_far_away_show_the_air() {
    for extinction in [1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 1.0f32] {
        let clouds = vec![cloud(filled(32, |_| 255), extinction)];
        // The air has the light 1 too, so its share does not matter.
        let layer = CloudLayer::new(clouds, FURNACE, &view(), &exact()).in_air(2.0, |_| Vec3A::ONE);
        let mut tile = Tile::at(0, 0, 64, 64);
        layer.draw(Level::new(), &mut tile);
        // Through the pixels in the middle the way is 2, but for a hundredth of a degree's cosine.
        let hides = -(-2.0 * extinction as f64).exp_m1();
        let error = (tile.red[32 * Tile::SIZE + 32] as f64 / hides - 1.0).abs();
        assert!(error < 2e-4, "{extinction:e}: {:e} for {hides:e}", tile.red[32 * Tile::SIZE + 32]);
    }
}

#[test]
fn an_empty_cloud_leaves_the_picture_as_it_is() {
    changes_nothing(exact());
    changes_nothing(Quality::FAST.cloud);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn an_empty_cloud_leaves_64_samples_as_they_are() {
    changes_nothing(Quality::REFERENCE.cloud);
}

#[test]
fn solids_end_rays_by_their_depth() {
    const EXTINCTION: f32 = 0.8;
    // The cube is from 2 to 4 metres away along the view axis: before it, in it, behind it.
    let solid = |at: usize| ([1.0, 0.75, 0.25, 0.0][at % 4], [0.5, 1.99, 2.5, 3.0, 3.9, 4.5, 90.0][at / 4 % 7]);
    let cloud = cloud(filled(32, |_| 255), EXTINCTION);
    let found = tile(vec![cloud], FURNACE, exact(), solid);
    let mut seen = 0;
    for at in 0..Tile::AREA {
        let ray = view().ray((at % 64) as f32 + 0.5, (at / 64) as f32 + 0.5).as_dvec3();
        let (covers, depth) = solid(at);
        let (covers, length) = (covers as f64, ray.length());
        let (entry, exit) = span(vec3a(0.0, 0.0, 3.0).as_dvec3(), ray / length).unwrap_or((0.0, 0.0));
        let [behind, before] =
            [exit, exit.min(depth as f64 * length)].map(|end| (-EXTINCTION as f64 * (end - entry).max(0.0)).exp());
        seen += (before > behind && before < 1.0 && covers > 0.0) as u32;
        let white = covers * (1.0 - before) + (1.0 - covers) * (1.0 - behind);
        let expected = [0.5, 0.25, 3.0].map(|own| covers * own * before + white);
        for (plane, exact) in [&found.red, &found.green, &found.blue].into_iter().zip(expected) {
            assert!((plane[at] as f64 - exact).abs() < EXACT, "pixel {at}: {} for {exact}", plane[at]);
        }
        let exact = covers + (1.0 - covers) * (1.0 - behind);
        assert!(
            (found.coverage[at] as f64 - exact).abs() < EXACT,
            "pixel {at}: {} covered for {exact}",
            found.coverage[at]
        );
    }
    assert!(seen > 200, "{seen} solids are in the cloud");
}

#[test]
fn clouds_hide_each_other_in_any_order() {
    let at = |z: f32, x: f32, extinction: f32| Cloud {
        centre: vec3a(x, 0.1, z),
        size: 0.6,
        ..cloud(ball(32, 3.0), extinction)
    };
    let clouds = [at(1.0, 0.1, 3.0), at(-0.5, -0.2, 9.0), at(-2.0, 0.4, 1.0)];
    let found = tile(clouds.to_vec(), DAY, CloudSettings { steps: 100, ..exact() }, |_| (0.0, 0.0));
    for order in [[2, 1, 0], [1, 2, 0], [0, 2, 1]] {
        let again =
            tile(order.map(|i| clouds[i].clone()).to_vec(), DAY, CloudSettings { steps: 100, ..exact() }, |_| {
                (0.0, 0.0)
            });
        assert!(bits(&again) == bits(&found), "{order:?}");
    }
    for at in (0..Tile::AREA).step_by(3) {
        let d = view().ray((at % 64) as f32 + 0.5, (at / 64) as f32 + 0.5).normalize();
        let (mut light, mut left) = (glam::DVec3::ZERO, 1.0);
        for cloud in &clouds {
            let (own, passes) = truth(cloud, &DAY, vec3a(0.0, 0.0, 3.0), d, 100);
            (light, left) = (light + own * left, left * passes);
        }
        let error = (vec3a(found.red[at], found.green[at], found.blue[at]).as_dvec3() - light).abs().max_element();
        assert!(
            error < EXACT && (found.coverage[at] as f64 - 1.0 + left).abs() < EXACT,
            "pixel {at}: off by {error:.1e}"
        );
    }
}

#[test]
fn exact_takes_no_shortcut() {
    for quality in [Quality::EXACT, Quality::REFERENCE] {
        let CloudSettings { detail, opaque, hidden, cell, .. } = quality.cloud;
        assert_eq!((detail, opaque, hidden, cell), (f32::INFINITY, 0.0, 0.0, 1));
    }
    // Cells that always are cut give each pixel's own ray.
    let clouds = || vec![cloud(ball(32, 4.0), 5.0)];
    let solid = |_| (0.0, 0.0);
    let every = bits(&tile(clouds(), DAY, exact(), solid));
    let corners = tile(clouds(), DAY, CloudSettings { cell: 8, threshold: -1.0, ..exact() }, solid);
    assert!(bits(&corners) == every);
}

#[test]
fn cells_are_off_by_less_than_their_threshold() {
    let clouds = || vec![cloud(ball(32, 9.0), 5.0)];
    let every = tile(clouds(), FURNACE, CloudSettings { steps: 100, ..exact() }, |_| (0.0, 0.0));
    let mut last = f32::INFINITY;
    for threshold in [0.1, 0.03, 0.01, 0.003] {
        let cells =
            tile(clouds(), FURNACE, CloudSettings { steps: 100, cell: 8, threshold, ..exact() }, |_| (0.0, 0.0));
        let squares: f32 = every.red.iter().zip(cells.red.iter()).map(|(a, b)| (a - b) * (a - b)).sum();
        let error = (squares / Tile::AREA as f32).sqrt();
        println!("threshold {threshold}: rms {error}");
        assert!(error < 0.2 * threshold && error < last, "{threshold}: {error}");
        // Nothing goes beyond what rays met.
        let beyond = cells.coverage.iter().fold(0.0, |most: f32, share| most.max(-share).max(share - 1.0));
        assert!(beyond < 1e-6, "{threshold}: {beyond} beyond none and all");
        last = error;
    }
}

fn is_close(names: &[&str], width: usize, height: usize) {
    // The target of adaptive pictures.
    const DECIBELS: f64 = 40.0;
    let mut renderer = Renderer::new(2).unwrap();
    for name in names {
        let [fast, exact] = [Quality::FAST, Quality::EXACT].map(|quality| {
            let mut frame = Frame::new(width, height);
            renderer.render(&scenes::named(name).unwrap(), 2.0, &quality, &mut frame);
            frame
        });
        let decibels = Difference::between(&fast, &exact).psnr();
        println!("{name}: {decibels:.1} dB");
        assert!(decibels > DECIBELS, "{name}: {decibels:.1} dB");
    }
}

#[test]
fn fast_is_close_to_exact() {
    is_close(&["sky-of-clouds"], 400, 225);
}

/// Clouds of few pixels get few steps, so the target is for this size.
#[test]
#[ignore = "long: run by .ci/run"]
fn fast_is_close_to_exact_at_the_size_that_is_played() {
    is_close(&["cumulus", "cumulus-inside", "sky-of-clouds"], 1280, 720);
}

fn levels_agree(settings: CloudSettings) {
    let clouds =
        || vec![cloud(ball(32, 4.0), 5.0), Cloud { centre: vec3a(0.5, 0.5, -1.0), ..cloud(ball(16, 2.0), 3.0) }];
    let mut first = None;
    for (name, level) in levels() {
        let layer = CloudLayer::new(clouds(), DAY, &view(), &CloudSettings { steps: 100, ..settings })
            .in_air(100.0, |_| Vec3A::ONE);
        let mut tile = Tile::at(0, 0, 64, 50);
        for at in 0..Tile::AREA {
            tile.coverage[at] = (at % 3) as f32 * 0.5;
            tile.inv_depth[at] = 0.3;
        }
        layer.draw(level, &mut tile);
        assert!(*first.get_or_insert_with(|| bits(&tile)) == bits(&tile), "{name}");
    }
}

#[test]
fn every_level_draws_the_same_bits() {
    levels_agree(Quality::FAST.cloud);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn every_level_draws_the_same_bits_of_64_samples() {
    levels_agree(Quality::REFERENCE.cloud);
}
