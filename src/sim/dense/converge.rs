//! The contacts of a component in one step, swept until what still changes is tolerated.

use super::block::solve_together;
use super::rub::{LawOf, Rubbing};
use super::stepped::{Contact, Moving, Step, Stepped};
use super::sweep::{Judgement, System};
use super::tolerance::{
    BUDGET, COARSEST, FINEST, FINEST_OF_DEEP, GAIN, GROSS_GAIN, MOST_BEFORE_FADING, MOST_GIVEN, MOST_IN_VAIN,
    MOST_SWEEPS, SHARE_IN_A_JAM, SHARE_OF_BUDGET, SHARE_OF_WAY, SWEEPS_AGAINST_GAIN, SWEEPS_TO_BLOCK,
};

/// What became of the contacts of a component in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Solution {
    /// Energy that the contacts took, J.
    pub loss: f64,
    pub sweeps: usize,
    pub has_converged: bool,
    /// Whether it gains so much that it must not be taken.
    pub gains: bool,
}

/// What the contacts of a component are solved for.
pub(super) struct Problem<'a> {
    pub bodies: &'a [Stepped],
    pub step: Step,
    /// Energy that sweeps of earlier steps have given, J.
    pub given: f64,
    pub law: &'a LawOf<'a>,
}

/// Solves the contacts of a component in a step. Their impulses are where it begins, and what it finds. `meet` adds
/// contacts that are seen to be met.
pub(super) fn solve(
    problem: &Problem<'_>,
    system: &mut System,
    contacts: &mut Vec<Contact>,
    rubbing: &mut Rubbing,
    mut meet: impl FnMut(&[Moving], &mut Vec<Contact>),
) -> Solution {
    let Problem { bodies, step, given, .. } = *problem;
    let tolerance = Tolerance::of(bodies, step);
    system.begin(bodies, step.h);
    rubbing.begin_anew();
    let allowed = allowed_gain(bodies);
    if given > MOST_BEFORE_FADING * allowed {
        contacts.iter_mut().for_each(|contact| contact.impulse *= SHARE_IN_A_JAM);
    }
    add(problem, &tolerance, system, contacts, rubbing, 0);
    let mut effort = Effort { has_blocks: rubbing.is_empty(), given, ..Effort::default() };
    let mut solution = Solution::default();
    loop {
        let is_tolerated = effort.sweep(system, rubbing);
        let is_last = effort.sweeps >= MOST_SWEEPS;
        if !is_tolerated && !is_last {
            effort.hasten(system, rubbing);
            continue;
        }
        let known = contacts.len();
        if is_tolerated {
            meet(&system.moving, contacts);
        }
        let has_met = contacts.len() > known;
        if has_met {
            add(problem, &tolerance, system, contacts, rubbing, known);
            solution.has_converged = false;
            if !is_last {
                continue;
            }
        }
        let judged = system.judge(contacts, step, rubbing);
        solution.loss = judged.loss;
        solution.gains = gains_grossly(judged.loss, allowed);
        // It has, if once, as long as it does not sink or gain again.
        solution.has_converged |= is_tolerated && !has_met;
        solution.has_converged &= !judged.sinks && !solution.gains;
        if is_last || effort.is_enough(judged, solution.gains, allowed) {
            break;
        }
        let creeping = |system: &System| system.creeping(contacts, step, allowed);
        effort.go_on(system, rubbing, creeping);
    }
    solution.sweeps = effort.sweeps;
    for (contact, impulse) in contacts.iter_mut().zip(&system.impulses) {
        contact.impulse = *impulse;
    }
    solution
}

/// Adds the contacts from `first` on to the rows, and to those that rub.
fn add(
    problem: &Problem<'_>,
    tolerance: &Tolerance,
    system: &mut System,
    contacts: &[Contact],
    rubbing: &mut Rubbing,
    first: usize,
) {
    let scale_of = |contact: &Contact| tolerance.scale(contact);
    let new = &contacts[first..];
    system.add(new, scale_of);
    let rows = rubbing.len();
    rubbing.add(first, new, problem.bodies, (problem.step.h, &scale_of), problem.law);
    rubbing.warm_up(rows, problem.bodies, &mut system.moving);
}

/// How much was done in a step so far.
#[derive(Clone, Copy, Debug, Default)]
struct Effort {
    sweeps: usize,
    /// Those after all changes were small enough.
    extra: usize,
    /// How often slow rows were solved together.
    blocks: usize,
    /// Whether rows may be: the bounds of friction move with the impulses, so that those that rub are left to sweeps.
    has_blocks: bool,
    /// What earlier steps have given beyond what contacts took since, J.
    given: f64,
    /// What the contacts took when it was last asked whether more sweeps are any good, J, and whether they were none.
    last_loss: f64,
    is_vain: bool,
}

impl Effort {
    /// Sweeps once; whether what changed is tolerated.
    fn sweep(&mut self, system: &mut System, rubbing: &mut Rubbing) -> bool {
        let worst = system.sweep(self.sweeps % 2 == 1, rubbing);
        self.sweeps += 1;
        worst <= 1.0
    }

