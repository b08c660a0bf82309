//! What a run leaves behind while it goes: rows, the worst overlap, the progress bar.

use std::time::{Duration, Instant};

use super::RunArgs;
use crate::cli::CliError;
use crate::cli::output::LineSink;
use crate::cli::progress::Progress;
use crate::cli::samples::SampleGrid;
use crate::cli::table::{Happened, Table, Wanted};
use crate::record::Cost;
use crate::sim::{Counters, Event, Simulation};

/// Rows reach their readers, and the bar moves, this often.
const TICK: Duration = Duration::from_millis(100);

/// Looking for overlaps costs more than a quiet Δt, so a run does it about this often.
const OVERLAP_LOOKS: u64 = 1000;

pub struct Recorder {
    states: Option<Table>,
    events: Option<Table>,
    wanted: Wanted,
    progress: Progress,
    last_tick: Instant,
    overlaps: Overlaps,
    /// States are written, and the worst overlap is looked for, every so many Δt and at the end.
    states_every: u64,
    overlap_every: u64,
    last_step: u64,
    /// The time, s, and the events until then of the state taken down last.
    taken_down: Option<(f64, u64)>,
    /// At the event before.
    counters: Counters,
    /// Whether the run has a purpose besides the rows.
    has_other_purpose: bool,
}

/// The deepest overlaps at the samples looked at, m.
#[derive(Clone, Copy, Default)]
pub struct Overlaps {
    /// When the run began; `None` before.
    first: Option<f64>,
    pub worst: f64,
}

impl Overlaps {
    pub(super) fn note(&mut self, depth: f64) {
        self.first.get_or_insert(depth);
        self.worst = self.worst.max(depth);
    }

    /// How much deeper than when the run began.
    pub fn more(&self) -> f64 {
        self.worst - self.first.unwrap_or(0.0)
    }
}

impl Recorder {
    /// Creates the output files.
    pub fn create(args: &RunArgs, grid: &SampleGrid, wanted: Wanted) -> Result<Self, CliError> {
        let states = args.states.as_deref().map(|path| args.rows.states(path)).transpose()?;
        let events = args.events.as_deref().map(|path| args.rows.events(path)).transpose()?;
        Ok(Self {
            has_other_purpose: args.final_scene.is_some()
                || args.json
                || (states.is_none() && events.is_none()),
            states,
            events,
            wanted,
            progress: Progress::new(grid.until, args.writes_to_stdout()),
            last_tick: Instant::now(),
            overlaps: Overlaps::default(),
            states_every: args.every,
            overlap_every: grid.steps.div_ceil(OVERLAP_LOOKS),
            last_step: grid.steps,
            taken_down: None,
            counters: Counters::default(),
        })
    }

    /// Takes down the state after the `step`-th Δt (0 at the start), where it is wanted.
    pub fn sample(&mut self, sim: &Simulation, step: u64) -> Result<(), CliError> {
        let is_last = step == self.last_step;
        if is_last || step.is_multiple_of(self.overlap_every) {
            self.look_for_overlap(sim);
        }
        if is_last || step.is_multiple_of(self.states_every) { self.take_down(sim) } else { Ok(()) }
    }

    /// Takes down the state of a run that ends here, wherever that is, unless that is done.
    pub fn last(&mut self, sim: &Simulation) -> Result<(), CliError> {
        if self.taken_down == Some(moment(sim)) {
            return Ok(());
        }
        self.look_for_overlap(sim);
        self.take_down(sim)
    }

    fn look_for_overlap(&mut self, sim: &Simulation) {
        self.overlaps.note(sim.worst_overlap());
    }

    fn take_down(&mut self, sim: &Simulation) -> Result<(), CliError> {
        self.taken_down = Some(moment(sim));
        self.states.as_mut().map_or(Ok(()), |table| table.state(sim, &self.wanted))
    }

    /// Takes down an event of the `dt_index`-th Δt.
    pub fn event(&mut self, sim: &Simulation, event: &Event, dt_index: u64) -> Result<(), CliError> {
        let Some(table) = &mut self.events else { return Ok(()) };
        let counters = sim.counters();
        let cost = Cost::between(&self.counters, &counters);
        self.counters = counters;
        let (a, b) = (sim.label(event.a), event.b.map(|b| sim.label(b)));
        table.event(&Happened { event, a, b, dt_index, cost }, &self.wanted)
    }

    /// Called often; acts every [`TICK`].
    pub fn tick(&mut self, sim: &Simulation) -> Result<(), CliError> {
        if self.last_tick.elapsed() < TICK {
            return Ok(());
        }
        self.last_tick = Instant::now();
        self.progress.show(sim.time(), Some(sim.counters().total_events()));
        self.flush()
    }

    /// Whether all that was asked for goes to pipes whose readers went away.
    pub fn nobody_listens(&self) -> bool {
        !self.has_other_purpose && self.sinks().all(LineSink::is_closed)
    }

    pub fn overlaps(&self) -> Overlaps {
        self.overlaps
    }

    /// Writes what is left and takes the bar away.
    pub fn close(&mut self) -> Result<(), CliError> {
        self.progress.clear();
        self.flush()
    }

    fn flush(&mut self) -> Result<(), CliError> {
        let tables = [&mut self.states, &mut self.events];
        tables.into_iter().flatten().try_for_each(|table| table.sink.flush())
    }

    fn sinks(&self) -> impl Iterator<Item = &LineSink> {
        self.states.iter().chain(&self.events).map(|table| &table.sink)
    }
}

fn moment(sim: &Simulation) -> (f64, u64) {
    (sim.time(), sim.counters().total_events())
}
