//! Sphere against sphere, moving or fixed: d = |x_b − x_a| − (r_a + r_b).

use glam::DVec3;

use super::advance::{Search, first_contact as advance};
use super::{Gap, Mover, hold_time, snap, touch_tolerance};
use crate::scene::SimParams;

/// Relative motion of `b` as seen from `a`.
struct Relative {
    position: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
    /// Size of the speeds whose difference the velocity is: its rounding is a fraction of that.
    speeds: f64,
}

pub(super) fn first_contact(a: Mover<'_>, b: Mover<'_>, params: &SimParams, from: f64) -> Option<f64> {
    let (seg_a, seg_b) = (a.path.segment, b.path.segment);
    let from = seg_a.start.max(seg_b.start).max(from);
    let until = seg_a.end.min(seg_b.end);
    let relative = relative(a, b, from);
    if let Some(hold) = pressed_together(a, b, &relative, params) {
        return Some(from + hold).filter(|time| *time <= until);
    }
    let parabolas = a.path.series.is_none() && b.path.series.is_none();
    if parabolas && relative.acceleration == DVec3::ZERO {
        return straight(&relative, a.radius + b.radius).map(|tau| from + tau).filter(|time| *time <= until);
    }
    let acceleration_bound = (!parabolas).then_some(seg_a.acceleration_bound + seg_b.acceleration_bound);
    let slack = touch_tolerance(seg_a.x, a.radius).max(touch_tolerance(seg_b.x, b.radius));
    advance(Search { from, until, acceleration_bound, slack }, |time| gap(a, b, time))
}

pub(super) fn first_contact_fixed(mover: Mover<'_>, center: DVec3, radius: f64, from: f64) -> Option<f64> {
    let seg = mover.path.segment;
    let from = seg.start.max(from);
    if mover.path.series.is_none() && seg.a == DVec3::ZERO {
        let position = center - mover.path.position(from);
        let relative =
            Relative { position, velocity: -seg.v, acceleration: DVec3::ZERO, speeds: seg.v.length() };
        return straight(&relative, mover.radius + radius)
            .map(|tau| from + tau)
            .filter(|time| *time <= seg.end);
    }
    let search = Search {
        from,
        until: seg.end,
        acceleration_bound: mover.path.series.map(|_| seg.acceleration_bound),
        slack: touch_tolerance(seg.x, mover.radius),
    };
    advance(search, |time| gap_fixed(mover, center, radius, time))
}

pub(super) fn gap(a: Mover<'_>, b: Mover<'_>, time: f64) -> Gap {
    gap_of(&relative(a, b, time), a.path.position(time), a.radius, b.radius)
}

pub(super) fn gap_fixed(mover: Mover<'_>, center: DVec3, radius: f64, time: f64) -> Gap {
    let (at, velocity) = (mover.path.position(time), mover.path.velocity(time));
    let relative = Relative {
        position: center - at,
        velocity: -velocity,
        acceleration: -mover.path.acceleration(time),
        speeds: velocity.length(),
    };
    gap_of(&relative, at, mover.radius, radius)
}

fn relative(a: Mover<'_>, b: Mover<'_>, time: f64) -> Relative {
    let (velocity_a, velocity_b) = (a.path.velocity(time), b.path.velocity(time));
    Relative {
        position: b.path.position(time) - a.path.position(time),
        velocity: velocity_b - velocity_a,
        acceleration: b.path.acceleration(time) - a.path.acceleration(time),
        speeds: velocity_a.length() + velocity_b.length(),
    }
}

fn gap_of(relative: &Relative, at: DVec3, radius_a: f64, radius_b: f64) -> Gap {
    let distance = relative.position.length();
    // Coincident centres have no direction. A fixed one lets them part: one taken from the velocity
    // would turn with every impact.
    let normal = if distance > 0.0 { relative.position / distance } else { DVec3::X };
    let rate = normal.dot(relative.velocity);
    let across = relative.velocity - rate * normal;
    // d̈ = n·p̈ + |ṗ⊥|²/|p|
    let turn = if distance > 0.0 { across.length_squared() / distance } else { 0.0 };
    let drive = normal.dot(relative.acceleration);
    Gap {
        distance: distance - (radius_a + radius_b),
        rate: snap(rate, relative.speeds),
        bend: snap(drive + turn, relative.acceleration.length() + turn),
        drive,
        normal,
        point: at + radius_a * normal,
    }
}

/// How long to hold two spheres that touch, hardly move against each other, and are driven together.
fn pressed_together(a: Mover<'_>, b: Mover<'_>, relative: &Relative, params: &SimParams) -> Option<f64> {
    if relative.acceleration == DVec3::ZERO {
        return None;
    }
    let gap = gap_of(relative, DVec3::ZERO, a.radius, b.radius);
    let slack = touch_tolerance(a.path.segment.x, a.radius).max(touch_tolerance(b.path.segment.x, b.radius));
    let hold = hold_time(params, -gap.bend);
    let still = gap.rate <= 0.0 && gap.rate >= 1e-3 * gap.bend * hold;
    (gap.distance <= slack && gap.bend < 0.0 && still).then_some(hold)
}

/// First τ ≥ 0 with |p + vτ| = R while closing, for a relative motion without acceleration.
fn straight(relative: &Relative, reach: f64) -> Option<f64> {
    let (p, v) = (relative.position, relative.velocity);
    let approach = p.dot(v);
    if snap(approach, p.length() * relative.speeds) >= 0.0 {
        return None;
    }
    let distance = p.length();
    let excess = (distance - reach) * (distance + reach);
    if excess <= 0.0 {
        return Some(0.0);
    }
    // (p·v)² − v²(p² − R²) = v²R² − |p×v|²: no cancellation when far away, which tells a graze from a miss.
    let discriminant = v.length_squared() * reach * reach - p.cross(v).length_squared();
    if discriminant < 0.0 {
        return None;
    }
    Some(excess / (discriminant.sqrt() - approach))
}
