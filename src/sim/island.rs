//! Islands: dynamic bodies connected by lasting contacts, which move together. A body that touches static
//! bodies only is an island of its own.

use std::collections::BTreeSet;

use glam::DVec3;

use super::account::angular;
use super::constraint::{enter_none, enter_none_from, hold_from, stay_on};
use super::event::EventKind;
use super::geometry::{BodiesAt, part_of, sees_part, surface_of};
use super::ledger::record_contact;
use super::link::{Link, Solved};
use super::loads::Loads;
use super::model::Model;
use super::motion::{CoupledStart, SegmentError, Step, check, coupled_step, place, step_hint};
use super::pair::Pair;
use super::place::Place;
use super::segment::{Path, SERIES, Segment};
use super::shape::{Part, Surface};
use super::state::State;
use super::tolerance::{LEAST_OF_STEP, PRESSURE_ROUNDING, PRESSURE_SAMPLES};

/// Bodies of one island at one time, in the order of their indices.
#[derive(Clone, Debug, Default)]
pub(super) struct Island {
    pub ids: Vec<u32>,
    pub x: Vec<DVec3>,
    pub v: Vec<DVec3>,
    pub contacts: Vec<(Pair, Surface)>,
    pub inverse_mass: Vec<f64>,
}

/// All bodies connected to the given ones by lasting contacts, and these, in the order of their indices.
pub(super) fn connected(state: &State, bodies: impl IntoIterator<Item = u32>) -> Vec<u32> {
    let mut waiting: Vec<u32> = bodies.into_iter().collect();
    let mut found: BTreeSet<u32> = waiting.iter().copied().collect();
    while let Some(body) = waiting.pop() {
        for contact in &state.contacts[body as usize] {
            if let Some(other) = contact.other.dynamic()
                && found.insert(other)
            {
                waiting.push(other);
            }
        }
    }
    found.into_iter().collect()
}

/// Splits bodies, closed under contact, into islands.
pub(super) fn islands(state: &State, bodies: &[u32]) -> Vec<Vec<u32>> {
    let mut seen = BTreeSet::new();
    let mut all = Vec::new();
    for body in bodies {
        if !seen.contains(body) {
            let island = connected(state, [*body]);
            seen.extend(island.iter().copied());
            all.push(island);
        }
    }
    all
}

impl Island {
    /// The island of some bodies, each where `from` says.
    pub fn new(model: &Model, state: &State, ids: Vec<u32>, from: impl Fn(u32) -> (DVec3, DVec3)) -> Self {
        let (x, v): (Vec<_>, Vec<_>) = ids.iter().map(|body| from(*body)).unzip();
        let inverse_mass = ids.iter().map(|body| state.inverse_mass(model, *body)).collect();
        let contacts = contacts_of(state, &ids);
        Self { ids, x, v, contacts, inverse_mass }
    }

    /// The island of some bodies at a time on their present segments.
    pub fn at(model: &Model, state: &State, ids: Vec<u32>, time: f64) -> Self {
        Self::new(model, state, ids, |body| (state.position(body, time), state.velocity(body, time)))
    }

    pub fn links(&self, model: &Model) -> Vec<Link> {
        links_of(model, &self.ids, &self.contacts, &self.x, &self.v)
    }

    /// Accelerations under the applied forces alone.
    pub fn free(&self, model: &Model, time: f64) -> Vec<DVec3> {
        free(model, &self.ids, &self.inverse_mass, time, (&self.x, &self.v))
    }

    /// Which of the contacts are still pressed, in their order.
    fn held(&self, model: &Model, time: f64, loads: &mut Loads) -> Vec<bool> {
        let links = self.links(model);
        let mut motion = self.free(model, time);
        let solved = enter_none_from(loads, &links, &self.inverse_mass, &mut motion);
        pressed(&links, &solved, &self.inverse_mass, &motion)
    }
}

/// Which links do not part by an acceleration, of bodies on which any link presses: such as fall side by side are
/// not in contact.
pub(super) fn pressed(links: &[Link], solved: &Solved, inverse_mass: &[f64], motion: &[DVec3]) -> Vec<bool> {
    let rounding = |link: &Link| PRESSURE_ROUNDING * solved.size(link);
    let loaded = loaded(links, solved, inverse_mass);
    let shares = |link: &Link| {
        links.iter().zip(&loaded).any(|(other, is_loaded)| *is_loaded && other.shares_body(link))
    };
    let parts = |link: &Link| link.limit - link.entering(motion) > rounding(link);
    links.iter().map(|link| !parts(link) && shares(link)).collect()
}

