//! A row of the panel: a number with its name, unit, range and default, to be dragged, typed or reset.

use super::{LOUD, QUIET};
use egui::{DragValue, Rect, RichText, Slider, Ui};
use paprsek::frame::Parameter;

/// Ratio of a range from which on its slider is logarithmic.
const WIDE: f64 = 200.0;

/// Shows the number; gives its new value where it has been changed, and where its slider is.
pub fn row(ui: &mut Ui, parameter: &Parameter, value: f64, usual: f64) -> (Option<f64>, Rect) {
    let Parameter { name, unit, range: (least, most), about, .. } = *parameter;
    let mut new = value;
    let whole = unit == "count";
    let changed = value != usual;
    let response = ui.scope(|ui| {
        ui.horizontal(|ui| {
            ui.label(if changed { RichText::new(name).color(LOUD) } else { RichText::new(name) });
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let reset = ui.add_enabled(changed, egui::Button::new("reset").small());
                if reset.clicked() {
                    new = usual;
                }
                if !matches!(unit, "1" | "count") {
                    ui.label(RichText::new(unit).small().color(QUIET));
                }
                let speed = if whole { 1.0 } else { ((most - least) / 2000.0).max(1e-6) };
                let drag = DragValue::new(&mut new).range(least..=most).speed(speed);
                ui.add(if whole { drag.fixed_decimals(0) } else { drag.max_decimals(6) });
            });
        });
        ui.spacing_mut().slider_width = (ui.available_width() - 4.0).max(40.0);
        let slider = Slider::new(&mut new, least..=most).show_value(false);
        let slider = if least >= 0.0 && most > WIDE * least.max(usual.min(most)).max(1e-9) {
            slider.logarithmic(true).smallest_positive(if whole { 1.0 } else { most * 1e-5 })
        } else {
            slider
        };
        let slider = ui.add(if whole { slider.step_by(1.0) } else { slider }).rect;
        let text = format!("{} to {}, default {}", number(least), number(most), number(usual));
        ui.label(RichText::new(text).small().color(QUIET));
        slider
    });
    let slider = response.inner;
    response.response.on_hover_text(about);
    ui.add_space(2.0);
    ((new != value).then_some(new), slider)
}

/// A number as the panel has it: no more decimals than it takes.
fn number(value: f64) -> String {
    if value.is_infinite() { "no limit".into() } else { format!("{}", (value * 1e6).round() / 1e6) }
}
