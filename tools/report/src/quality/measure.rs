//! The time of each point of a sweep, and the error of its pictures.

use super::subject::Subject;
use super::sweep::{Point, Sweep, Truth};
use crate::metrics::Error;
use fearless_simd::Level;
use paprsek::frame::{Frame, Renderer};
use std::collections::HashMap;
use std::time::Instant;
use testkit::drawn::forget_maps;
use testkit::median;

/// How much is measured.
pub struct Effort {
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Number of instants of each scene.
    pub instants: usize,
    /// Number of timed frames of a point. A multiple of the instants treats them alike.
    pub rounds: usize,
    /// Number of threads of all but the sweep of threads.
    pub threads: usize,
}

/// A point of a sweep in one scene.
pub struct Row {
    /// The setting.
    pub point: Point,
    /// Median milliseconds of a frame.
    pub ms: f64,
    /// The interval that holds that median with 95 % or more, milliseconds; of few rounds all that was seen.
    pub interval: [f64; 2],
    /// Speed relative to `exact`, or to the dome at every pixel, on all threads: the median of the ratios within each
    /// round.
    pub ratio: f64,
    /// Eye rays per pixel, or shaded fragments.
    pub samples: f64,
    /// Mean over the instants.
    pub error: Error,
}

/// All points of a sweep in one scene.
pub struct Table {
    /// Median milliseconds of `exact`, or of the dome at every pixel, in the same rounds as the rows.
    pub exact_ms: f64,
    /// In the sweep's order.
    pub rows: Vec<Row>,
}

impl Table {
    /// Whether the knob changes anything in this scene.
    pub fn matters(&self) -> bool {
        let first = &self.rows[0];
        let same = |row: &Row| row.samples == first.samples && row.error.square == first.error.square;
        first.point.level.is_some() || first.point.threads.is_some() || !self.rows.iter().all(same)
    }
}

/// Measures in one scene.
pub struct Bench<'a> {
    effort: &'a Effort,
    subject: &'a Subject,
    /// By number of threads.
    renderers: &'a mut Renderers,
    truths: HashMap<(Truth, usize), Frame>,
    /// Error and samples by setting, as the same setting is a point of several sweeps.
    errors: HashMap<String, (Error, f64)>,
}

