//! The search for the nearest motion within bounds: the dual active set method of Goldfarb & Idnani (1983, Math. Prog.
//! 27).
//!
//! In the metric of masses, ‖w‖² = Σ mᵢ|wᵢ|², the bound of a link is a half-space with the normal d = M⁻¹nᵀ, the
//! motion that a unit impulse gives. The method starts at the motion without bounds and adds the bound that is
//! overstepped most, keeping the multipliers of those already met ≥ 0. All projections go along an orthogonal
//! basis of the normals, never through the matrix N M⁻¹ Nᵀ, whose condition number is the square of theirs:
//! a ball of 10¹² kg on one of 1 kg costs six digits that way instead of all.

use glam::DVec3;

use super::link::{Link, Solved};
use super::tolerance::{DEPENDENT, ENTERING, LEFT_OVER, ONE_DIRECTION, SHARING};

/// Turns a motion into the nearest one in which no link enters faster than its limit, and those of `both`
/// neither enter nor leave.
pub(super) fn search(links: &[Link], both: &[bool], inverse_mass: &[f64], motion: &mut [DVec3]) -> Solved {
    let mut search = ActiveSet::new(links, both, inverse_mass, motion, 0.0);
    let is_unmet = !search.run();
    let mut multipliers = search.multipliers();
    if search.has_shared_loads() {
        let mut shared = ActiveSet::new(links, both, inverse_mass, motion, SHARING);
        shared.run();
        search.carry_the_rest(motion, &mut shared.multipliers(), &mut multipliers);
    }
    for ((w, found), size) in motion.iter_mut().zip(&search.at).zip(&search.sizes) {
        *w = if found.length() <= LEFT_OVER * size { DVec3::ZERO } else { *found };
    }
    Solved { multipliers, sizes: search.sizes, is_unmet }
}

/// What a unit of force at each link changes there while all the others of the set hold; where these would
/// hold it alone, what it changes by itself.
pub(super) fn responses_by_search(links: &[Link], inverse_mass: &[f64]) -> Vec<f64> {
    let still = vec![DVec3::ZERO; inverse_mass.len()];
    let both = vec![true; links.len()];
    let mut search = ActiveSet::new(links, &both, inverse_mass, &still, 0.0);
    (0..links.len()).for_each(|k| search.meet(k, 1.0));
    let mut responses: Vec<f64> = links.iter().map(|link| link.response(link, inverse_mass)).collect();
    // The rows of the inverse of the triangular factor: (NᵀN)⁻¹ₖₖ = Σ (R⁻¹)²ₖⱼ/‖qⱼ‖².
    let count = search.active.len();
    let mut inverse = vec![0.0; count];
    for j in 0..count {
        let mut unit = vec![0.0; j + 1];
        unit[j] = 1.0;
        for (row, entry) in search.relief(&unit).into_iter().enumerate() {
            inverse[row] += entry * entry / search.active[j].norm;
        }
    }
    for (active, inverse) in search.active.iter().zip(inverse) {
        responses[active.link] = 1.0 / inverse;
    }
    responses
}

/// A motion of all bodies, and of one coordinate more for each link where loads are shared.
#[derive(Clone, Debug)]
struct Direction {
    bodies: Vec<DVec3>,
    own: Vec<f64>,
}

/// A bound that is met exactly.
struct Active {
    link: usize,
    /// 1, or −1 where a link of `both` is kept from leaving.
    sign: f64,
    multiplier: f64,
    /// Its normal = Σ coefficients·(directions before it) + its own direction.
    coefficients: Vec<f64>,
    direction: Direction,
    /// Square of its length.
    norm: f64,
    /// The motion along it where the bound is met.
    target: f64,
}

/// Mass of a body, kg; 0 for one without inverse mass: no motion of it is ever compared with another.
fn weight(inverse_mass: f64) -> f64 {
    if inverse_mass > 0.0 { 1.0 / inverse_mass } else { 0.0 }
}

