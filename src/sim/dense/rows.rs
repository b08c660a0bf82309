//! The contacts of a component as the sweeps read them: four side by side.
//!
//! In large components neighbours in the order of rows share no body (see [`super::components`]), so that four of them
//! can be swept at once, with the bits of one after the other.

use super::stepped::{Contact, FIXED, Moving};

/// Four rows, of which each lane is one. Where there are fewer, the rest of the lanes do nothing.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Four {
    /// x, y, z from the first body to the second.
    pub normal: [[f64; 4]; 3],
    /// That an impulse along the normal moves, kg.
    pub mass: [f64; 4],
    /// That mass times the bound on the rate, N·s.
    pub target: [f64; 4],
    /// Places of the first and of the second bodies; that of what does not move is the last.
    pub ends: [[u32; 4]; 2],
}

/// One row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// And 0.
    pub normal: [f64; 4],
    /// Places of its bodies; the second may be [`FIXED`].
    pub ends: [u32; 2],
}

/// The rows of a component. It is kept from step to step for its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    fours: Vec<Four>,
    /// Whether no two of the four share a body that moves.
    are_apart: Vec<bool>,
    count: usize,
    /// The place of what does not move: after all bodies.
    fixed: u32,
    /// For each body the last four that it is in, from 1 on.
    last_in: Vec<u32>,
}

/// What a sweep changes: impulses and their changes, N·s, as many as [`Rows::lanes`], and the bodies, with one that does
/// not move after them.
pub(super) struct Swept<'a> {
    pub impulses: &'a mut [f64],
    pub changes: &'a mut [f64],
    pub moving: &'a mut [Moving],
}

/// The same of four rows.
pub(super) struct Lanes<'a> {
    pub impulses: &'a mut [f64; 4],
    pub changes: &'a mut [f64; 4],
}

impl Rows {
    /// None, of so many bodies.
    pub fn begin(&mut self, bodies: usize) {
        self.fours.clear();
        self.are_apart.clear();
        self.count = 0;
        self.fixed = bodies as u32;
        self.last_in.clear();
        self.last_in.resize(bodies, 0);
    }

    pub fn add(&mut self, contact: &Contact) {
        let lane = self.count % 4;
        if lane == 0 {
            let ends = [[self.fixed; 4]; 2];
            self.fours.push(Four { normal: [[0.0; 4]; 3], mass: [0.0; 4], target: [0.0; 4], ends });
            self.are_apart.push(true);
        }
        self.count += 1;
        let number = self.fours.len() as u32;
        let (Some(four), Some(is_apart)) = (self.fours.last_mut(), self.are_apart.last_mut()) else { return };
        for (axis, component) in contact.normal.to_array().into_iter().enumerate() {
            four.normal[axis][lane] = component;
        }
        let mass = 1.0 / contact.inverse_mass;
        (four.mass[lane], four.target[lane]) = (mass, contact.bound * mass);
        for (ends, body) in four.ends.iter_mut().zip([contact.a, contact.b]) {
            if let Some(last) = self.last_in.get_mut(body as usize) {
                ends[lane] = body;
                *is_apart &= *last != number;
                *last = number;
            }
        }
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// Rows and lanes that do nothing.
    pub fn lanes(&self) -> usize {
        4 * self.fours.len()
    }

    pub fn row(&self, index: usize) -> Row {
        let (four, lane) = (&self.fours[index / 4], index % 4);
        let [x, y, z] = four.normal.map(|component| component[lane]);
        let place = |body: u32| if body == self.fixed { FIXED } else { body };
        Row { normal: [x, y, z, 0.0], ends: four.ends.map(|bodies| place(bodies[lane])) }
    }

    /// One sweep of projected Gauss–Seidel over all rows, one after the other.
    pub fn sweep_one_by_one(&self, is_backward: bool, Swept { impulses, changes, moving }: Swept<'_>) {
        let sweep = |(four, _, lanes): (&Four, bool, Lanes<'_>)| one_by_one(four, is_backward, lanes, moving);
        let fours = self.fours(impulses, changes);
        if is_backward { fours.rev().for_each(sweep) } else { fours.for_each(sweep) }
    }

    /// The rows by fours, with whether they are apart, and with their impulses and changes.
    #[inline(always)]
    pub fn fours<'a>(
        &'a self,
        impulses: &'a mut [f64],
        changes: &'a mut [f64],
    ) -> impl DoubleEndedIterator<Item = (&'a Four, bool, Lanes<'a>)> {
        let lanes = impulses.as_chunks_mut().0.iter_mut().zip(changes.as_chunks_mut().0);
        let rows = self.fours.iter().zip(&self.are_apart).zip(lanes);
        rows.map(|((four, is_apart), (impulses, changes))| (four, *is_apart, Lanes { impulses, changes }))
    }
}

/// Sweeps four rows one after the other.
pub(super) fn one_by_one(
    four: &Four,
    is_backward: bool,
    Lanes { impulses, changes }: Lanes<'_>,
    moving: &mut [Moving],
) {
    for nth in 0..4 {
        let lane = if is_backward { 3 - nth } else { nth };
        let [x, y, z] = four.normal.map(|component| component[lane]);
        let normal = [x, y, z, 0.0];
        let [a, b] = four.ends.map(|bodies| bodies[lane] as usize);
        let (one, other) = (moving[a], moving[b]);
        // What takes its time is how long each row waits for what it calculates: all that can be is multiplied before.
        let wanted = four.target[lane] - dot(times(normal, four.mass[lane]), minus(other, one));
        // Quicker than `max`, which asks for NaN.
        let by = if wanted > -impulses[lane] { wanted } else { -impulses[lane] };
        impulses[lane] += by;
        changes[lane] = by;
        moving[b] = moved(other, normal, by);
        moving[a] = moved(one, normal, -by);
    }
}

/// A body after an impulse.
#[inline(always)]
pub(super) fn moved(body: Moving, normal: [f64; 4], impulse: f64) -> Moving {
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

/// Of the first three.
#[inline(always)]
fn dot(one: [f64; 4], other: [f64; 4]) -> f64 {
    (one[0] * other[0] + one[2] * other[2]) + one[1] * other[1]
}

#[cfg(test)]
pub(super) mod tests {
    use glam::DVec3;

    use super::*;

    const NONE: Contact = Contact {
        near: 0,
        listed: 0,
        a: FIXED,
        b: FIXED,
        normal: DVec3::ZERO,
        gap: 0.0,
        rate: 0.0,
        bound: 0.0,
        inverse_mass: 0.0,
        impulse: 0.0,
    };

    /// Numbers from −½ to ½ (Numerical Recipes' generator).
    fn random() -> impl FnMut() -> f64 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        }
    }

