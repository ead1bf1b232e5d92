//! The show's parts, and the shots in them.

use paprsek::frame::Scene;
use paprsek::scenes::INTRO;
use paprsek::scenes::show::intro::{DARK, PARTS, brightness};
use paprsek::scenes::show::{clouds, day, lumen, torches};
use std::ops::Range;

/// A part of the show. Seconds are those of the show unless said otherwise.
pub struct Part {
    scene: Scene,
    /// When it starts, and when the next part does, seconds.
    pub seconds: Range<f64>,
    /// Where it starts, in seconds of the scene.
    from: f64,
    /// Where the scene's shots start, in seconds of the scene; the first at 0.
    cuts: Vec<f64>,
}

/// Every part, in the show's order.
pub fn all() -> Result<Vec<Part>, String> {
    let ends = PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]);
    let part = |(&(start, (scene, from)), end): (&(f64, (Scene, f64)), f64)| {
        Ok(Part { scene, seconds: start..end, from, cuts: cuts(&scene)? })
    };
    PARTS.iter().zip(ends).map(part).collect()
}

/// Where a scene's shots start, seconds.
fn cuts(scene: &Scene) -> Result<Vec<f64>, String> {
    // The days of the scene begin at four o'clock.
    let leap = day::LENGTH * (f64::from(day::LEAP) - 4.0) / 24.0;
    Ok(match scene.name {
        "lumen" => lumen::CUTS.iter().map(|shot| shot.0).collect(),
        // The next day is in another season.
        "day" => (0..4).flat_map(|day| [0.0, leap].map(|since| day::LENGTH * f64::from(day) + since)).collect(),
        "clouds" => clouds::SHOTS.iter().map(|shot| shot.0).collect(),
        "snowfall" => vec![0.0],
        "torches" => torches::SHOTS.iter().map(|shot| shot.0).collect(),
        name => return Err(format!("where are the cuts of {name}?")),
    })
}

impl Part {
    /// Its scene and when it plays, since a scene may come twice.
    pub fn name(&self) -> String {
        format!("`{}`, {} to {} s", self.scene.name, self.seconds.start, self.seconds.end)
    }

    /// The numbers of its frames in a film of the show at `fps` frames per second.
    pub fn frames(&self, fps: f64) -> Range<usize> {
        (self.seconds.start * fps).ceil() as usize..(self.seconds.end * fps).ceil() as usize
    }

    /// The number of the shot that runs at a time, by the show's own arithmetic.
    pub fn shot(&self, time: f64) -> Option<usize> {
        let own = self.from + (time - self.seconds.start);
        self.cuts.iter().rposition(|cut| *cut <= own)
    }

    /// When each of its shots starts and ends.
    pub fn shots(&self) -> Vec<Range<f64>> {
        let cuts = self.cuts.iter().map(|cut| self.seconds.start + (cut - self.from));
        let inside = cuts.filter(|cut| *cut > self.seconds.start && *cut < self.seconds.end);
        let edges: Vec<_> = [self.seconds.start].into_iter().chain(inside).chain([self.seconds.end]).collect();
        edges.windows(2).map(|pair| pair[0]..pair[1]).collect()
    }

    /// The middles of its shots, seconds. Longer shots are cut into equal pieces of at most `piece` seconds.
    pub fn instants(&self, piece: f64) -> impl Iterator<Item = f64> {
        self.shots().into_iter().flat_map(move |shot| {
            let length = shot.end - shot.start;
            let pieces = (length / piece).ceil();
            (0..pieces as usize).map(move |k| shot.start + length * (k as f64 + 0.5) / pieces)
        })
    }
}

/// Whether the show has its full light, and does not fade to a cut or from it.
pub fn is_lit(time: f64) -> bool {
    brightness(&DARK, INTRO.duration, time) == 1.0
}
