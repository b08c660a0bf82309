//! Going back: a run is put back to a snapshot and simulates again from there, with the same bits. That is done
//! in portions, so that it can be given up; then the run rests where it is.

use super::grid::StepGrid;
use super::history::Moment;
use super::run::{PREDICTIONS, Rows, Run};
use crate::sim::Progress;

/// A way back that is not at its end yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Replay {
    target: Moment,
    /// The grid at the target, if that is the end of a Δt.
    arrived: Option<StepGrid>,
    /// The grid where going back began: its Δt may be one without a recorded end.
    latest: StepGrid,
}

impl Run {
    /// Back to the beginning of the open Δt, or else of the last one.
    pub(super) fn step_back(&mut self) -> Option<Replay> {
        let (tick, before) = self.history.last_ticks(self.simulation.time())?;
        self.go_back(before.unwrap_or(tick).at, tick.at, Some(tick.grid))
    }

    /// Back to the event before the one now looked at; the Δt around it is open then.
    pub(super) fn event_back(&mut self) -> Option<Replay> {
        let history = &self.history;
        // After the end of a Δt the last event is itself the one before.
        let at_event =
            history.time_of(self.last_event) == Some(self.simulation.time()) && self.grid.open.is_some();
        let target = if at_event { self.last_event.saturating_sub(1) } else { self.last_event };
        if self.history.time_of(target).is_none() {
            self.message = Some("there is no recorded event before this one".into());
            return None;
        }
        self.back_to_event(target)
    }

    /// Back to an event that was reached before; the Δt around it is open then.
    pub(super) fn back_to_event(&mut self, event: u64) -> Option<Replay> {
        let target = Moment { event, time: self.history.time_of(event)? };
        let tick = self.history.tick_before(target)?;
        self.go_back(tick.at, target, None)
    }

    /// Puts the run back to a snapshot not after `from`, the beginning of the Δt whose events the table shall
    /// show at the target. What goes wrong on the way is left as the message.
    fn go_back(&mut self, from: Moment, target: Moment, arrived: Option<StepGrid>) -> Option<Replay> {
        let latest = self.grid;
        let key = self.history.rewind(from)?;
        self.simulation.restore(&key.snapshot);
        self.grid = key.grid;
        self.last_event = key.at.event;
        self.drift.rewind(&self.simulation, key.at.event);
        self.faulted = false;
        self.message = None;
        let replay = Replay { target, arrived, latest };
        if self.grid.open.is_some() {
            // A snapshot of an edit: the Δt around it may have been divided anew since.
            self.reopen_step(&replay);
        }
        self.rows = Rows { truncated: self.grid.open.is_some(), ..Rows::default() };
        Some(replay)
    }

    /// One portion of the way, Δt by Δt as before, with the edits on it applied at their stamps; whether the
    /// target is reached.
    pub(super) fn replay(&mut self, replay: &Replay) -> bool {
        let Moment { event, time } = replay.target;
        if self.last_event >= event && self.simulation.time() >= time {
            self.arrive(replay);
            return true;
        }
        if self.grid.open.is_none() {
            self.reopen_step(replay);
            self.rows = Rows::default();
        }
        let end = self.grid.open.map_or(time, |(_, end)| end);
        self.begin_until(end, time);
        match self.simulation.work(PREDICTIONS) {
            Ok(Progress::Event(event)) => self.note(&event),
            Ok(Progress::Working) => {}
            Ok(Progress::Done) => {
                if self.simulation.time() >= end && self.grid.open.is_some() {
                    self.grid.close();
                }
                if self.simulation.time() >= time {
                    self.arrive(replay);
                    return true;
                }
            }
            Err(fault) => self.stop_at(&fault),
        }
        false
    }

    /// Edits made at the target belong to it.
    fn arrive(&mut self, replay: &Replay) {
        self.apply_due_edits();
        if let Some(grid) = replay.arrived {
            self.grid = grid;
        }
    }

    /// Opens the recorded Δt that now lies in.
    fn reopen_step(&mut self, replay: &Replay) {
        let now = self.simulation.time();
        match self.history.ticks_around(now) {
            (before, Some(after)) => {
                let start = before.map_or(now, |before| before.at.time);
                self.grid = after.grid.reopened(start, after.at.time);
            }
            (_, None) if replay.latest.open.is_some_and(|(_, end)| end > now) => self.grid = replay.latest,
            (_, None) => self.grid.open = None,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

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
        recorder.run = Some(Run::new(simulation, Arc::new(scene)));
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
        run.history.note_edits(&run.simulation, run.grid, run.last_event, vec![unknown]);

        (0..2).for_each(|_| drop(frame_after(&mut recorder, RunCommand::StepBack)));
        let again = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 2 });
        assert_eq!(again.state, RunState::Paused);
        let message = again.fault.unwrap();
        assert!(message.contains("edit made at 0.5 s") && message.ends_with(&reason), "{message}");
    }

    /// Symptom: while a run went back, pause and reset waited until it had arrived, for minutes in large scenes.
    /// Expected: it goes back in portions of bounded work, and a pause leaves it inside a Δt from which it can go
    /// on with the same bits.
    /// Cause: going back simulated the whole way inside one command.
    #[test]
    fn going_back_is_done_in_portions_and_can_be_given_up() {
        let mut recorder = recorder(None);
        let last = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 8 });
        assert!(last.event_count > 0, "{} events", last.event_count);

        recorder.command(RunCommand::StepBack);
        assert!(recorder.work(2));
        let way = frame_of(&mut recorder, 1, Pace::default());
        assert_eq!((way.state, way.time < 1.75), (RunState::Busy, true));
        let (start, end) = way.step.unwrap();
        assert!(
            start <= way.time && way.time <= end && end - start == 0.25,
            "{:?} at {}",
            way.step,
            way.time
        );

        let paused = frame_after(&mut recorder, RunCommand::Pause);
        assert_eq!((paused.state, paused.fault, paused.time), (RunState::Paused, None, way.time));
        frame_after(&mut recorder, RunCommand::FinishStep);
        while frame_of(&mut recorder, 1, Pace::default()).time < last.time {
            frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 1 });
        }
        let again = frame_of(&mut recorder, 1, Pace::default());
        assert_eq!((again.time, again.dt_index, &again.bodies), (last.time, last.dt_index, &last.bodies));
        assert_eq!((again.event_count, &again.events), (last.event_count, &last.events));
    }

    /// Symptom: an edit sent while a run went back was made somewhere on the way.
    /// Expected: it is made where the way ends.
    /// Cause: edits act at once on whatever state the simulation is in.
    #[test]
    fn an_edit_waits_until_going_back_is_done() {
        let mut recorder = recorder(None);
        let last = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 8 });
        recorder.command(RunCommand::StepBack);
        assert!(recorder.work(1));
        let key = last.bodies[0].key;
        let frame = frame_after(&mut recorder, RunCommand::Edit(vec![SimEdit::Remove(key)]));
        assert_eq!((frame.time, frame.bodies.len() + 1), (1.75, last.bodies.len()));
    }
}
