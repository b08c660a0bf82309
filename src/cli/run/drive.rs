//! The loop of a run: Δt after Δt, event after event, looking often for a reason to stop.

use std::sync::atomic::{AtomicBool, Ordering};

use super::recorder::Recorder;
use super::samples::SampleGrid;
use crate::cli::CliError;
use crate::sim::{Fault, Progress, Simulation};

/// Predictions carried out between two looks at the clock: a Δt may hold millions that are no events.
const PREDICTIONS: u32 = 64;

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    Finished,
    /// Every reader of the output went away.
    NobodyListens,
    Interrupted,
    Faulted(Fault),
}

/// Runs `sim` over `grid`; an error means that an output can't be written.
pub fn drive(
    sim: &mut Simulation,
    grid: &SampleGrid,
    recorder: &mut Recorder,
    stop: &AtomicBool,
) -> Result<Ending, CliError> {
    recorder.sample(sim, 0)?;
    for step in 1..=grid.steps {
        sim.begin(grid.time(step));
        loop {
            match sim.work(PREDICTIONS) {
                Ok(Progress::Event(event)) => recorder.event(sim, &event, step)?,
                Ok(Progress::Working) => {}
                Ok(Progress::Done) => break,
                Err(fault) => return Ok(Ending::Faulted(fault)),
            }
            if let Some(ending) = reason_to_stop(sim, recorder, stop)? {
                return Ok(ending);
            }
        }
        recorder.sample(sim, step)?;
        if let Some(ending) = reason_to_stop(sim, recorder, stop)? {
            return Ok(ending);
        }
    }
    Ok(Ending::Finished)
}

fn reason_to_stop(
    sim: &Simulation,
    recorder: &mut Recorder,
    stop: &AtomicBool,
) -> Result<Option<Ending>, CliError> {
    recorder.tick(sim)?;
    Ok(if stop.load(Ordering::Relaxed) {
        Some(Ending::Interrupted)
    } else if recorder.nobody_listens() {
        Some(Ending::NobodyListens)
    } else {
        None
    })
}
