//! UserIDs: labels that files repeat or leave out, made into labels that are unique.

use compact_str::{CompactString, ToCompactString as _, format_compact};
use rustc_hash::{FxBuildHasher, FxHashMap, FxHashSet};

/// Largest id that is given: the predecessor's tools read 32 bits.
const MAX_GIVEN: i64 = i32::MAX as i64;

/// What one body or force is called.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Label {
    pub id: i64,
    /// 1 for the first of that id in file order.
    pub repeat: u32,
}

impl Label {
    /// `id`, or `id#k` for the k-th of that id.
    pub fn text(self) -> CompactString {
        let Self { id, repeat } = self;
        if repeat == 1 { id.to_compact_string() } else { format_compact!("{id}#{repeat}") }
    }
}

/// The ids of all bodies or of all forces of a document.
#[derive(Debug)]
pub(super) struct Ids {
    taken: FxHashSet<i64>,
    /// Where to look for the next id to give.
    next: i64,
}

impl Ids {
    pub fn new(ids: impl Iterator<Item = i64>) -> Self {
        let taken = ids.collect::<FxHashSet<_>>();
        let largest = taken.iter().copied().max().unwrap_or(0).max(0);
        let next = if largest < MAX_GIVEN { largest + 1 } else { 1 };
        Self { taken, next }
    }

    /// An id that nothing has: the one after the largest, or the smallest free one if that is too large.
    pub fn fresh(&mut self) -> i64 {
        while !self.taken.insert(self.next) {
            self.next = if self.next < MAX_GIVEN { self.next + 1 } else { 1 };
        }
        self.next
    }

    /// The id itself, or a fresh one if something has it.
    pub fn take(&mut self, id: i64) -> i64 {
        if self.taken.insert(id) { id } else { self.fresh() }
    }
}

/// Labels for the elements of a list, in file order.
#[derive(Debug)]
pub(super) struct Labels {
    /// How often each id came; only if they do not all ascend, so that each comes once.
    repeats: Option<FxHashMap<i64, u32>>,
    /// Only if there are elements without an id.
    ids: Option<Ids>,
}

impl Labels {
    pub fn of(ids: &(impl Iterator<Item = Option<i64>> + Clone)) -> Self {
        let is_complete = ids.clone().all(|id| id.is_some());
        let ascends = is_complete && ids.clone().is_sorted_by(|one, next| one < next);
        let room = || FxHashMap::with_capacity_and_hasher(ids.clone().count(), FxBuildHasher);
        Self { repeats: (!ascends).then(room), ids: (!is_complete).then(|| Ids::new(ids.clone().flatten())) }
    }

    /// The label of the next element, with a given id if it has none.
    pub fn next(&mut self, id: Option<i64>) -> Label {
        let id = id.or_else(|| self.ids.as_mut().map(Ids::fresh)).unwrap_or_default();
        let Some(repeats) = &mut self.repeats else { return Label { id, repeat: 1 } };
        let repeat = repeats.entry(id).or_insert(0);
        *repeat += 1;
        Label { id, repeat: *repeat }
    }
}
