//! One run, looked at from all sides; its timing is separate.

use std::time::{Duration, Instant};

use glam::DVec3;

use super::hits::{Onto, compare};
use super::overlap::OverlapMonitor;
use super::{Candidate, Control, HorizonCause, PairImpact, RunFigures, Stop, StudySettings, Truth};
use crate::scene::Scene;
use crate::sim::{BodyRef, Event, EventKind, Progress, Simulation};

/// When a run is looked at, and when it is given up.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub until: f64,
    pub sample_dt: f64,
    /// Longest wall time, s.
    pub run_limit: f64,
    pub max_events: Option<u64>,
    pub agreement: f64,
    pub event_window: f64,
}

impl Limits {
    pub fn of(settings: &StudySettings) -> Self {
        Self {
            until: settings.until,
            sample_dt: settings.sample_dt(),
            run_limit: settings.run_limit,
            max_events: settings.max_events,
            agreement: settings.agreement,
            event_window: settings.event_window,
        }
    }

    /// The last step of a run of this Δt, from 1: beyond the end by rounding is still the end.
    pub(super) fn last_step(&self, dt: f64) -> u64 {
        (self.until / dt * (1.0 + 1e-12)) as u64
    }

    /// The times at which a candidate is compared, s.
    pub fn sample_times(&self, candidate: &Candidate) -> Vec<f64> {
        let (dt, every) = candidate.stride(self.sample_dt);
        (1..=self.last_step(dt) / every).map(|k| (k * every) as f64 * dt).collect()
    }
}

/// Predictions carried out between two looks at the clock.
pub(super) const PREDICTIONS: u32 = 256;

/// So many tests of a pair take about a second.
const TESTS: u64 = 30_000_000;

/// Runs one candidate and compares it. `None` when cancelled. `scene` is what it simulates, so that a test
/// can measure a wrong law.
pub fn measure(
    candidate: &Candidate,
    scene: &Scene,
    truth: &Truth,
    limits: &Limits,
    control: &mut Control,
) -> Option<RunFigures> {
    let sim = match candidate.start(scene) {
        Ok(sim) => sim,
        Err(error) => return Some(ObservedRun::blank(candidate, Some(Stop::Fault(error.to_string())))),
    };
    let mut trial = ObservedRun::new(candidate, scene, sim, truth, limits);
    trial.look();
    let (dt, every) = candidate.stride(limits.sample_dt);
    let deadline = Instant::now() + Duration::from_secs_f64(limits.run_limit.min(1e9));
    let steps = limits.last_step(dt);
    for step in 1..=steps {
        let stop = trial.step(step as f64 * dt, deadline, control)?;
        trial.point.reached = trial.sim.time();
        if let Some(stop) = stop {
            trial.point.stopped = Some(stop);
            break;
        }
        if step % every == 0 || step == steps {
            trial.sample();
            control.show(step as f64 / steps as f64);
        } else if trial.may_look_often() {
            trial.look();
        }
    }
    Some(trial.finished())
}

/// A run that is being looked at.
struct ObservedRun<'a> {
    sim: Simulation,
    truth: &'a Truth,
    limits: &'a Limits,
    monitor: OverlapMonitor,
    /// Tests of a pair that may still be made at events.
    tests_left: u64,
    /// The dynamic bodies in the order of the file.
    bodies: Vec<BodyRef>,
    /// Index in the scene of dynamic and of static bodies.
    dynamic: Vec<usize>,
    fixed: Vec<usize>,
    hits: Vec<PairImpact>,
    /// Of all kinds.
    events: u64,
    has_parted: bool,
    point: RunFigures,
}

impl<'a> ObservedRun<'a> {
    fn new(
        candidate: &Candidate,
        scene: &Scene,
        sim: Simulation,
        truth: &'a Truth,
        limits: &'a Limits,
    ) -> Self {
        let index = |body: BodyRef| {
            let label = sim.label(body);
            scene.bodies.iter().position(|body| body.label == label).unwrap_or(usize::MAX)
        };
        let mut bodies: Vec<BodyRef> = sim.dynamic_bodies().collect();
        let dynamic = bodies.iter().map(|&body| index(body)).collect();
        let fixed = (0..sim.static_count() as u32).map(|k| index(BodyRef::Static(k))).collect();
        bodies.sort_by_key(|&body| index(body));
        Self {
            monitor: OverlapMonitor::in_file_order(scene),
            tests_left: TESTS,
            bodies,
            dynamic,
            fixed,
            hits: Vec::new(),
            events: 0,
            has_parted: false,
            point: Self::blank(candidate, None),
            sim,
            truth,
            limits,
        }
    }

    fn blank(candidate: &Candidate, stopped: Option<Stop>) -> RunFigures {
        RunFigures {
            method: candidate.method,
            dt: candidate.dt,
            tolerance: candidate.tolerance,
            group_step: candidate.group_step,
            reached: 0.0,
            stopped,
            wall_per_s: None,
            wall_range: None,
            position_error: None,
            velocity_error: None,
            energy_residual: None,
            momentum_residual: 0.0,
            worst_overlap: 0.0,
            impacts: 0,
            missed: None,
            wrong: None,
            first_difference: None,
            follows_until: None,
        }
    }

