//! Islands that rub and are not one ball on a face: balls on edges and other balls, in grooves, in chains, in fields.
//!
//! Each contact slips or sticks. While none changes, centres and spins are integrated together, with the work of friction
//! as one more unknown; a step ends where a slip is zero, where a contact that sticks would need more than μ times its
//! load, and where a load is zero. Where no choice of what slips obeys all laws, the bodies are stepped.

use glam::DVec3;

use super::contact_forces::{Mode, Motions, Touch, apply};
use super::geometry::{normal_arms, rubbing_of};
use super::grip::{Choice, Driven, Grip};
use super::island::{Island, first_failing, level, part, part_ends, parts_of};
use super::model::Model;
use super::motion::{CoupledStart, SegmentError, Step, check, coupled_step, place, step_hint};
use super::rolling::{book_turn, report};
use super::segment::{Segment, Series};
use super::state::State;
use super::tolerance::{
    AS_IT_BEGAN, AT_ONCE, JUST_BEGUN, LAST_OF_SLIP, LAST_OF_WAY, LEAST_OF_STEP, MOST_GRIPPING, NO_SLIP,
    PRESSURE_ROUNDING, SHARE_OF_SLIP, STICKS_ON, STIFF_STEP,
};
use super::turn::{Due, Hold, Turn};

/// How an island goes on.
pub(super) enum Gripped {
    /// Its segments stand.
    Goes,
    /// A contact has parted: what is left is to be looked at anew.
    Parted,
    /// No choice of what slips is found: the bodies are to be stepped.
    Stepped,
}

/// Whether an island is one for this: with few contacts, and without rolling friction.
pub(super) fn can_grip(model: &Model, state: &State, island: &Island) -> bool {
    island.contacts.len() <= MOST_GRIPPING
        && island.inverse_mass.iter().all(|inverse| *inverse > 0.0)
        && island.contacts.iter().all(|(pair, _)| rubbing_of(model, *pair).rolling == 0.0)
        && island.ids.iter().all(|body| !state.captured.contains(body))
}

/// The steps of all, and the contacts whose slip is zero at their end.
type Gone = (Vec<Step>, Vec<usize>);

/// Lets an island that rubs go on.
pub(super) fn begin_gripping(
    model: &Model,
    state: &mut State,
    island: &mut Island,
    time: f64,
) -> Result<Gripped, (u32, SegmentError)> {
    let undisturbed: Vec<bool> = (island.ids.iter().zip(&island.v))
        .map(|(body, v)| state.turns[*body as usize].given.is_none() && state.velocity(*body, time) == *v)
        .collect();
    level(model, state, island);
    let island = &*island;
    let mut grip = Grip {
        model,
        island,
        radii: island.ids.iter().map(|body| model.radius(*body)).collect(),
        frictions: island.contacts.iter().map(|(pair, _)| rubbing_of(model, *pair).friction).collect(),
        arms: island.contacts.iter().map(|(pair, _)| normal_arms(model, *pair)).collect(),
        parts: parts_of(model, island),
        modes: vec![Mode::Smooth; island.contacts.len()],
        begins: vec![false; island.contacts.len()],
        slow: 0.0,
    };
    let mut motions: Motions = island.v.clone();
    motions
        .extend(island.ids.iter().zip(&grip.radii).map(|(body, radius)| *radius * state.spin(*body, time)));
    find_slips(&mut grip, state, &undisturbed, &mut motions);
    let driven = match grip.choose(time, &motions) {
        Choice::Holds(driven) => driven,
        Choice::Parts(k) => {
            part(model, state, island.contacts[k].0, time);
            return Ok(Gripped::Parted);
        }
        Choice::None => return Ok(Gripped::Stepped),
    };
    let is_still = motions.iter().all(|motion| *motion == DVec3::ZERO)
        && driven.motions.iter().all(|a| a.length() <= PRESSURE_ROUNDING * driven.size)
        && !model.may_depend_on_time();
    let gone = if is_still {
        Some((still(island, time), Vec::new()))
    } else {
        grip.integrate(state, time, &motions, &driven)?
    };
    let Some((steps, ends)) = gone else { return Ok(Gripped::Stepped) };
    grip.enter(state, time, &motions, &steps, &ends, is_still)?;
    Ok(Gripped::Goes)
}

