//! Impact groups: the contacts of bodies that touch, resolved together.
//!
//! Generalized reflections (Smith, Kaufman, Vouga, Tamstorf & Grinspun 2012, "Reflections on simultaneous
//! impact"): in each round all contacts that close are taken at once. The nearest velocity that enters none
//! of them, in the kinetic metric, has multipliers λ ≥ 0; the elastic outcome is the mirror image of the
//! velocity in it, v' = v − 2 M⁻¹Nᵀλ. Rounds go on until nothing closes. That keeps energy, momentum and
//! every symmetry of the group, and hands one ball on for one through a row of touching ones.
//!
//! With restitution e < 1 there is no unique answer. The rule here: contacts of a round that are connected
//! through moving bodies share one e̅, v' = v − (1 + e̅) M⁻¹Nᵀλ, with e̅² the mean of e² weighted with the
//! energy λ·c that each contact takes up (c the closing speed). Such a round loses ½(1 − e̅²) Σ λc ≥ 0, and a
//! contact alone obeys Newton's law. Where every e is 0, and where closing speeds have become rounding, all
//! contacts of the group are taken at once and plastically (Moreau).

use glam::DVec3;

use super::body::BodyId;
use super::constraint::{Link, enter_none};
use super::geometry::{BodiesAt, gap_of, restitution_of, surface_of};
use super::island::Island;
use super::model::Model;
use super::neighbours::near;
use super::pair::Pair;
use super::predict::Gap;
use super::shape::Surface;
use super::state::State;
use super::tolerance::{CLOSING_ROUNDING, LARGEST_REST, SAME_INSTANT, SMALLEST_SHARE};

/// Bodies that touch, at the time of an impact.
pub(super) struct Group {
    pub bodies: Island,
    pub members: Vec<Member>,
    /// s.
    pub time: f64,
    /// Momentum taken by what is fixed where bodies seize, kg·m/s.
    pub seized: DVec3,
}

/// One contact of a group.
pub(super) struct Member {
    pub pair: Pair,
    pub surface: Surface,
    pub gap: Gap,
    pub restitution: f64,
    pub is_lasting: bool,
    /// As a bound on velocities.
    pub link: Link,
    /// Closing speed before, m/s.
    pub before: f64,
    /// N·s.
    pub impulse: f64,
}

impl Group {
    /// The group of an impact: what touches its bodies, what touches those, and so on. `also` are impacts
    /// due at the same instant; those that belong to the group are taken out of it.
    ///
    /// Who lies against whom is known, and so is what closes now. That a body about to be thrown back also
    /// touches something behind it shows when it hits that in the same instant: then all that is near is
    /// looked at.
    pub fn gather(model: &Model, state: &State, time: f64, first: Pair, also: &mut Vec<Pair>) -> Self {
        let mut pairs = vec![first];
        let mut ids: Vec<u32> = first.dynamic().collect();
        let again = ids.iter().any(|body| hit_just_now(model, state, *body, time));
        let mut next = 0;
        while let Some(body) = ids.get(next).copied() {
            let near = if again { near(model, state, body) } else { Vec::new() };
            for pair in touching(model, state, body, time, &near, also) {
                if !pairs.contains(&pair) {
                    pairs.push(pair);
                }
                for other in pair.dynamic() {
                    if !ids.contains(&other) {
                        ids.push(other);
                    }
                }
            }
            next += 1;
        }
        ids.sort_unstable();
        pairs.sort_unstable();
        let bodies = Island::at(model, state, ids, time);
        let members = pairs.into_iter().map(|pair| member(model, state, &bodies, pair, time)).collect();
        Self { bodies, members, time, seized: DVec3::ZERO }
    }

    /// The contacts as bounds on accelerations at the present velocities.
    pub fn acceleration_links(&self, model: &Model) -> Vec<Link> {
        let bodies = BodiesAt { ids: &self.bodies.ids, x: &self.bodies.x, v: &self.bodies.v };
        self.members.iter().map(|member| bodies.link(model, member.pair, member.surface)).collect()
    }

