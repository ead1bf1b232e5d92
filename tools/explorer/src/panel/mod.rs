//! What is drawn over the picture: the panel, the help, and the line below.

mod graph;
mod help;
mod hud;
mod keyed;
mod row;
mod study;
mod turn;

pub use graph::Graph;
pub use help::help;
pub use hud::hud;
pub use study::{compared, legend, probed};
pub use turn::{Turned, panel};

use egui::{Color32, Context, CornerRadius, FontFamily, FontId, Frame, Margin, Stroke, TextStyle, Visuals};

/// What is under text: dark enough to read it over snow.
pub const GROUND: Color32 = Color32::from_rgba_premultiplied(14, 16, 20, 236);
/// What is usual.
pub const QUIET: Color32 = Color32::from_rgb(168, 174, 184);
/// What has been changed, and what is to be noticed.
pub const LOUD: Color32 = Color32::from_rgb(255, 196, 92);

/// A frame of that ground.
pub fn ground() -> Frame {
    Frame::new().fill(GROUND).inner_margin(Margin::same(8)).corner_radius(CornerRadius::same(4))
}

/// Colours and sizes of all text.
pub fn dress(ctx: &Context) {
    let mut visuals = Visuals::dark();
    visuals.override_text_color = Some(Color32::from_rgb(232, 234, 238));
    visuals.window_fill = GROUND;
    visuals.panel_fill = GROUND;
    visuals.window_stroke = Stroke::NONE;
    visuals.window_shadow = egui::Shadow::NONE;
    visuals.popup_shadow = egui::Shadow::NONE;
    visuals.slider_trailing_fill = true;
    visuals.selection.bg_fill = Color32::from_rgb(46, 104, 168);
    ctx.set_visuals(visuals);
    ctx.style_mut(|style| {
        let font = |size| FontId::new(size, FontFamily::Proportional);
        style.text_styles.insert(TextStyle::Body, font(13.0));
        style.text_styles.insert(TextStyle::Button, font(13.0));
        style.text_styles.insert(TextStyle::Heading, font(15.0));
        style.text_styles.insert(TextStyle::Small, font(11.0));
        style.text_styles.insert(TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace));
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        // Motion would repaint the panel for its own sake.
        style.animation_time = 0.0;
    });
}

/// Whether a picture has room for one thing at a time only.
pub fn is_narrow(ctx: &Context) -> bool {
    ctx.content_rect().width() < 640.0
}

/// Pixels per point: text is larger on large pictures.
pub fn scale(height: usize) -> f32 {
    match height {
        0..1300 => 1.0,
        1300..2000 => 1.5,
        _ => 2.0,
    }
}
