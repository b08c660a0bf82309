//! The books: what energy and momentum ought to be, so that drift can be told from loss.

use glam::DVec3;

use super::account::{Account, AngularAccount, Sum, VectorSum, angular};
use super::force::{ForceEntry, Law, Subject};
use super::model::Model;
use super::motion::integrate;
use super::place::Place;
use super::report::{AngularMomentum, BodyState, Energy, Momentum};
use super::rub::inertia;
use super::state::State;
use super::turn::{Hold, Rubbing};

/// Kinetic and potential energy now, J.
pub(super) fn energies(model: &Model, state: &State, time: f64) -> (f64, Option<f64>) {
    let mut kinetic = Sum::default();
    let mut potential = Some(Sum::default());
    for body in model.present() {
        kinetic.add(0.5 * model.mass(body) * state.velocity(body, time).length_squared());
        if model.plan.spin {
            kinetic.add(kinetic_of_spin(model, state, body, time));
        }
        for force in &model.forces {
            match (&mut potential, force.law.potential(&subject(model, state, body, time))) {
                (Some(sum), Some(value)) => sum.add(value),
                _ => potential = None,
            }
        }
    }
    (kinetic.value(), potential.map(|sum| sum.value()))
}

/// Kinetic energy of a body in a state, J.
pub(super) fn kinetic_in(model: &Model, body: u32, state: &BodyState) -> f64 {
    let of_centre = 0.5 * model.mass(body) * state.velocity.length_squared();
    let of_spin = state.turn.map(|turn| 0.5 * inertia(model, body) * turn.spin.length_squared());
    of_spin.map_or(of_centre, |of_spin| of_centre + of_spin)
}

fn kinetic_of_spin(model: &Model, state: &State, body: u32, time: f64) -> f64 {
    0.5 * inertia(model, body) * state.spin(body, time).length_squared()
}

pub(super) fn momentum_value(model: &Model, state: &State, time: f64) -> (DVec3, f64) {
    let mut sum = VectorSum::default();
    let mut scale = Sum::default();
    for body in model.present() {
        let momentum = model.mass(body) * state.velocity(body, time);
        sum.add(momentum);
        scale.add(momentum.length());
    }
    (sum.value(), scale.value())
}

/// Angular momentum about the origin of the map, and Σ m|x||v| + I|ω|; nothing where nothing rubs.
pub(super) fn angular_value(model: &Model, state: &State, time: f64) -> (DVec3, f64) {
    let mut sum = VectorSum::default();
    let mut scale = Sum::default();
    if !model.plan.spin {
        return (DVec3::ZERO, 0.0);
    }
    for body in model.present() {
        let (orbit, spin) = angular_of(model, state, body, time);
        sum.add(orbit);
        sum.add(spin);
        let way = model.mass(body) * state.velocity(body, time).length();
        scale.add(state.position(body, time).length() * way + spin.length());
    }
    (sum.value(), scale.value())
}

/// m x×v and I ω of a body.
fn angular_of(model: &Model, state: &State, body: u32, time: f64) -> (DVec3, DVec3) {
    let orbit = angular(state.position(body, time), model.mass(body) * state.velocity(body, time));
    (orbit, inertia(model, body) * state.spin(body, time))
}

/// Opens the books at the present state.
pub(super) fn open(model: &Model, state: &mut State) {
    let (kinetic, potential) = energies(model, state, state.now);
    let (momentum, scale) = momentum_value(model, state, state.now);
    let (at_start, angular_scale) = angular_value(model, state, state.now);
    state.account = Account {
        energy_at_start: kinetic + potential.unwrap_or(0.0),
        kinetic_at_start: kinetic,
        momentum_at_start: momentum,
        momentum_scale: scale,
        angular: AngularAccount { at_start, scale: angular_scale, ..AngularAccount::default() },
        ..Account::default()
    };
}

/// Books the work and impulse of a body's segment up to `time`, before it is replaced.
pub(super) fn book_segment(model: &Model, state: &mut State, body: u32, time: f64) {
    let dissipated = dissipated(model, state, body, time);
    let impulse = force_impulse(model, state, body, time);
    state.account.unknown_work |= has_unknown_work(model, state, body, time);
    state.account.dissipated.add(dissipated);
    state.account.force_impulse.add(impulse);
    if model.plan.spin {
        let torque = torque_impulse(model, state, body, time);
        state.account.angular.torque_impulse.add(torque);
    }
}

