//! Going back: a run is put back to a snapshot and simulates again from there, with the same bits.

use super::history::{Moment, Tick};
use super::run::{Rows, Run};

impl Run {
    /// Back to the beginning of the open Δt, or else of the last one.
    pub(super) fn step_back(&mut self) {
        let Some((tick, before)) = self.history.last_ticks(self.simulation.time()) else { return };
        self.replay(before.unwrap_or(tick), |run| {
            if let Some(before) = before {
                run.grid = tick.grid.reopened(before.at.time, tick.at.time);
            }
            run.run_to(tick.at);
            if !run.faulted {
                run.grid = tick.grid;
            }
        });
    }

    /// Back to the event before the one now looked at; the Δt around it is open then.
    pub(super) fn event_back(&mut self) {
        let history = &self.history;
        // After the end of a Δt the last event is itself the one before.
        let at_event =
            history.time_of(self.last_event) == Some(self.simulation.time()) && self.grid.open.is_some();
        let target = if at_event { self.last_event.saturating_sub(1) } else { self.last_event };
        if self.history.time_of(target).is_none() {
            self.message = Some("there is no recorded event before this one".into());
            return;
        }
        self.back_to_event(target);
    }

    /// Back to an event that was reached before; the Δt around it is open then.
    pub(super) fn back_to_event(&mut self, event: u64) {
        let Some(time) = self.history.time_of(event) else { return };
        let target = Moment { event, time };
        let Some((tick, after)) = self.history.ticks_around(target) else { return };
        let around = match after {
            Some(after) => after.grid.reopened(tick.at.time, after.at.time),
            None => self.grid,
        };
        self.replay(tick, |run| {
            run.grid = around;
            run.run_to(target);
        });
    }

    /// Puts the run back to where it was at `from` and lets `then` go on from there, with the table filled
    /// by what it passes. What goes wrong on the way is left as the message.
    fn replay(&mut self, from: Tick, then: impl FnOnce(&mut Self)) {
        let Some(key) = self.history.rewind(from.at) else { return };
        self.simulation.restore(&key.snapshot);
        self.grid = key.grid;
        self.last_event = key.at.event;
        self.drift.rewind(&self.simulation, key.at.event);
        self.faulted = false;
        self.message = None;
        self.run_to(from.at);
        if !self.faulted {
            self.rows = Rows::default();
            then(self);
        }
    }

    /// Simulates again up to a moment, Δt by Δt as before, with the edits on the way applied at their stamps.
    fn run_to(&mut self, target: Moment) {
        while !self.faulted {
            let now = self.simulation.time();
            let open = self.grid.open.map(|(_, end)| end).filter(|end| *end > now);
            let end = self.history.next_tick(now).or(open).unwrap_or(target.time);
            self.begin_until(end, target.time);
            if self.last_event >= target.event && self.simulation.time() >= target.time {
                return;
            }
            match self.simulation.next_event() {
                Ok(Some(event)) => self.note(&event),
                Ok(None) if self.simulation.time() < target.time => {}
                Ok(None) => return,
                Err(fault) => self.stop_at(&fault),
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by stopping")]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};

    use glam::DVec3;

    use super::Run;
    use crate::record::publish::{Pace, frame_of};
    use crate::record::recorder::RunRecorder;
    use crate::record::{Frame, RunCommand, RunState};
    use crate::scene::{Document, NodeKey};
    use crate::sim::{Force, SimEdit, Simulation, Subject};

    /// No force, or one that is not a number.
    #[derive(Debug, Default)]
    struct Breakable(AtomicBool);

    impl Force for Breakable {
        fn force(&self, _: &Subject<'_>) -> DVec3 {
            if self.0.load(Ordering::Relaxed) { DVec3::NAN } else { DVec3::ZERO }
        }

        fn potential(&self, _: &Subject<'_>) -> Option<f64> {
            Some(0.0)
        }
    }

    fn recorder(force: Option<Arc<Breakable>>) -> RunRecorder {
        let document = Document::from_bytes(include_bytes!("../../scenes/bounce.xml"));
        let scene = document.scene().unwrap().clone();
        let mut simulation = Simulation::new(&scene).unwrap();
        if let Some(force) = force {
            simulation.add_force(force).unwrap();
        }
        let mut recorder = RunRecorder::default();
        recorder.run = Some(Run::new(simulation, Box::new(scene)));
        recorder
    }

    fn frame_after(recorder: &mut RunRecorder, command: RunCommand) -> Frame {
        recorder.command(command);
        while recorder.work(u32::MAX) {}
        frame_of(recorder, 1, Pace::default())
    }

    /// Symptom: a step back that met a fault showed a frame of another time, and no fault.
    /// Expected: the frame is faulted and has the reason; going back to the start still helps.
    /// Cause: errors of the steps that are simulated again were dropped.
    #[test]
    fn a_fault_on_the_way_back_reaches_the_frame() {
        let force = Arc::new(Breakable::default());
        let mut recorder = recorder(Some(force.clone()));
        let forward = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 3 });
        assert_eq!((forward.state, forward.fault), (RunState::Paused, None));

        force.0.store(true, Ordering::Relaxed);
        let back = frame_after(&mut recorder, RunCommand::StepBack);
        assert_eq!(back.state, RunState::Faulted);
        assert!(back.fault.is_some_and(|fault| fault.starts_with("at t = ")));

        force.0.store(false, Ordering::Relaxed);
        let reset = frame_after(&mut recorder, RunCommand::Reset);
        assert_eq!((reset.state, reset.fault, reset.time), (RunState::Paused, None, 0.0));
    }

    /// Symptom: a recorded edit that the simulation refused when run again was left out without a word.
    /// Expected: the frame has the reason.
    /// Cause: the result of applying a recorded edit was dropped.
    #[test]
    fn an_edit_refused_when_run_again_reaches_the_frame() {
        let mut recorder = recorder(None);
        frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 2 });
        let run = recorder.run.as_mut().unwrap();
        let unknown = SimEdit::Remove(NodeKey(u32::MAX.into()));
        let reason = run.simulation.apply(&unknown).unwrap_err().to_string();
        run.history.note_edit(&run.simulation, run.grid, run.last_event, &unknown);

        (0..2).for_each(|_| drop(frame_after(&mut recorder, RunCommand::StepBack)));
        let again = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 2 });
        assert_eq!(again.state, RunState::Paused);
        let message = again.fault.unwrap();
        assert!(message.contains("edit made at 0.5 s") && message.ends_with(&reason), "{message}");
    }
}
