//! What a file holds besides the scene: comments, and pieces that the format does not know. They are kept on saving.

use super::read::is_cosmetic;
use super::tree::{Child, RawKind, View, raw_kind, tag};
use super::vocabulary::{Content, ElementInfo, VOCABULARY};
use super::{Document, shown};

/// What is no part of what a scene means.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Foreign {
    /// How many comments there are.
    pub comments: usize,
    /// Unknown elements, attributes, texts and instructions, by name, in file order.
    pub unknown: Vec<String>,
}

impl Document {
    /// Comments and unknown pieces.
    pub fn foreign(&self) -> Foreign {
        let mut found = Foreign::default();
        for child in self.top() {
            match child {
                Child::Raw(text) => found.raw(text.get(self.source_text())),
                Child::Element(node) => {
                    let el = View { node, source: self.source_text() };
                    found.element(el, (el.name() == VOCABULARY.name).then_some(&VOCABULARY));
                }
            }
        }
        found
    }
}

impl Foreign {
    /// Of an unknown element only the comments inside still count.
    fn element(&mut self, el: View<'_>, info: Option<&'static ElementInfo>) {
        let Some(info) = info else {
            self.unknown.push(shown(el.name()));
            return;
        };
        let known = |name: &str| info.attributes.iter().any(|attribute| attribute.name == name);
        let own = el.attributes().filter(|attr| !known(attr.name) && attr.name != "xmlns");
        self.unknown.extend(own.filter(|attr| !attr.name.contains(':')).map(|attr| shown(attr.name)));
        if matches!(info.content, Content::Anything) {
            return;
        }
        for child in el.node.children(el.source).iter() {
            match child {
                Child::Raw(text) => self.raw(text.get(el.source)),
                Child::Element(node) => {
                    let child = View { node, source: el.source };
                    let info = info.children().find(|info| info.name == child.name());
                    self.element(child, info);
                }
            }
        }
    }

    fn raw(&mut self, raw: &str) {
        match raw_kind(raw) {
            RawKind::Comment => self.comments += 1,
            RawKind::Text => self.unknown.push(shown(raw.trim())),
            RawKind::Instruction if !is_cosmetic(raw) && tag::name(raw) != "?xml" => {
                self.unknown.push(shown(tag::name(raw)));
            }
            RawKind::Instruction | RawKind::Space => {}
        }
    }
}
