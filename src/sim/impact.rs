//! Response to an impact: of two bodies alone by Newton's law of restitution, of more as a group; and whether
//! it was the last of their bounces.

use glam::DVec3;

use super::contact::{Contact, Pair, gap_of, restitution_of};
use super::engine::{a_little_after, in_id_order, look_again, rank, record};
use super::group::{Group, Member, hit_just_now};
use super::island::{From, part, restart};
use super::lasting::{Settling, settle};
use super::model::Model;
use super::motion::free_if_struck;
use super::predict::{Gap, touch_tolerance};
use super::restitution::{Blow, blow, reduced_mass};
use super::state::State;
use super::{Event, EventKind, Fault};

/// Two bodies touch while closing. `also` are impacts of the same instant, of which those connected with it
/// are resolved too and taken out.
pub(super) fn resolve(
    model: &Model,
    state: &mut State,
    time: f64,
    pair: Pair,
    gap: &Gap,
    also: &mut Vec<Pair>,
) -> Result<(), Fault> {
    for struck in std::iter::once(&pair).chain(also.iter()) {
        free_struck(model, state, time, *struck);
    }
    let is_lone = pair.bodies().all(|body| {
        state.contacts[body as usize].is_empty()
            && state.touching[body as usize].is_empty()
            && also.iter().all(|other| other.bodies().all(|other| other != body))
            && !hit_just_now(model, state, body, time)
    });
    let is_plain = !is_near_rest(model, pair, gap) && !is_in_cascade(model, state, pair, time);
    if is_lone && is_plain {
        return bounce(model, state, time, pair, gap);
    }
    let mut group = Group::gather(model, state, time, pair, also);
    if group.members.len() == 1 && is_plain {
        return bounce(model, state, time, pair, gap);
    }
    let closing: Vec<Pair> = group.still_closing().into_iter().map(|k| group.members[k].pair).collect();
    let cascading = note_lossy(model, state, time, &closing);
    if cascading != Cascading::No {
        // Only where it happens: the other end of a heap bounces as it would.
        let counts =
            |body: u32| f64::from(state.cascades[body as usize].length) >= model.params.collapse_count;
        for member in &mut group.members {
            if member.pair.bodies().any(counts) {
                member.restitution = 0.0;
            }
        }
    }
    let has_collapsed = group.resolve();
    let kind =
        if cascading == Cascading::Begins || has_collapsed { EventKind::Collapse } else { EventKind::Impact };
    list(model, state, time, &group, kind);
    finish(model, state, time, group)
}

/// Mass that an impulse between two bodies moves, kg.
fn moved_mass(model: &Model, state: &State, pair: Pair) -> f64 {
    let mass = model.movers[pair.a as usize].mass;
    match pair.other().map(|other| (other, model.movers[other as usize].mass)) {
        Some((_, other_mass)) if state.held.contains(pair.a) => other_mass,
        Some((other, _)) if state.held.contains(other) => mass,
        Some((_, other_mass)) => reduced_mass(mass, other_mass),
        None => mass,
    }
}

/// Frees held bodies that an impact would throw out.
fn free_struck(model: &Model, state: &mut State, time: f64, pair: Pair) {
    let Some(other) = pair.other() else { return };
    if !pair.bodies().any(|body| state.held.contains(body)) {
        return;
    }
    let gap = gap_of(model, state, pair, time);
    let [mass, other_mass] = [pair.a, other].map(|body| model.movers[body as usize].mass);
    let reduced = reduced_mass(mass, other_mass);
    let Blow { impulse, .. } = blow(reduced, restitution_of(model, pair), -gap.rate);
    free_if_struck(model, state, pair.a, -impulse / mass * gap.normal);
    free_if_struck(model, state, other, impulse / other_mass * gap.normal);
}

