//! The step: one predicted event after the other. [`advance`] is its table of contents.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use super::capture::{free_unheld, is_caught};
use super::close_pass::{capture, pass_core};
use super::dense::{self, Dense, Role};
use super::event::EventKind;
use super::fault::{Fault, fault};
use super::geometry::{contact_distance, gap_of, larger_radius};
use super::impact;
use super::island::part;
use super::ledger::{rank, record_contact};
use super::model::Model;
use super::neighbours::{predict_later, predict_pair, reregister};
use super::pair::Pair;
use super::predict::{Gap, touch_tolerance};
use super::queue::{Kind, Predicted};
use super::report::PredictedImpact;
use super::restart::{Start, restart};
use super::rolling::kind_of;
use super::state::State;
use super::tolerance::{FOUND, TIME_ROUNDING};
use super::turn::Hold;

/// Carries out the next predicted event that is not after `state.until`; false when there is none.
/// What it has to report is left in the outbox.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    let step_at = dense::next_step(state);
    let Some(next) = pop(state, state.until.min(step_at)) else {
        // Where nothing is stepped, that is never: also of a run without an end.
        if step_at > state.until || step_at.is_infinite() {
            return Ok(false);
        }
        state.reached = step_at;
        step_groups(model, state, step_at)?;
        return Ok(true);
    };
    debug_assert!(next.time >= state.reached, "predictions come in the order of time: {next:?}");
    state.reached = next.time;
    match next.kind {
        Kind::SegmentEnd => go_on(model, state, next.a, next.time)?,
        Kind::LeaveTiles => reregister(model, state, next.a, next.time)
            .map_err(|error| fault(model, next.a, next.time, error))?,
        Kind::CorePass => pass_core(model, state, &next)?,
        Kind::Settled => settled(model, state, &next),
        Kind::ContactEnd => leave_contact(model, state, &next)?,
        Kind::Reach => dense::reach(model, state, next.a, next.b.index(), next.time)?,
        Kind::Impact => meet(model, state, &next)?,
    }
    tidy(state);
    Ok(true)
}

fn pop(state: &mut State, until: f64) -> Option<Predicted> {
    let State { queue, stamps, dense, counters, .. } = state;
    queue.pop(until, &mut counters.stale_events, |predicted| holds(stamps, dense.as_deref(), predicted))
}

/// Whether nothing is predicted any more: whatever moves goes on as it does for ever.
pub(super) fn is_over(state: &mut State) -> bool {
    if dense::next_step(state) < f64::INFINITY {
        return false;
    }
    let next = pop(state, f64::INFINITY);
    let is_over = next.is_none();
    next.into_iter().for_each(|next| state.queue.push(next));
    is_over
}

/// The impacts that are predicted now, in order.
pub(super) fn predicted_impacts(model: &Model, state: &State) -> Vec<PredictedImpact> {
    let State { queue, stamps, dense, .. } = state;
    let hold = queue.iter().filter(|predicted| predicted.kind == Kind::Impact);
    let hold = hold.filter(|predicted| holds(stamps, dense.as_deref(), predicted));
    let mut impacts: Vec<PredictedImpact> = hold
        .map(|predicted| {
            let (mut a, mut b) = predicted.pair().refs();
            if rank(model, b) < rank(model, a) {
                (a, b) = (b, a);
            }
            PredictedImpact { time: predicted.time, a, b }
        })
        .collect();
    impacts.sort_by(|one, other| {
        one.time.total_cmp(&other.time).then_with(|| (one.a, one.b).cmp(&(other.a, other.b)))
    });
    // One may be predicted twice, for the same time but for rounding.
    let mut known = FxHashSet::default();
    impacts.retain(|impact| known.insert((impact.a, impact.b)));
    impacts
}

fn tidy(state: &mut State) {
    let State { queue, stamps, dense, .. } = state;
    queue.tidy(|predicted| holds(stamps, dense.as_deref(), predicted));
}

/// Whether a prediction was made for the segments that its bodies still follow.
#[inline]
fn holds(stamps: &[u32], dense: Option<&Dense>, predicted: &Predicted) -> bool {
    if stamps[predicted.a as usize] != predicted.stamp_a {
        return false;
    }
    if predicted.kind == Kind::Reach {
        return dense.is_some_and(|dense| dense.epoch == predicted.stamp_b);
    }
    predicted.b.dynamic().is_none_or(|b| stamps[b as usize] == predicted.stamp_b)
}

/// Begins segments for all bodies at `state.now` and predicts everything: any of them may be concerned.
pub(super) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    free_unheld(model, state);
    dense::forget_removed(model, state);
    prepare_groups(model, state);
    let starts: Vec<Start> = model
        .present()
        .filter(|body| state.role(*body) == Role::Outside)
        .map(|body| (body, state.segments[body as usize]))
        .map(|(body, segment)| Start { body, x: segment.x, v: segment.v })
        .collect();
    set_beginning(state, true);
    restart(model, state, state.now, &starts)?;
    dense::wake_all(model, state, state.now)?;
    set_beginning(state, false);
    Ok(())
}

fn set_beginning(state: &mut State, is_beginning: bool) {
    if let Some(dense) = &mut state.dense {
        dense.is_beginning = is_beginning;
    }
}

/// Finds the step of groups where nothing told it before something happened.
pub(super) fn find_group_step(model: &mut Arc<Model>, state: &mut State) {
    if dense::find_step(model, state) {
        prepare_groups(model, state);
    }
}

