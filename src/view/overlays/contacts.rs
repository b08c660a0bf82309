//! Where bodies met during the last Δt: a point, and the normal with a length that grows with the impulse.

use glam::DVec3;

use crate::sim::{BodyRef, Event, EventKind};
use crate::view::camera::is_drawable;
use crate::view::overlays::crowd::share_of_size;
use crate::view::overlays::scaled_arrows::width_of;
use crate::view::stage::Stage;
use crate::view::{Arrow, DrawList, Point, PointShape};

const MOST: usize = 1000;

/// Lengths of the arrows of no impulse and of the largest one shown, points.
const ARROW_POINTS: (f64, f64) = (16.0, 52.0);

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(frame) = stage.input.frame else { return };
    let hits = frame.events.iter().map(|row| &row.event).filter(|event| is_contact(event));
    let count = hits.clone().count();
    let largest = hits.clone().map(|event| event.impulse).fold(0.0, f64::max);
    let share = share_of_size(stage.input.viewport, count.min(MOST));
    let last = hits.skip(count.saturating_sub(MOST));
    for event in last.filter(|event| stage.shows_mark_at(event.point)) {
        add_contact(stage, list, event, (largest, share));
    }
    if count > MOST || frame.events_truncated {
        list.notes.push(format!("Contacts: only the last {} of the Δt.", count.min(MOST)));
    }
}

fn is_contact(event: &Event) -> bool {
    matches!(event.kind, EventKind::Impact | EventKind::Collapse) && is_drawable(event.point)
}

/// `largest`: the largest impulse shown, N·s; `share`: of their size that marks have.
fn add_contact(stage: &Stage<'_>, list: &mut DrawList, event: &Event, (largest, share): (f64, f64)) {
    let strength = if largest > 0.0 { event.impulse / largest } else { 0.0 };
    let points = share * (ARROW_POINTS.0 + (ARROW_POINTS.1 - ARROW_POINTS.0) * strength);
    let tip = event.point + pushed_towards(event) * (points * stage.metres_per_point(event.point));
    let (from, color) = (list.local(event.point), stage.palette.contact);
    list.arrows.push(Arrow { from, to: list.local(tip), color, width: width_of(share) });
    list.points.push(Point { position: from, color, size: (7.0 * share) as f32, shape: PointShape::Disc });
}

/// The way in which the impact pushed the body that can move; of two, the second.
pub(super) fn pushed_towards(event: &Event) -> DVec3 {
    match event.b {
        Some(BodyRef::Static(_)) => -event.normal,
        _ => event.normal,
    }
}