/// On which links a force acts that is more than rounding.
fn loaded(links: &[Link], solved: &Solved, inverse_mass: &[f64]) -> Vec<bool> {
    let is_loaded = |(link, load): (&Link, &f64)| {
        load * link.response(link, inverse_mass) > PRESSURE_ROUNDING * solved.size(link)
    };
    links.iter().zip(&solved.multipliers).map(is_loaded).collect()
}

/// The largest of some accelerations and of what keeps the bodies on curved surfaces.
pub(super) fn largest(accelerations: &[DVec3], links: &[Link]) -> f64 {
    accelerations.iter().map(|a| a.length()).chain(links.iter().map(|link| link.limit)).fold(0.0, f64::max)
}

fn contacts_of(state: &State, ids: &[u32]) -> Vec<(Pair, Surface)> {
    let mut contacts = Vec::new();
    for body in ids {
        for contact in &state.contacts[*body as usize] {
            let pair = Pair::of(*body, contact.other);
            if pair.first() == *body {
                contacts.push((pair, contact.surface));
            }
        }
    }
    contacts
}

fn links_of(model: &Model, ids: &[u32], contacts: &[(Pair, Surface)], x: &[DVec3], v: &[DVec3]) -> Vec<Link> {
    let bodies = BodiesAt { ids, x, v };
    contacts.iter().map(|(pair, surface)| bodies.link(model, *pair, *surface)).collect()
}

/// Accelerations under the applied forces alone; nothing moves a body without inverse mass.
pub(super) fn free(
    model: &Model,
    ids: &[u32],
    inverse_mass: &[f64],
    time: f64,
    (x, v): (&[DVec3], &[DVec3]),
) -> Vec<DVec3> {
    let driven = |((body, x), v): ((&u32, &DVec3), &DVec3)| {
        model.applied_acceleration(&model.subject(*body, time, Place::exact(*x), *v))
    };
    let bodies = ids.iter().zip(x).zip(v).zip(inverse_mass);
    bodies.map(|(at, inverse)| if *inverse > 0.0 { driven(at) } else { DVec3::ZERO }).collect()
}

/// Drops the contacts of an island that nothing presses together any more, and brings the others up to date
/// (a body rolls from an edge onto the face).
pub(super) fn drop_unpressed(model: &Model, state: &mut State, island: &Island, time: f64) {
    for (held, (pair, _)) in island.held(model, time, &mut Loads::default()).into_iter().zip(&island.contacts)
    {
        if !held {
            part(model, state, *pair, time);
        }
    }
    for (body, x) in island.ids.iter().zip(&island.x) {
        for contact in &mut state.contacts[*body as usize] {
            if contact.other.is_static() && contact.surface == Surface::Round {
                contact.surface = surface_of(model, contact.other, *x);
            }
        }
    }
}

/// Ends a lasting contact, and says so.
pub(super) fn part(model: &Model, state: &mut State, pair: Pair, time: f64) {
    let mut listed = false;
    for (body, other) in pair.ends() {
        state.contacts[body as usize].retain(|contact| {
            listed |= contact.other == other;
            contact.other != other
        });
    }
    if listed {
        record_contact(model, state, time, EventKind::LiftOff, pair);
    }
}

