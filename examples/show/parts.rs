//! The show's parts, and the shots in them.

use paprsek::frame::Scene;
use paprsek::scenes::INTRO;
use paprsek::scenes::show::intro::{PARTS, brightness};
use paprsek::scenes::show::{clouds, day, lumen, torches};
use std::ops::Range;

/// A part of the show; seconds are those of the show where nothing else is said.
pub struct Part {
    scene: Scene,
    /// When it starts, and when the next one does.
    pub seconds: Range<f64>,
    /// Where it starts in the scene's own seconds.
    from: f64,
    /// Where the scene's shots start, in its own seconds; the first at 0.
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
    // Days start at four.
    let leap = day::LENGTH * (f64::from(day::LEAP) - 4.0) / 24.0;
    Ok(match scene.name {
        "lumen" => lumen::CUTS.iter().map(|shot| shot.0).collect(),
        // The next day is of another season.
        "day" => (0..4).flat_map(|day| [0.0, leap].map(|since| day::LENGTH * f64::from(day) + since)).collect(),
        "clouds" => clouds::SHOTS.iter().map(|shot| shot.0).collect(),
        "snowfall" => vec![0.0],
        "torches" => torches::SHOTS.iter().map(|shot| shot.0).collect(),
        name => return Err(format!("where are the cuts of {name}?")),
    })
}

impl Part {
    /// Its scene and when it plays: a scene may come twice.
    pub fn name(&self) -> String {
        format!("`{}`, {} to {} s", self.scene.name, self.seconds.start, self.seconds.end)
    }

    /// Numbers of its frames in a film of the show at `fps` frames a second.
    pub fn frames(&self, fps: f64) -> Range<usize> {
        (self.seconds.start * fps).ceil() as usize..(self.seconds.end * fps).ceil() as usize
    }

    /// Number of the shot that runs at a second, by the arithmetic of the show itself.
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
}

/// Is all of the light there, or does the show fade to a cut or from it?
pub fn is_lit(time: f64) -> bool {
    brightness(PARTS, INTRO.duration, time) == 1.0
}
