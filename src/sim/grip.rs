//! Contacts that slip or stick: the accelerations of an island that rubs, and the choice of what slips.

use glam::DVec3;

use super::contact_forces::{Forces, Mode, Motions, Touch, apply};
use super::geometry::BodiesAt;
use super::island::{Island, free, largest};
use super::model::Model;
use super::shape::Part;
use super::tolerance::{AS_IT_BEGAN, NO_SLIP, PRESSURE_ROUNDING, START_OF_SLIP};
/// An island at one time with all that is known about its contacts.
pub(super) struct Grip<'a> {
    pub model: &'a Model,
    pub island: &'a Island,
    pub radii: Vec<f64>,
    pub frictions: Vec<f64>,
    pub arms: Vec<[f64; 2]>,
    pub parts: Vec<Option<Part>>,
    pub modes: Vec<Mode>,
    /// Whether the slip of a contact begins in this step. It has the direction in which it does while its own differs by
    /// less than rounding may.
    pub begins: Vec<bool>,
    /// Slips below this have no direction of their own, m/s.
    pub slow: f64,
}

/// Accelerations of centres and, times the radii, of spins, with the forces and what friction takes, W.
pub(super) struct Driven {
    pub motions: Motions,
    pub forces: Forces,
    pub touches: Vec<Touch>,
    pub power: f64,
    pub size: f64,
}

impl Grip<'_> {
    pub fn touches(&self, x: &[DVec3], v: &[DVec3]) -> Vec<Touch> {
        let bodies = BodiesAt { ids: &self.island.ids, x, v };
        let parts = self.parts.iter().map(Option::as_ref).chain(std::iter::repeat(None));
        (self.island.contacts.iter().zip(parts).enumerate())
            .map(|(k, ((pair, surface), part))| {
                let (link, turning) = bodies.turning_link(self.model, *pair, *surface, part);
                Touch { link, turning, arms: self.arms[k], friction: self.frictions[k], mode: self.modes[k] }
            })
            .collect()
    }

    /// The accelerations at places and motions, velocities first and spins times radii after them.
    pub fn driven(&self, time: f64, x: &[DVec3], motions: &[DVec3]) -> Driven {
        let count = self.island.ids.len();
        let v = &motions[..count];
        let mut touches = self.touches(x, v);
        for (touch, begins) in touches.iter_mut().zip(&self.begins) {
            if let Mode::Slips(direction) = touch.mode {
                // It turns with the surface.
                let direction = direction - direction.dot(touch.link.towards) * touch.link.towards;
                let direction = direction.normalize_or(DVec3::X);
                let now = touch.slip(motions).try_normalize().unwrap_or(direction);
                let is_same = *begins && (now - direction).length() <= AS_IT_BEGAN
                    || touch.slip(motions).length() <= self.slow;
                touch.mode = Mode::Slips(if is_same { direction } else { now });
            }
        }
        let limits: Vec<f64> = touches.iter().map(|touch| touch.link.limit).collect();
        let drifts: Vec<DVec3> = touches.iter().map(|touch| touch.drift(motions)).collect();
        let mut accelerations = free(self.model, &self.island.ids, &self.island.inverse_mass, time, (x, v));
        let links: Vec<_> = touches.iter().map(|touch| touch.link).collect();
        let size = largest(&accelerations, &links);
        accelerations.resize(2 * count, DVec3::ZERO);
        let forces = apply(&touches, &self.island.inverse_mass, &limits, &drifts, &mut accelerations);
        let power =
            touches.iter().zip(&forces.across).map(|(touch, across)| -across.dot(touch.slip(motions)));
        Driven { power: power.sum(), motions: accelerations, forces, touches, size }
    }

    /// The largest speed, or that of a fall by a radius under accelerations of this size, m/s.
    pub fn speed(&self, motions: &[DVec3], size: f64) -> f64 {
        let radius = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        motions.iter().map(|motion| motion.length()).fold((size * radius).sqrt(), f64::max)
    }

    /// Whether no contact pulls, and none that sticks is held by more than its friction, but for this part of it.
    pub fn holds(&self, driven: &Driven, tolerance: f64) -> bool {
        (0..self.modes.len()).all(|k| !self.pulls(driven, k) && self.excess(driven, k) <= tolerance)
    }

    fn pulls(&self, driven: &Driven, k: usize) -> bool {
        let link = &driven.touches[k].link;
        let parting = -driven.forces.loads[k] * link.response(link, &self.island.inverse_mass);
        // More than what others take for rounding, who would put them together again.
        parting > 4.0 * PRESSURE_ROUNDING * (2.0 * driven.size + link.limit)
    }

    /// What a contact that sticks is held by beyond its friction, as a part of that and of rounding.
    fn excess(&self, driven: &Driven, k: usize) -> f64 {
        if self.modes[k] != Mode::Sticks {
            return 0.0;
        }
        let held = driven.forces.across[k].length();
        let bound = self.frictions[k] * driven.forces.loads[k].max(0.0);
        let whole =
            driven.forces.loads.iter().fold(bound, |whole, load| whole.max(PRESSURE_ROUNDING * load.abs()));
        if held <= bound { 0.0 } else { (held - bound) / whole.max(f64::MIN_POSITIVE) }
    }

    /// Lets contacts slip that friction can't hold, until all the others hold.
    pub fn choose(&mut self, time: f64, motions: &[DVec3]) -> Choice {
        for _ in 0..=self.modes.len() {
            let driven = self.settled(time, motions);
            let Some(driven) = driven else { return Choice::None };
            if let Some(k) = (0..self.modes.len()).find(|k| self.pulls(&driven, *k)) {
                return Choice::Parts(k);
            }
            let excess = |k: &usize| self.excess(&driven, *k);
            let worst = (0..self.modes.len()).max_by(|a, b| excess(a).total_cmp(&excess(b)));
            match worst.filter(|k| excess(k) > 0.0) {
                None => return Choice::Holds(Box::new(driven)),
                Some(k) => {
                    let against = -driven.forces.across[k];
                    self.modes[k] = Mode::Slips(against.normalize_or(DVec3::X));
                    self.begins[k] = true;
                    self.slow = START_OF_SLIP * self.speed(motions, driven.size);
                }
            }
        }
        Choice::None
    }

    /// The accelerations with the directions in which slips begin that they lead to themselves.
    fn settled(&mut self, time: f64, motions: &[DVec3]) -> Option<Driven> {
        for _ in 0..MOST_TURNS {
            let driven = self.driven(time, &self.island.x, motions);
            let mut is_done = true;
            for (k, touch) in driven.touches.iter().enumerate() {
                let Mode::Slips(begins) = self.modes[k] else { continue };
                if touch.slip(motions) != DVec3::ZERO {
                    continue;
                }
                let change = touch.slip(&driven.motions) + touch.drift(motions);
                // At the limit of sticking it has the direction of what held it.
                if change.length() <= AS_IT_BEGAN * driven.size {
                    continue;
                }
                let next = change.normalize_or_zero();
                if next.dot(begins) <= 0.0 {
                    return None;
                }
                is_done &= (next - begins).length() <= NO_SLIP;
                self.modes[k] = Mode::Slips(next);
            }
            if is_done {
                return Some(driven);
            }
        }
        None
    }
}

/// Turns of the direction in which slips begin, at most: each is some digits nearer.
const MOST_TURNS: u32 = 60;

/// What a choice of what slips came to.
pub(super) enum Choice {
    Holds(Box<Driven>),
    Parts(usize),
    None,
}
