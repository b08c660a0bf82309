//! Pairs of bodies whose boxes meet, by a tree of boxes: n log n for any sizes and places, where a sweep along one axis
//! compares each body of a lattice with the two layers around it.

use super::extent::Extent;
use crate::scene::{Body, BodyList};

/// Bodies in a leaf: below so many comparing all costs less than dividing them.
const LEAF: usize = 8;

/// Gives each pair of bodies, by their indices in order, whose boxes are nearer than `margin`, until `visit` says
/// that it has seen enough. Pairs in which neither moves are left out.
pub(super) fn for_each_near(bodies: &BodyList, margin: f64, mut visit: impl FnMut(usize, usize) -> bool) {
    // What is nowhere meets nothing, and no box around others may hold it.
    let boxes = bodies.iter().enumerate().map(Boxed::of);
    let mut boxes: Vec<Boxed> =
        boxes.filter(|one| !(one.extent.min.is_nan() || one.extent.max.is_nan())).collect();
    let Some(root) = Node::over(&mut boxes) else { return };
    let meet = |a: &Boxed, b: &Boxed| (a.moves || b.moves) && a.extent.meets(b.extent, margin);
    let near = |a: &Node, b: &Node| (a.moves || b.moves) && a.extent.meets(b.extent, margin);
    let mut open = vec![(&root, &root)];
    while let Some((a, b)) = open.pop() {
        if !near(a, b) {
            continue;
        }
        match (a.parts.as_deref(), b.parts.as_deref()) {
            (Some([low, high]), _) if std::ptr::eq(a, b) => {
                open.extend([(low, low), (low, high), (high, high)]);
            }
            (Some([low, high]), other) if other.is_none() || a.count >= b.count => {
                open.extend([(low, b), (high, b)]);
            }
            (_, Some([low, high])) => open.extend([(a, low), (a, high)]),
            _ => {
                let (ours, theirs) = (&boxes[a.range()], &boxes[b.range()]);
                let same = std::ptr::eq(a, b);
                for (at, one) in ours.iter().enumerate() {
                    let others = if same { &theirs[at + 1..] } else { theirs };
                    for other in others.iter().filter(|other| meet(one, other)) {
                        if !visit(one.index.min(other.index), one.index.max(other.index)) {
                            return;
                        }
                    }
                }
            }
        }
    }
}

/// A body's box.
struct Boxed {
    extent: Extent,
    index: usize,
    moves: bool,
}

impl Boxed {
    fn of((index, body): (usize, &Body)) -> Self {
        Self { extent: Extent::of(body), index, moves: body.is_dynamic() }
    }
}

/// Boxes that stand next to each other in the list, and the box around them.
struct Node {
    extent: Extent,
    moves: bool,
    first: usize,
    count: usize,
    parts: Option<Box<[Node; 2]>>,
}

impl Node {
    /// Orders the boxes so that those of each node stand together.
    fn over(boxes: &mut [Boxed]) -> Option<Self> {
        Self::over_part(boxes, 0)
    }

    fn over_part(boxes: &mut [Boxed], first: usize) -> Option<Self> {
        let extent = boxes.iter().map(|one| one.extent).reduce(Extent::with)?;
        let (count, moves) = (boxes.len(), boxes.iter().any(|one| one.moves));
        let mut node = Self { extent, moves, first, count, parts: None };
        if count > LEAF {
            // By the middles and not by the boxes: a floor under all would leave one half as wide as the whole.
            let middle = |one: &Boxed| one.extent.middle();
            let (low, high) = boxes
                .iter()
                .map(middle)
                .fold((glam::DVec3::INFINITY, glam::DVec3::NEG_INFINITY), |(low, high), at| {
                    (low.min(at), high.max(at))
                });
            let size = (high - low).to_array();
            let axis = (1..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
            boxes.select_nth_unstable_by(count / 2, |a, b| {
                middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.index.cmp(&b.index))
            });
            let (low, high) = boxes.split_at_mut(count / 2);
            let parts = Self::over_part(low, first).zip(Self::over_part(high, first + count / 2));
            node.parts = parts.map(|(low, high)| Box::new([low, high]));
        }
        Some(node)
    }

    fn range(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.count
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::random::Random;
    use crate::scene::{Motion, Shape};

    fn ball(index: usize, at: DVec3, radius: f64, moves: bool) -> Body {
        let motion =
            if moves { Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO } } else { Motion::Static };
        Body::new(index as i64, at, motion, Shape::Sphere { radius })
    }

    fn found(bodies: &BodyList, margin: f64) -> Vec<(usize, usize)> {
        let mut pairs = Vec::new();
        for_each_near(bodies, margin, |a, b| {
            pairs.push((a, b));
            true
        });
        pairs.sort_unstable();
        pairs
    }

    /// Against all pairs: random sizes over four orders, some at one place, some huge, some no numbers.
    #[test]
    fn pairs_are_those_of_comparing_all() {
        let mut random = Random::new(5);
        for count in [0, 1, 2, 9, 40, 300] {
            let mut bodies: BodyList = (0..count)
                .map(|index| {
                    let radius = libm::pow(10.0, random.range(-3.0, 1.0));
                    let at = if index % 7 == 0 { DVec3::ONE } else { random.vector(10.0) };
                    ball(index, at, radius, index % 3 > 0)
                })
                .collect();
            if let Some(body) = bodies.get_mut(20) {
                body.position.y = f64::NAN;
            }
            for margin in [0.0, 0.5] {
                let extents: Vec<Extent> = bodies.iter().map(Extent::of).collect();
                let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
                let meet = |&(a, b): &(usize, usize)| {
                    (bodies[a].is_dynamic() || bodies[b].is_dynamic()) && extents[a].meets(extents[b], margin)
                };
                assert_eq!(
                    found(&bodies, margin),
                    pairs.filter(meet).collect::<Vec<_>>(),
                    "{count} {margin}"
                );
            }
        }
    }

    #[test]
    fn it_ends_when_enough_is_seen() {
        let bodies: BodyList = (0..100).map(|index| ball(index, DVec3::ZERO, 1.0, true)).collect();
        let mut seen = 0;
        for_each_near(&bodies, 0.0, |_, _| {
            seen += 1;
            seen < 10
        });
        assert_eq!(seen, 10);
    }
}
