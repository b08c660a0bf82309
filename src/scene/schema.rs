//! XML schemas (XSD 1.0) of the format, written from its vocabulary: editors complete and check by them.
//!
//! What they cannot say: that a body has exactly one shape (elements in any order have no choice in XSD 1.0), and ranges of
//! numbers with a decimal comma beyond their sign. `polyscene check` says both.

use std::fmt::Write as _;

use super::diagnostic::escaped;
use super::vocabulary::{AttributeInfo, Content, ElementInfo, Need, Part, Since, VOCABULARY, ValueKind};

/// The schema of a version.
pub fn schema(version: Since) -> String {
    let mut text = head(version);
    element(&mut text, &VOCABULARY, "", version, 1);
    text.push_str("</xs:schema>\n");
    text
}

fn head(version: Since) -> String {
    let (number, versions) = match version {
        Since::V1_0 => ("1.0", r"\s*1([.,]0+)?\s*"),
        Since::V1_1 => ("1.1", r"\s*1([.,]0*[01])?\s*"),
    };
    let mut text = format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<!-- PolyPhysicsXml {number}. Written by `polyscene schema {number}`. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
"#
    );
    let unsigned = "([0-9]+([.,][0-9]*)?|[.,][0-9]+)";
    // Some digit is not 0.
    let above_0 = "([0-9]*[1-9][0-9]*([.,][0-9]*)?|[0-9]*[.,][0-9]*[1-9][0-9]*)";
    let exponent = "([eE][+\\-]?[0-9]+)?";
    let tiles = "([1-9][0-9]{0,3}|[1-5][0-9]{4}|6[0-4][0-9]{3}|65[0-4][0-9]{2}|655[0-2][0-9]|6553[0-6])";
    let types = [
        ("Number", format!(r"\s*[+\-]?{unsigned}{exponent}\s*"), "a decimal comma or point"),
        ("Positive", format!(r"\s*\+?{above_0}{exponent}\s*"), "a number greater than 0"),
        (
            "NotNegative",
            format!(r"\s*(\+?{unsigned}|-(0+([.,]0*)?|[.,]0+)){exponent}\s*"),
            "a number of 0 or more",
        ),
        ("Tiles", format!(r"\s*\+?0*{tiles}([.,]0*)?\s*"), "a whole number from 1 to 65536"),
        ("Id", r"\s*[+\-]?[0-9]+\s*".into(), "a whole number of 64 bits"),
        ("Version", versions.into(), "of the format"),
    ];
    for (name, pattern, meaning) in types {
        let _ = writeln!(
            text,
            "  <xs:simpleType name=\"{name}\">
    <xs:annotation><xs:documentation>{meaning}</xs:documentation></xs:annotation>
    <xs:restriction base=\"xs:string\"><xs:pattern value=\"{pattern}\"/></xs:restriction>
  </xs:simpleType>"
        );
    }
    text
}

/// An element with its type in place. `occurs` is an attribute with a space before it, or nothing.
fn element(text: &mut String, info: &ElementInfo, occurs: &str, version: Since, depth: usize) {
    let indent = "  ".repeat(depth);
    let _ = writeln!(
        text,
        "{indent}<xs:element name=\"{}\"{occurs}>
{indent}  <xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>",
        info.name,
        xml(info.meaning)
    );
    if !matches!(info.content, Content::Anything) {
        let _ = writeln!(text, "{indent}  <xs:complexType>");
        content(text, info, version, depth + 2);
        for attribute in info.attributes {
            let _ = writeln!(text, "{indent}    {}", attribute_line(attribute));
        }
        let _ = writeln!(
            text,
            "{indent}    <xs:anyAttribute namespace=\"##other\" processContents=\"lax\"/>
{indent}  </xs:complexType>"
        );
    }
    let _ = writeln!(text, "{indent}</xs:element>");
}

fn content(text: &mut String, info: &ElementInfo, version: Since, depth: usize) {
    let indent = "  ".repeat(depth);
    match info.content {
        Content::Parts(parts) if parts.iter().any(|part| part.element.since <= version) => {
            let _ = writeln!(text, "{indent}<xs:all>");
            for part in parts.iter().filter(|part| part.element.since <= version) {
                element(text, &part.element, occurs(part), version, depth + 1);
            }
            let _ = writeln!(text, "{indent}</xs:all>");
        }
        Content::List(list) => {
            let _ = writeln!(text, "{indent}<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">");
            for child in list.iter().filter(|child| child.since <= version) {
                element(text, child, "", version, depth + 1);
            }
            let _ = writeln!(text, "{indent}</xs:choice>");
        }
        Content::Parts(_) | Content::Anything => {}
    }
}

fn occurs(part: &Part) -> &'static str {
    match part.need {
        Need::Required => "",
        Need::Shape | Need::Default(_) | Need::Optional => " minOccurs=\"0\"",
    }
}

fn attribute_line(attribute: &AttributeInfo) -> String {
    let (kind, limits) = match attribute.kind {
        ValueKind::Number => ("Number", None),
        ValueKind::Positive => ("Positive", None),
        ValueKind::NotNegative => ("NotNegative", None),
        ValueKind::Between(low, high) => {
            (if low > 0.0 { "Positive" } else { "NotNegative" }, Some(format!("from {low:e} to {high:e}")))
        }
        ValueKind::Tiles => ("Tiles", None),
        ValueKind::Id => ("Id", None),
        ValueKind::Version => ("Version", None),
        ValueKind::Text => ("xs:string", None),
    };
    let needed = if attribute.required { " use=\"required\"" } else { "" };
    let start = format!("<xs:attribute name=\"{}\" type=\"{kind}\"{needed}", attribute.name);
    match limits {
        Some(limits) => format!(
            "{start}><xs:annotation><xs:documentation>{limits}</xs:documentation></xs:annotation></xs:attribute>"
        ),
        None => format!("{start}/>"),
    }
}

fn xml(text: &str) -> String {
    quick_xml::escape::escape(escaped(text)).into_owned()
}