struct ActiveSet<'a> {
    links: &'a [Link],
    both: &'a [bool],
    inverse_mass: &'a [f64],
    /// Weights of the bodies; 0 for one without inverse mass, which nothing moves.
    weights: Vec<f64>,
    /// Length of each link's own coordinate.
    own: Vec<f64>,
    at: Vec<DVec3>,
    at_own: Vec<f64>,
    /// Length of all that each body's motion is the sum of.
    sizes: Vec<f64>,
    active: Vec<Active>,
    /// Links that no motion could meet any better.
    given_up: Vec<bool>,
}

impl<'a> ActiveSet<'a> {
    fn new(
        links: &'a [Link],
        both: &'a [bool],
        inverse_mass: &'a [f64],
        motion: &[DVec3],
        sharing: f64,
    ) -> Self {
        let shared = if sharing > 0.0 { links } else { &[] };
        let own = shared.iter().map(|link| sharing * link.response(link, inverse_mass).sqrt()).collect();
        Self {
            links,
            both,
            inverse_mass,
            weights: inverse_mass.iter().map(|inverse| weight(*inverse)).collect(),
            own,
            at: motion.to_vec(),
            at_own: vec![0.0; if sharing > 0.0 { links.len() } else { 0 }],
            sizes: motion.iter().map(|w| w.length()).collect(),
            active: Vec::new(),
            given_up: vec![false; links.len()],
        }
    }

    /// Whether all are met, but for those that nothing could meet any better.
    fn run(&mut self) -> bool {
        for k in (0..self.links.len()).filter(|k| self.both[*k]) {
            // Those that are met already too: the next ones must not undo them.
            self.meet(k, self.excess(k).signum());
        }
        // Each bound added moves the motion away from its start, so none is met twice in the same company.
        for _ in 0..8 * self.links.len() + 8 {
            self.clean();
            let Some(worst) = self.worst() else { return true };
            self.meet(worst, 1.0);
        }
        self.clean();
        self.worst().is_none()
    }

    fn multipliers(&self) -> Vec<f64> {
        let mut multipliers = vec![0.0; self.links.len()];
        for active in &self.active {
            multipliers[active.link] = active.sign * active.multiplier;
        }
        multipliers
    }

    /// Replaces multipliers by shared ones, and lets the active bounds carry what these leave over.
    fn carry_the_rest(&self, motion: &[DVec3], shared: &mut [f64], multipliers: &mut [f64]) {
        let mut rest = Direction { bodies: motion.to_vec(), own: Vec::new() };
        for (w, at) in rest.bodies.iter_mut().zip(&self.at) {
            *w -= *at;
        }
        for (link, multiplier) in self.links.iter().zip(shared.iter()) {
            link.push(&mut rest.bodies, self.inverse_mass, *multiplier);
        }
        let along: Vec<f64> =
            self.active.iter().map(|active| self.inner(&active.direction, &rest) / active.norm).collect();
        for (active, more) in self.active.iter().zip(self.relief(&along)) {
            let sum = shared[active.link] + active.sign * more;
            shared[active.link] = if self.both[active.link] { sum } else { sum.max(0.0) };
        }
        multipliers.copy_from_slice(shared);
    }

    /// How much a link enters faster than its limit.
    fn excess(&self, link: usize) -> f64 {
        let own = self.at_own.get(link).map_or(0.0, |own| own * self.own[link]);
        self.links[link].entering(&self.at) + own - self.links[link].limit
    }

    fn tolerance(&self, link: usize) -> f64 {
        ENTERING * self.links[link].size_of(&self.sizes)
    }

    /// The link that oversteps its limit most, for its rounding.
    fn worst(&self) -> Option<usize> {
        (0..self.links.len())
            .filter(|k| {
                !self.both[*k] && !self.given_up[*k] && !self.active.iter().any(|active| active.link == *k)
            })
            .map(|k| (k, self.excess(k)))
            .filter(|(k, excess)| *excess > self.tolerance(*k))
            .reduce(|best, next| if next.1 > best.1 { next } else { best })
            .map(|(k, _)| k)
    }

