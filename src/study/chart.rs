//! The work-precision diagrams as one SVG picture: wall time per simulated second against each error, both
//! logarithmic. Towards the lower left is better.

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use std::ops::Range;

use super::scale::{Scale, series_of};
use super::{AXES, Axis, StudyReport, look_of, seconds, short};
use crate::sim::Method;

/// Width and height, px.
const SIZE: (u32, u32) = (1500, 1020);
const COLUMNS: usize = 3;
const TITLE_HEIGHT: u32 = 92;
const LEGEND_HEIGHT: u32 = 66;
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(40, 40, 40);
const FAINT: RGBColor = RGBColor(225, 225, 225);

/// The picture could not be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the diagram cannot be drawn: {0}")]
pub struct ChartError(String);

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Draws all diagrams of a report.
pub fn svg(report: &StudyReport) -> Result<String, ChartError> {
    let mut text = String::new();
    draw(report, &mut text).map_err(|error| ChartError(error.to_string()))?;
    // What a screen reader says, and what a browser shows on its tab.
    let head = text.find("<svg").and_then(|at| Some(at + text[at..].find('>')? + 1));
    if let Some(at) = head {
        let about = |tag: &str, what: &str| format!("\n<{tag}>{}</{tag}>", escaped(what));
        text.insert_str(at, &about("desc", &report.horizon_statement()));
        text.insert_str(at, &about("title", &report.title()));
    }
    Ok(text)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn draw(report: &StudyReport, text: &mut String) -> Drawn {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (top, rest) = root.split_vertically(TITLE_HEIGHT);
    let (middle, bottom) = rest.split_vertically(SIZE.1 - TITLE_HEIGHT - LEGEND_HEIGHT);
    heading(&top, report)?;
    let drawn: Vec<&Axis> = AXES.iter().filter(|axis| axis.is_drawn).collect();
    let areas = middle.split_evenly((drawn.len().div_ceil(COLUMNS), COLUMNS));
    for (axis, area) in drawn.into_iter().zip(&areas) {
        diagram(area, report, axis)?;
    }
    legend(&bottom, report)?;
    root.present()
}

/// A scale as plotters wants it.
struct Decades {
    scale: Scale,
    ticks: Vec<f64>,
}

impl Ranged for Decades {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, limit: (i32, i32)) -> i32 {
        let Range { start, end } = self.scale.range();
        let part = (place - start) / (end - start);
        limit.0 + libm::round(f64::from(limit.1 - limit.0) * part) as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.scale.range()
    }
}

fn heading(area: &Area, report: &StudyReport) -> Drawn {
    let title = (FONT, 30).into_font().style(FontStyle::Bold).color(&INK);
    area.draw_text(&report.title(), &title, (24, 14))?;
    let small = (FONT, 19).into_font().color(&INK);
    for (nth, line) in wrapped(&report.horizon_statement(), 175).iter().enumerate() {
        area.draw_text(line, &small, (24, 48 + 21 * nth as i32))?;
    }
    Ok(())
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => *line = word.into(),
            Some(line) if line.chars().count() + word.chars().count() < width => *line += &format!(" {word}"),
            _ => lines.push(word.into()),
        }
    }
    lines
}