/// Whether the last bounces may have come: the full rule must decide.
fn is_near_rest(model: &Model, pair: Pair, gap: &Gap) -> bool {
    let speed = restitution_of(model, pair) * -gap.rate;
    let rounding = touch_tolerance(gap.point, model.movers[pair.a as usize].radius);
    speed <= model.params.rest_speed || speed * speed <= 4.0 * gap.drive.abs() * rounding
}

/// Newton's law for two bodies that touch nothing else, which then go on.
fn bounce(model: &Model, state: &mut State, time: f64, pair: Pair, gap: &Gap) -> Result<(), Fault> {
    note_lossy(model, state, time, &[pair]);
    let changes = exchange(model, state, time, pair, gap);
    let start = |(body, change): (u32, DVec3)| From {
        body,
        x: state.position(body, time),
        v: state.velocity(body, time) + change,
    };
    match changes {
        (first, None) => {
            let first = start(first);
            restart(model, state, time, &[first])
        }
        (first, Some(second)) => {
            let both = [start(first), start(second)];
            restart(model, state, time, &both)
        }
    }
}

/// Books and lists an impact of two bodies by Newton's law, v_n' = −e v_n. Gives the changes of their
/// velocities, of the second one if it is dynamic.
pub(super) fn exchange(
    model: &Model,
    state: &mut State,
    time: f64,
    pair: Pair,
    gap: &Gap,
) -> ((u32, DVec3), Option<(u32, DVec3)>) {
    let Blow { impulse, parting, loss } =
        blow(moved_mass(model, state, pair), restitution_of(model, pair), -gap.rate);
    state.account.impact_losses.add(loss);
    let from_outside = impulse_from_outside(state, pair, impulse * gap.normal);
    state.account.impulses.add(from_outside);
    state.group += 1;
    let event = Event {
        impulse,
        vn_before: gap.rate,
        vn_after: parting,
        group: state.group,
        ..contact_event(time, EventKind::Impact, pair, gap)
    };
    record(state, in_id_order(model, event));
    let change = |body: u32, impulse: f64| {
        let free = !state.held.contains(body);
        (body, if free { impulse / model.movers[body as usize].mass * gap.normal } else { DVec3::ZERO })
    };
    (change(pair.a, -impulse), pair.other().map(|other| change(other, impulse)))
}

/// Momentum that an impulse from the first body to the other brings into the system: what is static or held
/// takes up its share of it.
fn impulse_from_outside(state: &State, pair: Pair, impulse: DVec3) -> DVec3 {
    let is_free = |body: u32| !state.held.contains(body);
    let first = if is_free(pair.a) { -impulse } else { DVec3::ZERO };
    first + if pair.other().is_some_and(is_free) { impulse } else { DVec3::ZERO }
}

/// An event of two bodies that exchanges no impulse, not yet numbered or in the order of their ids.
pub(super) fn contact_event(time: f64, kind: EventKind, pair: Pair, gap: &Gap) -> Event {
    let (a, b) = pair.refs();
    Event { b: Some(b), normal: gap.normal, ..Event::of_one(time, kind, a, gap.point) }
}

/// Lists what a group exchanged, one row for each contact.
fn list(model: &Model, state: &mut State, time: f64, group: &Group, kind: EventKind) {
    if group.members.iter().all(|member| member.impulse <= 0.0) {
        return;
    }
    state.group += 1;
    let row = |member: &Member| {
        let event = Event {
            impulse: member.impulse,
            // not −0
            vn_before: 0.0 - member.before,
            vn_after: 0.0 - group.closing(member),
            group: state.group,
            ..contact_event(time, kind, member.pair, &member.gap)
        };
        in_id_order(model, event)
    };
    let mut rows: Vec<Event> = group.members.iter().filter(|member| member.impulse > 0.0).map(row).collect();
    rows.sort_by_key(|row| (rank(model, row.a), row.b.map(|b| rank(model, b))));
    for row in rows {
        record(state, row);
    }
}

