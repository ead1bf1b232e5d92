//! How a frame is put into a window over the X server's protocol, scaled, however large the window is.

use super::protocol::{SETUP_LENGTHS, Server, WAITS, bytes, request};
use paprsek::frame::{Frame, resample};

// Codes of requests (X11/Xproto.h).
const CLEAR_AREA: u32 = 61;
const PUT_IMAGE: u32 = 72;

/// The layout of an image: whole pixels.
const Z_PIXMAP: u32 = 2;
/// Words of a PutImage request before its pixels.
const PUT_IMAGE_HEAD: usize = 6;
/// Largest side of what is drawn, pixels: X counts them no further. In a larger window the picture is in the upper left
/// corner. A frame has at most half of that, and is scaled.
const MAX_SIDE: usize = 0x7fff;

/// Where frames are put.
pub struct Target {
    /// The window's number.
    pub window: u32,
    /// The number of the graphics context.
    pub context: u32,
    /// Bits of a pixel that are shown.
    pub depth: u32,
    /// Width and height of the window, pixels.
    pub size: (usize, usize),
}

/// A window that frames are put into.
pub trait Surface {
    /// The connection that they take.
    fn server(&mut self) -> &mut Server;

    /// Where they go.
    fn target(&self) -> Target;

    /// Whether the size has changed since this was asked last.
    fn take_resized(&mut self) -> bool;

    /// Hears what the server has said by now, and says whether Esc is among it. `None` where the server has hung up.
    fn leaves(&mut self) -> Option<bool>;
}

/// Puts a frame there, as large as it fits into the window at its own aspect, or begins to: Esc ends it. `None` where
/// the display is lost.
pub fn put(surface: &mut impl Surface, frame: &Frame) -> Option<()> {
    // Pixels that the longest request has room for. A picture is no wider, so that one row fits, and no higher either.
    let room = (surface.server().setup[SETUP_LENGTHS] >> 16) as usize;
    let room = room.saturating_sub(PUT_IMAGE_HEAD).clamp(1, MAX_SIDE);
    let Target { window, context, depth, size } = surface.target();
    let size = (size.0.min(room), size.1.min(room));
    let (columns, count) = resample::fit(frame, size);
    let (left, top) = (size.0.saturating_sub(columns) / 2, size.1.saturating_sub(count) / 2);
    let band_rows = room / columns;
    surface.server().waits = WAITS;
    if surface.take_resized() {
        // What was sent for another size may lie outside of this picture.
        surface.server().send(&[request(CLEAR_AREA, 0, 4), window, 0, 0])?;
    }
    let mut first = 0;
    while first < count {
        let rows = first..count.min(first + band_rows);
        let mut band = bytes(&[
            request(PUT_IMAGE, Z_PIXMAP, (PUT_IMAGE_HEAD + rows.len() * columns) as u32),
            window,
            context,
            columns as u32 | (rows.len() as u32) << 16,
            left as u32 | ((top + first) as u32) << 16,
            depth << 8,
        ]);
        band.extend_from_slice(&resample::rows(frame, columns, count, rows));
        surface.server().waits = WAITS;
        let mut rest = &*band;
        while !rest.is_empty() {
            // However long the whole frame takes, Esc ends at once.
            if surface.leaves()? {
                return Some(());
            }
            rest = &rest[surface.server().push(rest)?..];
        }
        first += band_rows;
    }
    Some(())
}
