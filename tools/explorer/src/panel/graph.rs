//! The graph of frame times: what each frame took, which share each layer had, and how slow the slowest are.

use super::{LOUD, QUIET, ground};
use crate::worker::Shown;
use egui::{Align2, Area, Color32, Context, Id, Rect, RichText, Sense, Stroke, Ui, pos2, vec2};
use std::collections::VecDeque;

/// Frames that are kept: one per column of the graph.
const FRAMES: usize = 240;
/// Height of the graph, points.
const HEIGHT: f32 = 70.0;
/// Colours of layers in the order in which they are drawn, and of preparing.
const COLOURS: [Color32; 6] = [
    Color32::from_rgb(96, 150, 220),
    Color32::from_rgb(120, 196, 130),
    Color32::from_rgb(222, 164, 82),
    Color32::from_rgb(204, 110, 150),
    Color32::from_rgb(150, 130, 220),
    Color32::from_rgb(120, 200, 200),
];

/// The frames that were shown last.
#[derive(Default)]
pub struct Graph(VecDeque<(f64, Vec<(&'static str, f64)>)>);

impl Graph {
    /// Takes a frame.
    pub fn take(&mut self, shown: &Shown) {
        if self.0.len() == FRAMES {
            self.0.pop_front();
        }
        let layers = shown.layers.iter().map(|layer| (layer.0, layer.1 + layer.2)).collect();
        self.0.push_back((shown.ms, layers));
    }

    /// Starts anew: frames of another scene have other layers.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Shows the graph in the upper right corner. Gives where its lower edge is, points.
    pub fn show(&self, ctx: &Context, samples: u64) -> f32 {
        let area = Area::new(Id::new("graph")).anchor(Align2::RIGHT_TOP, vec2(-8.0, 8.0)).interactable(false);
        let shown = area.show(ctx, |ui| {
            ground().show(ui, |ui| self.draw(ui, samples));
        });
        shown.response.rect.bottom()
    }

    fn draw(&self, ui: &mut Ui, samples: u64) {
        let mut sorted: Vec<f64> = self.0.iter().map(|frame| frame.0).collect();
        sorted.sort_by(f64::total_cmp);
        let Some((last, layers)) = self.0.back() else { return };
        let [median, slow] = [50, 99].map(|percent| sorted[(sorted.len() * percent / 100).min(sorted.len() - 1)]);
        let width = (FRAMES as f32).min(ui.ctx().available_rect().width() - 40.0);
        ui.set_width(width);
        ui.label(format!("{last:.1} ms"));
        ui.label(format!("median {median:.1}, slowest hundredth {slow:.1}"));
        // The slowest frame fits, and a line is at 60 frames per second.
        let top = sorted.last().copied().unwrap_or(1.0).max(1000.0 / 60.0);
        let (area, _) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
        let y = |ms: f64| area.bottom() - (ms / top) as f32 * area.height();
        let step = width / FRAMES as f32;
        for (number, (ms, layers)) in self.0.iter().enumerate() {
            let x = area.right() - (self.0.len() - number) as f32 * step;
            let all: f64 = layers.iter().map(|layer| layer.1).sum();
            let mut below = 0.0;
            for (place, (_, own)) in layers.iter().enumerate() {
                // Times of all threads together, as shares of the frame's.
                let share = if all > 0.0 { own / all * ms } else { 0.0 };
                let bar = Rect::from_min_max(pos2(x, y(below + share)), pos2(x + step, y(below)));
                ui.painter().rect_filled(bar, 0.0, COLOURS[place % COLOURS.len()]);
                below += share;
            }
        }
        for (ms, colour) in [(1000.0 / 60.0, QUIET), (slow, LOUD)] {
            ui.painter().hline(area.x_range(), y(ms), Stroke::new(1.0, colour));
        }
        let all: f64 = layers.iter().map(|layer| layer.1).sum();
        for (place, (name, own)) in layers.iter().enumerate() {
            let text = format!("{name} {:.0} %", own / all.max(1e-9) * 100.0);
            ui.label(RichText::new(text).color(COLOURS[place % COLOURS.len()]));
        }
        ui.label(RichText::new(format!("{samples} samples")).color(QUIET));
    }
}
