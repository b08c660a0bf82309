//! Projected Gauss–Seidel sweeps over the contacts of one component, forwards and backwards in turn.

use glam::DVec3;

use super::rub::Rubbing;
use super::stepped::{Contact, Moving, Stepped, velocity};
use super::tolerance::{BUDGET, CREEPING, FINEST, GIVING, SLOW};

/// A contact as the sweeps read it: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Row {
    /// And 0.
    pub normal: [f64; 4],
    pub bound: f64,
    pub mass: f64,
    /// Change of impulse in units of what is tolerated.
    pub scale: f64,
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
    /// Where the conjugate gradient goes on, N·s.
    directions: Vec<f64>,
    /// Σ change²/mass of the last sweep; 0 before the first.
    norm: f64,
    /// How that compares to the sweep before.
    share: f64,
    /// In the middle of the step.
    pub moving: Vec<Moving>,
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
        self.moving.clear();
        self.moving.extend(bodies.iter().map(|body| free(body, h)));
    }

    /// Adds contacts, each as a row, with the impulses that they begin with.
    pub fn add(&mut self, contacts: &[Contact], row: impl Fn(&Contact) -> Row) {
        self.rows.extend(contacts.iter().map(row));
        self.impulses.extend(contacts.iter().map(|contact| contact.impulse));
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
        let rows = self.rows.iter().zip(self.impulses.iter_mut().zip(&mut self.changes));
        let (worst, norm) =
            if is_backward { sweep(rows.rev(), &mut self.moving) } else { sweep(rows, &mut self.moving) };
        // Where the change became larger, the conjugate gradient begins anew.
        (self.share, self.norm) = (norm / self.norm, norm);
        if rubbing.is_empty() {
            return worst;
        }
        worst.max(rubbing.sweep(&mut self.moving, &self.impulses, is_backward))
    }

    /// The nonlinear conjugate gradient method on top of the sweeps, taking what a sweep changes for the gradient
    /// (Silcowitz-Hansen, Niebe & Erleben 2010): impulses travel through a column of n bodies in some n sweeps, not
    /// n². It goes on along the directions of before, as long as changes become smaller.
    pub fn go_on(&mut self, rubbing: &Rubbing) {
        // The bounds of friction move with the impulses: nothing is to be overshot.
        if !rubbing.is_empty() {
            return;
        }
        let share = self.share;
        if share.is_nan() || share >= 1.0 {
            self.directions.copy_from_slice(&self.changes);
            return;
        }
        let steps = self.directions.iter_mut().zip(&self.changes);
        for ((row, impulse), (direction, change)) in self.rows.iter().zip(&mut self.impulses).zip(steps) {
            let step = share * *direction;
            *direction = step + change;
            let before = std::mem::replace(impulse, (*impulse + step).max(0.0));
            push(&mut self.moving, row.ends, row.normal, *impulse - before);
        }
    }

    /// What the contacts come to with the impulses of now.
    pub fn judge(&self, contacts: &[Contact], h: f64, rubbing: &Rubbing) -> Judgement {
        let mut judged = Judgement::default();
        for (contact, impulse) in contacts.iter().zip(&self.impulses) {
            let rate = closing(contact, &self.moving);
            judged.loss += taken(contact, *impulse, rate);
            let deeper = -h * rate;
            judged.sinks |=
                deeper > FINEST * contact.radius && deeper - contact.gap > BUDGET * contact.radius;
            judged.creeps |= creeps(contact, deeper);
        }
        if !rubbing.is_empty() {
            judged.loss += rubbing.loss(&self.moving);
        }
        judged
    }

    /// The rows that creep or give much of the energy that the component may gain, J: what a sweep changes of them is
    /// tolerated, but it adds up.
    pub fn creeping(&self, contacts: &[Contact], h: f64, allowed: f64) -> Vec<usize> {
        let is_creeping = |(contact, impulse): (&Contact, &f64)| {
            let rate = closing(contact, &self.moving);
            creeps(contact, -h * rate) || -taken(contact, *impulse, rate) > GIVING * allowed
        };
        let rows = (0..).zip(contacts.iter().zip(&self.impulses));
        rows.filter(|(_, row)| is_creeping(*row)).map(|(k, _)| k).collect()
    }

    /// The rows of which the last sweep changed the impulses by a share of what is tolerated.
    pub fn slow(&self) -> Vec<usize> {
        let is_slow = |(row, change): (&Row, &f64)| (change * row.scale).abs() > SLOW;
        let rows = (0..).zip(self.rows.iter().zip(&self.changes));
        rows.filter(|(_, row)| is_slow(*row)).map(|(k, _)| k).collect()
    }
}

/// Energy that a contact takes by an impulse λ that leaves it with the rate s', −½ λ (s + s'), J.
fn taken(contact: &Contact, impulse: f64, rate: f64) -> f64 {
    -0.5 * impulse * (contact.rate + rate)
}

/// Whether a contact that has used up its overlap budget goes deeper, by this, m.
fn creeps(contact: &Contact, deeper: f64) -> bool {
    -contact.gap > BUDGET * contact.radius && deeper > CREEPING * contact.radius
}

/// A body as the applied forces alone move it.
fn free(body: &Stepped, h: f64) -> Moving {
    let u = if body.inverse_mass > 0.0 { body.u + h * body.a } else { body.u };
    [u.x, u.y, u.z, body.inverse_mass]
}

/// One sweep over rows with their impulses and changes; gives the largest change in units of what is tolerated, and
/// Σ change²/mass.
#[inline(always)]
fn sweep<'a>(
    rows: impl Iterator<Item = (&'a Row, (&'a mut f64, &'a mut f64))>,
    moving: &mut [Moving],
) -> (f64, f64) {
    let (mut worst, mut norm): (f64, f64) = (0.0, 0.0);
    for (row, (impulse, change)) in rows {
        let [a, b] = row.ends;
        let one = moving[a as usize];
        let other = moving.get(b as usize).copied().unwrap_or_default();
        let rate = dot(row.normal, minus(other, one));
        let before = std::mem::replace(impulse, (*impulse + (row.bound - rate) * row.mass).max(0.0));
        let by = *impulse - before;
        let (scaled, weighted) = ((by * row.scale).abs(), by * by * (one[3] + other[3]));
        // Quicker than `max`, which asks for NaN.
        worst = if scaled > worst { scaled } else { worst };
        norm += weighted;
        let (one, other) = (moved(one, row.normal, -by), moved(other, row.normal, by));
        *change = by;
        moving[a as usize] = one;
        if let Some(body) = moving.get_mut(b as usize) {
            *body = other;
        }
    }
    (worst, norm)
}

#[inline(always)]
pub(super) fn push(moving: &mut [Moving], [a, b]: [u32; 2], normal: [f64; 4], impulse: f64) {
    let one = &mut moving[a as usize];
    *one = moved(*one, normal, -impulse);
    if let Some(other) = moving.get_mut(b as usize) {
        *other = moved(*other, normal, impulse);
    }
}

/// A body after an impulse.
#[inline(always)]
fn moved(body: Moving, normal: [f64; 4], impulse: f64) -> Moving {
    let change = impulse * body[3];
    std::array::from_fn(|axis| body[axis] + change * normal[axis])
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
