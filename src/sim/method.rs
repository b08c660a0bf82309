//! The ways in which a simulation can step.

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
