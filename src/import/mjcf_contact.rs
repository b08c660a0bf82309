//! Restitution from MuJoCo's damped contact, and friction: each geom's own, how two mix, and the Bounce and Friction values
//! whose products and means they are.

use super::piece::Piece;
use crate::export::{restitution_of_damping, rolling_of_lever};

/// What a geom says about contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub solref: [f64; 2],
    /// Coefficient of sliding; `None` where it gives none to a contact.
    pub friction: Option<f64>,
    /// Of rolling friction, m.
    pub lever: f64,
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

/// What a body here says about contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    bounce: f64,
    friction: f64,
    rolling: f64,
    /// Of what may roll, m.
    radius: Option<f64>,
}

impl Surface {
    pub fn of(piece: &Piece) -> Self {
        let Piece { bounce, friction, rolling, .. } = *piece;
        Self { bounce, friction, rolling, radius: piece.rolling_radius() }
    }

    /// Whether this body and another have this restitution, this coefficient of sliding and this lever of rolling friction.
    pub fn meets(&self, other: &Self, restitution: f64, friction: f64, lever: f64) -> bool {
        let radius = [self.radius, other.radius].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let rolling = if radius.is_finite() { rolling_of_lever(lever, radius) } else { 0.0 };
        let is_near = |found: f64, said: f64| (found - said).abs() <= 1e-6 * said.max(1.0);
        is_near(self.bounce * other.bounce, restitution)
            && is_near(mean(self.friction, other.friction), friction)
            && is_near(mean(self.rolling, other.rolling), rolling)
    }
}

/// What two bodies have here.
fn mean(one: f64, other: f64) -> f64 {
    libm::sqrt(one * other)
}

/// Of two geoms: that of higher priority decides, else springs are averaged and the larger frictions count.
fn mixed(one: &Contact, other: &Contact) -> ([f64; 2], f64, f64) {
    let own = |contact: &Contact| (contact.solref, contact.friction.unwrap_or(0.0), contact.lever);
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
    (solref, own(one).1.max(own(other).1), one.lever.max(other.lever))
}

/// Bodies that move and are alike.
struct Alike {
    surface: Surface,
    contact: Contact,
    count: usize,
}

impl Alike {
    fn is_of(&self, surface: &Surface) -> bool {
        let numbers = |surface: &Surface| (surface.bounce, surface.friction, surface.rolling);
        let same_size = surface.rolling == 0.0 || self.surface.radius == surface.radius;
        numbers(&self.surface) == numbers(surface) && same_size
    }

    /// The more common one; of equally common ones that of larger numbers, as the export has it.
    fn in_order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |alike: &Self| {
            let Surface { bounce, friction, rolling, radius } = alike.surface;
            [bounce, friction, rolling, radius.filter(|_| rolling > 0.0).unwrap_or(f64::INFINITY)]
        };
        let pairs = numbers(self).into_iter().zip(numbers(other));
        let unequal = pairs.map(|(one, other)| one.total_cmp(&other)).find(|order| order.is_ne());
        self.count.cmp(&other.count).then(unequal.unwrap_or(std::cmp::Ordering::Equal))
    }
}

/// Gives each piece its Bounce and frictions: a moving one what two like it have, one that stands still what is left of its
/// contact with the commonest moving ones.
pub(super) fn give_surfaces(pieces: &mut [Piece], contacts: &[Contact]) {
    let mut kinds: Vec<Alike> = Vec::new();
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_some()) {
        alone(piece, contact);
        let surface = Surface::of(piece);
        match kinds.iter_mut().find(|known| known.is_of(&surface)) {
            Some(known) => known.count += 1,
            None => kinds.push(Alike { surface, contact: *contact, count: 1 }),
        }
    }
    let common = kinds.iter().max_by(|one, other| one.in_order(other));
    for (piece, contact) in pieces.iter_mut().zip(contacts).filter(|(piece, _)| piece.motion.is_none()) {
        alone(piece, contact);
        if let Some(common) = common {
            beside(piece, contact, common);
        }
    }
}

/// What is left for a piece of its contact with others, whose Bounce is a factor and whose frictions are in a mean.
fn beside(piece: &mut Piece, contact: &Contact, common: &Alike) {
    let (solref, friction, lever) = mixed(contact, &common.contact);
    let Surface { bounce, rolling, radius, .. } = common.surface;
    if bounce > 0.0 {
        piece.bounce = rounded(restitution(solref) / bounce);
    }
    // √(μ μ₂) is to be what the contact has.
    let left = |both: f64, other: f64| rounded(both / other * both);
    if let Some(of_moving) = common.contact.friction.filter(|friction| *friction > 0.0) {
        let left = left(friction, of_moving);
        piece.friction = if left.is_finite() { left } else { friction };
    }
    let left = left(radius.map_or(0.0, |radius| rolling_of_lever(lever, radius)), rolling);
    piece.rolling = if left.is_finite() { left } else { 0.0 };
}

/// What two like it have.
fn alone(piece: &mut Piece, contact: &Contact) {
    piece.bounce = rounded(libm::sqrt(restitution(contact.solref)));
    piece.friction = contact.friction.unwrap_or(0.0);
    piece.rolling =
        piece.rolling_radius().map_or(0.0, |radius| rounded(rolling_of_lever(contact.lever, radius)));
}

fn rounded(value: f64) -> f64 {
    (value * DIGITS).round() / DIGITS
}
