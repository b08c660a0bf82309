//! The order of bodies or forces in the file: elements move with what is written about them, all else keeps its bytes.

use std::collections::BTreeSet;
use std::ops::Range;

use rustc_hash::FxHashMap;

use super::pen::unit;
use super::style::raw;
use super::work::Work;
use super::{EditError, Side};
use crate::scene::NodeKey;
use crate::scene::locate::List;
use crate::scene::tree::{Child, Children, RawKind, Splice, raw_kind};

impl Work<'_> {
    /// Puts elements of one list before or after another of it, in the order that they have.
    pub fn reorder(&mut self, keys: &[NodeKey], side: Side, anchor: NodeKey) -> Result<(), EditError> {
        let (list, anchor_at) = self.find(anchor).ok_or(EditError::Gone)?;
        let mut moved = BTreeSet::new();
        for &key in keys {
            match self.find(key) {
                Some((found, at)) if found == list => drop(moved.insert(at)),
                Some(_) => return Err(EditError::Invalid("bodies and forces have a list each".into())),
                None => return Err(EditError::Gone),
            }
        }
        self.check_order(list, &moved, (side, anchor_at))?;
        let source = &self.pen.source.text;
        self.section(list.path(), |pen, el, _| {
            if is_there(el.children(source), &moved, (side, anchor_at)) {
                return Ok(el.clone());
            }
            Ok(pen.with_splices(
                el,
                splices(el.children(source), &moved, (side, anchor_at), source).into_iter(),
            ))
        })?;
        self.touched.cosmetics = true;
        self.forget_places();
        Ok(())
    }

    /// Refuses an order that would mean something else: what has one UserID is told apart by it, and what has none gets
    /// its UserID by it.
    fn check_order(
        &self,
        list: List,
        moved: &BTreeSet<usize>,
        (side, anchor): (Side, usize),
    ) -> Result<(), EditError> {
        let items = self.items_with_places(list);
        let places: Vec<usize> = items.iter().map(|(at, _)| *at).collect();
        let after = reordered(&places, moved, (side, anchor));
        let ids: FxHashMap<usize, Option<i64>> =
            items.iter().map(|(at, el)| (*at, self.written_id(el))).collect();
        let mut last = FxHashMap::default();
        for at in after {
            let id = ids.get(&at).copied().flatten();
            if last.insert(id, at).is_some_and(|before| before > at) {
                let of = id.map_or("without a UserID".to_owned(), |id| format!("of UserID {id}"));
                return Err(EditError::Invalid(format!(
                    "several objects {of} are told apart by their order; make the IDs unique first (Edit menu)"
                )));
            }
        }
        Ok(())
    }
}

/// Places in the order they get.
fn reordered(places: &[usize], moved: &BTreeSet<usize>, (side, anchor): (Side, usize)) -> Vec<usize> {
    let is_before = |at: usize| match side {
        Side::Before => at < anchor,
        Side::After => at <= anchor,
    };
    let staying = places.iter().copied().filter(|at| !moved.contains(at));
    let (before, behind): (Vec<_>, Vec<_>) = staying.partition(|at| is_before(*at));
    before.into_iter().chain(moved.iter().copied()).chain(behind).collect()
}

fn is_there(children: &Children, moved: &BTreeSet<usize>, to: (Side, usize)) -> bool {
    let elements = children.iter().enumerate().filter(|(_, child)| child.element().is_some());
    let places: Vec<usize> = elements.map(|(at, _)| at).collect();
    reordered(&places, moved, to).is_sorted()
}

/// Cuts the elements out and puts them in elsewhere.
fn splices(
    children: &Children,
    moved: &BTreeSet<usize>,
    (side, anchor): (Side, usize),
    source: &str,
) -> Vec<Splice> {
    let (mut taken, mut cuts) = (Vec::new(), Vec::new());
    for &at in moved {
        let (range, space) = piece(children, at, source);
        let behind_space = range.start + usize::from(space.is_some());
        taken.extend(space.and_then(|(_, goes)| text(goes)));
        taken.extend((behind_space..range.end).filter_map(|at| children.get(at).cloned()));
        cuts.push((range, space.and_then(|(stays, _)| text(stays)).into_iter().collect::<Vec<_>>()));
    }
    let (range, space) = piece(children, anchor, source);
    let put = match (side, space) {
        (Side::After, _) => (range.end..range.end, taken),
        (Side::Before, Some((stays, goes))) if !stays.is_empty() => {
            if let Some((_, left)) = cuts.iter_mut().find(|(cut, _)| *cut == range) {
                left.extend(taken);
                return cuts;
            }
            let around = text(stays).into_iter().chain(taken).chain(text(goes));
            (range.start..range.start + 1, around.collect())
        }
        (Side::Before, _) => (range.start..range.start, taken),
    };
    let place = cuts.partition_point(|(cut, _)| cut.start < put.0.start);
    cuts.insert(place, put);
    cuts
}

fn text(text: &str) -> Option<Child> {
    (!text.is_empty()).then(|| Child::Raw(text.into()))
}

/// An element with what is written about it: comments on lines of their own right above, and those behind it on its
/// line. It begins with the white space before it, if there is some: lines that are empty stay, the rest goes with it.
fn piece<'s>(
    children: &'s Children,
    at: usize,
    source: &'s str,
) -> (Range<usize>, Option<(&'s str, &'s str)>) {
    let start = comments_above(children, at, source);
    let (_, end) = unit(children, at, source);
    let space = start.checked_sub(1).and_then(|before| space_at(children, before, source));
    match space {
        None => (start..end, None),
        Some(space) => {
            let line = space.rfind('\n').map_or(0, |at| at - usize::from(space[..at].ends_with('\r')));
            (start - 1..end, Some(space.split_at(line)))
        }
    }
}

/// The first of the comments that stand above an element, on lines of their own and with no empty line between; the
/// element itself if there is none.
fn comments_above(children: &Children, at: usize, source: &str) -> usize {
    let (mut start, mut breaks) = (at, 0);
    for here in (0..at).rev() {
        let Some(text) = children.get(here).and_then(|child| raw(child, source)) else { break };
        match raw_kind(text) {
            // White space may be in several pieces, after an edit.
            RawKind::Space => breaks += text.matches('\n').count(),
            RawKind::Comment => {
                breaks = 0;
                let before = here.checked_sub(1).and_then(|before| space_at(children, before, source));
                if before.is_some_and(|space| space.contains('\n')) {
                    start = here;
                }
            }
            RawKind::Instruction | RawKind::Text => break,
        }
        if breaks > 1 {
            break;
        }
    }
    start
}

fn space_at<'s>(children: &'s Children, at: usize, source: &'s str) -> Option<&'s str> {
    let text = children.get(at).and_then(|child| raw(child, source))?;
    (raw_kind(text) == RawKind::Space).then_some(text)
}
