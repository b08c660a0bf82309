//! The way back from a point attractor: a body that turns at the core retraces the way it came.
//!
//! Motion under forces of position alone is the same backwards, so the way out is the way in, played in
//! reverse, bit by bit. Integrated anew it would not do: at the core radius the potential is some 10⁶ times
//! as deep as the energy that is to be kept, more than f64 has digits for.

use glam::DVec3;

use super::collocation::{beginning, extrapolate};
use super::tolerance::REMEMBERED;
use crate::sim::force::Law;
use crate::sim::model::Model;
use crate::sim::place::Place;
use crate::sim::segment::{Segment, Series};
use crate::sim::state::State;
use crate::sim::way_in::{Leg, Plunge, Point, Turn};

/// How a body in a field goes on.
pub(super) enum Onward {
    /// By the next step of its way back.
    Back(Box<(Segment, Series)>),
    /// By a step of the integrator.
    On(Point),
}

/// How a body goes on from (x, v). What it does is remembered if it leads into an attractor.
pub(super) fn way_on(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    (x, v): (DVec3, DVec3),
) -> Onward {
    if let Some(way) = way_back(state, body, time, v) {
        return way;
    }
    remember(model, state, body, time);
    let path = state.path(body);
    let place = path.place(time);
    let goes_on = path.series.is_some() && place.x == x;
    Onward::On(Point { place: if goes_on { place } else { Place::exact(x) }, v })
}

/// Turns a body back on its way at the core; false where the way can't be retraced.
pub(in crate::sim) fn turn_back(model: &Model, state: &mut State, body: u32, time: f64) -> bool {
    let old = &state.segments[body as usize];
    if old.step == 0.0 || old.constrained || !is_reversible(model) {
        return false;
    }
    let from = Point { place: state.path(body).place(time), v: -state.velocity(body, time) };
    push(state, body, time).back = Some(Turn { time, from });
    true
}

/// Remembers the step that ends at `time` if it leads into an attractor; forgets the way if it does not.
fn remember(model: &Model, state: &mut State, body: u32, time: f64) {
    let old = &state.segments[body as usize];
    if old.step > 0.0 && old.end == time && !old.constrained && falls_in(model, old) {
        push(state, body, time);
    } else {
        state.plunges.remove(&body);
    }
}

fn push(state: &mut State, body: u32, time: f64) -> &mut Plunge {
    let segment = state.segments[body as usize];
    let leg = Leg { segment, series: state.fields[body as usize].series, length: time - segment.start };
    let plunge = state.plunges.entry(body).or_default();
    if leg.length > 0.0 {
        plunge.legs.push(leg);
    }
    plunge
}

fn falls_in(model: &Model, segment: &Segment) -> bool {
    let reach = REMEMBERED * model.params.core_radius;
    is_reversible(model)
        && model.forces.iter().any(|force| match force.law {
            Law::Point { center, intensity } if intensity > 0.0 => {
                let inward = center - segment.x;
                inward.length_squared() < reach * reach && inward.dot(segment.v) >= 0.0
            }
            _ => false,
        })
}

/// Whether all forces depend on the position alone.
fn is_reversible(model: &Model) -> bool {
    model.forces.iter().all(|force| matches!(force.law, Law::Point { .. }) || force.law.is_uniform())
}

/// The next step of a body on its way back, or where that ends; `None` for one that is not, or was disturbed.
fn way_back(state: &mut State, body: u32, time: f64, v: DVec3) -> Option<Onward> {
    let turn = state.plunges.get(&body)?.back?;
    let now = state.velocity(body, time);
    if turn.time != time || state.segments[body as usize].step == 0.0 || (v != now && v != -now) {
        state.plunges.remove(&body);
        return None;
    }
    let plunge = state.plunges.get_mut(&body)?;
    let Some(leg) = plunge.legs.pop() else {
        state.plunges.remove(&body);
        return Some(Onward::On(turn.from));
    };
    let reversed = reversed(&leg, time, &turn.from);
    let from = Point { place: Place { x: leg.segment.x, low: leg.series.low }, v: -leg.segment.v };
    plunge.back = Some(Turn { time: reversed.0.end, from });
    Some(Onward::Back(Box::new(reversed)))
}

/// The same way from its end to its start: a'(s) = a(1 − s).
fn reversed(leg: &Leg, time: f64, from: &Point) -> (Segment, Series) {
    let part = beginning(&leg.series, leg.length / leg.segment.step);
    let series = Series { low: from.place.low, ..extrapolate(&part, -1.0) };
    let segment = Segment {
        start: time,
        end: time + leg.length,
        x: from.place.x,
        v: from.v,
        a: leg.segment.a + part.acceleration_term(1.0),
        step: leg.length,
        ..leg.segment
    };
    (segment, series)
}
