//! The error of shadow maps against traced shadows: by the size of the map and the height of the sun, by the number of
//! cascades beside one warped map, and by the bias. Writes `shadows.md` and `shadows-*.svg`.

mod lookup;
mod set;
mod truth;
mod warp;

use crate::options::{Common, Result};
use crate::plot::{self, Axis, Curve};
use glam::Vec3A;
use paprsek::frame::Renderer;
use paprsek::raster::{Bias, ShadowViews};
use set::{Set, sun};
use std::fmt::Write;
use std::time::Instant;
use testkit::median;
use truth::Pixel;

/// Heights of the sun above the horizon, degrees.
const ELEVATIONS: [f32; 5] = [1.0, 5.0, 30.0, 60.0, 90.0];
/// The heights over which means are taken, degrees.
const USUAL: [f32; 3] = [5.0, 30.0, 60.0];
const THREADS: usize = 2;

/// How much is measured.
struct Effort {
    size: (usize, usize),
    maps: &'static [u32],
    rounds: usize,
}

const FULL: Effort = Effort { size: (640, 360), maps: &[256, 512, 1024, 2048, 4096], rounds: 7 };
const QUICK: Effort = Effort { size: (320, 180), maps: &[512, 1024], rounds: 1 };

/// The errors of a map, as sums over the pixels that face the sun.
#[derive(Clone, Copy, Default)]
struct Score {
    count: f64,
    /// The number of pixels on the wrong side of a half: lit ones found dark, and dark ones found lit.
    acne: f64,
    leaks: f64,
    /// Light lost and won where no shadow edge is within 1.5 texels.
    far_lost: f64,
    far_won: f64,
    /// Absolute difference of the light.
    error: f64,
}

impl Score {
    fn of(pixels: &[Pixel], seen: impl Fn(&Pixel) -> f32) -> Score {
        let mut score = Score { count: pixels.len().max(1) as f64, ..Score::default() };
        for pixel in pixels {
            let (seen, lit) = (seen(pixel) as f64, pixel.lit as u32 as f64);
            score.acne += (pixel.lit && seen < 0.5) as u32 as f64;
            score.leaks += (!pixel.lit && seen >= 0.5) as u32 as f64;
            score.error += (seen - lit).abs();
            if pixel.far {
                score.far_lost += (lit - seen).max(0.0);
                score.far_won += (seen - lit).max(0.0);
            }
        }
        score
    }

    fn add(&mut self, o: &Score) {
        self.count += o.count;
        self.acne += o.acne;
        self.leaks += o.leaks;
        self.far_lost += o.far_lost;
        self.far_won += o.far_won;
        self.error += o.error;
    }

    fn percent(&self, of: f64) -> f64 {
        100.0 * of / self.count
    }

    fn missed(&self) -> f64 {
        self.percent(self.acne + self.leaks)
    }

    fn cells(&self) -> String {
        format!(
            "{:.2} | {:.2} | {:.2} | {:.3} | {:.3} | {:.2}",
            self.missed(),
            self.percent(self.acne),
            self.percent(self.leaks),
            self.percent(self.far_lost),
            self.percent(self.far_won),
            self.percent(self.error)
        )
    }
}

const COLUMNS: &str = "wrong, % | acne | leaks | far, lost | far, won | light off";
const LINE: &str = "--:|--:|--:|--:|--:|--:|";

/// The errors of shadow views of the sun.
fn mapped(set: &Set, renderer: &mut Renderer, pixels: &[Pixel], towards: Vec3A, shadow_views: ShadowViews) -> Score {
    let shot = set.draw(renderer, &[(towards, Vec3A::ONE, Some(shadow_views))]);
    Score::of(pixels, |pixel| shot.pixels[pixel.index][0] / pixel.cosine)
}

