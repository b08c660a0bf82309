//! Which predicted impacts an event cancelled. The queue of the core forgets them one by one as their turn comes, so a copy of the
//! simulation goes from a keyframe to the event again, and what was predicted right before it is compared with what is right after.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::ledger::EventRow;
use super::limits::PREDICTIONS;
use super::moment::Moment;
use super::run::Run;
use super::ways::{Cancelled, CancelledImpact};
use crate::sim::{BodyRef, Method, PredictedImpact, Progress, Simulation};

/// An impact that is predicted anew comes at the same time but for rounding of the time itself,
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// and of the places and the ways until then, of the time left: integrated ones are known to 1e-8 as a rule.
const OF_WAY: f64 = 1e-7;

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

    /// Whether what the event shown cancelled is still to be found.
    pub(super) fn is_due(&self, run: &Run) -> bool {
        self.is_wanted && run.event_shown().is_some() && self.found(run).is_none()
    }

    pub(super) fn is_searching(&self) -> bool {
        self.search.is_some()
    }

    /// Something else is to be done.
    pub(super) fn stop(&mut self) {
        self.search = None;
    }

    /// Another run, or another past: what is known of events is so no more.
    pub(super) fn forget(&mut self) {
        (self.search, self.found) = (None, None);
    }

    /// So many portions of the search for the event shown; whether there is more to do.
    pub(super) fn advance(&mut self, run: &Run, portions: u32) -> bool {
        let Some(row) = run.event_shown().filter(|_| self.is_due(run)) else {
            self.stop();
            return false;
        };
        let before = self.search.take().filter(|search| Arc::ptr_eq(&search.row, row));
        let Some(mut search) = before.or_else(|| Search::new(run, row).map(Box::new)) else {
            self.note(row, Err("the methods that step by Δt predict nothing".to_owned()));
            return false;
        };
        match (0..portions).find_map(|_| search.portion(run)) {
            Some(outcome) => self.note(row, outcome),
            None => self.search = Some(search),
        }
        self.is_searching()
    }

    fn note(&mut self, row: &EventRow, outcome: Result<Vec<CancelledImpact>, String>) {
        let (impacts, problem) = match outcome {
            Ok(impacts) => (impacts, None),
            Err(problem) => (Vec::new(), Some(problem)),
        };
        self.found = Some(Arc::new(Cancelled { event: row.event.seq, impacts, problem }));
    }
}

impl Search {
    /// From the last keyframe before the event; `None` where nothing is predicted.
    fn new(run: &Run, row: &Arc<EventRow>) -> Option<Self> {
        if run.simulation.method() != Method::Exact {
            return None;
        }
        let ((first, _), time) = (row.rows(), row.event.time);
        let goals = [before(run, first, time), Moment::right_after(first, time)];
        // An edit that was made right then is a later event, or this one.
        let is_earlier = |at: Moment| at != goals[0] && at.is_not_after(goals[0]);
        let edits = run.recording.edits().iter().take_while(|edit| is_earlier(edit.at)).count();
        let key = run.recording.keyframes.before_edits(goals[0], edits)?;
        let simulation = key.snapshot.simulation().clone();
        Some(Self { row: row.clone(), simulation, at: key.at, applied: key.edits, goals, before: None })
    }

    /// One portion of the way, and at its end what was found.
    fn portion(&mut self, run: &Run) -> Option<Result<Vec<CancelledImpact>, String>> {
        // Edits that were made at a goal came after it.
        if self.before.is_none() && self.at == self.goals[0] {
            self.before = Some(self.simulation.predicted_impacts());
        }
        let goal = if self.before.is_some() { self.goals[1] } else { self.goals[0] };
        if self.at == goal {
            return Some(Ok(self.compare(run)));
        }
        let from = (self.at, self.applied);
        self.apply_due_edits(run);
        let edit = run.recording.edits().get(self.applied).map_or(f64::INFINITY, |edit| edit.at.time);
        self.simulation.begin(goal.time.min(edit));
        match self.simulation.work(PREDICTIONS) {
            Ok(Progress::Event(event)) => self.at = Moment::right_after(event.seq, event.time),
            Ok(Progress::Working) => (self.at.time, self.at.is_over) = (self.simulation.time(), false),
            Ok(Progress::Done) => (self.at.time, self.at.is_over) = (self.simulation.time(), true),
            Err(fault) => return Some(Err(fault.to_string())),
        }
        // It was recorded the first time.
        self.simulation.take_motion(|_| {});
        let is_stuck = self.at.is_over && (self.at, self.applied) == from;
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
        let (first, last) = self.row.rows();
        let rows = (first..=last).filter_map(|number| run.recording.ledger.get(number));
        let happened: HashSet<(BodyRef, BodyRef)> =
            rows.filter_map(|row| Some((row.event.a, row.event.b?))).collect();
        let after = self.simulation.predicted_impacts();
        let after: HashMap<(BodyRef, BodyRef), f64> =
            after.into_iter().map(|impact| ((impact.a, impact.b), impact.time)).collect();
        let before = self.before.iter().flatten();
        let gone = before.filter(|impact| !happened.contains(&(impact.a, impact.b)));
        gone.filter_map(|impact| {
            let now = after.get(&(impact.a, impact.b)).copied();
            let slack = ROUNDING * impact.time + OF_WAY * (impact.time - self.row.event.time).max(0.0);
            let is_kept = now.is_some_and(|now| (now - impact.time).abs() <= slack);
            (!is_kept).then(|| CancelledImpact {
                keys: [impact.a, impact.b].map(|body| self.simulation.key(body)),
                labels: [impact.a, impact.b].map(|body| Arc::from(self.simulation.label(body))),
                time: impact.time,
                now,
            })
        })
        .collect()
    }
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
