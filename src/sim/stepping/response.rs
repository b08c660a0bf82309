//! A collision: both bodies are where they meet; the law of impact, the books, a row of the ledger.

use glam::DVec3;

use super::overlap::{Hit, Partner, gap};
use super::trial;
use crate::sim::engine::{in_id_order, record};
use crate::sim::model::Model;
use crate::sim::predict::Gap;
use crate::sim::restitution::{self, Blow};
use crate::sim::state::State;
use crate::sim::{BodyRef, Event, EventKind, Fault};

/// Lets a pair bounce. Its bodies must have been moved to `hit.time`. A pair that does not close in, such as
/// a ball that lies on a floor, exchanges nothing.
pub(super) fn respond(model: &Model, state: &mut State, hit: &Hit) -> Result<(), Fault> {
    let gap = gap(model, state, hit.body, hit.partner, hit.time);
    if gap.rate >= 0.0 {
        return Ok(());
    }
    let info = &model.movers[hit.body as usize];
    let (mass, bounce) = (info.mass, info.bounce);
    match hit.partner {
        Partner::Moving(other) => {
            let second = &model.movers[other as usize];
            let blow = restitution::blow(
                restitution::reduced_mass(mass, second.mass),
                restitution::of_pair(bounce, second.bounce),
                -gap.rate,
            );
            note(model, state, hit, BodyRef::Dynamic(other), &gap, &blow);
            push(model, state, hit.body, hit.time, -blow.impulse / mass * gap.normal)?;
            push(model, state, other, hit.time, blow.impulse / second.mass * gap.normal)
        }
        Partner::Fixed(index) => {
            let fixture = &model.fixtures[index as usize];
            let blow = restitution::blow(mass, restitution::of_pair(bounce, fixture.bounce), -gap.rate);
            state.account.impulses.add(-blow.impulse * gap.normal);
            note(model, state, hit, BodyRef::Static(index), &gap, &blow);
            push(model, state, hit.body, hit.time, -blow.impulse / mass * gap.normal)
        }
    }
}

fn push(model: &Model, state: &mut State, body: u32, time: f64, change: DVec3) -> Result<(), Fault> {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    trial::begin(model, state, body, time, x, v + change)
}

fn note(model: &Model, state: &mut State, hit: &Hit, partner: BodyRef, gap: &Gap, blow: &Blow) {
    state.account.impact_losses.add(blow.loss);
    state.group += 1;
    let event = Event {
        seq: 0,
        time: hit.time,
        kind: EventKind::Impact,
        a: BodyRef::Dynamic(hit.body),
        b: Some(partner),
        point: gap.point,
        normal: gap.normal,
        impulse: blow.impulse,
        vn_before: gap.rate,
        vn_after: blow.parting,
        group: state.group,
    };
    record(state, in_id_order(model, event));
}
