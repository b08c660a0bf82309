//! Projected Gauss–Seidel sweeps over the contacts of one component, forwards and backwards in turn.

use glam::DVec3;

use super::rows::{Row, Rows, Swept, moved};
#[cfg(target_arch = "x86_64")]
use super::rows_avx;
use super::rub::Rubbing;
use super::stepped::{Contact, Moving, Step, Stepped, velocity};
use super::tolerance::{BUDGET, CREEPING, FINEST, GIVING, SHARE_OF_DIRECTION, SLOW};

/// The rows of a component with the velocities that they act on. It is kept from step to step for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct System {
    pub rows: Rows,
    /// The bound of each row on its rate, m/s.
    pub bounds: Vec<f64>,
    /// The impulses of the rows and of the lanes after them, N·s.
    pub impulses: Vec<f64>,
    /// What the last sweep changed of each of these, N·s.
    pub changes: Vec<f64>,
    /// Change of an impulse in units of what is tolerated, 1/(N·s), and 1/m_a + 1/m_b, 1/kg, of each row.
    scales: Vec<f64>,
    inverse_masses: Vec<f64>,
    /// Where the conjugate gradient goes on, N·s, as many as impulses, and what that is to the velocities, m/s.
    directions: Vec<f64>,
    headings: Vec<Moving>,
    /// Σ change²/mass of the last sweep; 0 before the first.
    norm: f64,
    /// How that compares to the sweep before.
    share: f64,
    /// In the middle of the step, with one that does not move after them; and before the last sweep.
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
        self.rows.begin(bodies.len());
        self.bounds.clear();
        self.impulses.clear();
        self.scales.clear();
        self.inverse_masses.clear();
        self.moving.clear();
        self.moving.extend(bodies.iter().map(|body| free(body, h)));
        self.moving.push(Moving::default());
        // What is not a number, of a step that was given up, would stay: zero times it is none.
        self.directions.clear();
        self.headings.clear();
        self.headings.resize(self.moving.len(), Moving::default());
    }

    /// Adds contacts, each as a row with the scale of its changes, and with the impulses that they begin with.
    pub fn add(&mut self, contacts: &[Contact], scale: impl Fn(&Contact) -> f64) {
        self.impulses.truncate(self.rows.len());
        for contact in contacts {
            self.rows.add(contact);
            self.bounds.push(contact.bound);
            self.impulses.push(contact.impulse);
            self.scales.push(scale(contact));
            self.inverse_masses.push(contact.inverse_mass);
            if contact.impulse > 0.0 {
                let [x, y, z] = contact.normal.to_array();
                push(&mut self.moving, [contact.a, contact.b], [x, y, z, 0.0], contact.impulse);
            }
        }
        for of_lanes in [&mut self.impulses, &mut self.changes, &mut self.directions] {
            of_lanes.resize(self.rows.lanes(), 0.0);
        }
        self.begin_anew();
    }

    /// Forgets where the conjugate gradient went: something else has changed impulses.
    pub fn begin_anew(&mut self) {
        self.norm = 0.0;
    }

    /// One sweep; gives the largest change in units of what is tolerated.
    pub fn sweep(&mut self, is_backward: bool, rubbing: &mut Rubbing) -> f64 {
        self.before.clone_from(&self.moving);
        let Self { impulses, changes, moving, .. } = self;
        sweep(&self.rows, is_backward, Swept { impulses, changes, moving });
        let (worst, norm) = measure(&self.changes[..self.rows.len()], &self.scales, &self.inverse_masses);
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
        let steps = self.directions.iter_mut().zip(&self.changes);
        for (impulse, (direction, change)) in self.impulses.iter_mut().zip(steps) {
            let step = share * *direction;
            *direction = step + change;
            *impulse += step;
        }
        self.push_back();
    }

    /// Takes back what would make impulses negative, and goes on there no further.
    fn push_back(&mut self) {
        let steps =
            self.impulses.as_chunks_mut::<4>().0.iter_mut().zip(self.directions.as_chunks_mut::<4>().0);
        for (first, (impulses, directions)) in (0..).step_by(4).zip(steps) {
            // Few rows are.
            if !is_any_negative(impulses) {
                continue;
            }
            for (nth, (impulse, direction)) in impulses.iter_mut().zip(directions).enumerate() {
                if *impulse < 0.0 {
                    let row = self.rows.row(first + nth);
                    let inverse_masses = inverse_masses(&self.moving, row.ends);
                    push_by(&mut self.headings, &row, inverse_masses, -*direction);
                    push_by(&mut self.moving, &row, inverse_masses, -*impulse);
                    (*impulse, *direction) = (0.0, 0.0);
                }
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

/// One sweep over all rows, by fours where the processor can.
fn sweep(rows: &Rows, is_backward: bool, swept: Swept<'_>) {
    #[cfg(target_arch = "x86_64")]
    let Some(swept) = rows_avx::sweep(rows, is_backward, swept) else { return };
    rows.sweep_one_by_one(is_backward, swept);
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

/// Gathers the signs as bits, which the processor does for several at once.
#[inline(always)]
fn is_any_negative(four: &[f64; 4]) -> bool {
    let signs = four.iter().fold(0, |signs, number| signs | number.to_bits());
    f64::from_bits(signs).is_sign_negative()
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

/// n·(u'_b − u'_a), m/s.
pub(super) fn closing(contact: &Contact, moving: &[Moving]) -> f64 {
    let of = |body: u32| moving.get(body as usize).map_or(DVec3::ZERO, velocity);
    contact.normal.dot(of(contact.b) - of(contact.a))
}
