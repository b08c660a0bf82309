//! The loop of a run: Δt after Δt, event after event, looking often for a reason to stop.

use super::recorder::Recorder;
use crate::cli::CliError;
use crate::cli::interrupt::Interrupt;
use crate::cli::samples::SampleGrid;
use crate::record::{Exceeded, PREDICTIONS, Watch};
use crate::sim::{Fault, Progress, Simulation};

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    Finished,
    /// Every reader of the output went away.
    NobodyListens,
    Interrupted,
    Faulted(Fault),
    /// A limit of the command line.
    Exceeded(Exceeded),
}

/// What may end a run before its end.
pub struct Stops<'a> {
    pub interrupt: &'a Interrupt,
    pub watch: Watch,
}

/// Runs `sim` over `grid` and takes down the state in which it ends, unless that is the state of a fault; an error means
/// that an output cannot be written.
pub fn drive(
    sim: &mut Simulation,
    grid: &SampleGrid,
    recorder: &mut Recorder,
    stops: &Stops,
) -> Result<Ending, CliError> {
    let ending = drive_on(sim, grid, recorder, stops)?;
    if !matches!(ending, Ending::Faulted(_)) {
        recorder.last(sim)?;
    }
    Ok(ending)
}

fn drive_on(
    sim: &mut Simulation,
    grid: &SampleGrid,
    recorder: &mut Recorder,
    stops: &Stops,
) -> Result<Ending, CliError> {
    let mut events = 0;
    recorder.sample(sim, 0)?;
    for step in 1..=grid.steps {
        sim.begin(grid.time(step));
        loop {
            match sim.work(PREDICTIONS) {
                Ok(Progress::Event(event)) => {
                    events += 1;
                    recorder.event(sim, &event, step)?;
                }
                Ok(Progress::Working) => {}
                Ok(Progress::Done) => break,
                Err(fault) => return Ok(Ending::Faulted(fault)),
            }
            if let Some(ending) = reason_to_stop(sim, recorder, stops, events)? {
                return Ok(ending);
            }
        }
        recorder.sample(sim, step)?;
        // At the end there is nothing left to stop.
        if step < grid.steps
            && let Some(ending) = reason_to_stop(sim, recorder, stops, events)?
        {
            return Ok(ending);
        }
    }
    Ok(Ending::Finished)
}

fn reason_to_stop(
    sim: &Simulation,
    recorder: &mut Recorder,
    stops: &Stops,
    events: u64,
) -> Result<Option<Ending>, CliError> {
    recorder.tick(sim)?;
    Ok(if stops.interrupt.is_raised() {
        Some(Ending::Interrupted)
    } else if recorder.nobody_listens() {
        Some(Ending::NobodyListens)
    } else {
        stops.watch.exceeded(events).map(Ending::Exceeded)
    })
}
