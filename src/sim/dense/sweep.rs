//! Projected Gauss–Seidel sweeps over the contacts of one component, forwards and backwards in turn.

use glam::DVec3;

use super::contact::{Contact, Stepped};
use super::tolerance::{
    BUDGET, COARSEST, FINEST, FINEST_OF_DEEP, GAIN, MOST_SWEEPS, SHARE_OF_BUDGET, SHARE_OF_WAY,
    SWEEPS_AGAINST_GAIN,
};

/// Velocities in the middle of a step, with the impulses that led to them.
#[derive(Clone, Debug)]
pub(super) struct Solution {
    pub velocities: Vec<DVec3>,
    /// Energy that the contacts took, J.
    pub loss: f64,
    pub sweeps: usize,
    pub has_converged: bool,
}

/// A contact as the sweeps read it: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Row {
    normal: [f64; 3],
    bound: f64,
    mass: f64,
    impulse: f64,
    /// Change of impulse in units of what is tolerated.
    scale: f64,
    a: u32,
    b: u32,
}

/// Velocity, and inverse mass.
type Moving = [f64; 4];

/// Solves the contacts of a component in a step of length h. Their impulses are where it begins, and what it finds.
pub(super) fn solve(contacts: &mut Vec<Contact>, bodies: &[Stepped], radii: &[f64], h: f64) -> Solution {
    let tolerance = Tolerance::of(bodies, h);
    let mut moving: Vec<Moving> = bodies.iter().map(|body| free(body, h)).collect();
    moving.push([0.0; 4]);
    let (mut waiting, taken): (Vec<Contact>, Vec<Contact>) =
        contacts.drain(..).partition(|contact| contact.is_lazy);
    *contacts = taken;
    let mut rows: Vec<Row> = contacts.iter().map(|contact| tolerance.row(contact, h)).collect();
    rows.iter().for_each(|row| push(&mut moving, row, row.impulse));
    let allowed = allowed_gain(bodies, radii);
    let (mut sweeps, mut extra, mut has_converged) = (0, 0, false);
    let mut conjugate = Conjugate::default();
    while sweeps < MOST_SWEEPS {
        conjugate.remember(&rows);
        let worst = if sweeps % 2 == 0 {
            sweep(rows.iter_mut(), &mut moving)
        } else {
            sweep(rows.iter_mut().rev(), &mut moving)
        };
        sweeps += 1;
        if worst > 1.0 {
            conjugate.go_on(&mut rows, &mut moving);
            continue;
        }
        let before = rows.len();
        waiting.retain(|contact| {
            let meets = contact.gap + h * closing(contact, &moving) < 0.0;
            if meets {
                contacts.push(*contact);
                rows.push(tolerance.row(contact, h));
            }
            !meets
        });
        if rows.len() > before {
            conjugate = Conjugate::default();
            continue;
        }
        has_converged = !sinks(contacts, &moving, h);
        let gains = -loss(contacts, &rows, &moving) > allowed;
        if extra >= SWEEPS_AGAINST_GAIN || (has_converged && !gains) {
            break;
        }
        conjugate.go_on(&mut rows, &mut moving);
        extra += 1;
    }
    let loss = loss(contacts, &rows, &moving);
    for (contact, row) in contacts.iter_mut().zip(&rows) {
        contact.impulse = row.impulse;
    }
    moving.pop();
    let velocities = moving.iter().map(|[x, y, z, _]| DVec3::new(*x, *y, *z)).collect();
    Solution { velocities, loss, sweeps, has_converged }
}

/// The nonlinear conjugate gradient method on top of the sweeps, taking what a sweep changes for the gradient
/// (Silcowitz-Hansen, Niebe & Erleben 2010): impulses travel through a column of n bodies in some n sweeps, not n².
#[derive(Default)]
struct Conjugate {
    before: Vec<f64>,
    direction: Vec<f64>,
    norm: f64,
}

impl Conjugate {
    fn remember(&mut self, rows: &[Row]) {
        self.before.clear();
        self.before.extend(rows.iter().map(|row| row.impulse));
    }

    /// Goes on along the directions of before, as long as changes become smaller.
    fn go_on(&mut self, rows: &mut [Row], moving: &mut [Moving]) {
        let changes = rows.iter().zip(&self.before).map(|(row, before)| row.impulse - before);
        let norm: f64 = changes.zip(rows.iter()).map(|(change, row)| change * change / row.mass).sum();
        let share = norm / self.norm;
        self.norm = norm;
        if self.direction.len() != rows.len() || share.is_nan() || share >= 1.0 {
            self.direction.clear();
            self.direction.extend(rows.iter().zip(&self.before).map(|(row, before)| row.impulse - before));
            return;
        }
        for ((row, direction), before) in rows.iter_mut().zip(&mut self.direction).zip(&self.before) {
            let change = row.impulse - before;
            let step = share * *direction;
            *direction = step + change;
            let impulse = (row.impulse + step).max(0.0);
            push(moving, row, impulse - row.impulse);
            row.impulse = impulse;
        }
    }
}

