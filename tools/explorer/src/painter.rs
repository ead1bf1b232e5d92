//! egui's shapes drawn over a frame's pixels.

use egui::{Context, FullOutput};
use egui_software_backend::{BufferMutRef, ColorFieldOrder, EguiSoftwareRender};

/// Draws what egui lays out.
pub struct Painter(EguiSoftwareRender);

impl Painter {
    /// A painter that has drawn nothing yet.
    pub fn new() -> Painter {
        // The bytes of 0x00RRGGBB from the lowest on.
        Painter(EguiSoftwareRender::new(ColorFieldOrder::Bgra))
    }

    /// Draws over `0RGB` pixels, width and height of which are `size`.
    pub fn paint(&mut self, ctx: &Context, output: FullOutput, pixels: &mut [u32], size: (usize, usize)) {
        let meshes = ctx.tessellate(output.shapes, output.pixels_per_point);
        let mut buffer = BufferMutRef::new(bytemuck::cast_slice_mut(pixels), size.0, size.1);
        self.0.render(&mut buffer, &meshes, &output.textures_delta, output.pixels_per_point);
    }
}
