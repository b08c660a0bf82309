//! Who may meet whom: registration in tiles, the look through them, and the predictions that follow.

use glam::DVec3;

use super::body::BodyId;
use super::contact_ends::predict_contact_events;
use super::dense::{Role, step_at};
use super::force::Law;
use super::geometry::{ball, contact_distance, gap_of, larger_radius, target};
use super::model::Model;
use super::motion::SegmentError;
use super::pair::Pair;
use super::predict::{self, Ball, Target, first_beyond};
use super::queue::{Kind, Predicted};
use super::roots::first_root;
use super::segment::{Path, Segment};
use super::state::{Scratch, State};
use super::tiles::{DynamicTiles, TileRange, for_each_brick};
use super::tolerance::{BOX_MARGIN, BOX_ROUNDING, LATER_ROUNDING};

/// How much larger than the body its registered box is, m: more than root finding can be off, and than bodies
/// are apart that touch.
fn margin(model: &Model, radius: f64, position: DVec3) -> f64 {
    let rounding = BOX_ROUNDING * model.grid.tile_size.max_element().max(position.abs().max_element());
    (BOX_MARGIN + model.params.contact_distance) * radius + rounding
}

/// Tiles of a body's box, rounded outwards.
fn range_at(model: &Model, radius: f64, position: DVec3) -> TileRange {
    let reach = radius + 2.0 * margin(model, radius, position);
    model.grid.range(position - reach, position + reach)
}

/// Enters a body that is in no tile yet.
pub(super) fn enter(model: &Model, state: &mut State, body: u32, time: f64) {
    let position = state.position(body, time);
    let range = range_at(model, model.radius(body), position);
    state.registered[body as usize] = range;
    state.dynamic_tiles.insert(&model.grid, range, body);
}

/// Enters all bodies anew, after the tiles have changed.
pub(super) fn enter_all(model: &Model, state: &mut State, time: f64) {
    state.dynamic_tiles = DynamicTiles::default();
    for body in model.present() {
        let (center, reach) = match state.role(body) {
            Role::Member(slot) => {
                let member = state.dense.as_ref().and_then(|dense| dense.members.get(slot as usize));
                member.map_or((state.position(body, time), 0.0), |member| {
                    (member.listed_at, OUTER * member.margin)
                })
            }
            Role::Outside | Role::Frozen(_) => (state.position(body, time), 0.0),
        };
        let range = range_at(model, model.radius(body) + reach, center);
        state.registered[body as usize] = range;
        state.dynamic_tiles.insert(&model.grid, range, body);
    }
}

/// Registers a body in all tiles that it may come to while it stays within `reach` of a point, m.
pub(super) fn register_within(model: &Model, state: &mut State, body: u32, center: DVec3, reach: f64) {
    let old = state.registered[body as usize];
    let new = range_at(model, reach, center);
    if new != old {
        state.dynamic_tiles.change(&model.grid, old, new, body);
        state.registered[body as usize] = new;
        state.counters.tile_crossings += 1;
    }
}

/// The bodies in the tiles within `reach` of a point, m, each once, in order: the dynamic ones that are wanted, and the
/// static ones with those that are in no tile.
pub(super) fn within(
    model: &Model,
    state: &State,
    center: DVec3,
    reach: f64,
    is_wanted: impl Fn(u32) -> bool,
    found: &mut Vec<BodyId>,
) {
    found.clear();
    let range = range_at(model, reach, center);
    state.dynamic_tiles.visit(&model.grid, range, None, |other| {
        if is_wanted(other) {
            found.push(BodyId::of_dynamic(other));
        }
    });
    model.static_tiles.visit(&model.grid, range, None, |other| found.push(BodyId::of_static(other)));
    found.extend(model.static_tiles.large().iter().map(|other| BodyId::of_static(*other)));
    found.sort_unstable();
    found.dedup();
}

/// Makes all predictions about a body that has just begun a segment at `time`.
pub(super) fn predict_all(model: &Model, state: &mut State, body: u32, time: f64) {
    let end = state.segments[body as usize].end;
    if end.is_finite() {
        state.predict_alone(end, Kind::SegmentEnd, body, BodyId::NONE);
    }
    predict_leaving(model, state, body, time);
    predict_core_passes(model, state, body, time);
    predict_contact_events(model, state, body, time);
    let range = state.registered[body as usize];
    predict_neighbours(model, state, body, range, None, time);
}