    /// Closing speed of a contact now, m/s.
    pub fn closing(&self, member: &Member) -> f64 {
        member.link.entering(&self.bodies.v)
    }

    /// The rounding of a closing speed: below it nothing closes.
    pub fn rounding(&self, member: &Member) -> f64 {
        let speed = |body: usize| self.bodies.v[body].length();
        CLOSING_ROUNDING * (speed(member.link.a) + member.link.b.map_or(0.0, speed))
    }

    /// Rounds of reflections until nothing closes; whether they went on so long that it is an inelastic
    /// collapse of several pairs of moving bodies. What is left when there would be no end is taken
    /// plastically.
    pub fn resolve(&mut self) -> bool {
        let largest = self.members.iter().map(|member| member.before).fold(0.0, f64::max);
        let mut rounds = 0;
        while rounds < 100 + 20 * self.members.len() {
            let closing = self.still_closing();
            let Some(worst) = closing.iter().map(|k| self.closing(&self.members[*k])).reduce(f64::max) else {
                return self.has_collapsed(rounds);
            };
            let is_plastic = self.members.iter().all(|member| member.restitution == 0.0);
            if is_plastic || worst <= SMALLEST_SHARE * largest {
                break;
            }
            for connected in self.split(&closing) {
                self.reflect(&connected);
            }
            rounds += 1;
        }
        self.take_up();
        self.has_collapsed(rounds)
    }

    /// Whether pairs of moving bodies that lose energy met more often than a blow takes to run through the
    /// group and back.
    fn has_collapsed(&self, rounds: usize) -> bool {
        let lossy = |member: &&Member| member.pair.second().is_some() && member.restitution < 1.0;
        rounds > 4 + 2 * self.members.len() && self.members.iter().filter(lossy).count() > 1
    }

    /// Which of the members close now.
    pub fn still_closing(&self) -> Vec<usize> {
        let closes = |member: &Member| self.closing(member) > self.rounding(member);
        (0..self.members.len()).filter(|k| closes(&self.members[*k])).collect()
    }

    /// Splits contacts into those that share moving bodies, directly or through others.
    fn split(&self, contacts: &[usize]) -> Vec<Vec<usize>> {
        let mut sets: Vec<Vec<usize>> = Vec::new();
        for k in contacts {
            let shares = |other: &usize| self.members[*k].link.shares_body(&self.members[*other].link);
            let (mut joined, rest): (Vec<_>, Vec<_>) =
                sets.into_iter().partition(|set| set.iter().any(shares));
            joined.push(vec![*k]);
            let mut set = joined.concat();
            set.sort_unstable();
            sets = rest;
            sets.push(set);
        }
        sets.sort_unstable();
        sets
    }

    /// Throws connected contacts back, all at once.
    fn reflect(&mut self, contacts: &[usize]) {
        let links: Vec<Link> = contacts.iter().map(|k| self.members[*k].link).collect();
        let closing: Vec<f64> = links.iter().map(|link| link.entering(&self.bodies.v)).collect();
        let multipliers = enter_none(&links, &self.bodies.inverse_mass, &mut self.bodies.v.clone());
        let taken = || multipliers.iter().zip(&closing).map(|(multiplier, closing)| multiplier * closing);
        let total: f64 = taken().sum();
        let first = self.members[contacts[0]].restitution;
        let restitution = if contacts.iter().all(|k| self.members[*k].restitution == first) {
            first
        } else {
            let restitutions = contacts.iter().map(|k| self.members[*k].restitution);
            (restitutions.zip(taken()).map(|(e, taken)| e * e * taken).sum::<f64>() / total).sqrt()
        };
        for ((k, link), multiplier) in contacts.iter().zip(links).zip(multipliers) {
            let impulse = (1.0 + restitution) * multiplier;
            link.push(&mut self.bodies.v, &self.bodies.inverse_mass, impulse);
            self.members[*k].impulse += impulse;
        }
    }

