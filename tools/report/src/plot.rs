//! Curves of the smaller measurements, in panels side by side.

use crate::options::Result;
use plotters::coord::combinators::IntoLogRange;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use std::path::Path;

/// A line, and a label at each of its points.
pub struct Curve {
    pub name: String,
    pub points: Vec<(f64, f64, String)>,
}

/// An axis of a panel; both are logarithmic.
#[derive(Clone, Copy)]
pub struct Axis {
    pub name: &'static str,
}

/// Colours of curves, in their order.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(31, 119, 180),
    RGBColor(214, 96, 20),
    RGBColor(44, 140, 60),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(200, 60, 140),
    RGBColor(20, 20, 20),
];
/// Zero has no logarithm: it is drawn here.
const LEAST: f64 = 1e-3;

/// A chart of two numbers.
pub type Chart<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

/// Draws a line with a dot of `size` pixels at each of its points, and enters it into the legend.
pub fn line<X: Ranged<ValueType = f64>, Y: Ranged<ValueType = f64>>(
    chart: &mut Chart<X, Y>,
    name: &str,
    points: &[(f64, f64)],
    colour: RGBColor,
    size: i32,
) -> Result {
    chart
        .draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?
        .label(name)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    chart.draw_series(points.iter().map(|point| Circle::new(*point, size, colour.filled())))?;
    Ok(())
}

/// Draws the legend into a corner.
pub fn legend<'a, 'b: 'a, X: Ranged<ValueType = f64>, Y: Ranged<ValueType = f64>>(
    chart: &mut Chart<'a, 'b, X, Y>,
    corner: SeriesLabelPosition,
) -> Result {
    let mut legend = chart.configure_series_labels();
    legend.position(corner).border_style(BLACK.mix(0.3)).background_style(WHITE.mix(0.8));
    Ok(legend.draw()?)
}

/// Writes panels side by side as SVG. The viewer sets the text, so no fonts are needed here.
pub fn draw(path: &Path, names: &[&str], panels: &[Vec<Curve>], [x, y]: [Axis; 2]) -> Result {
    let area = SVGBackend::new(path, (1160, 460)).into_drawing_area();
    area.fill(&WHITE)?;
    for ((area, curves), name) in area.split_evenly((1, panels.len())).iter().zip(panels).zip(names) {
        let points = || curves.iter().flat_map(|curve| &curve.points);
        let range = |of: fn(&(f64, f64, String)) -> f64| {
            let low = points().map(|point| of(point).max(LEAST)).fold(f64::MAX, f64::min);
            let high = points().map(|point| of(point).max(LEAST)).fold(f64::MIN, f64::max);
            (0.8 * low..1.5 * high.max(1.5 * low)).log_scale()
        };
        let mut chart = ChartBuilder::on(area)
            .caption(name, ("sans-serif", 17))
            .margin(10)
            .x_label_area_size(36)
            .y_label_area_size(56)
            .build_cartesian_2d(range(|point| point.0), range(|point| point.1))?;
        let mut mesh = chart.configure_mesh();
        // Sums of tenths are not tenths in binary: they would be printed with all their digits.
        let short = |value: &f64| ((value * 1e4).round() / 1e4).to_string();
        mesh.x_label_formatter(&short).y_label_formatter(&short);
        mesh.x_desc(x.name).y_desc(y.name).max_light_lines(0).bold_line_style(BLACK.mix(0.12)).draw()?;
        for (index, curve) in curves.iter().enumerate() {
            let colour = COLOURS[index % COLOURS.len()];
            let at = |(x, y, _): &(f64, f64, String)| (x.max(LEAST), y.max(LEAST));
            let size = if curve.points.len() == 1 { 6 } else { 3 };
            line(&mut chart, &curve.name, &curve.points.iter().map(at).collect::<Vec<_>>(), colour, size)?;
            chart.draw_series(curve.points.iter().map(|point| {
                let style = ("sans-serif", 11).into_font().color(&colour);
                EmptyElement::at(at(point)) + Text::new(point.2.clone(), (6, -12), style)
            }))?;
        }
        legend(&mut chart, SeriesLabelPosition::UpperRight)?;
    }
    Ok(area.present()?)
}
