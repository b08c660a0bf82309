//! Impact groups: the contacts of bodies that touch, resolved together.
//!
//! Generalized reflections (Smith, Kaufman, Vouga, Tamstorf & Grinspun 2012, "Reflections on simultaneous
//! impact"): in each round all contacts that close are taken at once. The nearest velocity that enters none
//! of them, in the kinetic metric, has multipliers λ ≥ 0; the elastic outcome is the mirror image of the
//! velocity in it, v' = v − 2 M⁻¹Nᵀλ. Rounds go on until nothing closes. That keeps energy, momentum and
//! every symmetry of the group, and hands one ball on for one through a row of touching ones.
//!
//! With restitution e < 1 there is no unique answer. The rule here: contacts of a round that act on each other,
//! nᵢM⁻¹nⱼᵀ ≠ 0, directly or through others, share one e̅, v' = v − (1 + e̅) M⁻¹Nᵀλ, with e̅² the mean of e²
//! weighted with the energy λ·c that each contact takes up (c the closing speed). Such a round loses
//! ½(1 − e̅²) Σ λc ≥ 0, and a contact on which no other acts obeys Newton's law: a ball that meets a bouncy wall and
//! a plastic floor at once leaves them as if it had met them in turn. Where every e is 0, and where closing speeds
//! have fallen to next to nothing, all contacts of the group are taken at once and plastically (Moreau).

use std::collections::BTreeSet;

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::body::BodyId;
use super::constraint::enter_none;
use super::geometry::{BodiesAt, contact_distance, gap_of, larger_radius, restitution_at, surface_of};
use super::island::Island;
use super::link::{Link, Solved, renumber};
use super::model::Model;
use super::nearest::nearest;
use super::neighbours::near;
use super::pair::Pair;
use super::predict::{Gap, touch_tolerance};
use super::shape::Surface;
use super::state::State;
use super::tolerance::{
    CLOSING_ROUNDING, NO_CHANGE, ROUNDS, ROUNDS_PER_CONTACT, ROUNDS_TO_FALL, ROUNDS_TO_FALL_PER_CONTACT,
    UNCOUPLED,
};

/// Bodies that touch, at the time of an impact.
pub(super) struct Group {
    pub bodies: Island,
    pub members: Vec<Member>,
    /// s.
    pub time: f64,
    /// The largest speed before, m/s.
    pub fastest: f64,
    /// Energy taken by the law of each round, J: not what the velocities say, so that the books can tell.
    pub loss: f64,
    /// In how many its contacts were resolved.
    pub rounds: u32,
    /// How often velocities were taken that not all contacts allow, for the search for better ones was given up.
    pub given_up: u64,
    /// Angular velocities, rad/s; none where nothing rubs.
    pub spins: Vec<DVec3>,
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
    /// Impulse of friction on the second body, N·s.
    pub rubbed: DVec3,
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
        let mut seen: FxHashSet<u32> = ids.iter().copied().collect();
        let again = ids.iter().any(|body| hit_just_now(model, state, *body, time));
        let mut next = 0;
        while let Some(body) = ids.get(next).copied() {
            let near = if again { near(model, state, body) } else { Vec::new() };
            for pair in touching(model, state, body, time, &near, also) {
                pairs.push(pair);
                ids.extend(pair.dynamic().filter(|other| seen.insert(*other)));
            }
            next += 1;
        }
        ids.sort_unstable();
        pairs.sort_unstable();
        // Both bodies of a pair find it.
        pairs.dedup();
        let bodies = Island::at(model, state, ids, time);
        let members = pairs.into_iter().map(|pair| member(model, state, &bodies, pair, time)).collect();
        let fastest = bodies.v.iter().map(|v| v.length()).fold(0.0, f64::max);
        Self { bodies, members, time, fastest, loss: 0.0, rounds: 0, given_up: 0, spins: Vec::new() }
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

    /// Whether a contact took part in the impact by more than the rounding of its speeds, and of places: bodies that touch
    /// may be a rounding δ apart, and then meet at √(2gδ).
    pub fn is_felt(&self, model: &Model, member: &Member) -> bool {
        let change = member.impulse * member.link.response(&member.link, &self.bodies.inverse_mass);
        let apart = touch_tolerance(member.gap.point, larger_radius(model, member.pair));
        let fall = (1.0 + member.restitution) * (2.0 * member.gap.drive.abs() * apart).sqrt();
        change > self.rounding(member).max(NO_CHANGE * self.fastest).max(fall)
    }

