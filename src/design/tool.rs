//! What the table of tools holds for each: names, what it asks for, and what it does.

use super::plan::{Given, Plan};

/// Where menus list a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ToolGroup {
    /// Ready parts to build from.
    Part,
    /// Many from one, and order among many.
    Arrange,
    /// Other selections from one.
    Select,
    /// What puts a scene right.
    Repair,
}

impl ToolGroup {
    pub const ALL: [Self; 4] = [Self::Part, Self::Arrange, Self::Select, Self::Repair];

    pub fn label(self) -> &'static str {
        match self {
            Self::Part => "Ready parts",
            Self::Arrange => "Arrange",
            Self::Select => "Select more",
            Self::Repair => "Put right",
        }
    }
}

/// One row of [`super::TOOLS`].
pub struct Tool {
    /// Stable name for scripts, tests and logs.
    pub id: &'static str,
    /// Sentence case; ends in `…` when it asks for something.
    pub label: &'static str,
    pub group: ToolGroup,
    /// One sentence.
    pub help: &'static str,
    /// What it asks for; empty for a tool that works at once.
    pub inputs: &'static [Input],
    /// Keeps values that say the same in other words consistent, after the one at this index was changed.
    pub follow: Option<fn(&mut [f64], usize)>,
    /// `Err` says why it cannot be used now.
    pub enabled: fn(&Given<'_>) -> Result<(), &'static str>,
    /// `Err` says why these values make no sense.
    pub plan: fn(&Given<'_>, &Values<'_>) -> Result<Plan, String>,
}

/// One value that a tool asks for.
pub struct Input {
    pub label: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    pub help: &'static str,
    pub kind: Kind,
    pub default: fn(&Given<'_>) -> f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Smallest and largest value.
    Number(f64, f64),
    /// The same, without fractions.
    Whole(f64, f64),
    /// One of these, by its index.
    Choice(&'static [&'static str]),
    /// 0 or 1.
    Flag,
}

impl Tool {
    /// What its dialog begins with.
    pub fn defaults(&self, given: &Given<'_>) -> Vec<f64> {
        self.inputs.iter().map(|input| (input.default)(given)).collect()
    }

    /// What it does with these values, one for each input; refuses those out of range.
    pub fn plan(&self, given: &Given<'_>, values: &[f64]) -> Result<Plan, String> {
        (self.enabled)(given).map_err(str::to_owned)?;
        for (input, value) in self.inputs.iter().zip(values) {
            input.check(*value)?;
        }
        (self.plan)(given, &Values { inputs: self.inputs, values })
    }
}

impl Input {
    /// Why a value is refused.
    pub fn check(&self, value: f64) -> Result<(), String> {
        let name = self.label;
        match self.kind {
            _ if !value.is_finite() => Err(format!("{name} must be a finite number")),
            Kind::Whole(..) if value.fract() != 0.0 => Err(format!("{name} must be a whole number")),
            Kind::Number(low, high) | Kind::Whole(low, high) if !(low..=high).contains(&value) => {
                let bound = if value < low { format!("at least {low}") } else { format!("at most {high}") };
                Err(format!("{name} must be {bound}"))
            }
            _ => Ok(()),
        }
    }
}

/// The values of one use of a tool, by the labels of its inputs.
pub struct Values<'a> {
    inputs: &'a [Input],
    values: &'a [f64],
}

impl Values<'_> {
    /// 0 where there is no such input.
    pub fn number(&self, label: &str) -> f64 {
        let at = self.inputs.iter().position(|input| input.label == label);
        debug_assert!(at.is_some(), "no input {label}");
        at.and_then(|at| self.values.get(at)).copied().unwrap_or(0.0)
    }

    /// A count, or the index of what was chosen.
    pub fn count(&self, label: &str) -> usize {
        self.number(label) as usize
    }

    pub fn is_on(&self, label: &str) -> bool {
        self.number(label) != 0.0
    }

    pub fn vector(&self, labels: [&str; 3]) -> glam::DVec3 {
        glam::DVec3::from_array(labels.map(|label| self.number(label)))
    }
}
