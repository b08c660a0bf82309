//! Sphere against plate: what a parabola has in closed form, before the search that any convex shape has, and the
//! way from the plate's nearest part where that search crawls.

use glam::DVec3;

use super::advance::Skip;
use super::approach::{Across, Approach, Way, gone_after};
use super::gap::{Ball, Gap, snap, touch_tolerance};
use super::sphere_convex::{self, search};
use crate::sim::roots::first_root;
use crate::sim::shape::{Feature, Near, Plate};
use crate::sim::tolerance::STILL;

pub(super) fn first_contact(ball: Ball<'_>, plate: &Plate, from: f64) -> Option<f64> {
    let seg = ball.path.segment;
    let slack = slack(ball, plate);
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
    let seen = |at: DVec3, velocity: DVec3| seen(plate, ball.radius, slack, at, velocity);
    search(ball, seen, from, slack, |time| skip(ball, plate, slack, time))
}

/// The gap of a sphere and a plate at a time.
pub(super) fn gap(ball: Ball<'_>, plate: &Plate, time: f64) -> Gap {
    let slack = slack(ball, plate);
    sphere_convex::gap(ball, |at, velocity| seen(plate, ball.radius, slack, at, velocity), time)
}

/// Rounding of the distance between the two, m.
pub(super) fn slack(ball: Ball<'_>, plate: &Plate) -> f64 {
    ball.tolerance().max(touch_tolerance(plate.center, ball.radius))
}

/// What of a plate a sphere meets. One that glides in the plane of a face towards its edge glides on over the face: whether
/// it is a rounding h too low for that can't be told, and by the edge it would then be hit at the speed v √(2h/r),
/// which is no rounding of v any more.
fn seen(plate: &Plate, radius: f64, slack: f64, at: DVec3, velocity: DVec3) -> Near {
    let near = plate.nearest(at);
    if near.feature == Feature::Face || near.distance - radius > slack {
        return near;
    }
    let height = plate.local_of(at).z;
    let towards = if height < 0.0 { plate.normal } else { -plate.normal };
    let inward = near.towards - near.towards.dot(towards) * towards;
    if (height.abs() - radius).abs() > slack || inward.dot(velocity) <= 0.0 {
        return near;
    }
    let distance = height.abs();
    Near { distance, towards, feature: Feature::Face, to_center: distance }
}

/// What isolating the root tells from a time on.
#[cold]
pub(super) fn skip(ball: Ball<'_>, plate: &Plate, slack: f64, time: f64) -> Skip {
    let (path, segment) = (ball.path, ball.path.segment);
    let (at, velocity) = (path.position(time), path.velocity(time));
    let mut until = segment.end;
    if path.series.is_none() {
        let reach = ball.radius + plate.half_x + plate.half_y;
        until = until.min(time + gone_after([at - plate.center, velocity, segment.a], reach));
    }
    let approach = Approach {
        from: time,
        until,
        reach: ball.radius,
        distance: plate.nearest(at).distance - ball.radius,
        still: STILL * velocity.length(),
        slack,
    };
    approach.skip(|from, span| across(plate, &Way::of(path, from, span)))
}

/// The way from what is nearest of the plate: its coordinates in the plate's frame, along each side only what is
/// beyond it.
fn across(plate: &Plate, way: &Way) -> Across {
    let turned = |c: DVec3| DVec3::new(plate.axis_x.dot(c), plate.axis_y.dot(c), plate.normal.dot(c));
    let mut local = way.map(turned);
    local.c[0] = plate.local_of(way.c[0]);
    let speed = local.derivative();
    let mut less = 0.0;
    for (axis, half) in [plate.half_x, plate.half_y].into_iter().enumerate() {
        let (low, high) = local.range(axis);
        if low > half {
            local.c[0][axis] -= half;
        } else if high < -half {
            local.c[0][axis] += half;
        } else {
            // Over the plate, or now over it and now beyond: no nearer than if it were over it, and closing by no
            // more than where it is farthest beyond.
            let (slowest, fastest) = speed.range(axis);
            less += (high - half).max(0.0) * (-slowest).max(0.0);
            less += (-half - low).max(0.0) * fastest.max(0.0);
            local.c.iter_mut().for_each(|c| c[axis] = 0.0);
        }
    }
    Across { way: local, less }
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
