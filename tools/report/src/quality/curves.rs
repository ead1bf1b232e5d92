//! Curves of the error against the speed relative to `exact`: one line per scene, with the default ringed.

use super::measure::{Row, Table};
use super::sweep::{Sweep, Truth};
use crate::metrics::Error;
use crate::options::Result;
use crate::plot;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A panel: the name of the error, the error itself, its target, the limit of its axis, and the corner for the legend.
type Panel = (&'static str, fn(&Error) -> f64, f64, f64, SeriesLabelPosition);

const PANELS: [Panel; 2] = [
    // The PSNR of equal pictures is infinite: they are drawn at the top.
    ("PSNR, dB (higher is better; target 40)", |e| e.psnr().min(80.0), 40.0, 80.0, SeriesLabelPosition::LowerLeft),
    ("FLIP, 99th percentile (lower is better; target 0.2)", |e| e.flip99, 0.2, 1.0, SeriesLabelPosition::UpperLeft),
];

/// Writes the curve of a sweep as SVG. The viewer sets the text, so no fonts are needed here.
pub fn draw(path: &Path, sweep: &Sweep, tables: &[(&'static str, Table)]) -> Result {
    let area = SVGBackend::new(path, (1080, 420)).into_drawing_area();
    area.fill(&WHITE)?;
    for (panel, area) in PANELS.into_iter().zip(area.split_evenly((1, 2))) {
        draw_panel(&area, panel, sweep, tables)?;
    }
    Ok(area.present()?)
}

fn draw_panel(
    area: &DrawingArea<SVGBackend, Shift>,
    (name, of, target, limit, corner): Panel,
    sweep: &Sweep,
    tables: &[(&'static str, Table)],
) -> Result {
    let rows = || tables.iter().flat_map(|(_, table)| &table.rows);
    let fastest = rows().map(|row| row.ratio).fold(1.0, f64::max);
    let errors = || rows().map(|row| of(&row.error)).chain([target]);
    let (low, high) = (errors().fold(limit, f64::min), errors().fold(0.0, f64::max));
    let margin = 0.08 * (high - low);
    let caption = format!("{} from {}, against {}", sweep.knob, sweep.base, sweep.truth.name());
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 17))
        .margin(10)
        .x_label_area_size(36)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..1.25 * fastest, (low - margin).max(0.0)..(high + margin).min(1.1 * limit))?;
    let mut mesh = chart.configure_mesh();
    let truth = if sweep.truth == Truth::Dome { "every pixel" } else { "exact" };
    mesh.x_desc(format!("times as fast as {truth}")).y_desc(name).max_light_lines(0).bold_line_style(BLACK.mix(0.12));
    mesh.draw()?;
    chart.draw_series(LineSeries::new([(0.0, target), (1.25 * fastest, target)], BLACK.mix(0.45)))?;
    for (index, (name, table)) in tables.iter().enumerate() {
        let colour = plot::COLOURS[index % plot::COLOURS.len()];
        let at = |row: &Row| (row.ratio, of(&row.error));
        plot::line(&mut chart, name, &table.rows.iter().map(at).collect::<Vec<_>>(), colour, 3)?;
        let defaults = table.rows.iter().filter(|row| row.point.default);
        chart.draw_series(defaults.map(|row| Circle::new(at(row), 8, colour.stroke_width(2))))?;
        let label = |row: &Row| {
            let text = if row.point.default { format!("{} default", row.point.label) } else { row.point.label.clone() };
            EmptyElement::at(at(row)) + Text::new(text, (9, -14), ("sans-serif", 12).into_font().color(&colour))
        };
        let apart = |a: &Row, b: &Row| {
            let ((x, y), (u, v)) = (at(a), at(b));
            (x - u).abs() > 0.25 * fastest || (y - v).abs() > 0.05 * (high - low)
        };
        chart.draw_series(legible(&table.rows, apart).into_iter().map(label))?;
    }
    plot::legend(&mut chart, corner)
}

/// The points that get a label: the default first, then the ends, then those that are far from all labels so far.
fn legible(rows: &[Row], apart: impl Fn(&Row, &Row) -> bool) -> Vec<&Row> {
    let mut order: Vec<_> = rows.iter().enumerate().collect();
    order.sort_by_key(|(index, row)| (!row.point.default, index % (rows.len() - 1).max(1) != 0));
    let mut chosen: Vec<&Row> = Vec::new();
    for (_, row) in order {
        if chosen.iter().all(|other| apart(row, other)) {
            chosen.push(row);
        }
    }
    chosen
}
