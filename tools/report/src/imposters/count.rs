//! Frames per second and loading time against the number of clouds.

use super::{SIZE, THREADS};
use crate::plot::{self, Axis, Curve};
use fearless_simd::{Level, dispatch};
use glam::{Vec3A, vec3a};
use paprsek::cloud::{Cloud, CloudKind, CloudLayer, CloudLight, Voxels, sunlight};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Cache, Frame, Layer, Picture, Renderer, Stats, Tile, Workers};
use paprsek::scenes::bench::cumulus_set as set;
use paprsek::settings::{CloudSettings, Quality};
use paprsek::simd::hash::rnd;
use paprsek::view::Camera;
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use testkit::median;

const COUNTS: [usize; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];
const EDGE: usize = 64;
const EXTINCTION: f32 = 30.0;

/// Clouds with nothing behind them.
struct Alone(CloudLayer);

impl Layer for Alone {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        self.0.prepare(workers, _cache);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        tile.solids_matter = true;
        tile.clear();
        self.0.draw(level, tile)
    }
}

/// One way to draw them.
struct Way {
    name: &'static str,
    quality: CloudSettings,
    /// Whether the sunlight of all shapes is baked anew in every frame.
    bakes: bool,
    /// Whether clouds outside of the view are handed on, too.
    all: bool,
}

fn grow(kind: u32) -> Voxels {
    dispatch!(Level::new(), simd => CloudKind::grow(simd, &CloudKind::CUMULUS, kind, EDGE))
}

fn bake(voxels: &mut Voxels) {
    dispatch!(Level::new(), simd => sunlight::bake(simd, voxels, set::sun(), EXTINCTION));
}

/// Draws a frame of `count` clouds as in `sky-of-clouds`, seen along its flight, and returns its milliseconds.
fn draw(renderer: &mut Renderer, frame: &mut Frame, shapes: &[Arc<Voxels>], count: usize, way: &Way, time: f64) -> f64 {
    let began = Instant::now();
    let mut shapes = shapes.to_vec();
    if way.bakes {
        for shape in &mut shapes {
            let mut voxels = Voxels::new(EDGE, shape.density().to_vec());
            bake(&mut voxels);
            *shape = Arc::new(voxels);
        }
    }
    let (eye, ahead) = set::camera(2, time);
    let camera = Camera::look_at(eye.as_vec3a(), (eye + ahead).as_vec3a(), 50f32.to_radians(), 0.0);
    let view = View::new(camera, SIZE.0, SIZE.1);
    let sides = view.sides();
    let mut clouds = Vec::new();
    for i in 0..count as u32 {
        let r = |k: u32| rnd(1, i, k);
        let size = 45.0 + 55.0 * r(3) * r(3);
        let centre = vec3a(1800.0 * (r(0) - 0.5), 130.0 + 0.45 * size + 12.0 * r(2), 1800.0 * (r(1) - 0.5));
        if way.all || sides.iter().all(|side| side.dot(centre - camera.eye) > -1.74 * size) {
            clouds.push(Cloud { voxels: shapes[i as usize % 4].clone(), centre, size, extinction: EXTINCTION });
        }
    }
    let light = CloudLight {
        ambient: [vec3a(0.22, 0.27, 0.36), vec3a(0.36, 0.42, 0.51)],
        towards: set::sun(),
        sun: vec3a(0.86, 0.78, 0.68),
        phase: [0.85, 0.5],
    };
    let clouds = CloudLayer::new(clouds, light, &view, &way.quality).in_air(1400.0, |_| Vec3A::ONE);
    renderer.draw(Picture { layers: vec![Box::new(Alone(clouds))], transfer: Transfer::Linear }, frame);
    began.elapsed().as_secs_f64() * 1e3
}

/// Appends a table with one row per name and one column per count.
fn table(text: &mut String, head: &str, counts: &[usize], rows: &[(String, Vec<f64>)]) -> Result<(), Box<dyn Error>> {
    let numbers: Vec<_> = counts.iter().map(usize::to_string).collect();
    writeln!(text, "| {head} | {} |\n|---|{}", numbers.join(" | "), "--:|".repeat(counts.len()))?;
    for (name, values) in rows {
        let values: Vec<_> = values.iter().map(|value| format!("{value:.1}")).collect();
        writeln!(text, "| {name} | {} |", values.join(" | "))?;
    }
    Ok(())
}

