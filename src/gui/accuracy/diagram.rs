//! The work-precision diagram: wall time per simulated second against one error, both logarithmic.

use egui::{Align2, Color32, RichText, Sense, Ui, pos2, vec2};
use egui_plot::{GridInput, GridMark, HoverPosition, Line, MarkerShape, Plot, PlotPoint, Points, Text};

use crate::gui::colors::tones;
use crate::gui::numbers;
use crate::sim::Method;
use crate::study::{Axis, CurvePoint, Marker, Scale, StudyReport, look_of, series_of, short};

/// Draws one measure of a report; `serial` distinguishes reports, so that a new one is shown whole.
pub fn show(ui: &mut Ui, report: &StudyReport, axis: &Axis, serial: u64) {
    let times = Scale::of(report.points.iter().filter_map(|point| point.wall_per_s));
    let errors = Scale::of(report.points.iter().filter_map(axis.get));
    let (Some(times), Some(errors)) = (times, errors) else {
        ui.add_space(12.0);
        ui.label(RichText::new("Nothing to draw: this scene has no such figure.").color(tones(ui).weak));
        return;
    };
    let curves: Vec<(Method, Vec<CurvePoint>)> =
        Method::ALL.into_iter().map(|method| (method, series_of(report, method, axis))).collect();
    legend(ui, &curves);
    let dark = ui.visuals().dark_mode;
    let (x, y) = (times.range(), errors.range());
    let response = Plot::new(("work-precision diagram", axis.id, serial))
        .default_x_bounds(x.start, x.end)
        .default_y_bounds(y.start, y.end)
        .x_grid_spacer(marks(times, 6))
        .y_grid_spacer(marks(errors, 8))
        .x_axis_formatter(move |mark, _| times.time_label(mark.value))
        .y_axis_formatter(move |mark, _| errors.label(mark.value))
        .x_axis_label("wall time per simulated second")
        .grid_color(tones(ui).line)
        .grid_fade(0.0)
        .allow_scroll(false)
        .show_crosshair(false)
        .label_formatter(|at| hovered(at, &curves, axis))
        .height(ui.available_height().max(90.0))
        .show(ui, |plot| {
            for (method, curve) in &curves {
                let color = color_of(*method, dark);
                let at: Vec<[f64; 2]> =
                    curve.iter().map(|point| [times.place(point.wall), errors.place(point.error)]).collect();
                let name = method.name();
                plot.line(Line::new(name, at.clone()).color(color).width(1.5).allow_hover(false));
                let shape = shape_of(*method);
                plot.points(
                    Points::new(name, at.clone()).id((name, "points")).shape(shape).radius(5.0).color(color),
                );
                for nth in [0, at.len().saturating_sub(1)] {
                    let (Some(point), Some(at)) = (curve.get(nth), at.get(nth)) else { continue };
                    let (place, anchor) =
                        (PlotPoint::new(at[0], at[1]), side(*method, nth == 0 && curve.len() > 1));
                    let label = RichText::new(format!("  {}  ", point.label)).size(10.5);
                    plot.text(Text::new("", place, label).id((name, nth)).anchor(anchor).color(color));
                }
            }
        });
    let name = format!("Diagram of {} over wall time", axis.title.to_lowercase());
    response.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
}

/// Labels of curves that run into each other stand on different sides of their points.
fn side(method: Method, is_first: bool) -> Align2 {
    match (method, is_first) {
        (Method::Fixed, true) => Align2::RIGHT_TOP,
        (Method::Fixed, false) => Align2::LEFT_TOP,
        (_, true) => Align2::RIGHT_BOTTOM,
        (_, false) => Align2::LEFT_BOTTOM,
    }
}

/// Marks at whole decades only, and at zero.
fn marks(scale: Scale, most: usize) -> impl Fn(GridInput) -> Vec<GridMark> {
    let ticks = scale.ticks(most);
    // how far they are apart decides whether their labels are shown; zero stands one decade below the rest
    let step_size = ticks.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(1.0, f64::max);
    move |_| ticks.iter().map(|&value| GridMark { value, step_size }).collect()
}

fn hovered(at: &HoverPosition<'_>, curves: &[(Method, Vec<CurvePoint>)], axis: &Axis) -> Option<String> {
    let HoverPosition::NearDataPoint { plot_name, index, .. } = at else { return None };
    let (method, curve) = curves.iter().find(|(method, _)| method.name() == *plot_name)?;
    let point = curve.get(*index)?;
    Some(format!(
        "{} {}\n{}: {} {}\n{} per simulated second",
        method.name(),
        point.label,
        axis.title,
        short(point.error),
        axis.unit,
        numbers::duration(point.wall)
    ))
}

fn legend(ui: &mut Ui, curves: &[(Method, Vec<CurvePoint>)]) {
    let dark = ui.visuals().dark_mode;
    ui.horizontal(|ui| {
        for (method, _) in curves.iter().filter(|(_, curve)| !curve.is_empty()) {
            let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
            let corner = |[x, y]: &[f64; 2]| rect.center() + vec2(*x as f32, -*y as f32) * 5.0;
            let corners =
                look_of(*method).1.corners().iter().map(corner).map(|at| pos2(at.x, at.y)).collect();
            let color = color_of(*method, dark);
            ui.painter().add(egui::Shape::convex_polygon(corners, color, egui::Stroke::NONE));
            ui.label(RichText::new(method.name()).small());
            ui.add_space(6.0);
        }
    });
}

fn shape_of(method: Method) -> MarkerShape {
    match look_of(method).1 {
        Marker::Diamond => MarkerShape::Diamond,
        Marker::Triangle => MarkerShape::Up,
        Marker::Square => MarkerShape::Square,
    }
}

/// The diagrams' colours are made for paper; on a dark ground they are lighter.
fn color_of(method: Method, dark: bool) -> Color32 {
    let ([r, g, b], _) = look_of(method);
    let color = Color32::from_rgb(r, g, b);
    if dark { color.lerp_to_gamma(Color32::WHITE, 0.3) } else { color }
}
