//! The panel: every parameter of the scene, the camera, and every field of the settings.

use super::keyed::keyed;
use super::row::row;
use super::{GROUND, QUIET};
use crate::calendar;
use crate::file;
use crate::model::{CAPS, Model};
use crate::overlay::Overlay;
use crate::request::rounded;
use egui::{CollapsingHeader, Context, Frame, Margin, Rect, RichText, ScrollArea, SidePanel, TextEdit, Ui};
use paprsek::frame::knobs::KNOBS;
use paprsek::frame::placement::{self, CAMERA};
use paprsek::simd::level;
use paprsek::{Quality, scenes};
use std::path::Path;

/// Width, points.
const WIDTH: f32 = 300.0;

/// What the panel keeps for itself, and what it asks for.
#[derive(Default)]
pub struct Turned {
    /// What is searched for.
    search: String,
    /// Whether to copy the frame as a command line.
    pub copy: bool,
    /// Where the first slider of the scene is, points.
    pub slider: Option<Rect>,
    /// Rows of keys to copy.
    pub rows: Option<String>,
    /// What to tell.
    pub told: Option<String>,
}

/// Shows the panel, which sets the model.
pub fn panel(ctx: &Context, own: &mut Turned, model: &mut Model, overlay: &mut Option<Overlay>, out: &Path) {
    let width = WIDTH.min(0.62 * ctx.content_rect().width());
    let frame = Frame::new().fill(GROUND).inner_margin(Margin::same(8));
    SidePanel::left("panel").exact_width(width).resizable(false).frame(frame).show(ctx, |ui| {
        ui.horizontal(|ui| {
            ui.label("find");
            ui.add(TextEdit::singleline(&mut own.search).hint_text("name").desired_width(f32::INFINITY));
        });
        ui.horizontal_wrapped(|ui| buttons(ui, own, model, out));
        ui.separator();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let mut slider = None;
            let found = |name: &str| name.contains(own.search.trim());
            if own.search.trim().is_empty() {
                general(ui, model, overlay);
            }
            parameters(ui, &mut slider, model, &found);
            camera(ui, model, &found);
            if own.search.trim().is_empty() {
                own.rows = keyed(ui, model).or(own.rows.take());
            }
            settings(ui, model, &found);
            own.slider = slider;
        });
    });
}

fn buttons(ui: &mut Ui, own: &mut Turned, model: &mut Model, out: &Path) {
    own.copy |= ui.button("copy").on_hover_text("copy the frame as a command line (C)").clicked();
    let path = out.join(format!("paprsek-{}.txt", model.scene.name));
    if ui.button("save").on_hover_text(format!("save everything into {}", path.display())).clicked() {
        let saved = std::fs::write(&path, file::write(model)).map_err(|error| error.to_string());
        own.told = Some(saved.map_or_else(|why| why, |()| format!("saved {}", path.display())));
    }
    if ui.button("load").on_hover_text(format!("load {}", path.display())).clicked() {
        let text = std::fs::read_to_string(&path).map_err(|error| error.to_string());
        let loaded = text.and_then(|text| file::read(model, &text));
        own.told = Some(loaded.map_or_else(|why| why, |()| format!("loaded {}", path.display())));
    }
    if ui.button("reset all").on_hover_text("every parameter and setting as it was (Delete)").clicked() {
        model.act(crate::keys::Action::Reset);
    }
}

