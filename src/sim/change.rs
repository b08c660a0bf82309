//! Edits of a running simulation: each changes the model and the state at the present time, and books
//! the energy it puts in.

use std::sync::Arc;

use glam::DVec3;

use super::account::{book_segment, energies, momentum_value};
use super::compile::{Compiled, check_force, compile_body};
use super::contact::Partner;
use super::engine::record;
use super::force::{Force, ForceEntry, Law};
use super::method::begin_all;
use super::model::Model;
use super::neighbours::enter;
use super::plan::plan_of;
use super::segment::Segment;
use super::state::State;
use super::tiles::StaticTiles;
use super::{BodyRef, EditRefused, Event, EventKind, Fault, SimEdit};
use crate::scene::{Body, NodeKey};

/// Applies an edit at `state.now`. Refused, it may leave both half changed: give it copies.
pub(super) fn apply(model: &mut Model, state: &mut State, edit: &SimEdit) -> Result<(), EditRefused> {
    let before = Books::read(model, state);
    let body = match edit {
        SimEdit::AddBody(body) => Some(add_body(model, state, body)?),
        SimEdit::Remove(key) => remove(model, state, *key)?,
        SimEdit::AddForce(force) => {
            if model.forces.iter().any(|entry| entry.key == Some(force.key)) {
                return Err(EditRefused(format!("force {} is there already", force.label)));
            }
            check_force(force).map_err(|problem| EditRefused(problem.message))?;
            model.forces.push(ForceEntry { key: Some(force.key), law: Law::from_kind(&force.kind) });
            None
        }
        SimEdit::ChangeForce(force) => {
            check_force(force).map_err(|problem| EditRefused(problem.message))?;
            let entry = model.forces.iter_mut().find(|entry| entry.key == Some(force.key));
            let entry =
                entry.ok_or_else(|| EditRefused(format!("force {} is not in the run", force.label)))?;
            entry.law = Law::from_kind(&force.kind);
            None
        }
        SimEdit::Bounce(key, bounce) => Some(set_bounce(model, *key, *bounce)?),
        SimEdit::Mass(key, mass) => Some(set_mass(model, *key, *mass)?),
        SimEdit::ChangeStatic(body) => Some(change_static(model, state, body)?),
    };
    model.plan = plan_of(model);
    restart_all(model, state, &before, body).map_err(|fault| EditRefused(fault.to_string()))
}

/// Adds a force of the user's own at `state.now`. Copies, as for [`apply`].
pub(super) fn add_custom(
    model: &mut Model,
    state: &mut State,
    force: Arc<dyn Force>,
) -> Result<(), EditRefused> {
    let before = Books::read(model, state);
    model.forces.push(ForceEntry { key: None, law: Law::Custom(force) });
    model.plan = plan_of(model);
    restart_all(model, state, &before, None).map_err(|fault| EditRefused(fault.to_string()))
}

/// Removes a force added by [`add_custom`]; whether it was there. Copies, as for [`apply`].
pub(super) fn remove_custom(
    model: &mut Model,
    state: &mut State,
    force: &Arc<dyn Force>,
) -> Result<bool, EditRefused> {
    let is_it = |entry: &ForceEntry| matches!(&entry.law, Law::Custom(other) if Arc::ptr_eq(other, force));
    let Some(index) = model.forces.iter().position(is_it) else { return Ok(false) };
    let before = Books::read(model, state);
    model.forces.remove(index);
    model.plan = plan_of(model);
    restart_all(model, state, &before, None).map_err(|fault| EditRefused(fault.to_string()))?;
    Ok(true)
}

/// Energy and momentum before an edit. The segments' work must be booked under the old forces.
struct Books {
    energy: f64,
    momentum: DVec3,
}

impl Books {
    fn read(model: &Model, state: &mut State) -> Self {
        let time = state.now;
        for body in super::account::present(model) {
            book_segment(model, state, body, time);
            cut(state, body, time);
        }
        let (kinetic, potential) = energies(model, state, time);
        Self { energy: kinetic + potential.unwrap_or(0.0), momentum: momentum_value(model, state, time).0 }
    }
}

/// Shortens a body's past: its segment starts now, as a point. A new one is begun at once.
fn cut(state: &mut State, body: u32, time: f64) {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    state.segments[body as usize] = Segment::ballistic(time, x, v, DVec3::ZERO);
}

/// Begins new segments for all bodies, for any of them may be concerned, and books the edit.
fn restart_all(
    model: &Model,
    state: &mut State,
    before: &Books,
    changed: Option<BodyRef>,
) -> Result<(), Fault> {
    let time = state.now;
    let (kinetic, potential) = energies(model, state, time);
    state.account.edit_work.add(kinetic + potential.unwrap_or(0.0) - before.energy);
    let momentum = momentum_value(model, state, time).0;
    state.account.impulses.add(momentum - before.momentum);
    let place = changed.map_or(DVec3::ZERO, |body| place_of(model, state, body));
    record(state, Event::of_one(time, EventKind::Edit, changed.unwrap_or(BodyRef::NONE), place));
    begin_all(model, state)
}

fn place_of(model: &Model, state: &State, body: BodyRef) -> DVec3 {
    match body {
        BodyRef::Dynamic(index) => state.segments[index as usize].x,
        BodyRef::Static(index) => model.fixtures[index as usize].position,
    }
}

