//! Motions of several bodies that touch: the nearest one that enters no surface.
//!
//! With the kinetic metric (masses as weights) the nearest allowed accelerations are the true ones (Gauss's
//! principle of least constraint), and the nearest allowed velocities those after a plastic impact (Moreau).
//! The multipliers λ ≥ 0 of the contacts solve a linear complementarity problem in the Delassus matrix
//! A = N M⁻¹ Nᵀ, by the active set method of Lawson and Hanson (1974, ch. 23), in which λ only pushes.

use glam::DVec3;

use super::tolerance::{DEPENDENT, ENTERING, LEFT_OVER, RAISE, REFINEMENTS};

/// One contact as a bound on the motion of the bodies of a group: (w_a − w_b)·towards ≤ limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Position of the body in the group.
    pub a: usize,
    /// Position of the other body; `None` for one that does not move.
    pub b: Option<usize>,
    /// Unit vector from the first body into the other.
    pub towards: DVec3,
    /// 0 for velocities; for accelerations what keeps the bodies on a curved surface, ≥ 0.
    pub limit: f64,
}

impl Link {
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

/// Turns a motion into the nearest one that enters no surface faster than its limit. Gives the multipliers
/// of the links, ≥ 0: impulses for velocities, forces for accelerations.
pub(super) fn enter_none(links: &[Link], inverse_mass: &[f64], motion: &mut [DVec3]) -> Vec<f64> {
    let excess: Vec<f64> = links.iter().map(|link| link.entering(motion) - link.limit).collect();
    if excess.iter().all(|excess| *excess <= 0.0) {
        return vec![0.0; links.len()];
    }
    let largest =
        links.iter().map(|link| link.limit).chain(excess.iter().map(|e| e.abs())).fold(0.0, f64::max);
    let multipliers = unilateral(&Delassus::new(links, inverse_mass), &excess, largest);
    apply(links, inverse_mass, motion, &multipliers);
    multipliers
}

/// Turns a motion into the nearest one that neither enters nor leaves: every link is at its limit. Gives
/// the multipliers, of either sign.
pub(super) fn stay_on(links: &[Link], inverse_mass: &[f64], motion: &mut [DVec3]) -> Vec<f64> {
    let excess: Vec<f64> = links.iter().map(|link| link.entering(motion) - link.limit).collect();
    if excess.iter().all(|excess| *excess == 0.0) {
        return vec![0.0; links.len()];
    }
    let all: Vec<usize> = (0..links.len()).collect();
    let multipliers = Delassus::new(links, inverse_mass).solve(&all, &excess, Dependent::LeaveOut);
    apply(links, inverse_mass, motion, &multipliers);
    multipliers
}

fn apply(links: &[Link], inverse_mass: &[f64], motion: &mut [DVec3], multipliers: &[f64]) {
    let mut sizes: Vec<f64> = motion.iter().map(|w| w.length()).collect();
    let mut touched = vec![false; motion.len()];
    for (link, multiplier) in links.iter().zip(multipliers).filter(|(_, multiplier)| **multiplier != 0.0) {
        link.push(motion, inverse_mass, *multiplier);
        for body in [Some(link.a), link.b].into_iter().flatten() {
            sizes[body] += multiplier.abs() * inverse_mass[body];
            touched[body] = true;
        }
    }
    // A light body between heavy ones is the small difference of large pushes, and so is what it leaves to them.
    let size = sizes
        .iter()
        .zip(&touched)
        .filter(|(_, touched)| **touched)
        .map(|(size, _)| *size)
        .fold(0.0, f64::max);
    for (w, touched) in motion.iter_mut().zip(touched) {
        if touched && w.length() <= LEFT_OVER * size {
            *w = DVec3::ZERO;
        }
    }
}

/// The largest part that a multiplier has in what enters anywhere: what enters is known to a rounding of it.
pub(super) fn largest_push(links: &[Link], inverse_mass: &[f64], multipliers: &[f64]) -> f64 {
    let push = |(link, multiplier): (&Link, &f64)| multiplier * link.response(link, inverse_mass);
    links.iter().zip(multipliers).map(push).fold(0.0, f64::max)
}

/// λ ≥ 0 with excess − Aλ ≤ tolerance, and = 0 where λ > 0.
fn unilateral(matrix: &Delassus, excess: &[f64], largest: f64) -> Vec<f64> {
    let size = excess.len();
    let mut multipliers = vec![0.0; size];
    let mut active: Vec<usize> = Vec::new();
    // Each pass makes the motion more nearly allowed; rounding alone could make it come back.
    for _ in 0..4 * size + 8 {
        let left = |k: usize, multipliers: &[f64]| excess[k] - matrix.row(k, multipliers);
        let pushes = (0..size).map(|k| multipliers[k] * matrix.at(k, k));
        let tolerance = ENTERING * pushes.fold(largest, f64::max);
        let worst = (0..size)
            .filter(|k| !active.contains(k))
            .map(|k| (k, left(k, &multipliers)))
            .filter(|(_, left)| *left > tolerance)
            .reduce(|best, next| if next.1 > best.1 { next } else { best });
        let Some((worst, _)) = worst else { break };
        active.push(worst);
        active.sort_unstable();
        while !active.is_empty() {
            let wanted = matrix.solve(&active, excess, Dependent::Share);
            if active.iter().all(|k| wanted[*k] > 0.0) {
                multipliers = wanted;
                break;
            }
            // Go towards it until the first multiplier would pull, and let that contact go.
            let step = active
                .iter()
                .filter(|k| wanted[**k] <= 0.0)
                .map(|k| multipliers[*k] / (multipliers[*k] - wanted[*k]).max(f64::MIN_POSITIVE))
                .fold(1.0, f64::min);
            for k in &active {
                multipliers[*k] += step * (wanted[*k] - multipliers[*k]);
            }
            let smallest = active
                .iter()
                .copied()
                .filter(|k| wanted[*k] <= 0.0)
                .reduce(|best, next| if multipliers[next] < multipliers[best] { next } else { best });
            if let Some(smallest) = smallest {
                multipliers[smallest] = 0.0;
            }
            active.retain(|k| multipliers[*k] > 0.0 || wanted[*k] > 0.0);
        }
    }
    multipliers
}

/// What to do with contacts that depend on each other (four feet of a chair), which make A singular.
#[derive(Clone, Copy, Debug)]
enum Dependent {
    /// They share the load: the diagonal is raised a little, and refinement takes the error of that out again
    /// (proximal point iteration).
    Share,
    /// The later ones carry nothing: where they contradict the earlier ones by rounding, nothing could meet
    /// them all.
    LeaveOut,
}

impl Dependent {
    /// The pivot to go on with instead of what is left of a diagonal entry; infinite leaves its row out.
    fn pivot(self, left: f64, entry: f64) -> f64 {
        match self {
            Self::Share => (left + RAISE * entry).max(f64::MIN_POSITIVE),
            Self::LeaveOut if left <= DEPENDENT * entry => f64::INFINITY,
            Self::LeaveOut => left,
        }
    }
}

/// A = N M⁻¹ Nᵀ: how an impulse at one contact changes what enters at another.
struct Delassus {
    size: usize,
    entries: Vec<f64>,
}

impl Delassus {
    fn new(links: &[Link], inverse_mass: &[f64]) -> Self {
        let entries = links
            .iter()
            .flat_map(|row| links.iter().map(|column| row.response(column, inverse_mass)))
            .collect();
        Self { size: links.len(), entries }
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.size + column]
    }