/// Errors by the height of the sun and the size of the map.
fn heights(effort: &Effort, sets: &[Set], renderer: &mut Renderer, text: &mut String) -> Vec<Vec<Curve>> {
    let mut panels = Vec::new();
    for set in sets {
        let kind = if set.ends.is_empty() { "one map" } else { "four cascades" };
        write!(text, "\n## `{}`: {kind}, by the sun's height and texels along an edge\n\n", set.name).unwrap();
        writeln!(text, "| sun | map | {COLUMNS} | maps, ms | frame, ms | traced frame / this |").unwrap();
        writeln!(text, "|--:|--:|{LINE}--:|--:|--:|").unwrap();
        let mut curves = Vec::new();
        for elevation in ELEVATIONS {
            let towards = sun(set, elevation);
            let (mut pixels, tracer) = truth::pixels(set, renderer, towards);
            let all_views: Vec<_> =
                effort.maps.iter().map(|&size| set.shadow_views(set.views(towards, None, size))).collect();
            let traced = ShadowViews { traced: true, ..set.shadow_views(set.views(towards, None, 1024)) };
            let mut times = vec![[vec![], vec![], vec![]]; all_views.len()];
            for _ in 0..effort.rounds {
                let slow = set.draw(renderer, &[(towards, Vec3A::ONE, Some(traced.clone()))]).all;
                for (shadow_views, times) in all_views.iter().zip(&mut times) {
                    let shot = set.draw(renderer, &[(towards, Vec3A::ONE, Some(shadow_views.clone()))]);
                    for (times, value) in times.iter_mut().zip([shot.maps, shot.all, slow / shot.all]) {
                        times.push(value);
                    }
                }
            }
            let mut curve = Curve { name: format!("sun at {elevation}°"), points: Vec::new() };
            for ((shadow_views, times), size) in all_views.into_iter().zip(times).zip(effort.maps) {
                truth::mark(&mut pixels, &tracer, towards, &shadow_views.views);
                let score = mapped(set, renderer, &pixels, towards, shadow_views);
                let [maps, all, ratio] = times.map(median);
                writeln!(text, "| {elevation}° | {size} | {} | {maps:.1} | {all:.1} | {ratio:.2} |", score.cells())
                    .unwrap();
                curve.points.push((*size as f64, score.missed(), size.to_string()));
            }
            curves.push(curve);
            eprintln!("{} at {elevation} degrees", set.name);
        }
        panels.push(curves);
    }
    panels
}

