//! The exchange of two bodies that meet alone, by Newton's law of restitution: booked and listed.

use glam::DVec3;

use super::account::Sum;
use super::body::BodyId;
use super::event::{Event, EventKind};
use super::geometry::restitution_at;
use super::ledger::{contact_event, in_id_order, record};
use super::model::Model;
use super::pair::Pair;
use super::predict::Gap;
use super::restitution::{Blow, blow, reduced_mass};
use super::state::State;

/// Books and lists an impact of two bodies by Newton's law, v_n' = −e v_n. Gives the impulse on the second one
/// along the normal, N·s; the first takes the opposite.
pub(super) fn exchange(model: &Model, state: &mut State, time: f64, pair: Pair, gap: &Gap) -> f64 {
    let moved = reduced_mass(mass(model, state, pair.a), mass(model, state, pair.b));
    let Blow { impulse, parting, loss } = blow(moved, restitution_at(model, pair, -gap.rate), -gap.rate);
    let impulse = impulse - impulse * excess(gap.normal);
    state.account.impact_losses.add(loss);
    let from_outside = impulse_from_outside(state, pair, impulse * gap.normal);
    state.account.impulses.add(from_outside);
    state.group += 1;
    let event = Event {
        impulse,
        vn_before: gap.rate,
        vn_after: parting,
        group: state.group,
        row_in_group: [1; 2],
        gap: gap.distance,
        ..contact_event(time, EventKind::Impact, pair, gap)
    };
    record(state, in_id_order(model, event));
    impulse
}

/// |n|² − 1 of a vector whose length is 1 but for rounding. What is taken along n, v − 2(v·n)n, keeps |v| only if it is
/// divided by |n|². At each distance at which balls touch, the root of its square rounds in a way of its own, at 1 m
/// mostly down: without this an elastic gas of such balls gains ε/2 of a ball's energy with each impact. The squares
/// are summed in all their digits, for numbers near 1 lie as far apart as what is looked for.
fn excess(normal: DVec3) -> f64 {
    let mut sum = Sum::default();
    sum.add(-1.0);
    for part in normal.to_array() {
        let square = part * part;
        sum.add(square);
        sum.add(libm::fma(part, part, -square));
    }
    sum.value()
}

/// What an impulse along the normal does to a dynamic body, m/s.
pub(super) fn velocity_change(model: &Model, state: &State, body: u32, impulse: f64, normal: DVec3) -> DVec3 {
    impulse / mass(model, state, BodyId::of_dynamic(body)) * normal
}

/// Mass with which a body answers an impulse, kg.
fn mass(model: &Model, state: &State, body: BodyId) -> f64 {
    if state.is_fixed(body) { f64::INFINITY } else { model.body(body).mass() }
}

/// Momentum that an impulse from the first body to the second brings into the system, N·s: what is fixed takes up
/// its share of it.
pub(super) fn impulse_from_outside(state: &State, pair: Pair, impulse: DVec3) -> DVec3 {
    let kept = |body: BodyId| if state.is_fixed(body) { DVec3::ZERO } else { impulse };
    kept(pair.b) - kept(pair.a)
}
