//! Projected Gauss–Seidel sweeps over the contacts of one component, forwards and backwards in turn.

use glam::DVec3;

use super::rub::Rubbing;
use super::stepped::{Contact, Moving, Step, Stepped, velocity};
use super::tolerance::{BUDGET, CREEPING, FINEST, GIVING, SHARE_OF_DIRECTION, SLOW};

/// A contact as the sweeps read it: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Row {
    /// And 0.
    pub normal: [f64; 4],
    pub bound: f64,
    pub mass: f64,
    /// Their product, N·s.
    target: f64,
    /// Places of its bodies.
    pub ends: [u32; 2],
}

/// The rows of a component with the velocities that they act on. It is kept from step to step for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct System {
    pub rows: Vec<Row>,
    /// The impulses of the rows, apart, since rows are only read, N·s.
    pub impulses: Vec<f64>,
    /// What the last sweep changed of each impulse, N·s.
    pub changes: Vec<f64>,
    /// Change of an impulse in units of what is tolerated, 1/(N·s), and 1/m_a + 1/m_b, 1/kg, of each row.
    scales: Vec<f64>,
    inverse_masses: Vec<f64>,
    /// Where the conjugate gradient goes on, N·s, and what that is to the velocities, m/s.
    directions: Vec<f64>,
    headings: Vec<Moving>,
    /// Σ change²/mass of the last sweep; 0 before the first.
    norm: f64,
    /// How that compares to the sweep before.
    share: f64,
    /// In the middle of the step; and before the last sweep.
    pub moving: Vec<Moving>,
    before: Vec<Moving>,
}

/// What the impulses of a component come to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Judgement {
    /// Energy that the contacts take, J.
    pub loss: f64,
    /// Whether one of them goes deeper than the overlap budget allows.
    pub sinks: bool,
    /// Whether one of them does so slowly.
    pub creeps: bool,
}

impl System {
    /// Bodies as the applied forces alone move them, without rows.
    pub fn begin(&mut self, bodies: &[Stepped], h: f64) {
        self.rows.clear();
        self.impulses.clear();
        self.scales.clear();
        self.inverse_masses.clear();
        self.moving.clear();
        self.moving.extend(bodies.iter().map(|body| free(body, h)));
        self.headings.resize(self.moving.len(), Moving::default());
    }

    /// Adds contacts, each as a row with the scale of its changes, and with the impulses that they begin with.
    pub fn add(&mut self, contacts: &[Contact], scale: impl Fn(&Contact) -> f64) {
        self.rows.extend(contacts.iter().map(row));
        self.impulses.extend(contacts.iter().map(|contact| contact.impulse));
        self.scales.extend(contacts.iter().map(scale));
        self.inverse_masses.extend(contacts.iter().map(|contact| contact.inverse_mass));
        for contact in contacts.iter().filter(|contact| contact.impulse > 0.0) {
            let [x, y, z] = contact.normal.to_array();
            push(&mut self.moving, [contact.a, contact.b], [x, y, z, 0.0], contact.impulse);
        }
        self.changes.resize(self.rows.len(), 0.0);
        self.directions.resize(self.rows.len(), 0.0);
        self.begin_anew();
    }

    /// Forgets where the conjugate gradient went: something else has changed impulses.
    pub fn begin_anew(&mut self) {
        self.norm = 0.0;
    }

    /// One sweep; gives the largest change in units of what is tolerated.
    pub fn sweep(&mut self, is_backward: bool, rubbing: &mut Rubbing) -> f64 {
        self.before.clone_from(&self.moving);
        let rows = self.rows.iter().zip(self.impulses.iter_mut().zip(&mut self.changes));
        if is_backward {
            sweep(rows.rev(), &mut self.moving);
        } else {
            sweep(rows, &mut self.moving);
        }
        let (worst, norm) = measure(&self.changes, &self.scales, &self.inverse_masses);
        // Where the change became larger, the conjugate gradient begins anew.
        (self.share, self.norm) = (norm / self.norm, norm);
        if rubbing.is_empty() {
            return worst;
        }
        worst.max(rubbing.sweep(&mut self.moving, &self.impulses, is_backward))
    }

