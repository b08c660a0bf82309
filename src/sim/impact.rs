//! Response to an impact: of two bodies alone by Newton's law of restitution, of more as a group; and whether
//! it was the last of their bounces.

use glam::DVec3;

use super::contact::Contact;
use super::event::{Event, EventKind};
use super::exchange::{exchange, velocity_change};
use super::fault::Fault;
use super::geometry::restitution_of;
use super::group::{Group, Member, hit_just_now};
use super::island::part;
use super::ledger::{contact_event, in_id_order, rank, record};
use super::model::Model;
use super::neighbours::{a_little_after, predict_pair};
use super::pair::Pair;
use super::predict::{Gap, touch_tolerance};
use super::restart::{Start, restart};
use super::settle::{Settling, settle};
use super::state::State;

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
    let is_lone = pair.dynamic().all(|body| {
        state.contacts[body as usize].is_empty()
            && state.touching[body as usize].is_empty()
            && also.iter().all(|other| !other.involves(body))
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
            if member.pair.dynamic().any(counts) {
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

/// Whether the last bounces may have come: the full rule must decide.
fn is_near_rest(model: &Model, pair: Pair, gap: &Gap) -> bool {
    let speed = restitution_of(model, pair) * -gap.rate;
    let rounding = touch_tolerance(gap.point, model.radius(pair.first()));
    speed <= model.params.rest_speed || speed * speed <= 4.0 * gap.drive.abs() * rounding
}

/// Newton's law for two bodies that touch nothing else, which then go on.
fn bounce(model: &Model, state: &mut State, time: f64, pair: Pair, gap: &Gap) -> Result<(), Fault> {
    note_lossy(model, state, time, &[pair]);
    let impulse = exchange(model, state, time, pair, gap);
    let start = |body: u32, impulse: f64| Start {
        body,
        x: state.position(body, time),
        v: state.velocity(body, time) + velocity_change(model, body, impulse, gap.normal),
    };
    let first = start(pair.first(), -impulse);
    match pair.second() {
        None => restart(model, state, time, &[first]),
        Some(second) => {
            let second = start(second, impulse);
            restart(model, state, time, &[first, second])
        }
    }
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
    book(state, &group, &before);
    let changed = changed(&group, &before, &settling);
    keep_contacts(model, state, &group, &settling);
    restart(model, state, time, &starts_of(&group, &changed))?;
    // What neither needed an impulse nor lasts.
    for member in &group.members {
        if !changed[member.link.a] && !member.link.b.is_some_and(|b| changed[b]) {
            predict_pair(model, state, member.pair, a_little_after(time), time);
        }
    }
    Ok(())
}

/// Momentum that static bodies gave or took, and energy lost.
fn book(state: &mut State, group: &Group, before: &[DVec3]) {
    for member in group.members.iter().filter(|member| member.pair.b.is_static()) {
        state.account.impulses.add(-member.impulse * member.link.towards);
    }
    state.account.impulses.add(group.seized);
    for (k, before) in before.iter().enumerate() {
        // ½m(v² − v'²) as a product, which does not cancel.
        let after = group.bodies.v[k];
        let loss = 0.5 * (*before - after).dot(*before + after) / group.bodies.inverse_mass[k];
        state.account.impact_losses.add(loss);
    }
}

/// Which bodies of a group go on otherwise than before: by velocity, or by a contact that begins or ends.
fn changed(group: &Group, before: &[DVec3], settling: &[Settling]) -> Vec<bool> {
    let mut changed: Vec<bool> = before.iter().zip(&group.bodies.v).map(|(old, new)| old != new).collect();
    for (k, member) in group.members.iter().enumerate() {
        let made = made_of(settling, k);
        let is_new = made.is_some_and(|made| made.settles_at.is_some());
        if is_new || (member.is_lasting && made.is_none()) {
            [Some(member.link.a), member.link.b].into_iter().flatten().for_each(|body| changed[body] = true);
        }
    }
    changed
}

/// What lasts of a contact of a group.
fn made_of(settling: &[Settling], member: usize) -> Option<&Settling> {
    settling.iter().find(|settling| settling.member == member)
}

/// Enters the contacts that begin to last, and ends those that last no more.
fn keep_contacts(model: &Model, state: &mut State, group: &Group, settling: &[Settling]) {
    for (k, member) in group.members.iter().enumerate() {
        match made_of(settling, k) {
            Some(made) => make(state, member, made),
            None if member.is_lasting => part(model, state, member.pair, group.time),
            None => {}
        }
    }
}

/// The bodies of a group that are to go on anew.
fn starts_of(group: &Group, changed: &[bool]) -> Vec<Start> {
    let bodies = &group.bodies;
    let start = |k: usize| Start { body: bodies.ids[k], x: bodies.x[k], v: bodies.v[k] };
    (0..bodies.ids.len()).filter(|k| changed[*k]).map(start).collect()
}

/// Enters a lasting contact with both bodies, or what is new about an old one.
fn make(state: &mut State, member: &Member, settling: &Settling) {
    let Some(settles_at) = settling.settles_at else { return };
    for (body, other) in member.pair.ends() {
        let contacts = &mut state.contacts[body as usize];
        contacts.retain(|contact| contact.other != other);
        contacts.push(Contact { other, surface: member.surface, settles_at: Some(settles_at) });
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
    pair.dynamic().any(|body| {
        let cascade = &state.cascades[body as usize];
        f64::from(cascade.length) >= last && time - cascade.last_impact < model.params.contact_duration
    })
}

/// Counts an impact of moving bodies that loses energy. Others make no collapse: elastic ones go on anyway,
/// and a lone body comes to rest on what is fixed.
fn note_lossy(model: &Model, state: &mut State, time: f64, pairs: &[Pair]) -> Cascading {
    let lossy = pairs.iter().filter(|pair| restitution_of(model, **pair) < 1.0);
    let mut bodies: Vec<u32> = lossy.filter(|pair| !pair.b.is_static()).flat_map(Pair::dynamic).collect();
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
