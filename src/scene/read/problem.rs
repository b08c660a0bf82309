//! Problems, counted without end and kept up to a limit: a hostile file must not fill the memory with them.

use crate::scene::diagnostic::Severity;
use crate::scene::rules::MAX_DIAGNOSTICS;

/// A problem whose place and path are still relative to the document and to the element read.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct Problem {
    pub severity: Severity,
    /// Bytes into the source.
    pub at: Option<u32>,
    /// Below the element that was read, such as `/Sphere/Radius`.
    pub path: String,
    pub message: String,
    pub hint: String,
}

/// The first [`MAX_DIAGNOSTICS`] things of each severity, and how many there were.
#[derive(Clone, Debug)]
pub(in crate::scene) struct Limited<T> {
    pub kept: Vec<T>,
    counts: [usize; 2],
}

impl<T> Default for Limited<T> {
    fn default() -> Self {
        Self::NONE
    }
}

impl<T> Limited<T> {
    pub const NONE: Self = Self { kept: Vec::new(), counts: [0; 2] };

    /// Counts one more, and keeps it if there is room.
    pub fn add(&mut self, severity: Severity, make: impl FnOnce() -> T) {
        self.counts[severity as usize] += 1;
        if self.counts[severity as usize] <= MAX_DIAGNOSTICS {
            self.kept.push(make());
        }
    }

    /// How many of that severity were counted and not kept.
    pub fn beyond(&self, severity: Severity) -> usize {
        self.counts[severity as usize].saturating_sub(MAX_DIAGNOSTICS)
    }

    /// Counts some that another list did not keep.
    pub fn add_beyond<U>(&mut self, other: &Limited<U>) {
        for severity in [Severity::Warning, Severity::Error] {
            self.counts[severity as usize] += other.beyond(severity);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }
}