/// Lets an island go on: books the old segments of its bodies and begins new ones. Bodies that rest or
/// slide on flat faces, without moving against each other, go on along parabolas, and what is still stays. Others, and
/// all that move in fields, are integrated together.
pub(super) fn begin_island(
    model: &Model,
    state: &mut State,
    island: &mut Island,
    time: f64,
) -> Result<(), (u32, SegmentError)> {
    level(model, state, island);
    let links = island.links(model);
    let mut accelerations = island.free(model, time);
    let solved = enter_none(&links, &island.inverse_mass, &mut accelerations);
    state.counters.given_up += u64::from(solved.is_unmet);
    let goes_on = is_still(model, island, &accelerations) || is_steady(model, island, &links, &accelerations);
    let steps: Vec<Step> = if goes_on {
        let rows = island.x.iter().zip(&island.v).zip(&accelerations);
        rows.map(|((x, v), a)| (Segment::ballistic(time, *x, *v, *a), None)).collect()
    } else {
        let parts = parts_of(model, island);
        let start =
            Pressed { loaded: &loaded(&links, &solved, &island.inverse_mass), loads: &solved.multipliers };
        let steps = integrated(model, state, island, time, &parts, start)?;
        match part_ends(model, island, &parts, &steps) {
            None => steps,
            Some(end) if end > time + LEAST_OF_STEP * steps[0].0.step => until(steps, end),
            // Where the border of two parts lies at the very start, no step across it is short enough: one up to it.
            Some(end) => match integrated(model, state, island, time, &[], start) {
                Err((_, SegmentError::Stalled)) if end > time => until(steps, end),
                across => across?,
            },
        }
    };
    for (body, (segment, _)) in island.ids.iter().zip(&steps) {
        check(model, segment).map_err(|error| (*body, error))?;
    }
    for ((body, (segment, column)), size) in island.ids.iter().zip(steps).zip(solved.sizes) {
        let segment = Segment { constrained: true, acceleration_size: size, ..segment };
        place(model, state, *body, segment, column);
    }
    Ok(())
}

/// Takes the rounding out of velocities: contacts that the bodies leave or enter have been dropped.
pub(super) fn level(model: &Model, state: &mut State, island: &mut Island) {
    let at_rest: Vec<Link> =
        island.links(model).into_iter().map(|link| Link { limit: 0.0, ..link }).collect();
    let before = island.v.clone();
    stay_on(&at_rest, &island.inverse_mass, &mut island.v);
    book(state, island, &before);
}

/// The same steps, of which only the beginning counts.
fn until(steps: Vec<Step>, end: f64) -> Vec<Step> {
    steps.into_iter().map(|(segment, column)| (Segment { end, ..segment }, column)).collect()
}

/// The edge or corner that each contact of an island lies on, in their order, where it is one of several of its shape.
pub(super) fn parts_of(model: &Model, island: &Island) -> Vec<Option<Part>> {
    let part = |(pair, surface): &(Pair, Surface)| {
        let at = island.ids.binary_search(&pair.first()).ok().map(|row| island.x[row])?;
        (*surface == Surface::Round && pair.b.is_static()).then(|| part_of(model, pair.b, at))?
    };
    island.contacts.iter().map(part).collect()
}

/// How the contacts of an island are pressed at the start of a step.
#[derive(Clone, Copy)]
struct Pressed<'a> {
    loaded: &'a [bool],
    loads: &'a [f64],
}

/// One step of the integrator for the bodies of an island, on the parts of the shapes on which they are now: beyond these
/// the way would bend, where no polynomial follows it. What bears a load at the start is held; the others may part, for
/// together they may allow no motion at all: of two balls that fill a slot, one pressed on the other, the one that is
/// carried along must be free to leave its wall.
fn integrated(
    model: &Model,
    state: &mut State,
    island: &Island,
    time: f64,
    parts: &[Option<Part>],
    start_pressed: Pressed<'_>,
) -> Result<Vec<Step>, (u32, SegmentError)> {
    let hint = step_hint(state, island.ids[0], time);
    let Island { ids, x, v, contacts, inverse_mass } = island;
    let start = CoupledStart { model, ids, time, x, v, hint, longest: f64::INFINITY, noise: 1.0 };
    // Of each node, once it was looked at; at first those of the node before.
    let mut loads_at: [Option<Loads>; SERIES + 1] = Default::default();
    let Pressed { loaded, loads } = start_pressed;
    let mut last = Loads::from(loads);
    let step = coupled_step(&start, &mut state.counters.force_evaluations, |node, time, x, v| {
        let mut motion = free(model, ids, inverse_mass, time, (x, v));
        let bodies = BodiesAt { ids, x, v };
        let parts = parts.iter().map(Option::as_ref).chain(std::iter::repeat(None));
        let links: Vec<Link> = (contacts.iter().zip(parts))
            .map(|((pair, surface), part)| bodies.link_on(model, *pair, *surface, part))
            .collect();
        let size = largest(&motion, &links);
        let loads = loads_at[node].get_or_insert_with(|| last.clone());
        hold_from(loads, &links, loaded, inverse_mass, &mut motion);
        last.clone_from(loads);
        (motion, size)
    });
    step.map_err(|error| (ids[0], error))
}

