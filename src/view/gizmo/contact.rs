//! Snapping to what is there: a sphere that is dragged stops where it touches a neighbour, and everything where its centre or
//! its edges are level with another's.

use glam::{DMat3, DVec3};

use super::{Axis, Freedom};
use crate::scene::{Body, NodeKey, Shape, rotation_matrix};

/// A body that can be snapped to, where it is seen.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour<'a> {
    pub body: &'a Body,
    pub position: DVec3,
}

/// Why something snapped: a line from it to its neighbour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    pub with: NodeKey,
    /// The neighbour's centre or corner, or the foot on its surface, m.
    pub from: DVec3,
    /// The dragged centre or corner.
    pub to: DVec3,
    pub touches: bool,
}

/// Where a sphere that is at `place` touches a neighbour instead, and the neighbour, if that takes no more than
/// `reach` metres of way within `freedom`. The nearest such place counts.
pub fn touching<'n>(
    radius: f64,
    place: DVec3,
    freedom: Freedom,
    neighbours: impl IntoIterator<Item = Neighbour<'n>>,
    reach: f64,
) -> Option<(DVec3, Guide)> {
    let candidates = neighbours.into_iter().filter_map(|neighbour| {
        let (at, foot) = match neighbour.body.shape {
            Shape::Sphere { radius: other } => {
                (on_sphere(place, freedom, neighbour.position, radius + other)?, neighbour.position)
            }
            Shape::Plane { half_x, half_y } => {
                let turn = rotation_matrix(neighbour.body.rotation);
                on_plate(place, freedom, (neighbour.position, turn), [half_x, half_y], radius)?
            }
            Shape::Unbuilt { .. } => return None,
        };
        let guide = Guide { with: neighbour.body.key, from: foot, to: at, touches: true };
        Some((at, guide)).filter(|(at, _)| at.is_finite() && at.distance(place) <= reach)
    });
    candidates.min_by(|(a, _), (b, _)| a.distance(place).total_cmp(&b.distance(place)))
}

/// What of a body comes level with what of others, relative to its centre, m: the centre, and the corners and so the edges of
/// a plate whose sides lie along the world's axes. Corners of others are level with nothing that a person would see.
pub fn features(body: &Body) -> Vec<DVec3> {
    let mut features = vec![DVec3::ZERO];
    if let Shape::Plane { half_x, half_y } = body.shape {
        let turn = rotation_matrix(body.rotation);
        if ![turn.x_axis, turn.y_axis].into_iter().all(is_along_an_axis) {
            return features;
        }
        for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            features.push(turn * DVec3::new(x * half_x, y * half_y, 0.0));
        }
    }
    features
}

/// But for what Euler angles leave by rounding.
fn is_along_an_axis(unit: DVec3) -> bool {
    unit.abs().max_element() > 1.0 - 1e-12
}

/// Two features that are level along an axis but for `off`.
#[derive(Clone, Copy)]
struct Level<'n> {
    off: f64,
    with: &'n Body,
    own: DVec3,
    other: DVec3,
}

/// Where one of the features of a body at `place` is level with one of a neighbour's along each of the world's axes that
/// `freedom` has, if that takes no more than `reach` metres; with a guide for each axis.
pub fn aligned<'n>(
    place: DVec3,
    own: &[DVec3],
    freedom: Freedom,
    neighbours: impl IntoIterator<Item = Neighbour<'n>>,
    reach: f64,
) -> (DVec3, Vec<Guide>) {
    let axes: Vec<Axis> = freedom.directions().filter_map(Axis::of_unit).collect();
    let mut best: [Option<Level<'n>>; 3] = [None; 3];
    for neighbour in neighbours {
        for other in features(neighbour.body) {
            let other = neighbour.position + other;
            for axis in axes.iter().map(|axis| *axis as usize) {
                for &own in own {
                    let off = other[axis] - (place + own)[axis];
                    // The nearer counts, and centres before corners, which come first.
                    let is_nearer = best[axis].is_none_or(|best| off.abs() < best.off.abs() - 1e-9 * reach);
                    if off.abs() <= reach && is_nearer {
                        best[axis] = Some(Level { off, with: neighbour.body, own, other });
                    }
                }
            }
        }
    }
    let mut at = place;
    for axis in axes.iter().map(|axis| *axis as usize) {
        if let Some(level) = best[axis] {
            at[axis] = level.other[axis] - level.own[axis];
        }
    }
    let guide = |level: Level<'_>| Guide {
        with: level.with.key,
        from: level.other,
        to: at + level.own,
        touches: false,
    };
    (at, best.into_iter().flatten().map(guide).collect())
}

/// The nearest place of the line or plane through `place` at `distance` from a centre.
fn on_sphere(place: DVec3, freedom: Freedom, center: DVec3, distance: f64) -> Option<DVec3> {
    match freedom {
        Freedom::Line(unit) => {
            // |p + s u − c|² = d²
            let from_center = place - center;
            let half_b = from_center.dot(unit);
            let off = from_center - unit * half_b;
            let root = (distance * distance - off.length_squared()).sqrt();
            [-half_b - root, -half_b + root]
                .into_iter()
                .filter(|s| s.is_finite())
                .min_by(|a, b| a.abs().total_cmp(&b.abs()))
                .map(|s| place + unit * s)
        }
        Freedom::Plane(u, v) => {
            let normal = u.cross(v);
            let height = (place - center).dot(normal);
            let foot = center + normal * height;
            let within = (distance * distance - height * height).sqrt();
            let direction = (place - foot).try_normalize()?;
            within.is_finite().then(|| foot + direction * within)
        }
    }
}

/// The nearest place of the line or plane through `place` at `radius` from a plate, with the foot on the plate.
fn on_plate(
    place: DVec3,
    freedom: Freedom,
    (center, turn): (DVec3, DMat3),
    half: [f64; 2],
    radius: f64,
) -> Option<(DVec3, DVec3)> {
    let normal = turn.z_axis;
    let height = (place - center).dot(normal);
    let wanted = if height < 0.0 { -radius } else { radius };
    // the way within the freedom that gains height fastest
    let way = freedom.within(normal);
    let gain = way.dot(normal);
    let at = place + way * ((wanted - height) / gain);
    let local = turn.transpose() * (at - center);
    let over = local.x.abs() <= half[0] && local.y.abs() <= half[1];
    (gain > 1e-6 && over).then(|| (at, at - normal * wanted))
}
