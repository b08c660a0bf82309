//! Two great circles on each ball that turns with others, so that one sees how it does.

use glam::DVec3;

use crate::scene::Shape;
use crate::view::DrawList;
use crate::view::stage::{Pen, Stage};

const MOST: usize = 2000;

/// Lines of a circle, and its radius over that of the ball: lines are drawn on the surface, not in it.
const SIDES: u32 = 24;
const ABOVE: f64 = 1.004;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let turning = || stage.bodies.iter().filter_map(|posed| Some((posed, posed.now?.turn?)));
    for (posed, turn) in turning().take(MOST) {
        let Shape::Sphere { radius } = posed.body.shape else { continue };
        let pen = Pen::hidden_by_bodies(stage.palette.pattern, 1.5);
        for [across, along] in [[DVec3::X, DVec3::Y], [DVec3::Z, DVec3::Y]] {
            let at = |side: u32| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(side) / f64::from(SIDES));
                posed.position + ABOVE * radius * (turn.orientation * (cos * across + sin * along))
            };
            for side in 0..SIDES {
                stage.add_line(list, [at(side), at(side + 1)], pen);
            }
        }
    }
    let count = turning().count();
    if count > MOST {
        list.notes.push(format!("Turning: the first {MOST} of {count} balls."));
    }
}
