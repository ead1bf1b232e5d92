//! Prints the table of kept frames as this target computes it: one line per frame, which ends in its hash.
//!
//! `frames [LEVEL|best] [EVERY]`: a SIMD level of this machine, by default the best, and the step from row to row, by
//! default 1. The first line is the level that kernels run at. It has one thread, which every target has.

use paprsek::frame::Renderer;
use paprsek::simd::level;
use std::env;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let wanted = arguments.next().unwrap_or("best".into());
    let every: usize = arguments.next().map_or(Ok(1), |step| step.parse())?;
    let levels = level::all();
    let level = match &*wanted {
        "best" => level::best(),
        name => levels.iter().find(|level| level.0 == name).ok_or(format!("this machine has no {name}"))?.1,
    };
    let mut renderer = Renderer::new(1)?.at_level(level);
    println!("{}", renderer.simd());
    for row in testkit::frames::rows().iter().step_by(every.max(1)) {
        println!("{}", row.line(&mut renderer));
    }
    Ok(())
}
