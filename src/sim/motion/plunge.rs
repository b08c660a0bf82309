//! The way back from a point attractor: a body that turns at the core retraces the way it came.
//!
//! Motion under forces of position alone is the same backwards, so the way out is the way in, played in
//! reverse, bit by bit. Integrated anew it would not do: at the core radius the potential is some 10⁶ times
//! as deep as the energy that is to be kept, more than f64 has digits for.

use glam::DVec3;

use super::radau::extrapolate;
use crate::sim::force::Law;
use crate::sim::model::Model;
use crate::sim::segment::{Segment, Series};
use crate::sim::state::State;

/// Within so many core radii of an attractor the way is remembered. Farther off the potential is flat
/// enough to lose nothing to rounding.
const REMEMBERED: f64 = 1e4;

/// A step on the way in.
#[derive(Clone, Copy, Debug)]
struct Leg {
    segment: Segment,
    series: Series,
    /// How long it lasted, s.
    length: f64,
}

/// A body on its way into an attractor, or back.
#[derive(Clone, Debug)]
pub(in crate::sim) struct Plunge {
    legs: Vec<Leg>,
    back: Option<Turn>,
}

/// Where the next leg of the way back begins.
#[derive(Clone, Copy, Debug)]
struct Turn {
    time: f64,
    from: Point,
}

/// A start of the integrator.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub x: DVec3,
    pub low: DVec3,
    pub v: DVec3,
}

/// What comes next on the way back.
pub(super) enum Next {
    Leg(Box<(Segment, Series)>),
    /// The way back ends here, where it had begun.
    Out(Point),
}

/// Remembers the step that ends at `time` if it leads into an attractor; forgets the way if it does not.
pub(super) fn remember(model: &Model, state: &mut State, body: u32, time: f64) {
    let old = state.segments[body as usize];
    let leads_in = old.step > 0.0 && old.end == time && !old.constrained && falls_in(model, &old);
    if leads_in {
        push(state, body, time);
    } else {
        state.plunges.remove(&body);
    }
}

fn push(state: &mut State, body: u32, time: f64) {
    let segment = state.segments[body as usize];
    let leg = Leg { segment, series: state.fields[body as usize].series, length: time - segment.start };
    let plunge = state.plunges.entry(body).or_insert(Plunge { legs: Vec::new(), back: None });
    if leg.length > 0.0 {
        plunge.legs.push(leg);
    }
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

/// Turns a body back on its way at the core; false where the way cannot be retraced.
pub(in crate::sim) fn turn_back(model: &Model, state: &mut State, body: u32, time: f64) -> bool {
    let old = state.segments[body as usize];
    if old.step == 0.0 || old.constrained || !is_reversible(model) {
        return false;
    }
    let (x, low) = state.path(body).position_split(time);
    let from = Point { x, low, v: -state.velocity(body, time) };
    push(state, body, time);
    if let Some(plunge) = state.plunges.get_mut(&body) {
        plunge.back = Some(Turn { time, from });
    }
    true
}

/// The next step of a body on its way back; `None` for one that is not, or was disturbed.
pub(super) fn next(state: &mut State, body: u32, time: f64, v: DVec3) -> Option<Next> {
    let turn = state.plunges.get(&body)?.back?;
    let now = state.velocity(body, time);
    if turn.time != time || state.segments[body as usize].step == 0.0 || (v != now && v != -now) {
        state.plunges.remove(&body);
        return None;
    }
    let plunge = state.plunges.get_mut(&body)?;
    let Some(leg) = plunge.legs.pop() else {
        state.plunges.remove(&body);
        return Some(Next::Out(turn.from));
    };
    let reversed = leg.reversed(time, &turn.from);
    let from = Point { x: leg.segment.x, low: leg.series.low, v: -leg.segment.v };
    plunge.back = Some(Turn { time: reversed.0.end, from });
    Some(Next::Leg(Box::new(reversed)))
}

impl Leg {
    /// The same way from its end to its start: a'(s) = a(1 − s).
    fn reversed(&self, time: f64, from: &Point) -> (Segment, Series) {
        let mut part = self.series;
        let share = self.length / self.segment.step;
        let mut power = 1.0;
        for b in &mut part.b {
            power *= share;
            *b *= power;
        }
        let series = Series { low: from.low, ..extrapolate(&part, -1.0) };
        let segment = Segment {
            start: time,
            end: time + self.length,
            x: from.x,
            v: from.v,
            a: self.segment.a + part.acceleration_term(1.0),
            step: self.length,
            ..self.segment
        };
        (segment, series)
    }
}
