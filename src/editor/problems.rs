//! The list of problems: those of the document, then those of the simulation's start.

use super::{Session, SessionCommand};
use crate::record::RunState;
use crate::scene::{Diagnostic, NodeKey, Severity};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProblemSource {
    Document,
    /// Found when the scene was compiled: overlaps, shapes that cannot be simulated yet.
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
    /// What to select when it is clicked.
    pub key: Option<NodeKey>,
    /// The command that puts it right.
    pub fix: Option<SessionCommand>,
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
                problem.fix = names_a_repeated_id.then_some(SessionCommand::MakeIdsUnique);
                problem
            })
            .collect();
        for diagnostic in self.frame().problems.iter() {
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
        let message = self.frame().fault.clone()?;
        let stopped = self.frame().state == RunState::Faulted;
        Some(Problem {
            severity: if stopped { Severity::Error } else { Severity::Warning },
            source: ProblemSource::Run,
            message,
            hint: if stopped { "reset, or step back and look at the bodies near the fault" } else { "" }
                .to_owned(),
            position: None,
            path: String::new(),
            key: None,
            fix: Some(SessionCommand::Reset),
        })
    }

    fn repeated_ids(&self) -> std::collections::BTreeSet<NodeKey> {
        let Some(scene) = self.scene() else { return Default::default() };
        let mut ids = std::collections::BTreeMap::<(bool, i64), Vec<NodeKey>>::new();
        for body in &scene.bodies {
            ids.entry((true, body.id)).or_default().push(body.key);
        }
        for force in &scene.forces {
            ids.entry((false, force.id)).or_default().push(force.key);
        }
        ids.into_values().filter(|keys| keys.len() > 1).flatten().collect()
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
        fix: None,
    }
}
