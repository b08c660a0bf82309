//! What a recording's numbers may be: what a run could have taken, by the limits that runs are held to.

use super::error::RecordingError;
use super::{Moment, RecordingFile};
use crate::record::limits::LATEST_TIME;

/// Δt of a run: weeks of them at sixty in a second.
const MOST_STEPS: u64 = 100_000_000;

type Checked = Result<(), RecordingError>;

impl RecordingFile {
    /// Names the first field that a run could not have written.
    pub(super) fn check(&self) -> Checked {
        steps(self)?;
        time("end.time", self.end.time)?;
        for (nth, edits) in self.edits.iter().enumerate() {
            time(&format!("edits[{nth}].at.time"), edits.at.time)?;
        }
        for (nth, checkpoint) in self.checkpoints.iter().enumerate() {
            time(&format!("checkpoints[{nth}].at.time"), checkpoint.at.time)?;
        }
        for (nth, bookmark) in self.bookmarks.iter().enumerate() {
            time(&format!("bookmarks[{nth}].time"), bookmark.time)?;
        }
        in_order(self)?;
        self.method().map(|_| ())
    }
}

fn wrong(what: String) -> Checked {
    Err(RecordingError::Content(what))
}

/// A time, s, of a run.
fn time(field: &str, time: f64) -> Checked {
    if (0.0..=LATEST_TIME).contains(&time) {
        return Ok(());
    }
    wrong(format!("{field} is {time:?}, and has to be from 0 to {LATEST_TIME:e} s"))
}

fn steps(file: &RecordingFile) -> Checked {
    let mut sum: u64 = 0;
    for (nth, steps) in file.steps.iter().enumerate() {
        let dt = steps.dt;
        if !(dt > 0.0 && dt <= LATEST_TIME) {
            let limits = format!("has to be above 0 and at most {LATEST_TIME:e} s");
            return wrong(format!("steps[{nth}].dt is {dt:?}, and {limits}"));
        }
        let count = steps.count;
        sum = sum.saturating_add(count);
        if count == 0 {
            return wrong(format!("steps[{nth}].count is 0, and has to be at least 1"));
        }
        if sum > MOST_STEPS {
            let limit = format!("that is more than the {MOST_STEPS} Δt that a run can take");
            return wrong(format!("steps[{nth}].count is {count}, {sum} with those before: {limit}"));
        }
    }
    Ok(())
}

/// Edits and checkpoints come one after the other, and before the end.
fn in_order(file: &RecordingFile) -> Checked {
    let edits: Vec<_> = file.edits.iter().map(|edits| edits.at).collect();
    one_after_the_other("edits", &edits, file.end)?;
    let checkpoints: Vec<_> = file.checkpoints.iter().map(|checkpoint| checkpoint.at).collect();
    one_after_the_other("checkpoints", &checkpoints, file.end)
}

fn one_after_the_other(field: &str, moments: &[Moment], end: Moment) -> Checked {
    let following = moments.iter().skip(1).chain([&end]);
    let mut pairs = moments.iter().zip(following).enumerate();
    let at = |moment: &Moment| format!("after event {} at {:?} s", moment.event, moment.time);
    match pairs.find(|(_, (one, next))| !one.is_not_after(**next)) {
        Some((nth, (one, next))) => {
            let what = if nth + 1 < moments.len() { format!("the next {field}") } else { "the end".into() };
            wrong(format!("{field}[{nth}].at is {}, and {what} {}, which is before", at(one), at(next)))
        }
        None => Ok(()),
    }
}
