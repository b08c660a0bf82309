//! What became of everything a scene says: kept, approximated, dropped, or not needed elsewhere.

use std::fmt;

use super::aspect::{ASPECTS, Aspect};
use super::format::Source;
use crate::scene::escaped;

/// What became of one aspect of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    Kept,
    /// Serves this program alone, such as the tiles of its search grid: no loss.
    NotNeeded,
    Approximated,
    Dropped,
}

/// One line of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportLine {
    pub verdict: Verdict,
    pub aspect: Aspect,
    /// How many of what, such as `2 point gravities (sun, 7)`.
    pub what: String,
    /// As what it is kept, or why it is not; may be empty.
    pub how: String,
}

/// One line for each aspect that the scene has, losses last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    pub lines: Vec<ReportLine>,
}

/// A verdict and its reason.
pub(super) type Fate = (Verdict, String);

pub(super) fn kept(how: impl Into<String>) -> Fate {
    (Verdict::Kept, how.into())
}

pub(super) fn not_needed(how: impl Into<String>) -> Fate {
    (Verdict::NotNeeded, how.into())
}

pub(super) fn approximated(how: impl Into<String>) -> Fate {
    (Verdict::Approximated, how.into())
}

pub(super) fn dropped(how: impl Into<String>) -> Fate {
    (Verdict::Dropped, how.into())
}

/// Of formats that write what forces do, or nothing of them: the lines of the forces say which.
pub(super) const NO_FORCE_IDS: &str =
    "tells this program's forces apart; the format has no names for its own";

/// Of what is in the file without a meaning for the scene.
pub(super) fn no_meaning() -> Fate {
    dropped("no part of the scene's meaning; only PolyPhysicsXml has a place for it")
}

impl Report {
    /// Asks for the fate of each aspect that the scene has.
    pub(super) fn of(source: &Source<'_>, fate: impl Fn(Aspect) -> Fate) -> Self {
        let line = |row: &super::aspect::AspectInfo| {
            let found = (row.found)(source);
            let what = row.counted(&found)?;
            let (verdict, how) = fate(row.aspect);
            Some(ReportLine { verdict, aspect: row.aspect, what, how })
        };
        let mut lines: Vec<_> = ASPECTS.iter().filter_map(line).collect();
        lines.sort_by_key(|line| line.verdict);
        Self { lines }
    }

    /// What was approximated or dropped.
    pub fn losses(&self) -> impl Iterator<Item = &ReportLine> {
        self.lines.iter().filter(|line| line.verdict.is_loss())
    }
}

impl Verdict {
    pub fn is_loss(self) -> bool {
        matches!(self, Self::Approximated | Self::Dropped)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Kept => "kept",
            Self::NotNeeded => "not needed",
            Self::Approximated => "approximated",
            Self::Dropped => "dropped",
        })
    }
}

impl fmt::Display for ReportLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.verdict, escaped(&self.what))?;
        if !self.how.is_empty() {
            write!(f, ": {}", escaped(&self.how))?;
        }
        Ok(())
    }
}
