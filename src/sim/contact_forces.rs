//! Forces at contacts that rub, when it is known which of them slip: a linear problem.
//!
//! With n from a body a into b, the force on a is −λ n + T, on b the opposite, at the arms R_a n and −R_b n. A contact that
//! slips has T = −μλ ŝ, one that sticks has T such that its slip stays zero. The unknowns are λ, and T where it
//! sticks; the accelerations along the normals and of the slips are given. It is not symmetric where contacts slip,
//! and has no unique answer where contacts depend on each other: those with the least friction are taken then.

use glam::DVec3;

use super::link::Link;
use super::tolerance::{DEPENDENT, OF_LOADS};
use super::turn::INERTIA;

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mode {
    /// Nothing rubs.
    Smooth,
    Sticks,
    /// With a unit slip of the first body on the second.
    Slips(DVec3),
}

/// A contact at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub link: Link,
    /// How the normal turns, 1/s.
    pub turning: DVec3,
    /// Radii of both bodies, m: 0 of one that does not turn.
    pub arms: [f64; 2],
    pub friction: f64,
    pub mode: Mode,
}

/// Motions of the bodies, of centres and of spins, times the radii in the second half: velocities or accelerations.
pub(super) type Motions = Vec<DVec3>;

/// What a problem came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Forces {
    /// Along the normals, ≥ 0 where they press.
    pub loads: Vec<f64>,
    /// Across them, on the first body of each.
    pub across: Vec<DVec3>,
}

/// One unknown: a unit of force at a contact, along its normal or across it.
struct Column {
    touch: usize,
    /// Whether it is a load, with the friction of a slip.
    is_load: bool,
    /// On the first body.
    force: DVec3,
    /// The part of it across the normal, which turns both.
    across: DVec3,
}

impl Touch {
    /// Slip of the first body on the second: from velocities or accelerations, without what the turning normal adds.
    pub fn slip(&self, motions: &[DVec3]) -> DVec3 {
        let half = motions.len() / 2;
        let [apart, turning] = self.both(motions, half);
        apart - apart.dot(self.link.towards) * self.link.towards + turning.cross(self.link.towards)
    }

    /// Difference of the centres, and the sum of R ω.
    fn both(&self, motions: &[DVec3], half: usize) -> [DVec3; 2] {
        let of = |at: Option<usize>| at.map_or(DVec3::ZERO, |at| motions[at]);
        let turn =
            |at: Option<usize>, arm: f64| if arm > 0.0 { of(at.map(|at| at + half)) } else { DVec3::ZERO };
        let (a, b) = (Some(self.link.a), self.link.b);
        [of(a) - of(b), turn(a, self.arms[0]) + turn(b, self.arms[1])]
    }

    /// What the turning of the normal adds to the change of a slip.
    pub fn drift(&self, velocities: &[DVec3]) -> DVec3 {
        let [_, turning] = self.both(velocities, velocities.len() / 2);
        let drift = turning.cross(self.turning);
        drift - drift.dot(self.link.towards) * self.link.towards
    }

    /// Two unit vectors across the normal.
    fn basis(&self) -> [DVec3; 2] {
        let first = self.link.towards.any_orthonormal_vector();
        [first, self.link.towards.cross(first)]
    }

    fn columns(&self, touch: usize) -> impl Iterator<Item = Column> + use<> {
        let normal = -self.link.towards;
        let rubbing = match self.mode {
            Mode::Slips(slip) => -self.friction * slip,
            Mode::Smooth | Mode::Sticks => DVec3::ZERO,
        };
        let along = Column { touch, is_load: true, force: normal + rubbing, across: rubbing };
        let basis = (self.mode == Mode::Sticks).then(|| self.basis()).into_iter().flatten();
        std::iter::once(along).chain(basis.map(move |across| Column {
            touch,
            is_load: false,
            force: across,
            across,
        }))
    }
}

/// Adds what a force of this size does.
fn push(touch: &Touch, inverse_mass: &[f64], column: &Column, size: f64, motions: &mut [DVec3]) {
    let half = motions.len() / 2;
    let ends = [(Some(touch.link.a), 1.0, touch.arms[0]), (touch.link.b, -1.0, touch.arms[1])];
    for (body, sign, arm) in ends {
        let Some(body) = body else { continue };
        let inverse = size * inverse_mass[body];
        motions[body] += sign * inverse * column.force;
        if arm > 0.0 {
            // R α = R (R n × T)/I on both.
            motions[body + half] += inverse / INERTIA * touch.link.towards.cross(column.across);
        }
    }
}

