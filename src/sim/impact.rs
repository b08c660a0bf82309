//! Response to an impact: of two bodies alone by Newton's law of restitution, of more as a group; and whether
//! it was the last of their bounces.

use glam::DVec3;

use super::account::angular;
use super::capture::free_if_struck;
use super::contact::Contact;
use super::dense::{
    LARGE_ISLAND, Role, SMALLEST_CROWD, component, enter, is_stuck, least_crowd, least_elastic_crowd,
    may_be_crowd, note_held, note_impact, note_met, note_too_few, note_work,
};
use super::event::{Event, EventKind};
use super::exchange::{exchange, velocity_change};
use super::fault::Fault;
use super::geometry::{gap_of, restitution_at, rubbing_of, smaller_radius};
use super::group::{Group, Member, hit_just_now};
use super::island::part;
use super::ledger::{contact_event, in_id_order, rank, record, record_contact};
use super::link::Link;
use super::model::Model;
use super::neighbours::predict_later;
use super::pair::Pair;
use super::predict::{Gap, touch_tolerance};
use super::restart::{Start, restart};
use super::restitution::{Blow, blow, reduced_mass};
use super::rub::rub_pair;
use super::settle::{Settling, settle};
use super::state::State;
use super::tolerance::{FALLING, MEMORY, NEAR_REST, NO_CHANGE};

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
    let mut freed = Vec::new();
    for struck in std::iter::once(&pair).chain(also.iter()) {
        free_struck(model, state, time, *struck, &mut freed);
    }
    resolve_freed(model, state, time, pair, gap, also)?;
    // Who was not moved after all, held by others or struck elsewhere, stays captured.
    let unmoved = freed.into_iter().filter(|(body, stamp)| state.stamps[*body as usize] == *stamp);
    state.captured.extend(unmoved.map(|(body, _)| body));
    Ok(())
}

fn resolve_freed(
    model: &Model,
    state: &mut State,
    time: f64,
    pair: Pair,
    gap: &Gap,
    also: &mut Vec<Pair>,
) -> Result<(), Fault> {
    if is_stuck(model, state, pair.dynamic(), time) {
        return enter(model, state, &pair.dynamic().collect::<Vec<u32>>(), time);
    }
    if let Some(least) = least_crowd_of(model, state, pair, gap, time)
        && enter_crowd(model, state, pair, least, time)?
    {
        return Ok(());
    }
    let is_lone = pair.dynamic().all(|body| {
        state.contacts[body as usize].is_empty()
            && state.touching[body as usize].is_empty()
            && also.iter().all(|other| !other.involves(body))
            && !hit_just_now(model, state, body, time)
    });
    let is_plain = !is_near_rest(model, pair, gap) && !is_collapsing(model, state, pair, -gap.rate);
    if is_lone && is_plain {
        return bounce(model, state, time, pair, gap);
    }
    let mut group = Group::gather(model, state, time, pair, also);
    if group.members.len() == 1 && is_plain {
        return bounce(model, state, time, pair, gap);
    }
    if is_for_steps(state, &group) {
        return enter(model, state, &group.bodies.ids, time);
    }
    if group.members.iter().any(|member| member.restitution < 1.0) {
        note_work(model, state, &group.bodies.ids, time);
    }
    let kind = if collapse(model, state, &mut group) { EventKind::Collapse } else { EventKind::Impact };
    if model.plan.spin && !group.rub(model, state) && state.dense.is_some() {
        return enter(model, state, &group.bodies.ids, time);
    }
    list(model, state, time, &group, kind);
    finish(model, state, time, group)
}

/// Of how many moving bodies the component of an impact must be to be stepped; `None` if it is not. Of an elastic pair
/// both must be struck often: a large body among many small ones is, and they are not.
fn least_crowd_of(model: &Model, state: &State, pair: Pair, gap: &Gap, time: f64) -> Option<usize> {
    if restitution_at(model, pair, -gap.rate) < 1.0 {
        return pair.dynamic().filter_map(|body| least_crowd(model, state, body, time)).min();
    }
    let mut of_each = pair.dynamic().map(|body| least_elastic_crowd(model, state, body, time));
    of_each.try_fold(0, |most, least| Some(most.max(least?)))
}

