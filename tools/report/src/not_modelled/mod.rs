//! What the renderers leave out: the error of leaving it out, against small reference renderers that have it, and what it
//! would cost.

mod air;
mod caustic;
mod ground;
mod lens;
mod scatter;
mod triangles;

use crate::machine;
use crate::metrics::Error;
use crate::options::{Common, Result};
use paprsek::frame::{Frame, encode};
use std::fs;

/// An effect that is left out, in one scene.
pub struct Row {
    /// The renderer, and what it lacks.
    pub what: &'static str,
    /// The scene, and the sizes that matter there.
    pub scene: String,
    /// What has it.
    pub reference: String,
    /// Error of the picture without, as the table shows it.
    pub error: String,
    /// Milliseconds per frame that it would add, and on what grounds.
    pub cost: String,
    /// Bytes packed, reckoned.
    pub bytes: &'static str,
}

/// Of a number uniform in 0 to 1: SplitMix64, so that the same table comes out again.
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Measures every effect, and writes `not-modelled.md`.
pub fn run(options: &Common) -> Result {
    let quick = options.quick;
    let mut text = format!(
        "# What is not modelled\n\nWritten by `{}`; not edited by hand.\n\n\
         What each renderer leaves out, and what that costs in likeness: the picture without against that of a reference \
         renderer that has it, both in 8-bit codes. The references are small, slow and written for this page \
         (`tools/report/src/not_modelled/`); where one draws both pictures, they differ in nothing else. **Milliseconds** are \
         reckoned for 1280x720 from what the reference took, on {}. **Bytes** are reckoned from modules of like size in \
         [size.md](../size.md), as nothing of it is in the packed file; they are not measured.\n\n\
         | left out | scene | reference | error of leaving it out | would cost, ms | bytes, packed |\n\
         |---|---|---|---|---|---|\n",
        options.command("not-modelled"),
        machine::machine(),
    );
    let mut rows = Vec::new();
    rows.extend(ground::rows(quick));
    eprintln!("shadows and light between surfaces: measured");
    rows.extend(caustic::rows(quick));
    rows.extend(scatter::rows(quick));
    eprintln!("caustics and clouds: measured");
    rows.extend(air::rows());
    rows.extend(lens::rows(quick)?);
    for Row { what, scene, reference, error, cost, bytes } in rows {
        text += &format!("| {what} | {scene} | {reference} | {error} | {cost} | {bytes} |\n");
    }
    text += "\nThe rasterizer's soft edges of shadows are a filter of the map, not a disc of the sun; the tracer has soft \
             shadows from lights with a size, in closed form (`src/trace/light.rs`), so nothing is missing there but the \
             shadow's exact profile. The blurs are means of frames with a dither of half a code, which by itself makes up to 60 dB. Depth of field is missing everywhere but in flakes close by, motion blur everywhere but \
             in drops of rain.\n";
    fs::create_dir_all(&options.out)?;
    fs::write(options.out.join("not-modelled.md"), &text)?;
    println!("{text}");
    Ok(())
}

/// The words for an error.
fn told(error: &Error) -> String {
    if error.square == 0.0 {
        return "none".into();
    }
    let (psnr, flip, flip99, bad) = (error.psnr(), error.flip, error.flip99, 100.0 * error.bad);
    format!("{psnr:.1} dB, FLIP {flip:.4}, 99 % {flip99:.3}, {bad:.1} % of pixels bad")
}

/// A frame of linear light, row by row.
fn frame(width: usize, height: usize, linear: &[[f64; 3]]) -> Frame {
    let mut frame = Frame::new(width, height);
    for (to, light) in frame.pixels.iter_mut().zip(linear) {
        let code = |c: f64| (255.0 * f64::from(encode::srgb_encode(c as f32))).round() as u32;
        *to = light.iter().fold(0, |all, c| all << 8 | code(c.clamp(0.0, 1.0)));
    }
    frame
}
