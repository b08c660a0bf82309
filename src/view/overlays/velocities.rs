//! Velocities of the moving bodies; before a simulation, the velocities they start with.

use glam::DVec3;

use crate::scene::Motion;
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

fn of_bodies<'a>(stage: &'a Stage<'_>) -> Vec<OfBody<'a>> {
    let velocity = |posed: &Posed<'_>| -> Option<DVec3> {
        match (posed.now, posed.body.motion) {
            (Some(now), _) => Some(now.velocity),
            (None, Motion::Dynamic { velocity, .. }) => Some(velocity),
            (None, Motion::Static) => None,
        }
    };
    stage.bodies.iter().filter_map(|posed| Some((posed, velocity(posed)?))).collect()
}
