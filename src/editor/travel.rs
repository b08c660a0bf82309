//! What belongs to moving through one run: bookmarks, the range that playing repeats, its direction.

use crate::record::Frame;

/// A moment of the run with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Bookmark {
    pub name: String,
    /// s.
    pub time: f64,
    /// The event that it stands right at.
    pub event: Option<u64>,
}

/// What belongs to moving through one run.
#[derive(Clone, Debug, Default)]
pub struct Travel {
    /// In the order of their times.
    pub(super) bookmarks: Vec<Bookmark>,
    /// What playing goes over again and again, s.
    pub(super) range: Option<(f64, f64)>,
    /// Whether playing goes backwards.
    pub(super) backwards: bool,
}

impl Travel {
    pub fn bookmarks(&self) -> &[Bookmark] {
        &self.bookmarks
    }

    /// In place of those there are.
    pub(super) fn set_bookmarks(&mut self, mut bookmarks: Vec<Bookmark>) {
        bookmarks.sort_by(|a, b| a.time.total_cmp(&b.time));
        self.bookmarks = bookmarks;
    }

    /// What playing goes over again and again, s.
    pub fn range(&self) -> Option<(f64, f64)> {
        self.range
    }
}

/// How playing goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    /// Multiplies the speed set: the time speed of the scene, below zero for backwards.
    pub speed: f64,
    pub range: Option<(f64, f64)>,
}

impl Bookmark {
    /// Of the moment that a frame shows.
    pub(super) fn at(frame: &Frame, number: usize) -> Self {
        let right_at = frame
            .event(frame.event_count)
            .filter(|row| row.event.time == frame.time && frame.open_step.is_some());
        let event = right_at.map(|row| row.event.seq);
        let name = match event {
            Some(event) => format!("{number}: event {event}"),
            None => format!("{number}: {:.6} s", frame.time),
        };
        Self { name, time: frame.time, event }
    }
}