fn has_unknown_work(model: &Model, state: &State, body: u32, time: f64) -> bool {
    let custom = |force: &ForceEntry| matches!(force.law, Law::Custom(_));
    model.forces.iter().any(custom)
        && time > state.segments[body as usize].start
        && potential(model, &subject(model, state, body, time)).is_none()
}

/// Potential energy of a body if it were at x, J; `None` when a force has no potential.
pub(super) fn potential_of(model: &Model, body: u32, time: f64, x: DVec3) -> Option<f64> {
    potential(model, &model.subject(body, time, Place::exact(x), DVec3::ZERO))
}

/// Sum over the forces, J; `None` when one has no potential.
fn potential(model: &Model, subject: &Subject<'_>) -> Option<f64> {
    model.forces.iter().map(|force| force.law.potential(subject)).sum()
}

pub(super) fn energy(model: &Model, state: &State) -> Energy {
    let (kinetic, potential) = energies(model, state, state.now);
    let total = potential.map(|potential| kinetic + potential);
    let account = &state.account;
    let residual = total.filter(|_| !account.unknown_work).map(|total| {
        let mut sum = Sum::default();
        sum.add(total);
        sum.add(-account.energy_at_start);
        sum.add(account.impact_losses.value());
        sum.add(account.dissipated.value());
        for body in model.present() {
            sum.add(dissipated(model, state, body, state.now));
        }
        sum.add(-account.edit_work.value());
        let turned_over = [&account.impact_losses, &account.dissipated, &account.edit_work];
        let turned_over = turned_over.into_iter().map(|sum| sum.value().abs()).fold(0.0, f64::max);
        let scale = account.energy_at_start.abs().max(account.kinetic_at_start).max(kinetic).max(turned_over);
        relative(sum.value(), scale)
    });
    Energy { kinetic, potential, total, residual }
}

pub(super) fn momentum(model: &Model, state: &State) -> Momentum {
    let (value, scale) = momentum_value(model, state, state.now);
    let account = &state.account;
    let mut sum = VectorSum::default();
    sum.add(value);
    sum.add(-account.momentum_at_start);
    sum.add(-account.impulses.value());
    sum.add(-account.force_impulse.value());
    for body in model.present() {
        sum.add(-force_impulse(model, state, body, state.now));
    }
    let turned_over = account.impulses.value().length().max(account.force_impulse.value().length());
    let scale = scale.max(account.momentum_scale).max(turned_over);
    Momentum { value, residual: relative(sum.value().length(), scale) }
}

pub(super) fn angular_momentum(model: &Model, state: &State) -> AngularMomentum {
    let (value, scale) = angular_value(model, state, state.now);
    let account = &state.account.angular;
    let mut sum = VectorSum::default();
    sum.add(value);
    sum.add(-account.at_start);
    sum.add(-account.impulses.value());
    sum.add(-account.torque_impulse.value());
    for body in model.present() {
        sum.add(-torque_impulse(model, state, body, state.now));
    }
    let turned_over = account.impulses.value().length().max(account.torque_impulse.value().length());
    let scale = scale.max(account.scale).max(turned_over);
    AngularMomentum { value, residual: relative(sum.value().length(), scale) }
}

/// Zero over zero is no drift.
fn relative(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale.max(f64::MIN_POSITIVE) }
}

pub(super) fn subject<'a>(model: &'a Model, state: &State, body: u32, time: f64) -> Subject<'a> {
    model.subject(body, time, state.path(body).place(time), state.velocity(body, time))
}

/// −∫ F·v dt of the drag forces along the body's segment up to `time`, and what friction took, J. In the step of a group
/// drag is what its constant acceleration is beyond that of the other forces: by the law along the way it would be off by an
/// error of that step.
fn dissipated(model: &Model, state: &State, body: u32, time: f64) -> f64 {
    let rubbed = if model.plan.spin { rubbed(state, body, time) } else { 0.0 };
    if !model.forces.iter().any(|force| force.law.dissipates()) {
        return rubbed;
    }
    let segment = &state.segments[body as usize];
    // Where bodies rub their acceleration is not of applied forces alone; in the step of a group contacts act at its ends.
    let is_held = model.plan.spin && state.turns[body as usize].hold != Hold::Free;
    if segment.constrained && segment.step == 0.0 && !is_held {
        let tau = time - segment.start;
        let way = tau * (segment.v + (0.5 * tau) * segment.a);
        return rubbed
            - model.mass(body)
                * (segment.a - undamped(model, body, segment.start, (segment.x, segment.v))).dot(way);
    }
    rubbed + by_law(model, state, body, time)
}

