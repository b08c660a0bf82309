//! Sphere against sphere, of which the second may be static: d = |x_b − x_a| − (r_a + r_b).

use glam::DVec3;

use super::advance::{Skip, Span, first_contact as advance};
use super::approach::{Across, Approach, Way, gone_after};
use super::gap::{Ball, Gap, snap, snap_pressure};
use crate::sim::segment::{Path, Segment};
use crate::sim::shape::direction;
use crate::sim::tolerance::{CROSS_ROUNDING, STILL, SURELY_APART};

/// Relative motion of `b` as seen from `a`.
struct Relative {
    position: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
    /// Size of the speeds whose difference the velocity is: its rounding is a fraction of that.
    speeds: f64,
    /// The same for the accelerations.
    drives: f64,
}

/// `slack` as of [`Span`]; most pairs need none.
pub(super) fn first_contact(a: Ball<'_>, b: Ball<'_>, from: f64, slack: impl FnOnce() -> f64) -> Option<f64> {
    let (seg_a, seg_b) = (a.path.segment, b.path.segment);
    let from = seg_a.start.max(seg_b.start).max(from);
    let until = seg_a.end.min(seg_b.end);
    if are_parabolas(a, b) && seg_a.a == seg_b.a {
        let position = b.path.position(from) - a.path.position(from);
        let (velocity_a, velocity_b) = (a.path.velocity(from), b.path.velocity(from));
        let speeds = || velocity_a.length() + velocity_b.length();
        let tau = straight(position, velocity_b - velocity_a, speeds, a.radius + b.radius);
        return tau.map(|tau| from + tau).filter(|time| *time <= until);
    }
    let search = span(a, b, from, until, slack());
    advance(search, |time| gap(a, b, time), |time| skip(a, b, search, time))
}

fn are_parabolas(a: Ball<'_>, b: Ball<'_>) -> bool {
    a.path.series.is_none() && b.path.series.is_none()
}

fn span(a: Ball<'_>, b: Ball<'_>, from: f64, until: f64, slack: f64) -> Span {
    let acceleration_bound = (!are_parabolas(a, b)).then(|| relative_bound(a.path, b.path));
    Span { from, until, acceleration_bound, slack }
}

/// [`skip`] until one of the segments ends.
pub(super) fn skip_from(a: Ball<'_>, b: Ball<'_>, slack: f64, time: f64) -> Skip {
    let until = a.path.segment.end.min(b.path.segment.end);
    skip(a, b, span(a, b, time, until, slack), time)
}

/// What isolating the root tells from a time on.
#[cold]
pub(super) fn skip(a: Ball<'_>, b: Ball<'_>, search: Span, time: f64) -> Skip {
    let relative = relative(a, b, time);
    let (reach, mut until) = (a.radius + b.radius, search.until);
    if search.acceleration_bound.is_none() {
        let way = [relative.position, relative.velocity, relative.acceleration];
        until = until.min(time + gone_after(way, reach));
    }
    let approach = Approach {
        from: time,
        until,
        reach,
        distance: relative.position.length() - reach,
        still: STILL * relative.speeds,
        slack: search.slack,
    };
    approach.skip(|from, span| {
        let way = Way::of(a.path, from, span).to(&Way::of(b.path, from, span));
        Across { way, less: 0.0 }
    })
}

/// Upper bound of the relative acceleration, m/s². Bodies integrated together move almost as one: what counts is
/// the difference of their series, or the search would creep along beside each other.
fn relative_bound(a: Path<'_>, b: Path<'_>) -> f64 {
    let (seg_a, seg_b) = (a.segment, b.segment);
    match (a.series, b.series) {
        (Some(series_a), Some(series_b)) if seg_a.start == seg_b.start && seg_a.step == seg_b.step => {
            let terms = series_a.b.iter().zip(&series_b.b);
            (seg_b.a - seg_a.a).length() + terms.map(|(a, b)| (*b - *a).length()).sum::<f64>()
        }
        _ => seg_a.acceleration_bound + seg_b.acceleration_bound,
    }
}

