//! Frames a second against fires, as in a thesis of 2008.

use crate::{SIZE, Stage, camera};
use glam::{Vec3, vec3};
use paprsek::frame::FrameSpec;
use paprsek::frame::Layer;
use paprsek::particles::ParticleLayer;
use paprsek::particles::fire::Fire;
use paprsek::scenes::bench::particles::{FIRE_SKY, fires, over};
use paprsek::settings::Quality;
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;

/// Where the fires of a case burn.
pub struct Case {
    name: &'static str,
    /// Frames a second of the thesis.
    theirs: f64,
    /// Metres before the eye, and to the right.
    places: &'static [(f32, f32)],
}

const CASES: [Case; 6] = [
    Case { name: "none", theirs: 60.0, places: &[] },
    Case { name: "near", theirs: 30.0, places: &[(2.2, 0.0)] },
    Case { name: "in the hand", theirs: 44.0, places: &[(0.6, 0.2)] },
    Case { name: "at the house", theirs: 54.0, places: &[(8.0, 0.0)] },
    Case { name: "two at the house", theirs: 51.0, places: &[(8.0, -1.5), (8.0, 1.5)] },
    Case { name: "three at the house", theirs: 48.0, places: &[(8.0, -1.5), (8.0, 0.0), (8.0, 1.5)] },
];

/// Metres from where a fire burns to its middle.
pub const MIDDLE: f32 = 0.7;

/// One of the bench scene's torches, with its 2000 sprites, in the origin.
pub fn torch(time: f64) -> Fire {
    Fire { place: Vec3::ZERO, ..fires(time)[0] }
}

/// The fires of a case before an eye that looks at them; particles for each pixel of height.
fn particles(case: &Case, shot: &FrameSpec, detail: f32) -> ParticleLayer {
    let middle = Vec3::Y * MIDDLE;
    let view = View::new(camera(middle, middle + Vec3::NEG_Z), SIZE.0, SIZE.1);
    let fire = |(number, (before, right)): (usize, &(f32, f32))| {
        let place = vec3(*right, 0.0, -before);
        Fire { place, first: 2000 * number as u32, ..torch(shot.time) }.detailed(&view, detail)
    };
    ParticleLayer::fire(case.places.iter().enumerate().map(fire).collect(), 1.6, &view, SIZE.0, SIZE.1)
}

/// Appends the table.
pub fn report(text: &mut String, stage: &mut Stage) -> Result<(), Box<dyn Error>> {
    writeln!(
        text,
        "\n## Fire\n\nTorches of the bench scene `fire`, 2000 sprites each, over its background, at `fast`: near, 2.2 m away, a fire fills most of the height; in the hand is 0.6 m away, at the house 8 m. All: every sprite of each; level of detail: as `particle_detail` has it at `fast`; sprites are those that the screen shows. The thesis (Pilsen 2008) drew a level of its game at 1680x1050 on a GeForce 7600. Milliseconds more are beside none.\n"
    )?;
    writeln!(
        text,
        "| fires | thesis: fps | ms more | all: sprites | fps | ms more | with level of detail: sprites | fps | ms more |\n|---|{}",
        "--:|".repeat(8)
    )?;
    let details = [f32::INFINITY, Quality::FAST.particles.detail];
    let cases: Vec<_> = CASES.iter().flat_map(|case| details.map(|detail| (case, detail))).collect();
    let fps = stage.fps(&cases, |(case, detail), shot| over(shot, FIRE_SKY, particles(case, shot, *detail)));
    for (case, fps_of) in CASES.iter().zip(fps.chunks_exact(2)) {
        write!(text, "| {} | {:.0} | {:.1}", case.name, case.theirs, 1e3 / case.theirs - 1e3 / CASES[0].theirs)?;
        for k in 0..2 {
            let mut particles = particles(case, &stage.shot(crate::START), details[k]);
            particles.prepare(stage.renderer.workers(), stage.renderer.cache());
            write!(text, " | {} | {:.1} | {:.2}", particles.drawn(), fps_of[k], 1e3 / fps_of[k] - 1e3 / fps[k])?;
        }
        writeln!(text, " |")?;
    }
    Ok(())
}