fn diagram(area: &Area, report: &StudyReport, axis: &Axis) -> Drawn {
    let caption = (FONT, 21).into_font().style(FontStyle::Bold).color(&INK);
    let unit = if axis.unit.is_empty() { String::new() } else { format!(" [{}]", axis.unit) };
    let heading = format!("{}{unit}", axis.title);
    let times = Scale::of(report.points.iter().filter_map(|point| point.wall_per_s));
    let errors = Scale::of(report.points.iter().filter_map(axis.get));
    let (Some(times), Some(errors)) = (times, errors) else {
        area.draw_text(&heading, &caption, (70, 8))?;
        return area.draw_text("n/a for this scene", &(FONT, 19).into_font().color(&INK), (70, 40));
    };
    let mut chart = ChartBuilder::on(area)
        .caption(&heading, caption)
        .margin(12)
        .margin_right(26)
        .x_label_area_size(48)
        .y_label_area_size(62)
        .build_cartesian_2d(
            Decades { scale: times, ticks: times.ticks(6) },
            Decades { scale: errors, ticks: errors.ticks(9) },
        )?;
    let ink = (FONT, 16.5).into_font().color(&INK);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT)
        .axis_style(INK)
        .label_style(ink.clone())
        .axis_desc_style(ink)
        .x_desc("wall time per simulated second")
        .x_label_formatter(&|x| times.time_label(*x))
        .y_label_formatter(&|y| errors.label(*y))
        .draw()?;
    for method in Method::ALL {
        let series = series_of(report, method, axis);
        let at: Vec<(f64, f64)> =
            series.iter().map(|point| (times.place(point.wall), errors.place(point.error))).collect();
        let color = color(method);
        chart.plotting_area().draw(&PathElement::new(at.clone(), color.stroke_width(2)))?;
        for place in &at {
            chart.plotting_area().draw(&(EmptyElement::at(*place) + marker(method)))?;
        }
        // The ends of a curve show which way it runs.
        for nth in ends(series.len()) {
            let (vertical, down) = label_side(method);
            let (side, right) = if nth == 0 && at.len() > 1 { (HPos::Right, -7) } else { (HPos::Left, 7) };
            let style = (FONT, 15).into_font().color(&color).pos(Pos::new(side, vertical));
            let label = Text::new(series[nth].label.clone(), (right, down), style);
            chart.plotting_area().draw(&(EmptyElement::at(at[nth]) + label))?;
        }
    }
    Ok(())
}

/// Labels of curves that run into each other stand on different sides of their points.
fn label_side(method: Method) -> (VPos, i32) {
    match method {
        Method::Exact | Method::Thesis => (VPos::Bottom, -5),
        Method::Fixed => (VPos::Top, 5),
    }
}

fn ends(length: usize) -> Vec<usize> {
    match length {
        0 => Vec::new(),
        1 => vec![0],
        _ => vec![0, length - 1],
    }
}

/// Told apart by anyone (Okabe & Ito 2008), and each with a shape of its own besides.
fn color(method: Method) -> RGBColor {
    let ([r, g, b], _) = look_of(method);
    RGBColor(r, g, b)
}

/// A filled shape around the origin, px.
fn marker(method: Method) -> Polygon<(i32, i32)> {
    let corners = look_of(method).1.corners().iter();
    let place = |unit: f64| libm::round(unit * 6.0) as i32;
    Polygon::new(corners.map(|[x, y]| (place(*x), -place(*y))).collect::<Vec<_>>(), color(method).filled())
}

fn legend(area: &Area, report: &StudyReport) -> Drawn {
    let mut x = 70;
    let text = (FONT, 19).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    for method in Method::ALL.into_iter().filter(|m| report.points.iter().any(|p| p.method == *m)) {
        let line = PathElement::new(vec![(x, 18), (x + 40, 18)], color(method).stroke_width(2));
        area.draw(&line)?;
        area.draw(&(EmptyElement::at((x + 20, 18)) + marker(method)))?;
        let label = format!("{}: {}", method.name(), axis_of(report, method));
        area.draw_text(&label, &text, (x + 50, 18))?;
        x += 50 + 9 * label.chars().count() as i32 + 40;
    }
    let note = "Towards the lower left is better, unless a title says otherwise. The row 0 holds what is exactly zero.";
    let small = (FONT, 16.5).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(note, &small, (70, 46))
}

/// What runs along a method's curve.
fn axis_of(report: &StudyReport, method: Method) -> String {
    let of = || report.points.iter().filter(|point| point.method == method);
    let span = |values: Vec<f64>, text: fn(f64) -> String| {
        let (most, least) = values.iter().fold((0.0_f64, f64::INFINITY), |(a, b), v| (a.max(*v), b.min(*v)));
        format!("{} … {}", text(most), text(least))
    };
    let (dts, tolerances): (Vec<f64>, Vec<f64>) =
        (of().filter_map(|point| point.dt).collect(), of().filter_map(|point| point.tolerance).collect());
    match (dts.len(), tolerances.len()) {
        (2.., _) => format!("Δt {}", span(dts, seconds)),
        (_, 2..) => format!("field tolerance {}", span(tolerances, short)),
        (1, _) => format!("Δt {}", seconds(dts[0])),
        _ => "one point, no Δt".into(),
    }
}
