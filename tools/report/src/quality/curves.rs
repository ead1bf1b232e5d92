//! Curves of the error against milliseconds: one line per scene, with the default ringed and the knee marked.

use super::measure::{Row, Table};
use super::sweep::Sweep;
use crate::metrics::Error;
use crate::options::Result;
use crate::plot;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A panel: the name of the error, the error itself, its target, the limit of its axis, and the corner for the legend.
type Panel = (&'static str, fn(&Error) -> f64, f64, f64, SeriesLabelPosition);

const PANELS: [Panel; 6] = [
    // The PSNR of equal pictures is infinite: they are drawn at the top.
    ("PSNR, dB (higher is better; target 40)", |e| e.psnr().min(80.0), 40.0, 80.0, SeriesLabelPosition::LowerRight),
    ("RMSE, codes of 255 (40 dB is 2.55)", |e| e.rmse(), 2.55, 255.0, SeriesLabelPosition::UpperRight),
    ("SSIM (higher is better; target 0.98)", |e| e.ssim, 0.98, 1.0, SeriesLabelPosition::LowerRight),
    ("FLIP, mean (target 0.02)", |e| e.flip, 0.02, 1.0, SeriesLabelPosition::UpperRight),
    ("FLIP, 99th percentile (target 0.2)", |e| e.flip99, 0.2, 1.0, SeriesLabelPosition::UpperRight),
    ("bad pixels, % (target 0.5)", |e| 100.0 * e.bad, 0.5, 100.0, SeriesLabelPosition::UpperRight),
];

/// Writes the curve of a sweep as SVG. The viewer sets the text, so no fonts are needed here.
pub fn draw(path: &Path, sweep: &Sweep, tables: &[(&'static str, Table)]) -> Result {
    let area = SVGBackend::new(path, (1260, 760)).into_drawing_area();
    area.fill(&WHITE)?;
    for (panel, area) in PANELS.into_iter().zip(area.split_evenly((2, 3))) {
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
    let slowest = rows().map(|row| row.ms).fold(0.0, f64::max);
    let errors = || rows().map(|row| of(&row.error)).chain([target]);
    let (low, high) = (errors().fold(limit, f64::min), errors().fold(0.0, f64::max));
    let margin = 0.08 * (high - low);
    let caption = format!("{} from {}, against {}", sweep.knob, sweep.base, sweep.truth.name());
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 17))
        .margin(10)
        .x_label_area_size(36)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..1.1 * slowest, (low - margin).max(0.0)..(high + margin).min(1.1 * limit))?;
    let mut mesh = chart.configure_mesh();
    mesh.x_desc("milliseconds per frame").y_desc(name).max_light_lines(0).bold_line_style(BLACK.mix(0.12));
    mesh.draw()?;
    chart.draw_series(LineSeries::new([(0.0, target), (1.1 * slowest, target)], BLACK.mix(0.45)))?;
    for (index, (name, table)) in tables.iter().enumerate() {
        let colour = plot::COLOURS[index % plot::COLOURS.len()];
        let at = |row: &Row| (row.ms, of(&row.error));
        plot::line(&mut chart, name, &table.rows.iter().map(at).collect::<Vec<_>>(), colour, 3)?;
        let defaults = table.rows.iter().filter(|row| row.point.default);
        chart.draw_series(defaults.map(|row| Circle::new(at(row), 8, colour.stroke_width(2))))?;
        if let Some(knee) = knee(&table.rows) {
            chart.draw_series([TriangleMarker::new(at(knee), 9, colour.stroke_width(2))])?;
        }
        let label = |row: &Row| {
            let text = if row.point.default { format!("{} default", row.point.label) } else { row.point.label.clone() };
            EmptyElement::at(at(row)) + Text::new(text, (9, -14), ("sans-serif", 12).into_font().color(&colour))
        };
        let apart = |a: &Row, b: &Row| {
            let ((x, y), (u, v)) = (at(a), at(b));
            (x - u).abs() > 0.15 * slowest || (y - v).abs() > 0.05 * (high - low)
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

/// The point that is farthest from the line between the slowest and the fastest, by the logarithm of the time and PSNR, both
/// in units of their ranges. None where the curve has no ends to speak of.
fn knee(rows: &[Row]) -> Option<&Row> {
    let at = |row: &Row| (row.ms.ln(), row.error.psnr().min(80.0));
    let slowest = rows.iter().max_by(|a, b| a.ms.total_cmp(&b.ms))?;
    let fastest = rows.iter().min_by(|a, b| a.ms.total_cmp(&b.ms))?;
    let ((x0, y0), (x1, y1)) = (at(fastest), at(slowest));
    if x1 - x0 < 0.05 || y1 - y0 < 1.0 {
        return None;
    }
    let above = |row: &Row| (at(row).1 - y0) / (y1 - y0) - (at(row).0 - x0) / (x1 - x0);
    rows.iter().max_by(|a, b| above(a).total_cmp(&above(b))).filter(|row| above(row) > 0.05)
}