    /// The nonlinear conjugate gradient method on top of the sweeps, taking what a sweep changes for the gradient
    /// (Silcowitz-Hansen, Niebe & Erleben 2010): impulses travel through a column of n bodies in some n sweeps, not
    /// n². It goes on along the directions of before, as long as changes become smaller. Velocities go along with all of
    /// them at once, v + β M⁻¹Jᵀd; only rows whose impulses would become negative are pushed back one by one.
    pub fn go_on(&mut self, rubbing: &Rubbing) {
        // The bounds of friction move with the impulses: nothing is to be overshot.
        if !rubbing.is_empty() {
            return;
        }
        let is_anew = self.share.is_nan() || self.share >= 1.0;
        let share = if is_anew { 0.0 } else { SHARE_OF_DIRECTION * self.share };
        let bodies = self.moving.as_flattened_mut().iter_mut().zip(self.before.as_flattened());
        for ((moving, before), heading) in bodies.zip(self.headings.as_flattened_mut()) {
            let step = share * *heading;
            *heading = step + (*moving - before);
            *moving += step;
        }
        // Signs are gathered as bits, which the processor does for several at once.
        let mut signs = 0;
        let steps = self.directions.iter_mut().zip(&self.changes);
        for (impulse, (direction, change)) in self.impulses.iter_mut().zip(steps) {
            let step = share * *direction;
            *direction = step + change;
            *impulse += step;
            signs |= impulse.to_bits();
        }
        if f64::from_bits(signs).is_sign_negative() {
            self.push_back();
        }
    }

    /// Takes back what would make impulses negative, and goes on there no further.
    fn push_back(&mut self) {
        let steps = self.impulses.iter_mut().zip(&mut self.directions);
        for (row, (impulse, direction)) in self.rows.iter().zip(steps) {
            if *impulse < 0.0 {
                let inverse_masses = inverse_masses(&self.moving, row.ends);
                push_by(&mut self.headings, row, inverse_masses, -*direction);
                push_by(&mut self.moving, row, inverse_masses, -*impulse);
                (*impulse, *direction) = (0.0, 0.0);
            }
        }
    }

    /// What the contacts come to with the impulses of now.
    pub fn judge(&self, contacts: &[Contact], Step { h, radius }: Step, rubbing: &Rubbing) -> Judgement {
        let mut judged = Judgement::default();
        for (contact, impulse) in contacts.iter().zip(&self.impulses) {
            let rate = closing(contact, &self.moving);
            judged.loss += taken(contact, *impulse, rate);
            let deeper = -h * rate;
            judged.sinks |= deeper > FINEST * radius && deeper - contact.gap > BUDGET * radius;
            judged.creeps |= creeps(contact, deeper, radius);
        }
        if !rubbing.is_empty() {
            judged.loss += rubbing.loss(&self.moving);
        }
        judged
    }

    /// The rows that creep or give much of the energy that the component may gain, J: what a sweep changes of them is
    /// tolerated, but it adds up.
    pub fn creeping(&self, contacts: &[Contact], Step { h, radius }: Step, allowed: f64) -> Vec<usize> {
        let is_creeping = |(contact, impulse): (&Contact, &f64)| {
            let rate = closing(contact, &self.moving);
            creeps(contact, -h * rate, radius) || -taken(contact, *impulse, rate) > GIVING * allowed
        };
        let rows = (0..).zip(contacts.iter().zip(&self.impulses));
        rows.filter(|(_, row)| is_creeping(*row)).map(|(k, _)| k).collect()
    }

    /// The rows of which the last sweep changed the impulses by a share of what is tolerated.
    pub fn slow(&self) -> Vec<usize> {
        let is_slow = |(scale, change): (&f64, &f64)| (change * scale).abs() > SLOW;
        let rows = (0..).zip(self.scales.iter().zip(&self.changes));
        rows.filter(|(_, row)| is_slow(*row)).map(|(k, _)| k).collect()
    }
}

/// Energy that a contact takes by an impulse λ that leaves it with the rate s', −½ λ (s + s'), J.
fn taken(contact: &Contact, impulse: f64, rate: f64) -> f64 {
    -0.5 * impulse * (contact.rate + rate)
}

/// Whether a contact that has used up its overlap budget goes deeper, by this, m.
fn creeps(contact: &Contact, deeper: f64, radius: f64) -> bool {
    -contact.gap > BUDGET * radius && deeper > CREEPING * radius
}

/// A body as the applied forces alone move it.
fn free(body: &Stepped, h: f64) -> Moving {
    let u = if body.inverse_mass > 0.0 { body.u + h * body.a } else { body.u };
    [u.x, u.y, u.z, body.inverse_mass]
}

fn row(contact: &Contact) -> Row {
    let [x, y, z] = contact.normal.to_array();
    let (bound, mass) = (contact.bound, 1.0 / contact.inverse_mass);
    Row { normal: [x, y, z, 0.0], bound, mass, target: bound * mass, ends: [contact.a, contact.b] }
}

