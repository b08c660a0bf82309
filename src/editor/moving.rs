//! Moving through the run by hand: to times and bookmarks, over a range again and again, to what happens to the selection.

use std::collections::HashSet;

use super::command::TravelCommand;
use super::travel::{Bookmark, Way};
use super::{Notice, Outcome, Session, Travel};
use crate::record::{Goal, Of, PathSpan, RunCommand, RunState};
use crate::scene::NodeKey;

impl Session {
    pub(super) fn travel_by(&mut self, command: TravelCommand) -> Outcome {
        match command {
            TravelCommand::PlayBack if self.is_busy() => self.run.pause(),
            TravelCommand::PlayBack => self.play_back(),
            TravelCommand::NextEventOfSelection => self.next_event(self.of_selection()),
            TravelCommand::EventBackOfSelection => {
                self.go_back(RunCommand::EventBack { of: self.of_selection() });
            }
            TravelCommand::RunToRest => self.run_until(Goal::Rest),
            TravelCommand::GoToBegin => return self.seek(self.run.frame.recorded.from),
            TravelCommand::GoToEnd => return self.seek(self.run.frame.recorded.to),
            TravelCommand::AddBookmark => self.add_bookmark(),
            TravelCommand::NextBookmark | TravelCommand::LastBookmark => {
                let forward = command == TravelCommand::NextBookmark;
                self.bookmark_beside(forward).into_iter().for_each(|index| self.go_to_bookmark(index));
            }
            TravelCommand::BringBack => {
                self.settle();
                self.run.bring_back(self.doc.history.document());
                if self.needs_reset() {
                    let text =
                        "The edit is out of the run and still in the scene: undo takes it out of that too";
                    self.talk.notices.push(Notice::info(text));
                }
            }
        }
        Outcome::Done
    }

    /// How much of the bodies' ways the frames have from now on.
    pub fn show_paths(&mut self, span: Option<PathSpan>) {
        self.run.show_paths(span);
    }

    /// Whether the frames from now on have the tile crossings of the selected bodies.
    pub fn show_crossings(&mut self, wanted: bool) {
        let keys = if wanted { self.selected_bodies() } else { Vec::new() };
        self.run.show_crossings(&keys);
    }

    /// Whether frames at an event have from now on the predictions that it cancelled.
    pub fn show_cancelled(&mut self, wanted: bool) {
        self.run.show_cancelled(wanted);
    }

    /// Whether the frames from now on have the occupied tiles.
    pub fn show_tiles(&mut self, wanted: bool) {
        self.run.show_tiles(wanted);
    }

    pub fn travel(&self) -> &Travel {
        &self.travel
    }

    /// To a time: into what is recorded, or on to it.
    pub(super) fn seek(&mut self, time: f64) -> Outcome {
        if !time.is_finite() || time < 0.0 {
            return Outcome::Refused("a time of the run is 0 s or later".into());
        }
        let dt = self.run.playback.dt();
        let beyond = time > self.run.frame.recorded.to;
        let command = RunCommand::Seek { dt, time };
        if beyond {
            self.go_on(command);
        } else {
            self.go_back(command);
        }
        Outcome::Done
    }

    pub(super) fn run_until(&mut self, goal: Goal) {
        self.go_on(RunCommand::RunUntil { dt: self.run.playback.dt(), goal });
    }

    pub(super) fn next_event(&mut self, of: Of) {
        self.go_on(RunCommand::NextEvent { dt: self.run.playback.dt(), of });
    }

    /// The events of the selected body, or between two selected ones.
    pub(super) fn of_selection(&self) -> Of {
        let Some(scene) = self.scene() else { return Of::All };
        let is_body = |key: &NodeKey| scene.bodies.iter().any(|body| body.key == *key);
        // Menus ask in every repaint: of a large selection it is enough to find that there are more than two.
        let mut last = self.selection.keys().iter().rev().copied().filter(is_body);
        match [last.next(), last.next(), last.next()] {
            [None, ..] => Of::All,
            [Some(b), Some(a), None] => Of::Pair(a, b),
            [Some(last), ..] => Of::Body(last),
        }
    }

    fn selected_bodies(&self) -> Vec<NodeKey> {
        let Some(scene) = self.scene() else { return Vec::new() };
        let bodies: HashSet<NodeKey> = scene.bodies.iter().map(|body| body.key).collect();
        self.selection.keys().iter().copied().filter(|key| bodies.contains(key)).collect()
    }