fn curves(counts: &[usize], rows: &[(String, Vec<f64>)]) -> Vec<Curve> {
    let points = |values: &[f64]| counts.iter().zip(values).map(|(x, y)| (*x as f64, *y, String::new())).collect();
    rows.iter().map(|(name, values)| Curve { name: name.clone(), points: points(values) }).collect()
}

/// Appends both tables, and writes their curves.
pub fn report(text: &mut String, out: &Path, quick: bool) -> Result<(), Box<dyn Error>> {
    let fast = Quality::FAST.cloud;
    let way = |name, quality| Way { name, quality, bakes: false, all: true };
    let ways = [
        way("fast", fast),
        way("sunlight baked in every frame", fast),
        way("steps not by size on the screen", CloudSettings { detail: f32::INFINITY, ..fast }),
        way("only clouds in the view handed on", fast),
        way("behind opaque clouds too", CloudSettings { hidden: 0.0, ..fast }),
        way("imposters, 1 pixel", CloudSettings { imposter: 1.0, ..fast }),
    ];
    let mut ways = ways;
    ways[1].bakes = true;
    ways[3].all = false;
    let shapes: Vec<_> = (0..4).map(set::shape).collect();
    let mut renderer = Renderer::new(THREADS)?;
    let mut frame = Frame::new(SIZE.0, SIZE.1);
    let rounds = if quick { 2 } else { 9 };
    let mut rows: Vec<_> = ways.iter().map(|way| (way.name.to_string(), Vec::new())).collect();
    for count in COUNTS {
        let mut times = vec![Vec::new(); ways.len()];
        for round in 0..=rounds {
            for (way, times) in ways.iter().zip(&mut times) {
                let ms = draw(&mut renderer, &mut frame, &shapes, count, way, 2.0 + f64::from(round) / 60.0);
                if round > 0 {
                    times.push(ms);
                }
            }
        }
        for (row, times) in rows.iter_mut().zip(times) {
            row.1.push(1e3 / median(times));
        }
    }
    writeln!(text, "\n## Number of clouds\n")?;
    writeln!(
        text,
        "Frames per second at `fast`, medians of {rounds} frames in which all rows take turns: the clouds of `sky-of-clouds`, and more of them, with nothing behind. Light towards the eye is computed for every ray and cannot be left out, so what is switched on and off is baking.\n"
    )?;
    table(text, "clouds", &COUNTS, &rows)?;
    let counts = &COUNTS[..if quick { 3 } else { 6 }];
    let mut loads = vec![("growth".to_string(), Vec::new()), ("sunlight".to_string(), Vec::new())];
    for count in counts {
        let (mut growth, mut sunlight) = (0.0, 0.0);
        for kind in 0..*count as u32 {
            let began = Instant::now();
            let mut voxels = grow(kind);
            growth += began.elapsed().as_secs_f64() * 1e3;
            let began = Instant::now();
            bake(&mut voxels);
            sunlight += began.elapsed().as_secs_f64() * 1e3;
        }
        loads[0].1.push(growth);
        loads[1].1.push(sunlight);
    }
    let sum = loads[0].1.iter().zip(&loads[1].1).map(|(a, b)| a + b).collect::<Vec<_>>();
    let each = sum.iter().zip(counts).map(|(sum, count)| sum / *count as f64).collect();
    loads.push(("both".into(), sum));
    loads.push(("both, per cloud".into(), each));
    writeln!(
        text,
        "\n## Loading\n\nMilliseconds for shapes of {EDGE}³ voxels, all of them different, on one thread.\n"
    )?;
    table(text, "shapes", counts, &loads)?;
    let axes = [Axis { name: "clouds" }, Axis { name: "frames per second" }];
    plot::draw(&out.join("imposters-count.svg"), &["number of clouds"], &[curves(&COUNTS, &rows)], axes)?;
    let axes = [Axis { name: "shapes" }, Axis { name: "milliseconds" }];
    plot::draw(&out.join("imposters-load.svg"), &["loading"], &[curves(counts, &loads)], axes)?;
    writeln!(text, "\n![by number of clouds](imposters-count.svg)\n\n![loading](imposters-load.svg)")?;
    Ok(())
}
