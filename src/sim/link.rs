//! Contacts as bounds on the motion of the bodies that touch.

use glam::DVec3;

/// One contact as a bound on the motion of the bodies of a group: (w_a − w_b)·towards ≤ limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Position of the body in the group.
    pub a: usize,
    /// Position of the other body; `None` for one that does not move.
    pub b: Option<usize>,
    /// Unit vector from the first body into the other.
    pub towards: DVec3,
    /// 0 for velocities after an impact; for accelerations what keeps the bodies on a curved surface, ≥ 0; for velocities
    /// in a step of a group how fast they may come nearer, or less than 0 where they must part.
    pub limit: f64,
}

/// What is found besides the motion that links allow.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// Of the links, ≥ 0 but for those that are kept from leaving: impulses for velocities, forces for accelerations.
    pub multipliers: Vec<f64>,
    /// Length of all that the motion of each body is the sum of: what is left is known to some roundings of it.
    pub sizes: Vec<f64>,
    /// Whether the search was given up before all links were within their limits.
    pub is_unmet: bool,
}

impl Solved {
    /// Length of all that decides how fast a link enters.
    pub fn size(&self, link: &Link) -> f64 {
        link.size_of(&self.sizes)
    }
}

impl Link {
    /// Length of all that decides how fast it enters, of that of its bodies.
    pub fn size_of(&self, sizes: &[f64]) -> f64 {
        sizes[self.a] + self.b.map_or(0.0, |b| sizes[b]) + self.limit.abs()
    }

    /// How fast a motion enters the other body, in the units of the motion; negative when it leaves.
    pub fn entering(&self, motion: &[DVec3]) -> f64 {
        let other = self.b.map_or(DVec3::ZERO, |b| motion[b]);
        (motion[self.a] - other).dot(self.towards)
    }

    /// Applies an impulse (or force) of this size to the bodies.
    pub fn push(&self, motion: &mut [DVec3], inverse_mass: &[f64], size: f64) {
        motion[self.a] -= size * inverse_mass[self.a] * self.towards;
        if let Some(b) = self.b {
            motion[b] += size * inverse_mass[b] * self.towards;
        }
    }

    /// Whether two links act on one body.
    pub fn shares_body(&self, other: &Self) -> bool {
        let is_its = |body: usize| body == other.a || Some(body) == other.b;
        is_its(self.a) || self.b.is_some_and(is_its)
    }

    /// Change of what enters here by a unit impulse at another link.
    pub fn response(&self, other: &Self, inverse_mass: &[f64]) -> f64 {
        let along = self.towards.dot(other.towards);
        let mut sum = 0.0;
        for (mine, my_sign) in [(Some(self.a), 1.0), (self.b, -1.0)] {
            for (theirs, their_sign) in [(Some(other.a), 1.0), (other.b, -1.0)] {
                if let Some(body) = mine.filter(|_| mine == theirs) {
                    sum += my_sign * their_sign * inverse_mass[body];
                }
            }
        }
        sum * along
    }
}

/// Gives the bodies of some links numbers of their own, in their order; which they were.
pub(super) fn renumber(links: &mut [Link]) -> Vec<usize> {
    let mut bodies: Vec<usize> = links.iter().flat_map(|link| [Some(link.a), link.b]).flatten().collect();
    bodies.sort_unstable();
    bodies.dedup();
    let number = |body: usize| bodies.partition_point(|other| *other < body);
    for link in links {
        (link.a, link.b) = (number(link.a), link.b.map(number));
    }
    bodies
}