/// Books what a group lost and was given, settles what has come to rest, and lets its bodies go on.
fn finish(model: &Model, state: &mut State, time: f64, mut group: Group) -> Result<(), Fault> {
    let before: Vec<DVec3> = group.bodies.ids.iter().map(|body| state.velocity(*body, time)).collect();
    let settling = settle(model, &mut group);
    let mut changed: Vec<bool> = before.iter().zip(&group.bodies.v).map(|(old, new)| old != new).collect();
    for (k, member) in group.members.iter().enumerate() {
        let from_outside = impulse_from_outside(state, member.pair, member.impulse * member.link.towards);
        state.account.impulses.add(from_outside);
        let made = settling.iter().find(|settling| settling.member == k);
        let is_new = made.is_some_and(|made| made.settles_at.is_some());
        if is_new || (member.is_lasting && made.is_none()) {
            [Some(member.link.a), member.link.b].into_iter().flatten().for_each(|body| changed[body] = true);
        }
        match made {
            Some(made) => make(state, member, made),
            None if member.is_lasting => part(model, state, member.pair, time),
            None => {}
        }
    }
    state.account.impulses.add(group.seized);
    for (k, before) in before.iter().enumerate() {
        // ½m(v² − v'²) as a product, which does not cancel.
        let after = group.bodies.v[k];
        if *before != after {
            let loss = 0.5 * (*before - after).dot(*before + after) / group.bodies.inverse_mass[k];
            state.account.impact_losses.add(loss);
        }
    }
    let unmoved: Vec<Pair> = group
        .members
        .iter()
        .filter(|member| !changed[member.link.a] && !member.link.b.is_some_and(|b| changed[b]))
        .map(|member| member.pair)
        .collect();
    let bodies = group.bodies;
    let starts: Vec<From> = (0..bodies.ids.len())
        .filter(|k| changed[*k])
        .map(|k| From { body: bodies.ids[k], x: bodies.x[k], v: bodies.v[k] })
        .collect();
    restart(model, state, time, &starts)?;
    // What neither needed an impulse nor lasts.
    for pair in unmoved {
        look_again(model, state, pair, a_little_after(time), time);
    }
    Ok(())
}

/// Enters a lasting contact with both bodies, or what is new about an old one.
fn make(state: &mut State, member: &Member, settling: &Settling) {
    let Some(settles_at) = settling.settles_at else { return };
    for (body, partner) in member.pair.ends() {
        let contacts = &mut state.contacts[body as usize];
        contacts.retain(|contact| contact.partner != partner);
        contacts.push(Contact { partner, surface: member.surface, settles_at: Some(settles_at) });
    }
}

/// Where an impact stands in a run of impacts of its bodies, each closely after the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Cascading {
    /// The run is short.
    No,
    /// The run reaches its limit with this impact: from now on nothing bounces.
    Begins,
    Goes,
}

/// Whether the next lossy impact of a pair may be one too many.
fn is_in_cascade(model: &Model, state: &State, pair: Pair, time: f64) -> bool {
    let last = model.params.collapse_count - 1.0;
    pair.bodies().any(|body| {
        let cascade = &state.cascades[body as usize];
        f64::from(cascade.length) >= last && time - cascade.last_impact < model.params.contact_duration
    })
}

/// Counts an impact of moving bodies that loses energy. Others make no collapse: elastic ones go on anyway,
/// and a lone body comes to rest on what is fixed.
fn note_lossy(model: &Model, state: &mut State, time: f64, pairs: &[Pair]) -> Cascading {
    let lossy = pairs.iter().filter(|pair| restitution_of(model, **pair) < 1.0);
    let mut bodies: Vec<u32> =
        lossy.filter_map(|pair| pair.other().map(|other| [pair.a, other])).flatten().collect();
    // A group is one impact to each of its bodies.
    bodies.sort_unstable();
    bodies.dedup();
    bodies.into_iter().map(|body| count(model, state, body, time)).max().unwrap_or(Cascading::No)
}

fn count(model: &Model, state: &mut State, body: u32, time: f64) -> Cascading {
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
