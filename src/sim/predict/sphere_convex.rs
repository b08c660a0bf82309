//! Sphere against any convex shape at rest: the distance of the centre to the shape, less the radius.

use glam::DVec3;

use super::advance::{Skip, Span, first_contact as advance};
use super::gap::{Ball, Gap, snap, snap_pressure, touch_tolerance};
use crate::sim::shape::{Convex, Near};

pub(super) fn first_contact(ball: Ball<'_>, shape: &dyn Convex, at: DVec3, from: f64) -> Option<f64> {
    let slack = ball.tolerance().max(touch_tolerance(at, ball.radius));
    let unknown = |_: f64| Skip::Unknown;
    search(ball, |point, _| shape.nearest(at, point), ball.path.segment.start.max(from), slack, unknown)
}

/// Conservative advancement from `from` on. `skip` as of [`advance`].
pub(super) fn search(
    ball: Ball<'_>,
    nearest: impl Fn(DVec3, DVec3) -> Near,
    from: f64,
    slack: f64,
    skip: impl Fn(f64) -> Skip,
) -> Option<f64> {
    let segment = ball.path.segment;
    let acceleration_bound = ball.path.series.map(|_| segment.acceleration_bound);
    let search = Span { from, until: segment.end, acceleration_bound, slack };
    advance(search, |time| gap(ball, &nearest, time), skip)
}

/// The gap from what the centre of the sphere, at a point with a velocity, sees of the shape.
pub(super) fn gap(ball: Ball<'_>, nearest: impl Fn(DVec3, DVec3) -> Near, time: f64) -> Gap {
    let at = ball.path.position(time);
    let velocity = ball.path.velocity(time);
    let acceleration = ball.path.acceleration(time);
    let near = nearest(at, velocity);
    let turn = near.turn_away(velocity);
    let drive = -near.towards.dot(acceleration);
    Gap {
        distance: near.distance - ball.radius,
        rate: snap(-near.towards.dot(velocity), velocity.length()),
        bend: snap_pressure(turn + drive, ball.path.acceleration_size(acceleration) + turn),
        drive,
        normal: near.towards,
        point: at + ball.radius * near.towards,
    }
}
