//! Edits of a running simulation: each changes the model and the state at the present time, and books
//! the energy it puts in.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use super::body::BodyId;
use super::books::{angular_value, book_segment, energies, momentum_value};
use super::compile::{Compiled, check_force, check_roughness, compile_body};
use super::dense::set_step;
use super::drive::begin_all;
use super::edit::{EditRefused, SimEdit};
use super::event::{BodyRef, Event, EventKind};
use super::fault::Fault;
use super::force::{Force, ForceEntry, Law};
use super::ledger::record;
use super::model::Model;
use super::neighbours::{enter, enter_all};
use super::plan::plan_of;
use super::segment::Segment;
use super::state::State;
use super::tiles::{StaticTiles, coarse_enough};
use crate::scene::{Body, NodeKey, Roughness};

/// Applies edits made together at `state.now`: bodies go on anew once, after the last of them. Tells of each in `outcomes`
/// whether it was taken. Where it fails as a whole, since none was taken or nothing can go on after them, both may be left
/// half changed: give it copies.
pub(super) fn apply(
    model: &mut Model,
    state: &mut State,
    edits: &[SimEdit],
    outcomes: &mut Vec<Result<(), EditRefused>>,
) -> Result<(), EditRefused> {
    let before = Books::read(model, state);
    let (mut subjects, mut after) = (Vec::new(), Aftermath::default());
    for edit in edits {
        outcomes.push(change(model, state, &mut after, edit).map(|subject| subjects.push(subject)));
    }
    if let (true, Some(Err(refused))) = (subjects.is_empty(), outcomes.first()) {
        return Err(refused.clone());
    }
    after.carry_out(model, state);
    plan_anew(model, state);
    restart_all(model, state, &before, &subjects).map_err(|fault| EditRefused(fault.to_string()))
}

/// What is to be done once after all edits, for it looks at all bodies.
#[derive(Default)]
struct Aftermath {
    /// Whether static bodies came, went or changed.
    has_new_statics: bool,
    /// Bodies that nothing touches any more.
    apart: BTreeSet<BodyId>,
}

impl Aftermath {
    fn carry_out(&self, model: &mut Model, state: &mut State) {
        if self.has_new_statics {
            remake_tiles(model, state);
        }
        if !self.apart.is_empty() {
            for contacts in &mut state.contacts {
                contacts.retain(|contact| !self.apart.contains(&contact.other));
            }
        }
    }
}

/// Makes one change, without its consequences; of the body that it gives, if it is of one. Refused, nothing is changed.
fn change(
    model: &mut Model,
    state: &mut State,
    after: &mut Aftermath,
    edit: &SimEdit,
) -> Result<Option<BodyId>, EditRefused> {
    match edit {
        SimEdit::AddBody(body) => add_body(model, state, after, body).map(Some),
        SimEdit::Remove(key) => remove(model, state, after, *key),
        SimEdit::AddForce(force) => {
            if model.forces.iter().any(|entry| entry.key == Some(force.key)) {
                return Err(EditRefused(format!("force {} is there already", force.label)));
            }
            check_force(force).map_err(|problem| EditRefused(problem.message))?;
            ForceEntry::of(force).put_into(&mut model.forces);
            Ok(None)
        }
        SimEdit::ChangeForce(force) => {
            check_force(force).map_err(|problem| EditRefused(problem.message))?;
            let entry = model.forces.iter_mut().find(|entry| entry.key == Some(force.key));
            let entry =
                entry.ok_or_else(|| EditRefused(format!("force {} is not in the run", force.label)))?;
            entry.law = Law::from_kind(&force.kind);
            Ok(None)
        }
        SimEdit::Bounce(key, bounce) => set_bounce(model, *key, *bounce).map(Some),
        SimEdit::Roughness(key, roughness) => set_roughness(model, *key, roughness).map(Some),
        SimEdit::Mass(key, mass) => set_mass(model, *key, *mass).map(Some),
        SimEdit::ChangeStatic(body) => change_static(model, after, body).map(Some),
    }
}

