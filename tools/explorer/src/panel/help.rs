//! The help: every key.

use super::{LOUD, QUIET, ground};
use crate::keys::{HELP, pair};
use crate::model::Model;
use egui::{Align2, Context, Grid, RichText, ScrollArea, Ui, Window, vec2};

/// Width above which there are two columns, points.
const TWO: f32 = 760.0;
/// Width below which what a key does stands below the key, points.
const ONE: f32 = 340.0;

/// Shows the help in the middle of the picture.
pub fn help(ctx: &Context, model: &Model) {
    let room = ctx.available_rect();
    let window = Window::new("help").title_bar(false).resizable(false).frame(ground());
    let (width, height) = ((room.width() - 32.0).min(860.0), room.height() - 48.0);
    // Else a window has 420 points at first.
    let window = window.default_height(height);
    window.anchor(Align2::CENTER_CENTER, room.center() - ctx.content_rect().center()).show(ctx, |ui| {
        ui.set_width(width);
        ScrollArea::vertical().max_height(height).auto_shrink([false, true]).show(ui, |ui| {
            let parts = HELP.len() / 2;
            if width > TWO {
                ui.columns(2, |columns| {
                    HELP[..parts].iter().for_each(|group| keys(&mut columns[0], group));
                    HELP[parts..].iter().for_each(|group| keys(&mut columns[1], group));
                    pairs(&mut columns[1], model);
                });
            } else {
                HELP.iter().for_each(|group| keys(ui, group));
                pairs(ui, model);
            }
        });
    });
}

fn keys(ui: &mut Ui, (title, rows): &(&str, &[(&str, &str)])) {
    ui.label(RichText::new(*title).strong().color(LOUD));
    if ui.available_width() < ONE {
        for (keys, about) in *rows {
            ui.label(RichText::new(*keys).monospace());
            ui.label(*about);
        }
        return;
    }
    Grid::new(title).num_columns(2).spacing(vec2(12.0, 3.0)).show(ui, |ui| {
        for (keys, about) in *rows {
            ui.label(RichText::new(*keys).monospace());
            ui.add(egui::Label::new(*about).wrap());
            ui.end_row();
        }
    });
    ui.add_space(6.0);
}

/// The pairs of keys of this scene's parameters.
fn pairs(ui: &mut Ui, model: &Model) {
    let parameters = model.scene.parameters;
    if parameters.is_empty() {
        return;
    }
    ui.label(RichText::new(format!("More and less, in {}", model.scene.name)).strong().color(LOUD));
    Grid::new("pairs").num_columns(3).spacing(vec2(12.0, 3.0)).show(ui, |ui| {
        for (number, parameter) in parameters.iter().enumerate() {
            ui.label(RichText::new(pair(number)).monospace());
            ui.label(parameter.name);
            let unit = if ["1", "count"].contains(&parameter.unit) { "" } else { parameter.unit };
            ui.label(RichText::new(format!("{} {unit}", model.value(parameter))).color(QUIET));
            ui.end_row();
        }
    });
}
