//! The contacts of a component in one step: found, and solved.

use super::contact::Finder;
use super::converge::{Problem, solve};
use super::data::{Component, Dense, Work};
use super::start::law_of;
use super::stepped::{Contact, Moving, Step};
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
pub(super) fn find_contacts(model: &Model, state: &State, component: &mut Component, h: f64) {
    let Component { near, work: Work { bodies, contacts, waiting, .. }, .. } = component;
    let finder = Finder { model, state, bodies, step: step_of(model, h) };
    contacts.clear();
    waiting.clear();
    for (place, near) in (0..).zip(near.iter()) {
        if near.force == 0.0 && finder.is_far(near) {
            waiting.push(place);
            continue;
        }
        if !finder.can_move(near) {
            continue;
        }
        let contact = finder.unbound(place, near);
        if finder.is_lazy(&contact) {
            waiting.push(place);
        } else {
            contacts.push(contact);
        }
    }
    for contact in contacts {
        finder.bind(contact, near[contact.near as usize].pair);
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
    let finder = Finder { model, state, bodies, step: step_of(model, h) };
    let mut meet = |moving: &[Moving], contacts: &mut Vec<Contact>| {
        waiting.retain(|place| {
            let near = &near[*place as usize];
            if finder.stays_apart(near, moving) {
                return true;
            }
            let contact = finder.contact(*place, near);
            let is_met = contact.gap + h * closing(&contact, moving) < 0.0;
            contacts.extend(is_met.then(|| land(contact)));
            !is_met
        });
    };
    let law = |contact: &Contact| law_of(model, dense, contact);
    let problem = Problem { bodies, step: finder.step, given: *given, law: &law };
    *solution = solve(&problem, system, contacts, rubbing, &mut meet);
}

fn step_of(model: &Model, h: f64) -> Step {
    Step { h, radius: model.bodies.range_of_radii().0 }
}
