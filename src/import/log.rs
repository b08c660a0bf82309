//! What became of each thing in a file: notes that are counted where they repeat, and errors.

use std::fmt;

use crate::export::Verdict;
use crate::scene::{Diagnostic, Severity, XmlElement, escaped};

/// One line of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImportLine {
    pub verdict: Verdict,
    pub what: String,
    /// As what it is kept, or why it is not; may be empty.
    pub how: String,
    pub count: usize,
    /// Of the first.
    pub position: Option<(u32, u32)>,
}

/// Losses last.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ImportReport {
    pub lines: Vec<ImportLine>,
}

impl ImportReport {
    /// What was approximated or dropped.
    pub fn losses(&self) -> impl Iterator<Item = &ImportLine> {
        self.lines.iter().filter(|line| line.verdict.is_loss())
    }
}

impl fmt::Display for ImportLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.position {
            write!(f, "{line}:{column}: ")?;
        }
        write!(f, "{}: ", self.verdict)?;
        if self.count > 1 {
            write!(f, "{} × ", self.count)?;
        }
        f.write_str(&escaped(&self.what))?;
        if !self.how.is_empty() {
            write!(f, ": {}", escaped(&self.how))?;
        }
        Ok(())
    }
}

/// Errors beyond this many say nothing new.
const MOST_PROBLEMS: usize = 100;

/// Kinds of things that a report lists; the rest is counted. A list is for people.
const MOST_LINES: usize = 200;

#[derive(Debug)]
pub(super) struct Log {
    lines: Vec<ImportLine>,
    problems: Vec<Diagnostic>,
    leave_out: bool,
    /// Notes for which there was no room.
    more: usize,
}

impl Log {
    pub fn new(leave_out: bool) -> Self {
        Self { lines: Vec::new(), problems: Vec::new(), leave_out, more: 0 }
    }

    pub fn note(
        &mut self,
        verdict: Verdict,
        what: &str,
        how: impl Into<String>,
        position: Option<(u32, u32)>,
    ) {
        let how = how.into();
        let same = |line: &&mut ImportLine| line.verdict == verdict && line.what == what && line.how == how;
        let is_full = self.lines.len() >= MOST_LINES;
        match self.lines.iter_mut().find(same) {
            Some(line) => line.count += 1,
            None if is_full => self.more += 1,
            None => self.lines.push(ImportLine { verdict, what: what.to_owned(), how, count: 1, position }),
        }
    }

    pub fn dropped(&mut self, el: XmlElement<'_>, what: &str, how: &str) {
        self.note(Verdict::Dropped, what, how, el.position());
    }

    pub fn not_needed(&mut self, el: XmlElement<'_>) {
        self.note(Verdict::NotNeeded, &format!("<{}>", el.name()), "", el.position());
    }

    /// What is wrong in the file itself.
    pub fn error(&mut self, el: XmlElement<'_>, message: String, hint: &str) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(error(el.position(), message, hint));
        }
    }

    /// What this program cannot be told: an error, or a thing that is left out.
    pub fn impossible(&mut self, el: XmlElement<'_>, what: &str, why: &str) {
        if self.leave_out {
            self.dropped(el, what, why);
        } else {
            let hint = format!("{why}; remove it, or import with --leave-out");
            self.error(el, format!("{what} cannot be imported"), &hint);
        }
    }

    pub fn into_parts(self) -> (ImportReport, Vec<Diagnostic>) {
        let Self { mut lines, mut problems, more, .. } = self;
        if more > 0 {
            let (what, how) = ("things of other kinds".to_owned(), String::new());
            lines.push(ImportLine { verdict: Verdict::Dropped, what, how, count: more, position: None });
        }
        lines.sort_by_key(|line| line.verdict);
        problems.sort_by_key(|problem| problem.position);
        (ImportReport { lines }, problems)
    }
}

pub(super) fn error(position: Option<(u32, u32)>, message: String, hint: &str) -> Diagnostic {
    let (severity, path) = (Severity::Error, String::new());
    Diagnostic { severity, position, path, message, hint: hint.to_owned(), key: None }
}
