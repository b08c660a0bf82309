//! The XML declaration: `<?xml version="1.0" encoding="utf-8" standalone="no"?>`, its three parts in this
//! order. The reader of XML hands it over unchecked.

use super::shown;
use super::tree::tag;

/// What is wrong with a declaration, and where in it, in bytes.
#[derive(Debug)]
pub(super) struct DeclarationFault {
    pub at: usize,
    pub message: String,
    pub hint: &'static str,
}

const AS_USUAL: &str = "write <?xml version=\"1.0\" encoding=\"utf-8\"?>, or leave the declaration out";

/// The parts that a declaration may have, in order.
const PARTS: [&str; 3] = ["version", "encoding", "standalone"];

/// Checks a whole declaration, from `<?xml` to `?>`.
pub(super) fn check(declaration: &str) -> Result<(), DeclarationFault> {
    let fault = |at, message: String| DeclarationFault { at, message, hint: AS_USUAL };
    if tag::name(declaration) != "?xml" {
        return Err(fault(0, "the XML declaration does not begin with <?xml".into()));
    }
    let mut parts_left = &PARTS[..];
    for attr in tag::attributes(declaration) {
        let attr =
            attr.map_err(|bad| fault(bad.at, format!("in the XML declaration {}", bad.fault.message())))?;
        let at = attr.whole.start + 1;
        if !PARTS.contains(&attr.name) {
            return Err(fault(at, format!("the XML declaration has no part {}", shown(attr.name))));
        }
        let Some(place) = parts_left.iter().position(|part| *part == attr.name) else {
            let message = format!("{} stands twice or too late in the XML declaration", attr.name);
            return Err(fault(at, message));
        };
        if attr.name != "version" && parts_left.len() == PARTS.len() {
            return Err(fault(at, "the XML declaration does not begin with its version".into()));
        }
        parts_left = &parts_left[place + 1..];
        if !is_value_of(attr.name, attr.raw) {
            let message = format!("{}=\"{}\" is not possible in XML", attr.name, shown(attr.raw));
            return Err(fault(attr.value.start, message));
        }
    }
    if parts_left.len() == PARTS.len() {
        return Err(fault(0, "the XML declaration has no version".into()));
    }
    Ok(())
}

fn is_value_of(part: &str, value: &str) -> bool {
    match part {
        "version" => value
            .strip_prefix("1.")
            .is_some_and(|minor| !minor.is_empty() && minor.bytes().all(|b| b.is_ascii_digit())),
        "encoding" => {
            value.starts_with(|c: char| c.is_ascii_alphabetic())
                && value.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_' | b'-'))
        }
        _ => matches!(value, "yes" | "no"),
    }
}
