//! Snapping to what is there: a sphere that is dragged stops where it touches a neighbour, or where its centre
//! is level with another's.

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
    /// The neighbour's centre or the foot on its surface, m.
    pub from: DVec3,
    /// The dragged centre.
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

/// Where a centre at `place` is level with a neighbour's along each of the world's axes that `freedom` has, if
/// that takes no more than `reach` metres; with a guide for each axis.
pub fn aligned<'n>(
    place: DVec3,
    freedom: Freedom,
    neighbours: impl IntoIterator<Item = Neighbour<'n>>,
    reach: f64,
) -> (DVec3, Vec<Guide>) {
    let axes: Vec<Axis> = freedom.directions().filter_map(Axis::of_unit).collect();
    let mut best: [Option<(f64, Neighbour<'n>)>; 3] = [None; 3];
    for neighbour in neighbours {
        for axis in &axes {
            let at = *axis as usize;
            let off = (neighbour.position[at] - place[at]).abs();
            if off <= reach && best[at].is_none_or(|(least, _)| off < least) {
                best[at] = Some((off, neighbour));
            }
        }
    }
    let mut level = place;
    for axis in &axes {
        if let Some((_, neighbour)) = best[*axis as usize] {
            level[*axis as usize] = neighbour.position[*axis as usize];
        }
    }
    let guide = |(_, neighbour): (f64, Neighbour<'n>)| Guide {
        with: neighbour.body.key,
        from: neighbour.position,
        to: level,
        touches: false,
    };
    (level, best.into_iter().flatten().map(guide).collect())
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
