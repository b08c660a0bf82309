//! Velocities of the moving bodies; before a simulation, the velocities they start with.

use glam::DVec3;

use crate::record::BodyFrame;
use crate::scene::Motion;
use crate::sim::ContactState;
use crate::view::DrawList;
use crate::view::overlays::scaled_arrows::{self, OfBody, Quantity};
use crate::view::stage::{Posed, Stage};

/// As the table of overlays has it.
const ID: &str = "velocities";

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let quantity = Quantity { name: "velocity", unit: "m/s", color: stage.palette.velocity };
    scaled_arrows::add_of_bodies(stage, list, &quantity, &of_bodies(stage), scale_with_events(stage));
}

pub(super) fn are_shown(stage: &Stage<'_>) -> bool {
    stage.input.overlays.contains(ID)
}

/// The scale of all velocities that the view shows, those at an event too, so that arrows can be compared; `None` without any.
pub(super) fn scale_with_events(stage: &Stage<'_>) -> Option<f64> {
    let impact = stage.input.frame.map_or(&[][..], |frame| &frame.at_impact);
    let of_event = impact.iter().flat_map(|body| [(body.position, body.before), (body.position, body.after)]);
    let mut vectors = Vec::new();
    if are_shown(stage) {
        vectors.extend(of_bodies(stage).into_iter().map(|(posed, velocity)| (posed.position, velocity)));
    }
    if stage.input.overlays.contains("impact") {
        vectors.extend(of_event);
    }
    scaled_arrows::scale_at(stage, &vectors)
}

/// Seconds in which a body crosses the map that is drawn without an arrow: what rounding leaves to bodies at rest.
const CROSSES_IN: f64 = 1e12;

/// The velocity that is drawn of a body now: none of what nobody would see move. What is stepped and lies still rises and falls
/// by ½gh in every step, and its velocity says at which moment of the step it is.
fn seen(stage: &Stage<'_>, now: &BodyFrame) -> DVec3 {
    let step = stage.input.frame.map_or(0.0, |frame| frame.plan.group_step);
    let trembling = if now.contact == ContactState::Stepped { now.acceleration.length() * step } else { 0.0 };
    let slowest = stage.input.scene.map.size.max_element() / CROSSES_IN;
    if now.velocity.length() > trembling.max(slowest) { now.velocity } else { DVec3::ZERO }
}

fn of_bodies<'a>(stage: &'a Stage<'_>) -> Vec<OfBody<'a>> {
    let velocity = |posed: &Posed<'_>| -> Option<DVec3> {
        match (posed.now, posed.body.motion) {
            (Some(now), _) => Some(seen(stage, now)),
            (None, Motion::Dynamic { velocity, .. }) => Some(velocity),
            (None, Motion::Static) => None,
        }
    };
    stage.bodies.iter().filter_map(|posed| Some((posed, velocity(posed)?))).collect()
}