    /// Takes out what rounding has left along the active directions: of links in all but the same direction the others
    /// would seem to overstep by it.
    fn clean(&mut self) {
        for k in 0..self.active.len() {
            let active = &self.active[k];
            let left = (self.along(&active.direction) - active.target) / active.norm;
            for (w, d) in self.at.iter_mut().zip(&self.active[k].direction.bodies) {
                *w -= left * *d;
            }
            for (w, d) in self.at_own.iter_mut().zip(&self.active[k].direction.own) {
                *w -= left * d;
            }
        }
    }

    /// Moves to where a link is at its limit, and lets those go that would have to pull.
    fn meet(&mut self, link: usize, sign: f64) {
        let mut multiplier = 0.0;
        loop {
            let (coefficients, direction, norm) = self.beside_active(link, sign);
            let relief = self.relief(&coefficients);
            let blocking = self.blocking(&relief);
            let target = self.target(link, sign, &coefficients);
            let full = (norm > 0.0).then(|| self.full_step(link, &direction, norm, target));
            let step = match (full, blocking) {
                (Some(full), Some((_, blocked))) => full.min(blocked),
                (Some(full), None) => full,
                (None, Some((_, blocked))) => blocked,
                (None, None) => {
                    self.given_up[link] = true;
                    return;
                }
            };
            if norm > 0.0 {
                self.go(&direction, step);
            }
            for (active, relief) in self.active.iter_mut().zip(&relief) {
                active.multiplier -= step * relief;
            }
            multiplier += step;
            if full == Some(step) {
                self.active.push(Active { link, sign, multiplier, coefficients, direction, norm, target });
                return;
            }
            if let Some((position, _)) = blocking {
                self.drop(position);
            }
        }
    }

    /// The step after which a link is at its limit: a projection along its own direction, so that the motion grows
    /// shorter whatever rounding the others leave. What it oversteps by rounding is left where taking it out would
    /// cost more than rounding: of two links in all but the same direction.
    fn full_step(&self, link: usize, direction: &Direction, norm: f64, target: f64) -> f64 {
        let excess = self.along(direction) - target;
        let step = if self.both[link] { excess / norm } else { (excess / norm).max(0.0) };
        let costs = |(d, size): (&DVec3, &f64)| step.abs() * d.length() > LEFT_OVER * size;
        let is_rounding = excess.abs() <= self.tolerance(link);
        if is_rounding && direction.bodies.iter().zip(&self.sizes).any(costs) { 0.0 } else { step }
    }

    /// The motion along a link's own direction at its limit: the limit itself, less what is met along the others.
    fn target(&self, link: usize, sign: f64, coefficients: &[f64]) -> f64 {
        let met =
            coefficients.iter().zip(&self.active).map(|(coefficient, active)| coefficient * active.target);
        sign * self.links[link].limit - met.sum::<f64>()
    }

    fn along(&self, direction: &Direction) -> f64 {
        let bodies = self.at.iter().zip(&direction.bodies).zip(&self.weights);
        let own = self.at_own.iter().zip(&direction.own);
        bodies.map(|((w, d), weight)| weight * w.dot(*d)).sum::<f64>() + own.map(|(w, d)| w * d).sum::<f64>()
    }

    fn go(&mut self, direction: &Direction, step: f64) {
        for ((w, size), d) in self.at.iter_mut().zip(&mut self.sizes).zip(&direction.bodies) {
            let change = step * *d;
            *w -= change;
            *size += change.length();
        }
        for (own, d) in self.at_own.iter_mut().zip(&direction.own) {
            *own -= step * d;
        }
    }

    /// The first active bound whose multiplier reaches 0, by position, and after which step.
    fn blocking(&self, relief: &[f64]) -> Option<(usize, f64)> {
        self.active
            .iter()
            .zip(relief)
            .enumerate()
            .filter(|(_, (active, relief))| !self.both[active.link] && **relief > 0.0)
            .map(|(position, (active, relief))| (position, (active.multiplier / relief).max(0.0)))
            .reduce(|best, next| if next.1 < best.1 { next } else { best })
    }

