//! The line below: what is shown, how fast, from where; and what is to be told.

use super::{LOUD, QUIET, ground};
use crate::model::Model;
use crate::worker::Shown;
use egui::{Align2, Area, Context, Id, RichText, vec2};

/// Shows the line at the lower edge, right of the panel.
pub fn hud(ctx: &Context, model: &Model, shown: Option<&Shown>, told: Option<&str>) {
    let room = ctx.available_rect();
    let at = vec2(room.left() + 8.0, -8.0);
    let show = |ui: &mut egui::Ui| {
        ground().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
            ui.set_max_width(room.width() - 32.0);
            if let Some(told) = told {
                ui.label(RichText::new(told).color(LOUD));
            }
            ui.horizontal_wrapped(|ui| {
                ui.label(RichText::new(model.scene.name).strong());
                let rate = if model.rate == 1.0 { String::new() } else { format!(" x{}", model.rate) };
                let pace = if model.playing { rate } else { " paused".into() };
                ui.label(format!("{:.2} s{pace}", model.time));
                if let Some(shown) = shown {
                    ui.label(format!("{:.1} ms", shown.ms));
                    let (threads, simd) = (shown.threads, shown.request.simd);
                    ui.label(RichText::new(format!("{threads} threads, {simd}")).color(QUIET));
                }
                if let Some(pose) = model.camera().filter(|_| model.pose.is_some() || model.flight.is_some()) {
                    let [x, y, z] = pose.eye.to_array();
                    ui.label(RichText::new(format!("{x:.1} {y:.1} {z:.1} m, {:.0}°", pose.heading)).color(QUIET));
                }
                let speed = model.flight.map_or(model.speed, |flight| flight.speed);
                ui.label(RichText::new(format!("{speed:.1} m/s")).color(QUIET));
                ui.label(RichText::new("F1 help").color(QUIET));
            });
        });
    };
    Area::new(Id::new("hud")).anchor(Align2::LEFT_BOTTOM, at).interactable(false).show(ctx, show);
}