    /// Goes on where a sweep led, or solves what is slow together.
    fn hasten(&mut self, system: &mut System, rubbing: &Rubbing) {
        let is_slow = self.has_blocks && self.sweeps.is_multiple_of(SWEEPS_TO_BLOCK);
        if is_slow && solve_together(system, system.slow(), self.blocks) {
            self.blocks += 1;
        } else {
            system.go_on(rubbing);
        }
    }

    /// Whether nothing is left to do where all changes are small enough, or it is in vain.
    fn is_enough(&mut self, judged: Judgement, gains: bool, allowed: f64) -> bool {
        if self.extra.is_multiple_of(SWEEPS_TO_BLOCK) {
            self.is_vain = self.extra > 0 && -judged.loss > -0.5 * self.last_loss;
            self.last_loss = judged.loss;
        }
        let given = (self.given - judged.loss) / allowed;
        let is_vain = self.is_vain && !judged.sinks && given <= MOST_IN_VAIN;
        let is_tired = (is_vain || self.extra >= SWEEPS_AGAINST_GAIN) && !gains;
        let creeps = self.has_blocks && self.extra == 0 && judged.creeps;
        let climbs = -judged.loss > allowed && given > MOST_GIVEN;
        is_tired || !(judged.sinks || creeps || climbs)
    }

    /// Goes on although all changes are small enough.
    fn go_on(&mut self, system: &mut System, rubbing: &Rubbing, creeping: impl Fn(&System) -> Vec<usize>) {
        let is_block = self.has_blocks && self.extra.is_multiple_of(SWEEPS_TO_BLOCK);
        let rings = 1 + self.extra / SWEEPS_TO_BLOCK;
        if !(is_block && solve_together(system, creeping(system), rings)) {
            system.go_on(rubbing);
        }
        self.extra += 1;
    }
}

/// Whether contacts that take this energy, J, give so much that a step has not converged.
fn gains_grossly(loss: f64, allowed: f64) -> bool {
    -loss > GROSS_GAIN * allowed
}

/// Energy that what the sweeps leave may add, J. What they leave of velocities is tolerated by itself, so that light bodies
/// are given next to nothing: the measure is the mean of all, to which heavy ones add most.
fn allowed_gain(bodies: &[Stepped]) -> f64 {
    let moving = bodies.iter().filter(|body| body.inverse_mass > 0.0);
    let (sum, count) = moving.fold((0.0, 0.0_f64), |(sum, count), body| {
        (sum + body.drive * body.radius / body.inverse_mass, count + 1.0)
    });
    GAIN * sum / count.max(1.0)
}

/// What changes of an impulse are tolerated at last: see [`super::tolerance`].
struct Tolerance {
    /// Of the way that bodies pass in a step on average, m.
    way: f64,
    step: Step,
}

impl Tolerance {
    fn of(bodies: &[Stepped], step: Step) -> Self {
        let mean: f64 = bodies.iter().map(|body| body.u.length_squared()).sum::<f64>() / bodies.len() as f64;
        Self { way: SHARE_OF_WAY * step.h * mean.sqrt(), step }
    }

    /// min(clamp(0.1 h u, 2e-6 r, 1e-4 r), max((6e-4 r + g)/4, 2e-7 r)), m.
    fn of_contact(&self, contact: &Contact) -> f64 {
        let radius = self.step.radius;
        let (finest, coarsest) = (FINEST * radius, COARSEST * radius);
        let left = SHARE_OF_BUDGET * (BUDGET * radius + contact.gap);
        self.way.clamp(finest, coarsest).min(left.max(FINEST_OF_DEEP * finest))
    }

