//! Two bodies that meet or touch, of which one at least is dynamic.

use super::body::BodyId;
use super::event::BodyRef;

/// Two bodies, `a` before `b`: so `a` is dynamic, and `b` is where one of them is static.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub a: BodyId,
    pub b: BodyId,
}

impl Pair {
    pub fn new(one: BodyId, other: BodyId) -> Self {
        let pair = Self { a: one.min(other), b: one.max(other) };
        debug_assert!(pair.a < pair.b && !pair.a.is_static(), "no pair: {pair:?}");
        pair
    }

    /// A dynamic body with any other.
    pub fn of(body: u32, other: BodyId) -> Self {
        Self::new(BodyId::of_dynamic(body), other)
    }

    /// `a` as a dynamic body.
    pub fn first(&self) -> u32 {
        self.a.index()
    }

    /// `b` if it is dynamic.
    pub fn second(&self) -> Option<u32> {
        self.b.dynamic()
    }

    /// The dynamic bodies.
    pub fn dynamic(&self) -> impl Iterator<Item = u32> + use<> {
        [Some(self.first()), self.second()].into_iter().flatten()
    }

    /// Each dynamic body with the other one of the pair.
    pub fn ends(&self) -> impl Iterator<Item = (u32, BodyId)> + use<> {
        let back = self.second().map(|second| (second, self.a));
        [Some((self.first(), self.b)), back].into_iter().flatten()
    }

    /// The other one of the pair of a dynamic body.
    pub fn other(&self, body: u32) -> BodyId {
        if self.first() == body { self.b } else { self.a }
    }

    pub fn involves(&self, body: u32) -> bool {
        let body = BodyId::of_dynamic(body);
        self.a == body || self.b == body
    }

    pub fn refs(&self) -> (BodyRef, BodyRef) {
        (self.a.to_ref(), self.b.to_ref())
    }
}
