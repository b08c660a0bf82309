//! Friction in impact groups: staggered projections (Kaufman, Sueda, James & Pai 2008).
//!
//! After the reflections of a group every contact has a normal impulse Λ. The tangential impulses with |J| ≤ μΛ that leave
//! least kinetic energy follow; what they make close is taken plastically, and so on until nothing closes. No phase
//! raises energy, and what it leaves is unique, so that the symmetry of a group stays. With tangential restitution β
//! the first phase goes (1 + β) times the way to the least energy, under bounds of μΛ/(1 + β): that loses
//! ½(1 − β²) Σ m|way|² at least, and gives Walton's law for a contact alone.

use glam::DVec3;

use super::geometry::{normal_arms, rubbing_of};
use super::group::{Group, Member};
use super::model::Model;
use super::rub::{inertia, slip};
use super::state::State;
use super::tolerance::{FRICTION_ROUNDS, FRICTION_SWEEPS, FRICTION_SWEPT};
use crate::scene::Roughness;

/// A contact of a group that rubs.
struct Rough {
    member: usize,
    law: Roughness,
    /// Radii of its bodies as far as they turn, m.
    arms: [f64; 2],
    /// 1/m_t, 1/kg.
    inverse_mass: f64,
    /// On the second body, of this phase and of all, N·s.
    impulse: DVec3,
    whole: DVec3,
    /// Normal impulse at the end of the phase before, N·s.
    pressed: f64,
}

impl Group {
    /// Lets the contacts of a group rub that have pressed; whether it ended.
    pub fn rub(&mut self, model: &Model, state: &State) -> bool {
        self.spins = self.bodies.ids.iter().map(|body| state.spin(*body, self.time)).collect();
        let mut contacts = self.rough(model);
        if contacts.is_empty() {
            return true;
        }
        for round in 0..FRICTION_ROUNDS {
            self.rub_once(model, &mut contacts, round == 0);
            for contact in &mut contacts {
                contact.pressed = self.members[contact.member].impulse;
                self.members[contact.member].rubbed = contact.whole;
            }
            if self.still_closing().is_empty() {
                return true;
            }
            self.take_up();
        }
        false
    }

    /// Adds what friction does to bodies that slide on what is fixed to the accelerations of the applied forces: it may press
    /// them against others.
    pub fn add_friction(&self, model: &Model, free: &mut [DVec3]) {
        let applied = free.to_vec();
        for contact in self.rough(model) {
            let Member { link, is_lasting, .. } = &self.members[contact.member];
            let load = applied[link.a].dot(link.towards);
            if *is_lasting && link.b.is_none() && load > 0.0 {
                free[link.a] += contact.law.friction * load * self.slip_of(&contact).normalize_or_zero();
            }
        }
    }

    fn rough(&self, model: &Model) -> Vec<Rough> {
        let rough = |(member, of): (usize, &Member)| {
            let law = rubbing_of(model, of.pair);
            // Friction acts in the middle of the gap, on both at one point.
            let middle = if of.pair.second().is_some() { 0.5 * of.gap.distance } else { 0.0 };
            let mut arms = normal_arms(model, of.pair).map(|arm| if arm > 0.0 { arm + middle } else { arm });
            let inverse = |body: usize| self.bodies.inverse_mass[body];
            let (a, b) = (inverse(of.link.a), of.link.b.map_or(0.0, inverse));
            // What nothing moves does not turn either.
            if a == 0.0 {
                arms[0] = 0.0;
            }
            if b == 0.0 {
                arms[1] = 0.0;
            }
            let inverse_mass = (1.0 + 1.0 / super::turn::INERTIA) * (a + b);
            (law.friction > 0.0 && inverse_mass > 0.0).then_some(Rough {
                member,
                law,
                arms,
                inverse_mass,
                impulse: DVec3::ZERO,
                whole: DVec3::ZERO,
                pressed: 0.0,
            })
        };
        self.members.iter().enumerate().filter_map(rough).collect()
    }

