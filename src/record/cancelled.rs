//! Which predicted impacts an event cancelled. The queue of the core forgets them one by one as their turn comes, so a copy of the
//! simulation goes from a keyframe to the event again, and what was predicted right before it is compared with what is right after.

use std::collections::HashMap;
use std::sync::Arc;

use super::ledger::EventRow;
use super::limits::PREDICTIONS;
use super::moment::Moment;
use super::run::Run;
use super::ways::{Cancelled, CancelledImpact};
use crate::sim::{BodyRef, Method, PredictedImpact, Progress, Simulation};

/// Two predictions of one impact made at different times differ by rounding, of their time.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Finds them for the event shown, while somebody wants to know.
#[derive(Debug, Default)]
pub(super) struct Cancelling {
    pub(super) is_wanted: bool,
    search: Option<Box<Search>>,
    found: Option<Arc<Cancelled>>,
}

/// On the way to an event with a copy of the simulation.
#[derive(Debug)]
struct Search {
    row: Arc<EventRow>,
    simulation: Simulation,
    at: Moment,
    /// Recorded edits that the copy has behind it.
    applied: usize,
    /// Right before the event, and right after it.
    goals: [Moment; 2],
    /// What was predicted right before it, once the copy was there.
    before: Option<Vec<PredictedImpact>>,
}

impl Cancelling {
    /// What is known of the event shown.
    pub(super) fn found(&self, run: &Run) -> Option<Arc<Cancelled>> {
        let event = run.event_shown()?.event.seq;
        self.found.clone().filter(|found| self.is_wanted && found.event == event)
    }

    /// Another run, or another past: what is known of events is so no more.
    pub(super) fn forget(&mut self) {
        (self.search, self.found) = (None, None);
    }

    /// So many portions of the search for the event shown; whether there is more to do.
    pub(super) fn advance(&mut self, run: &Run, portions: u32) -> bool {
        let row = run.event_shown().filter(|_| self.is_wanted);
        let Some(row) =
            row.filter(|row| self.found.as_ref().is_none_or(|found| found.event != row.event.seq))
        else {
            self.search = None;
            return false;
        };
        let mut search = self.search.take().filter(|search| Arc::ptr_eq(&search.row, row));
        for _ in 0..portions {
            let going = search.take().or_else(|| Search::new(run, row).map(Box::new));
            let outcome = match going {
                Some(mut going) => {
                    let outcome = going.portion(run);
                    search = Some(going);
                    outcome
                }
                None => Some(Err("the methods that step by Δt predict nothing".to_owned())),
            };
            if let Some(outcome) = outcome {
                let (impacts, problem) = match outcome {
                    Ok(impacts) => (impacts, None),
                    Err(problem) => (Vec::new(), Some(problem)),
                };
                self.found = Some(Arc::new(Cancelled { event: row.event.seq, impacts, problem }));
                return false;
            }
        }
        self.search = search;
        true
    }
}

impl Search {
    /// From the last keyframe before the event; `None` where nothing is predicted.
    fn new(run: &Run, row: &Arc<EventRow>) -> Option<Self> {
        let (first, _) = rows_of(row);
        let goals = [before(run, first, row.event.time), Moment::right_after(first, row.event.time)];
        let key = run.recording.keyframes.before(goals[0])?;
        let simulation = key.snapshot.simulation().clone();
        (simulation.method() == Method::Exact).then(|| Self {
            row: row.clone(),
            simulation,
            at: key.at,
            applied: key.edits,
            goals,
            before: None,
        })
    }

    /// One portion of the way, and at its end what was found.
    fn portion(&mut self, run: &Run) -> Option<Result<Vec<CancelledImpact>, String>> {
        self.apply_due_edits(run);
        if self.before.is_none() && self.at == self.goals[0] {
            self.before = Some(self.simulation.predicted_impacts());
        }
        let goal = if self.before.is_some() { self.goals[1] } else { self.goals[0] };
        if self.at == goal {
            return Some(Ok(self.compare(run)));
        }
        let edit = run.recording.edits().get(self.applied).map_or(f64::INFINITY, |edit| edit.at.time);
        let from = self.at;
        self.simulation.begin(goal.time.min(edit));
        match self.simulation.work(PREDICTIONS) {
            Ok(Progress::Event(event)) => self.at = Moment::right_after(event.seq, event.time),
            Ok(Progress::Working) => (self.at.time, self.at.is_over) = (self.simulation.time(), false),
            Ok(Progress::Done) => (self.at.time, self.at.is_over) = (self.simulation.time(), true),
            Err(fault) => return Some(Err(fault.to_string())),
        }
        // It was recorded the first time.
        self.simulation.take_motion(|_| {});
        let is_stuck = self.at == from && self.at.is_over && edit > self.at.time;
        (is_stuck || !self.at.is_not_after(goal))
            .then(|| Err("simulated again, the run does not come to this event".to_owned()))
    }

    /// Applies the recorded edits that were made right here.
    fn apply_due_edits(&mut self, run: &Run) {
        let edits = run.recording.edits().iter().skip(self.applied);
        for due in edits.take_while(|due| due.at.is_not_after(self.at)) {
            self.applied += 1;
            self.simulation.apply_all(&due.edits);
        }
    }

    /// What was predicted before the event, and neither happened by it nor is predicted for the same time after it.
    fn compare(&self, run: &Run) -> Vec<CancelledImpact> {
        let (first, last) = rows_of(&self.row);
        let rows = (first..=last).filter_map(|number| run.recording.ledger.get(number));
        let happened: Vec<(BodyRef, Option<BodyRef>)> = rows.map(|row| (row.event.a, row.event.b)).collect();
        let after = self.simulation.predicted_impacts();
        let after: HashMap<(BodyRef, BodyRef), f64> =
            after.into_iter().map(|impact| ((impact.a, impact.b), impact.time)).collect();
        let before = self.before.iter().flatten();
        let gone = before.filter(|impact| !happened.contains(&(impact.a, Some(impact.b))));
        gone.filter_map(|impact| {
            let now = after.get(&(impact.a, impact.b)).copied();
            let is_kept = now.is_some_and(|now| (now - impact.time).abs() <= ROUNDING * impact.time);
            (!is_kept).then(|| CancelledImpact {
                keys: [impact.a, impact.b].map(|body| self.simulation.key(body)),
                labels: [impact.a, impact.b].map(|body| self.simulation.shared_label(body)),
                time: impact.time,
                now,
            })
        })
        .collect()
    }
}

/// Numbers of the first and the last row of the impact that a row belongs to.
pub(super) fn rows_of(row: &EventRow) -> (u64, u64) {
    let [nth, of] = row.event.row_in_group.map(u64::from);
    (row.event.seq - nth.saturating_sub(1), row.event.seq + of.saturating_sub(nth))
}

/// Right before an event: after all that happened earlier, or after the event before it at the same time.
fn before(run: &Run, number: u64, time: f64) -> Moment {
    let last = number - 1;
    let is_tied = run.recording.ledger.get(last).is_some_and(|row| row.event.time == time);
    if is_tied {
        Moment::right_after(last, time)
    } else if time > 0.0 {
        Moment::after_all(last, time.next_down())
    } else {
        Moment::default()
    }
}
