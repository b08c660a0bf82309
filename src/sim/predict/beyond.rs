//! When a path crosses a plane.

use glam::DVec3;

use crate::sim::roots::first_root;
use crate::sim::segment::Path;

/// First time ≥ `from` at which direction·x reaches `limit`, or comes within `early` of it on a path that
/// is not a parabola.
pub(in crate::sim) fn first_beyond(
    path: Path<'_>,
    direction: DVec3,
    limit: f64,
    early: f64,
    from: f64,
) -> Option<f64> {
    let segment = path.segment;
    let mut time = from;
    // |direction·ẍ| ≤ A: along an edge it is next to nothing, whatever |ẍ| is.
    let along = |way: DVec3| direction.dot(way).abs();
    let bound = path.series.map_or(0.0, |series| series.b.iter().map(|b| along(*b)).sum()) + along(segment.a);
    loop {
        let distance = limit - direction.dot(path.position(time));
        let rate = -direction.dot(path.velocity(time));
        if path.series.is_none() {
            return first_root(distance, rate, -direction.dot(segment.a)).map(|tau| time + tau);
        }
        if distance <= early {
            return Some(time);
        }
        // The limit is not reached before distance + rate·δ − ½Aδ² = 0.
        let step = first_root(distance, rate, -bound)?;
        if time + step > segment.end {
            return None;
        }
        if time + step <= time {
            return Some(time);
        }
        time += step;
    }
}
