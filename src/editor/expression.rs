//! Numbers and formulas as people type them, for one value or many.

use crate::design::{Formula, Instance};

/// Reads a number, or a formula that is one, with comma or point. `None` for anything else and for what is not
/// finite.
pub fn parse_number(text: &str) -> Option<f64> {
    constant(text, false)
}

/// As [`parse_number`], in radians; numbers may be followed by `°`, `deg` or `rad`.
pub fn parse_angle(text: &str) -> Option<f64> {
    constant(text, true)
}

fn constant(text: &str, angles: bool) -> Option<f64> {
    let formula = Formula::parse(text, angles).filter(Formula::is_constant)?;
    formula.value(Instance { old: 0.0, index: 0, count: 1 })
}

/// What was typed or dragged, for one value or for many.
#[derive(Clone, Debug, PartialEq)]
pub enum Typed {
    Value(f64),
    /// Sees the old value and the place of each.
    Formula(Formula),
}

impl Typed {
    /// What it makes of one value.
    pub fn value(&self, of: Instance) -> Option<f64> {
        match self {
            Self::Value(value) => Some(*value),
            Self::Formula(formula) => formula.value(of),
        }
    }
}
