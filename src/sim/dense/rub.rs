//! Friction at the contacts of a component in one step, swept in turn with the impulses along the normals.
//!
//! With s' the slip in the middle of the step and m_t the mass that an impulse across the normal moves,
//! J ← J − m_t s', shortened to μλ, after each sweep over the normals (Coulomb's law, as projected Gauss–Seidel has it).
//! Its work is J·(s + s')/2 ≤ 0 where it has converged. Rolling friction is a torque on both bodies against what they turn
//! relative to each other, of (1 + k) μ_R λ R at most.

use glam::DVec3;

use super::stepped::{Contact, Moving, Stepped, velocity};
use crate::scene::Roughness;
use crate::sim::turn::INERTIA;

/// A contact that rubs.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Its place among the contacts.
    contact: usize,
    /// Places of its bodies, and their radii as far as they turn, m.
    ends: [u32; 2],
    arms: [f64; 2],
    normal: DVec3,
    law: Roughness,
    /// m_t, kg, and the moment of inertia that a torque moves, kg·m².
    mass: f64,
    inertia: f64,
    /// Radius of rolling, m.
    radius: f64,
    /// Change of impulse in units of what is tolerated.
    scale: f64,
    /// On the second body, N·s, and on the second body against its turning, N·m·s.
    impulse: DVec3,
    torque: DVec3,
    /// Slip and relative spin before the step.
    slip: DVec3,
    turning: DVec3,
}

/// Friction of a component, kept from step to step for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Rubbing {
    rows: Vec<Row>,
    /// rad/s, in the order of the bodies; none where nothing rubs.
    pub spins: Vec<DVec3>,
    /// The same before the step.
    before: Vec<DVec3>,
    inverse_inertia: Vec<f64>,
}

/// The law of a contact, and the impulse of its friction in the last step as a force, N.
pub(super) struct Law {
    pub roughness: Roughness,
    pub force: DVec3,
}

/// How a step asks for that of a contact; `None` where it does not rub.
pub(super) type LawOf<'a> = dyn Fn(&Contact) -> Option<Law> + 'a;

impl Row {
    /// Slip of the second body on the first, m/s.
    fn slip(&self, velocities: [DVec3; 2], spins: [DVec3; 2]) -> DVec3 {
        let apart = velocities[1] - velocities[0];
        let turning = self.arms[0] * spins[0] + self.arms[1] * spins[1];
        (apart - apart.dot(self.normal) * self.normal) - turning.cross(self.normal)
    }

    /// What the second body turns relative to the first, across the normal, rad/s.
    fn turning(&self, spins: [DVec3; 2]) -> DVec3 {
        let turning = spins[1] - spins[0];
        turning - turning.dot(self.normal) * self.normal
    }
}

impl Rubbing {
    /// Bodies with their spins before the step, rad/s; without any where nothing rubs.
    pub fn begin(&mut self, bodies: &[Stepped], spin: Option<impl Fn(u32) -> DVec3>) {
        self.rows.clear();
        self.spins.clear();
        self.before.clear();
        self.inverse_inertia.clear();
        let Some(spin) = spin else { return };
        for body in bodies {
            let is_held = body.inverse_mass == 0.0;
            self.spins.push(if is_held { DVec3::ZERO } else { spin(body.body) });
            self.inverse_inertia.push(body.inverse_mass / (INERTIA * body.radius * body.radius));
        }
        self.before.clone_from(&self.spins);
    }

    /// The same bodies as before the step, without rows.
    pub fn begin_anew(&mut self) {
        self.rows.clear();
        self.spins.clone_from(&self.before);
    }

    /// Adds contacts, of which the first is the one of this number.
    pub fn add(
        &mut self,
        first: usize,
        contacts: &[Contact],
        bodies: &[Stepped],
        (h, scale_of): (f64, &dyn Fn(&Contact) -> f64),
        law: &LawOf<'_>,
    ) {
        if self.spins.is_empty() {
            return;
        }
        for (nth, contact) in contacts.iter().enumerate() {
            let Some(Law { roughness, force }) = law(contact) else { continue };
            let normal = contact.normal;
            let moves = |body: u32| bodies.get(body as usize).is_some_and(|body| body.inverse_mass > 0.0);
            // Friction acts in the middle of the gap, on both at one point.
            let middle = if moves(contact.a) && moves(contact.b) { 0.5 * contact.gap } else { 0.0 };
            let arm = |body: u32| if moves(body) { bodies[body as usize].radius + middle } else { 0.0 };
            let radius = |body: u32| bodies.get(body as usize).map_or(f64::INFINITY, |body| body.radius);
            let turns = |body: u32| self.inverse_inertia.get(body as usize).copied().unwrap_or(0.0);
            let impulse = h * (force - force.dot(normal) * normal);
            let row = Row {
                contact: first + nth,
                ends: [contact.a, contact.b],
                arms: [arm(contact.a), arm(contact.b)],
                normal,
                law: roughness,
                mass: INERTIA / (1.0 + INERTIA) / contact.inverse_mass,
                inertia: 1.0 / (turns(contact.a) + turns(contact.b)),
                radius: 1.0 / (1.0 / radius(contact.a) + 1.0 / radius(contact.b)),
                scale: scale_of(contact),
                impulse: impulse.clamp_length_max(roughness.friction * contact.impulse),
                torque: DVec3::ZERO,
                slip: DVec3::ZERO,
                turning: DVec3::ZERO,
            };
            self.rows.push(row);
        }
    }

