//! Velocities of the moving bodies; before a simulation, the velocities they start with.

use crate::scene::Motion;
use crate::view::DrawList;
use crate::view::overlays::scaled_arrows::{self, Quantity};
use crate::view::stage::Stage;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let velocity = |posed: &crate::view::stage::Posed<'_>| match (posed.now, posed.body.motion) {
        (Some(now), _) => Some(now.velocity),
        (None, Motion::Dynamic { velocity, .. }) => Some(velocity),
        (None, Motion::Static) => None,
    };
    let vectors: Vec<_> =
        stage.bodies.iter().filter_map(|posed| Some((posed.position, velocity(posed)?))).collect();
    let quantity = Quantity { name: "velocity", unit: "m/s", color: stage.palette.velocity };
    let scale = scaled_arrows::scale_at(stage, &vectors);
    scaled_arrows::add_at(stage, list, &quantity, &vectors, scale);
}
