//! Any XML file as a tree to read, with the places of its elements: what importers need. Checked for well-formedness as
//! scenes are, without a `DOCTYPE`, not nested too deep.

use std::borrow::Cow;

use super::document::Content;
use super::source::Source;
use super::tree::{Child, RawKind, View, raw_kind};
use super::{Document, locate};

/// An element of a document, whatever its name.
#[derive(Clone, Copy)]
pub struct XmlElement<'a> {
    view: View<'a>,
    source: &'a Source,
}

impl Document {
    /// The root element as plain XML; `None` for what is not well-formed.
    pub fn xml_root(&self) -> Option<XmlElement<'_>> {
        let Content::Tree(top) = self.content() else { return None };
        let view = locate::root(top, &self.source.text)?;
        Some(XmlElement { view, source: &self.source })
    }
}

impl<'a> XmlElement<'a> {
    pub fn name(self) -> &'a str {
        self.view.name()
    }

    /// The value of an attribute, references resolved.
    pub fn attribute(self, name: &str) -> Option<Cow<'a, str>> {
        self.view.value(name)
    }

    /// Names of all attributes.
    pub fn attribute_names(self) -> impl Iterator<Item = &'a str> {
        self.view.attributes().map(|attribute| attribute.name)
    }

    pub fn children(self) -> impl Iterator<Item = XmlElement<'a>> {
        let source = self.source;
        self.view.elements().map(move |view| XmlElement { view, source })
    }

    /// The first child of that name.
    pub fn child(self, name: &str) -> Option<XmlElement<'a>> {
        self.children().find(|child| child.name() == name)
    }

    /// The text right inside, references resolved, without the spaces around it.
    pub fn text(self) -> String {
        let pieces = self.view.node.children(self.view.source).iter().filter_map(|child| match child {
            Child::Raw(text) => Some(text.get(self.view.source)),
            Child::Element(_) => None,
        });
        let plain = pieces.filter(|raw| matches!(raw_kind(raw), RawKind::Text | RawKind::Space));
        let text: String = plain.map(unescaped).collect();
        text.trim().to_owned()
    }

    /// Line and column, from 1.
    pub fn position(self) -> Option<(u32, u32)> {
        self.view.place().map(|at| self.source.position(at as usize))
    }
}

fn unescaped(raw: &str) -> Cow<'_, str> {
    let cdata = raw.strip_prefix("<![CDATA[").and_then(|rest| rest.strip_suffix("]]>"));
    match cdata {
        Some(text) => text.into(),
        None => quick_xml::escape::unescape(raw).unwrap_or(raw.into()),
    }
}