/// Which contacts slip: those that stuck and were not disturbed do not, nor do those whose slip is rounding. Takes what
/// rounding left out of the motions.
fn find_slips(grip: &mut Grip<'_>, state: &State, undisturbed: &[bool], motions: &mut Motions) {
    let count = grip.island.ids.len();
    let touches = grip.touches(&grip.island.x, &motions[..count]);
    for (k, touch) in touches.iter().enumerate() {
        if grip.frictions[k] == 0.0 {
            continue;
        }
        let slip = touch.slip(motions);
        let sizes = |at: usize| motions[at].length() + motions[at + count].length();
        let size = sizes(touch.link.a) + touch.link.b.map_or(0.0, sizes);
        let is_same = undisturbed[touch.link.a] && touch.link.b.is_none_or(|b| undisturbed[b]);
        let stuck = state.contact(grip.island.contacts[k].0).is_some_and(|contact| contact.sticks);
        let sticks = slip.length() <= NO_SLIP * size || (stuck && is_same);
        grip.modes[k] = if sticks { Mode::Sticks } else { Mode::Slips(slip.normalize_or(DVec3::X)) };
    }
    // Velocities are kept as accelerations are, where nothing slips.
    let mut held = grip.touches(&grip.island.x, &motions[..count]);
    held.retain(|touch| touch.mode == Mode::Sticks);
    if held.iter().any(|touch| touch.slip(motions) != DVec3::ZERO) {
        let (limits, drifts) = (vec![0.0; held.len()], vec![DVec3::ZERO; held.len()]);
        apply(&held, &grip.island.inverse_mass, &limits, &drifts, motions);
    }
}

fn still(island: &Island, time: f64) -> Vec<Step> {
    let row = |x: &DVec3| (Segment::ballistic(time, *x, DVec3::ZERO, DVec3::ZERO), None);
    let none = || (Segment::ballistic(time, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO), None);
    let spins = std::iter::repeat_with(none).take(island.ids.len() + 1);
    island.x.iter().map(row).chain(spins).collect()
}

