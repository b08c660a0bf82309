//! A loaded simulation on its grid of Δt, with the table of events and what is needed to go back.

use std::collections::VecDeque;
use std::sync::Arc;

use super::EventRow;
use super::drift::Drift;
use super::grid::StepGrid;
use super::history::History;
use crate::scene::Scene;
use crate::sim::{Event, Fault, Progress, SimEdit, Simulation};

/// Events of one Δt that are kept for the table; older ones are left out, and the frame says so.
const MAX_ROWS: usize = 20_000;

/// Predictions carried out between two looks at the budget: a Δt may hold millions that are no events.
pub(super) const PREDICTIONS: u32 = 16;

/// A loaded simulation with its Δt grid and its past.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) simulation: Simulation,
    pub(super) scene: Arc<Scene>,
    pub(super) grid: StepGrid,
    pub(super) rows: Rows,
    pub(super) history: History,
    pub(super) drift: Drift,
    /// Deepest overlap at any time looked at so far, m.
    pub(super) worst_overlap: f64,
    /// Number of the last event reached.
    pub(super) last_event: u64,
    /// The fault that stopped it, or why the last edit was refused.
    pub(super) message: Option<String>,
    pub(super) faulted: bool,
}

/// Events of the Δt being looked at.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    pub(super) list: VecDeque<Arc<EventRow>>,
    pub(super) truncated: bool,
}

/// What became of a Δt in a slice of work.
pub(super) enum Slice {
    /// The Δt is done.
    Done,
    /// An event was reached.
    Event,
    /// The slice is used up.
    Pause,
}

impl Run {
    pub(super) fn new(simulation: Simulation, scene: Arc<Scene>) -> Self {
        let history = History::new(&simulation, StepGrid::new());
        Self {
            worst_overlap: simulation.worst_overlap(),
            simulation,
            scene,
            grid: StepGrid::new(),
            rows: Rows::default(),
            history,
            drift: Drift::default(),
            last_event: 0,
            message: None,
            faulted: false,
        }
    }

    /// Goes on in the open Δt, or opens one, until an event, its end, or the end of the budget.
    pub(super) fn slice(&mut self, dt: f64, budget: &mut u32) -> Slice {
        let (_, end) = self.open_step(dt);
        if *budget == 0 {
            return Slice::Pause;
        }
        *budget -= 1;
        self.begin_until(end, end);
        match self.simulation.work(PREDICTIONS) {
            Ok(Progress::Event(event)) => {
                self.note(&event);
                Slice::Event
            }
            Ok(Progress::Working) => Slice::Pause,
            // The place of a recorded edit.
            Ok(Progress::Done) if self.simulation.time() < end => Slice::Pause,
            Ok(Progress::Done) => {
                self.close_step();
                self.apply_due_edits();
                Slice::Done
            }
            Err(fault) => {
                self.stop_at(&fault);
                Slice::Pause
            }
        }
    }

    /// Begins the Δt that ends at `end`, or goes on in it, up to `until` or to where the next recorded edit was
    /// made. Edits of this very moment are applied first.
    pub(super) fn begin_until(&mut self, end: f64, until: f64) {
        // A method that steps by Δt must know its end before it is asked to stop inside it.
        self.simulation.begin(end);
        self.apply_due_edits();
        // An edit ends the Δt; the rest of it is begun anew.
        self.simulation.begin(end);
        let edit = self.history.next_edit(self.last_event).unwrap_or(f64::INFINITY);
        self.simulation.begin(until.min(end).min(edit));
    }

    /// Applies the recorded edits that were made right here.
    pub(super) fn apply_due_edits(&mut self) {
        while let Some(due) = self.history.take_due_edits(self.last_event, self.simulation.time()) {
            // It was accepted in this very state before: a refusal means that the run is no longer the same.
            for edit in &due.edits {
                if let Err(refused) = self.simulation.apply(edit) {
                    let time = due.at.time;
                    self.message =
                        Some(format!("the edit made at {time} s was refused when run again: {refused}"));
                }
            }
        }
    }

    /// Notes a fault: nothing goes on from here but back.
    pub(super) fn stop_at(&mut self, fault: &Fault) {
        self.message = Some(fault.to_string());
        self.faulted = true;
    }

    fn open_step(&mut self, dt: f64) -> (f64, f64) {
        if self.grid.open.is_none() {
            self.grid.open(self.simulation.time(), dt);
            self.rows = Rows::default();
            let end = self.grid.open.map_or(0.0, |(_, end)| end);
            let lost = self.history.divide_time_anew(&self.simulation, self.last_event, end);
            if lost > 0 {
                self.message = Some(format!("{lost} edit(s) made later, with another Δt, no longer apply"));
            }
        }
        self.grid.open.unwrap_or_default()
    }

    fn close_step(&mut self) {
        self.grid.close();
        self.history.note_tick(&self.simulation, self.grid, self.last_event);
    }

    /// Enters an event into the table and the history.
    pub(super) fn note(&mut self, event: &Event) {
        self.last_event = event.seq;
        self.history.note_event(event);
        self.drift.note(&self.simulation, event);
        if self.rows.list.len() >= MAX_ROWS {
            self.rows.list.pop_front();
            self.rows.truncated = true;
        }
        self.rows.list.push_back(Arc::new(row_of(&self.simulation, event, self.grid.index())));
    }

    /// Looks for overlaps now. It costs a look through the tiles, so it is done when a frame is made.
    pub(super) fn look_for_overlap(&mut self) {
        self.worst_overlap = self.worst_overlap.max(self.simulation.worst_overlap());
    }

    /// Changes the scene now, between events, and records what was accepted with the time it was stamped with.
    pub(super) fn edit(&mut self, mut edits: Vec<SimEdit>) {
        let mut refusal = None;
        edits.retain(|edit| match self.simulation.apply(edit) {
            Ok(()) => true,
            Err(refused) => {
                refusal = Some(format!("the running simulation refused the edit: {refused}"));
                false
            }
        });
        if !edits.is_empty() {
            self.history.note_edits(&self.simulation, self.grid, self.last_event, edits);
            self.faulted = false;
        }
        self.message = refusal;
    }
}

fn row_of(simulation: &Simulation, event: &Event, dt_index: u64) -> EventRow {
    EventRow {
        event: *event,
        a_key: simulation.key(event.a),
        b_key: event.b.map(|b| simulation.key(b)),
        a_label: simulation.label(event.a).to_owned(),
        b_label: event.b.map_or(String::new(), |b| simulation.label(b).to_owned()),
        dt_index,
    }
}
