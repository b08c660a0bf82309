//! The inline runner: carries out every command before it returns. For tests and tools; it never sleeps.

use std::sync::Arc;

use super::file::{RecordingFile, file_of};
use super::publish::{Pace, frame_of};
use super::recorder::RunRecorder;
use super::{Exceeded, Frame, Limits, RunCommand, RunState, Runner, Watch};

/// Runs on the caller's thread. While it plays, [`Runner::tick`] is its clock.
#[derive(Debug, Default)]
pub struct InlineRunner {
    recorder: RunRecorder,
    frame: Arc<Frame>,
    /// Number of the last command.
    command: u64,
    watch: Option<Watch>,
    exceeded: Option<Exceeded>,
}

impl InlineRunner {
    pub fn new() -> Self {
        Self::default()
    }

    /// A runner that gives a command up where a limit is reached; its time begins now.
    pub fn limited(limits: Limits) -> Self {
        Self { watch: Some(Watch::start(limits)), ..Self::default() }
    }

    /// The recording so far as a file, of a scene with this name and these bytes; `None` without a simulation.
    pub fn recording(&self, scene_name: &str, scene: &[u8]) -> Option<RecordingFile> {
        self.recorder.run.as_ref().map(|run| file_of(run, scene_name, scene))
    }

    /// Hash of the simulation; `None` without one.
    pub fn hash(&self) -> Option<u64> {
        self.recorder.run.as_ref().map(|run| run.simulation.hash())
    }

    /// The limit that was reached, if one was.
    pub fn exceeded(&self) -> Option<Exceeded> {
        self.exceeded
    }

    /// As [`Runner::send`], but gives the command up when `go_on`, which hears the time reached, says so; whether it was
    /// carried out.
    pub fn send_while(&mut self, command: RunCommand, go_on: &mut dyn FnMut(f64) -> bool) -> bool {
        self.recorder.command(command);
        self.command += 1;
        let is_done = self.work_while(go_on);
        self.publish();
        is_done
    }

    /// Looks at the limits after one event, or a bounded amount of work.
    fn work_while(&mut self, go_on: &mut dyn FnMut(f64) -> bool) -> bool {
        while self.recorder.work(1) {
            let (events, time) =
                self.recorder.run.as_ref().map_or((0, 0.0), |run| (run.at.event, run.at.time));
            self.exceeded = self.watch.and_then(|watch| watch.exceeded(events));
            if self.exceeded.is_some() || !go_on(time) {
                self.recorder.command(RunCommand::Pause);
                return false;
            }
        }
        true
    }

    fn settle(&mut self) {
        if self.watch.is_some() {
            self.work_while(&mut |_| true);
        } else {
            while self.recorder.work(u32::MAX) {}
        }
        self.publish();
    }

    fn publish(&mut self) {
        self.frame =
            Arc::new(frame_of(&mut self.recorder, self.frame.revision + 1, self.command, Pace::default()));
    }
}

impl Runner for InlineRunner {
    fn send(&mut self, command: RunCommand) -> u64 {
        self.recorder.command(command);
        self.command += 1;
        self.settle();
        self.command
    }

    fn frame(&self) -> Arc<Frame> {
        self.frame.clone()
    }

    fn tick(&mut self, wall_s: f64) {
        // a simulation at rest publishes nothing new
        if self.recorder.state() == RunState::Playing {
            self.recorder.elapse(wall_s);
            self.settle();
        }
    }
}
