//! Who may meet whom: registration in tiles, the look through them, and the predictions that follow.

use glam::DVec3;

use super::contact::Partner;
use super::model::Model;
use super::motion::predict_core_passes;
use super::predict;
use super::queue::Kind;
use super::roots::first_root;
use super::segment::Path;
use super::state::{Scratch, State};
use super::tiles::{TileRange, for_each_brick};

/// How much larger than the body its registered box is, m: more than root finding can be off, and than bodies
/// are apart that touch.
fn margin(model: &Model, radius: f64, position: DVec3) -> f64 {
    let rounding = 1e-12 * model.grid.tile_size.max_element().max(position.abs().max_element());
    1e-6 * radius + rounding + model.params.contact_distance
}

/// Tiles of a body's box, rounded outwards.
fn range_at(model: &Model, radius: f64, position: DVec3) -> TileRange {
    let reach = radius + 2.0 * margin(model, radius, position);
    model.grid.range(position - reach, position + reach)
}

/// Enters a body that is in no tile yet.
pub(super) fn enter(model: &Model, state: &mut State, body: u32, time: f64) {
    let position = state.position(body, time);
    let range = range_at(model, model.movers[body as usize].radius, position);
    state.registered[body as usize] = range;
    state.moving.insert(&model.grid, range, body);
}

/// Makes all predictions about a body that has just begun a segment at `time`.
pub(super) fn predict_all(model: &Model, state: &mut State, body: u32, time: f64) {
    let end = state.segments[body as usize].end;
    if end.is_finite() {
        state.predict_one(end, Kind::SegmentEnd, body, 0);
    }
    predict_leaving(model, state, body, time);
    predict_core_passes(model, state, body, time);
    super::lasting::predict_contact_events(model, state, body, time);
    let range = state.registered[body as usize];
    predict_neighbours(model, state, body, range, None, time);
}

/// Moves a body to the tiles it is in now and predicts against the bodies it finds there.
pub(super) fn reregister(model: &Model, state: &mut State, body: u32, time: f64) {
    let old = state.registered[body as usize];
    let new = range_at(model, model.movers[body as usize].radius, state.position(body, time));
    if new != old {
        state.moving.change(&model.grid, old, new, body);
        state.registered[body as usize] = new;
        state.counters.tile_crossings += 1;
        predict_neighbours(model, state, body, new, Some(old), time);
    }
    predict_leaving(model, state, body, time);
}

/// Predicts when the body's box leaves its registered tiles: never too late, perhaps a little early.
fn predict_leaving(model: &Model, state: &mut State, body: u32, time: f64) {
    let (low, high) = model.grid.bounds(&state.registered[body as usize]);
    if low == DVec3::NEG_INFINITY && high == DVec3::INFINITY {
        return;
    }
    let radius = model.movers[body as usize].radius;
    let path = state.path(body);
    let (x, v, a) = (path.position(time), path.velocity(time), path.segment.a);
    let margin = margin(model, radius, x);
    let reach = radius + margin;
    let mut leaving = f64::INFINITY;
    for (axis, unit) in DVec3::AXES.into_iter().enumerate() {
        for (side, bound) in [(1.0, high[axis]), (-1.0, -low[axis])] {
            let limit = bound - reach;
            if limit == f64::INFINITY {
                continue;
            }
            let (distance, rate) = (limit - side * x[axis], -side * v[axis]);
            // Where |ẍ| ≤ A keeps the body from the limit until the segment ends, one look tells.
            let bend = if path.series.is_some() { -path.segment.acceleration_bound } else { -side * a[axis] };
            let Some(tau) = first_root(distance, rate, bend) else { continue };
            if time + tau > path.segment.end {
                continue;
            }
            let beyond = match path.series {
                Some(_) => first_beyond(path, side * unit, limit, 0.5 * margin, time),
                None => Some(time + tau),
            };
            leaving = leaving.min(beyond.unwrap_or(f64::INFINITY));
        }
    }
    if leaving <= path.segment.end && leaving.is_finite() {
        state.predict_one(leaving, Kind::LeaveTiles, body, 0);
    }
}

/// First time ≥ `from` at which direction·x reaches `limit`, or comes within `early` of it on a path that
/// is not a parabola.
pub(super) fn first_beyond(
    path: Path<'_>,
    direction: DVec3,
    limit: f64,
    early: f64,
    from: f64,
) -> Option<f64> {
    let segment = path.segment;
    let mut time = from;
    loop {
        let distance = limit - direction.dot(path.position(time));
        let rate = -direction.dot(path.velocity(time));
        if path.series.is_none() {
            return first_root(distance, rate, -direction.dot(segment.a)).map(|tau| time + tau);
        }
        if distance <= early {
            return Some(time);
        }
        // |ẍ| ≤ A: the limit is not reached before distance + rate·δ − ½Aδ² = 0.
        let step = first_root(distance, rate, -segment.acceleration_bound)?;
        if time + step > segment.end {
            return None;
        }
        if time + step <= time {
            return Some(time);
        }
        time += step;
    }
}

