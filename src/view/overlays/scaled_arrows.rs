//! Arrows whose lengths stand for a quantity, all at one round scale.

use glam::DVec3;

use crate::view::format::round_down_125;
use crate::view::stage::Stage;
use crate::view::{Arrow, Color, DrawList, format::number};

const MOST: usize = 5000;

/// Length of the longest arrow, and the shortest that a quantity above zero is drawn with, points.
const LONGEST: f64 = 90.0;
const SHORTEST: f64 = 12.0;

/// What the arrows show.
pub(super) struct Quantity {
    pub name: &'static str,
    pub unit: &'static str,
    pub color: Color,
}

/// Adds an arrow for each (place, vector), and a line with the scale to the legend.
pub(super) fn add(stage: &Stage<'_>, list: &mut DrawList, quantity: &Quantity, vectors: &[(DVec3, DVec3)]) {
    let largest = vectors.iter().map(|(_, vector)| vector.length()).fold(0.0, f64::max);
    if !(largest.is_finite() && largest > 0.0) {
        return;
    }
    let metres_per_point = stage.camera.world_per_pixel(stage.input.viewport.height);
    // Rounded, so that arrows do not breathe with every change of the largest.
    let metres_per_unit = round_down_125(LONGEST * metres_per_point / largest);
    for (place, vector) in vectors.iter().take(MOST) {
        let Some(direction) = vector.try_normalize() else { continue };
        let shortest = SHORTEST * stage.metres_per_point(*place);
        let length = (vector.length() * metres_per_unit).max(shortest);
        let (from, to) = (list.local(*place), list.local(*place + direction * length));
        list.arrows.push(Arrow { from, to, color: quantity.color, width: 2.0 });
    }
    let Quantity { name, unit, color } = quantity;
    list.legend.push((*color, format!("{name} arrows: 1 m = {} {unit}", number(1.0 / metres_per_unit, 9))));
    if vectors.len() > MOST {
        list.notes.push(format!("{name}: the first {MOST} of {} arrows.", vectors.len()));
    }
}
