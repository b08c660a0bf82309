//! Islands that rub: what they do, and what the ledger says about it.

use glam::DVec3;

use super::constraint::enter_none;
use super::event::EventKind;
use super::geometry::rubbing_of;
use super::island::{Island, level};
use super::ledger::record_contact;
use super::model::Model;
use super::motion::{Going, OnFace, SegmentError, check, go_on_face, place, step_hint};
use super::pair::Pair;
use super::rub::inertia;
use super::segment::Segment;
use super::shape::Surface;
use super::state::State;
use super::turn::{Due, Hold};

/// Whether friction acts in an island.
pub(super) fn rubs(model: &Model, island: &Island) -> bool {
    model.plan.spin && island.contacts.iter().any(|(pair, _)| rubbing_of(model, *pair).friction > 0.0)
}

/// The face on which the one body of an island lies, as the direction into it, where that is all it touches.
pub(super) fn lone_face(model: &Model, island: &Island) -> Option<(Pair, DVec3)> {
    match (&island.ids[..], &island.contacts[..]) {
        ([_], [(pair, Surface::Flat(towards))]) if pair.b.is_static() && model.is_ballistic() => {
            Some((*pair, *towards))
        }
        _ => None,
    }
}

/// Lets the one body of an island go on along a face.
pub(super) fn begin_on_face(
    model: &Model,
    state: &mut State,
    island: &mut Island,
    (pair, towards): (Pair, DVec3),
    time: f64,
) -> Result<(), (u32, SegmentError)> {
    let body = island.ids[0];
    let (spin, before) = (state.spin(body, time), state.turns[body as usize]);
    // What was to end here does so unless something has happened.
    let old = &state.segments[body as usize];
    let goes_on = old.end == time && before.given.is_none() && state.velocity(body, time) == island.v[0];
    level(model, state, island);
    let mut accelerations = island.free(model, time);
    let solved = enter_none(&island.links(model), &island.inverse_mass, &mut accelerations);
    state.counters.given_up += u64::from(solved.is_unmet);
    let on = OnFace {
        body,
        time,
        normal: -towards,
        load: solved.multipliers[0] * island.inverse_mass[0],
        along: accelerations[0],
        law: rubbing_of(model, pair),
        x: island.x[0],
        v: island.v[0],
        spin,
        due: if goes_on { before.due } else { Due::Nothing },
        hint: step_hint(state, body, time),
    };
    let failed = |error| (body, error);
    let going = go_on_face(model, &on, &mut state.counters.force_evaluations).map_err(failed)?;
    check(model, &going.segment).map_err(failed)?;
    book_turn(model, state, (body, on.x), (on.v, on.spin), (going.segment.v, going.turn.spin));
    let Going { segment, column, turn } = going;
    place(model, state, body, Segment { constrained: true, ..segment }, column);
    let orientation = state.turns[body as usize].orientation;
    let hold = turn.hold;
    state.turns[body as usize] = super::turn::Turn { orientation, ..turn };
    report(model, state, time, pair, before.hold, hold);
    Ok(())
}

/// Books the roundings by which velocity and spin of a body at x were brought to what sticks.
pub(super) fn book_turn(
    model: &Model,
    state: &mut State,
    (body, x): (u32, DVec3),
    before: (DVec3, DVec3),
    now: (DVec3, DVec3),
) {
    if before == now {
        return;
    }
    let (mass, inertia) = (model.mass(body), inertia(model, body));
    let (way, turn) = (now.0 - before.0, now.1 - before.1);
    let lost = -0.5 * (mass * way.dot(now.0 + before.0) + inertia * turn.dot(now.1 + before.1));
    state.account.impact_losses.add(lost);
    state.account.impulses.add(mass * way);
    state.account.angular.impulses.add(x.cross(mass * way) + inertia * turn);
}

/// Says how a body in contact goes on, once its bounces are over, if that is new.
pub(super) fn report(model: &Model, state: &mut State, time: f64, pair: Pair, before: Hold, now: Hold) {
    let is_settled = state.contact(pair).is_some_and(|contact| contact.settles_at.is_none());
    if is_settled && before != now && before != Hold::Free {
        record_contact(model, state, time, kind_of(now), pair);
    }
}

/// The event with which a body begins to go on so.
pub(super) fn kind_of(hold: Hold) -> EventKind {
    match hold {
        Hold::Rolls => EventKind::Roll,
        Hold::Rests => EventKind::Rest,
        Hold::Free | Hold::Slides => EventKind::Slide,
    }
}
