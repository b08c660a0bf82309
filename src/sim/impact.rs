//! Response to an impact: Newton's law of restitution, v' = v − (1+e)(v·n)n and its two-body form.

use glam::DVec3;

use super::engine::{begin, in_id_order, record, restart};
use super::lasting::{Hit, keep_contacts, settle};
use super::model::Model;
use super::neighbours::predict_all;
use super::predict::{Gap, hold_time};
use super::state::State;
use super::{BodyRef, Event, EventKind, Fault};

/// Two dynamic spheres exchange momentum along the line of centres.
pub(super) fn of_pair(
    model: &Model,
    state: &mut State,
    a: u32,
    b: u32,
    time: f64,
    gap: &Gap,
) -> Result<(), Fault> {
    let (info_a, info_b) = (&model.movers[a as usize], &model.movers[b as usize]);
    let natural = info_a.bounce * info_b.bounce;
    let cascades = [a, b].map(|body| note_pair_impact(model, state, body, time, natural));
    let cascade = cascades[0].max(cascades[1]);
    let closing = -gap.rate;
    let parting = parting_speed(model, natural, cascade, closing, gap);
    let reduced_mass = info_a.mass * info_b.mass / (info_a.mass + info_b.mass);
    let impulse = reduced_mass * (closing + parting);
    // ΔE = ½ μ (v_n² − v_n'²)
    state.account.impact_losses.add(0.5 * reduced_mass * (closing - parting) * (closing + parting));
    if let Some(kind) = listed_kind(cascade) {
        let event = Event {
            seq: 0,
            time,
            kind,
            a: BodyRef::Dynamic(a),
            b: Some(BodyRef::Dynamic(b)),
            point: gap.point,
            normal: gap.normal,
            impulse,
            vn_before: gap.rate,
            vn_after: parting,
            group: next_group(state),
        };
        record(state, in_id_order(model, event));
    }

    let starts = [(a, -impulse / info_a.mass), (b, impulse / info_b.mass)].map(|(body, change)| {
        let x = state.position(body, time);
        let v = state.velocity(body, time) + change * gap.normal;
        (body, x, keep_contacts(model, state, body, time, x, v))
    });
    // Both segments must stand before anything is predicted between them.
    for (body, x, v) in starts {
        begin(model, state, body, time, x, v)?;
    }
    predict_all(model, state, a, time);
    predict_all(model, state, b, time);
    Ok(())
}

/// A dynamic sphere is thrown back by a static body, or comes to rest on it.
pub(super) fn on_fixture(
    model: &Model,
    state: &mut State,
    body: u32,
    fixture: u32,
    time: f64,
    gap: &Gap,
) -> Result<(), Fault> {
    let info = &model.movers[body as usize];
    let natural = info.bounce * model.fixtures[fixture as usize].bounce;
    let cascade = if state.is_in_collapse(model, body, time) { Cascading::Goes } else { Cascading::No };
    let restitution = if cascade == Cascading::No { natural } else { natural.max(1.0) };
    let closing = -gap.rate;
    let before = state.velocity(body, time);
    let mut velocity = before - (1.0 + restitution) * closing * gap.normal;
    let position = state.position(body, time);
    let hit = Hit { time, position, velocity, closing, restitution };
    let settling = settle(model, state, body, fixture, &hit);

    if closing > 0.0
        && let Some(kind) = listed_kind(cascade)
    {
        let event = Event {
            seq: 0,
            time,
            kind,
            a: BodyRef::Dynamic(body),
            b: Some(BodyRef::Static(fixture)),
            point: gap.point,
            normal: gap.normal,
            impulse: (1.0 + restitution) * info.mass * closing,
            vn_before: gap.rate,
            vn_after: restitution * closing,
            group: next_group(state),
        };
        record(state, in_id_order(model, event));
    }
    match settling {
        Some(settling) => {
            state.contacts[body as usize].push(settling.contact);
            velocity = settling.velocity;
        }
        None => velocity = keep_contacts(model, state, body, time, position, velocity),
    }
    book_change(model, state, body, before, velocity);
    restart(model, state, body, time, position, velocity)
}

/// Books what a change of velocity at a static body took and gave.
fn book_change(model: &Model, state: &mut State, body: u32, before: DVec3, after: DVec3) {
    let mass = model.movers[body as usize].mass;
    // ½m(v² − v'²) as a product, which does not cancel.
    state.account.impact_losses.add(0.5 * mass * (before - after).dot(before + after));
    state.account.impulses.add(mass * (after - before));
}

/// Where an impact stands in a run of impacts of one body, each closely after the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Cascading {
    /// The run is short.
    No,
    /// The run reaches its limit with this impact: the rest of it must not lose energy.
    Begins,
    Goes,
}

/// Counts an impact of two moving bodies that loses energy. Others make no collapse: elastic ones go on
/// anyway, and a lone body comes to rest on what is fixed.
fn note_pair_impact(model: &Model, state: &mut State, body: u32, time: f64, restitution: f64) -> Cascading {
    if restitution >= 1.0 {
        return if state.is_in_collapse(model, body, time) { Cascading::Goes } else { Cascading::No };
    }
    let cascade = &mut state.cascades[body as usize];
    let follows = time - cascade.last_impact < model.params.contact_duration;
    cascade.length = if follows { cascade.length.saturating_add(1) } else { 0 };
    cascade.last_impact = time;
    match f64::from(cascade.length).total_cmp(&model.params.collapse_count) {
        std::cmp::Ordering::Less => Cascading::No,
        std::cmp::Ordering::Equal => Cascading::Begins,
        std::cmp::Ordering::Greater => Cascading::Goes,
    }
}

/// The ledger lists a collapse once, not the impacts without end that follow in it.
fn listed_kind(cascade: Cascading) -> Option<EventKind> {
    match cascade {
        Cascading::No => Some(EventKind::Impact),
        Cascading::Begins => Some(EventKind::Collapse),
        Cascading::Goes => None,
    }
}

/// Speed at which two moving bodies part. In a cascade no energy is lost. Bodies that are driven together
/// so hard that they would meet again at once part a little faster than e·v_n, for the hold time, but
/// never faster than they met: the energy never grows, and they do not sink into each other.
fn parting_speed(model: &Model, restitution: f64, cascade: Cascading, closing: f64, gap: &Gap) -> f64 {
    let natural = restitution * closing;
    if cascade != Cascading::No {
        return natural.max(closing);
    }
    let pressing = (-gap.bend).max(0.0);
    let shortest = pressing * hold_time(&model.params, pressing);
    if natural < shortest { closing.min(shortest).max(natural) } else { natural }
}

fn next_group(state: &mut State) -> u64 {
    state.group += 1;
    state.group
}
