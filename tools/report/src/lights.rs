//! Frames per second against the number of objects and the number of lights, beside the tables that `[Sun07]` measured on a
//! graphics card; and what one pass over the visible pixels saves of drawing the scene once per light. Writes `lights.md`
//! and `lights.svg`.
//!
//! The scene is cubes on a plane under suns that move, each with a shadow map of 1024^2 texels.

use crate::options::{Common, Result};
use crate::plot;
use glam::{Affine3A, Mat3A, Vec2, Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::raster::{Bias, Body, Haze, Light, Mesh, Paint, Projection, RasterLayer, ShadowViews, World, fit};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;
use plotters::prelude::*;
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use testkit::median;

const SIZE: (usize, usize) = (1280, 720);
const THREADS: usize = 2;
const MAP: u32 = 1024;
/// Edge of the plane, metres. It has room for 32 x 32 cubes.
const FIELD: f32 = 64.0;
const ROW: usize = 32;

/// Frames per second of the thesis by the number of objects under one light, and by the number of lights over 80 objects.
const OBJECTS: [(usize, f64); 5] = [(1, 32.1), (12, 26.4), (32, 23.0), (64, 20.0), (128, 10.7)];
const LIGHTS: [(usize, f64); 6] = [(1, 17.3), (2, 15.2), (3, 14.5), (4, 13.2), (5, 11.9), (6, 11.0)];
/// Number of objects under several lights.
const UNDER: usize = 80;
/// Numbers beyond those of the thesis.
const MORE_OBJECTS: [usize; 3] = [256, 512, 1024];
const MORE_LIGHTS: [usize; 2] = [7, 8];

/// How a frame is lit.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Suns from all around, with one map each.
    Suns,
    /// Lamps spread over the plane, without shadows, with this reach in metres.
    Lamps(f32),
    /// The same, each with a cube of six maps of 256^2 texels.
    CubeLamps(f32),
}

/// One way to draw the scene.
#[derive(Clone, Copy)]
struct Case {
    objects: usize,
    kind: Kind,
    lights: usize,
    /// Whether the scene is drawn once per light, as on a graphics card of 2007, instead of once.
    apart: bool,
    /// Whether the lights rest, so that their maps are kept from the frame before.
    rest: bool,
    quality: Quality,
}

struct Stage {
    /// The plane, then the cubes.
    bodies: Vec<Body>,
    renderer: Renderer,
    frame: Frame,
    /// Number of frames so far, by which the lights move.
    count: usize,
}

impl Stage {
    fn new() -> Result<Stage> {
        let paint = |albedo| Paint { albedo, texture: None, gloss: 0.0 };
        let mut plane = Mesh::painted(&[paint(vec3a(0.6, 0.6, 0.55))]);
        for z in [1.0, -1.0] {
            plane.points.extend([-1.0, 1.0].map(|x| vec3a(x, 0.0, z) * (0.5 * FIELD)));
        }
        plane.loft(0, 2, 0, &[]);
        let mut cube = Mesh::painted(&[paint(vec3a(0.7, 0.35, 0.2))]);
        cube.block(&Mat3A::IDENTITY, Vec3A::ZERO, 0);
        let cube = Arc::new(cube);
        let place = |i: usize| {
            // 389 and 1024 have no common factor, so every cell is used once, and even few cubes are spread over the plane.
            let cell = (i * 389 + ROW * ROW / 2 + ROW / 2) % (ROW * ROW);
            let [x, z] = [cell % ROW, cell / ROW].map(|n| (n as f32 + 0.5 - 0.5 * ROW as f32) * FIELD / ROW as f32);
            let turn = Mat3A::from_rotation_y(i as f32) * 0.6;
            Body::new(cube.clone(), Affine3A { matrix3: turn, translation: vec3a(x, 0.6, z) })
        };
        let bodies = std::iter::once(Body::new(Arc::new(plane), Affine3A::IDENTITY)).chain((0..ROW * ROW).map(place));
        let renderer = Renderer::new(THREADS)?;
        Ok(Stage { bodies: bodies.collect(), renderer, frame: Frame::new(SIZE.0, SIZE.1), count: 0 })
    }