    fn contacts(ends: &[[u32; 2]]) -> Vec<Contact> {
        let mut random = random();
        let of = |[a, b]: &[u32; 2]| Contact {
            a: *a,
            b: *b,
            normal: DVec3::new(random(), random(), random()).normalize(),
            bound: 0.2 * random(),
            inverse_mass: 1.0 + random(),
            impulse: (0.1 * random()).max(0.0),
            ..NONE
        };
        ends.iter().map(of).collect()
    }

    /// The impulses, their changes and the velocities after eight sweeps, to and fro.
    pub fn swept(contacts: &[Contact], bodies: usize, sweep: impl Fn(&Rows, bool, Swept<'_>)) -> Vec<f64> {
        let mut rows = Rows::default();
        rows.begin(bodies);
        contacts.iter().for_each(|contact| rows.add(contact));
        assert_eq!((rows.len(), rows.lanes()), (contacts.len(), contacts.len().next_multiple_of(4)));
        let mut random = random();
        let mut moving: Vec<Moving> =
            (0..bodies).map(|_| [random(), random(), random(), 1.0 + random()]).collect();
        moving.push(Moving::default());
        let mut impulses: Vec<f64> = contacts.iter().map(|contact| contact.impulse).collect();
        impulses.resize(rows.lanes(), 0.0);
        let mut changes = vec![0.0; rows.lanes()];
        for nth in 0..8 {
            let (impulses, changes, moving) = (&mut impulses, &mut changes, &mut moving);
            sweep(&rows, nth % 2 == 1, Swept { impulses, changes, moving });
        }
        assert_eq!(moving[bodies], Moving::default(), "what does not move has moved");
        assert!(impulses[contacts.len()..].iter().all(|impulse| *impulse == 0.0));
        [impulses, changes, moving.into_flattened()].concat()
    }

    /// Contacts of which some fours share no body, others one, some touch what does not move, and the last are few.
    pub fn mixed() -> Vec<Contact> {
        let apart = [[0, 1], [2, 3], [4, 5], [6, FIXED]];
        let shared = [[0, 2], [2, 4], [5, FIXED], [6, 1]];
        let fixed = [[0, FIXED], [1, FIXED], [2, FIXED], [3, FIXED]];
        contacts(&[&apart[..], &shared, &fixed, &apart, &shared[..3]].concat())
    }

    /// In its plainest form: λ ← max(λ + (b − n·(u_b − u_a))/(1/m_a + 1/m_b), 0), contact after contact.
    #[test]
    fn a_sweep_is_one_of_projected_gauss_seidel() {
        let contacts = mixed();
        let plainly = |_: &Rows, is_backward: bool, Swept { impulses, changes, moving }: Swept<'_>| {
            for nth in 0..contacts.len() {
                let k = if is_backward { contacts.len() - 1 - nth } else { nth };
                let Contact { a, b, normal, bound, inverse_mass, .. } = contacts[k];
                let place = |body: u32| if body == FIXED { 7 } else { body as usize };
                let velocity = |body: u32| super::super::stepped::velocity(&moving[place(body)]);
                let rate = normal.dot(velocity(b) - velocity(a));
                let impulse = (impulses[k] + (bound - rate) / inverse_mass).max(0.0);
                changes[k] = impulse - std::mem::replace(&mut impulses[k], impulse);
                for (body, sign) in [(a, -1.0), (b, 1.0)] {
                    let [x, y, z, inverse] = moving[place(body)];
                    let after = DVec3::new(x, y, z) + sign * changes[k] * inverse * normal;
                    moving[place(body)] = [after.x, after.y, after.z, inverse];
                }
            }
        };
        let (found, expected) = (swept(&contacts, 7, Rows::sweep_one_by_one), swept(&contacts, 7, plainly));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
        }
    }

    #[test]
    fn rows_are_kept_as_they_were_added() {
        let contacts = contacts(&[[0, 1], [2, FIXED], [1, 2], [3, 4], [0, 4]]);
        let mut rows = Rows::default();
        rows.begin(5);
        contacts.iter().for_each(|contact| rows.add(contact));
        for (k, contact) in contacts.iter().enumerate() {
            let row = rows.row(k);
            assert_eq!(
                (row.ends, &row.normal[..3]),
                ([contact.a, contact.b], &contact.normal.to_array()[..])
            );
        }
    }
}