    /// Slip of the second body of a contact on the first, m/s.
    fn slip_of(&self, contact: &Rough) -> DVec3 {
        let link = &self.members[contact.member].link;
        let velocity = |body: usize| self.bodies.v[body];
        let apart = link.b.map_or(DVec3::ZERO, velocity) - velocity(link.a);
        let spin = |body: usize| self.spins[body];
        let turning = contact.arms[0] * spin(link.a) + contact.arms[1] * link.b.map_or(DVec3::ZERO, spin);
        slip(link.towards, apart, turning)
    }

    /// One phase of friction: to the least energy within the bounds, and beyond by the restitution of the first phase.
    fn rub_once(&mut self, model: &Model, contacts: &mut [Rough], is_first: bool) {
        let slips: Vec<DVec3> = contacts.iter().map(|contact| self.slip_of(contact)).collect();
        // Those whose slip came back would lose it again.
        let takes_part = |group: &Self, contact: &Rough| {
            let impulse = group.members[contact.member].impulse;
            impulse > 0.0 && (is_first || contact.law.tangential == 0.0 || impulse > contact.pressed)
        };
        let active: Vec<usize> = (0..contacts.len()).filter(|k| takes_part(self, &contacts[*k])).collect();
        contacts.iter_mut().for_each(|contact| contact.impulse = DVec3::ZERO);
        let back = if is_first { shared_tangential(contacts, &active, &slips) } else { 0.0 };
        self.sweep(model, contacts, &active, back);
        for k in &active {
            let further = back * contacts[*k].impulse;
            self.push(model, &contacts[*k], further);
            contacts[*k].impulse += further;
            contacts[*k].whole += contacts[*k].impulse;
        }
        // −Σ J·(s + s')/2, for the energy is a quadratic form.
        for k in active {
            let mean = 0.5 * (slips[k] + self.slip_of(&contacts[k]));
            self.loss -= contacts[k].impulse.dot(mean);
        }
    }

    /// Block Gauss–Seidel sweeps to the least kinetic energy.
    fn sweep(&mut self, model: &Model, contacts: &mut [Rough], active: &[usize], back: f64) {
        for _ in 0..FRICTION_SWEEPS {
            let mut changed = 0.0_f64;
            for k in active {
                let contact = &contacts[*k];
                let bound = contact.law.friction * self.members[contact.member].impulse / (1.0 + back);
                let before = contact.impulse;
                // What was given in phases before counts for the bound too.
                let wanted = contact.whole + before - self.slip_of(contact) / contact.inverse_mass;
                let by = wanted.clamp_length_max(bound) - contact.whole - before;
                self.push(model, contact, by);
                changed = changed.max(by.length() * contact.inverse_mass);
                contacts[*k].impulse += by;
            }
            if changed <= FRICTION_SWEPT * self.fastest {
                return;
            }
        }
    }

    /// Gives the second body of a contact an impulse across its normal, and the first the opposite.
    fn push(&mut self, model: &Model, contact: &Rough, impulse: DVec3) {
        let link = self.members[contact.member].link;
        let ends = [(Some(link.a), -1.0, contact.arms[0]), (link.b, 1.0, contact.arms[1])];
        for (body, sign, arm) in ends {
            let Some(body) = body else { continue };
            self.bodies.v[body] += sign * self.bodies.inverse_mass[body] * impulse;
            let inertia = inertia(model, self.bodies.ids[body]);
            self.spins[body] -= arm / inertia * link.towards.cross(impulse);
        }
    }
}

/// √ of the mean of β², weighted with the energies of the slips, as restitutions are shared along the normals.
fn shared_tangential(contacts: &[Rough], active: &[usize], slips: &[DVec3]) -> f64 {
    let of = |k: &usize| contacts[*k].law.tangential;
    let Some(first) = active.first().map(of) else { return 0.0 };
    if active.iter().all(|k| of(k) == first) {
        return first;
    }
    let weight = |k: &usize| slips[*k].length_squared() / contacts[*k].inverse_mass;
    let whole: f64 = active.iter().map(weight).sum();
    let back: f64 = active.iter().map(|k| of(k) * of(k) * weight(k)).sum();
    if whole > 0.0 { (back / whole).sqrt() } else { 0.0 }
}