impl<'a> Bench<'a> {
    /// Starts without a measurement.
    pub fn new(effort: &'a Effort, subject: &'a Subject, renderers: &'a mut Renderers) -> Bench<'a> {
        Bench { effort, subject, renderers, truths: HashMap::new(), errors: HashMap::new() }
    }

    /// Measures all points of a sweep.
    pub fn measure(&mut self, sweep: &Sweep) -> Table {
        let (exact_ms, times) = self.time(sweep);
        let rows = sweep.points.iter().zip(times).map(|(point, (ms, interval, ratio))| {
            let (error, samples) = self.error(point, sweep.truth);
            Row { point: point.clone(), ms, interval, ratio, samples, error }
        });
        Table { exact_ms, rows: rows.collect() }
    }

    /// Returns the milliseconds of `exact`; then the milliseconds of each point, their interval, and its speed relative to `exact`.
    ///
    /// Each round draws `exact` and every point once, so that other load on the machine affects all of them alike.
    fn time(&mut self, sweep: &Sweep) -> (f64, Vec<(f64, [f64; 2], f64)>) {
        let mut exact = Vec::new();
        let mut times = vec![Vec::new(); sweep.points.len()];
        let truth = if sweep.truth == Truth::Dome { Truth::Dome } else { Truth::Exact }.of(&sweep.points[0]);
        let mut frame = Frame::new(self.effort.size.0, self.effort.size.1);
        let instants = self.effort.instants;
        for round in 0..self.effort.rounds {
            let mut timed = |point: &Point| {
                forget_maps(self.renderers.with(point.threads.unwrap_or(self.effort.threads), point.level));
                let began = Instant::now();
                self.render(point, round % instants, &mut frame);
                began.elapsed().as_secs_f64() * 1000.0
            };
            if round == 0 {
                // Warms up: memory is touched and kernels are in the cache before the clock counts.
                timed(&truth);
            }
            exact.push(timed(&truth));
            for (point, times) in sweep.points.iter().zip(&mut times) {
                times.push(timed(point));
            }
        }
        let summary = |times: &Vec<f64>| {
            let ratios = exact.iter().zip(times).map(|(exact, ms)| exact / ms).collect();
            (median(times.clone()), interval(times, instants), median(ratios))
        };
        (median(exact.clone()), times.iter().map(summary).collect())
    }

    /// The error of the point's pictures, and their samples per pixel.
    fn error(&mut self, point: &Point, truth: Truth) -> (Error, f64) {
        // The number of threads changes no byte, which tests hold, so it is not part of the key.
        let key = format!("{truth:?} {:?} {:?} {:?}", point.quality, point.dome, point.level);
        if let Some(known) = self.errors.get(&key) {
            return *known;
        }
        let instants = self.effort.instants;
        let (width, height) = self.effort.size;
        let mut samples = 0;
        let mut pictures = vec![Frame::new(width, height); instants];
        for (index, picture) in pictures.iter_mut().enumerate() {
            samples += self.render(point, index, picture);
            if !self.truths.contains_key(&(truth, index)) {
                let mut frame = Frame::new(width, height);
                self.render(&truth.of(point), index, &mut frame);
                self.truths.insert((truth, index), frame);
            }
        }
        let truths = &self.truths;
        let errors: Vec<Error> = std::thread::scope(|scope| {
            let judge = |(index, picture)| scope.spawn(move || Error::between(picture, &truths[&(truth, index)]));
            let running: Vec<_> = pictures.iter().enumerate().map(judge).collect();
            running.into_iter().map(|judge| judge.join().expect("a metric does not panic")).collect()
        });
        let known = (Error::mean(&errors), samples as f64 / (width * height * instants) as f64);
        self.errors.insert(key, known);
        known
    }

    /// Draws a point at an instant, and returns the number of its samples.
    fn render(&mut self, point: &Point, instant: usize, frame: &mut Frame) -> u64 {
        let renderer = self.renderers.with(point.threads.unwrap_or(self.effort.threads), point.level);
        let picture = self.subject.picture(instant, point, self.effort.size, renderer);
        renderer.draw(picture, frame).samples
    }
}

/// A renderer for each number of threads, started once.
#[derive(Default)]
pub struct Renderers(HashMap<usize, Renderer>);

impl Renderers {
    /// The renderer with that number of threads, at that SIMD level or the machine's best.
    pub fn with(&mut self, threads: usize, level: Option<Level>) -> &mut Renderer {
        let level = level.unwrap_or_else(Level::new);
        let renderer = match self.0.remove(&threads) {
            Some(renderer) => renderer.at_level(level),
            None => Renderer::new(threads).expect("threads can be started").at_level(level),
        };
        self.0.entry(threads).or_insert(renderer)
    }
}

/// The interval of the median that order statistics give with 95 % or more, whatever the distribution: of nine rounds the
/// second to the eighth. Instants take their turns and differ, so each time counts relative to the median of its instant.
fn interval(times: &[f64], instants: usize) -> [f64; 2] {
    let of = |instant| median(times.iter().skip(instant).step_by(instants).copied().collect());
    let medians: Vec<f64> = (0..instants).map(of).collect();
    let mut relative: Vec<f64> = times.iter().enumerate().map(|(round, ms)| ms / medians[round % instants]).collect();
    relative.sort_by(f64::total_cmp);
    // Ranks from both ends, as long as the tails of the binomial distribution beyond them stay below 2.5 % each.
    let count = relative.len();
    let (mut tail, mut term, mut rank) = (0.0, 0.5f64.powi(count as i32), 0);
    while tail + term <= 0.025 && 2 * (rank + 1) < count {
        tail += term;
        term *= (count - rank) as f64 / (rank + 1) as f64;
        rank += 1;
    }
    let whole = median(times.to_vec());
    let rank = rank.max(1) - 1;
    [relative[rank] * whole, relative[count - 1 - rank] * whole]
}