/// Errors of cascades beside those of one map through a perspective.
fn warps(effort: &Effort, sets: &[Set], renderer: &mut Renderer, text: &mut String) -> Vec<Vec<Curve>> {
    let mut panels = Vec::new();
    let edge = if effort.rounds > 1 { 1024 } else { 512 };
    for set in sets {
        write!(text, "\n## `{}`: cascades beside a light-space perspective map\n\n", set.name).unwrap();
        writeln!(
            text,
            "| maps | texels, million | {COLUMNS} | drawn on one thread, ms | wrong at 5°, 30°, 60° | by the renderer |"
        )
        .unwrap();
        writeln!(text, "|---|--:|{LINE}--:|---|--:|").unwrap();
        // One warped map with at least as many texels as 1 to 4 cascades, and with more.
        let kinds: Vec<(Option<usize>, u32)> = (1..=4)
            .map(|n| (Some(n), edge))
            .chain(
                [1.0, 2f32.sqrt(), 3f32.sqrt(), 2.0, 3.0, 4.0]
                    .map(|k| (None, (edge as f32 * k / 64.0).ceil() as u32 * 64)),
            )
            .collect();
        let mut totals = vec![(Score::default(), Vec::new(), String::new(), Score::default()); kinds.len()];
        for elevation in USUAL {
            let towards = sun(set, elevation);
            let (mut pixels, tracer) = truth::pixels(set, renderer, towards);
            // What is far from edges is judged by the texels of the scene's own maps, which is the same for all.
            truth::mark(&mut pixels, &tracer, towards, &set.views(towards, None, edge));
            let views: Vec<_> = kinds
                .iter()
                .map(|&(cascades, size)| match cascades {
                    Some(_) => set.views(towards, cascades, size),
                    None => vec![warp::warped(set, towards, size)],
                })
                .collect();
            let mut maps: Vec<Vec<_>> =
                views.iter().map(|views| views.iter().map(|view| lookup::Map::new(*view)).collect()).collect();
            for _ in 0..effort.rounds {
                for ((maps, views), total) in maps.iter_mut().zip(&views).zip(&mut totals) {
                    let began = Instant::now();
                    maps.iter_mut().zip(views).for_each(|(map, view)| map.draw(set, *view));
                    total.1.push(began.elapsed().as_secs_f64() * 1e3);
                }
            }
            for (((maps, views), total), (cascades, _)) in maps.iter().zip(&views).zip(&mut totals).zip(&kinds) {
                let score = Score::of(&pixels, |pixel| lookup::light(maps, pixel, towards, &set.bias, set.smooth));
                total.0.add(&score);
                write!(total.2, "{:.2} ", score.missed()).unwrap();
                if cascades.is_some() {
                    total.3.add(&mapped(set, renderer, &pixels, towards, set.shadow_views(views.clone())));
                }
            }
            eprintln!("{} warped at {elevation} degrees", set.name);
        }
        let mut curves = ["cascades", "one warped map"].map(|name| Curve { name: name.into(), points: Vec::new() });
        for ((cascades, size), (score, times, each, check)) in kinds.into_iter().zip(totals) {
            let count = cascades.unwrap_or(1);
            let name = match cascades {
                Some(n) => format!("{n} x {size}²"),
                None => format!("warped {size}²"),
            };
            let texels = count as f64 * (size as f64).powi(2) * 1e-6;
            let ms = median(times);
            let check = if cascades.is_some() { format!("{:.2}", check.missed()) } else { String::new() };
            writeln!(text, "| {name} | {texels:.2} | {} | {ms:.1} | {each}| {check} |", score.cells()).unwrap();
            curves[cascades.is_none() as usize].points.push((ms, score.missed(), name));
        }
        panels.push(curves.into());
    }
    panels
}

/// A kind of bias, with its strengths by name and whether back faces are drawn.
type Family = (&'static str, Vec<(String, Bias, bool)>);

/// Kinds of bias. Constants are in metres, the others in texels.
fn families() -> Vec<Family> {
    let row = |of: fn(f32) -> Bias, back: bool, values: &[f32]| {
        values.iter().map(|&value| (value.to_string(), of(value), back)).collect::<Vec<_>>()
    };
    let texels = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0];
    vec![
        (
            "constant, m",
            row(|c| Bias { constant: c, slope: 0.0, normal: 0.0 }, false, &[0.0, 0.02, 0.1, 0.3, 1.0, 3.0]),
        ),
        ("slope", row(|s| Bias { constant: 0.02, slope: s, normal: 0.0 }, false, &texels)),
        ("normal", row(|n| Bias { constant: 0.02, slope: 0.0, normal: n }, false, &texels)),
        (
            "slope and normal alike",
            row(|k| Bias { constant: 0.02, slope: k, normal: k }, false, &[0.25, 0.5, 0.75, 1.0, 1.5, 2.0]),
        ),
        ("normal 0.5, slope", row(|s| Bias { constant: 0.02, slope: s, normal: 0.5 }, false, &texels)),
        (
            "back faces, slope",
            row(|s| Bias { constant: 0.0, slope: s, normal: 0.0 }, true, &[-1.0, -0.5, 0.0, 0.5, 1.0]),
        ),
        ("default", vec![("0.02, 2, 0".into(), Bias::SHOW, false)]),
    ]
}

