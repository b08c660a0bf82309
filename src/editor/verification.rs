//! A recording that is opened is run again a second time, in the background, and compared with what it recorded.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, channel};

use super::Notice;
use crate::record::{Compared, Limits, RecordingFile, Rerun, RerunError};

/// How far a comparison is, or what came of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Verified {
    /// From 0 to 1.
    Part(f32),
    Same(String),
    Differs(String),
    /// Nobody knows, and why.
    Unknown(String),
}

/// A comparison. Dropped, it is given up.
pub(super) struct Verification {
    cancel: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    outcome: Receiver<Result<Compared, RerunError>>,
    found: Option<Verified>,
}

/// Of the time that it takes, what making the run again has.
const RUN_SHARE: f64 = 0.5;

impl Verification {
    pub fn start(file: RecordingFile) -> Self {
        let (cancel, done) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU32::new(0)));
        let (sender, outcome) = channel();
        let (stop, part) = (cancel.clone(), done.clone());
        std::thread::spawn(move || {
            let go_on = |share: f64| {
                part.store((1000.0 * share) as u32, Ordering::Relaxed);
                !stop.load(Ordering::Relaxed)
            };
            let rerun = Rerun::of(file, Limits::default(), &mut |share| go_on(RUN_SHARE * share));
            let compared = rerun.and_then(|mut rerun| {
                rerun.verify(&mut |share| go_on(RUN_SHARE + (1.0 - RUN_SHARE) * share))
            });
            // the recording may be closed by now
            let _ = sender.send(compared);
        });
        Self { cancel, done, outcome, found: None }
    }

    /// What came of it, once.
    pub fn take(&mut self) -> Option<Notice> {
        if self.found.is_some() {
            return None;
        }
        let outcome = match self.outcome.try_recv() {
            Ok(outcome) => outcome,
            Err(std::sync::mpsc::TryRecvError::Empty) => return None,
            Err(std::sync::mpsc::TryRecvError::Disconnected) => {
                let text = "The comparison with the recording stopped without an answer".to_owned();
                self.found = Some(Verified::Unknown(text.clone()));
                return Some(Notice::warning(text));
            }
        };
        let (found, notice) = match outcome {
            Ok(Compared { same, left_out }) => {
                let more = if left_out > 0 {
                    format!("; {left_out} earlier ones were not kept")
                } else {
                    String::new()
                };
                let text = format!("The run is the recorded one: {same} states are the same{more}");
                (Verified::Same(text.clone()), Notice::info(text))
            }
            Err(RerunError::Parted { message, .. }) => {
                let text = format!("This is not the run that was recorded: {message}");
                (Verified::Differs(text.clone()), Notice::error(text))
            }
            Err(error) => {
                let text = format!("The run was not compared with its recording: {error}");
                (Verified::Unknown(text.clone()), Notice::warning(text))
            }
        };
        self.found = Some(found);
        Some(notice)
    }

    pub fn state(&self) -> Verified {
        let part = self.done.load(Ordering::Relaxed) as f32 / 1000.0;
        self.found.clone().unwrap_or(Verified::Part(part))
    }

    /// Gives it up; the next turn says so.
    pub fn stop(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

impl Drop for Verification {
    fn drop(&mut self) {
        self.stop();
    }
}