    /// One Δt. The outer `None` is a request to end, an inner `Some` a reason of the run's own.
    fn step(&mut self, time: f64, deadline: Instant, control: &Control) -> Option<Option<Stop>> {
        self.sim.begin(time);
        loop {
            let progress = match self.sim.work(PREDICTIONS) {
                Ok(progress) => progress,
                Err(fault) => return Some(Some(Stop::Fault(fault.to_string()))),
            };
            if let Progress::Event(event) = &progress {
                self.event(event);
            }
            // Also after a Δt in which nothing happened: there may be a billion of them.
            if control.is_cancelled() {
                return None;
            }
            if self.limits.max_events.is_some_and(|most| self.events >= most) {
                return Some(Some(Stop::EventLimit));
            }
            if Instant::now() > deadline {
                return Some(Some(Stop::RunLimit));
            }
            if progress == Progress::Done {
                return Some(None);
            }
        }
    }

    fn event(&mut self, event: &Event) {
        self.events += 1;
        if let (EventKind::Impact | EventKind::Collapse, Some(b)) = (event.kind, event.b) {
            self.point.impacts += 1;
            let bodies = [self.scene_index(event.a), self.scene_index(b)];
            let onto = match (event.a, b) {
                (BodyRef::Dynamic(_), BodyRef::Static(_)) => Some((bodies[0], event.normal)),
                (BodyRef::Static(_), BodyRef::Dynamic(_)) => Some((bodies[1], -event.normal)),
                _ => None,
            };
            let onto = onto.map(|(ball, towards)| Onto { ball, towards });
            self.hits.push(PairImpact { time: event.time, bodies, onto });
        }
        if self.may_look_often() {
            self.look();
        }
    }

    fn scene_index(&self, body: BodyRef) -> usize {
        let found = match body {
            BodyRef::Dynamic(k) => self.dynamic.get(k as usize),
            BodyRef::Static(k) => self.fixed.get(k as usize),
        };
        found.copied().unwrap_or(usize::MAX)
    }

    /// Whether there is time left to look at every event too, not at samples alone.
    fn may_look_often(&mut self) -> bool {
        self.tests_left = self.tests_left.saturating_sub(self.monitor.tests());
        self.tests_left > 0
    }

    /// Looks for overlaps.
    fn look(&mut self) -> Vec<(DVec3, DVec3)> {
        let states: Vec<_> = self
            .bodies
            .iter()
            .filter_map(|&body| self.sim.state(body))
            .map(|state| (state.position, state.velocity))
            .collect();
        let positions: Vec<DVec3> = states.iter().map(|state| state.0).collect();
        self.point.worst_overlap = self.point.worst_overlap.max(self.monitor.worst(&positions));
        states
    }

    fn sample(&mut self) {
        let states = self.look();
        let energy = self.sim.energy().residual.map(f64::abs);
        let point = &mut self.point;
        point.energy_residual = larger(point.energy_residual, energy);
        point.momentum_residual = point.momentum_residual.max(self.sim.momentum().residual);
        let Some(truth) = self.truth.at(self.sim.time()) else { return };
        let (mut position, mut velocity) = (0.0_f64, 0.0_f64);
        for (own, expected) in states.iter().zip(&truth.states) {
            position = position.max((own.0 - expected.0).length());
            velocity = velocity.max((own.1 - expected.1).length());
        }
        // Velocities jump at an impact: a rounding of its time would look like a large error.
        if self.truth.is_near_hit(truth.time, self.limits.event_window) {
            velocity = 0.0;
        }
        point.position_error = larger(point.position_error, Some(position));
        point.velocity_error = larger(point.velocity_error, Some(velocity));
        self.has_parted |= position > self.limits.agreement;
        if !self.has_parted {
            point.follows_until = Some(truth.time);
        }
    }

    fn finished(mut self) -> RunFigures {
        let horizon = self.truth.horizon.time.min(self.point.reached);
        if horizon > 0.0 {
            let window = self.limits.event_window + self.point.dt.unwrap_or(0.0);
            let found = compare(&self.hits, &self.truth.hits, horizon - window, window);
            // No impact of none compared says nothing, unless that is all there was.
            let is_said = self.truth.horizon.impacts > 0
                || found.wrong > 0
                || self.truth.horizon.cause == HorizonCause::WholeRun;
            if is_said {
                (self.point.missed, self.point.wrong) = (Some(found.missed), Some(found.wrong));
            }
            self.point.first_difference = found.first;
            // Parted at the first sample.
            self.point.follows_until.get_or_insert(0.0);
        }
        self.point
    }
}

fn larger(known: Option<f64>, new: Option<f64>) -> Option<f64> {
    match (known, new) {
        (Some(known), Some(new)) => Some(known.max(new)),
        (known, new) => known.or(new),
    }
}