    pub(super) fn can_find_its_events(&self) -> Result<(), &'static str> {
        self.can_run()?;
        if self.of_selection() == Of::All { Err("no body is selected") } else { Ok(()) }
    }

    pub(super) fn can_go_to_its_events(&self) -> Result<(), &'static str> {
        self.can_step_back()?;
        self.can_find_its_events()
    }

    pub(super) fn can_go_to_end(&self) -> Result<(), &'static str> {
        if self.run.frame.time < self.run.frame.recorded.to {
            Ok(())
        } else {
            Err("this is the end of what is recorded")
        }
    }

    /// Plays backwards, or stops.
    pub(super) fn play_back(&mut self) {
        self.travel.backwards = true;
        self.play_in_direction();
    }

    pub(super) fn play_forward(&mut self) {
        self.travel.backwards = false;
        self.play_in_direction();
    }

    fn play_in_direction(&mut self) {
        self.settle();
        let way = self.way();
        let frame = &self.run.frame;
        if let Some((from, to)) = way.range
            && !(from..to).contains(&frame.time)
            && frame.state != RunState::Playing
        {
            self.run.go_back(RunCommand::Seek { dt: self.run.playback.dt(), time: from });
        }
        self.run.play(way);
    }

    pub(super) fn way(&self) -> Way {
        let time_speed = self.scene().map_or(1.0, |scene| scene.time_speed);
        let direction = if self.travel.backwards { -1.0 } else { 1.0 };
        Way { speed: time_speed * direction, range: self.travel.range }
    }

    /// Plays over a range again and again, or once through everything.
    pub(super) fn set_range(&mut self, range: Option<(f64, f64)>) -> Outcome {
        if range.is_some_and(|(from, to)| !(from.is_finite() && to.is_finite() && from >= 0.0 && from < to)) {
            return Outcome::Refused("a range begins before it ends".into());
        }
        self.travel.range = range;
        self.run.play_on(self.way());
        Outcome::Done
    }

    /// Marks the moment that is shown.
    pub(super) fn add_bookmark(&mut self) {
        let mark = Bookmark::at(&self.run.frame, self.travel.bookmarks.len() + 1);
        let is_there = |other: &Bookmark| (other.time, other.event) == (mark.time, mark.event);
        if self.travel.bookmarks.iter().any(is_there) {
            self.talk.notices.push(Notice::info("There is a bookmark here already"));
            return;
        }
        let place = self.travel.bookmarks.partition_point(|other| other.time <= mark.time);
        self.travel.bookmarks.insert(place, mark);
    }

    pub(super) fn rename_bookmark(&mut self, index: usize, name: &str) {
        let name = name.trim();
        if let Some(mark) = self.travel.bookmarks.get_mut(index).filter(|_| !name.is_empty()) {
            name.clone_into(&mut mark.name);
        }
    }

    pub(super) fn remove_bookmark(&mut self, index: usize) {
        if index < self.travel.bookmarks.len() {
            self.travel.bookmarks.remove(index);
        }
    }

    pub(super) fn go_to_bookmark(&mut self, index: usize) {
        let Some(mark) = self.travel.bookmarks.get(index).cloned() else { return };
        // After an edit another event may have its number.
        let is_there =
            |event: &u64| self.run.frame.event(*event).is_some_and(|row| row.event.time == mark.time);
        match mark.event.filter(is_there) {
            Some(event) => self.go_to_event(event),
            None => drop(self.seek(mark.time)),
        }
    }

    /// The next bookmark after the time shown, or the last before it.
    pub(super) fn bookmark_beside(&self, forward: bool) -> Option<usize> {
        let (marks, now) = (&self.travel.bookmarks, self.run.frame.time);
        if forward {
            marks.iter().position(|mark| mark.time > now)
        } else {
            marks.iter().rposition(|mark| mark.time < now)
        }
    }

    pub(super) fn can_go_to_next_bookmark(&self) -> Result<(), &'static str> {
        self.bookmark_beside(true).map(|_| ()).ok_or("there is no bookmark after this time")
    }

    pub(super) fn can_go_to_last_bookmark(&self) -> Result<(), &'static str> {
        self.bookmark_beside(false).map(|_| ()).ok_or("there is no bookmark before this time")
    }

    pub(super) fn can_bring_back(&self) -> Result<(), &'static str> {
        if self.run.frame.recorded.can_bring_back {
            Ok(())
        } else {
            Err("no edit in the past has replaced what came after it, or the memory had no room for that")
        }
    }
}
