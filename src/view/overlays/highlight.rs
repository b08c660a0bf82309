//! The event that is being looked at: its place, its normal, and where its bodies were at that moment.

use glam::DVec3;

use crate::scene::{NodeKey, Shape};
use crate::view::camera::is_drawable;
use crate::view::format::number;
use crate::view::overlays::contacts::pushed_towards;
use crate::view::stage::Stage;
use crate::view::{Align, Arrow, DrawList, Label, Point, PointShape};

/// Length of the normal, points.
const ARROW_POINTS: f64 = 64.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(row) = stage.input.highlighted else { return };
    let event = &row.event;
    if !is_drawable(event.point) {
        return;
    }
    let (position, color) = (list.local(event.point), stage.palette.highlight);
    // Bodies have moved on since: rings show where they touched.
    ghost(stage, list, row.a_key, event.point, -event.normal);
    if let Some(b) = row.b_key {
        ghost(stage, list, b, event.point, event.normal);
    }
    if event.normal != DVec3::ZERO {
        let tip = event.point + pushed_towards(event) * (ARROW_POINTS * stage.metres_per_point(event.point));
        list.arrows.push(Arrow { from: position, to: list.local(tip), color, width: 2.5 });
    }
    list.points.push(Point { position, color, size: 20.0, shape: PointShape::Ring });
    list.points.push(Point { position, color, size: 8.0, shape: PointShape::Disc });
    if let Some(at) = stage.on_screen(event.point) {
        list.labels.push(Label {
            position: at.as_vec2() + glam::Vec2::new(14.0, 0.0),
            text: format!(
                "{} {} · t = {} s",
                event.kind.name().replace('_', " "),
                event.seq,
                number(event.time, 6)
            ),
            color,
            size: 12.0,
            align: Align::LeftCenter,
            back: stage.palette.label_back,
        });
    }
}

/// The outline of a ball that touched `point` and lay on the `outward` side of it.
fn ghost(stage: &Stage<'_>, list: &mut DrawList, key: NodeKey, point: DVec3, outward: DVec3) {
    let Some(posed) = stage.bodies.iter().find(|posed| posed.body.key == key) else { return };
    let Shape::Sphere { radius } = posed.body.shape else { return };
    let center = point + outward * radius;
    let size = (2.0 * radius / stage.metres_per_point(center)) as f32;
    if posed.body.is_dynamic() && outward != DVec3::ZERO && size < 4000.0 {
        let position = list.local(center);
        list.points.push(Point { position, color: stage.palette.highlight, size, shape: PointShape::Ring });
    }
}
