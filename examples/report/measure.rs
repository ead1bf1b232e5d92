//! What each point of a sweep takes, and how far its picture is from the true one.

use crate::maps;
use crate::metrics::Error;
use crate::subject::Subject;
use crate::sweep::{Point, Sweep, Truth};
use fearless_simd::Level;
use paprsek::frame::{Frame, Renderer};
use std::collections::HashMap;
use std::time::Instant;

/// How much is measured.
pub struct Effort {
    /// Pixels in a row, and rows.
    pub size: (usize, usize),
    /// Instants of each scene.
    pub instants: usize,
    /// Frames of a point that are timed; a multiple of the instants gives each as many.
    pub rounds: usize,
    /// Threads of all but the sweep of threads.
    pub threads: usize,
}

/// A point of a sweep in one scene.
pub struct Row {
    /// The setting.
    pub point: Point,
    /// Median milliseconds of a frame.
    pub ms: f64,
    /// How many times faster than the truth's cheapest form, `exact` or the dome at every pixel, on all threads: the median of the ratios within each round.
    pub ratio: f64,
    /// Eye rays a pixel, or fragments.
    pub samples: f64,
    /// Mean over the instants.
    pub error: Error,
}

/// Median milliseconds of `exact`, of the dome at every pixel in its own sweeps, and every point.
pub struct Table {
    /// Of the same rounds as the rows.
    pub exact_ms: f64,
    /// In the sweep's order.
    pub rows: Vec<Row>,
}

impl Table {
    /// Does the knob change anything in this scene?
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
    /// What a picture was off, and the samples it took: the same setting comes in several sweeps.
    errors: HashMap<String, (Error, f64)>,
}

impl<'a> Bench<'a> {
    /// Nothing is known of the scene yet.
    pub fn new(effort: &'a Effort, subject: &'a Subject, renderers: &'a mut Renderers) -> Bench<'a> {
        Bench { effort, subject, renderers, truths: HashMap::new(), errors: HashMap::new() }
    }

    /// All points of a sweep.
    pub fn measure(&mut self, sweep: &Sweep) -> Table {
        let (exact_ms, times) = self.time(sweep);
        let rows = sweep.points.iter().zip(times).map(|(point, (ms, ratio))| {
            let (error, samples) = self.error(point, sweep.truth);
            Row { point: point.clone(), ms, ratio, samples, error }
        });
        Table { exact_ms, rows: rows.collect() }
    }

    /// Milliseconds of `exact`; then of each point, and how many times faster that is.
    ///
    /// A round draws `exact` and every point once, so that whatever else the machine does hits all alike.
    fn time(&mut self, sweep: &Sweep) -> (f64, Vec<(f64, f64)>) {
        let mut exact = Vec::new();
        let mut times = vec![Vec::new(); sweep.points.len()];
        let truth = if sweep.truth == Truth::Dome { Truth::Dome } else { Truth::Exact }.of(&sweep.points[0]);
        let mut frame = Frame::new(self.effort.size.0, self.effort.size.1);
        let instants = self.effort.instants;
        for round in 0..self.effort.rounds {
            let mut timed = |point: &Point| {
                maps::forget(self.renderers.with(point.threads.unwrap_or(self.effort.threads), point.level));
                let began = Instant::now();
                self.render(point, round % instants, &mut frame);
                began.elapsed().as_secs_f64() * 1000.0
            };
            if round == 0 {
                // Memory is fetched and kernels are read before the clock counts.
                timed(&truth);
            }
            exact.push(timed(&truth));
            for (point, times) in sweep.points.iter().zip(&mut times) {
                times.push(timed(point));
            }
        }
        let summary = |times: &Vec<f64>| {
            let ratios = exact.iter().zip(times).map(|(exact, ms)| exact / ms).collect();
            (median(times.clone()), median(ratios))
        };
        (median(exact.clone()), times.iter().map(summary).collect())
    }

    /// How far the point's pictures are off, and the samples a pixel that they take.
    fn error(&mut self, point: &Point, truth: Truth) -> (Error, f64) {
        // The number of threads changes no byte; tests see to that.
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

    /// Draws a point at an instant; returns its samples.
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
    /// The renderer on that many threads, at that SIMD level or the machine's best.
    pub fn with(&mut self, threads: usize, level: Option<Level>) -> &mut Renderer {
        let level = level.unwrap_or_else(Level::new);
        let renderer = match self.0.remove(&threads) {
            Some(renderer) => renderer.at_level(level),
            None => Renderer::new(threads).expect("threads can be started").at_level(level),
        };
        self.0.entry(threads).or_insert(renderer)
    }
}

/// Of an even number the mean of the middle two.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len().is_multiple_of(2) { 0.5 * (values[half - 1] + values[half]) } else { values[half] }
}
