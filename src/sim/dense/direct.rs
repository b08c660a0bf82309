//! The contacts of a small component solved at once, where sweeps do not get there: a light body under or between heavy
//! ones takes some M/m of them.

use glam::DVec3;

use super::rub::Rubbing;
use super::stepped::{Contact, Moving, Stepped, velocity};
use super::sweep::{Solution, System, free, gains_grossly};
use super::tolerance::MOST_SOLVED_AT_ONCE;
use crate::sim::constraint::enter_none;
use crate::sim::link::Link;

/// Solves the contacts of a component in a step of length h, as [`super::sweep::solve`] does; `None` where there are too
/// many.
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
        let links: Vec<Link> = contacts.iter().map(|contact| link(contact, bodies.len())).collect();
        let mut motion: Vec<DVec3> = undisturbed.iter().map(velocity).collect();
        let impulses = enter_none(&links, &inverse_mass, &mut motion).multipliers;
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
