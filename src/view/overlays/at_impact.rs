//! At an event: the velocities that its bodies came and left with, and where they are at the start and the end of the Δt.

use crate::record::ImpactBody;
use crate::scene::Shape;
use crate::view::overlays::scaled_arrows::{self, Quantity};
use crate::view::overlays::velocities;
use crate::view::stage::{Pen, Posed, Stage};
use crate::view::{DrawList, Point, PointShape};

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(frame) = stage.input.frame else { return };
    let impact = &frame.at_impact;
    let vectors = |of: fn(&ImpactBody) -> glam::DVec3| {
        impact.iter().map(|body| (body.position, of(body))).collect::<Vec<_>>()
    };
    // What came ends where the body is, so that it is seen to come.
    let scale = velocities::scale_with_events(stage);
    let after = Quantity { name: "event velocity", unit: "m/s", color: stage.palette.velocity };
    let before = Quantity { color: stage.palette.velocity.with_alpha(130), ..after };
    scaled_arrows::add_ending(stage, list, &before, &vectors(|body| body.before), scale);
    scaled_arrows::add_at(stage, list, &after, &vectors(|body| body.after), scale);
    if !impact.is_empty() && !velocities::are_shown(stage) {
        scaled_arrows::add_to_legend(list, &after, scale);
    }
    for body in impact.iter() {
        let Some(posed) = stage.bodies.iter().find(|posed| posed.body.key == body.key) else { continue };
        ghost(stage, list, posed, body.at_start, 1.0);
        if let Some(at_end) = body.at_end {
            ghost(stage, list, posed, at_end, 0.5);
        }
    }
}

/// The outline of a body elsewhere, with a line to where it is.
fn ghost(stage: &Stage<'_>, list: &mut DrawList, posed: &Posed<'_>, place: glam::DVec3, strength: f64) {
    let Shape::Sphere { radius } = posed.body.shape else { return };
    let size = (2.0 * radius / stage.metres_per_point(place)) as f32;
    if size.is_nan() || size >= 4000.0 {
        return;
    }
    let color = posed.color.with_alpha((200.0 * strength) as u8);
    list.points.push(Point { position: list.local(place), color, size, shape: PointShape::Ring });
    stage.add_line(list, [place, posed.position], Pen::hidden_by_bodies(color, 1.0));
}
