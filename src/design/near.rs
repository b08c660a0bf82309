//! Pairs of bodies whose boxes meet, by sorting along one axis and sweeping.

use super::extent::Extent;
use crate::scene::Body;

/// Gives each pair of bodies, by their indices in order, whose boxes are nearer than `margin`, until `visit` says
/// that it has seen enough. Pairs in which neither moves are left out.
pub(super) fn for_each_near(bodies: &[Body], margin: f64, mut visit: impl FnMut(usize, usize) -> bool) {
    let extents: Vec<Extent> = bodies.iter().map(Extent::of).collect();
    let Some(all) = extents.iter().copied().reduce(Extent::with) else { return };
    let axis = all
        .size()
        .to_array()
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))
        .map_or(0, |(axis, _)| axis);
    let (start, end) = (|at: usize| extents[at].min[axis], |at: usize| extents[at].max[axis] + margin);
    let mut order: Vec<usize> = (0..bodies.len()).collect();
    order.sort_by(|a, b| start(*a).total_cmp(&start(*b)).then(a.cmp(b)));
    let mut open: Vec<usize> = Vec::new();
    for now in order {
        open.retain(|other| end(*other) >= start(now));
        for &other in &open {
            let moves = bodies[now].is_dynamic() || bodies[other].is_dynamic();
            if moves && extents[now].meets(extents[other], margin) && !visit(now.min(other), now.max(other)) {
                return;
            }
        }
        open.push(now);
    }
}
