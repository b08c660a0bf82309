//! `polyscene schema`: the XML schema of the format, for editors and `xmllint`.

use clap::Args;

use super::{CliError, output};
use crate::scene::{Since, schema};

/// Print the XML schema (XSD) of the scene format
///
/// Editors that know schemas complete and check scenes by it; `xmllint --noout --schema FILE.xsd SCENE` checks them too.
/// A schema cannot say all: `polyscene check` does.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  polyscene schema 1.1 > polyphysics-1.1.xsd")]
pub struct SchemaArgs {
    /// Version of the format
    #[arg(value_parser = ["1.0", "1.1"], default_value = "1.1")]
    version: String,
}

pub(super) fn schema_of(args: &SchemaArgs) -> Result<(), CliError> {
    let version = if args.version == "1.0" { Since::V1_0 } else { Since::V1_1 };
    output::print(schema(version).as_bytes())
}