/// Whether two dynamic spheres fly straight as seen from each other and pass or part: a quick look that is
/// sure where it says so. `reach` is the sum of their radii or more, m. It says so of no pair that is nearer than
/// `near` beyond it, m: such a pair may lie against each other. Without branches but one, so that the looks at many
/// bodies overlap in the processor.
#[inline]
pub(in crate::sim) fn surely_pass(a: &Segment, b: &Segment, reach: f64, near: f64) -> bool {
    let from = if a.start > b.start { a.start } else { b.start };
    let (tau_a, tau_b) = (from - a.start, from - b.start);
    let (p, v) = if (a.acceleration_bound == 0.0) & (b.acceleration_bound == 0.0) {
        ((b.x + tau_b * b.v) - (a.x + tau_a * a.v), b.v - a.v)
    } else if a.step > 0.0 || b.step > 0.0 || a.a != b.a {
        return false;
    } else {
        let p = (b.x + tau_b * (b.v + (0.5 * tau_b) * b.a)) - (a.x + tau_a * (a.v + (0.5 * tau_a) * a.a));
        (p, (b.v + tau_b * b.a) - (a.v + tau_a * a.a))
    };
    let (p2, v2, approach) = (p.length_squared(), v.length_squared(), p.dot(v));
    // |p×v|² = p²v² − (p·v)², which is sure where it is more than its rounding.
    let across = p2 * v2 - approach * approach - CROSS_ROUNDING * (p2 * v2);
    (p2 > (reach + near) * (reach + near)) & ((approach >= 0.0) | (v2 * (reach * reach) < across))
}

/// Whether two spheres surely stay farther apart than `reach` and `near`, m, while both of their segments last, whatever
/// drives them: from the straight way they part by ½Aτ² at most, where |ẍ| ≤ A.
pub(in crate::sim) fn surely_stay_apart(a: Path<'_>, b: Path<'_>, reach: f64, near: f64) -> bool {
    let (seg_a, seg_b) = (a.segment, b.segment);
    let from = seg_a.start.max(seg_b.start);
    let lasts = seg_a.end.min(seg_b.end) - from;
    let p = b.position(from) - a.position(from);
    let v = b.velocity(from) - a.velocity(from);
    let bends = 0.5 * (seg_a.acceleration_bound + seg_b.acceleration_bound) * lasts * lasts;
    let nearest = p + (-p.dot(v) / v.length_squared()).clamp(0.0, lasts.max(0.0)) * v;
    let kept = reach + near + bends;
    nearest.length_squared() > kept * kept
}

pub(super) fn gap(a: Ball<'_>, b: Ball<'_>, time: f64) -> Gap {
    gap_between(&relative(a, b, time), a.path.position(time), a.radius, b.radius)
}

fn relative(a: Ball<'_>, b: Ball<'_>, time: f64) -> Relative {
    let (velocity_a, velocity_b) = (a.path.velocity(time), b.path.velocity(time));
    let (drive_a, drive_b) = (a.path.acceleration(time), b.path.acceleration(time));
    Relative {
        position: b.path.position(time) - a.path.position(time),
        velocity: velocity_b - velocity_a,
        acceleration: drive_b - drive_a,
        speeds: velocity_a.length() + velocity_b.length(),
        drives: a.path.acceleration_size(drive_a) + b.path.acceleration_size(drive_b),
    }
}

fn gap_between(relative: &Relative, at: DVec3, radius_a: f64, radius_b: f64) -> Gap {
    let (distance, normal) = direction(relative.position);
    let rate = normal.dot(relative.velocity);
    let across = relative.velocity - rate * normal;
    // d̈ = n·p̈ + |ṗ⊥|²/|p|
    let turn = if distance > 0.0 { across.length_squared() / distance } else { 0.0 };
    let drive = normal.dot(relative.acceleration);
    Gap {
        distance: distance - (radius_a + radius_b),
        rate: snap(rate, relative.speeds),
        bend: snap_pressure(drive + turn, relative.drives + turn),
        drive,
        normal,
        point: at + radius_a * normal,
    }
}

/// Whether two points that fly straight pass each other by more than `reach`, and are farther apart now.
///
/// (p·v)² − v²(p² − R²) = v²R² − |p×v|²: no cancellation when far away, which tells a graze from a miss.
fn misses(p: DVec3, v: DVec3, reach: f64) -> bool {
    (v.length_squared() * reach * reach < p.cross(v).length_squared())
        & (p.length_squared() > (1.0 + SURELY_APART) * reach * reach)
}

/// First τ ≥ 0 with |p + vτ| = R while closing. `speeds` is the size of the speeds whose difference v is.
///
/// Most pairs part or pass each other: they are told without a square root.
fn straight(p: DVec3, v: DVec3, speeds: impl Fn() -> f64, reach: f64) -> Option<f64> {
    let approach = p.dot(v);
    if approach >= 0.0 || misses(p, v, reach) {
        return None;
    }
    let distance = p.length();
    if snap(approach, distance * speeds()) == 0.0 {
        return None;
    }
    let excess = (distance - reach) * (distance + reach);
    if excess <= 0.0 {
        return Some(0.0);
    }
    let discriminant = v.length_squared() * reach * reach - p.cross(v).length_squared();
    (discriminant >= 0.0).then(|| excess / (discriminant.sqrt() - approach))
}