/// Makes room for stepped groups where the scene can have them.
fn prepare_groups(model: &Model, state: &mut State) {
    if model.dense_step > 0.0 && state.dense.is_none() {
        state.dense = Some(Box::new(Dense::new(state.segments.len())));
    }
}

/// The ends of the steps of stepped groups: they go on, and who has left goes on from event to event.
fn step_groups(model: &Model, state: &mut State, time: f64) -> Result<(), Fault> {
    let left = dense::step(model, state, time)?;
    let starts: Vec<Start> =
        left.iter().map(|left| Start { body: left.body, x: left.x, v: left.v }).collect();
    restart(model, state, time, &starts)
}

/// The end of a segment: the next one goes on from there.
fn go_on(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    if !state.captured.contains(&body) && is_caught(model, state, body, time) {
        return capture(model, state, body, time);
    }
    restart(model, state, time, &[from_now(state, body, time)])
}

/// Where a body is on its segment.
fn from_now(state: &State, body: u32, time: f64) -> Start {
    Start { body, x: state.position(body, time), v: state.velocity(body, time) }
}

/// Two bodies are due to touch.
fn meet(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (next.pair(), next.time);
    let gap = gap_of(model, state, pair, time);
    if !(gap.is_closing() && is_closed(&gap, larger_radius(model, pair), time)) {
        if gap.is_closing() {
            predict_pair(model, state, pair, time, time);
        } else {
            predict_later(model, state, pair, time);
        }
        return Ok(());
    }
    if pair.dynamic().any(|body| state.role(body) != Role::Outside) {
        return dense::enter(model, state, &pair.dynamic().collect::<Vec<u32>>(), time);
    }
    let [also, rest] = simultaneous(model, state, pair, time, &gap);
    let mut left: Vec<Pair> = also.iter().map(Predicted::pair).collect();
    let outcome = impact::resolve(model, state, time, pair, &gap, &mut left);
    // What was not part of it is due as before.
    let unmet = also.into_iter().filter(|predicted| left.contains(&predicted.pair()));
    rest.into_iter().chain(unmet).for_each(|predicted| state.queue.push(predicted));
    outcome
}

/// Other impacts that are due at the same instant, for all that can be measured: their surfaces touch to
/// within the contact distance and close. And the other predictions of that instant. (A pair may have been
/// predicted twice.)
fn simultaneous(model: &Model, state: &mut State, pair: Pair, time: f64, gap: &Gap) -> [Vec<Predicted>; 2] {
    let near = contact_distance(model, pair, gap.point);
    let (mut also, mut rest) = (Vec::new(), Vec::new());
    // Mostly there is nothing at all within the time in which these two come nearer by that.
    let Some(first) = pop(state, time + near / gap.rate.abs()) else { return [also, rest] };
    state.queue.push(first);
    let window = time_to_move(state, pair, time, gap, near);
    while let Some(next) = pop(state, time + window) {
        let is_impact = next.kind == Kind::Impact;
        if is_impact && next.pair() == pair {
            continue;
        }
        let meets = || {
            let gap = gap_of(model, state, next.pair(), time);
            gap.rate < 0.0 && gap.distance <= contact_distance(model, next.pair(), gap.point)
        };
        if is_impact && meets() { also.push(next) } else { rest.push(next) }
    }
    [also, rest]
}

/// The time in which a body of a pair moves by a distance, or the two come nearer by it, s.
fn time_to_move(state: &State, pair: Pair, time: f64, gap: &Gap, distance: f64) -> f64 {
    let speed = pair.dynamic().map(|body| state.velocity(body, time).length()).fold(gap.rate.abs(), f64::max);
    let window = (distance / speed).min((2.0 * distance / gap.bend.abs()).sqrt());
    if window.is_finite() { window } else { 0.0 }
}

/// Whether surfaces are as near as a found root leaves them: a search that gave up is farther off. A root
/// is known to the rounding of the time, in which they come nearer by |ḋ| times that.
fn is_closed(gap: &Gap, radius: f64, time: f64) -> bool {
    let rounding_of_time = TIME_ROUNDING * time * gap.rate.abs();
    gap.distance <= FOUND * touch_tolerance(gap.point, radius) + rounding_of_time
}

/// The limit time of the bounces of two bodies has come.
fn settled(model: &Model, state: &mut State, next: &Predicted) {
    let (pair, time) = (next.pair(), next.time);
    let mut was_due = false;
    for (body, other) in pair.ends() {
        let contacts = &mut state.contacts[body as usize];
        let contact = contacts.iter_mut().find(|contact| contact.other == other);
        was_due |= contact.is_some_and(|contact| contact.settles_at.take().is_some());
    }
    if was_due {
        record_contact(model, state, time, EventKind::Rest, pair);
        let hold = state.hold(pair.first());
        if hold != Hold::Free {
            if hold != Hold::Rests {
                record_contact(model, state, time, kind_of(hold), pair);
            }
            return;
        }
        let speed = state.path_of(model, pair.b).velocity(time);
        if state.velocity(pair.first(), time) != speed {
            record_contact(model, state, time, EventKind::Slide, pair);
        }
    }
}

/// A surface ends under a body, or nothing presses two bodies together any more.
fn leave_contact(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (next.pair(), next.time);
    part(model, state, pair, time);
    let starts: Vec<Start> = pair.dynamic().map(|body| from_now(state, body, time)).collect();
    restart(model, state, time, &starts)
}