    /// Rounds of reflections until nothing closes; whether closing speeds fell without end, so that the rest was
    /// taken plastically.
    pub fn resolve(&mut self, smallest_share: f64) -> bool {
        let largest = self.members.iter().map(|member| member.before).fold(0.0, f64::max);
        let is_plastic = self.members.iter().all(|member| member.restitution == 0.0);
        let rounds = ROUNDS + ROUNDS_PER_CONTACT * self.members.len();
        let settling_in = ROUNDS_TO_FALL + ROUNDS_TO_FALL_PER_CONTACT * self.members.len();
        let couplings = self.couplings();
        for round in 0..2 * rounds {
            let closing = self.still_closing();
            let Some(worst) = closing.iter().map(|k| self.closing(&self.members[*k])).reduce(f64::max) else {
                return false;
            };
            let is_far_gone = round > settling_in && worst <= smallest_share * largest;
            if is_plastic || is_far_gone {
                break;
            }
            let before = self.bodies.v.clone();
            self.rounds += 1;
            if round < rounds {
                split(&closing, &couplings).iter().for_each(|coupled| self.reflect(coupled));
            } else {
                // A light body between heavy ones would be thrown to and fro some √(M/m) times.
                self.reflect(&(0..self.members.len()).collect::<Vec<_>>());
            }
            if self.bodies.v == before {
                break;
            }
        }
        self.take_up();
        !is_plastic
    }

    /// Gives bodies the velocity that they had where it changed by rounding only, and none where rounding is all that
    /// is left of it.
    pub fn forget_rounding(&mut self, before: &[DVec3]) {
        let rounding = NO_CHANGE * self.fastest;
        for (old, new) in before.iter().zip(&mut self.bodies.v) {
            if (*new - *old).length() <= rounding {
                *new = *old;
            } else if new.length() <= rounding {
                *new = DVec3::ZERO;
            }
        }
    }

    /// Which of the members close now.
    pub fn still_closing(&self) -> Vec<usize> {
        let closes = |member: &Member| self.closing(member) > self.rounding(member);
        (0..self.members.len()).filter(|k| closes(&self.members[*k])).collect()
    }

    /// Restitution of a contact in this impact: what it came to where others took part, else its own.
    pub fn restitution_of(&self, member: &Member) -> f64 {
        let parting = -self.closing(member);
        let own = member.restitution;
        if self.members.len() > 1 && member.before > 0.0 { own.min(parting / member.before) } else { own }
    }

    /// The other contacts that each one acts on.
    fn couplings(&self) -> Vec<Vec<usize>> {
        let mut of_bodies: Vec<Vec<usize>> = vec![Vec::new(); self.bodies.ids.len()];
        let bodies = |k: usize| std::iter::once(self.members[k].link.a).chain(self.members[k].link.b);
        let all = 0..self.members.len();
        all.clone().for_each(|k| bodies(k).for_each(|body| of_bodies[body].push(k)));
        let coupled = |k: usize| {
            let mut others: Vec<usize> = bodies(k).flat_map(|body| of_bodies[body].iter().copied()).collect();
            others.sort_unstable();
            others.dedup();
            others.retain(|other| *other != k && self.couples(k, *other));
            others
        };
        all.map(coupled).collect()
    }

    /// Whether two contacts share a moving body on which an impulse at one changes what closes at the other, by more
    /// than rounding.
    fn couples(&self, k: usize, other: usize) -> bool {
        let links = [&self.members[k].link, &self.members[other].link];
        let response = |a: &Link, b: &Link| a.response(b, &self.bodies.inverse_mass);
        let both = if links[0].shares_body(links[1]) { response(links[0], links[1]) } else { 0.0 };
        both * both > UNCOUPLED * UNCOUPLED * response(links[0], links[0]) * response(links[1], links[1])
    }

    /// Throws connected contacts back, all at once.
    fn reflect(&mut self, contacts: &[usize]) {
        let mut links: Vec<Link> = contacts.iter().map(|k| self.members[*k].link).collect();
        let closing: Vec<f64> = links.iter().map(|link| link.entering(&self.bodies.v)).collect();
        let bodies = renumber(&mut links);
        let inverse_mass: Vec<f64> = bodies.iter().map(|body| self.bodies.inverse_mass[*body]).collect();
        let mut plastic: Vec<DVec3> = bodies.iter().map(|body| self.bodies.v[*body]).collect();
        let Solved { multipliers, is_unmet, .. } = enter_none(&links, &inverse_mass, &mut plastic);
        self.given_up += u64::from(is_unmet);
        let energies: Vec<f64> =
            multipliers.iter().zip(&closing).map(|(multiplier, closing)| multiplier * closing).collect();
        let restitution = self.shared_restitution(contacts, &energies);
        for (k, multiplier) in contacts.iter().zip(multipliers) {
            self.members[*k].impulse += (1.0 + restitution) * multiplier;
        }
        self.throw(bodies.into_iter().zip(plastic), restitution);
    }