    fn row(&self, row: usize, multipliers: &[f64]) -> f64 {
        (0..self.size).map(|column| self.at(row, column) * multipliers[column]).sum()
    }

    /// λ with Aλ = right on the rows and columns of `active`, 0 elsewhere.
    fn solve(&self, active: &[usize], right: &[f64], dependent: Dependent) -> Vec<f64> {
        let size = active.len();
        let mut factor = vec![0.0; size * size];
        for i in 0..size {
            for j in 0..=i {
                let entry = self.at(active[i], active[j]);
                let known: f64 = (0..j).map(|k| factor[i * size + k] * factor[j * size + k]).sum();
                let rest = entry - known;
                factor[i * size + j] =
                    if i == j { dependent.pivot(rest, entry).sqrt() } else { rest / factor[j * size + j] };
            }
        }
        let mut solution = vec![0.0; self.size];
        for _ in 0..=REFINEMENTS {
            let mut rest: Vec<f64> = active.iter().map(|k| right[*k] - self.row(*k, &solution)).collect();
            for i in 0..size {
                let known: f64 = (0..i).map(|k| factor[i * size + k] * rest[k]).sum();
                rest[i] = (rest[i] - known) / factor[i * size + i];
            }
            for i in (0..size).rev() {
                let known: f64 = (i + 1..size).map(|k| factor[k * size + i] * rest[k]).sum();
                rest[i] = (rest[i] - known) / factor[i * size + i];
            }
            for (k, change) in active.iter().zip(rest) {
                solution[*k] += change;
            }
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor(a: usize) -> Link {
        Link { a, b: None, towards: DVec3::NEG_Y, limit: 0.0 }
    }

    fn below(a: usize, b: usize) -> Link {
        Link { a, b: Some(b), towards: DVec3::NEG_Y, limit: 0.0 }
    }

    #[test]
    fn a_tower_presses_with_the_weight_above() {
        let links = [floor(0), below(1, 0), below(2, 1)];
        let mut motion = [DVec3::Y * -10.0; 3];
        let forces = enter_none(&links, &[1.0, 0.5, 0.25], &mut motion);
        assert_eq!(motion, [DVec3::ZERO; 3]);
        for (force, weight) in forces.iter().zip([70.0, 60.0, 40.0]) {
            assert!((force - weight).abs() <= 1e-12 * weight, "{forces:?}");
        }
    }

    #[test]
    fn contacts_only_push() {
        let links = [floor(0), below(1, 0)];
        let mut motion = [DVec3::Y * -10.0, DVec3::Y * 3.0];
        let forces = enter_none(&links, &[1.0, 1.0], &mut motion);
        assert_eq!(motion, [DVec3::ZERO, DVec3::Y * 3.0]);
        assert_eq!(forces[1], 0.0);
    }

    #[test]
    fn contacts_that_depend_on_each_other_share_the_load() {
        let links = [floor(0), floor(0), floor(0), Link { towards: DVec3::X, ..floor(0) }];
        let mut motion = [DVec3::new(-1.0, -10.0, 0.5)];
        let forces = enter_none(&links, &[2.0], &mut motion);
        assert!((motion[0] - DVec3::new(-1.0, 0.0, 0.5)).length() <= 1e-15, "{motion:?}");
        assert!((forces.iter().sum::<f64>() - 5.0).abs() <= 1e-12, "{forces:?}");
        let mut motion = [DVec3::new(-1.0, 10.0, 0.5)];
        stay_on(&links, &[2.0], &mut motion);
        assert!((motion[0] - DVec3::new(0.0, 0.0, 0.5)).length() <= 1e-15, "{motion:?}");
    }

    /// Random problems: every answer must meet the conditions of Karush, Kuhn and Tucker, which the nearest
    /// allowed motion alone does.
    #[test]
    fn the_nearest_allowed_motion_is_found() {
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = move || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for case in 0..2000 {
            let bodies = 1 + case % 5;
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| libm::exp(3.0 * random())).collect();
            let links: Vec<Link> = (0..=case % 9)
                .map(|k| {
                    let (a, b) = (k % bodies, (k * 7 + case) % bodies);
                    let towards = DVec3::new(random(), random(), random()).normalize();
                    Link { a, b: (a != b).then_some(b), towards, limit: random().max(0.0) }
                })
                .collect();
            let free: Vec<DVec3> = (0..bodies).map(|_| DVec3::new(random(), random(), random())).collect();
            let mut motion = free.clone();
            let multipliers = enter_none(&links, &inverse_mass, &mut motion);
            for (link, multiplier) in links.iter().zip(&multipliers) {
                let excess = link.entering(&motion) - link.limit;
                assert!(*multiplier >= 0.0 && excess <= 1e-11, "case {case}: {multiplier} {excess:e}");
                assert!(*multiplier == 0.0 || excess.abs() <= 1e-11, "case {case}: {multiplier} {excess:e}");
            }
        }
    }
}