/// Lets the bodies of an impact be stepped with all that they touch, if so many can move; whether they can.
fn enter_crowd(model: &Model, state: &mut State, pair: Pair, least: usize, time: f64) -> Result<bool, Fault> {
    let Some(dense) = state.dense.as_ref().filter(|_| may_be_crowd(state, pair.dynamic(), least, time))
    else {
        return Ok(false);
    };
    let bodies = component(model, state, dense, &pair.dynamic().collect::<Vec<u32>>(), time);
    let moving = bodies.iter().filter(|body| !state.captured.contains(body)).count();
    // Where bodies rub, even one between what is fixed may be struck without end.
    let is_endless = model.plan.spin && least <= SMALLEST_CROWD;
    if moving < least && !is_endless {
        note_too_few(model, state, &bodies, time);
        return Ok(false);
    }
    enter(model, state, &bodies, time)?;
    Ok(true)
}

/// Whether a group is one for steps: too large and lossy, or with a body that is stepped or lies in a stepped heap.
fn is_for_steps(state: &State, group: &Group) -> bool {
    let is_large = group.bodies.ids.len() >= LARGE_ISLAND;
    state.dense.is_some()
        && (is_large && group.members.iter().any(|member| member.restitution < 1.0)
            || group.bodies.ids.iter().any(|body| state.role(*body) != Role::Outside))
}

/// Resolves a group, plastically where it is collapsing; whether that is news.
fn collapse(model: &Model, state: &mut State, group: &mut Group) -> bool {
    let closing = group.still_closing();
    let impacts: Vec<(Pair, f64)> =
        closing.iter().map(|k| (group.members[*k].pair, group.members[*k].before)).collect();
    let mut collapsed: Vec<u32> = Vec::new();
    for k in closing {
        let member = &mut group.members[k];
        if is_collapsing(model, state, member.pair, member.before) {
            member.restitution = 0.0;
            collapsed.extend(member.pair.dynamic());
        }
    }
    remember(model, state, impacts);
    if group.resolve(model.params.collapse_share) {
        let is_lossy = |member: &&Member| {
            member.impulse > 0.0 && member.restitution < 1.0 && are_both_free(state, member.pair)
        };
        let lossy: Vec<Pair> = group.members.iter().filter(is_lossy).map(|member| member.pair).collect();
        // One pair on what is fixed comes to rest.
        if lossy.len() > 1 {
            collapsed.extend(lossy.iter().flat_map(Pair::dynamic));
        }
    }
    report_collapse(state, collapsed)
}

/// Frees captured bodies that an impact would throw out, if no other held them; adds them to a list, with the number of the
/// segment on which they stay.
fn free_struck(model: &Model, state: &mut State, time: f64, pair: Pair, freed: &mut Vec<(u32, u32)>) {
    let Some(other) = pair.second() else { return };
    if !pair.dynamic().any(|body| state.captured.contains(&body)) {
        return;
    }
    let gap = gap_of(model, state, pair, time);
    let reduced = reduced_mass(model.mass(pair.first()), model.mass(other));
    let Blow { impulse, .. } = blow(reduced, restitution_at(model, pair, -gap.rate), -gap.rate);
    for (body, impulse) in [(pair.first(), -impulse), (other, impulse)] {
        if free_if_struck(model, state, body, impulse / model.mass(body) * gap.normal) {
            freed.push((body, state.stamps[body as usize]));
        }
    }
}

/// Whether the last bounces may have come: the full rule must decide.
fn is_near_rest(model: &Model, pair: Pair, gap: &Gap) -> bool {
    let speed = restitution_at(model, pair, -gap.rate) * -gap.rate;
    let radius = smaller_radius(model, pair);
    let height = (model.params.rest_height * radius).max(touch_tolerance(gap.point, radius));
    speed * speed <= 2.0 * NEAR_REST * gap.drive.abs() * height
}

