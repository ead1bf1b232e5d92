//! Frames on their way out: fitted to the window, or saved as PNG.

use crate::worker::Shown;
use paprsek::frame::Frame;
use std::path::{Path, PathBuf};

/// Fits pixels of `from` columns and rows to a picture of `width` x `height` pixels. While a window is being resized its
/// frame is still of another size, and the nearest pixels stand for it.
pub fn fit(old: &[u32], from: (usize, usize), pixels: &mut [u32], (width, height): (usize, usize)) {
    if from == (width, height) {
        pixels.copy_from_slice(old);
        return;
    }
    for (y, row) in pixels.chunks_exact_mut(width).enumerate() {
        let old = &old[y * from.1 / height * from.0..][..from.0];
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = old[x * from.0 / width];
        }
    }
}

/// Saves the frame under a name of its own.
pub fn save(out: &Path, shown: &Shown) -> Result<PathBuf, String> {
    let stem = format!("paprsek-{}-{:.3}", shown.request.scene.name, shown.request.time);
    let names = (1..).map(|number| if number == 1 { format!("{stem}.png") } else { format!("{stem}-{number}.png") });
    let path = names.map(|name| out.join(name)).find(|path| !path.exists()).ok_or("no name is free")?;
    write(&path, &shown.frame)?;
    Ok(path)
}

/// Writes a frame as PNG.
pub fn write(path: &Path, frame: &Frame) -> Result<(), String> {
    let (width, height) = (frame.width as u32, frame.height as u32);
    let saved = image::save_buffer(path, &frame.to_rgb(), width, height, image::ColorType::Rgb8);
    saved.map_err(|error| {
        // Half a picture is none.
        let _ = std::fs::remove_file(path);
        format!("{}: {error}", path.display())
    })
}
