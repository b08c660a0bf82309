//! The loop of a run: Δt after Δt, event after event, looking for a reason to stop in between.

use std::sync::atomic::{AtomicBool, Ordering};

use super::recorder::Recorder;
use super::samples::SampleGrid;
use crate::cli::CliError;
use crate::sim::{Fault, Simulation};

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
            match sim.next_event() {
                Ok(Some(event)) => recorder.event(sim, &event, step)?,
                Ok(None) => break,
                Err(fault) => return Ok(Ending::Faulted(fault)),
            }
            if let Some(ending) = reason_to_stop(sim, recorder, stop)? {
                return Ok(ending);
            }
        }
        if let Err(fault) = sim.finish(&mut |_, _| {}) {
            return Ok(Ending::Faulted(fault));
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
