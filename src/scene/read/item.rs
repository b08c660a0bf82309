//! What one body or force element means by itself, kept with the element.

use std::sync::Arc;

use compact_str::CompactString;

use super::feature::{self, Use};
use super::log::Log;
use super::problem::{Limited, Problem};
use super::{body, cosmetic, force};
use crate::scene::ids::Label;
use crate::scene::tree::View;
use crate::scene::{Body, Force};

#[derive(Clone, Debug)]
pub(in crate::scene) struct ItemReading {
    /// With the `UserID` of the file and the label that it has alone, or without both: the rest depends on the other elements.
    pub item: Item,
    pub id: Option<i64>,
    /// Most have none.
    remarks: Option<Box<Remarks>>,
}

/// What there is to say about an element.
#[derive(Clone, Debug, Default)]
struct Remarks {
    problems: Limited<Problem>,
    uses: Vec<Use>,
}

#[derive(Clone, Debug)]
pub(in crate::scene) enum Item {
    Body(Arc<Body>),
    /// Behind a pointer too: there are a hundred thousand bodies for one force.
    Force(Box<Force>),
    /// An element that is neither.
    Unknown,
}

impl ItemReading {
    /// What a child of `Primitives` means, read if it has not been.
    pub fn kept_body(el: View<'_>) -> &Arc<Self> {
        el.node.reading.get_or_init(|| Arc::new(Self::of_body(el)))
    }

    fn new(item: Item, id: Option<i64>, remarks: Remarks) -> Self {
        let is_plain = remarks.problems.is_empty() && remarks.uses.is_empty();
        Self { item, id, remarks: (!is_plain).then(|| Box::new(remarks)) }
    }

    /// The same element with other numbers, that change neither its problems nor its uses.
    pub fn with_body(&self, body: Body) -> Self {
        Self { item: Item::Body(Arc::new(body)), id: self.id, remarks: self.remarks.clone() }
    }

    /// Paths begin below the element.
    pub fn problems(&self) -> &Limited<Problem> {
        const NONE: &Limited<Problem> = &Limited::NONE;
        self.remarks.as_ref().map_or(NONE, |remarks| &remarks.problems)
    }

    /// Elements of format 1.1.
    pub fn uses(&self) -> &[Use] {
        self.remarks.as_ref().map_or(&[], |remarks| &remarks.uses)
    }

    /// The body, if the element is one.
    pub fn body(&self) -> Option<&Arc<Body>> {
        match &self.item {
            Item::Body(body) => Some(body),
            Item::Force(_) | Item::Unknown => None,
        }
    }

    /// Reads a child of `Primitives`.
    pub fn of_body(el: View<'_>) -> Self {
        Self::of(el, &body::BODIES, |el, (log, id), cosmetics, uses| {
            let body = body::read(el, log, cosmetics, uses);
            // As it is called if no other has its id, so that the scene can share it.
            let own = id.map(|id| Label { id, repeat: 1 });
            let (id, label) = own.map_or((0, CompactString::default()), |own| (own.id, own.text()));
            Item::Body(Arc::new(Body { id, label, ..body }))
        })
    }

    /// Reads a child of `Forces`.
    pub fn of_force(el: View<'_>) -> Self {
        Self::of(el, &force::FORCES, |el, (log, _), cosmetics, _| {
            Item::Force(Box::new(force::read(el, log, cosmetics)))
        })
    }

    fn of<'a>(
        el: View<'a>,
        known: &[&str],
        read: impl FnOnce(View<'a>, (&mut Log<'a>, Option<i64>), cosmetic::Cosmetics, &mut Vec<Use>) -> Item,
    ) -> Self {
        let mut log = Log::default();
        let mut uses = Vec::new();
        if !known.contains(&el.name()) {
            log.unknown_element(el, known);
            return Self::new(Item::Unknown, None, Remarks { problems: log.problems, uses });
        }
        feature::note(&mut uses, el.name(), el.place());
        log.check_attributes(el, &["UserID"]);
        let id = log.user_id(el);
        let cosmetics = cosmetic::read(el, &mut log);
        let item = read(el, (&mut log, id), cosmetics, &mut uses);
        Self::new(item, id, Remarks { problems: log.problems, uses })
    }
}
