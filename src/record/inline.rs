//! The inline runner: carries out every command before it returns. For tests and tools; it never sleeps.

use std::sync::Arc;

use super::publish::{Pace, frame_of};
use super::recorder::RunRecorder;
use super::{Frame, RunCommand, RunState, Runner};

/// Runs on the caller's thread. While it plays, [`Runner::tick`] is its clock.
#[derive(Debug, Default)]
pub struct InlineRunner {
    recorder: RunRecorder,
    frame: Arc<Frame>,
}

impl InlineRunner {
    pub fn new() -> Self {
        Self::default()
    }

    fn settle(&mut self) {
        while self.recorder.work(u32::MAX) {}
        self.frame = Arc::new(frame_of(&mut self.recorder, self.frame.revision + 1, Pace::default()));
    }
}

impl Runner for InlineRunner {
    fn send(&mut self, command: RunCommand) {
        self.recorder.command(command);
        self.settle();
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
