//! Finding elements: by key, and the two lists of bodies and forces.

use compact_str::CompactString;
use rustc_hash::FxHashMap;

use super::tree::{Child, Children, Kept, View};
use super::{NodeKey, Scene};

/// The elements from the root down to the one with that key; empty if there is none.
pub(super) fn chain<'a>(top: &'a Children, source: &'a str, key: NodeKey) -> Vec<View<'a>> {
    let mut chain = Vec::new();
    descend(top, source, key, &mut chain);
    chain
}

fn descend<'a>(children: &'a Children, source: &'a str, key: NodeKey, chain: &mut Vec<View<'a>>) -> bool {
    // Breadth first: what is looked for is a body, not something inside the bodies before it.
    let elements = || children.iter().filter_map(Child::element);
    if let Some(node) = elements().find(|node| node.key == key) {
        chain.push(View { node, source });
        return true;
    }
    for node in elements() {
        chain.push(View { node, source });
        // Nothing inside what is folded has a key that is asked for.
        if let Kept::Listed(children) = node.kept(source)
            && descend(children, source, key, chain)
        {
            return true;
        }
        chain.pop();
    }
    false
}

/// The label of a body or force.
pub(super) fn label_of(scene: &Scene, key: NodeKey) -> Option<&str> {
    let body = scene.bodies.iter().find(|body| body.key == key).map(|body| &body.label);
    let force = || scene.forces.iter().find(|force| force.key == key).map(|force| &force.label);
    body.or_else(force).map(CompactString::as_str)
}

/// The two lists that hold what a scene consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum List {
    Bodies,
    Forces,
}

impl List {
    /// Names of the elements from the root down to the list.
    pub fn path(self) -> &'static [&'static str] {
        match self {
            Self::Bodies => &["Primitives"],
            Self::Forces => &["Simulation", "Forces"],
        }
    }

    /// The list's element, if the document has it.
    pub fn find<'a>(self, root: View<'a>) -> Option<View<'a>> {
        self.path().iter().try_fold(root, |el, name| el.child(name))
    }
}

/// Where each body and force stands among the children of its list.
pub(super) type Index = FxHashMap<NodeKey, (List, usize)>;

/// Lists all bodies and forces.
pub(super) fn index(top: &Children, source: &str) -> Index {
    let mut index = Index::default();
    let Some(root) = root(top, source) else { return index };
    for list in [List::Bodies, List::Forces] {
        let Some(el) = list.find(root) else { continue };
        for (at, child) in el.node.children(source).iter().enumerate() {
            if let Child::Element(item) = child {
                index.insert(item.key, (list, at));
            }
        }
    }
    index
}

/// The elements from the root down to a body or force.
pub(super) fn item_chain(root: View<'_>, list: List, at: usize) -> Vec<View<'_>> {
    let source = root.source;
    let mut chain = vec![root];
    for name in list.path() {
        chain.extend(chain.last().and_then(|el| el.child(name)));
    }
    let item = chain.last().and_then(|el| el.node.children(source).get(at)).and_then(Child::element);
    chain.extend(item.map(|node| View { node, source }));
    chain
}

/// The root element.
pub(super) fn root<'a>(top: &'a Children, source: &'a str) -> Option<View<'a>> {
    top.iter().find_map(Child::element).map(|node| View { node, source })
}