impl Grip<'_> {
    /// One step of all, on the parts of the shapes on which they are, and the contacts whose slip is zero at its end; `None`
    /// where steps have no length.
    fn integrate(
        &self,
        state: &mut State,
        time: f64,
        motions: &[DVec3],
        driven: &Driven,
    ) -> Result<Option<Gone>, (u32, SegmentError)> {
        let slips = self.slip_ends(motions, driven);
        let (first, soonest) = slips.iter().fold(
            (None, f64::INFINITY),
            |best: (Option<usize>, f64), (k, end)| {
                if *end < best.1 { (Some(*k), *end) } else { best }
            },
        );
        if first.filter(|k| self.is_last(*k, soonest, motions, driven)).is_some() {
            let all = slips.iter().filter(|(_, end)| *end <= soonest * (1.0 + AT_ONCE)).map(|(k, _)| *k);
            return Ok(Some((self.straight(time, soonest, motions, driven), all.collect())));
        }
        let Some(mut steps) = self.step(state, time, (motions, driven), soonest)? else { return Ok(None) };
        if self.is_stiff(&steps[0], motions, driven) {
            return Ok(None);
        }
        if let Some(end) = self.end_of(time, &steps) {
            let length = steps[0].0.end - time;
            let before = state.segments[self.island.ids[0] as usize].start;
            // What changes again at once changes for ever.
            if end <= time + LEAST_OF_STEP * length && time <= before + LEAST_OF_STEP * length {
                return Ok(None);
            }
            steps.iter_mut().for_each(|(segment, _)| segment.end = end);
        }
        Ok(Some((steps, Vec::new())))
    }

    /// One step of the integrator, with the work of friction in joules as the last; `None` where it has no length: slips
    /// that turn ever faster as they end are followed no further.
    fn step(
        &self,
        state: &mut State,
        time: f64,
        (motions, driven): (&[DVec3], &Driven),
        soonest: f64,
    ) -> Result<Option<Vec<Step>>, (u32, SegmentError)> {
        let count = self.island.ids.len();
        let unit = self.unit_of_work(motions, driven);
        let mut x: Vec<DVec3> = self.island.x.clone();
        x.resize(2 * count + 1, DVec3::ZERO);
        let mut v = motions.to_vec();
        v.push(DVec3::ZERO);
        let mut start = CoupledStart {
            model: self.model,
            ids: &self.island.ids,
            time,
            x: &x,
            v: &v,
            hint: step_hint(state, self.island.ids[0], time),
            longest: SHARE_OF_SLIP * soonest,
            noise: self.noise(motions, driven),
        };
        let evaluations = &mut state.counters.force_evaluations;
        let field = |_, time, x: &[DVec3], v: &[DVec3]| {
            let driven = self.driven(time, &x[..count], &v[..2 * count]);
            let mut all = driven.motions;
            all.push(DVec3::X * (driven.power / unit));
            (all, driven.size)
        };
        let mut steps = coupled_step(&start, evaluations, field);
        if steps.is_err() {
            // A slip that begins and turns at once has a direction of few digits.
            start.noise = 1.0 / AS_IT_BEGAN;
            steps = coupled_step(&start, evaluations, field);
        }
        let mut steps = match steps {
            Err(SegmentError::Stalled) => return Ok(None),
            steps => steps.map_err(|error| (self.island.ids[0], error))?,
        };
        // From the unit of the accelerations.
        let (work, column) = &mut steps[2 * count];
        work.a *= unit;
        if let Some(column) = column {
            column.series.b.iter_mut().for_each(|b| *b *= unit);
        }
        Ok(Some(steps))
    }

    /// How much larger than their rounding slips make that of their directions.
    fn noise(&self, motions: &[DVec3], driven: &Driven) -> f64 {
        let speed = self.speed(motions, driven.size);
        let of = |(k, touch): (usize, &Touch)| match touch.mode {
            Mode::Slips(_) if !self.begins[k] => speed / touch.slip(motions).length(),
            Mode::Slips(_) => 1.0,
            Mode::Smooth | Mode::Sticks => 1.0,
        };
        driven.touches.iter().enumerate().map(of).fold(1.0, f64::max).min(1.0 / AS_IT_BEGAN)
    }

    /// Whether a step has become short because a slip has only just begun and turns: its direction follows what drives it
    /// within |s|/μg, in which a fixed point is found only over steps as short.
    fn is_stiff(&self, (segment, _): &Step, motions: &[DVec3], driven: &Driven) -> bool {
        let speed = self.speed(motions, driven.size);
        let radius = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        let begins = |touch: &Touch| {
            let Mode::Slips(direction) = touch.mode else { return false };
            let grows = (touch.slip(&driven.motions) + touch.drift(motions)).dot(direction) >= 0.0;
            grows && touch.slip(motions).length() <= JUST_BEGUN * speed
        };
        segment.step * speed <= STIFF_STEP * radius && driven.touches.iter().any(begins)
    }

    /// When contacts that slip would cease to at their present rate, s from now.
    fn slip_ends(&self, motions: &[DVec3], driven: &Driven) -> Vec<(usize, f64)> {
        let end = |(k, touch): (usize, &Touch)| {
            let Mode::Slips(direction) = touch.mode else { return None };
            let slip = touch.slip(motions);
            let rate = -(touch.slip(&driven.motions) + touch.drift(motions)).dot(direction);
            (slip != DVec3::ZERO && rate > 0.0).then(|| (k, slip.length() / rate))
        };
        driven.touches.iter().enumerate().filter_map(end).collect()
    }

    /// Whether so little is left of a slip that the rest is straight, and so little time that the others are too.
    fn is_last(&self, k: usize, left: f64, motions: &[DVec3], driven: &Driven) -> bool {
        let speed = motions.iter().map(|motion| motion.length()).fold(0.0, f64::max);
        let touch = &driven.touches[k];
        let rate = (touch.slip(&driven.motions) + touch.drift(motions)).length();
        let radius = self.radii.iter().copied().fold(f64::INFINITY, f64::min);
        rate * left <= LAST_OF_SLIP * speed && driven.size * left * left <= LAST_OF_WAY * radius
    }

    /// All at their present accelerations for a short time.
    fn straight(&self, time: f64, length: f64, motions: &[DVec3], driven: &Driven) -> Vec<Step> {
        let count = self.island.ids.len();
        let mut steps = still(self.island, time);
        for (k, (segment, _)) in steps.iter_mut().enumerate().take(2 * count) {
            *segment = Segment {
                end: time + length,
                ..Segment::ballistic(time, segment.x, motions[k], driven.motions[k])
            };
        }
        // Slips change evenly: what is rubbed is what the middle says.
        let power = driven.touches.iter().zip(&driven.forces.across).map(|(touch, across)| {
            let change = touch.slip(&driven.motions) + touch.drift(motions);
            -across.dot(touch.slip(motions) + 0.5 * length * change)
        });
        let work = &mut steps[2 * count].0;
        *work = Segment { end: time + length, a: DVec3::X * power.sum::<f64>(), ..*work };
        steps
    }

    /// What makes the power of friction a number like the accelerations, kg·m/s.
    fn unit_of_work(&self, motions: &[DVec3], driven: &Driven) -> f64 {
        let mass: f64 = self.island.inverse_mass.iter().map(|inverse| 1.0 / inverse).sum();
        mass * self.speed(motions, driven.size).max(f64::MIN_POSITIVE)
    }

    /// When a step must end because a contact no longer does what it did, or goes on to another part of a shape.
    fn end_of(&self, time: f64, steps: &[Step]) -> Option<f64> {
        let count = self.island.ids.len();
        let length = steps[0].0.end - time;
        let holds = |at: f64| {
            let state: Vec<(DVec3, DVec3)> =
                steps[..2 * count].iter().map(|step| motion_at(step, at)).collect();
            let (x, v): (Vec<DVec3>, Vec<DVec3>) = state.into_iter().unzip();
            self.holds(&self.driven(at, &x[..count], &v), STICKS_ON)
        };
        let parts = part_ends(self.model, self.island, &self.parts, &steps[..count]);
        let parts = parts.filter(|end| *end > time + LEAST_OF_STEP * length);
        let fails = first_failing(time, length, holds);
        [parts, fails].into_iter().flatten().reduce(f64::min)
    }

    /// Books the old segments and begins the new ones.
    fn enter(
        &self,
        state: &mut State,
        time: f64,
        motions: &[DVec3],
        steps: &[Step],
        ends: &[usize],
        is_still: bool,
    ) -> Result<(), (u32, SegmentError)> {
        let count = self.island.ids.len();
        let work = steps[2 * count];
        for (row, body) in self.island.ids.iter().enumerate() {
            let (mut segment, mut column) = steps[row];
            (segment.constrained, segment.v) = (true, motions[row]);
            if is_still {
                (segment.end, column) = (f64::INFINITY, None);
            }
            check(self.model, &segment).map_err(|error| (*body, error))?;
            let before = state.turns[*body as usize].hold;
            let spin = motions[count + row] / self.radii[row];
            let given = (self.island.v[row], state.spin(*body, time));
            book_turn(self.model, state, (*body, self.island.x[row]), given, (segment.v, spin));
            place(self.model, state, *body, segment, column);
            let orientation = state.turns[*body as usize].orientation;
            let hold = self.hold_of(row, is_still);
            let mut turn = Turn { hold, ..self.turn(row, &steps[count + row], spin) };
            turn.orientation = orientation;
            if row == 0 {
                turn.work = work.0.a.x;
                turn.work_series = work.1.map_or(Series::default(), |column| column.series);
            }
            state.turns[*body as usize] = turn;
            self.tell(state, time, row, (before, hold));
        }
        for (k, (pair, _)) in self.island.contacts.iter().enumerate() {
            let sticks = self.modes[k] == Mode::Sticks || ends.contains(&k);
            state.mark_sticking(*pair, sticks);
        }
        Ok(())
    }

    fn turn(&self, row: usize, (segment, column): &Step, spin: DVec3) -> Turn {
        let scale = 1.0 / self.radii[row];
        let mut series = column.as_ref().map_or(Series::default(), |column| column.series);
        series.b.iter_mut().for_each(|b| *b *= scale);
        Turn {
            ramp: scale * segment.a,
            series,
            step: segment.step,
            due: Due::Nothing,
            ..Turn::steady(segment.start, glam::DQuat::IDENTITY, spin)
        }
    }

    fn hold_of(&self, row: usize, is_still: bool) -> Hold {
        let of_body = |k: &usize| {
            let pair = self.island.contacts[*k].0;
            pair.involves(self.island.ids[row])
        };
        let mut own = (0..self.modes.len()).filter(of_body);
        if is_still {
            Hold::Rests
        } else if own.any(|k| self.modes[k] != Mode::Sticks) {
            Hold::Slides
        } else {
            Hold::Rolls
        }
    }

    /// Says how a body goes on, at its first contact.
    fn tell(&self, state: &mut State, time: f64, row: usize, (before, now): (Hold, Hold)) {
        let body = self.island.ids[row];
        let own = self.island.contacts.iter().find(|(pair, _)| pair.involves(body));
        if let Some((pair, _)) = own {
            report(self.model, state, time, *pair, before, now);
        }
    }
}

/// Place and velocity of a step at a time.
fn motion_at((segment, column): &Step, time: f64) -> (DVec3, DVec3) {
    let series = column.as_ref().map(|column| &column.series);
    let path = super::segment::Path { segment, series };
    (path.position(time), path.velocity(time))
}
