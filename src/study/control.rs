//! How whoever started a study follows it and ends it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// What a study is doing.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyProgress {
    /// Share of the work done, 0 to 1; a guess.
    pub part: f64,
    /// One line for a person.
    pub what: String,
}

/// The line to whoever started a study.
pub struct Control<'a> {
    cancel: &'a AtomicBool,
    deadline: Option<Instant>,
    report: &'a mut dyn FnMut(&StudyProgress),
    /// The stage that is going on: its name, where it starts and which share of the whole it is.
    stage: (String, f64, f64),
    /// Sums of shares round; a bar must not go back for that.
    shown: f64,
}

impl<'a> Control<'a> {
    /// `cancel` ends the study soon after it becomes true; `report` is called often, from the study's thread.
    pub fn new(cancel: &'a AtomicBool, report: &'a mut dyn FnMut(&StudyProgress)) -> Self {
        Self { cancel, deadline: None, report, stage: (String::new(), 0.0, 1.0), shown: 0.0 }
    }

    /// Ends the study after so much wall-clock time from now, if there is such a limit.
    pub fn until(mut self, wall: Option<Duration>) -> Self {
        self.deadline = wall.and_then(|wall| Instant::now().checked_add(wall));
        self
    }

    /// Whether to end now.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed) || self.is_late()
    }

    /// Whether it would end for its time alone.
    pub(super) fn is_out_of_time(&self) -> bool {
        !self.cancel.load(Ordering::Relaxed) && self.is_late()
    }

    fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    pub(super) fn begin(&mut self, what: String, start: f64, share: f64) {
        self.stage = (what, start, share);
        self.show(0.0);
    }

    /// `part` of the stage is done.
    pub(super) fn show(&mut self, part: f64) {
        let (what, start, share) = &self.stage;
        self.shown = (start + share * part.clamp(0.0, 1.0)).clamp(self.shown, 1.0);
        (self.report)(&StudyProgress { part: self.shown, what: what.clone() });
    }
}
