//! How much a run may cost: events and wall-clock time, looked at between bounded amounts of work.

use std::fmt;
use std::time::{Duration, Instant};

use crate::sim::{Event, Fault, Progress, Simulation};

/// The latest model time of a run, and its longest Δt, s. Neighbouring numbers are 1e-7 s apart there: contacts are not told
/// apart well.
pub const LATEST_TIME: f64 = 1e9;

/// What a run may cost; `None` is without limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The run ends right after this many events.
    pub events: Option<u64>,
    /// Wall-clock time from the start of the run.
    pub wall: Option<Duration>,
}

/// The limit that ended a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exceeded {
    Events(u64),
    Wall(Duration),
}

impl fmt::Display for Exceeded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Events(1) => write!(f, "it has had 1 event, the most allowed"),
            Self::Events(count) => write!(f, "it has had {count} events, the most allowed"),
            Self::Wall(wall) => {
                write!(f, "it has taken {} s of wall time, the longest allowed", wall.as_secs_f64())
            }
        }
    }
}

/// Limits with the time at which their run began.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    limits: Limits,
    started: Instant,
}

impl Watch {
    /// The run begins now.
    pub fn start(limits: Limits) -> Self {
        Self { limits, started: Instant::now() }
    }

    /// The limit that is reached, after so many events.
    pub fn exceeded(&self, events: u64) -> Option<Exceeded> {
        if let Some(most) = self.limits.events.filter(|most| events >= *most) {
            return Some(Exceeded::Events(most));
        }
        self.limits.wall.filter(|wall| self.started.elapsed() >= *wall).map(Exceeded::Wall)
    }
}

/// Predictions carried out between two looks at the clock or the budget: a Δt may hold millions that are no events.
pub const PREDICTIONS: u32 = 16;

/// Goes on to `until` (s) and hands out the events on the way; `Ok(Some(_))` if a limit ended it earlier. Then
/// the simulation is right after its last event, and can go on. `events` counts those of the whole run.
pub fn advance(
    simulation: &mut Simulation,
    until: f64,
    watch: &Watch,
    events: &mut u64,
    on_event: &mut dyn FnMut(&Simulation, &Event),
) -> Result<Option<Exceeded>, Fault> {
    simulation.begin(until);
    loop {
        if let Some(exceeded) = watch.exceeded(*events) {
            return Ok(Some(exceeded));
        }
        match simulation.work(PREDICTIONS)? {
            Progress::Event(event) => {
                *events += 1;
                on_event(simulation, &event);
            }
            Progress::Working => {}
            Progress::Done => return Ok(None),
        }
    }
}
