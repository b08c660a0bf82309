//! The books: what energy and momentum ought to be, so that drift can be told from loss.

use glam::DVec3;

use super::account::{Account, Sum, VectorSum};
use super::force::{ForceEntry, Law, Subject};
use super::model::Model;
use super::motion::integrate;
use super::place::Place;
use super::report::{Energy, Momentum};
use super::state::State;

/// Kinetic and potential energy now, J.
pub(super) fn energies(model: &Model, state: &State, time: f64) -> (f64, Option<f64>) {
    let mut kinetic = Sum::default();
    let mut potential = Some(Sum::default());
    for body in model.present() {
        let mass = model.mass(body);
        kinetic.add(0.5 * mass * state.velocity(body, time).length_squared());
        for force in &model.forces {
            match (&mut potential, force.law.potential(&subject(model, state, body, time))) {
                (Some(sum), Some(value)) => sum.add(value),
                _ => potential = None,
            }
        }
    }
    (kinetic.value(), potential.map(|sum| sum.value()))
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

/// Opens the books at the present state.
pub(super) fn open(model: &Model, state: &mut State) {
    let (kinetic, potential) = energies(model, state, state.now);
    let (momentum, scale) = momentum_value(model, state, state.now);
    state.account = Account {
        energy_at_start: kinetic + potential.unwrap_or(0.0),
        kinetic_at_start: kinetic,
        momentum_at_start: momentum,
        momentum_scale: scale,
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

/// Zero over zero is no drift.
fn relative(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale.max(f64::MIN_POSITIVE) }
}

pub(super) fn subject<'a>(model: &'a Model, state: &State, body: u32, time: f64) -> Subject<'a> {
    model.subject(body, time, state.path(body).place(time), state.velocity(body, time))
}

/// −∫ F·v dt of the drag forces along the body's segment up to `time`, J. In the step of a group drag is what its constant
/// acceleration is beyond that of the other forces: by the law along the way it would be off by an error of that step.
fn dissipated(model: &Model, state: &State, body: u32, time: f64) -> f64 {
    if !model.forces.iter().any(|force| force.law.dissipates()) {
        return 0.0;
    }
    let segment = &state.segments[body as usize];
    if segment.constrained && segment.step == 0.0 {
        let tau = time - segment.start;
        let way = tau * (segment.v + (0.5 * tau) * segment.a);
        return -model.mass(body) * (segment.a - undamped(model, body, segment.start, segment.x)).dot(way);
    }
    integrate(state.segments[body as usize].start, time, 0.0, |at| {
        let subject = subject(model, state, body, at);
        let drags = model.forces.iter().filter(|force| force.law.dissipates());
        -drags.map(|force| force.law.force(&subject).dot(subject.velocity)).sum::<f64>()
    })
}

/// Acceleration by the forces that do not dissipate, m/s².
fn undamped(model: &Model, body: u32, time: f64, x: DVec3) -> DVec3 {
    let subject = model.subject(body, time, Place::exact(x), DVec3::ZERO);
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
        let rise = undamped(model, body, time, state.position(body, time))
            - undamped(model, body, segment.start, segment.x);
        let of_drag = kick - (0.5 * (time - segment.start)) * rise;
        state.account.dissipated.add(-mass * of_drag.dot(v + 0.5 * kick));
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
