//! The contacts of a component in one step: found, and solved.

use super::contact::{contact, is_far, stays_apart};
use super::converge::solve;
use super::data::{Component, Dense, Work};
use super::start::law_of;
use super::stepped::{Contact, Moving, velocity};
use super::sweep::closing;
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
    let Work { bodies, contacts, waiting, system, rubbing, solution, given, .. } = work;
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
    *solution = solve(system, contacts, bodies, (h, *given), (rubbing, &law), &mut meet);
}