    /// Goes (1 + e) times the way to the plastic velocities, which is orthogonal to them in the metric of masses, and
    /// books the loss ½(1 − e²) Σ m|v − v_plastic|². The impulses say the same, but where normals all but coincide
    /// they are large differences, and the velocities are not.
    fn throw(&mut self, plastic: impl Iterator<Item = (usize, DVec3)>, restitution: f64) {
        let mut of_way = 0.0;
        for (body, plastic) in plastic {
            let v = &mut self.bodies.v[body];
            let way = *v - plastic;
            if way != DVec3::ZERO {
                of_way += way.length_squared() / self.bodies.inverse_mass[body];
                *v -= (1.0 + restitution) * way;
            }
        }
        self.loss += 0.5 * (1.0 - restitution) * (1.0 + restitution) * of_way;
    }

    /// √ of the mean of e², weighted with the energy that each contact takes up.
    fn shared_restitution(&self, contacts: &[usize], energies: &[f64]) -> f64 {
        let of = |k: &usize| self.members[*k].restitution;
        let first = of(&contacts[0]);
        if contacts.iter().all(|k| of(k) == first) {
            return first;
        }
        let whole: f64 = energies.iter().map(|energy| energy.max(0.0)).sum();
        let weighted = contacts.iter().zip(energies).map(|(k, energy)| of(k) * of(k) * energy.max(0.0));
        if whole > 0.0 { (weighted.sum::<f64>() / whole).sqrt() } else { 0.0 }
    }

    /// Takes all that closes, plastically.
    pub fn take_up(&mut self) {
        let none_lasts = vec![false; self.members.len()];
        let levelled = self.levelled(&none_lasts);
        self.bring_to(levelled);
    }

    /// The nearest velocities at which no contact closes, and those that last do not part.
    pub fn levelled(&self, lasts: &[bool]) -> Levelled {
        let links: Vec<Link> = self.members.iter().map(|member| member.link).collect();
        let mut velocities = self.bodies.v.clone();
        let solved = nearest(&links, lasts, &self.bodies.inverse_mass, &mut velocities);
        Levelled { velocities, impulses: solved.multipliers, is_unmet: solved.is_unmet }
    }

    pub fn bring_to(&mut self, levelled: Levelled) {
        self.given_up += u64::from(levelled.is_unmet);
        for (member, impulse) in self.members.iter_mut().zip(levelled.impulses) {
            member.impulse += impulse;
        }
        self.throw(levelled.velocities.into_iter().enumerate(), 0.0);
    }
}

/// Splits some contacts into those that act on each other, directly or through others of them.
fn split(contacts: &[usize], couplings: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut left: BTreeSet<usize> = contacts.iter().copied().collect();
    let mut sets = Vec::new();
    while let Some(first) = left.pop_first() {
        let mut set = vec![first];
        let mut next = 0;
        while let Some(k) = set.get(next) {
            let more: Vec<usize> = couplings[*k].iter().copied().filter(|other| left.remove(other)).collect();
            set.extend(more);
            next += 1;
        }
        set.sort_unstable();
        sets.push(set);
    }
    sets
}

/// Velocities of the bodies of a group with the impulses at its contacts that lead to them.
pub(super) struct Levelled {
    pub velocities: Vec<DVec3>,
    /// N·s.
    pub impulses: Vec<f64>,
    /// Whether the search for them was given up.
    pub is_unmet: bool,
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
    let near = |pair: &Pair| {
        let gap = gap_of(model, state, *pair, time);
        gap.distance <= contact_distance(model, *pair, gap.point)
    };
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

/// Whether a body has not moved by the contact distance since its present motion began, at an impact as like as
/// not: what it touched then it still touches.
pub(super) fn hit_just_now(model: &Model, state: &State, body: u32, time: f64) -> bool {
    let path = state.path(body);
    let way = path.position(time) - path.segment.x;
    way.length() <= model.params.contact_distance * model.radius(body)
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
    let before = link.entering(&bodies.v);
    Member {
        pair,
        surface,
        gap: gap_of(model, state, pair, time),
        restitution: restitution_at(model, pair, before),
        is_lasting: lasting.is_some(),
        link,
        before,
        impulse: 0.0,
        rubbed: DVec3::ZERO,
    }
}