    /// By how much the multipliers of the active bounds fall for a unit of the new one.
    fn relief(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut relief = coefficients.to_vec();
        for k in (0..relief.len()).rev() {
            let known = relief[k];
            for (j, coefficient) in self.active[k].coefficients.iter().enumerate() {
                relief[j] -= known * coefficient;
            }
        }
        relief
    }

    /// Splits the normal of a link into a combination of the active directions and what is left, with the
    /// square of its length: 0 if that is rounding.
    fn beside_active(&self, link: usize, sign: f64) -> (Vec<f64>, Direction, f64) {
        let normal = self.normal(link, sign);
        let whole = self.inner(&normal, &normal);
        let mut rest = normal;
        let mut coefficients = vec![0.0; self.active.len()];
        // Twice is enough (Kahan, Parlett).
        for _ in 0..2 {
            for (coefficient, active) in coefficients.iter_mut().zip(&self.active) {
                let along = self.inner(&active.direction, &rest) / active.norm;
                *coefficient += along;
                for (w, d) in rest.bodies.iter_mut().zip(&active.direction.bodies) {
                    *w -= along * *d;
                }
                for (w, d) in rest.own.iter_mut().zip(&active.direction.own) {
                    *w -= along * d;
                }
            }
        }
        let norm = self.inner(&rest, &rest);
        (coefficients, rest, if norm > DEPENDENT * DEPENDENT * whole { norm } else { 0.0 })
    }

    /// What a unit impulse at a link takes from the motion.
    fn normal(&self, link: usize, sign: f64) -> Direction {
        let Link { a, b, towards, .. } = self.links[link];
        let mut bodies = vec![DVec3::ZERO; self.at.len()];
        bodies[a] += sign * self.inverse_mass[a] * towards;
        if let Some(b) = b {
            bodies[b] -= sign * self.inverse_mass[b] * towards;
        }
        let mut own = vec![0.0; self.at_own.len()];
        if let Some(own) = own.get_mut(link) {
            *own = sign * self.own[link];
        }
        Direction { bodies, own }
    }

    fn inner(&self, left: &Direction, right: &Direction) -> f64 {
        let bodies = left.bodies.iter().zip(&right.bodies).zip(&self.weights);
        let own = left.own.iter().zip(&right.own);
        bodies.map(|((l, r), weight)| weight * l.dot(*r)).sum::<f64>() + own.map(|(l, r)| l * r).sum::<f64>()
    }

    /// Takes an active bound out and makes the directions after it anew.
    fn drop(&mut self, position: usize) {
        let later = self.active.split_off(position);
        for old in later.into_iter().skip(1) {
            let (coefficients, direction, norm) = self.beside_active(old.link, old.sign);
            let target = self.target(old.link, old.sign, &coefficients);
            // What is left of one that is a combination of others is rounding, of its own size.
            let whole = self.normal(old.link, old.sign);
            let norm = norm.max(DEPENDENT * DEPENDENT * self.inner(&whole, &whole));
            self.active.push(Active { coefficients, direction, norm, target, ..old });
        }
    }

    /// Whether a link at its limit is next to a combination of active ones: what they carry, it could carry.
    fn has_shared_loads(&self) -> bool {
        (0..self.links.len()).any(|k| {
            !self.both[k]
                && !self.active.iter().any(|active| active.link == k)
                && self.excess(k).abs() <= self.tolerance(k)
                && self.is_combination(k)
        })
    }

    fn is_combination(&self, link: usize) -> bool {
        let normal = self.normal(link, 1.0);
        let (_, rest, _) = self.beside_active(link, 1.0);
        self.inner(&rest, &rest) <= ONE_DIRECTION * ONE_DIRECTION * self.inner(&normal, &normal)
    }
}
