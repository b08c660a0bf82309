//! How a document is written: what new parts of it copy.

use crate::scene::NumberStyle;
use crate::scene::number;
use crate::scene::tree::{Child, Children, Element, RawKind, View, raw_kind};

#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct Style {
    /// Line break before the root's children; empty if the document has none.
    pub newline: String,
    /// What a level of nesting adds to the indentation.
    pub indent: String,
    pub quote: char,
    /// ` />` or `/>`.
    pub self_close: &'static str,
    pub numbers: NumberStyle,
}

impl Style {
    /// Finds the style of a document by its first examples.
    pub fn of(top: &Children, source: &str) -> Self {
        let root = top.iter().find_map(Child::element).map(|node| View { node, source });
        let newline = match source.find('\n') {
            Some(at) if source[..at].ends_with('\r') => "\r\n",
            Some(_) => "\n",
            None => "",
        };
        let find = |test: &mut dyn FnMut(View<'_>) -> bool| root.is_some_and(|root| any(root, test));
        let mut self_close = " />";
        find(&mut |el| {
            let tag = el.tag();
            let is_empty = tag.ends_with("/>");
            if is_empty && !tag.ends_with(" />") {
                self_close = "/>";
            }
            is_empty
        });
        let mut quote = '"';
        find(&mut |el| match el.attributes().next() {
            Some(attr) => {
                quote = if el.tag()[..attr.value.start].ends_with('\'') { '\'' } else { '"' };
                true
            }
            None => false,
        });
        let mut numbers = None;
        find(&mut |el| {
            let mut values = el.attributes().filter(|attr| matches!(attr.name, "X" | "Y" | "Z" | "F32"));
            numbers = values.find_map(|attr| number::style_of(attr.raw));
            numbers.is_some()
        });
        let indent = root.and_then(|root| lead_in(root.node.children(source), source)).unwrap_or_default();
        let indent = match indent.trim_start_matches(['\r', '\n']) {
            "" if newline.is_empty() => "",
            "" => "  ",
            indent => indent,
        };
        Self {
            newline: newline.into(),
            indent: indent.into(),
            quote,
            self_close,
            numbers: numbers.unwrap_or_default(),
        }
    }

    /// White space before the children of an element that stands behind `lead`.
    pub fn inner_lead(&self, lead: &str) -> String {
        if lead.contains('\n') { format!("{lead}{}", self.indent) } else { lead.to_owned() }
    }
}

/// Whether the test holds for an element or one inside it, in document order.
fn any(el: View<'_>, test: &mut dyn FnMut(View<'_>) -> bool) -> bool {
    test(el) || el.elements().any(|child| any(child, test))
}

/// The line break and indentation before the first child element that has some.
fn lead_in(children: &Children, source: &str) -> Option<String> {
    let elements = children.iter().enumerate().filter(|(_, child)| child.element().is_some());
    elements.map(|(at, _)| lead_before(children, at, source)).find(|lead| !lead.is_empty())
}

/// The line break and indentation before a child, or those of its siblings if it has none.
pub(in crate::scene) fn lead_at(children: &Children, at: usize, source: &str) -> String {
    match lead_before(children, at, source) {
        lead if lead.is_empty() => lead_in(children, source).unwrap_or_default(),
        lead => lead,
    }
}

fn lead_before(children: &Children, at: usize, source: &str) -> String {
    let before = at.checked_sub(1).and_then(|before| children.get(before));
    let Some(space) = before.and_then(|child| raw(child, source)) else { return String::new() };
    if raw_kind(space) != RawKind::Space {
        return String::new();
    }
    let line = space.rfind('\n').map_or(0, |at| at - usize::from(space[..at].ends_with('\r')));
    space[line..].to_owned()
}

/// The text of a child that is no element.
pub(in crate::scene) fn raw<'a>(child: &'a Child, source: &'a str) -> Option<&'a str> {
    match child {
        Child::Raw(text) => Some(text.get(source)),
        Child::Element(_) => None,
    }
}

/// Whether an element has an end tag of its own.
pub(in crate::scene) fn is_open(el: &Element, source: &str) -> bool {
    !el.close.get(source).is_empty()
}
