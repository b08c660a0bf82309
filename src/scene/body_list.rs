//! The bodies of a scene. Versions of a document, and what their elements mean by themselves, share those that did not change: a
//! hundred thousand bodies are held once, and an edit copies one.

use std::ops::{Index, IndexMut};
use std::slice;
use std::sync::Arc;

use super::types::Body;

/// In file order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyList(Vec<Arc<Body>>);

/// What [`BodyList::iter`] gives.
pub type Iter<'a> = std::iter::Map<slice::Iter<'a, Arc<Body>>, fn(&'a Arc<Body>) -> &'a Body>;
/// What [`BodyList::iter_mut`] gives.
pub type IterMut<'a> = std::iter::Map<slice::IterMut<'a, Arc<Body>>, fn(&'a mut Arc<Body>) -> &'a mut Body>;

impl BodyList {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn get(&self, at: usize) -> Option<&Body> {
        self.0.get(at).map(AsRef::as_ref)
    }

    /// A copy of its own, where another version has it too.
    pub fn get_mut(&mut self, at: usize) -> Option<&mut Body> {
        self.0.get_mut(at).map(Arc::make_mut)
    }

    pub fn last(&self) -> Option<&Body> {
        self.0.last().map(AsRef::as_ref)
    }

    pub fn iter(&self) -> Iter<'_> {
        self.0.iter().map(AsRef::as_ref)
    }

    /// Each a copy of its own, where another version has it too.
    pub fn iter_mut(&mut self) -> IterMut<'_> {
        self.0.iter_mut().map(Arc::make_mut)
    }

    pub fn reserve(&mut self, more: usize) {
        self.0.reserve(more);
    }

    pub fn push(&mut self, body: impl Into<Arc<Body>>) {
        self.0.push(body.into());
    }

    pub fn retain(&mut self, mut stays: impl FnMut(&Body) -> bool) {
        self.0.retain(|body| stays(body));
    }

    /// Two different ones; `None` where one is missing.
    pub fn get_two_mut(&mut self, a: usize, b: usize) -> Option<[&mut Body; 2]> {
        self.0.get_disjoint_mut([a, b]).ok().map(|pair| pair.map(Arc::make_mut))
    }

    pub fn as_slice(&self) -> &[Arc<Body>] {
        &self.0
    }

    /// The list behind it, to be put in another order.
    pub fn as_mut_slice(&mut self) -> &mut [Arc<Body>] {
        &mut self.0
    }
}

impl Index<usize> for BodyList {
    type Output = Body;

    fn index(&self, at: usize) -> &Body {
        &self.0[at]
    }
}

impl IndexMut<usize> for BodyList {
    fn index_mut(&mut self, at: usize) -> &mut Body {
        Arc::make_mut(&mut self.0[at])
    }
}

impl IntoIterator for BodyList {
    type Item = Body;
    type IntoIter = std::iter::Map<std::vec::IntoIter<Arc<Body>>, fn(Arc<Body>) -> Body>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter().map(Arc::unwrap_or_clone)
    }
}

impl<'a> IntoIterator for &'a BodyList {
    type Item = &'a Body;
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

impl<'a> IntoIterator for &'a mut BodyList {
    type Item = &'a mut Body;
    type IntoIter = IterMut<'a>;

    fn into_iter(self) -> IterMut<'a> {
        self.iter_mut()
    }
}

impl<B: Into<Arc<Body>>> FromIterator<B> for BodyList {
    fn from_iter<I: IntoIterator<Item = B>>(bodies: I) -> Self {
        Self(bodies.into_iter().map(Into::into).collect())
    }
}

impl<B: Into<Arc<Body>>> Extend<B> for BodyList {
    fn extend<I: IntoIterator<Item = B>>(&mut self, bodies: I) {
        self.0.extend(bodies.into_iter().map(Into::into));
    }
}

impl From<Vec<Body>> for BodyList {
    fn from(bodies: Vec<Body>) -> Self {
        bodies.into_iter().collect()
    }
}

impl<const N: usize> From<[Body; N]> for BodyList {
    fn from(bodies: [Body; N]) -> Self {
        bodies.into_iter().collect()
    }
}
