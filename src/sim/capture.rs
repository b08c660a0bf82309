//! Bodies that a point attractor has captured: they stay where they are, at its core, until something frees them.
//!
//! A body is bound within a distance R if its apoapsis is nearer, r_a = a(1 + e) ≤ R, with a = −G/2E,
//! E = ½v² − G/r and e² = 1 + 2E|r×v|²/G². Captured, it takes part in impacts and contacts as a static body would.

use glam::DVec3;

use super::account::angular;
use super::body::BodyId;
use super::event::{Event, EventKind};
use super::force::{Law, Subject};
use super::ledger::record;
use super::model::Model;
use super::place::Place;
use super::rub::inertia;
use super::state::State;
use super::tolerance::{BOUND_ALONE, BOUND_DISTURBED, BOUND_OF_RADIUS, PASSED, SWALLOWED};

/// A point attractor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attractor {
    pub center: DVec3,
    /// m³/s², above 0.
    pub intensity: f64,
}

impl Attractor {
    /// Apoapsis of an orbit under it alone, m; infinite for one that is not closed.
    fn apoapsis(&self, x: DVec3, v: DVec3) -> f64 {
        let r = x - self.center;
        let energy = 0.5 * v.length_squared() - self.intensity / r.length();
        if energy >= 0.0 {
            return f64::INFINITY;
        }
        let axis = self.intensity / (-2.0 * energy);
        let round = r.cross(v).length_squared() / (self.intensity * axis);
        axis * (1.0 + (1.0 - round).max(0.0).sqrt())
    }

    /// Whether its pull on a body exceeds all other applied forces but drag even at this distance, m.
    fn rules(&self, subject: &Subject<'_>, model: &Model, distance: f64) -> bool {
        // In the sum of all, beside its own pull, the others would be rounding.
        let others = model.forces.iter().filter(|force| !self.is(&force.law) && !force.law.dissipates());
        let load: DVec3 = others.map(|force| force.law.force(subject)).sum();
        load.length() * distance * distance < self.intensity * subject.mass
    }

    fn is(&self, law: &Law) -> bool {
        matches!(*law, Law::Point { center, intensity } if center == self.center && intensity == self.intensity)
    }

    /// Whether a body at the core can't leave it by itself.
    pub fn captures(&self, model: &Model, state: &State, body: u32, time: f64) -> bool {
        let (x, v) = (state.position(body, time), state.velocity(body, time));
        let disturbed = is_disturbed(model, state, body);
        let reach = if disturbed { reach(model, body) } else { BOUND_ALONE * model.params.core_radius };
        let apoapsis = self.apoapsis(x, v);
        apoapsis <= reach && self.rules(&model.subject(body, time, Place::exact(x), v), model, apoapsis)
    }
}

/// How far from an attractor a body may be at most that it has captured, m.
fn reach(model: &Model, body: u32) -> f64 {
    (BOUND_DISTURBED * model.params.core_radius).max(BOUND_OF_RADIUS * model.radius(body))
}

/// Whether a body that circles an attractor exchanges energy with something else: with air, what it lies against, or
/// what it has hit.
fn is_disturbed(model: &Model, state: &State, body: u32) -> bool {
    let reversible = |law: &Law| matches!(law, Law::Point { .. }) || law.is_uniform();
    state.segments[body as usize].constrained
        || state.cascades[body as usize].reference > 0.0
        || state.cascades[body as usize].is_struck
        || !model.forces.iter().all(|force| reversible(&force.law))
}

/// The attractor that a body at x may be captured by.
fn attractor_at(model: &Model, body: u32, x: DVec3) -> Option<Attractor> {
    let reach = (PASSED * model.params.core_radius).max(reach(model, body));
    model.forces.iter().find_map(|force| match force.law {
        Law::Point { center, intensity } if intensity > 0.0 && (x - center).length() <= reach => {
            Some(Attractor { center, intensity })
        }
        _ => None,
    })
}

