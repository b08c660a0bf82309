//! Restitution from MuJoCo's damped contact, and friction: each geom's own, how two mix, and the Bounce and Friction values
//! whose products and means they are.

use super::piece::Piece;
use crate::export::restitution_of_damping;

/// What a geom says about contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub solref: [f64; 2],
    /// Coefficient of sliding; `None` where it gives none to a contact.
    pub friction: Option<f64>,
    pub priority: i64,
    pub solmix: f64,
}

/// A spring of 20 ms, critically damped.
pub(super) const USUAL_SOLREF: [f64; 2] = [0.02, 1.0];

/// Coefficient of sliding.
pub(super) const USUAL_FRICTION: f64 = 1.0;

/// Digits of a restitution that survive being written as damping.
const DIGITS: f64 = 1e9;

/// Positive numbers are a time and a damping ratio, negative ones stiffness and damping themselves.
pub(super) fn restitution(solref: [f64; 2]) -> f64 {
    let [first, second] = solref;
    let ratio = if first > 0.0 { second } else { -second / (2.0 * libm::sqrt(-first)) };
    let e = restitution_of_damping(ratio.max(0.0));
    if e.is_finite() { (e * DIGITS).round() / DIGITS } else { 0.0 }
}

/// What two bodies have here.
pub(super) fn sliding(one: f64, other: f64) -> f64 {
    libm::sqrt(one * other)
}

/// Of two geoms: that of higher priority decides, else springs are averaged and the larger friction counts.
fn mixed(one: &Contact, other: &Contact) -> ([f64; 2], f64) {
    let own = |contact: &Contact| (contact.solref, contact.friction.unwrap_or(0.0));
    if one.priority != other.priority {
        return own(if one.priority > other.priority { one } else { other });
    }
    let pairs = [0, 1].map(|at| (one.solref[at], other.solref[at]));
    let solref = if one.solref[0] > 0.0 && other.solref[0] > 0.0 {
        let sum = one.solmix + other.solmix;
        let share = if sum > 0.0 { one.solmix / sum } else { 0.5 };
        pairs.map(|(a, b)| share * a + (1.0 - share) * b)
    } else {
        pairs.map(|(a, b)| a.min(b))
    };
    (solref, own(one).1.max(own(other).1))
}

/// Gives each piece its Bounce and Friction: a moving one what two like it have, one that stands still what is left of its
/// contact with the commonest moving ones.
pub(super) fn give_surfaces(pieces: &mut [Piece], contacts: &[Contact]) {
    let mut counts: Vec<(f64, Contact, usize)> = Vec::new();
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_some()) {
        alone(piece, contact);
        let same = |known: &&mut (f64, Contact, usize)| {
            known.0 == piece.bounce && known.1.friction == contact.friction
        };
        match counts.iter_mut().find(same) {
            Some((.., count)) => *count += 1,
            None => counts.push((piece.bounce, *contact, 1)),
        }
    }
    // Of those that are equally common the one whose numbers are larger, as the export has it.
    let common = counts.iter().max_by(|one, other| {
        let friction = |contact: &Contact| contact.friction.unwrap_or(0.0);
        let larger = one.0.total_cmp(&other.0).then(friction(&one.1).total_cmp(&friction(&other.1)));
        one.2.cmp(&other.2).then(larger)
    });
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_none()) {
        alone(piece, contact);
        let Some((bounce, moving, _)) = common else { continue };
        let (solref, friction) = mixed(contact, moving);
        if *bounce > 0.0 {
            piece.bounce = rounded(restitution(solref) / bounce);
        }
        if let Some(of_moving) = moving.friction.filter(|friction| *friction > 0.0) {
            // √(μ μ₂) is to be what the contact has.
            let left = rounded(friction / of_moving * friction);
            piece.friction = if left.is_finite() { left } else { friction };
        }
    }
}

/// What two like it have.
fn alone(piece: &mut Piece, contact: &Contact) {
    piece.bounce = rounded(libm::sqrt(restitution(contact.solref)));
    piece.friction = contact.friction.unwrap_or(0.0);
}

fn rounded(value: f64) -> f64 {
    (value * DIGITS).round() / DIGITS
}
