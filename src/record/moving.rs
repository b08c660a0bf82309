//! Moving through what is recorded, in both directions: only what is shown changes, by looking it up.

use glam::DVec3;

use super::command::Of;
use super::grid::StepGrid;
use super::moment::Moment;
use super::run::Run;
use super::ticks::Tick;
use crate::sim::{BodyState, ContactState, Event};

impl Run {
    pub(super) fn can_step_back(&self) -> bool {
        self.tick_before().is_some()
    }

    /// The last end of a Δt before what is shown, if what was then is recorded.
    fn tick_before(&self) -> Option<Tick> {
        let from = self.recording.from();
        self.recording.ticks.before(self.cursor).filter(|tick| from.time <= tick.at.time)
    }

    /// Back to the beginning of the open Δt, or else of the last one; whether there was one.
    pub(super) fn step_back(&mut self) -> bool {
        let Some(tick) = self.tick_before() else { return false };
        self.show(tick.at, tick.grid);
        true
    }

    /// Back to the last event before the one shown that is one `of` what is asked for; the Δt around it is open then.
    pub(super) fn event_back(&mut self, of: Of) {
        // After the end of a Δt the last event is itself the one before.
        let ledger = &self.recording.ledger;
        let shown = ledger.get(self.cursor.event).map(|row| row.event.time);
        let is_at_event = shown == Some(self.cursor.time) && self.grid.open.is_some();
        let last = self.cursor.event.saturating_sub(u64::from(is_at_event));
        let first = ledger.first();
        // Rows are not made for what is only passed.
        let is_meant = |number: &u64| {
            let index = (number - first) as usize;
            let bodies = ledger.keys_at(index);
            bodies.is_some_and(|(a, b)| of.holds_between(a, b))
                && ledger.event_at(index).is_some_and(|event| self.is_kept(event))
        };
        match (first..=last).rev().find(is_meant) {
            Some(number) => self.go_to_event(number),
            None => self.message = Some("there is no recorded event before this one".into()),
        }
    }

    /// Whether what was at an event is known: the ledger, which drops many rows at once, has some that are older.
    fn is_kept(&self, event: &Event) -> bool {
        self.recording.from().is_not_after(Moment::right_after(event.seq, event.time))
    }

    /// To a recorded event, with the Δt around it open.
    pub(super) fn go_to_event(&mut self, number: u64) {
        match self.recording.ledger.get(number) {
            Some(row) if self.is_kept(&row.event) => {
                let moment = Moment::right_after(number, row.event.time);
                self.show(moment, self.grid_around_event(moment));
            }
            Some(_) => {
                let text = format!("event {number} is older than what is kept within the memory");
                self.message = Some(text.into());
            }
            None => self.message = Some(format!("event {number} is not recorded").into()),
        }
    }

    /// To a moment, if it is recorded.
    pub(super) fn go_to(&mut self, moment: Moment) {
        let is_within = self.recording.from().is_not_after(moment) && moment.is_not_after(self.recording.end);
        if is_within && self.is_of_its_event(moment) {
            self.show(moment, self.grid_at(moment));
        } else {
            let text = format!("event {} at {} s is not recorded", moment.event, moment.time);
            self.message = Some(text.into());
        }
    }

    /// Whether its event has happened at its time, and the one after it not before.
    fn is_of_its_event(&self, moment: Moment) -> bool {
        let time_of = |event| self.recording.ledger.get(event).map(|row| row.event.time);
        time_of(moment.event).is_none_or(|time| time <= moment.time)
            && time_of(moment.event.saturating_add(1)).is_none_or(|time| moment.time <= time)
    }

    /// To a time, if it is recorded; whether it is.
    pub(super) fn seek(&mut self, time: f64) -> bool {
        if time > self.recording.end.time {
            return false;
        }
        let moment = self.recording.moment_at(time);
        self.show(moment, self.grid_at(moment));
        true
    }

    pub(super) fn show(&mut self, moment: Moment, grid: StepGrid) {
        (self.cursor, self.grid) = (moment, grid);
        self.message = None;
    }

    fn grid_around_event(&self, moment: Moment) -> StepGrid {
        let Some(before) = self.recording.ticks.before_event(moment) else { return self.grid_at(moment) };
        match self.recording.ticks.around(before.at.time).1 {
            Some(after) => after.grid.reopened(before.at.time, after.at.time),
            None => self.recording.end_grid,
        }
    }

    /// Whether all bodies lie still at what is shown.
    pub(super) fn is_at_rest(&self) -> bool {
        self.all_bodies(|state| state.contact == ContactState::Rest || is_still(state))
    }

    /// Whether nothing moves at what is shown, and nothing will: no force of a scene depends on the time.
    pub(super) fn is_over(&self) -> bool {
        self.all_bodies(is_still)
    }

    /// Whether something holds of the states of all bodies at what is shown.
    fn all_bodies(&self, holds: impl Fn(&BodyState) -> bool) -> bool {
        let mut bodies = self.simulation.dynamic_bodies();
        if self.is_settled() {
            return bodies.all(|body| self.simulation.state(body).is_none_or(|state| holds(&state)));
        }
        let then = self.recording.at(self.cursor);
        bodies.all(|body| then.piece(body).is_none_or(|piece| holds(&piece.at(self.cursor.time))))
    }
}

/// Without motion and cause of motion. What is stepped has its rest still before it, which is an event.
fn is_still(state: &BodyState) -> bool {
    let spin = state.turn.map_or(DVec3::ZERO, |turn| turn.spin);
    state.contact != ContactState::Stepped && [state.velocity, state.acceleration, spin] == [DVec3::ZERO; 3]
}
