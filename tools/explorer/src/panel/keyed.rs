//! The camera's keys: a timeline, and a row for each.

use super::{LOUD, QUIET};
use crate::model::Model;
use egui::{Align2, CollapsingHeader, DragValue, FontId, RichText, Sense, Stroke, Ui, pos2, vec2};

/// Height of the timeline, points.
const HEIGHT: f32 = 22.0;

/// Shows the keys. Gives their rows where these are to be copied.
pub fn keyed(ui: &mut Ui, model: &mut Model) -> Option<String> {
    let mut rows = None;
    CollapsingHeader::new(format!("Camera's keys ({})", model.keys.keys().len())).id_salt("keys").show(ui, |ui| {
        ui.horizontal(|ui| {
            if ui.button("add").on_hover_text("a key where the camera is now (;)").clicked() {
                model.add_key();
            }
            let some = !model.keys.keys().is_empty();
            ui.add_enabled_ui(some, |ui| {
                ui.checkbox(&mut model.keyed, "play").on_hover_text("the camera goes by its keys")
            });
            if ui
                .add_enabled(some, egui::Button::new("copy rows"))
                .on_hover_text("as rows of the show's tables")
                .clicked()
            {
                rows = Some(model.keys.rows());
            }
        });
        timeline(ui, model);
        let keys = model.keys.keys().to_vec();
        for (number, key) in keys.iter().enumerate() {
            ui.horizontal(|ui| {
                let mut time = f64::from(key[0]);
                let drag = DragValue::new(&mut time).range(0.0..=model.scene.duration).speed(0.02).suffix(" s");
                if ui.add(drag.max_decimals(3)).changed() {
                    model.keys.put(number, time);
                }
                if ui.small_button("go").clicked() {
                    (model.time, model.playing) = (f64::from(key[0]), false);
                }
                if ui.small_button("delete").clicked() && number < model.keys.keys().len() {
                    model.keys.delete(number);
                }
                ui.label(RichText::new(format!("{:.1} {:.1} {:.1}", key[1], key[2], key[3])).small().color(QUIET));
            });
        }
    });
    rows
}

/// The time of the scene as a bar, with its keys and the time that is shown; a click goes there.
fn timeline(ui: &mut Ui, model: &mut Model) {
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width() - 4.0, HEIGHT), Sense::click_and_drag());
    let duration = model.scene.duration.max(1e-3);
    let at = |time: f64| area.left() + (time / duration) as f32 * area.width();
    let painter = ui.painter();
    painter.hline(area.x_range(), area.center().y, Stroke::new(2.0, QUIET));
    for key in model.keys.keys() {
        painter.circle_filled(pos2(at(f64::from(key[0])), area.center().y), 4.5, LOUD);
    }
    painter.vline(at(model.time), area.y_range(), Stroke::new(1.0, egui::Color32::WHITE));
    painter.text(area.right_top(), Align2::RIGHT_TOP, format!("{duration:.0} s"), FontId::proportional(9.0), QUIET);
    if let Some(pointer) = response.interact_pointer_pos() {
        let share = f64::from(((pointer.x - area.left()) / area.width()).clamp(0.0, 0.9999));
        (model.time, model.playing) = (share * duration, false);
    }
}
