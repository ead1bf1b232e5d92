//! Frames per second against fires, as in `[Fire08]`.

use super::{SIZE, Stage, camera};
use glam::{Vec3A, vec3a};
use paprsek::frame::FrameSpec;
use paprsek::frame::Layer;
use paprsek::particles::{Emitter, Fire, ParticleLayer};
use paprsek::scenes::bench::particles::{FIRE_SKY, fires, over};
use paprsek::settings::{ParticleSettings, Quality};
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;

/// Fires before the eye.
pub struct Case {
    name: &'static str,
    /// Frames per second of the thesis.
    theirs: f64,
    /// Places of the fires: metres before the eye, and metres to its right.
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

/// Height of a fire's middle above its place, metres.
pub const MIDDLE: f32 = 0.7;

/// One of the bench scene's torches with its 2000 sprites, at the origin.
pub fn torch(time: f64) -> Fire {
    Fire { place: Vec3A::ZERO, ..fires(time)[0] }
}

/// The fires of a case, with a level of detail in shares of the particles per pixel of height.
fn particles(case: &Case, shot: &FrameSpec, detail: f32) -> ParticleLayer {
    let middle = Vec3A::Y * MIDDLE;
    let view = View::new(camera(middle, middle + Vec3A::NEG_Z), SIZE.0, SIZE.1);
    let fire = |(number, (before, right)): (usize, &(f32, f32))| {
        let place = vec3a(*right, 0.0, -before);
        Fire { place, first: 2000 * number as u32, ..torch(shot.time) }
    };
    ParticleLayer::new(
        case.places.iter().enumerate().map(fire).map(Emitter::Fire).collect(),
        &view,
        &ParticleSettings { detail },
    )
}

/// Appends the table.
pub fn report(text: &mut String, stage: &mut Stage) -> Result<(), Box<dyn Error>> {
    writeln!(
        text,
        "\n## Fire\n\nTorches of the bench scene `fire`, 2000 sprites each, over its background, at `fast`. Near: 2.2 m away, where a fire fills most of the height. In the hand: 0.6 m away. At the house: 8 m away. All: every sprite of each fire. Level of detail: as `particle_detail` has it at `fast`. Sprites are those that are visible on the screen. The thesis (Pilsen 2008) drew a level of its game at 1680x1050 on a GeForce 7600. \"ms more\" is the time beyond a frame without fires.\n"
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
            let mut particles = particles(case, &stage.shot(super::START), details[k]);
            particles.prepare(stage.renderer.workers(), stage.renderer.cache());
            write!(text, " | {} | {:.1} | {:.2}", particles.drawn(), fps_of[k], 1e3 / fps_of[k] - 1e3 / fps[k])?;
        }
        writeln!(text, " |")?;
    }
    Ok(())
}
