//! Projected Gauss–Seidel sweeps over the contacts of one component, forwards and backwards in turn.

use glam::DVec3;

use super::rub::{LawOf, Rubbing};
use super::stepped::{Contact, Moving, Stepped, velocity};
use super::tolerance::{
    BUDGET, COARSEST, FINEST, FINEST_OF_DEEP, GAIN, GROSS_GAIN, MOST_SWEEPS, SHARE_OF_BUDGET, SHARE_OF_WAY,
    SWEEPS_AGAINST_GAIN,
};

/// What became of the contacts of a component in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Solution {
    /// Energy that the contacts took, J.
    pub loss: f64,
    pub sweeps: usize,
    pub has_converged: bool,
    /// Whether it gains so much that it must not be taken.
    pub gains: bool,
}

/// A contact as the sweeps read it: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Row {
    /// And 0.
    normal: [f64; 4],
    bound: f64,
    mass: f64,
    /// Change of impulse in units of what is tolerated.
    scale: f64,
    /// Places of its bodies.
    ends: [u32; 2],
}

/// The rows of a component with the velocities that they act on. It is kept from step to step for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct System {
    rows: Vec<Row>,
    /// The impulses of the rows, apart, since rows are only read, N·s.
    impulses: Vec<f64>,
    /// What the last sweep changed of each impulse, and where the conjugate gradient goes on, N·s.
    changes: Vec<f64>,
    directions: Vec<f64>,
    /// Σ change²/mass of the last sweep; 0 before the first.
    norm: f64,
    /// How that compares to the sweep before.
    share: f64,
    /// In the middle of the step.
    pub moving: Vec<Moving>,
}