/// Whether a body that something disturbs is bound to an attractor that near that it is captured, wherever it is on its
/// orbit.
pub(super) fn is_caught(model: &Model, state: &State, body: u32, time: f64) -> bool {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let is_bound = |attractor: Attractor| {
        let apoapsis = attractor.apoapsis(x, v);
        apoapsis <= BOUND_OF_RADIUS * model.radius(body)
            && attractor.rules(&model.subject(body, time, Place::exact(x), v), model, apoapsis)
    };
    !model.is_ballistic()
        && is_disturbed(model, state, body)
        && attractor_at(model, body, x).is_some_and(is_bound)
}

/// The same for a stepped body, which is captured also where steps can't follow it.
pub(super) fn is_swallowed(model: &Model, body: u32, (x, v): (DVec3, DVec3)) -> bool {
    let caught = |attractor: Attractor| {
        (x - attractor.center).length() <= SWALLOWED * model.radius(body)
            || attractor.apoapsis(x, v) <= reach(model, body)
    };
    attractor_at(model, body, x).is_some_and(caught)
}

/// Books and reports that a body stays where it is from now on.
pub(super) fn hold(model: &Model, state: &mut State, body: u32, time: f64) {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    state.account.impact_losses.add(energy_above(model, state, body, time, x));
    state.account.impulses.add(-model.mass(body) * v);
    if model.plan.spin {
        let (inertia, spin) = (inertia(model, body), state.spin(body, time));
        state.account.impact_losses.add(0.5 * inertia * spin.length_squared());
        state.account.angular.impulses.add(angular(x, -model.mass(body) * v) - inertia * spin);
        state.give_spin(body, DVec3::ZERO);
    }
    record(state, Event::of_one(time, EventKind::Captured, BodyId::of_dynamic(body).to_ref(), x));
    state.plunges.remove(&body);
    state.captured.insert(body);
}

/// Frees the bodies at whose place no attractor is any more: after an edit.
pub(super) fn free_unheld(model: &Model, state: &mut State) {
    let segments = &state.segments;
    state.captured.retain(|body| {
        model.dynamic(*body).present && attractor_at(model, *body, segments[*body as usize].x).is_some()
    });
}

/// Frees a captured body if the speed that an impact would give it carries it beyond what is captured; whether it does.
pub(super) fn free_if_struck(model: &Model, state: &mut State, body: u32, velocity: DVec3) -> bool {
    if !state.captured.contains(&body) {
        return false;
    }
    let x = state.segments[body as usize].x;
    let reach = reach(model, body);
    let stays = |attractor: Attractor| attractor.apoapsis(x, velocity) <= reach;
    !attractor_at(model, body, x).is_some_and(stays) && state.captured.remove(&body)
}

/// What kinetic and potential energy a body has more than if it stood at x, J.
pub(super) fn energy_above(model: &Model, state: &State, body: u32, time: f64, x: DVec3) -> f64 {
    let moving = model.subject(body, time, state.path(body).place(time), state.velocity(body, time));
    let standing = model.subject(body, time, Place::exact(x), DVec3::ZERO);
    let fall = |law: &Law| Some(law.potential(&moving)? - law.potential(&standing)?);
    let potential: f64 = model.forces.iter().filter_map(|force| fall(&force.law)).sum();
    0.5 * moving.mass * moving.velocity.length_squared() + potential
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn apoapses_of_lines_circles_and_ellipses() {
        let attractor = Attractor { center: DVec3::splat(5.0), intensity: 8.0 };
        let off = |expected: f64, found: f64| (found / expected - 1.0).abs();
        let x = attractor.center + DVec3::X * 0.5;
        let speed = |apoapsis: f64| (2.0 * 8.0 * (1.0 / 0.5 - 1.0 / apoapsis)).sqrt();
        assert!(off(3.0, attractor.apoapsis(x, DVec3::X * speed(3.0))) <= 1e-14);
        assert!(off(0.5, attractor.apoapsis(x, DVec3::Y * 4.0)) <= 1e-7, "a circle");
        // Periapsis 0.5, apoapsis 2: v² = G(2/r − 1/a).
        assert!(off(2.0, attractor.apoapsis(x, DVec3::Y * (8.0_f64 * (4.0 - 0.8)).sqrt())) <= 1e-14);
        assert_eq!(attractor.apoapsis(x, DVec3::Y * 6.0), f64::INFINITY);
    }
}