    /// The change of an impulse that makes one, 1/(N·s).
    fn scale(&self, contact: &Contact) -> f64 {
        contact.inverse_mass * self.step.h / self.of_contact(contact)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::stepped::FIXED;
    use super::*;

    const G: f64 = 10.0;
    const H: f64 = 1.0 / 1024.0;
    const RADIUS: f64 = 0.05;

    fn ball(mass: f64) -> Stepped {
        let a = DVec3::NEG_Y * G;
        Stepped { a, drive: G, inverse_mass: 1.0 / mass, radius: RADIUS, ..Stepped::FIXED }
    }

    /// What lies on body b, or on the floor, at rest so far, with a gap.
    fn lies(bodies: &[Stepped], a: u32, b: u32, gap: f64) -> Contact {
        let inverse_mass = |body: u32| bodies.get(body as usize).map_or(0.0, |body| body.inverse_mass);
        Contact {
            near: 0,
            listed: 0,
            a,
            b,
            normal: DVec3::NEG_Y,
            gap,
            rate: 0.0,
            bound: if gap < 0.0 { 0.0 } else { -gap / H },
            inverse_mass: inverse_mass(a) + inverse_mass(b),
            impulse: 0.0,
        }
    }

    /// Columns of balls one upon the other, without a force between them yet.
    fn columns(masses: &[&[f64]]) -> (Vec<Stepped>, Vec<Contact>) {
        let bodies: Vec<Stepped> = masses.iter().copied().flatten().map(|mass| ball(*mass)).collect();
        let mut contacts = Vec::new();
        let mut place = 0;
        for column in masses {
            for floor in 0..column.len() as u32 {
                let below = if floor == 0 { FIXED } else { place - 1 };
                contacts.push(lies(&bodies, place, below, 0.0));
                place += 1;
            }
        }
        (bodies, contacts)
    }

    fn solved(bodies: &[Stepped], contacts: &mut Vec<Contact>) -> Solution {
        solved_in_a_jam(bodies, contacts, 0.0)
    }

    /// Where earlier steps have given energy, J.
    fn solved_in_a_jam(bodies: &[Stepped], contacts: &mut Vec<Contact>, given: f64) -> Solution {
        solved_after(&mut System::default(), bodies, contacts, given)
    }

    /// With the memory of earlier steps.
    fn solved_after(
        system: &mut System,
        bodies: &[Stepped],
        contacts: &mut Vec<Contact>,
        given: f64,
    ) -> Solution {
        let step = Step { h: H, radius: RADIUS };
        let problem = Problem { bodies, step, given, law: &|_| None };
        solve(&problem, system, contacts, &mut Rubbing::default(), |_, _| {})
    }

    #[test]
    fn light_balls_bear_heavy_ones_at_once() {
        let even: &[f64] = &[1.0, 1.0];
        let uneven: &[f64] = &[1e-3, 1e3, 1e-2, 1e3];
        let mut masses = vec![even; 150];
        masses[70] = uneven;
        let (bodies, mut contacts) = columns(&masses);
        let solution = solved(&bodies, &mut contacts);
        assert!(solution.has_converged && solution.sweeps < 100, "{solution:?}");
        let carried = contacts.iter().find(|contact| contact.a == 140).map_or(0.0, |contact| contact.impulse);
        let weight = uneven.iter().sum::<f64>() * G * H;
        assert!((carried - weight).abs() < 1e-6 * weight, "{carried} of {weight}");
    }

    #[test]
    fn a_step_that_overflowed_leaves_nothing_behind() {
        let mut system = System::default();
        let (mut bodies, mut contacts) = columns(&[&[1.0, 1.0][..]; 3]);
        bodies[1].u = DVec3::NEG_Y * f64::MAX;
        contacts[0].bound = f64::MAX;
        contacts[1].bound = f64::MAX;
        let overflowed = solved_after(&mut system, &bodies, &mut contacts, 0.0);
        assert!(!overflowed.loss.is_finite(), "{overflowed:?}");
        let impulses = |system: &mut System| {
            let (bodies, mut contacts) = columns(&[&[1.0, 1.0][..]; 3]);
            let solution = solved_after(system, &bodies, &mut contacts, 0.0);
            assert!(solution.has_converged, "{solution:?}");
            contacts.iter().map(|contact| contact.impulse.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(impulses(&mut system), impulses(&mut System::default()));
    }

    /// A ball squeezed between two walls by impulses that balance each other and bear nothing.
    #[test]
    fn impulses_that_bear_nothing_fade_in_a_jam_that_was_given_energy() {
        let bodies = [Stepped { a: DVec3::ZERO, ..ball(1.0) }];
        let squeeze = 100.0;
        let side = |normal: DVec3| Contact { normal, impulse: squeeze, ..lies(&bodies, 0, FIXED, 0.0) };
        let pressed_after_steps = |given: f64| {
            let mut contacts = vec![side(DVec3::X), side(DVec3::NEG_X)];
            for _ in 0..10 {
                let solution = solved_in_a_jam(&bodies, &mut contacts, given);
                assert!(solution.has_converged, "{solution:?}");
            }
            contacts.iter().map(|contact| contact.impulse).fold(0.0, f64::max)
        };
        let allowed = allowed_gain(&bodies);
        assert_eq!(pressed_after_steps(0.5 * MOST_BEFORE_FADING * allowed), squeeze);
        let faded = pressed_after_steps(2.0 * MOST_BEFORE_FADING * allowed);
        assert!((faded - squeeze * libm::pow(SHARE_IN_A_JAM, 10.0)).abs() < 1e-9 * squeeze, "{faded}");
    }

    /// A ball wedged between normals that all but oppose each other: what each sweep changes is tolerated long before
    /// the ball is borne, W/(2 sin α) on either side.
    #[test]
    fn what_is_wedged_and_has_used_up_its_budget_sinks_no_more() {
        let bodies = [ball(1.0)];
        let slope = 1e-3;
        let side = |x: f64| {
            let normal = DVec3::new(x, -slope, 0.0).normalize();
            Contact { normal, ..lies(&bodies, 0, FIXED, -1.5 * BUDGET * RADIUS) }
        };
        let mut contacts = vec![side(1.0), side(-1.0)];
        let solution = solved(&bodies, &mut contacts);
        assert!(solution.has_converged, "{solution:?}");
        let borne: f64 = contacts.iter().map(|contact| -contact.normal.y * contact.impulse).sum();
        assert!((borne - G * H).abs() < 1e-6 * G * H, "{borne}");
    }
}
