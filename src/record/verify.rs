//! Runs a recording again, and says where the run parts from what was recorded.

use std::sync::Arc;

use super::file::{Checkpoint, RecordingError, RecordingFile};
use super::frame::{Frame, RunState};
use super::inline::InlineRunner;
use super::{Exceeded, Limits, RunCommand, Runner as _};

/// A run made again from its recording.
#[derive(Debug)]
pub struct Rerun {
    file: RecordingFile,
    runner: InlineRunner,
}

/// Why it is not the run that was recorded, or was not compared.
#[derive(Debug, thiserror::Error)]
pub enum RerunError {
    #[error("{0}")]
    Recording(#[from] RecordingError),
    #[error("stopped at t = {time} s: {why}")]
    Exceeded { time: f64, why: Exceeded },
    #[error("stopped at t = {time} s")]
    Cancelled { time: f64 },
    /// By this time, s, it is another run.
    #[error("{message}")]
    Parted { time: f64, message: String },
}

/// How many states were compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compared {
    pub same: usize,
    /// Those too early to be kept within the memory of a recording.
    pub left_out: usize,
}

/// Hears how much is done, from 0 to 1, and ends the work by `false`.
type GoOn<'a> = &'a mut dyn FnMut(f64) -> bool;

impl Rerun {
    /// Makes the run, with its edits, up to where the recording ends.
    pub fn of(file: RecordingFile, limits: Limits, go_on: GoOn<'_>) -> Result<Self, RerunError> {
        let document = file.document()?;
        let scene = RecordingFile::scene(&document)?;
        let commands = file.commands(&scene)?;
        let mut runner = InlineRunner::limited(limits);
        runner.send(RunCommand::Method(file.method()?));
        runner.send(RunCommand::Load(Arc::new(scene)));
        let end = file.end.time;
        let mut rerun = Self { file, runner };
        for command in commands {
            rerun.send(command, &mut |time| go_on(if end > 0.0 { time / end } else { 1.0 }))?;
        }
        rerun.check_end()?;
        Ok(rerun)
    }

    pub fn file(&self) -> &RecordingFile {
        &self.file
    }

    /// Where the run stands, to go elsewhere in it.
    pub fn runner(&mut self) -> &mut InlineRunner {
        &mut self.runner
    }

    fn send(&mut self, command: RunCommand, go_on: GoOn<'_>) -> Result<(), RerunError> {
        let is_done = self.runner.send_while(command, go_on);
        let time = self.runner.frame().time;
        match self.runner.exceeded() {
            Some(why) => Err(RerunError::Exceeded { time, why }),
            None if !is_done => Err(RerunError::Cancelled { time }),
            None => Ok(()),
        }
    }

    /// The run has to come to the recorded end.
    fn check_end(&self) -> Result<(), RerunError> {
        let (end, time, events) = (self.runner.frame(), self.file.end.time, self.file.end.event);
        let parted = |message: String| Err(RerunError::Parted { time: end.time, message });
        match (end.complaint(), end.state) {
            (_, RunState::Faulted) if end.time == time => Ok(()),
            (Some(message), _) => parted(format!("it cannot be run again: {message}")),
            (None, _) if (end.time, end.event_count) != (time, events) => parted(format!(
                "it came to t = {} s with {} events where {time} s and {events} were recorded",
                end.time, end.event_count
            )),
            (None, _) => Ok(()),
        }
    }

    /// Compares the states with those that were recorded.
    pub fn verify(&mut self, go_on: GoOn<'_>) -> Result<Compared, RerunError> {
        let checkpoints = self.file.checkpoints.clone();
        let mut compared = Compared { same: 0, left_out: 0 };
        let mut last = Checkpoint { at: super::Moment::default(), hash: String::new(), line: None };
        for (nth, checkpoint) in checkpoints.iter().enumerate() {
            if checkpoint.at.time < self.runner.frame().recorded.from {
                compared.left_out += 1;
                continue;
            }
            let part = nth as f64 / checkpoints.len() as f64;
            self.send(RunCommand::Show(checkpoint.at), &mut |_| go_on(part))?;
            let hash = self.runner.hash().map(|hash| format!("{hash:016x}"));
            let frame = self.runner.frame();
            if hash.as_deref() != Some(checkpoint.hash.as_str()) || frame.complaint().is_some() {
                let line = checkpoint.line.map_or_else(String::new, |line| format!(", line {line}"));
                let parted = parting(&last, checkpoint, &frame);
                let message = format!("checkpoint {}{line}: {parted}", nth + 1);
                return Err(RerunError::Parted { time: checkpoint.at.time, message });
            }
            compared.same += 1;
            last = checkpoint.clone();
        }
        Ok(compared)
    }
}

/// Between two states of which the first is still the same: when, and what happens there first in the run made again.
fn parting(last: &Checkpoint, checkpoint: &Checkpoint, frame: &Frame) -> String {
    let (from, to, event) = (last.at.time, checkpoint.at.time, checkpoint.at.event);
    if (frame.time, frame.event_count) != (to, event) {
        return format!(
            "it is at no place of the run: {}; the run parts from the recording after t = {from} s, or the file is damaged",
            frame.complaint().unwrap_or("it is not reached")
        );
    }
    let why = frame.complaint().unwrap_or("the state is another one");
    let first = frame.ledger.get(last.at.event + 1).filter(|row| row.event.time <= to);
    let first = first.map_or_else(
        || "nothing happens in between".to_owned(),
        |row| {
            let with = if row.b_key.is_some() { format!(" and {}", row.b_label) } else { String::new() };
            let (seq, kind, time) = (row.event.seq, row.event.kind.name(), row.event.time);
            format!("the first event in between is {seq}, {kind} of {}{with} at t = {time} s", row.a_label)
        },
    );
    format!(
        "the run parts from the recording after t = {from} s and before {to} s, event {event}: {why}; {first}"
    )
}