fn add_body(model: &mut Model, state: &mut State, body: &Body) -> Result<BodyRef, EditRefused> {
    if find(model, body.key).is_some() {
        return Err(EditRefused(format!("body {} is there already", body.label)));
    }
    let movers = model.movers.iter().map(|mover| mover.identity.id);
    let fixtures = model.fixtures.iter().map(|fixture| fixture.identity.id);
    let order = movers.chain(fixtures).filter(|id| *id == body.id).count() as u32;
    match compile_body(body, order).map_err(|problem| EditRefused(problem.message))? {
        Compiled::Mover(mover, start) => {
            model.radii.push(mover.radius);
            model.movers.push(mover);
            if 2.0 * mover_radius(&model.movers) > MOST_TILES_ACROSS * model.grid.tile_size.min_element() {
                return Err(EditRefused(format!(
                    "body {} spans too many tiles for the grid of this run; reset to run it",
                    body.label
                )));
            }
            let index = state.push_body(start);
            enter(model, state, index, state.now);
            Ok(BodyRef::Dynamic(index))
        }
        Compiled::Fixture(fixture) => {
            model.fixtures.push(fixture);
            remake_static_tiles(model);
            Ok(BodyRef::Static(model.fixtures.len() as u32 - 1))
        }
    }
}

/// Tiles across a body added while it runs, at most: the grid was made for the bodies of the start.
const MOST_TILES_ACROSS: f64 = 64.0;

fn mover_radius(movers: &[super::model::MoverInfo]) -> f64 {
    movers.last().map_or(0.0, |mover| mover.radius)
}

fn remove(model: &mut Model, state: &mut State, key: NodeKey) -> Result<Option<BodyRef>, EditRefused> {
    if let Some(index) = model.forces.iter().position(|entry| entry.key == Some(key)) {
        model.forces.remove(index);
        return Ok(None);
    }
    let body = find(model, key).ok_or_else(|| EditRefused("that body is not in the run".into()))?;
    match body {
        BodyRef::Dynamic(index) => {
            model.movers[index as usize].present = false;
            state.moving.remove(&model.grid, state.registered[index as usize], index);
            // Nothing predicted about it holds any more.
            state.stamps[index as usize] = state.stamps[index as usize].wrapping_add(1);
            state.forget_touching(index);
            state.contacts[index as usize].clear();
            drop_contacts_with(state, Partner::Dynamic(index));
        }
        BodyRef::Static(index) => {
            model.fixtures[index as usize].present = false;
            remake_static_tiles(model);
            drop_contacts_with(state, Partner::Static(index));
        }
    }
    Ok(Some(body))
}

fn change_static(model: &mut Model, state: &mut State, body: &Body) -> Result<BodyRef, EditRefused> {
    let Some(BodyRef::Static(index)) = find(model, body.key) else {
        return Err(EditRefused(format!("body {} is no static body of the run", body.label)));
    };
    let order = model.fixtures[index as usize].identity.order;
    match compile_body(body, order).map_err(|problem| EditRefused(problem.message))? {
        Compiled::Fixture(fixture) => model.fixtures[index as usize] = fixture,
        Compiled::Mover(..) => {
            return Err(EditRefused("a static body can't become dynamic while running".into()));
        }
    }
    remake_static_tiles(model);
    drop_contacts_with(state, Partner::Static(index));
    Ok(BodyRef::Static(index))
}

fn set_bounce(model: &mut Model, key: NodeKey, bounce: f64) -> Result<BodyRef, EditRefused> {
    if !(bounce.is_finite() && bounce >= 0.0) {
        return Err(EditRefused(format!("Bounce must be 0 or more, not {bounce}")));
    }
    let body = find(model, key).ok_or_else(|| EditRefused("that body is not in the run".into()))?;
    match body {
        BodyRef::Dynamic(index) => model.movers[index as usize].bounce = bounce,
        BodyRef::Static(index) => model.fixtures[index as usize].bounce = bounce,
    }
    Ok(body)
}

fn set_mass(model: &mut Model, key: NodeKey, mass: f64) -> Result<BodyRef, EditRefused> {
    if !(mass.is_finite() && mass > 0.0) {
        return Err(EditRefused(format!("Weight must be above 0, not {mass}")));
    }
    match find(model, key) {
        Some(body @ BodyRef::Dynamic(index)) => {
            model.movers[index as usize].mass = mass;
            Ok(body)
        }
        _ => Err(EditRefused("only a dynamic body has a mass".into())),
    }
}

pub(super) fn find(model: &Model, key: NodeKey) -> Option<BodyRef> {
    let moving = model.movers.iter().position(|mover| mover.present && mover.identity.key == key);
    let fixed = || model.fixtures.iter().position(|fixture| fixture.present && fixture.identity.key == key);
    moving
        .map(|index| BodyRef::Dynamic(index as u32))
        .or_else(|| fixed().map(|index| BodyRef::Static(index as u32)))
}

fn remake_static_tiles(model: &mut Model) {
    let limit = model.params.static_tile_limit as u64;
    model.static_tiles = StaticTiles::new(&model.grid, &model.fixtures, limit);
}

fn drop_contacts_with(state: &mut State, partner: Partner) {
    for contacts in &mut state.contacts {
        contacts.retain(|contact| contact.partner != partner);
    }
}