    /// Light number `index` of `count`.
    fn light(&self, kind: Kind, index: usize, count: usize) -> Light {
        let time = self.count as f32 * 0.01;
        let bias = Bias { constant: 0.02, slope: 1.0, normal: 1.0 };
        let shadow_views = |views| ShadowViews { smooth: false, ..ShadowViews::new(views, bias) };
        if kind == Kind::Suns {
            let (sin, cos) = (index as f32 * 2.4 + time).sin_cos();
            let towards = vec3a(cos, 0.8, sin).normalize();
            let view = Projection::parallel(towards, Vec3A::ZERO, 1.5 * FIELD, MAP);
            let color = Vec3A::splat(1.0 / count as f32);
            return Light::sun(towards, color).with_shadow(shadow_views(vec![view]));
        }
        // A spiral of equal areas, which turns.
        let radius = 0.45 * FIELD * ((index as f32 + 0.5) / count as f32).sqrt();
        let (sin, cos) = (index as f32 * 2.4 + time).sin_cos();
        let position = vec3a(radius * cos, 2.5, radius * sin);
        let (reach, shadow) = match kind {
            Kind::CubeLamps(reach) => (reach, Some(shadow_views(fit::cube(position, 256)))),
            Kind::Lamps(reach) => (reach, None),
            Kind::Suns => unreachable!("suns are made above"),
        };
        Light { shadow, ..Light::lamp(position, vec3a(1.5, 1.2, 0.8), Vec2::new(0.0, 0.1), reach) }
    }

    /// Draws a frame, and returns its milliseconds.
    fn draw(&mut self, case: &Case) -> f64 {
        self.count += 1;
        if case.rest {
            // Other cases have had their turn since, and the maps with them: this frame draws this case's anew.
            self.timed(case);
        }
        self.timed(case)
    }

    fn timed(&mut self, case: &Case) -> f64 {
        let lights: Vec<_> = (0..case.lights).map(|index| self.light(case.kind, index, case.lights)).collect();
        let passes: Vec<Vec<Light>> =
            if case.apart { lights.into_iter().map(|light| vec![light]).collect() } else { vec![lights] };
        let mut ms = 0.0;
        for lights in passes {
            let camera = Camera::look_at(vec3a(0.0, 26.0, 44.0), vec3a(0.0, 0.0, 4.0), 50f32.to_radians(), 0.0);
            let fog = vec3a(0.4, 0.5, 0.7);
            let world = World {
                lights,
                ambient: [Vec3A::splat(0.1); 2],
                haze: Haze::even(fog, 0.0),
                zenith: fog,
                background: Some(fog),
                ..World::new(self.bodies[..=case.objects].to_vec())
            };
            let began = Instant::now();
            let drawn = RasterLayer::new(world, &View::new(camera, SIZE.0, SIZE.1), &case.quality.raster);
            self.renderer.draw(Picture { layers: vec![Box::new(drawn)], transfer: Transfer::Srgb }, &mut self.frame);
            ms += began.elapsed().as_secs_f64() * 1e3;
        }
        ms
    }

    /// The median milliseconds of each case; cases take turns.
    fn time(&mut self, cases: &[Case], rounds: usize) -> Vec<f64> {
        let mut times = vec![Vec::new(); cases.len()];
        for round in 0..=rounds {
            for (case, times) in cases.iter().zip(&mut times) {
                let ms = self.draw(case);
                // The first round warms up: memory is allocated and touched.
                if round > 0 {
                    times.push(ms);
                }
            }
        }
        times.into_iter().map(median).collect()
    }
}

/// Frames per second of the thesis and ours, by a count of objects or lights.
struct Series {
    what: &'static str,
    counts: Vec<usize>,
    theirs: Vec<f64>,
    /// At `fast`, at `default`, and at `default` where lights rest.
    ours: [Vec<f64>; 3],
}

const NAMES: [&str; 4] = ["thesis, 2007", "fast", "default", "default, at rest"];

impl Series {
    fn lines(&self) -> [&Vec<f64>; 4] {
        [&self.theirs, &self.ours[0], &self.ours[1], &self.ours[2]]
    }