/// Predicts impacts with everything in the tiles of `range` that are not in `known`.
fn predict_neighbours(
    model: &Model,
    state: &mut State,
    body: u32,
    range: TileRange,
    known: Option<TileRange>,
    time: f64,
) {
    let mut scratch = std::mem::take(&mut state.scratch);
    collect(model, state, &mut scratch, body, range, known);
    let mover = state.mover(model, body);
    let looked_at = scratch.found_moving.len();
    let near = model.params.contact_distance;
    scratch.found_moving.retain(|other| !predict::surely_pass(mover, state.mover(model, *other), near));
    state.counters.pair_tests += (looked_at - scratch.found_moving.len()) as u64;
    for other in &scratch.found_moving {
        predict_pair(model, state, body, *other, f64::NEG_INFINITY, time);
    }
    for fixture in &scratch.found_fixed {
        predict_fixture(model, state, body, *fixture, f64::NEG_INFINITY, time);
    }
    state.scratch = scratch;
}

/// The bodies in those tiles, each once.
fn collect(
    model: &Model,
    state: &State,
    scratch: &mut Scratch,
    body: u32,
    range: TileRange,
    known: Option<TileRange>,
) {
    scratch.begin(state.segments.len(), model.fixtures.len());
    let epoch = scratch.epoch;
    scratch.seen_moving[body as usize] = epoch;
    let Scratch { seen_moving, seen_fixed, found_moving, found_fixed, .. } = scratch;
    let mut see_moving = |other: u32| {
        // With who is in the old tiles too, the next impact is predicted already.
        if known.is_some_and(|known| known.overlaps(&state.registered[other as usize])) {
            return;
        }
        if std::mem::replace(&mut seen_moving[other as usize], epoch) != epoch {
            found_moving.push(other);
        }
    };
    let mut see_fixed = |other: u32| {
        if std::mem::replace(&mut seen_fixed[other as usize], epoch) != epoch {
            found_fixed.push(other);
        }
    };
    for_each_brick(&model.grid, range, known, |brick, tiles| {
        state.moving.visit_brick(brick, tiles, &mut see_moving);
        model.static_tiles.visit_brick(brick, tiles, &mut see_fixed);
    });
    if known.is_none() {
        scratch.found_fixed.extend(model.static_tiles.large());
    }
}

/// All others that lie in the tiles of a body, each once, in order.
pub(super) fn near(model: &Model, state: &State, body: u32) -> Vec<Partner> {
    let mut found: Vec<Partner> = Vec::new();
    let range = state.registered[body as usize];
    state.moving.visit(&model.grid, range, None, |other| found.push(Partner::Dynamic(other)));
    model.static_tiles.visit(&model.grid, range, None, |other| found.push(Partner::Static(other)));
    found.extend(model.static_tiles.large().iter().map(|other| Partner::Static(*other)));
    found.sort_unstable();
    found.dedup();
    found.retain(|partner| *partner != Partner::Dynamic(body));
    found
}

/// Predicts the next impact of two dynamic bodies that are not in lasting contact. `from` is −∞ but where an
/// earlier search gave up.
pub(super) fn predict_pair(model: &Model, state: &mut State, a: u32, b: u32, from: f64, time: f64) {
    // The order of the two must not matter to the last bit.
    let (a, b) = (a.min(b), a.max(b));
    if !state.contacts[a as usize].is_empty() && state.is_in_contact(a, Partner::Dynamic(b)) {
        return;
    }
    state.counters.pair_tests += 1;
    if lies_against(model, state, a, b, time) {
        state.note_touching(a, b);
    }
    if let Some(impact) = predict::sphere_sphere(state.mover(model, a), state.mover(model, b), from) {
        state.predict_pair(impact.max(time), Kind::Impact, a, b);
    }
}

/// Whether two dynamic bodies touch to within the contact distance and will for a while: an impact on one
/// of them is an impact on both.
fn lies_against(model: &Model, state: &State, a: u32, b: u32, time: f64) -> bool {
    let params = &model.params;
    let apart = state.position(b, time) - state.position(a, time);
    let reach = model.movers[a as usize].radius + model.movers[b as usize].radius + params.contact_distance;
    if apart.length_squared() > reach * reach {
        return false;
    }
    let rate = apart.dot(state.velocity(b, time) - state.velocity(a, time));
    rate.abs() * params.contact_duration <= params.contact_distance * apart.length()
}

/// Predicts the next impact of a dynamic body with a static one it is not in lasting contact with.
pub(super) fn predict_fixture(
    model: &Model,
    state: &mut State,
    body: u32,
    fixture: u32,
    from: f64,
    time: f64,
) {
    if !state.contacts[body as usize].is_empty() && state.is_in_contact(body, Partner::Static(fixture)) {
        return;
    }
    state.counters.pair_tests += 1;
    let impact = predict::sphere_fixture(state.mover(model, body), &model.fixtures[fixture as usize], from);
    if let Some(impact) = impact {
        state.predict_one(impact.max(time), Kind::FixtureImpact, body, fixture);
    }
}

impl Scratch {
    fn begin(&mut self, moving: usize, fixed: usize) {
        self.found_moving.clear();
        self.found_fixed.clear();
        self.epoch = self.epoch.wrapping_add(1);
        if self.epoch == 0 {
            self.seen_moving.fill(0);
            self.seen_fixed.fill(0);
            self.epoch = 1;
        }
        self.seen_moving.resize(moving, 0);
        self.seen_fixed.resize(fixed, 0);
    }
}