/// First time at which a body of an island has rolled off the part of a shape on which its step began.
pub(super) fn part_ends(
    model: &Model,
    island: &Island,
    parts: &[Option<Part>],
    steps: &[Step],
) -> Option<f64> {
    if parts.iter().all(Option::is_none) {
        return None;
    }
    let all_seen = |time: f64| {
        island.contacts.iter().zip(parts).all(|((pair, _), part)| {
            let (Some(part), Ok(row)) = (part, island.ids.binary_search(&pair.first())) else { return true };
            let (segment, column) = &steps[row];
            let path = Path { segment, series: column.as_ref().map(|column| &column.series) };
            sees_part(model, pair.b, part, path.position(time))
        })
    };
    let segment = &steps.first()?.0;
    first_failing(segment.start, segment.end - segment.start, all_seen)
}

/// Books what the surfaces took of velocities that pointed into them or away.
fn book(state: &mut State, island: &Island, before: &[DVec3]) {
    let turns = !state.turns.is_empty();
    for (row, (old, new)) in before.iter().zip(&island.v).enumerate() {
        if old != new {
            let (way, inverse_mass) = (*new - *old, &island.inverse_mass[row]);
            state.account.impulses.add(way / *inverse_mass);
            if turns {
                state.account.angular.impulses.add(angular(island.x[row], way / *inverse_mass));
            }
            state.account.impact_losses.add(-0.5 * way.dot(*new + *old) / *inverse_mass);
        }
    }
}

/// Whether an island at rest stays so: nothing about its forces depends on time.
fn is_still(model: &Model, island: &Island, accelerations: &[DVec3]) -> bool {
    island.v.iter().chain(accelerations).all(|way| *way == DVec3::ZERO) && !model.may_depend_on_time()
}

/// Whether nothing about the contacts and forces of an island will change along parabolas.
fn is_steady(model: &Model, island: &Island, links: &[Link], accelerations: &[DVec3]) -> bool {
    let still = |link: &Link, (_, surface): &(Pair, Surface)| match link.b {
        None => matches!(surface, Surface::Flat(_)),
        Some(b) => island.v[link.a] == island.v[b] && accelerations[link.a] == accelerations[b],
    };
    model.is_ballistic() && links.iter().zip(&island.contacts).all(|(link, contact)| still(link, contact))
}

/// First time on their present segments at which some contacts of an island are no longer pressed, and
/// which. On parabolas that never happens.
pub(super) fn first_parting(model: &Model, state: &State, ids: &[u32]) -> Option<(f64, Vec<Pair>)> {
    let segment = &state.segments[*ids.first()? as usize];
    if segment.step == 0.0 {
        return None;
    }
    let mut loads = Loads::default();
    let mut lost = |time: f64| -> Vec<Pair> {
        let island = Island::at(model, state, ids.to_vec(), time);
        let held = island.held(model, time, &mut loads);
        held.into_iter().zip(island.contacts).filter(|(held, _)| !held).map(|(_, (pair, _))| pair).collect()
    };
    let time = first_failing(segment.start, segment.step, |time| lost(time).is_empty())?;
    Some((time, lost(time)))
}

/// The first time in a segment of this length at which `holds` no longer holds, as some looks on the way see it.
pub(super) fn first_failing(start: f64, length: f64, mut holds: impl FnMut(f64) -> bool) -> Option<f64> {
    let mut low = start;
    for sample in 1..=PRESSURE_SAMPLES {
        let high = start + length * f64::from(sample) / f64::from(PRESSURE_SAMPLES);
        if !holds(high) {
            return Some(bisect(low, high, &mut holds));
        }
        low = high;
    }
    None
}

/// The earliest representable time in low..=high at which `holds` no longer holds.
fn bisect(mut low: f64, mut high: f64, mut holds: impl FnMut(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if holds(middle) { low = middle } else { high = middle }
    }
}
