//! `--method`: how to step.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::sim::Method;

/// Takes the names of [`Method::ALL`], and lists them in the help.
pub fn parser() -> impl TypedValueParser<Value = Method> {
    let values = Method::ALL.map(|method| PossibleValue::new(method.name()).help(method.meaning()));
    PossibleValuesParser::new(values).map(|name| Method::from_name(&name).unwrap_or_default())
}