    /// Rows of cells: the counts; then for each series its frames per second, their ratio to the first column, and the
    /// milliseconds beyond the first column.
    fn cells(&self) -> Vec<Vec<String>> {
        let mut rows =
            vec![std::iter::once(self.what.to_string()).chain(self.counts.iter().map(usize::to_string)).collect()];
        for (name, line) in NAMES.iter().zip(self.lines()) {
            let row = |head: String, of: &dyn Fn(f64) -> String| {
                let cell = |k: usize| line.get(k).map_or(String::new(), |fps| of(*fps));
                std::iter::once(head).chain((0..self.counts.len()).map(cell)).collect::<Vec<_>>()
            };
            rows.push(row(format!("{name}, fps"), &|fps| format!("{fps:.1}")));
            rows.push(row("of the first".into(), &|fps| format!("{:.2}", fps / line[0])));
            rows.push(row("ms more".into(), &|fps| format!("{:.1}", 1e3 / fps - 1e3 / line[0])));
        }
        rows
    }

    fn markdown(&self) -> String {
        let mut text = String::new();
        for (index, row) in self.cells().iter().enumerate() {
            writeln!(text, "| {} |", row.join(" | ")).expect("memory");
            if index == 0 {
                writeln!(text, "|---|{}", "--:|".repeat(row.len() - 1)).expect("memory");
            }
        }
        text
    }
}

/// Draws the tables, and below them curves of the speed relative to the first column.
fn draw_tables(path: &Path, all: &[Series]) -> Result {
    let area = SVGBackend::new(path, (1160, 660)).into_drawing_area();
    area.fill(&WHITE)?;
    let [blue, orange, green, ..] = plot::COLOURS;
    let colours = [RGBColor(110, 110, 110), blue, orange, green];
    for (series, half) in all.iter().zip(area.split_evenly((1, all.len()))) {
        let (top, bottom) = half.split_vertically(300);
        let (head, height) = (140, 21);
        let width = (570 - head) / series.counts.len() as i32;
        for (y, row) in series.cells().iter().enumerate() {
            for (x, cell) in row.iter().enumerate() {
                let left = if x == 0 { 8 } else { 8 + head + (x as i32 - 1) * width };
                let right = left + if x == 0 { head } else { width };
                let (above, below) = (14 + y as i32 * height, 14 + (y as i32 + 1) * height);
                top.draw(&Rectangle::new([(left, above), (right, below)], BLACK.mix(0.5)))?;
                let colour = if y == 0 { BLACK } else { colours[(y - 1) / 3] };
                let style = ("sans-serif", 12).into_font().color(&colour);
                top.draw(&Text::new(cell.clone(), (left + 5, above + 4), style))?;
            }
        }
        let last = *series.counts.last().expect("something is counted") as f64;
        let mut chart = ChartBuilder::on(&bottom)
            .margin(10)
            .x_label_area_size(36)
            .y_label_area_size(48)
            .build_cartesian_2d((1.0..1.1 * last).log_scale(), 0.0..1.1)?;
        let mut mesh = chart.configure_mesh();
        mesh.x_label_formatter(&|count| format!("{count:.0}"));
        mesh.x_desc(series.what).y_desc("frames per second, relative to one").max_light_lines(0);
        mesh.bold_line_style(BLACK.mix(0.12)).draw()?;
        for ((name, line), colour) in NAMES.iter().zip(series.lines()).zip(colours) {
            let points = series.counts.iter().zip(line).map(|(count, fps)| (*count as f64, fps / line[0]));
            plot::line(&mut chart, name, &points.collect::<Vec<_>>(), colour, 3)?;
        }
        plot::legend(&mut chart, SeriesLabelPosition::LowerLeft)?;
    }
    Ok(area.present()?)
}

/// Measures frames per second against a count.
fn series(stage: &mut Stage, rounds: usize, what: &'static str, theirs: &[(usize, f64)], more: &[usize]) -> Series {
    let counts: Vec<usize> = theirs.iter().map(|row| row.0).chain(more.iter().copied()).collect();
    let case = |&count: &usize, quality, rest| match what {
        "objects" => Case { objects: count, kind: Kind::Suns, lights: 1, apart: false, rest, quality },
        _ => Case { objects: UNDER, kind: Kind::Suns, lights: count, apart: false, rest, quality },
    };
    let ways = [(Quality::FAST, false), (Quality::DEFAULT, false), (Quality::DEFAULT, true)];
    let cases: Vec<_> =
        counts.iter().flat_map(|count| ways.map(|(quality, rest)| case(count, quality, rest))).collect();
    let times = stage.time(&cases, rounds);
    let ours = [0, 1, 2].map(|first| times.iter().skip(first).step_by(ways.len()).map(|ms| 1e3 / ms).collect());
    Series { what, counts, theirs: theirs.iter().map(|row| row.1).collect(), ours }
}

