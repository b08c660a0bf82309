//! Sphere against plate: what a parabola has in closed form, before the search that any convex shape has.

use super::gap::{Ball, snap, touch_tolerance};
use super::sphere_convex::search;
use crate::sim::roots::first_root;
use crate::sim::shape::Plate;

pub(super) fn first_contact(ball: Ball<'_>, plate: &Plate, from: f64) -> Option<f64> {
    let seg = ball.path.segment;
    let slack = ball.tolerance().max(touch_tolerance(plate.center, ball.radius));
    let mut from = seg.start.max(from);
    // Along a parabola the time at which the sphere reaches the plane of the plate has a closed form. It
    // is the contact if the foot lies on the plate, and not later than any contact if it does not.
    if ball.path.series.is_none() {
        match reach_plane(ball, plate, from, slack) {
            Reach::Never => return None,
            Reach::Within => {}
            Reach::At(time) => {
                if time > seg.end {
                    return None;
                }
                if plate.covers(plate.local_of(ball.path.position(time))) {
                    return Some(time);
                }
                from = time;
            }
        }
    }
    search(ball, |point| plate.nearest(point), from, slack)
}

enum Reach {
    /// The sphere stays off the plane for ever.
    Never,
    /// The sphere cuts the plane at the start already.
    Within,
    At(f64),
}

/// First τ ≥ 0 with |z(τ)| = r, approaching, for z(τ) = z + ż τ + ½ z̈ τ² in the plate's frame.
fn reach_plane(ball: Ball<'_>, plate: &Plate, from: f64, slack: f64) -> Reach {
    let z = plate.local_of(ball.path.position(from)).z;
    let side = if z < 0.0 { -1.0 } else { 1.0 };
    let distance = side * z - ball.radius;
    let velocity = ball.path.velocity(from);
    let rate = snap(side * plate.normal.dot(velocity), velocity.length());
    let acceleration = side * plate.normal.dot(ball.path.segment.a);
    if distance < -slack || (distance <= 0.0 && (rate < 0.0 || (rate == 0.0 && acceleration < 0.0))) {
        return Reach::Within;
    }
    let tau = first_root(distance, rate, acceleration);
    tau.map_or(Reach::Never, |tau| Reach::At(from + tau))
}