/// Adds a force of the user's own at `state.now`. Copies, as for [`apply`].
pub(super) fn add_custom(
    model: &mut Model,
    state: &mut State,
    force: Arc<dyn Force>,
) -> Result<(), EditRefused> {
    let before = Books::read(model, state);
    ForceEntry::custom(force).put_into(&mut model.forces);
    plan_anew(model, state);
    restart_all(model, state, &before, &[None]).map_err(|fault| EditRefused(fault.to_string()))
}

/// Whether a force was added by [`add_custom`].
pub(super) fn has_custom(model: &Model, force: &Arc<dyn Force>) -> bool {
    position_of_custom(model, force).is_some()
}

fn position_of_custom(model: &Model, force: &Arc<dyn Force>) -> Option<usize> {
    let is_it = |entry: &ForceEntry| matches!(&entry.law, Law::Custom(other) if Arc::ptr_eq(other, force));
    model.forces.iter().position(is_it)
}

/// Removes a force added by [`add_custom`], once. Copies, as for [`apply`].
pub(super) fn remove_custom(
    model: &mut Model,
    state: &mut State,
    force: &Arc<dyn Force>,
) -> Result<(), EditRefused> {
    let before = Books::read(model, state);
    if let Some(index) = position_of_custom(model, force) {
        model.forces.remove(index);
    }
    plan_anew(model, state);
    restart_all(model, state, &before, &[None]).map_err(|fault| EditRefused(fault.to_string()))
}

/// What the changed scene needs.
fn plan_anew(model: &mut Model, state: &mut State) {
    model.bodies.measure();
    model.plan = plan_of(model);
    // What turns goes on turning, also where nothing rubs any more.
    model.plan.spin |= !state.turns.is_empty();
    state.make_turns(model);
    if model.plan.stepped_groups || state.dense.is_some() {
        let time = state.now;
        set_step(model, time, |body| (state.position(body, time), state.velocity(body, time)));
    }
}

/// Energy and momentum before an edit. The segments' work must be booked under the old forces.
struct Books {
    energy: f64,
    momentum: DVec3,
    angular: DVec3,
}

impl Books {
    fn read(model: &Model, state: &mut State) -> Self {
        let time = state.now;
        for body in model.present() {
            book_segment(model, state, body, time);
            cut(state, body, time);
        }
        let (kinetic, potential) = energies(model, state, time);
        Self {
            energy: kinetic + potential.unwrap_or(0.0),
            momentum: momentum_value(model, state, time).0,
            angular: angular_value(model, state, time).0,
        }
    }
}

/// Shortens a body's past: its segment starts now, as a point. A new one is begun at once.
fn cut(state: &mut State, body: u32, time: f64) {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    state.turn_freely(body, time);
    state.segments[body as usize] = Segment::ballistic(time, x, v, DVec3::ZERO);
}

/// Begins new segments for all bodies, for any of them may be concerned, and books the edits, of which each has its row of
/// the ledger.
fn restart_all(
    model: &Model,
    state: &mut State,
    before: &Books,
    changed: &[Option<BodyId>],
) -> Result<(), Fault> {
    let time = state.now;
    let (kinetic, potential) = energies(model, state, time);
    state.account.edit_work.add(kinetic + potential.unwrap_or(0.0) - before.energy);
    let momentum = momentum_value(model, state, time).0;
    state.account.impulses.add(momentum - before.momentum);
    state.account.angular.impulses.add(angular_value(model, state, time).0 - before.angular);
    for changed in changed {
        let place = changed.map_or(DVec3::ZERO, |body| state.path_of(model, body).segment.x);
        let subject = changed.map_or(BodyRef::NONE, BodyId::to_ref);
        record(state, Event::of_one(time, EventKind::Edit, subject, place));
    }
    begin_all(model, state)
}

fn add_body(
    model: &mut Model,
    state: &mut State,
    after: &mut Aftermath,
    body: &Body,
) -> Result<BodyId, EditRefused> {
    if find(model, body.key).is_some() {
        return Err(EditRefused(format!("body {} is there already", body.label)));
    }
    let order = model.bodies.count_of(body.id);
    let Compiled { identity, body: compiled, origin } =
        compile_body(body, order).map_err(|problem| EditRefused(problem.message))?;
    let most = MOST_TILES_ACROSS * model.grid.tile_size.min_element();
    if !compiled.is_static() && 2.0 * compiled.shape.radius() > most {
        return Err(EditRefused(format!(
            "body {} spans too many tiles for the grid of this run; reset to run it",
            body.label
        )));
    }
    let id = model.bodies.push(identity, compiled, origin.position);
    let Some(index) = id.dynamic() else {
        after.has_new_statics = true;
        return Ok(id);
    };
    let row = state.push_body(origin);
    state.came.insert(row, state.now);
    debug_assert_eq!(row, index, "every dynamic body has its row in all columns");
    enter(model, state, index, state.now);
    Ok(id)
}