/// One sweep over rows with their impulses and changes. What takes its time is how long each row waits for what it
/// calculates: all that can be is multiplied before.
#[inline(always)]
fn sweep<'a>(rows: impl Iterator<Item = (&'a Row, (&'a mut f64, &'a mut f64))>, moving: &mut [Moving]) {
    for (row, (impulse, change)) in rows {
        let [a, b] = row.ends;
        let one = moving[a as usize];
        let other = moving.get(b as usize).copied().unwrap_or_default();
        let wanted = row.target - dot(times(row.normal, row.mass), minus(other, one));
        // Quicker than `max`, which asks for NaN.
        let by = if wanted > -*impulse { wanted } else { -*impulse };
        *impulse += by;
        *change = by;
        moving[a as usize] = moved(one, row.normal, -by);
        if let Some(body) = moving.get_mut(b as usize) {
            *body = moved(other, row.normal, by);
        }
    }
}

/// The largest change in units of what is tolerated, and Σ change²/mass, in four sums that the processor adds at once.
fn measure(changes: &[f64], scales: &[f64], inverse_masses: &[f64]) -> (f64, f64) {
    let (mut worst, mut norm) = ([0.0_f64; 4], [0.0_f64; 4]);
    let mut take = |lane: usize, change: f64, scale: f64, inverse_mass: f64| {
        let scaled = (change * scale).abs();
        worst[lane] = if scaled > worst[lane] { scaled } else { worst[lane] };
        norm[lane] += change * change * inverse_mass;
    };
    let (by_four, rest) = changes.as_chunks::<4>();
    let (scales_by_four, scales_of_rest) = scales.as_chunks::<4>();
    let (masses_by_four, masses_of_rest) = inverse_masses.as_chunks::<4>();
    for ((changes, scales), inverse_masses) in by_four.iter().zip(scales_by_four).zip(masses_by_four) {
        for lane in 0..4 {
            take(lane, changes[lane], scales[lane], inverse_masses[lane]);
        }
    }
    for ((change, scale), inverse_mass) in rest.iter().zip(scales_of_rest).zip(masses_of_rest) {
        take(0, *change, *scale, *inverse_mass);
    }
    let largest = worst.into_iter().fold(0.0, f64::max);
    (largest, (norm[0] + norm[1]) + (norm[2] + norm[3]))
}

#[inline(always)]
pub(super) fn push(moving: &mut [Moving], [a, b]: [u32; 2], normal: [f64; 4], impulse: f64) {
    let one = &mut moving[a as usize];
    *one = moved(*one, normal, -impulse);
    if let Some(other) = moving.get_mut(b as usize) {
        *other = moved(*other, normal, impulse);
    }
}

/// 1/kg; 0 for what does not move.
fn inverse_masses(moving: &[Moving], ends: [u32; 2]) -> [f64; 2] {
    ends.map(|body| moving.get(body as usize).map_or(0.0, |moving| moving[3]))
}

/// Adds to velocities what an impulse of a row is to them.
fn push_by(velocities: &mut [Moving], row: &Row, inverse_masses: [f64; 2], impulse: f64) {
    for ((body, inverse_mass), sign) in row.ends.into_iter().zip(inverse_masses).zip([-1.0, 1.0]) {
        if let Some(velocity) = velocities.get_mut(body as usize) {
            let change = sign * impulse * inverse_mass;
            *velocity = std::array::from_fn(|axis| velocity[axis] + change * row.normal[axis]);
        }
    }
}

/// A body after an impulse.
#[inline(always)]
fn moved(body: Moving, normal: [f64; 4], impulse: f64) -> Moving {
    let per_impulse = times(normal, body[3]);
    std::array::from_fn(|axis| body[axis] + impulse * per_impulse[axis])
}

#[inline(always)]
fn times(vector: [f64; 4], factor: f64) -> [f64; 4] {
    vector.map(|component| component * factor)
}

#[inline(always)]
fn minus(one: Moving, other: Moving) -> [f64; 4] {
    std::array::from_fn(|axis| one[axis] - other[axis])
}

#[inline(always)]
fn dot(one: [f64; 4], other: [f64; 4]) -> f64 {
    (one[0] * other[0] + one[2] * other[2]) + (one[1] * other[1] + one[3] * other[3])
}

/// n·(u'_b − u'_a), m/s.
pub(super) fn closing(contact: &Contact, moving: &[Moving]) -> f64 {
    let of = |body: u32| moving.get(body as usize).map_or(DVec3::ZERO, velocity);
    contact.normal.dot(of(contact.b) - of(contact.a))
}
