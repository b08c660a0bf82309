//! Bringing the simulation to what is shown: it is put back to a keyframe and simulates again from there, with the same bits.
//! That is done in portions, so that it can be given up for another place.

use super::grid::StepGrid;
use super::limits::PREDICTIONS;
use super::moment::Moment;
use super::run::Run;
use crate::sim::{Event, Progress};

impl Run {
    /// One portion of the way of the simulation to the cursor; whether it is there.
    pub(super) fn settle(&mut self) -> bool {
        if self.is_settled() {
            return true;
        }
        self.leave_end();
        if !self.at.is_not_after(self.cursor) || self.is_nearer_from_keyframe() {
            self.rewind();
        }
        if !self.is_settled() {
            self.replay();
        }
        self.is_settled()
    }

    /// Keeps the end of what is known, so that going on from there needs no simulating again.
    fn leave_end(&mut self) {
        if self.at == self.recording.end && self.recording.keyframes.head().is_none() {
            self.recording.keep_head(&self.simulation);
        }
    }

    /// Goes to the end of what is known; whether the simulation is there.
    pub(super) fn go_to_end(&mut self) -> bool {
        self.cursor = self.recording.end;
        let is_there = self.settle();
        if is_there {
            self.recording.keyframes.take_head();
        }
        is_there
    }

    /// Whether a keyframe lies between the simulation and the cursor.
    fn is_nearer_from_keyframe(&self) -> bool {
        let key = self.recording.keyframes.before(self.cursor);
        key.is_some_and(|key| key.at != self.at && self.at.is_not_after(key.at))
    }

    /// Puts the simulation back to the last keyframe before the cursor.
    pub(super) fn rewind(&mut self) {
        let Some(key) = self.recording.keyframes.before(self.cursor) else { return };
        self.simulation.restore(&key.snapshot);
        (self.at, self.applied) = (key.at, key.edits);
        self.apply_due_edits();
    }

    /// Simulates again towards the cursor, Δt by Δt as before, with the edits on the way applied at their stamps.
    fn replay(&mut self) {
        let end = self.step_end(self.at.time).max(self.at.time);
        let edit = self.next_edit().unwrap_or(f64::INFINITY);
        let before = (self.at, self.applied);
        // A method that steps by Δt must know its end before it is asked to stop inside it.
        self.simulation.begin(end);
        self.simulation.begin(self.cursor.time.min(end).min(edit));
        let progress = self.simulation.work(PREDICTIONS);
        self.arrive(&progress);
        let is_done = matches!(progress, Ok(Progress::Done));
        match progress {
            Ok(Progress::Event(event)) => self.compare(&event),
            Ok(Progress::Working | Progress::Done) => {}
            Err(fault) => {
                // Met before, where it ended the run; anywhere else the run is no longer the same.
                self.cursor = self.at;
                self.stop_at(&fault);
            }
        }
        // Nothing taken is lost: it was recorded the first time.
        self.simulation.take_motion(|_| {});
        self.apply_due_edits();
        self.compare_state();
        let is_stuck = is_done && (self.at, self.applied) == before;
        if is_stuck || !self.at.is_not_after(self.cursor) {
            self.report_divergence("what is shown does not come again");
            self.cursor = self.at;
        }
    }

    /// End of the recorded Δt that begins or lies at a time.
    fn step_end(&self, time: f64) -> f64 {
        let next = self.recording.ticks.end_after(time);
        next.unwrap_or(self.recording.end.time.max(self.grid.open.map_or(time, |(_, end)| end)))
    }

    /// An event reached again must be the one recorded.
    fn compare(&mut self, event: &Event) {
        let recorded = self.recording.ledger.get(event.seq);
        if recorded.is_some_and(|recorded| !is_same(&recorded.event, event)) {
            self.report_divergence(&format!("event {} is another one", event.seq));
        }
    }

    /// The simulation must have the bits that it had at a keyframe.
    fn compare_state(&mut self) {
        let recorded = self.recording.keyframes.at(self.at).map(|key| (key.hash, key.edits));
        if recorded.is_some_and(|(hash, edits)| edits == self.applied && hash != self.simulation.hash()) {
            self.report_divergence("the state is another one");
        }
    }

    fn report_divergence(&mut self, what: &str) {
        let time = self.at.time;
        self.message.get_or_insert_with(|| {
            format!(
                "simulated again, the run differs from its recording from t = {time} s on: {what}. Please report this scene"
            )
            .into()
        });
    }

    /// When the next recorded edit was made, if no event more comes before it.
    fn next_edit(&self) -> Option<f64> {
        let next = self.recording.edits().get(self.applied)?.at;
        (next.event <= self.at.event).then_some(next.time)
    }

    /// Applies the recorded edits that were made right here.
    fn apply_due_edits(&mut self) {
        while let Some(due) =
            self.recording.edits().get(self.applied).filter(|due| due.at.is_not_after(self.at))
        {
            let (time, edits) = (due.at.time, due.edits.clone());
            self.applied += 1;
            // They were accepted in this very state before: a refusal means that the run is no longer the same.
            for refused in self.simulation.apply_all(&edits).into_iter().filter_map(Result::err) {
                let text = format!("the edit made at {time} s was refused when run again: {refused}");
                self.message = Some(text.into());
            }
        }
    }

    /// The grid of Δt as it stands at a moment of the recording.
    pub(super) fn grid_at(&self, moment: Moment) -> StepGrid {
        let (before, after) = self.recording.ticks.around(moment.time);
        match (before, after) {
            _ if moment == self.recording.end => self.recording.end_grid,
            (Some(before), _) if before.at == moment => before.grid,
            (before, Some(after)) => {
                after.grid.reopened(before.map_or(moment.time, |before| before.at.time), after.at.time)
            }
            (_, None) => self.recording.end_grid,
        }
    }
}

/// Bit for bit.
fn is_same(a: &Event, b: &Event) -> bool {
    (a.time.to_bits(), a.kind, a.a, a.b, a.impulse.to_bits())
        == (b.time.to_bits(), b.kind, b.a, b.b, b.impulse.to_bits())
}