/// A body as the applied forces alone move it.
fn free(body: &Stepped, h: f64) -> Moving {
    let u = if body.inverse_mass > 0.0 { body.u + h * body.a } else { body.u };
    [u.x, u.y, u.z, body.inverse_mass]
}

/// One sweep; gives the largest change in units of what is tolerated.
#[inline(always)]
fn sweep<'a>(rows: impl Iterator<Item = &'a mut Row>, moving: &mut [Moving]) -> f64 {
    let mut worst: f64 = 0.0;
    for row in rows {
        let (a, b) = (moving[row.a as usize], moving[row.b as usize]);
        let [x, y, z] = row.normal;
        let rate = x * (b[0] - a[0]) + y * (b[1] - a[1]) + z * (b[2] - a[2]);
        let impulse = (row.impulse + (row.bound - rate) * row.mass).max(0.0);
        let change = impulse - row.impulse;
        row.impulse = impulse;
        worst = worst.max((change * row.scale).abs());
        push(moving, row, change);
    }
    worst
}

#[inline(always)]
fn push(moving: &mut [Moving], row: &Row, impulse: f64) {
    let [x, y, z] = row.normal;
    for (index, impulse) in [(row.a, -impulse), (row.b, impulse)] {
        let body = &mut moving[index as usize];
        let change = impulse * body[3];
        body[0] += change * x;
        body[1] += change * y;
        body[2] += change * z;
    }
}

/// n·(u'_b − u'_a), m/s.
fn closing(contact: &Contact, moving: &[Moving]) -> f64 {
    let (a, b) = (moving[contact.a as usize], moving[contact.b as usize]);
    contact.normal.dot(DVec3::new(b[0] - a[0], b[1] - a[1], b[2] - a[2]))
}

/// Whether a contact goes deeper than the overlap budget allows.
fn sinks(contacts: &[Contact], moving: &[Moving], h: f64) -> bool {
    let goes_deep = |contact: &Contact| {
        let deeper = -h * closing(contact, moving);
        let budget = BUDGET * contact.radius;
        deeper > FINEST * contact.radius && deeper - contact.gap > budget
    };
    contacts.iter().any(goes_deep)
}

/// −½ Σ λ (s + s'), J.
fn loss(contacts: &[Contact], rows: &[Row], moving: &[Moving]) -> f64 {
    let loaded = contacts.iter().zip(rows).filter(|(_, row)| row.impulse > 0.0);
    loaded.map(|(contact, row)| -0.5 * row.impulse * (contact.rate + closing(contact, moving))).sum()
}

/// Energy that what the sweeps leave may add, J.
fn allowed_gain(bodies: &[Stepped], radii: &[f64]) -> f64 {
    let moving = bodies.iter().zip(radii).filter(|(body, _)| body.inverse_mass > 0.0);
    let least = moving.map(|(body, radius)| body.a.length() * radius / body.inverse_mass);
    GAIN * least.fold(f64::INFINITY, f64::min)
}

/// What changes of an impulse are tolerated at last: see [`super::tolerance`].
struct Tolerance {
    /// Of the way that bodies pass in a step on average, m.
    way: f64,
}

impl Tolerance {
    fn of(bodies: &[Stepped], h: f64) -> Self {
        let mean: f64 = bodies.iter().map(|body| body.u.length_squared()).sum::<f64>() / bodies.len() as f64;
        Self { way: SHARE_OF_WAY * h * mean.sqrt() }
    }

    /// min(clamp(0.1 h u, 2e-6 r, 1e-4 r), max((8e-4 r + g)/4, 2e-7 r)), m.
    fn of_contact(&self, contact: &Contact) -> f64 {
        let (finest, coarsest) = (FINEST * contact.radius, COARSEST * contact.radius);
        let left = SHARE_OF_BUDGET * (BUDGET * contact.radius + contact.gap);
        self.way.clamp(finest, coarsest).min(left.max(FINEST_OF_DEEP * finest))
    }

    fn row(&self, contact: &Contact, h: f64) -> Row {
        Row {
            normal: contact.normal.to_array(),
            bound: contact.bound,
            mass: 1.0 / contact.inverse_mass,
            impulse: contact.impulse,
            scale: contact.inverse_mass * h / self.of_contact(contact),
            a: contact.a,
            b: contact.b,
        }
    }
}
