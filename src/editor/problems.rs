//! The list of problems: those of the document, those of the scene as one designs it, then those of the simulation's
//! start. Each says what to select and, where it is clear, how to put it right.

use std::collections::BTreeSet;

use super::{Session, SessionCommand};
use crate::design::{Repair, Trouble};
use crate::scene::{Diagnostic, NodeKey, Severity};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProblemSource {
    Document,
    /// Found in the scene, as it is edited.
    Scene,
    /// Found when the scene was compiled: shapes that cannot be simulated yet.
    Simulation,
    /// A numerical fault while running, or an edit that the running simulation refused.
    Run,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub severity: Severity,
    pub source: ProblemSource,
    pub message: String,
    /// What to do about it; may be empty.
    pub hint: String,
    /// Line and column in the file.
    pub position: Option<(u32, u32)>,
    pub path: String,
    /// The object that it is about.
    pub key: Option<NodeKey>,
    /// Others that belong to it, such as what that one overlaps.
    pub others: Vec<NodeKey>,
    /// What puts it right.
    pub fix: Option<Fix>,
}

/// What a button beside a problem does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fix {
    Repair(Repair),
    Reset,
}

impl Fix {
    pub fn label(self) -> &'static str {
        match self {
            Self::Repair(repair) => repair.label(),
            Self::Reset => "Reset",
        }
    }

    pub fn help(self) -> &'static str {
        match self {
            Self::Repair(repair) => repair.help(),
            Self::Reset => super::info(SessionCommand::Reset).map_or("", |row| row.help),
        }
    }
}

impl Session {
    /// All problems, errors of the document first in file order.
    pub fn problems(&self) -> Vec<Problem> {
        let repeated = self.repeated_ids();
        let document = self.document().diagnostics().iter();
        let mut problems: Vec<Problem> = document
            .map(|diagnostic| {
                let mut problem = problem(ProblemSource::Document, diagnostic);
                let names_a_repeated_id = problem.key.is_some_and(|key| repeated.contains(&key))
                    && problem.severity == Severity::Warning
                    && problem.message.contains("UserID");
                problem.fix = names_a_repeated_id.then_some(Fix::Repair(Repair::MakeIdsUnique));
                problem
            })
            .collect();
        let of = (self.opened_count(), self.document_state());
        let troubles = self.doc.troubles.of(of, self.scene());
        problems.extend(troubles.iter().map(|trouble| self.placed(of_trouble(trouble))));
        for diagnostic in self.frame().problems.iter().filter(|diagnostic| !is_geometry(diagnostic)) {
            // the compiler repeats errors that the document has reported already, with a place
            let known = problems.iter().any(|p| p.key == diagnostic.key && p.message == diagnostic.message);
            if !known {
                problems.push(self.placed(problem(ProblemSource::Simulation, diagnostic)));
            }
        }
        problems.extend(self.fault_problem());
        problems
    }

    fn placed(&self, mut problem: Problem) -> Problem {
        if let (Some(key), None) = (problem.key, problem.position) {
            let (position, path) = self.document().place_of(key);
            problem.position = position;
            if problem.path.is_empty() {
                problem.path = path;
            }
        }
        problem
    }

    fn fault_problem(&self) -> Option<Problem> {
        let (fault, refused) = (&self.frame().fault, &self.frame().refused);
        let (severity, message, hint) = match (fault, refused) {
            (Some(fault), _) => {
                let hint = "reset, or step back and look at the bodies near the fault";
                (Severity::Error, fault.to_string(), hint)
            }
            (None, Some(refused)) => {
                (Severity::Warning, format!("the running simulation refused an edit: {refused}"), "")
            }
            (None, None) => return None,
        };
        Some(Problem {
            severity,
            source: ProblemSource::Run,
            message,
            hint: hint.to_owned(),
            position: None,
            path: String::new(),
            key: None,
            others: Vec::new(),
            fix: Some(Fix::Reset),
        })
    }

    /// What has the UserID of something before it in the file.
    fn repeated_ids(&self) -> BTreeSet<NodeKey> {
        let Some(scene) = self.scene() else { return BTreeSet::new() };
        let bodies = scene.bodies.iter().filter(|body| body.repeats_id()).map(|body| body.key);
        let forces = scene.forces.iter().filter(|force| force.repeats_id()).map(|force| force.key);
        bodies.chain(forces).collect()
    }
}

fn problem(source: ProblemSource, diagnostic: &Diagnostic) -> Problem {
    Problem {
        severity: diagnostic.severity,
        source,
        message: diagnostic.message.clone(),
        hint: diagnostic.hint.clone(),
        position: diagnostic.position,
        path: diagnostic.path.clone(),
        key: diagnostic.key,
        others: Vec::new(),
        fix: None,
    }
}

fn of_trouble(trouble: &Trouble) -> Problem {
    Problem {
        severity: Severity::Warning,
        source: ProblemSource::Scene,
        message: trouble.message.clone(),
        hint: trouble.hint.clone(),
        position: None,
        path: String::new(),
        key: trouble.keys.first().copied(),
        others: trouble.keys.get(1..).unwrap_or_default().to_vec(),
        fix: trouble.repair.map(Fix::Repair),
    }
}

/// Warnings of the compiler about what [`crate::design::troubles`] finds as well, without waiting for it.
fn is_geometry(diagnostic: &Diagnostic) -> bool {
    let message = &diagnostic.message;
    let known =
        [" overlap by ", " more overlaps at the start", " starts outside the map", " start outside the map"];
    !diagnostic.is_error() && known.iter().any(|known| message.contains(known))
}
