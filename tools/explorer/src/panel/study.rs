//! What is told about the frame: the scale of an overlay, the comparison with the truth, and the probe.

use super::{LOUD, QUIET, ground};
use crate::compare::Compare;
use crate::overlay::{Coloured, Range, colour};
use crate::probing::Probing;
use crate::worker::Shown;
use egui::{Align2, Area, Color32, Context, Id, Rect, RichText, Sense, Slider, Ui, Window, pos2, vec2};

/// Width of the scale, points.
const SCALE: f32 = 220.0;

/// Shows the scale of an overlay at the right edge, below what ends at `above`, points.
pub fn legend(ctx: &Context, coloured: &Coloured, above: f32) {
    let at = vec2(-8.0, above + 8.0);
    Area::new(Id::new("legend")).anchor(Align2::RIGHT_TOP, at).interactable(false).show(ctx, |ui| {
        ground().show(ui, |ui| {
            ui.set_width(SCALE);
            let (name, about) = coloured.overlay.about();
            ui.label(RichText::new(name).strong().color(LOUD));
            match coloured.range {
                Some(range) => scale(ui, about, range),
                None => drop(ui.label("no layer of this scene knows any")),
            }
        });
    });
}

fn scale(ui: &mut Ui, about: &str, Range { least, end, most, mean }: Range) {
    let (area, _) = ui.allocate_exact_size(vec2(SCALE, 12.0), Sense::hover());
    const PARTS: usize = 44;
    for part in 0..PARTS {
        let [from, to] = [part, part + 1].map(|part| area.left() + SCALE * part as f32 / PARTS as f32);
        let [red, green, blue] = colour(part as f32 / (PARTS - 1) as f32).map(|code| code as u8);
        let bar = Rect::from_min_max(pos2(from, area.top()), pos2(to, area.bottom()));
        ui.painter().rect_filled(bar, 0.0, Color32::from_rgb(red, green, blue));
    }
    ui.horizontal(|ui| {
        ui.label(number(least));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(number(end)));
    });
    ui.label(RichText::new(about).color(QUIET));
    let most = if most > end { format!(", most {}", number(most)) } else { String::new() };
    ui.label(RichText::new(format!("mean {}{most}", number(mean))).color(QUIET));
}

/// A number with three digits or so.
fn number(value: f32) -> String {
    // A mean of equal whole numbers is one.
    let value = if (value - value.round()).abs() < 1e-4 * value.abs() { value.round() } else { value };
    match value.abs() {
        0.0 => "0".into(),
        0.0..10.0 if value.fract() != 0.0 => format!("{value:.2}"),
        10.0..100.0 if value.fract() != 0.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

/// Shows what the comparison is set to and has found.
pub fn compared(ctx: &Context, compare: &mut Compare, shown: Option<&Shown>) {
    let window = Window::new("compare").title_bar(false).resizable(false).frame(ground());
    window.anchor(Align2::RIGHT_BOTTOM, vec2(-8.0, -8.0)).show(ctx, |ui| {
        ui.set_width(250.0);
        ui.horizontal(|ui| {
            ui.label("against");
            for name in ["exact", "reference"] {
                ui.selectable_value(&mut compare.against, name, name);
            }
        });
        ui.horizontal(|ui| {
            ui.label("right");
            ui.selectable_value(&mut compare.difference, false, "truth");
            ui.selectable_value(&mut compare.difference, true, "difference");
            let drag = egui::DragValue::new(&mut compare.amplified).range(1.0..=64.0).speed(0.1).prefix("x ");
            ui.add_enabled(compare.difference, drag.fixed_decimals(0));
        });
        ui.spacing_mut().slider_width = 190.0;
        ui.add(Slider::new(&mut compare.split, 0.0..=1.0).text("split").show_value(false));
        match shown.and_then(|shown| compare.of(&shown.request)) {
            Some(found) => {
                let difference = &found.difference;
                let psnr = difference.psnr();
                let psnr = if psnr.is_finite() { format!("{psnr:.2} dB") } else { "equal".into() };
                ui.label(RichText::new(format!("PSNR {psnr}")).strong().color(LOUD));
                let bad = 100.0 * difference.bad;
                ui.label(format!("SSIM {:.5}", found.ssim));
                ui.label(format!("FLIP {:.5}", found.flip));
                ui.label(format!("{bad:.3} % bad pixels (by 8 codes)"));
                ui.label(format!("largest difference {} codes", difference.largest));
            }
            None => drop(ui.label(format!("rendering the truth, {:.0} %", 100.0 * compare.progress()))),
        }
    });
}

/// Shows what the probe has told.
pub fn probed(ctx: &Context, probing: &Probing) {
    let room = ctx.available_rect();
    let at = vec2(room.left() + 8.0, 8.0);
    Area::new(Id::new("probe")).anchor(Align2::LEFT_TOP, at).interactable(false).show(ctx, |ui| {
        ground().show(ui, |ui| {
            ui.set_max_width((room.width() - 32.0).min(620.0));
            ui.spacing_mut().item_spacing.y = 1.0;
            match &probing.told {
                Some((_, text)) => {
                    // As many lines as fit, and how many do not.
                    let fits = ((room.height() - 90.0) / 15.0).max(4.0) as usize;
                    let count = text.lines().count();
                    for line in text.lines().take(fits) {
                        ui.add(egui::Label::new(RichText::new(line).monospace()).truncate());
                    }
                    if count > fits {
                        ui.label(RichText::new(format!("and {} lines more", count - fits)).color(QUIET));
                    }
                }
                None => drop(ui.label("move the mouse over the picture")),
            }
        });
    });
}