/// Measures everything, and writes the tables and their curves.
pub fn run(options: &Common) -> Result {
    let (rounds, out) = (if options.quick { 3 } else { 25 }, &options.out);
    std::fs::create_dir_all(out)?;
    let mut stage = Stage::new()?;
    let (width, height) = SIZE;
    let mut text = format!(
        "# Objects and lights\n\n\
         Written by `{}`; not edited by hand.\n\n\
         {width}x{height}, {THREADS} threads, {}. Times are medians of {rounds} rounds in which all rows of a table take \
         turns. The scene is cubes on a plane under suns from all around, each with a shadow map of {MAP}² texels that is \
         drawn in every frame. The thesis (Pilsen 2007) measured its own scene on a graphics card: what can be compared is \
         how the speed falls. Lights at rest do not move, so their maps are kept.\n",
        options.command("lights"),
        stage.renderer.simd()
    );
    let tables = [
        series(&mut stage, rounds, "objects", &OBJECTS, &MORE_OBJECTS),
        series(&mut stage, rounds, "lights", &LIGHTS, &MORE_LIGHTS),
    ];
    for (table, head) in tables.iter().zip(["Objects under one light", "Lights over 80 objects"]) {
        write!(text, "\n## {head}\n\n{}", table.markdown())?;
    }
    draw_tables(&out.join("lights.svg"), &tables)?;
    text += "\n![objects and lights](lights.svg)\n";

    write!(
        text,
        "\n## One pass over the visible pixels, against one pass over the scene per light\n\n\
         Milliseconds per frame of 80 cubes at `default`. Passes per light are frames of one light each, added.\n\n\
         | lights | one pass | pass per light | gain |\n|--:|--:|--:|--:|\n"
    )?;
    let case =
        |kind, lights, apart| Case { objects: UNDER, kind, lights, apart, rest: false, quality: Quality::DEFAULT };
    let cases: Vec<_> = (1..=8).flat_map(|lights| [false, true].map(|apart| case(Kind::Suns, lights, apart))).collect();
    for (lights, times) in (1..).zip(stage.time(&cases, rounds).chunks_exact(2)) {
        writeln!(text, "| {lights} | {:.1} | {:.1} | {:.2} |", times[0], times[1], times[1] / times[0])?;
    }

    const REACH: f32 = 8.0;
    write!(
        text,
        "\n## Lamps spread over the plane\n\n\
         Milliseconds per frame of the same scene. Bounded lamps reach {REACH} metres of the plane's {FIELD}. A pass per \
         light draws the scene once for each lamp. With maps: a cube of six maps of 256² texels per lamp.\n\n\
         | lamps | bounded | unbounded | pass per light | gain | bounded, maps | unbounded, maps |\n\
         |--:|--:|--:|--:|--:|--:|--:|\n"
    )?;
    let counts = [1, 2, 4, 8, 16, 32];
    let row = |lights| {
        [
            case(Kind::Lamps(REACH), lights, false),
            case(Kind::Lamps(f32::INFINITY), lights, false),
            case(Kind::Lamps(REACH), lights, true),
            case(Kind::CubeLamps(REACH), lights, false),
            case(Kind::CubeLamps(f32::INFINITY), lights, false),
        ]
    };
    let cases: Vec<_> = counts.iter().flat_map(|&lights| row(lights)).collect();
    for (lights, t) in counts.iter().zip(stage.time(&cases, rounds.div_ceil(3)).chunks_exact(5)) {
        let gain = t[2] / t[0];
        writeln!(
            text,
            "| {lights} | {:.1} | {:.1} | {:.1} | {gain:.2} | {:.1} | {:.1} |",
            t[0], t[1], t[2], t[3], t[4]
        )?;
    }
    let file = out.join("lights.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}