/// −∫ F·v dt of the drag forces by their law, J.
fn by_law(model: &Model, state: &State, body: u32, time: f64) -> f64 {
    integrate(state.segments[body as usize].start, time, 0.0, |at| {
        let subject = subject(model, state, body, at);
        let drags = model.forces.iter().filter(|force| force.law.dissipates());
        -drags.map(|force| force.law.force(&subject).dot(subject.velocity)).sum::<f64>()
    })
}

/// What friction took along the body's segment, J: ∫ μN|s| + M|v| dt on a face, or what was integrated with the motion.
fn rubbed(state: &State, body: u32, time: f64) -> f64 {
    let turn = &state.turns[body as usize];
    let Rubbing { slide, roll, arm } = turn.rubbing;
    if slide == 0.0 && roll == 0.0 {
        return turn.work_until(time);
    }
    let path = state.path(body);
    turn.work_until(time)
        + integrate(turn.start, time, 0.0, |at| {
            let v = path.velocity(at);
            let slip = v - turn.spin_at(at).cross(arm);
            slide * slip.length() + roll * v.length()
        })
}

/// ∫ x×F dt of the forces on a body along its segment up to `time`, in contact what the motion makes of it.
fn torque_impulse(model: &Model, state: &State, body: u32, time: f64) -> DVec3 {
    let segment = &state.segments[body as usize];
    if segment.constrained {
        let turn = &state.turns[body as usize];
        let inertia = inertia(model, body);
        let before = angular(segment.x, model.mass(body) * segment.v) + inertia * turn.spin;
        let path = state.path(body);
        let now = angular(path.position(time), model.mass(body) * path.velocity(time));
        return now + inertia * turn.spin_at(time) - before;
    }
    let path = state.path(body);
    if segment.step == 0.0 && model.is_ballistic() {
        let tau = time - segment.start;
        let middle = segment.x + 0.5 * tau * segment.v;
        return angular(middle, model.mass(body) * tau * segment.a);
    }
    integrate(segment.start, time, DVec3::ZERO, |at| {
        angular(path.position(at), model.applied_force(&subject(model, state, body, at)))
    })
}

/// Acceleration by the forces that do not dissipate, m/s².
pub(super) fn undamped(model: &Model, body: u32, time: f64, (x, v): (DVec3, DVec3)) -> DVec3 {
    let subject = model.subject(body, time, Place::exact(x), v);
    let lasting = model.forces.iter().filter(|force| !force.law.dissipates());
    lasting.map(|force| force.law.force(&subject)).sum::<DVec3>() / subject.mass
}

/// Books what changes a body's velocity, now v, between two steps of a group, as the forces at the end of a step
/// are others than at its start. What drag has of it is lost.
pub(super) fn book_kick(model: &Model, state: &mut State, body: u32, time: f64, kick: DVec3, v: DVec3) {
    let mass = model.mass(body);
    state.account.force_impulse.add(mass * kick);
    if model.forces.iter().any(|force| force.law.dissipates()) {
        let segment = &state.segments[body as usize];
        let rise = undamped(model, body, time, (state.position(body, time), v))
            - undamped(model, body, segment.start, (segment.x, segment.v));
        let of_drag = kick - (0.5 * (time - segment.start)) * rise;
        state.account.dissipated.add(-mass * of_drag.dot(v + 0.5 * kick));
    }
    if model.plan.spin {
        let torque = angular(state.position(body, time), mass * kick);
        state.account.angular.torque_impulse.add(torque);
    }
}

/// ∫ F dt of all forces on the body along its segment up to `time`, N·s. In free flight through a field the
/// force law itself is integrated over the path, which checks the method; in contact, where the
/// force of the surface is what the motion makes it, the change of momentum is taken.
fn force_impulse(model: &Model, state: &State, body: u32, time: f64) -> DVec3 {
    let segment = &state.segments[body as usize];
    let mass = model.mass(body);
    // A parabola in a field is what a stepping method makes of it, not what the field does.
    if segment.step == 0.0 && (model.is_ballistic() || time == segment.start) {
        return mass * (time - segment.start) * segment.a;
    }
    if segment.constrained {
        return mass * (state.velocity(body, time) - segment.v);
    }
    integrate(segment.start, time, DVec3::ZERO, |at| model.applied_force(&subject(model, state, body, at)))
}
