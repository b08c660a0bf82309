//! Collects problems while an element is read, and holds the checks that all elements share.

use std::num::IntErrorKind;

use super::problem::{Limited, Problem};
use crate::scene::diagnostic::Severity;
use crate::scene::rules::Range;
use crate::scene::tree::{RawKind, View, raw_kind};
use crate::scene::{number, shown};

/// The problems found so far and the path of the element being read.
#[derive(Default)]
pub(super) struct Log<'a> {
    pub problems: Limited<Problem>,
    path: Vec<&'a str>,
}

impl<'a> Log<'a> {
    /// Reads something inside a child element, whose name joins the path meanwhile.
    pub fn within<R>(&mut self, el: View<'a>, read: impl FnOnce(&mut Self) -> R) -> R {
        self.path.push(el.name());
        let result = read(self);
        self.path.pop();
        result
    }

    pub fn error(&mut self, at: Option<u32>, message: impl Into<String>, hint: impl Into<String>) {
        self.report(Severity::Error, at, message.into(), hint.into());
    }

    pub fn warn(&mut self, at: Option<u32>, message: impl Into<String>, hint: impl Into<String>) {
        self.report(Severity::Warning, at, message.into(), hint.into());
    }

    fn report(&mut self, severity: Severity, at: Option<u32>, message: String, hint: String) {
        let path = || self.path.iter().map(|name| format!("/{}", shown(name))).collect();
        self.problems.add(severity, || Problem { severity, at, path: path(), message, hint });
    }

    /// The first child of each known name. A second one is an error, an unknown one a warning.
    pub fn children<const N: usize>(&mut self, el: View<'a>, known: [&str; N]) -> [Option<View<'a>>; N] {
        let mut found = [None; N];
        for child in el.elements() {
            let name = child.name();
            match known.iter().position(|&candidate| candidate == name) {
                Some(slot) if found[slot].is_none() => found[slot] = Some(child),
                Some(_) => {
                    self.error(child.place(), format!("a second {name}"), "remove one of them");
                }
                None => self.unknown_element(child, &known),
            }
        }
        self.check_text(el);
        found
    }

    /// Warns of an element that means nothing here.
    pub fn unknown_element(&mut self, child: View<'a>, known: &[&str]) {
        let message = format!("the element {} is not known here", shown(child.name()));
        self.warn(child.place(), message, kept_or_meant(child.name(), known));
    }

    /// Warns of attributes that mean nothing here; those of namespaces are no concern of ours.
    pub fn check_attributes(&mut self, el: View<'a>, known: &[&str]) {
        for attr in el.attributes() {
            if !known.contains(&attr.name) && attr.name != "xmlns" && !attr.name.contains(':') {
                let at = place_in(el, attr.whole.start + 1);
                let message = format!("the attribute {} is not known here", shown(attr.name));
                self.warn(at, message, kept_or_meant(attr.name, known));
            }
        }
    }

    /// Checks an element that holds attributes only.
    pub fn leaf(&mut self, el: View<'a>, attributes: &[&str]) {
        self.check_attributes(el, attributes);
        self.children(el, []);
    }

    /// Warns of text, which means nothing in any element of the format.
    pub fn check_text(&mut self, el: View<'a>) {
        if el.raws().any(|raw| raw_kind(raw) == RawKind::Text) {
            self.warn(el.place(), "text between the elements means nothing", "it is kept as it is");
        }
    }

    /// A number that must be there and in range.
    pub fn number(&mut self, el: View<'a>, name: &str, range: Range) -> Option<f64> {
        let Some(attr) = el.attribute(name) else {
            let hint = format!("write {name}=\"…\"");
            self.error(el.place(), format!("the attribute {name} is missing"), hint);
            return None;
        };
        let at = place_in(el, attr.value.start);
        let value = attr.resolved();
        match number::parse(&value) {
            Ok(number) => match range.refusal(number) {
                Some(must) => {
                    self.error(at, format!("{name}=\"{}\" {must}", shown(&value)), "");
                    None
                }
                None => Some(number),
            },
            Err(fault) => {
                self.error(at, format!("{name}=\"{}\" is not a number", shown(&value)), fault.hint());
                None
            }
        }
    }

    /// The number `F32` of an element that holds nothing else.
    pub fn scalar(&mut self, el: View<'a>, range: Range) -> Option<f64> {
        self.within(el, |log| {
            log.leaf(el, &["F32"]);
            log.number(el, "F32", range)
        })
    }

    /// The numbers `X Y Z` of an element that holds nothing else.
    pub fn vector(&mut self, el: View<'a>, range: Range) -> Option<glam::DVec3> {
        self.within(el, |log| {
            log.leaf(el, &["X", "Y", "Z"]);
            let [x, y, z] = ["X", "Y", "Z"].map(|axis| log.number(el, axis, range));
            Some(glam::DVec3::new(x?, y?, z?))
        })
    }

    /// A whole number used as a label, if there is one.
    pub fn user_id(&mut self, el: View<'a>) -> Option<i64> {
        let attr = el.attribute("UserID")?;
        let value = attr.resolved();
        let digits = value.trim_matches(number::is_space);
        let fault = match digits.parse::<i64>() {
            Ok(id) => return Some(id),
            Err(fault) => fault,
        };
        let (what, hint) = match fault.kind() {
            IntErrorKind::PosOverflow | IntErrorKind::NegOverflow => (
                "is beyond the range of IDs",
                format!("write a whole number from {} to {}", i64::MIN, i64::MAX),
            ),
            IntErrorKind::Empty => ("is empty", "write a whole number such as 7".to_owned()),
            _ => {
                let hint = "write a whole number such as 7; a name belongs in the properties of the body";
                ("is not a whole number", hint.to_owned())
            }
        };
        let message = format!("UserID=\"{}\" {what}", shown(&value));
        self.error(place_in(el, attr.value.start), message, hint);
        None
    }
}

/// The place of something inside a start tag; the tag's own if the tag was edited since.
pub(super) fn place_in(el: View<'_>, offset: usize) -> Option<u32> {
    let in_source = matches!(el.node.open, crate::scene::tree::Text::Source { .. });
    el.place().map(|at| if in_source { at + offset as u32 } else { at })
}

fn kept_or_meant(name: &str, known: &[&str]) -> String {
    match known.iter().find(|candidate| candidate.eq_ignore_ascii_case(name)) {
        Some(meant) => format!("is {meant} meant? It is kept as it is"),
        None => "it is kept as it is".into(),
    }
}
