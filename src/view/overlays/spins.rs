//! Angular velocities of the moving bodies; before a simulation, those they start with.

use crate::view::DrawList;
use crate::view::overlays::scaled_arrows::{self, Quantity};
use crate::view::stage::Stage;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let moving = stage.bodies.iter().filter(|posed| posed.body.is_dynamic());
    let vectors: Vec<_> = moving
        .map(|posed| {
            let turn = posed.now.and_then(|now| now.turn);
            (posed, turn.map_or(posed.body.spin, |turn| turn.spin))
        })
        .collect();
    let quantity = Quantity { name: "spin", unit: "rad/s", color: stage.palette.spin };
    scaled_arrows::add(stage, list, &quantity, &vectors);
}