    /// Takes all that closes, plastically.
    fn take_up(&mut self) {
        let largest = self.members.iter().map(|member| member.before).fold(0.0, f64::max);
        let links: Vec<Link> = self.members.iter().map(|member| member.link).collect();
        let multipliers = enter_none(&links, &self.bodies.inverse_mass, &mut self.bodies.v);
        for (member, multiplier) in self.members.iter_mut().zip(multipliers) {
            member.impulse += multiplier;
        }
        self.seize(LARGEST_REST * largest);
    }

    /// Stops what still closes faster than `speed`. Bodies wedged along one line, with normals that differ in
    /// the eighth digit, would take impulses beyond all digits: they go on as one body, or not at all where
    /// they touch something fixed.
    fn seize(&mut self, speed: f64) {
        let mut stuck: Vec<usize> = Vec::new();
        // Each pass adds a contact at least.
        for _ in 0..self.members.len() {
            let still = self.still_closing();
            let closing: Vec<usize> =
                still.into_iter().filter(|k| self.closing(&self.members[*k]) > speed).collect();
            if closing.is_empty() {
                return;
            }
            stuck.extend(closing);
            stuck.sort_unstable();
            stuck.dedup();
            for connected in self.split(&stuck) {
                self.stop(&connected);
            }
        }
    }

    /// Gives the bodies of connected contacts one velocity.
    fn stop(&mut self, contacts: &[usize]) {
        let links = contacts.iter().map(|k| self.members[*k].link);
        let mut bodies: Vec<usize> = links.flat_map(|link| [Some(link.a), link.b]).flatten().collect();
        bodies.sort_unstable();
        bodies.dedup();
        let is_fixed = |member: &Member| member.link.b.is_none() && bodies.contains(&member.link.a);
        let mass = |body: &usize| 1.0 / self.bodies.inverse_mass[*body];
        let momentum: DVec3 = bodies.iter().map(|body| mass(body) * self.bodies.v[*body]).sum();
        let common = if self.members.iter().any(is_fixed) {
            self.seized -= momentum;
            DVec3::ZERO
        } else {
            momentum / bodies.iter().map(mass).sum::<f64>()
        };
        for body in bodies {
            self.bodies.v[body] = common;
        }
    }
}

/// Contacts of one body: lasting ones, bodies that lie against it, and impacts of this instant.
fn touching(
    model: &Model,
    state: &State,
    body: u32,
    time: f64,
    nearby: &[BodyId],
    also: &mut Vec<Pair>,
) -> Vec<Pair> {
    let lasting = state.contacts[body as usize].iter().map(|contact| Pair::of(body, contact.other));
    let against =
        state.touching[body as usize].iter().map(|other| Pair::of(body, BodyId::of_dynamic(*other)));
    let near = |pair: &Pair| gap_of(model, state, *pair, time).distance <= model.params.contact_distance;
    let nearby = nearby.iter().map(|other| Pair::of(body, *other));
    let mut pairs: Vec<Pair> = lasting.chain(against.chain(nearby).filter(near)).collect();
    also.retain(|pair| {
        let is_its = pair.involves(body);
        if is_its {
            pairs.push(*pair);
        }
        !is_its
    });
    pairs
}

/// Whether a body began its present motion in this instant, at an impact as like as not.
pub(super) fn hit_just_now(model: &Model, state: &State, body: u32, time: f64) -> bool {
    time - state.segments[body as usize].start <= SAME_INSTANT * model.params.contact_duration
}

fn member(model: &Model, state: &State, bodies: &Island, pair: Pair, time: f64) -> Member {
    let lasting = state.contact(pair);
    let surface = match (lasting, pair.second()) {
        (Some(contact), _) => contact.surface,
        (None, Some(_)) => Surface::Round,
        (None, None) => surface_of(model, pair.b, state.position(pair.first(), time)),
    };
    let at = BodiesAt { ids: &bodies.ids, x: &bodies.x, v: &bodies.v };
    let link = Link { limit: 0.0, ..at.link(model, pair, surface) };
    Member {
        pair,
        surface,
        gap: gap_of(model, state, pair, time),
        restitution: restitution_of(model, pair),
        is_lasting: lasting.is_some(),
        link,
        before: link.entering(&bodies.v),
        impulse: 0.0,
    }
}
