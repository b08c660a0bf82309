//! Looking at an element together with the source its text lies in.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Child, Element, NO_PLACE, tag};

/// An element and the source text of its document.
#[derive(Clone, Copy)]
pub(in crate::scene) struct View<'a> {
    pub node: &'a Arc<Element>,
    pub source: &'a str,
}

impl<'a> View<'a> {
    pub fn tag(self) -> &'a str {
        self.node.open.get(self.source)
    }

    pub fn name(self) -> &'a str {
        tag::name(self.tag())
    }

    pub fn attributes(self) -> impl Iterator<Item = tag::Attr<'a>> {
        tag::attributes(self.tag()).flatten()
    }

    pub fn attribute(self, name: &str) -> Option<tag::Attr<'a>> {
        tag::find(self.tag(), name)
    }

    /// The value of an attribute, references resolved.
    pub fn value(self, name: &str) -> Option<Cow<'a, str>> {
        self.attribute(name).map(|attr| attr.resolved())
    }

    /// The child elements.
    pub fn elements(self) -> impl DoubleEndedIterator<Item = View<'a>> + Clone {
        let source = self.source;
        self.node.children(source).iter().filter_map(Child::element).map(move |node| View { node, source })
    }

    /// The first child element of that name.
    pub fn child(self, name: &str) -> Option<View<'a>> {
        self.elements().find(|child| child.name() == name)
    }

    /// The children that are no elements, as written.
    pub fn raws(self) -> impl Iterator<Item = &'a str> {
        let source = self.source;
        self.node.children(source).iter().filter_map(move |child| match child {
            Child::Raw(text) => Some(text.get(source)),
            Child::Element(_) => None,
        })
    }

    /// Where it is in the source, in bytes.
    pub fn place(self) -> Option<u32> {
        (self.node.at != NO_PLACE).then_some(self.node.at)
    }
}

/// What a raw child is, told from its first characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) enum RawKind {
    Space,
    Comment,
    Instruction,
    Text,
}

pub(in crate::scene) fn raw_kind(raw: &str) -> RawKind {
    if raw.starts_with("<!--") {
        RawKind::Comment
    } else if raw.starts_with("<?") {
        RawKind::Instruction
    } else if raw.chars().all(crate::scene::number::is_space) {
        RawKind::Space
    } else {
        RawKind::Text
    }
}