    /// Notes the slips before the step from row `first` on, and gives the bodies the impulses that these begin with.
    pub fn warm_up(&mut self, first: usize, bodies: &[Stepped], moving: &mut [Moving]) {
        for index in first..self.rows.len() {
            let row = self.rows[index];
            let velocity = |body: u32| bodies.get(body as usize).map_or(DVec3::ZERO, |body| body.u);
            let spin = |body: u32| self.before.get(body as usize).copied().unwrap_or_default();
            self.rows[index].slip = row.slip(row.ends.map(velocity), row.ends.map(spin));
            self.rows[index].turning = row.turning(row.ends.map(spin));
        }
        for index in first..self.rows.len() {
            let row = self.rows[index];
            self.push(&row, moving, row.impulse);
        }
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    fn spin(&self, body: u32) -> DVec3 {
        self.spins.get(body as usize).copied().unwrap_or_default()
    }

    fn slip(&self, row: &Row, moving: &[Moving]) -> DVec3 {
        let of = |body: u32| moving.get(body as usize).map_or(DVec3::ZERO, velocity);
        row.slip(row.ends.map(of), row.ends.map(|body| self.spin(body)))
    }

    fn turning(&self, row: &Row) -> DVec3 {
        row.turning(row.ends.map(|body| self.spin(body)))
    }

    /// Gives the second body an impulse across the normal, and the first the opposite.
    fn push(&mut self, row: &Row, moving: &mut [Moving], impulse: DVec3) {
        for ((body, arm), sign) in row.ends.into_iter().zip(row.arms).zip([-1.0, 1.0]) {
            let Some(one) = moving.get_mut(body as usize) else { continue };
            let change = sign * one[3] * impulse;
            (one[0], one[1], one[2]) = (one[0] + change.x, one[1] + change.y, one[2] + change.z);
            let turn = arm * self.inverse_inertia[body as usize];
            self.spins[body as usize] -= turn * row.normal.cross(impulse);
        }
    }

    fn twist(&mut self, row: &Row, torque: DVec3) {
        for (body, sign) in row.ends.into_iter().zip([-1.0, 1.0]) {
            if let Some(spin) = self.spins.get_mut(body as usize) {
                *spin += sign * self.inverse_inertia[body as usize] * torque;
            }
        }
    }

    /// One sweep; gives the largest change in units of what is tolerated.
    pub fn sweep(&mut self, moving: &mut [Moving], pressed: &[f64], is_backward: bool) -> f64 {
        let mut worst = 0.0_f64;
        let count = self.rows.len();
        for nth in 0..count {
            let index = if is_backward { count - 1 - nth } else { nth };
            let row = self.rows[index];
            let load = pressed[row.contact];
            let wanted = row.impulse - row.mass * self.slip(&row, moving);
            let impulse = wanted.clamp_length_max(row.law.friction * load);
            self.push(&row, moving, impulse - row.impulse);
            worst = worst.max(row.scale * (impulse - row.impulse).length());
            self.rows[index].impulse = impulse;
            if row.law.rolling > 0.0 {
                let bound = (1.0 + INERTIA) * row.law.rolling * load * row.radius;
                let torque = (row.torque - row.inertia * self.turning(&row)).clamp_length_max(bound);
                self.twist(&row, torque - row.torque);
                worst = worst.max(row.scale * (torque - row.torque).length() / row.radius);
                self.rows[index].torque = torque;
            }
        }
        worst
    }

    /// Energy that friction takes, J.
    pub fn loss(&self, moving: &[Moving]) -> f64 {
        let of = |row: &Row| {
            row.impulse.dot(row.slip + self.slip(row, moving))
                + row.torque.dot(row.turning + self.turning(row))
        };
        -0.5 * self.rows.iter().map(of).sum::<f64>()
    }

    /// The contacts that rub with the impulse on the second body of each, N·s.
    pub fn impulses(&self) -> impl Iterator<Item = (usize, DVec3)> + '_ {
        self.rows.iter().map(|row| (row.contact, row.impulse))
    }

    /// The same for torques, with the places of both bodies, N·m·s.
    pub fn torques(&self) -> impl Iterator<Item = ([u32; 2], DVec3)> + '_ {
        self.rows.iter().map(|row| (row.ends, row.torque))
    }
}