/// Scene, time, quality, threads and level.
fn general(ui: &mut Ui, model: &mut Model, overlay: &mut Option<Overlay>) {
    egui::Grid::new("general").num_columns(2).show(ui, |ui| {
        ui.label("scene");
        let mut scene = model.scene;
        egui::ComboBox::from_id_salt("scene").selected_text(scene.name).height(400.0).show_ui(ui, |ui| {
            for each in scenes::all() {
                if ui.selectable_label(each.name == scene.name, each.name).on_hover_text(each.about).clicked() {
                    scene = *each;
                }
            }
        });
        model.go(scene);
        ui.end_row();
        ui.label("quality");
        let mut base = model.base;
        egui::ComboBox::from_id_salt("quality").selected_text(base).show_ui(ui, |ui| {
            for each in Quality::NAMES {
                if ui.selectable_label(each == base, each).clicked() {
                    base = each;
                    model.start_from(each);
                }
            }
        });
        ui.end_row();
        ui.label("threads");
        let mut threads = model.threads;
        ui.add(egui::DragValue::new(&mut threads).range(0..=paprsek::frame::pool::cores()).speed(0.05))
            .on_hover_text("0 for one per core");
        model.threads = threads;
        ui.end_row();
        ui.label("SIMD");
        egui::ComboBox::from_id_salt("simd").selected_text(model.simd).show_ui(ui, |ui| {
            for (name, _) in level::all() {
                if ui.selectable_label(name == model.simd, name).clicked() {
                    model.simd = name;
                }
            }
        });
        ui.end_row();
        ui.label("frames/s");
        let name = |cap: u32| if cap == 0 { "no cap".to_owned() } else { format!("at most {cap}") };
        egui::ComboBox::from_id_salt("cap").selected_text(name(model.cap)).show_ui(ui, |ui| {
            for cap in CAPS {
                ui.selectable_value(&mut model.cap, cap, name(cap));
            }
        });
        ui.end_row();
        ui.label("see");
        let name = overlay.map_or("the picture", |overlay| overlay.about().0);
        egui::ComboBox::from_id_salt("see").selected_text(name).height(400.0).show_ui(ui, |ui| {
            ui.selectable_value(overlay, None, "the picture");
            for each in Overlay::all() {
                let (name, about) = each.about();
                ui.selectable_value(overlay, Some(each), name).on_hover_text(about);
            }
        });
        ui.end_row();
        ui.label("time");
        let mut time = model.time;
        let drag = egui::DragValue::new(&mut time).range(0.0..=model.scene.duration).speed(0.02);
        if ui.add(drag.fixed_decimals(3).suffix(" s")).changed() {
            (model.time, model.playing) = (time, false);
        }
        ui.end_row();
    });
}

fn parameters(ui: &mut Ui, slider: &mut Option<Rect>, model: &mut Model, found: &impl Fn(&str) -> bool) {
    let all = model.scene.parameters;
    if all.iter().any(|parameter| found(parameter.name)) {
        CollapsingHeader::new(format!("Scene {}", model.scene.name)).default_open(true).show(ui, |ui| {
            for parameter in all.iter().filter(|parameter| found(parameter.name)) {
                let value = model.value(parameter);
                let (new, at) = row(ui, parameter, value, parameter.default);
                slider.get_or_insert(at);
                if let Some(new) = new {
                    model.set(parameter, new);
                }
                if parameter.unit == "days" {
                    ui.label(RichText::new(calendar::words(value)).small().color(QUIET));
                }
            }
        });
    }
}

fn camera(ui: &mut Ui, model: &mut Model, found: &impl Fn(&str) -> bool) {
    let Some(pose) = model.camera().filter(|_| CAMERA.iter().any(|parameter| found(parameter.name))) else { return };
    let mut header = CollapsingHeader::new("Camera").id_salt("camera");
    if CAMERA.iter().all(|parameter| !found(parameter.name)) {
        header = header.open(Some(true));
    }
    header.show(ui, |ui| {
        let mut numbers = placement::numbers(&pose);
        let own = model.placed.camera.map_or(numbers, |own| placement::numbers(&own));
        let mut moved = false;
        for ((parameter, number), own) in CAMERA.iter().zip(&mut numbers).zip(own).filter(|row| found(row.0.0.name)) {
            let usual = if model.pose.is_some() { own } else { *number };
            if let Some(new) = row(ui, parameter, rounded(*number), rounded(usual)).0 {
                (*number, moved) = (new, true);
            }
        }
        if moved && model.flight.is_none() {
            model.pose = Some(placement::pose(numbers));
        }
        if ui.button("the scene's own (Home)").clicked() {
            model.act(crate::keys::Action::Home);
        }
    });
}

fn settings(ui: &mut Ui, model: &mut Model, found: &impl Fn(&str) -> bool) {
    let base = Quality::named(model.base).unwrap_or_default();
    for part in ["trace", "raster", "cloud", "particles", "sky"] {
        let is_of = |name: &str| name.split('.').next() == Some(part) && found(name);
        if !KNOBS.iter().any(|knob| is_of(knob.parameter.name)) {
            continue;
        }
        let changed =
            KNOBS.iter().any(|knob| is_of(knob.parameter.name) && (knob.get)(&model.quality) != (knob.get)(&base));
        let title = format!("Settings: {part}{}", if changed { " *" } else { "" });
        CollapsingHeader::new(title).id_salt(part).show(ui, |ui| {
            for knob in KNOBS.iter().filter(|knob| is_of(knob.parameter.name)) {
                let shown = |quality: &Quality| {
                    let value = (knob.get)(quality);
                    // As the shortest decimal of an f32 has it.
                    if value.is_finite() { (value as f32).to_string().parse().unwrap_or(value) } else { value }
                };
                if let Some(new) = row(ui, &knob.parameter, shown(&model.quality), shown(&base)).0 {
                    if new.is_finite() { model.turn(knob, new) } else { (knob.set)(&mut model.quality, new) }
                }
            }
        });
    }
}
