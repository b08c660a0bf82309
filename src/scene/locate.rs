//! Finding an element by its key.

use super::tree::{Child, Children, View};
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
        if descend(&node.children, source, key, chain) {
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
    body.or_else(force).map(String::as_str)
}
