//! Restitution from MuJoCo's damped contact: each geom's own, how two mix, and the Bounce values whose products they are.

use super::piece::Piece;
use crate::export::restitution_of_damping;

/// What a geom says about contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub solref: [f64; 2],
    pub priority: i64,
    pub solmix: f64,
}

/// A spring of 20 ms, critically damped.
pub(super) const USUAL_SOLREF: [f64; 2] = [0.02, 1.0];

/// Digits of a restitution that survive being written as damping.
const DIGITS: f64 = 1e9;

/// Positive numbers are a time and a damping ratio, negative ones stiffness and damping themselves.
pub(super) fn restitution(solref: [f64; 2]) -> f64 {
    let [first, second] = solref;
    let ratio = if first > 0.0 { second } else { -second / (2.0 * libm::sqrt(-first)) };
    let e = restitution_of_damping(ratio.max(0.0));
    if e.is_finite() { (e * DIGITS).round() / DIGITS } else { 0.0 }
}

fn mixed(one: &Contact, other: &Contact) -> [f64; 2] {
    if one.priority != other.priority {
        return if one.priority > other.priority { one.solref } else { other.solref };
    }
    let pairs = [0, 1].map(|at| (one.solref[at], other.solref[at]));
    if one.solref[0] > 0.0 && other.solref[0] > 0.0 {
        let sum = one.solmix + other.solmix;
        let share = if sum > 0.0 { one.solmix / sum } else { 0.5 };
        return pairs.map(|(a, b)| share * a + (1.0 - share) * b);
    }
    pairs.map(|(a, b)| a.min(b))
}

/// Gives each piece its Bounce: a moving one the root of what two like it have, one that stands still what is left of its
/// contact with the commonest moving ones.
pub(super) fn give_bounces(pieces: &mut [Piece], contacts: &[Contact]) {
    let mut common: Option<(f64, Contact, usize)> = None;
    let mut counts: Vec<(f64, Contact, usize)> = Vec::new();
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_some()) {
        piece.bounce = rounded(libm::sqrt(restitution(contact.solref)));
        let known = counts.iter_mut().find(|(bounce, ..)| *bounce == piece.bounce);
        match known {
            Some((.., count)) => *count += 1,
            None => counts.push((piece.bounce, *contact, 1)),
        }
    }
    for candidate in counts {
        if common.is_none_or(|(.., count)| candidate.2 > count) {
            common = Some(candidate);
        }
    }
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_none()) {
        piece.bounce = match &common {
            Some((bounce, moving, _)) if *bounce > 0.0 => {
                rounded(restitution(mixed(contact, moving)) / bounce)
            }
            _ => rounded(libm::sqrt(restitution(contact.solref))),
        };
    }
}

fn rounded(value: f64) -> f64 {
    (value * DIGITS).round() / DIGITS
}
