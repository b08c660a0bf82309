//! What belongs to the view, not to the scene: the axis triad and the scale bar.

use glam::{DVec2, DVec3, Vec2};

use super::format::round_down_125;
use super::stage::Stage;
use super::{Align, Axis, Color, DrawList, Label, Stroke, with_unit};

/// Views smaller than this have no room for furniture, points.
const SMALLEST_VIEW: f64 = 120.0;

fn has_room(stage: &Stage<'_>) -> bool {
    stage.input.viewport.width >= SMALLEST_VIEW && stage.input.viewport.height >= SMALLEST_VIEW
}

/// The world's axes at the bottom left, as the view sees them. Axes that point at the viewer are drawn last.
pub(super) fn axis_triad(stage: &Stage<'_>, list: &mut DrawList) {
    const LENGTH: f64 = 26.0;
    if !has_room(stage) {
        return;
    }
    let camera = &stage.camera;
    let center = DVec2::new(42.0, stage.input.viewport.height - 42.0);
    let seen = |direction: DVec3| DVec2::new(direction.dot(camera.right()), -direction.dot(camera.up()));
    let mut axes = Axis::ALL;
    axes.sort_by(|a, b| a.unit().dot(camera.backward()).total_cmp(&b.unit().dot(camera.backward())));
    for axis in axes {
        let flat = seen(axis.unit());
        let tip = center + flat * LENGTH;
        let color = stage.palette.axes[axis as usize];
        list.strokes.push(Stroke { from: center.as_vec2(), to: tip.as_vec2(), color, width: 2.5 });
        // An axis seen end-on has no direction to put its letter in; it would cover the others' root.
        if flat.length() > 0.2 {
            let position = (center + flat * LENGTH + flat.normalize() * 9.0).as_vec2();
            let text = axis.label().to_owned();
            list.labels.push(Label {
                position,
                text,
                color,
                size: 13.0,
                align: Align::Center,
                back: Color::NONE,
            });
        }
    }
}

/// A bar of a round length at the bottom right. In perspective it holds at the target's depth.
pub(super) fn scale_bar(stage: &Stage<'_>, list: &mut DrawList) {
    const LONGEST: f64 = 110.0;
    if !has_room(stage) {
        return;
    }
    let viewport = stage.input.viewport;
    let metres_per_point = stage.camera.world_per_pixel(viewport.height);
    let metres = round_down_125(LONGEST * metres_per_point);
    let length = (metres / metres_per_point) as f32;
    let right = Vec2::new(viewport.width as f32 - 18.0, viewport.height as f32 - 20.0);
    let left = right - Vec2::new(length, 0.0);
    let color = stage.palette.text;
    let tick = Vec2::new(0.0, 4.0);
    for (from, to) in [(left, right), (left - tick, left + tick), (right - tick, right + tick)] {
        list.strokes.push(Stroke { from, to, color, width: 1.5 });
    }
    list.labels.push(Label {
        position: (left + right) * 0.5 - Vec2::new(0.0, 6.0),
        text: with_unit(metres),
        color,
        size: 12.0,
        align: Align::CenterBottom,
        back: Color::NONE,
    });
}

/// The legend's lines above the scale bar, upwards.
pub(super) fn legend(stage: &Stage<'_>, list: &mut DrawList) {
    const LINE: f32 = 16.0;
    if !has_room(stage) {
        return;
    }
    let viewport = stage.input.viewport;
    let corner = Vec2::new(viewport.width as f32 - 14.0, viewport.height as f32 - 46.0);
    for (i, (color, text)) in list.legend.iter().enumerate() {
        list.labels.push(Label {
            position: corner - Vec2::new(0.0, LINE * i as f32),
            text: text.clone(),
            color: *color,
            size: 12.0,
            align: Align::RightBottom,
            back: stage.palette.label_back,
        });
    }
}