/// Tiles across a body added while it runs, at most: the grid was made for the bodies of the start.
const MOST_TILES_ACROSS: f64 = 64.0;

fn remove(
    model: &mut Model,
    state: &mut State,
    after: &mut Aftermath,
    key: NodeKey,
) -> Result<Option<BodyId>, EditRefused> {
    if let Some(index) = model.forces.iter().position(|entry| entry.key == Some(key)) {
        model.forces.remove(index);
        return Ok(None);
    }
    let body = find(model, key).ok_or_else(|| EditRefused("that body is not in the run".into()))?;
    model.bodies.remove(body);
    after.apart.insert(body);
    let Some(index) = body.dynamic() else {
        after.has_new_statics = true;
        return Ok(Some(body));
    };
    state.dynamic_tiles.remove(&model.grid, state.registered[index as usize], index);
    // Nothing predicted about it holds any more.
    state.stamps[index as usize] = state.stamps[index as usize].wrapping_add(1);
    state.forget_touching(index);
    state.contacts[index as usize].clear();
    Ok(Some(body))
}

fn change_static(model: &mut Model, after: &mut Aftermath, body: &Body) -> Result<BodyId, EditRefused> {
    let Some(id) = find(model, body.key).filter(|id| id.is_static()) else {
        return Err(EditRefused(format!("body {} is no static body of the run", body.label)));
    };
    let (_, order) = model.body(id).rank();
    let Compiled { identity, body: compiled, origin } =
        compile_body(body, order).map_err(|problem| EditRefused(problem.message))?;
    if !compiled.is_static() {
        return Err(EditRefused("a static body cannot become dynamic while running".into()));
    }
    model.bodies.replace_static(id.index(), identity, compiled, origin.position);
    after.has_new_statics = true;
    after.apart.insert(id);
    Ok(id)
}

fn set_bounce(model: &mut Model, key: NodeKey, bounce: f64) -> Result<BodyId, EditRefused> {
    if !(bounce.is_finite() && bounce >= 0.0) {
        return Err(EditRefused(format!("Bounce must be 0 or more, not {bounce}")));
    }
    let body = find(model, key).ok_or_else(|| EditRefused("that body is not in the run".into()))?;
    model.bodies.get_mut(body).bounce = bounce;
    Ok(body)
}

fn set_roughness(model: &mut Model, key: NodeKey, roughness: &Roughness) -> Result<BodyId, EditRefused> {
    check_roughness(roughness).map_err(|hint| EditRefused(hint.into()))?;
    let body = find(model, key).ok_or_else(|| EditRefused("that body is not in the run".into()))?;
    model.bodies.get_mut(body).set_roughness(*roughness);
    Ok(body)
}

fn set_mass(model: &mut Model, key: NodeKey, mass: f64) -> Result<BodyId, EditRefused> {
    if !(mass.is_finite() && mass > 0.0) {
        return Err(EditRefused(format!("Weight must be above 0, not {mass}")));
    }
    match find(model, key) {
        Some(body) if !body.is_static() => {
            model.bodies.get_mut(body).set_mass(mass);
            Ok(body)
        }
        _ => Err(EditRefused("only a dynamic body has a mass".into())),
    }
}

pub(super) fn find(model: &Model, key: NodeKey) -> Option<BodyId> {
    model.bodies.of_key(key)
}

/// Lists the static bodies anew, in coarser tiles where they are too many for these.
fn remake_tiles(model: &mut Model, state: &mut State) {
    let limit = model.params.static_tile_limit as u64;
    let grid = coarse_enough(model.grid, &model.bodies, limit);
    if grid != model.grid {
        model.grid = grid;
        enter_all(model, state, state.now);
    }
    model.static_tiles = StaticTiles::new(&model.grid, &model.bodies, limit);
}