/// Errors by the bias.
fn biases(effort: &Effort, set: &Set, renderer: &mut Renderer, text: &mut String) -> Vec<Curve> {
    let edge = if effort.rounds > 1 { 1024 } else { 512 };
    let families = families();
    let mut scores: Vec<Vec<Score>> = families.iter().map(|(_, row)| vec![Score::default(); row.len()]).collect();
    for elevation in USUAL {
        let towards = sun(set, elevation);
        let (mut pixels, tracer) = truth::pixels(set, renderer, towards);
        let views = set.views(towards, None, edge);
        truth::mark(&mut pixels, &tracer, towards, &views);
        for ((_, row), scores) in families.iter().zip(&mut scores) {
            for ((_, bias, back_faces), score) in row.iter().zip(scores) {
                let shadow_views =
                    ShadowViews { bias: *bias, back_faces: *back_faces, ..set.shadow_views(views.clone()) };
                score.add(&mapped(set, renderer, &pixels, towards, shadow_views));
            }
        }
    }
    write!(text, "\n## `{}`: bias, four cascades of {edge}², mean of 5°, 30° and 60°\n\n", set.name).unwrap();
    writeln!(text, "| bias | | {COLUMNS} |\n|---|--:|{LINE}").unwrap();
    let mut curves = Vec::new();
    for ((name, row), scores) in families.into_iter().zip(scores) {
        let mut curve = Curve { name: name.into(), points: Vec::new() };
        for ((label, ..), score) in row.into_iter().zip(scores) {
            writeln!(text, "| {name} | {label} | {} |", score.cells()).unwrap();
            curve.points.push((score.percent(score.far_won), score.percent(score.far_lost), label));
        }
        curves.push(curve);
    }
    curves
}

/// Measures both sets, and writes tables and curves.
pub fn run(options: &Common) -> Result {
    let (effort, out) = (if options.quick { QUICK } else { FULL }, &options.out);
    std::fs::create_dir_all(out)?;
    let sets = set::both(effort.size);
    let mut renderer = Renderer::new(THREADS)?;
    let (width, height) = effort.size;
    let mut text = format!(
        "# Shadow maps against traced shadows\n\n\
         Written by `{}`; not edited by hand.\n\n\
         {width}x{height}, one sample per pixel, {THREADS} threads. Times are medians of {} rounds in which all candidates \
         take turns; they hold for an idle machine. Every surface is white, so that a pixel shows the light that reaches \
         it.\n\n\
         * **wrong**: share of the pixels that face the sun (by more than 0.02 of its light) whose light lies on the other \
         side of one half than the traced light, in percent. **acne**: lit pixels found dark. **leaks**: dark pixels found \
         lit.\n\
         * **far**: light lost and light won at pixels more than 1.5 texels away from any shadow edge, in percent of the \
         same pixels: there a map has no excuse. **light off**: mean difference of the light, the softness of edges \
         included.\n",
        options.command("shadows"),
        effort.rounds
    );
    let panels = heights(&effort, &sets, &mut renderer, &mut text);
    let texels = Axis { name: "texels along an edge" };
    let wrong = Axis { name: "wrong pixels, %" };
    plot::draw(&out.join("shadows-size.svg"), &["bench", "day"], &panels, [texels, wrong])?;
    text += "\n![by size](shadows-size.svg)\n";
    let panels = warps(&effort, &sets, &mut renderer, &mut text);
    let ms = Axis { name: "drawing the maps on one thread, ms" };
    plot::draw(&out.join("shadows-warp.svg"), &["bench", "day"], &panels, [ms, wrong])?;
    text += "\n![cascades and a warped map](shadows-warp.svg)\n";
    let panels = [0, 1].map(|index| biases(&effort, &sets[index], &mut renderer, &mut text));
    let (won, lost) = (Axis { name: "light won far from edges, %" }, Axis { name: "light lost, %" });
    plot::draw(&out.join("shadows-bias.svg"), &["bench", "day"], &panels, [won, lost])?;
    text += "\n![bias](shadows-bias.svg)\n";
    let file = out.join("shadows.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}