/// Newton's law for two bodies that touch nothing else, which then go on.
fn bounce(model: &Model, state: &mut State, time: f64, pair: Pair, gap: &Gap) -> Result<(), Fault> {
    remember(model, state, [(pair, -gap.rate)]);
    let is_lossy = restitution_at(model, pair, -gap.rate) < 1.0;
    for (body, other) in pair.ends() {
        note_impact(model, state, body, time, is_lossy);
        if is_lossy {
            note_met(model, state, body, other, time);
        }
    }
    let impulse = exchange(model, state, time, pair, gap);
    let start = |body: u32, impulse: f64| Start {
        body,
        x: state.position(body, time),
        v: state.velocity(body, time) + velocity_change(model, state, body, impulse, gap.normal),
    };
    let mut first = start(pair.first(), -impulse);
    let mut second = pair.second().map(|second| start(second, impulse));
    if model.plan.spin {
        let rubbed = rub_pair(model, state, time, pair, gap, impulse);
        first.v -= rubbed * state.inverse_mass(model, first.body);
        second.iter_mut().for_each(|second| second.v += rubbed * state.inverse_mass(model, second.body));
    }
    match second {
        None => restart(model, state, time, &[first]),
        Some(second) => restart(model, state, time, &[first, second]),
    }
}

/// Lists what a group exchanged, one row for each contact.
fn list(model: &Model, state: &mut State, time: f64, group: &Group, kind: EventKind) {
    if !group.members.iter().any(|member| group.is_felt(model, member)) {
        if model.plan.spin {
            // Touches that nobody feels may follow each other without end too, where friction drives them.
            group.bodies.ids.iter().for_each(|body| note_impact(model, state, *body, time, true));
        }
        return;
    }
    state.group += 1;
    for member in group.members.iter().filter(|member| group.is_felt(model, member)) {
        let is_lossy = member.restitution < 1.0;
        member.pair.dynamic().for_each(|body| note_impact(model, state, body, time, is_lossy));
    }
    let row = |member: &Member| {
        let event = Event {
            impulse: member.impulse,
            // not −0
            vn_before: 0.0 - member.before,
            vn_after: 0.0 - group.closing(member),
            group: state.group,
            gap: member.gap.distance,
            rounds: group.rounds,
            ..contact_event(time, kind, member.pair, &member.gap)
        };
        in_id_order(model, event)
    };
    let mut rows: Vec<Event> =
        group.members.iter().filter(|member| group.is_felt(model, member)).map(row).collect();
    rows.sort_by_key(|row| (rank(model, row.a), row.b.map(|b| rank(model, b))));
    let count = rows.len() as u32;
    for (nth, row) in (1..).zip(rows) {
        record(state, Event { row_in_group: [nth, count], ..row });
    }
}

/// Books what a group lost and was given, settles what has come to rest, and lets its bodies go on.
fn finish(model: &Model, state: &mut State, time: f64, mut group: Group) -> Result<(), Fault> {
    let before: Vec<DVec3> = group.bodies.ids.iter().map(|body| state.velocity(*body, time)).collect();
    group.forget_rounding(&before);
    let settling = settle(model, &mut group);
    group.forget_rounding(&before);
    book(state, &group, &before);
    if group.members.len() > 1 && group.members.iter().any(|member| member.restitution < 1.0) {
        note_held(model, state, &group.bodies.ids, time);
    }
    let mut changed = changed(&group, &before, &settling);
    if model.plan.spin {
        book_torques(state, &group);
        give_spins(model, state, &group, &mut changed);
    }
    keep_contacts(model, state, &group, &settling);
    report_slides(model, state, time, &group, &before);
    restart(model, state, time, &starts_of(&group, &changed))?;
    // What neither needed an impulse nor lasts.
    for member in &group.members {
        if !changed[member.link.a] && !member.link.b.is_some_and(|b| changed[b]) {
            predict_later(model, state, member.pair, time);
        }
    }
    Ok(())
}

/// Momentum that static and captured bodies gave or took, and energy lost.
fn book(state: &mut State, group: &Group, before: &[DVec3]) {
    // What the bodies gave each other cancels: the rest came from those that stay.
    let bodies = &group.bodies;
    for ((old, new), inverse_mass) in before.iter().zip(&bodies.v).zip(&bodies.inverse_mass) {
        if old != new {
            state.account.impulses.add((*new - *old) / *inverse_mass);
        }
    }
    state.account.impact_losses.add(group.loss);
    state.counters.given_up += group.given_up;
}

