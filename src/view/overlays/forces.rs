//! Total applied force on each moving body, without contact forces.

use crate::view::DrawList;
use crate::view::overlays::scaled_arrows::{self, Quantity};
use crate::view::stage::Stage;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let vectors: Vec<_> = stage.bodies.iter().filter_map(|posed| Some((posed, posed.now?.force))).collect();
    let quantity = Quantity { name: "force", unit: "N", color: stage.palette.force };
    scaled_arrows::add(stage, list, &quantity, &vectors);
}