/// Solves the contacts of a component in a step of length h. Their impulses are where it begins, and what it finds.
/// `meet` adds contacts that are seen to be met.
pub(super) fn solve(
    system: &mut System,
    contacts: &mut Vec<Contact>,
    bodies: &[Stepped],
    h: f64,
    (rubbing, law): (&mut Rubbing, &LawOf<'_>),
    mut meet: impl FnMut(&[Moving], &mut Vec<Contact>),
) -> Solution {
    let tolerance = Tolerance::of(bodies, h);
    let scale_of = |contact: &Contact| tolerance.row(contact).scale;
    let rub_on = |system: &mut System, rubbing: &mut Rubbing, first: usize, contacts: &[Contact]| {
        let rows = rubbing.len();
        rubbing.add(first, &contacts[first..], bodies, (h, &scale_of), law);
        rubbing.warm_up(rows, bodies, &mut system.moving);
    };
    system.begin(bodies, h);
    system.add(contacts, &tolerance);
    rub_on(system, rubbing, 0, contacts);
    let allowed = allowed_gain(bodies);
    let (mut extra, mut solution) = (0, Solution::default());
    let loss = loop {
        if solution.sweeps >= MOST_SWEEPS {
            let loss = system.judge(contacts, h, rubbing).0;
            solution.gains = gains_grossly(loss, bodies);
            break loss;
        }
        let worst = system.sweep(solution.sweeps % 2 == 1, rubbing);
        solution.sweeps += 1;
        if worst > 1.0 {
            system.go_on(rubbing);
            continue;
        }
        let before = contacts.len();
        meet(&system.moving, contacts);
        if contacts.len() > before {
            system.add(&contacts[before..], &tolerance);
            rub_on(system, rubbing, before, contacts);
            solution.has_converged = false;
            continue;
        }
        let (loss, sinks) = system.judge(contacts, h, rubbing);
        solution.gains = gains_grossly(loss, bodies);
        solution.has_converged = !sinks && !solution.gains;
        let is_tired = extra >= SWEEPS_AGAINST_GAIN && !solution.gains;
        if is_tired || (!sinks && -loss <= allowed) {
            break loss;
        }
        system.go_on(rubbing);
        extra += 1;
    };
    solution.loss = loss;
    for (contact, impulse) in contacts.iter_mut().zip(&system.impulses) {
        contact.impulse = *impulse;
    }
    solution
}

impl System {
    /// Bodies as the applied forces alone move them, without rows.
    fn begin(&mut self, bodies: &[Stepped], h: f64) {
        self.rows.clear();
        self.impulses.clear();
        self.moving.clear();
        self.moving.extend(bodies.iter().map(|body| free(body, h)));
    }

    /// Adds rows with the impulses that they begin with.
    fn add(&mut self, contacts: &[Contact], tolerance: &Tolerance) {
        self.rows.extend(contacts.iter().map(|contact| tolerance.row(contact)));
        self.impulses.extend(contacts.iter().map(|contact| contact.impulse));
        for contact in contacts.iter().filter(|contact| contact.impulse > 0.0) {
            let [x, y, z] = contact.normal.to_array();
            push(&mut self.moving, [contact.a, contact.b], [x, y, z, 0.0], contact.impulse);
        }
        self.changes.resize(self.rows.len(), 0.0);
        self.directions.resize(self.rows.len(), 0.0);
        self.norm = 0.0;
    }

    /// Takes a solution that was found elsewhere.
    pub fn adopt(&mut self, impulses: Vec<f64>, motion: &[DVec3], inverse_mass: &[f64]) {
        self.impulses = impulses;
        self.moving.clear();
        self.moving.extend(motion.iter().zip(inverse_mass).map(|(u, inverse)| [u.x, u.y, u.z, *inverse]));
    }

    /// One sweep; gives the largest change in units of what is tolerated.
    fn sweep(&mut self, is_backward: bool, rubbing: &mut Rubbing) -> f64 {
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
    fn go_on(&mut self, rubbing: &Rubbing) {
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

    /// Energy that the contacts take, −½ Σ λ (s + s'), J, and whether one of them goes deeper than the overlap
    /// budget allows.
    pub fn judge(&self, contacts: &[Contact], h: f64, rubbing: &Rubbing) -> (f64, bool) {
        let (mut loss, mut sinks) = (0.0, false);
        for (contact, impulse) in contacts.iter().zip(&self.impulses) {
            let rate = closing(contact, &self.moving);
            loss -= 0.5 * impulse * (contact.rate + rate);
            let deeper = -h * rate;
            let budget = BUDGET * contact.radius;
            sinks |= deeper > FINEST * contact.radius && deeper - contact.gap > budget;
        }
        if !rubbing.is_empty() {
            loss += rubbing.loss(&self.moving);
        }
        (loss, sinks)
    }
}

/// A body as the applied forces alone move it.
pub(super) fn free(body: &Stepped, h: f64) -> Moving {
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
fn push(moving: &mut [Moving], [a, b]: [u32; 2], normal: [f64; 4], impulse: f64) {
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

/// Whether contacts that take this energy, J, give so much that a step has not converged.
pub(super) fn gains_grossly(loss: f64, bodies: &[Stepped]) -> bool {
    -loss > GROSS_GAIN * allowed_gain(bodies)
}

/// Energy that what the sweeps leave may add, J.
fn allowed_gain(bodies: &[Stepped]) -> f64 {
    let moving = bodies.iter().filter(|body| body.inverse_mass > 0.0);
    let least = moving.map(|body| body.drive * body.radius / body.inverse_mass);
    GAIN * least.fold(f64::INFINITY, f64::min)
}

/// What changes of an impulse are tolerated at last: see [`super::tolerance`].
struct Tolerance {
    /// Of the way that bodies pass in a step on average, m.
    way: f64,
    /// Length of the step, s.
    h: f64,
}

impl Tolerance {
    fn of(bodies: &[Stepped], h: f64) -> Self {
        let mean: f64 = bodies.iter().map(|body| body.u.length_squared()).sum::<f64>() / bodies.len() as f64;
        Self { way: SHARE_OF_WAY * h * mean.sqrt(), h }
    }

    /// min(clamp(0.1 h u, 2e-6 r, 1e-4 r), max((6e-4 r + g)/4, 2e-7 r)), m.
    fn of_contact(&self, contact: &Contact) -> f64 {
        let (finest, coarsest) = (FINEST * contact.radius, COARSEST * contact.radius);
        let left = SHARE_OF_BUDGET * (BUDGET * contact.radius + contact.gap);
        self.way.clamp(finest, coarsest).min(left.max(FINEST_OF_DEEP * finest))
    }

    fn row(&self, contact: &Contact) -> Row {
        let [x, y, z] = contact.normal.to_array();
        Row {
            normal: [x, y, z, 0.0],
            bound: contact.bound,
            mass: 1.0 / contact.inverse_mass,
            scale: contact.inverse_mass * self.h / self.of_contact(contact),
            ends: [contact.a, contact.b],
        }
    }
}