/// Angular momentum that bodies which stay gave or took.
fn book_torques(state: &mut State, group: &Group) {
    let is_fixed = |body: Option<usize>| body.is_none_or(|body| group.bodies.inverse_mass[body] == 0.0);
    for member in &group.members {
        let impulse = member.impulse * member.link.towards + member.rubbed;
        let mut kept = DVec3::ZERO;
        if is_fixed(member.link.b) {
            kept -= impulse;
        }
        if is_fixed(Some(member.link.a)) {
            kept += impulse;
        }
        state.account.angular.impulses.add(angular(member.gap.point, kept));
    }
}

/// Gives bodies the spins that friction left them; they go on anew.
fn give_spins(model: &Model, state: &mut State, group: &Group, changed: &mut [bool]) {
    let rounding = NO_CHANGE * group.fastest;
    for ((body, spin), changed) in group.bodies.ids.iter().zip(&group.spins).zip(changed) {
        let before = state.spin(*body, group.time);
        if model.radius(*body) * (*spin - before).length() > rounding {
            state.give_spin(*body, *spin);
            *changed = true;
        }
    }
}

/// Reports the lasting contacts whose bodies lay still against each other and do no longer.
fn report_slides(model: &Model, state: &mut State, time: f64, group: &Group, before: &[DVec3]) {
    let slips = |velocities: &[DVec3], link: &Link| {
        velocities[link.a] != link.b.map_or(DVec3::ZERO, |b| velocities[b])
    };
    for member in group.members.iter().filter(|member| member.is_lasting) {
        // Where bodies rub, how they go on says it.
        let lasts = state.contact(member.pair).is_some() && rubbing_of(model, member.pair).friction == 0.0;
        if lasts && !slips(before, &member.link) && slips(&group.bodies.v, &member.link) {
            record_contact(model, state, time, EventKind::Slide, member.pair);
        }
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
        contacts.push(Contact {
            other,
            surface: member.surface,
            settles_at: Some(settles_at),
            sticks: false,
        });
    }
}

/// Whether the speed at which a lossy pair of dynamic bodies closes is what an inelastic collapse leaves: step by
/// step, next to nothing of what its bodies met others with. A soft touch after a hard blow is none. Elastic pairs
/// make no collapse, and a lone body comes to rest on what is fixed.
fn is_collapsing(model: &Model, state: &State, pair: Pair, closing: f64) -> bool {
    let restitution = restitution_at(model, pair, closing);
    let falling = |body: u32| Some(state.cascades[body as usize]).filter(|cascade| cascade.since >= FALLING);
    let references = pair.dynamic().filter_map(falling).map(|cascade| cascade.reference);
    are_both_free(state, pair)
        && 0.0 < restitution
        && restitution < 1.0
        && closing <= model.params.collapse_share * references.fold(0.0, f64::max)
}

/// Whether both bodies can move.
fn are_both_free(state: &State, pair: Pair) -> bool {
    !state.is_fixed(pair.a) && !state.is_fixed(pair.b)
}

/// Remembers the impacts of dynamic bodies with each other.
fn remember(model: &Model, state: &mut State, impacts: impl IntoIterator<Item = (Pair, f64)>) {
    for (pair, closing) in impacts {
        let Some(other) = pair.second() else { continue };
        if !model.is_ballistic() {
            pair.dynamic().for_each(|body| state.cascades[body as usize].is_struck = true);
        }
        if restitution_at(model, pair, closing) >= 1.0 {
            continue;
        }
        let is_collapsing = is_collapsing(model, state, pair, closing);
        for body in [pair.first(), other] {
            let cascade = &mut state.cascades[body as usize];
            let remembered = MEMORY * cascade.reference;
            cascade.since = if closing >= remembered { 0 } else { cascade.since.saturating_add(1) };
            cascade.reference = closing.max(remembered);
            cascade.is_reported &= is_collapsing;
        }
    }
}

/// Whether a collapse of some bodies is news.
fn report_collapse(state: &mut State, bodies: impl IntoIterator<Item = u32>) -> bool {
    let mut is_news = false;
    for body in bodies {
        is_news |= !std::mem::replace(&mut state.cascades[body as usize].is_reported, true);
    }
    is_news
}
