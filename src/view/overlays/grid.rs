//! Lines at round coordinates with their numbers: over the whole view in an axis view, on the map's floor else.

use glam::{DVec2, DVec3, Vec2};

use crate::view::format::{number, round_down_125};
use crate::view::stage::{Pen, Stage};
use crate::view::{Align, Axis, Color, DrawList, Label, Projection};

/// Least distance of lines with numbers, points.
const SPACING: f64 = 48.0;

/// Most lines in one direction.
const MOST: f64 = 400.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    match (stage.camera.projection, stage.camera.axis_view()) {
        (Projection::Orthographic, Some(_)) => add_ruled_view(stage, list),
        _ => add_floor(stage, list),
    }
}

/// The largest step of lines that `spacing` metres allow at least, 1, 2 or 5 × 10^k.
fn round_up_125(spacing: f64) -> f64 {
    let below = round_down_125(spacing);
    [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|factor| below * factor)
        .find(|step| *step >= spacing * (1.0 - 1e-9) && (round_down_125(*step) / step - 1.0).abs() < 1e-6)
        .unwrap_or(below)
}

/// Multiples of `step` in a range, as counts; none if there are too many to see.
fn multiples(low: f64, high: f64, step: f64) -> impl Iterator<Item = i64> {
    let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
    let sensible = last - first <= MOST && first.abs().max(last.abs()) < 1e15;
    sensible.then_some(first as i64..=last as i64).into_iter().flatten()
}

/// Lines across an axis view, behind the scene, with numbers along the left and the bottom edge.
fn add_ruled_view(stage: &Stage<'_>, list: &mut DrawList) {
    let (camera, viewport) = (&stage.camera, stage.input.viewport);
    let back = camera.backward();
    let half_height = 0.5 * camera.height;
    let half_size = DVec2::new(half_height * viewport.aspect(), half_height);
    let step = round_up_125(SPACING * camera.world_per_pixel(viewport.height));
    // On the map's far side.
    let depth = stage.map.corners().into_iter().map(|corner| corner.dot(back)).fold(f64::INFINITY, f64::min);
    for (across, along, is_vertical) in
        [(camera.right(), camera.up(), true), (camera.up(), camera.right(), false)]
    {
        let axis = across.abs();
        let sign = across.dot(axis);
        let (half_across, half_along) =
            if is_vertical { (half_size.x, half_size.y) } else { (half_size.y, half_size.x) };
        let (middle, along_middle) = (camera.target.dot(axis), camera.target.dot(along));
        for count in multiples(middle - half_across, middle + half_across, step) {
            let value = count as f64 * step;
            let place = |along_by: f64| axis * value + along * along_by + back * depth;
            let ends = [place(along_middle - half_along), place(along_middle + half_along)];
            let color = if count == 0 { stage.palette.grid_major } else { stage.palette.grid };
            stage.add_line(list, ends, Pen::hidden_by_bodies(color, 1.0));
            let ndc = sign * (value - middle) / half_across;
            add_edge_number(stage, list, ndc, is_vertical, &number_text(value, step));
        }
    }
}

/// A number at the bottom edge (under a vertical line) or at the left edge, where no furniture is.
fn add_edge_number(stage: &Stage<'_>, list: &mut DrawList, ndc: f64, is_vertical: bool, text: &str) {
    const TRIAD: f64 = 84.0;
    const SCALE_BAR: f64 = 150.0;
    let viewport = stage.input.viewport;
    let (position, align) = if is_vertical {
        let x = viewport.points(DVec2::new(ndc, 0.0)).x;
        let free = x > TRIAD && x < viewport.width - SCALE_BAR;
        (free.then(|| Vec2::new(x as f32, viewport.height as f32 - 3.0)), Align::CenterBottom)
    } else {
        let y = viewport.points(DVec2::new(0.0, ndc)).y;
        let free = y > 34.0 && y < viewport.height - TRIAD;
        (free.then(|| Vec2::new(5.0, y as f32)), Align::LeftCenter)
    };
    if let Some(position) = position {
        list.labels.push(label(position, align, text, stage.palette.text_weak));
    }
}

/// Lines on the map's floor, with numbers along the two edges nearest to the eye.
fn add_floor(stage: &Stage<'_>, list: &mut DrawList) {
    let size = stage.map.size();
    let step = round_up_125(size.x.max(size.z) / 10.0 * (1.0 - 1e-9));
    let towards_eye = stage.camera.backward();
    for (axis, other) in [(Axis::X, Axis::Z), (Axis::Z, Axis::X)] {
        let (unit, across) = (axis.unit(), other.unit());
        let (length, width) = (size.dot(unit), size.dot(across));
        let near_edge = if towards_eye.dot(across) > 0.0 { width } else { 0.0 };
        let outward = if near_edge > 0.0 { 0.045 * width } else { -0.045 * width };
        for count in multiples(0.0, length, step) {
            let value = count as f64 * step;
            let ends = [unit * value, unit * value + across * width];
            stage.add_line(list, ends, Pen::hidden_by_bodies(stage.palette.grid_major, 1.0));
            let place = unit * value + across * (near_edge + outward);
            add_floor_number(stage, list, place, &number_text(value, step));
        }
        let place = unit * (0.5 * length) + across * (near_edge + 3.2 * outward);
        add_floor_number(stage, list, place, &format!("{} [m]", axis.label()));
    }
}

fn add_floor_number(stage: &Stage<'_>, list: &mut DrawList, place: DVec3, text: &str) {
    if let Some(at) = stage.on_screen(place) {
        list.labels.push(label(at.as_vec2(), Align::Center, text, stage.palette.text_weak));
    }
}

fn label(position: Vec2, align: Align, text: &str, color: Color) -> Label {
    Label { position, text: text.to_owned(), color, size: 11.0, align, back: Color::NONE }
}

/// A multiple of `step` with as many digits as the step has.
fn number_text(value: f64, step: f64) -> String {
    number(value, (-libm::log10(step).floor()).clamp(0.0, 12.0) as usize)
}