/// Moves a body to the tiles it is in now and predicts against the bodies it finds there. One that leaves its tiles at the
/// time at which it was found in them would do so for ever.
pub(super) fn reregister(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), SegmentError> {
    let old = state.registered[body as usize];
    let new = range_at(model, model.radius(body), state.position(body, time));
    if new != old {
        state.dynamic_tiles.change(&model.grid, old, new, body);
        state.registered[body as usize] = new;
        state.counters.tile_crossings += 1;
        predict_neighbours(model, state, body, new, Some(old), time);
    }
    let leaving = predict_leaving(model, state, body, time);
    if new == old && leaving <= time { Err(SegmentError::TooFast) } else { Ok(()) }
}

/// Predicts when the body's box leaves its registered tiles: never too late, perhaps a little early. Gives the time,
/// infinite if it does not on its present segment.
fn predict_leaving(model: &Model, state: &mut State, body: u32, time: f64) -> f64 {
    let (low, high) = model.grid.bounds(&state.registered[body as usize]);
    if low == DVec3::NEG_INFINITY && high == DVec3::INFINITY {
        return f64::INFINITY;
    }
    let radius = model.radius(body);
    let path = state.path(body);
    let (x, v, a) = (path.position(time), path.velocity(time), path.segment.a);
    let margin = margin(model, radius, x);
    let reach = radius + margin;
    let mut leaving = f64::INFINITY;
    for (axis, unit) in DVec3::AXES.into_iter().enumerate() {
        // Along an axis on which nothing drives it, a body leaves on the side to which it flies.
        let ahead = if v[axis] < 0.0 { -1.0 } else { 1.0 };
        let sides = if path.series.is_none() && a[axis] == 0.0 { 1 } else { 2 };
        for side in [ahead, -ahead].into_iter().take(sides) {
            let bound = if side > 0.0 { high[axis] } else { -low[axis] };
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
        state.predict_alone(leaving, Kind::LeaveTiles, body, BodyId::NONE);
        return leaving;
    }
    f64::INFINITY
}

/// Predicts when a body comes within the core radius of an attractor on its present segment.
pub(super) fn predict_core_passes(model: &Model, state: &mut State, body: u32, time: f64) {
    if state.captured.contains(&body) {
        return;
    }
    for (index, force) in (0u32..).zip(&model.forces) {
        let Law::Point { center, intensity } = force.law else { continue };
        if intensity <= 0.0 {
            continue;
        }
        if let Some(pass) = predict::core_pass(state.path(body), center, model.params.core_radius, time) {
            state.predict_alone(pass.max(time), Kind::CorePass, body, BodyId::of_static(index));
        }
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
    let passed = sieve(model, state, &mut scratch.found_dynamic, body, time);
    state.counters.pair_tests += passed as u64;
    for other in &scratch.found_dynamic {
        predict_pair(model, state, Pair::of(body, BodyId::of_dynamic(*other)), f64::NEG_INFINITY, time);
    }
    for other in &scratch.found_static {
        predict_pair(model, state, Pair::of(body, BodyId::of_static(*other)), f64::NEG_INFINITY, time);
    }
    state.scratch = scratch;
}

/// Drops from a list those that a body surely passes; gives how many.
fn sieve(model: &Model, state: &State, others: &mut Vec<u32>, body: u32, time: f64) -> usize {
    let looked_at = others.len();
    let (segment, radius) = (state.segments[body as usize], model.radius(body));
    // More than the contact distance of any pair of this body.
    let near = 2.0 * margin(model, radius, state.position(body, time));
    // First as if all were as large as the largest, for that needs to know only where they fly.
    let (least, largest) = model.bodies.range_of_radii();
    let reach = radius + largest;
    // Of stepped bodies the present flight tells nothing: it ends with the step.
    let stepped = state.dense.as_deref().filter(|dense| !dense.members.is_empty());
    let is_stepped = |other: u32| stepped.is_some_and(|dense| dense.is_member(other));
    let passes =
        |other: u32, reach: f64| predict::surely_pass(&segment, &state.segments[other as usize], reach, near);
    // All are asked for before the first is looked at: memory answers many at once.
    std::hint::black_box(others.iter().map(|other| state.segments[*other as usize].start).sum::<f64>());
    if stepped.is_none() {
        keep(others, |other| !passes(other, reach));
    } else {
        keep(others, |other| !passes(other, reach) || is_stepped(other));
    }
    if least < largest {
        keep(others, |other| !passes(other, radius + model.radius(other)) || is_stepped(other));
    }
    if segment.end.is_finite() {
        let path = state.path(body);
        let apart = |other: u32| {
            predict::surely_stay_apart(path, state.path(other), radius + model.radius(other), near)
        };
        keep(others, |other| is_stepped(other) || !apart(other));
    }
    looked_at - others.len()
}

/// As `Vec::retain`, without branches: half of the answers nobody can foretell.
fn keep(list: &mut Vec<u32>, mut keeps: impl FnMut(u32) -> bool) {
    let mut kept = 0;
    for at in 0..list.len() {
        let body = list[at];
        list[kept] = body;
        kept += usize::from(keeps(body));
    }
    list.truncate(kept);
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
    scratch.begin(state.segments.len(), model.bodies.static_len());
    let epoch = scratch.epoch;
    scratch.seen_dynamic[body as usize] = epoch;
    let Scratch { seen_dynamic, seen_static, found_dynamic, found_static, .. } = scratch;
    let mut see_static = |other: u32| {
        if std::mem::replace(&mut seen_static[other as usize], epoch) != epoch {
            found_static.push(other);
        }
    };
    for_each_brick(&model.grid, range, known, |brick, tiles| {
        state.dynamic_tiles.gather(brick, tiles, found_dynamic);
        model.static_tiles.visit_brick(brick, tiles, &mut see_static);
    });
    keep(found_dynamic, |other| std::mem::replace(&mut seen_dynamic[other as usize], epoch) != epoch);
    if let Some(known) = known {
        // With who is in the old tiles too, the next impact is predicted already.
        keep(found_dynamic, |other| !known.overlaps(&state.registered[other as usize]));
    }
    if known.is_none() {
        scratch.found_static.extend(model.static_tiles.large());
    }
}

/// All others that lie in the tiles of a body, each once, in order.
pub(super) fn near(model: &Model, state: &State, body: u32) -> Vec<BodyId> {
    let mut found: Vec<BodyId> = Vec::new();
    let range = state.registered[body as usize];
    state.dynamic_tiles.visit(&model.grid, range, None, |other| found.push(BodyId::of_dynamic(other)));
    model.static_tiles.visit(&model.grid, range, None, |other| found.push(BodyId::of_static(other)));
    found.extend(model.static_tiles.large().iter().map(|other| BodyId::of_static(*other)));
    found.sort_unstable();
    found.dedup();
    found.retain(|other| *other != BodyId::of_dynamic(body));
    found
}

/// Predicts the next impact of two bodies that are not in lasting contact. `from` is −∞ but where an earlier
/// search gave up.
pub(super) fn predict_pair(model: &Model, state: &mut State, pair: Pair, from: f64, time: f64) {
    let body = pair.first();
    if !state.contacts[body as usize].is_empty() && state.contact(pair).is_some() {
        return;
    }
    if is_stepped(state, pair) {
        return predict_reach(model, state, pair, time);
    }
    state.counters.pair_tests += 1;
    if let Some(other) = pair.second()
        && lies_against(model, state, pair, time)
    {
        state.note_touching(body, other);
    }
    if model.plan.spin && time == 0.0 && lies_on(model, state, pair, time) {
        return state.predict(time, Kind::Impact, pair);
    }
    let impact = predict::first_contact(ball(model, state, body), target(model, state, pair.b), from);
    if let Some(impact) = impact {
        state.predict(impact.max(time), Kind::Impact, pair);
    }
}

/// Whether one of a pair is stepped.
fn is_stepped(state: &State, pair: Pair) -> bool {
    let Some(dense) = state.dense.as_ref().filter(|dense| !dense.members.is_empty()) else { return false };
    pair.dynamic().any(|body| dense.is_member(body))
}

/// Predicts when a body comes near where a stepped one may be, two steps before: among each other, stepped bodies
/// need no predictions.
fn predict_reach(model: &Model, state: &mut State, pair: Pair, time: f64) {
    let Some((body, member)) = outsider(state, pair) else { return };
    let Some(met) = reach_of(model, state, body, member, time) else { return };
    // Not before it is in the tiles of the other for certain: when it got there is not to matter.
    let Some(near) = touch_of(model, state, body, member, OUTER, time) else { return };
    let Some(epoch) = state.dense.as_ref().map(|dense| dense.epoch) else { return };
    let step = step_at(model, member, time, (state.position(member, time), state.velocity(member, time)));
    let soon = (met - 2.0 * step).max(near).max(time);
    let (kind, b) = (Kind::Reach, BodyId::of_dynamic(member));
    let stamp_a = state.stamps[body as usize];
    state.queue.push(Predicted { time: soon, kind, a: body, b, stamp_a, stamp_b: epoch });
}

/// The one of a pair that is not stepped, and the other.
fn outsider(state: &State, pair: Pair) -> Option<(u32, u32)> {
    let (a, b) = (pair.first(), pair.second()?);
    match (state.role(a), state.role(b)) {
        (Role::Outside, Role::Member(_)) => Some((a, b)),
        (Role::Member(_), Role::Outside) => Some((b, a)),
        _ => None,
    }
}

/// A stepped body is registered in the tiles of a ball that is larger than the one in which it stays by as many times its
/// margin.
pub(super) const OUTER: f64 = 2.0;

/// When a body on its present segment touches the ball in which a stepped one stays; `time` if it is in it already.
pub(super) fn reach_of(model: &Model, state: &State, body: u32, member: u32, time: f64) -> Option<f64> {
    touch_of(model, state, body, member, 1.0, time)
}

/// The same for a ball with so many margins.
fn touch_of(model: &Model, state: &State, body: u32, member: u32, margins: f64, time: f64) -> Option<f64> {
    let dense = state.dense.as_ref()?;
    let Role::Member(slot) = dense.role(member) else { return None };
    let member = &dense.members[slot as usize];
    let segment = Segment::resting(member.listed_at);
    let radius = model.radius(member.body) + margins * member.margin;
    let place = Target::Sphere(Ball { path: Path { segment: &segment, series: None }, radius });
    let ball = ball(model, state, body);
    let is_in = |time: f64| predict::gap(ball, place, time).distance <= 0.0;
    if is_in(time) {
        return Some(time);
    }
    // It may have been there before, earlier on this segment; or when that began, and be on its way back.
    let since = [f64::NEG_INFINITY, dense.listed_since, time];
    let start = ball.path.segment.start;
    let from = since.into_iter().find(|since| !is_in(since.max(start))).unwrap_or(time);
    let first = predict::first_contact(ball, place, from)?;
    if first >= time { Some(first) } else { predict::first_contact(ball, place, time) }
}

/// Predicts again what touches and neither meets nor lasts: from when the motion that is left, if any, has brought
/// the surfaces nearer by the rounding of a place. The same time would only give the same answer.
pub(super) fn predict_later(model: &Model, state: &mut State, pair: Pair, time: f64) {
    if is_stepped(state, pair) {
        return;
    }
    let gap = gap_of(model, state, pair, time);
    let slack = predict::touch_tolerance(gap.point, larger_radius(model, pair));
    let integrated: Vec<Path<'_>> =
        pair.dynamic().map(|body| state.path(body)).filter(|path| path.series.is_some()).collect();
    let bounds = integrated.iter().map(|path| -path.segment.acceleration_bound);
    // Past an edge the surfaces bend apart now, and no more when they have parted: only the drive bounds.
    let bend = bounds.fold(gap.bend.min(gap.drive), f64::min);
    let Some(tau) = first_root(slack, gap.rate, bend) else { return };
    let mut from = time + tau.max(LATER_ROUNDING * time);
    if !integrated.is_empty() {
        let (ball, target) = (ball(model, state, pair.first()), target(model, state, pair.b));
        let Some(deeper) = predict::first_deeper(ball, target, time) else { return };
        from = from.max(deeper);
    }
    predict_pair(model, state, pair, from, time);
}

/// Whether two dynamic bodies touch to within the contact distance and do not part: an impact on one of them is
/// an impact on both.
fn lies_against(model: &Model, state: &State, pair: Pair, time: f64) -> bool {
    let Some(second) = pair.second() else { return false };
    let at = state.position(pair.first(), time);
    let apart = state.position(second, time) - at;
    let reach = model.radius(pair.first()) + model.radius(second) + contact_distance(model, pair, at);
    apart.length_squared() <= reach * reach && gap_of(model, state, pair, time).rate <= 0.0
}

/// Whether two bodies rest on each other but for the rounding of their places: at the start, as somebody wrote them. Friction
/// must begin then: in the time in which a body falls by a rounding it would slide by the root of that.
fn lies_on(model: &Model, state: &State, pair: Pair, time: f64) -> bool {
    let gap = gap_of(model, state, pair, time);
    let slack = predict::touch_tolerance(gap.point, larger_radius(model, pair));
    gap.rate == 0.0 && gap.bend < 0.0 && gap.distance > 0.0 && gap.distance <= slack
}

impl Scratch {
    fn begin(&mut self, dynamic: usize, statics: usize) {
        self.found_dynamic.clear();
        self.found_static.clear();
        self.epoch = self.epoch.wrapping_add(1);
        if self.epoch == 0 {
            self.seen_dynamic.fill(0);
            self.seen_static.fill(0);
            self.epoch = 1;
        }
        self.seen_dynamic.resize(dynamic, 0);
        self.seen_static.resize(statics, 0);
    }
}
