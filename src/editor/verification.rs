//! A recording that is opened is run again a second time, in the background, and compared with what it recorded.

use super::Notice;
use super::background::{Background, Lost};
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
    work: Background<Result<Compared, RerunError>>,
    found: Option<Verified>,
}

/// Of the time that it takes, what making the run again has.
const RUN_SHARE: f64 = 0.5;

impl Verification {
    pub fn start(file: RecordingFile) -> Self {
        // The session looks at it at every turn.
        let work = Background::start(
            || (),
            move |go_on| {
                let mut rerun = Rerun::of(file, Limits::default(), &mut |share| go_on(RUN_SHARE * share))?;
                rerun.verify(&mut |share| go_on(RUN_SHARE + (1.0 - RUN_SHARE) * share))
            },
        );
        Self { work, found: None }
    }

    /// What came of it, once.
    pub fn take(&mut self) -> Option<Notice> {
        if self.found.is_some() {
            return None;
        }
        let (found, notice) = match self.work.take()? {
            Err(Lost) => {
                let text = "The comparison with the recording stopped without an answer".to_owned();
                (Verified::Unknown(text.clone()), Notice::warning(text))
            }
            Ok(Ok(Compared { same, left_out })) => {
                let more = if left_out > 0 {
                    format!("; {left_out} earlier ones were not kept")
                } else {
                    String::new()
                };
                let text = format!("The run is the recorded one: {same} states are the same{more}");
                (Verified::Same(text.clone()), Notice::info(text))
            }
            Ok(Err(RerunError::Parted { message, .. })) => {
                let text = format!("This is not the run that was recorded: {message}");
                (Verified::Differs(text.clone()), Notice::error(text))
            }
            Ok(Err(error)) => {
                let text = format!("The run was not compared with its recording: {error}");
                (Verified::Unknown(text.clone()), Notice::warning(text))
            }
        };
        self.found = Some(found);
        Some(notice)
    }

    pub fn state(&self) -> Verified {
        self.found.clone().unwrap_or_else(|| Verified::Part(self.work.part()))
    }

    /// Gives it up; the next turn says so.
    pub fn stop(&self) {
        self.work.cancel();
    }
}
