//! The contacts of a component in one step: found, and solved by sweeps or at once.

use super::contact::{contact, is_far, stays_apart};
use super::data::{Component, Dense, Work};
use super::direct::solve_at_once;
use super::start::law_of;
use super::stepped::{Contact, Moving, velocity};
use super::sweep::{Solution, closing, solve};
use super::tolerance::BUDGET;
use crate::sim::model::Model;
use crate::sim::state::State;

/// What bodies that meet in a step do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Landing {
    OrRebound,
    /// Nobody parts from another by its impulse. Velocities without any motion are allowed then, and the nearest allowed
    /// ones have no more energy than the free ones. Where several contacts of a body rebound, Newton's law may give
    /// energy: one between a wall and a heavy body throws that back as fast as it came itself.
    Only,
}

/// Finds what touches or may come to in a step of length h, and what is too far off for that.
pub(super) fn find_contacts(model: &Model, state: &State, dense: &Dense, component: &mut Component, h: f64) {
    let Component { near, work: Work { bodies, contacts, waiting, .. }, .. } = component;
    contacts.clear();
    waiting.clear();
    for (place, near) in (0..).zip(near.iter()) {
        let force = dense.pairs[near.listed as usize].force;
        if force == 0.0 && is_far(near, bodies, h) {
            waiting.push(place);
            continue;
        }
        match contact(model, state, near, force, bodies, h) {
            Some(contact) if contact.is_lazy => waiting.push(place),
            Some(contact) => contacts.push(contact),
            None => {}
        }
    }
}

/// Solves the contacts that were found, with those that wait as soon as they are seen to meet.
pub(super) fn solve_contacts(
    model: &Model,
    state: &State,
    dense: &Dense,
    component: &mut Component,
    h: f64,
    landing: Landing,
) {
    let Component { near, work, .. } = component;
    let Work { bodies, contacts, waiting, system, rubbing, solution, is_tough, .. } = work;
    let land = |contact: Contact| match landing {
        Landing::OrRebound => contact,
        Landing::Only => Contact { bound: contact.bound.min(0.0), ..contact },
    };
    contacts.iter_mut().for_each(|contact| *contact = land(*contact));
    let mut meet = |moving: &[Moving], contacts: &mut Vec<Contact>| {
        waiting.retain(|place| {
            let near = &near[*place as usize];
            if stays_apart(near, bodies, |body| velocity(&moving[body as usize]), h) {
                return true;
            }
            let contact = contact(model, state, near, 0.0, bodies, h);
            let met = contact.filter(|contact| contact.gap + h * closing(contact, moving) < 0.0);
            contacts.extend(met.map(land));
            met.is_none()
        });
    };
    let law = |contact: &Contact| law_of(model, dense, contact);
    if *is_tough
        && rubbing.is_empty()
        && let Some(found) = solve_at_once(system, contacts, bodies, h, &mut meet)
        && found.has_converged
    {
        *solution = found;
        return;
    }
    *solution = solve(system, contacts, bodies, h, (rubbing, &law), &mut meet);
    let is_deep = |contact: &Contact| -contact.gap > BUDGET * contact.radius;
    // The friction of a step is found by sweeps alone.
    if rubbing.is_empty()
        && (!solution.has_converged || contacts.iter().any(is_deep))
        && let Some(found) = solve_at_once(system, contacts, bodies, h, &mut meet)
    {
        *is_tough |= found.has_converged;
        *solution = Solution { sweeps: solution.sweeps, ..found };
    }
}
