//! Drives the scene of a case in steps of Δt, looks at it at every event and at random times between, and
//! gives up on a run that no longer gets anywhere.

use crate::scene::Scene;
use crate::sim::{BodyState, Event, Fault, Progress, Simulation};
use crate::study::Random;

/// Why a case could not be run to its end.
#[derive(Clone, Debug, thiserror::Error)]
pub(super) enum Stop {
    #[error("{0}")]
    Scene(String),
    #[error("{0}")]
    Fault(#[from] Fault),
    #[error("stalled at t = {time} s, after {segments} segments")]
    Stalled { time: f64, segments: u64 },
    #[error("no body {0}")]
    NoBody(i64),
    #[error("{0}")]
    Unexpected(String),
}

/// A case's scene and the Δt it is run with.
pub(super) struct Trial {
    pub scene: Scene,
    /// s.
    pub dt: f64,
    /// Segments the core may begin before it counts as stalled.
    pub budget: u64,
}

/// Random looks in one run, besides the samples.
const LOOKS: u32 = 200;
/// Predictions carried out between two looks at the budget.
const PORTION: u32 = 256;

impl Trial {
    pub(super) fn start(&self) -> Result<Simulation, Stop> {
        start(&self.scene)
    }

    /// Goes on to a later time in steps of Δt, cut at some random times. `see` is called at each event and,
    /// with `None`, at each random time and at the end.
    pub(super) fn watch(
        &self,
        sim: &mut Simulation,
        until: f64,
        mut see: impl FnMut(&Simulation, Option<&Event>) -> Result<(), Stop>,
    ) -> Result<(), Stop> {
        let from = sim.time();
        let mut random = Random::new(1);
        let mut looks: Vec<f64> = (0..LOOKS).map(|_| random.range(from, until)).collect();
        looks.push(until);
        looks.sort_by(f64::total_cmp);
        let mut step: u64 = 1;
        for look in looks {
            loop {
                let sample = from + step as f64 * self.dt;
                let target = sample.min(look);
                sim.begin(target);
                self.finish(sim, &mut see)?;
                if sample <= look {
                    step += 1;
                }
                if target >= look {
                    break;
                }
            }
            see(sim, None)?;
        }
        Ok(())
    }

    /// As [`Self::watch`], for those who look at events only at the end.
    pub(super) fn events(&self, sim: &mut Simulation, until: f64) -> Result<Vec<Event>, Stop> {
        let mut events = Vec::new();
        self.watch(sim, until, |_, event| {
            events.extend(event);
            Ok(())
        })?;
        Ok(events)
    }

    fn finish(
        &self,
        sim: &mut Simulation,
        see: &mut impl FnMut(&Simulation, Option<&Event>) -> Result<(), Stop>,
    ) -> Result<(), Stop> {
        loop {
            let progress = sim.work(PORTION)?;
            let segments = sim.counters().segments;
            if segments > self.budget {
                return Err(Stop::Stalled { time: sim.time(), segments });
            }
            match progress {
                Progress::Done => return Ok(()),
                Progress::Event(event) => see(sim, Some(&event))?,
                Progress::Working => {}
            }
        }
    }
}

pub(super) fn start(scene: &Scene) -> Result<Simulation, Stop> {
    Simulation::new(scene).map_err(|error| Stop::Scene(error.to_string()))
}

/// The state of the dynamic body with this UserID.
pub(super) fn state_of(sim: &Simulation, id: i64) -> Result<BodyState, Stop> {
    let label = id.to_string();
    let body = sim.dynamic_bodies().find(|&body| sim.label(body) == label);
    body.and_then(|body| sim.state(body)).ok_or(Stop::NoBody(id))
}

/// The states of all dynamic bodies, in UserID order.
pub(super) fn states(sim: &Simulation) -> Vec<BodyState> {
    sim.dynamic_bodies().filter_map(|body| sim.state(body)).collect()
}
