//! The contacts of a component solved at once, where sweeps do not get there: a light body under or between heavy ones
//! takes some M/m of them.

use glam::DVec3;

use super::rub::Rubbing;
use super::stepped::{Contact, Moving, Stepped, velocity};
use super::sweep::{Solution, System, free, gains_grossly};
use super::tolerance::{MOST_SEARCHED, MOST_SOLVED_AT_ONCE};
use crate::sim::constraint::{enter_none, enter_none_by_loads};
use crate::sim::link::Link;
use crate::sim::loads::Loads;

/// Solves the contacts of a component in a step of length h, as [`super::sweep::solve`] does, and starts from the impulses
/// that they have; `None` where there are too many.
pub(super) fn solve_at_once(
    system: &mut System,
    contacts: &mut Vec<Contact>,
    bodies: &[Stepped],
    h: f64,
    mut meet: impl FnMut(&[Moving], &mut Vec<Contact>),
) -> Option<Solution> {
    if contacts.len() > MOST_SOLVED_AT_ONCE {
        return None;
    }
    let inverse_mass: Vec<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
    let undisturbed: Vec<Moving> = bodies.iter().map(|body| free(body, h)).collect();
    loop {
        let mut motion: Vec<DVec3> = undisturbed.iter().map(velocity).collect();
        let impulses = impulses(contacts, &inverse_mass, &mut motion)?;
        for (contact, impulse) in contacts.iter_mut().zip(&impulses) {
            contact.impulse = *impulse;
        }
        system.adopt(impulses, &motion, &inverse_mass);
        let before = contacts.len();
        meet(&system.moving, contacts);
        if contacts.len() > before {
            continue;
        }
        let (_, sinks) = system.judge(contacts, h, &Rubbing::default());
        let loss = loss(bodies, &undisturbed, &motion);
        let gains = gains_grossly(loss, bodies);
        return Some(Solution { loss, sweeps: 0, has_converged: !sinks && !gains, gains });
    }
}

/// The impulses that turn the undisturbed motion into an allowed one: by loads from those that the contacts have, or else,
/// where there are few, by search.
fn impulses(contacts: &[Contact], inverse_mass: &[f64], motion: &mut [DVec3]) -> Option<Vec<f64>> {
    let links: Vec<Link> = contacts.iter().map(|contact| link(contact, motion.len())).collect();
    let known: Vec<f64> = contacts.iter().map(|contact| contact.impulse).collect();
    let found = enter_none_by_loads(Loads::from(&known), &links, inverse_mass, motion);
    found.or_else(|| {
        (links.len() <= MOST_SEARCHED).then(|| enter_none(&links, inverse_mass, motion).multipliers)
    })
}

/// A contact as a bound on velocities.
fn link(contact: &Contact, bodies: usize) -> Link {
    let b = contact.b as usize;
    Link {
        a: contact.a as usize,
        b: (b < bodies).then_some(b),
        towards: contact.normal,
        limit: -contact.bound,
    }
}

/// Energy that the contacts take, −Σ ½ m Δ·(2v + Δ), J, of the changes Δ that they make to the velocities v: their impulses
/// say the same, but where normals all but coincide those are large differences.
fn loss(bodies: &[Stepped], undisturbed: &[Moving], motion: &[DVec3]) -> f64 {
    let taken = |((body, free), moved): ((&Stepped, &Moving), &DVec3)| {
        let change = *moved - velocity(free);
        if body.inverse_mass > 0.0 {
            -0.5 * change.dot(2.0 * body.v + change) / body.inverse_mass
        } else {
            0.0
        }
    };
    bodies.iter().zip(undisturbed).zip(motion).map(taken).sum()
}
