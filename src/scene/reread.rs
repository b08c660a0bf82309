//! A file read again: bodies and forces that are still there keep their keys, so that what runs and what is selected goes
//! on with them.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use rustc_hash::FxHashMap;

use super::document::{Content, read_file};
use super::encoding::encode;
use super::tree::{Child, Children, Element};
use super::{Document, NodeKey, Scene, Touched};

impl Document {
    /// Reads a file that this document was read from before. What has the same label keeps its key.
    pub fn reopen(&self, path: &Path) -> Self {
        match read_file(path) {
            Ok(bytes) => self.reread(&bytes),
            Err(_) => Self::open(path),
        }
    }

    /// As [`Self::reopen`], from a text that was edited by hand, in the encoding of this document.
    pub fn rewritten(&self, text: &str) -> Self {
        self.reread(&encode(text, self.source.encoding))
    }

    /// As [`Self::reopen`], from bytes.
    pub fn reread(&self, bytes: &[u8]) -> Self {
        let new = Self::from_bytes_with_keys(bytes.into(), self.source.keys.clone());
        let (Some(before), Some(after), Content::Tree(top)) = (self.scene(), new.scene(), new.content())
        else {
            return new;
        };
        let known: FxHashMap<(bool, &str), NodeKey> = labels(before).collect();
        let same = labels(after).filter_map(|(label, key)| Some((key, *known.get(&label)?)));
        let tree = with_keys(top, &new.source.text, &same.collect());
        Self::of_tree(new.source.clone(), tree)
    }

    /// Bodies, forces and settings that differ between two versions of a document, by their keys.
    pub fn differences(&self, other: &Self) -> Touched {
        let (Some(before), Some(after)) = (self.scene(), other.scene()) else { return Touched::default() };
        let keys = labels(before).chain(labels(after)).map(|(_, key)| key).collect();
        let cosmetics = self.viewpoints() != other.viewpoints();
        Touched { keys, settings: true, cosmetics }.that_differs(before, after)
    }
}

/// Labels of bodies (marked so) and of forces, which have a name space of their own.
fn labels(scene: &Scene) -> impl Iterator<Item = ((bool, &str), NodeKey)> {
    let bodies = scene.bodies.iter().map(|body| ((true, body.label.as_str()), body.key));
    bodies.chain(scene.forces.iter().map(|force| ((false, force.label.as_str()), force.key)))
}

/// The tree with other keys for some elements, which are read anew. Nothing inside bodies and forces has any.
fn with_keys(children: &Children, source: &str, keys: &FxHashMap<NodeKey, NodeKey>) -> Children {
    let one = |child: &Child| match child {
        Child::Raw(text) => Child::Raw(text.clone()),
        Child::Element(el) => Child::Element(match keys.get(&el.key) {
            Some(key) => {
                let mut el = Element::clone(el);
                (el.key, el.reading) = (*key, OnceLock::new());
                Arc::new(el)
            }
            // A list, or what holds one.
            None if el.reading.get().is_none() => {
                Arc::new(el.with_children(with_keys(el.children(source), source, keys)))
            }
            None => el.clone(),
        }),
    };
    Children::from(children.iter().map(one).collect::<Vec<_>>())
}