/// Turns motions into those under contact: along each normal `entering` its limit, and slips that stay zero where they are
/// to, but for `drifts`.
pub(super) fn apply(
    touches: &[Touch],
    inverse_mass: &[f64],
    limits: &[f64],
    drifts: &[DVec3],
    motions: &mut Motions,
) -> Forces {
    let columns: Vec<Column> = touches.iter().enumerate().flat_map(|(k, touch)| touch.columns(k)).collect();
    let mut matrix = vec![vec![0.0; columns.len() + 1]; columns.len()];
    let mut response = vec![DVec3::ZERO; motions.len()];
    for (j, column) in columns.iter().enumerate() {
        response.fill(DVec3::ZERO);
        push(&touches[column.touch], inverse_mass, column, 1.0, &mut response);
        for (row, entry) in matrix.iter_mut().zip(rows(touches, &columns, &response)) {
            row[j] = entry;
        }
    }
    let wanted = columns.iter().map(|column| {
        if column.is_load { limits[column.touch] } else { -drifts[column.touch].dot(column.across) }
    });
    let now = rows(touches, &columns, motions);
    for ((row, wanted), now) in matrix.iter_mut().zip(wanted).zip(now) {
        row[columns.len()] = wanted - now;
    }
    let weights: Vec<f64> =
        columns.iter().map(|column| if column.is_load { OF_LOADS } else { 1.0 }).collect();
    let sizes = eliminate(&mut matrix, &weights);
    let mut forces = Forces { loads: vec![0.0; touches.len()], across: vec![DVec3::ZERO; touches.len()] };
    for (column, size) in columns.iter().zip(sizes) {
        push(&touches[column.touch], inverse_mass, column, size, motions);
        forces.across[column.touch] += size * column.across;
        if column.is_load {
            forces.loads[column.touch] = size;
        }
    }
    forces
}

/// What each column's condition is about: entering along the normal, or the slip along a direction.
fn rows<'a>(
    touches: &'a [Touch],
    columns: &'a [Column],
    motions: &'a [DVec3],
) -> impl Iterator<Item = f64> + 'a {
    let half = motions.len() / 2;
    columns.iter().map(move |column| {
        let touch = &touches[column.touch];
        if column.is_load {
            touch.link.entering(&motions[..half])
        } else {
            touch.slip(motions).dot(column.across)
        }
    })
}

/// Gauss elimination with full pivoting, and of all answers the one with the least squares.
fn eliminate(matrix: &mut [Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let count = matrix.len();
    let mut order: Vec<usize> = (0..count).collect();
    let mut rank = 0;
    let mut largest = 0.0_f64;
    while rank < count {
        let mut best = (0.0, rank, rank);
        for (row, entries) in matrix.iter().enumerate().skip(rank) {
            for (column, entry) in entries[..count].iter().enumerate().skip(rank) {
                if entry.abs() > best.0 {
                    best = (entry.abs(), row, column);
                }
            }
        }
        largest = largest.max(best.0);
        if best.0 <= DEPENDENT * largest {
            break;
        }
        matrix.swap(rank, best.1);
        matrix.iter_mut().for_each(|row| row.swap(rank, best.2));
        order.swap(rank, best.2);
        let (done, rest) = matrix.split_at_mut(rank + 1);
        let pivot = &done[rank];
        for row in rest {
            let factor = row[rank] / pivot[rank];
            if factor != 0.0 {
                row.iter_mut().zip(pivot).skip(rank).for_each(|(entry, above)| *entry -= factor * above);
            }
        }
        rank += 1;
    }
    let mut found = back(matrix, rank, |row| matrix[row][count]);
    // What changes nothing: each unknown that depends on others, with these. An orthogonal basis of it.
    let weights: Vec<f64> = order.iter().map(|at| weights[*at]).collect();
    let mut idle: Vec<Vec<f64>> = Vec::new();
    for free in rank..count {
        let mut way = back(matrix, rank, |row| -matrix[row][free]);
        way[free] = 1.0;
        for other in &idle {
            take_out(&mut way, other, &weights);
        }
        let length = dot(&way, &way, &weights).sqrt();
        way.iter_mut().for_each(|part| *part /= length);
        idle.push(way);
    }
    idle.iter().for_each(|way| take_out(&mut found, way, &weights));
    let mut answer = vec![0.0; count];
    order.into_iter().zip(found).for_each(|(at, part)| answer[at] = part);
    answer
}

/// The unknowns that are not free, of a triangle with this right side.
fn back(triangle: &[Vec<f64>], rank: usize, right: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut found = vec![0.0; triangle.len()];
    for row in (0..rank).rev() {
        let known: f64 = (row + 1..rank).map(|column| triangle[row][column] * found[column]).sum();
        found[row] = (right(row) - known) / triangle[row][row];
    }
    found
}

/// Takes what a vector has along a unit vector out of it.
fn take_out(vector: &mut [f64], unit: &[f64], weights: &[f64]) {
    let along = dot(vector, unit, weights);
    vector.iter_mut().zip(unit).for_each(|(part, of)| *part -= along * of);
}

fn dot(one: &[f64], other: &[f64], weights: &[f64]) -> f64 {
    one.iter().zip(other).zip(weights).map(|((one, other), weight)| weight * one * other).sum()
}
