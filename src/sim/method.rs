//! How a simulation steps, and the one place where the methods part.

use super::model::Model;
use super::state::State;
use super::{Fault, engine, stepping};

/// A way to go through time. All share shapes, gap functions, the law of impact, the ledger and the books.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Event by event: Δt only samples.
    #[default]
    Exact,
    /// The stepping of the thesis that the scene format comes from: a tentative step of the whole Δt, tiles
    /// and overlaps at its end only, bisection, local sets. May tunnel, and depends on Δt.
    Thesis,
    /// Velocity Verlet with the fixed step Δt, and bisection for what overlaps at its end. May tunnel, and
    /// depends on Δt.
    Fixed,
}

impl Method {
    pub const ALL: [Self; 3] = [Self::Exact, Self::Thesis, Self::Fixed];

    /// The name used in files and on the command line: `exact`, `thesis`, `fixed`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Thesis => "thesis",
            Self::Fixed => "fixed",
        }
    }

    /// One line for the help.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Exact => "event by event: every impact is a root in time, Δt only samples",
            Self::Thesis => {
                "the original thesis's stepping: trial step by Δt, overlaps looked for at its end only, bisection"
            }
            Self::Fixed => "velocity Verlet with fixed Δt, overlaps looked for at its end only, bisection",
        }
    }

    /// The method of a [`Self::name`].
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// Whether the result depends on how time is divided into Δt.
    pub fn depends_on_dt(self) -> bool {
        self != Self::Exact
    }
}

/// Tells that time is to go on from `state.now` to `state.until`.
pub(super) fn plan(model: &Model, state: &mut State) {
    match model.method {
        Method::Exact => {}
        Method::Thesis | Method::Fixed => stepping::plan(state),
    }
}

/// Goes on by one prediction or one collision, not beyond `state.until`; false when nothing is left.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    match model.method {
        Method::Exact => engine::advance(model, state),
        Method::Thesis | Method::Fixed => stepping::advance(model, state),
    }
}

/// Lets all bodies go on from where their segments begin, at `state.now`: at the start and after an edit.
pub(super) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    match model.method {
        Method::Exact => engine::begin_all(model, state),
        Method::Thesis | Method::Fixed => stepping::begin_all(model, state),
    }
}
