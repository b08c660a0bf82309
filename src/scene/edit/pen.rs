//! Changing elements: each function gives the element changed, or the very same one where nothing differs.

use std::sync::Arc;

use super::EditError;
use super::style::{Style, is_open, lead_at, raw};
use crate::scene::source::Source;
use crate::scene::tree::{Child, Children, Element, RawKind, Splice, View, raw_kind, tag};
use crate::scene::{NumberStyle, number, parse, rules};

/// Writes into one document, in its style.
#[derive(Clone, Copy)]
pub(super) struct Pen<'a> {
    pub source: &'a Source,
    pub style: &'a Style,
}

pub(super) type Changed = Result<Arc<Element>, EditError>;

/// Where a new child goes.
#[derive(Clone, Copy)]
pub(super) enum Spot<'o> {
    /// Before all other elements, behind the start tag's line.
    First,
    Last,
    After(usize),
    /// Behind its predecessors in a list of names.
    Ordered(&'o [&'o str]),
}

impl<'a> Pen<'a> {
    pub fn view<'e>(self, node: &'e Arc<Element>) -> View<'e>
    where
        'a: 'e,
    {
        View { node, source: &self.source.text }
    }

    /// The place of the first child element of a name.
    pub fn child_at(self, el: &Element, name: &str) -> Option<usize> {
        let source = &self.source.text;
        let is_it = |child: &Child| child.element().is_some_and(|node| View { node, source }.name() == name);
        el.children(source).iter().position(is_it)
    }

    /// Sets an attribute to a text, escaped as need be.
    pub fn with_text(self, el: &Arc<Element>, name: &str, value: &str) -> Arc<Element> {
        if self.view(el).value(name).is_some_and(|old| old == value) {
            return el.clone();
        }
        let open = tag::with_raw(self.view(el).tag(), name, &escaped(value), self.style.quote);
        Arc::new(el.with_open(open))
    }

    /// Sets numeric attributes: each only if its bits differ, in the number style it has.
    pub fn with_numbers(self, el: &Arc<Element>, numbers: &[(&str, f64)]) -> Arc<Element> {
        let mut open = None;
        for &(name, value) in numbers {
            let tag = open.as_deref().unwrap_or(self.view(el).tag());
            let old = tag::find(tag, name);
            let resolved = old.as_ref().and_then(|attr| quick_xml::escape::unescape(attr.raw).ok());
            if let Some(Ok(old)) = resolved.map(|raw| number::parse(&raw))
                && old.to_bits() == value.to_bits()
            {
                continue;
            }
            let style =
                old.as_ref().and_then(|attr| number::style_of(attr.raw)).unwrap_or(self.style.numbers);
            let written = number::format(value, style);
            let raw = match &old {
                // Spaces around the old number stay.
                Some(attr) if !attr.raw.trim().is_empty() && !attr.raw.contains('&') => {
                    attr.raw.replacen(attr.raw.trim(), &written, 1)
                }
                _ => written,
            };
            open = Some(tag::with_raw(tag, name, &raw, self.style.quote));
        }
        open.map_or_else(|| el.clone(), |open| Arc::new(el.with_open(open)))
    }

    /// Sets the numbers of a child element, which is added if it is absent and they are not `default`.
    pub fn with_leaf(
        self,
        el: &Arc<Element>,
        lead: &str,
        (name, order): (&str, &[&str]),
        numbers: &[(&str, f64)],
        default: Option<f64>,
    ) -> Changed {
        if let Some(at) = self.child_at(el, name) {
            return self.with_child(el, at, |child, _| Ok(self.with_numbers(child, numbers)));
        }
        let is_default = |value: f64| default.is_some_and(|default| default.to_bits() == value.to_bits());
        if numbers.iter().all(|&(_, value)| is_default(value)) {
            return Ok(el.clone());
        }
        self.with_new(el, lead, Spot::Ordered(order), name, |_| self.leaf(name, numbers))
    }

    /// Replaces a child element by what `change` makes of it; it also gets the white space before it.
    pub fn with_child(
        self,
        el: &Arc<Element>,
        at: usize,
        change: impl FnOnce(&Arc<Element>, &str) -> Changed,
    ) -> Changed {
        let Some(old) = el.children(&self.source.text).get(at).and_then(Child::element) else {
            return Err(EditError::Gone);
        };
        let new = change(old, &lead_at(el.children(&self.source.text), at, &self.source.text))?;
        if Arc::ptr_eq(&new, old) {
            return Ok(el.clone());
        }
        Ok(Arc::new(
            el.with_children(el.children(&self.source.text).splice(at..at + 1, vec![Child::Element(new)])),
        ))
    }

    /// Replaces ranges of children, which are in order; the very same element if there are none.
    pub fn with_splices(self, el: &Arc<Element>, splices: impl Iterator<Item = Splice>) -> Arc<Element> {
        let splices = splices.collect::<Vec<_>>();
        if splices.is_empty() {
            return el.clone();
        }
        Arc::new(el.with_children(el.children(&self.source.text).splice_all(splices)))
    }

    /// Adds the new child `name` that `xml` writes, given the white space before it.
    pub fn with_new(
        self,
        el: &Arc<Element>,
        lead: &str,
        spot: Spot<'_>,
        name: &str,
        xml: impl FnOnce(&str) -> String,
    ) -> Changed {
        let (at, near) = self.insertion(el, spot, name);
        let inner = match near {
            Some(near) => lead_at(el.children(&self.source.text), near, &self.source.text),
            None => self.style.inner_lead(lead),
        };
        let new = parse::fragment(&xml(&inner), &self.source.keys)
            .map_err(|fault| EditError::Invalid(fault.message))?;
        Ok(Arc::new(self.with_inserted(el, lead, at, inner, new)))
    }

    /// Adds children at an index, behind white space, and opens an element that was one empty tag.
    pub fn with_inserted(
        self,
        el: &Element,
        lead: &str,
        at: usize,
        inner: String,
        new: Vec<Child>,
    ) -> Element {
        let mut added = Vec::new();
        let breaks = inner.contains('\n');
        if !inner.is_empty() {
            added.push(Child::Raw(inner.into()));
        }
        added.extend(new);
        if el.children(&self.source.text).len() == 0 && breaks {
            added.push(Child::Raw(lead.into()));
        }
        let mut changed = el.with_children(el.children(&self.source.text).splice(at..at, added));
        if is_open(el, &self.source.text) {
            return changed;
        }
        let tag = el.open.get(&self.source.text);
        let open = format!("{}>", tag.trim_end_matches("/>").trim_end());
        changed.close = format!("</{}>", tag::name(tag)).into();
        changed.open = open.into();
        changed
    }

    /// Adds children behind the last one, each on a line of its own as that one is.
    pub fn with_appended(self, el: &Element, new: Vec<Child>) -> Element {
        let (at, near) = self.insertion(el, Spot::Last, "");
        let lead = near
            .map_or(String::new(), |near| lead_at(el.children(&self.source.text), near, &self.source.text));
        let space = || (!lead.is_empty()).then(|| Child::Raw(lead.as_str().into()));
        let added = new.into_iter().flat_map(|child| space().into_iter().chain([child])).collect();
        el.with_children(el.children(&self.source.text).splice(at..at, added))
    }

    /// The index for a new child, and the sibling whose indentation it copies.
    fn insertion(self, el: &Element, spot: Spot<'_>, name: &str) -> (usize, Option<usize>) {
        let children = el.children(&self.source.text);
        let source = &self.source.text;
        let elements = || children.iter().enumerate().filter(|(_, child)| child.element().is_some());
        let first = elements().next().map(|(at, _)| at);
        match spot {
            Spot::First => (end_of_line(children, 0, source), first),
            Spot::After(at) => (end_of_line(children, at + 1, source), Some(at)),
            Spot::Last => {
                let is_space = |child| raw(child, source).is_some_and(|raw| raw_kind(raw) == RawKind::Space);
                let space = children.iter().rev().take_while(|&child| is_space(child)).count();
                let last = children.iter().rev().position(|child| child.element().is_some());
                (children.len() - space, last.map(|back| children.len() - 1 - back))
            }
            Spot::Ordered(order) => {
                let rank = |name: &str| order.iter().position(|&candidate| candidate == name);
                let name_of = |node| View { node, source }.name();
                let before = elements()
                    .filter_map(|(at, child)| child.element().map(|node| (at, rank(name_of(node)))))
                    .filter(|(_, other)| other.is_some_and(|other| Some(other) < rank(name)));
                match (before.last(), first) {
                    (Some((at, _)), _) => self.insertion(el, Spot::After(at), name),
                    (None, Some(first)) => (unit(children, first, source).0, Some(first)),
                    (None, None) => self.insertion(el, Spot::Last, name),
                }
            }
        }
    }

    /// The element without a child, the white space before it and the comments behind it on its line.
    pub fn without_child(self, el: &Element, at: usize) -> Element {
        let (start, end) = unit(el.children(&self.source.text), at, &self.source.text);
        el.with_children(el.children(&self.source.text).splice(start..end, Vec::new()))
    }

    /// `<Name A="1" B="2" />`
    pub fn leaf(self, name: &str, numbers: &[(&str, f64)]) -> String {
        let quote = self.style.quote;
        let number = |value| number::format(value, self.style.numbers);
        let attrs = numbers.iter().map(|&(name, value)| format!(" {name}={quote}{}{quote}", number(value)));
        format!("<{name}{}{}", attrs.collect::<String>(), self.style.self_close)
    }

    /// `Name="text"`, with the space before it.
    pub fn attribute(self, name: &str, text: &str) -> String {
        let quote = self.style.quote;
        format!(" {name}={quote}{}{quote}", escaped(text))
    }

    /// A copy whose nodes have keys of their own.
    pub fn copy(self, el: &Element) -> Element {
        let children = el.children(&self.source.text).iter().map(|child| match child {
            Child::Element(child) => Child::Element(Arc::new(self.copy(child))),
            Child::Raw(text) => Child::Raw(text.clone()),
        });
        let children = Children::from(children.collect::<Vec<_>>());
        let key = self.source.keys.fresh();
        let mut copy = el.with_children(children);
        (copy.key, copy.at) = (key, crate::scene::tree::NO_PLACE);
        copy
    }
}

/// The first index at or behind `from` that is not on the same line: comments there belong to what is
/// before them.
fn end_of_line(children: &Children, from: usize, source: &str) -> usize {
    let mut end = from;
    for at in from..children.len() {
        match children.get(at).and_then(|child| raw(child, source)) {
            Some(raw) if raw_kind(raw) == RawKind::Space => {
                if raw.contains('\n') {
                    return end;
                }
            }
            Some(raw) if raw_kind(raw) == RawKind::Comment => end = at + 1,
            _ => return from,
        }
    }
    // The parent's end tag is on the line: the comments may be about anything.
    from
}

/// What goes when a child goes: from the white space before it to the comments behind it on its line.
pub(super) fn unit(children: &Children, at: usize, source: &str) -> (usize, usize) {
    let before = at.checked_sub(1).and_then(|before| children.get(before));
    let space =
        before.and_then(|child| raw(child, source)).is_some_and(|raw| raw_kind(raw) == RawKind::Space);
    (at - usize::from(space), end_of_line(children, at + 1, source))
}

/// A text as the value of an attribute in either kind of quotes.
pub(super) fn escaped(text: &str) -> String {
    let escaped = quick_xml::escape::escape(text);
    escaped.replace('\n', "&#10;").replace('\r', "&#13;").replace('\t', "&#9;")
}

/// Refuses a text that XML cannot hold.
pub(super) fn check_text(text: &str) -> Result<(), EditError> {
    match text.chars().find(|&c| !rules::is_xml_char(c)) {
        Some(c) => Err(EditError::Invalid(format!("the character U+{:04X} cannot be stored", u32::from(c)))),
        None => Ok(()),
    }
}

/// Refuses a number out of range.
pub(super) fn check(name: &str, value: f64, range: rules::Range) -> Result<(), EditError> {
    match range.refusal(value) {
        Some(must) => {
            let value = number::format(value, NumberStyle::Point);
            Err(EditError::Invalid(format!("{name} {must}; {value} was given")))
        }
        None => Ok(()),
    }
}

/// Refuses a vector with a number out of range.
pub(super) fn check_vector(name: &str, value: glam::DVec3, range: rules::Range) -> Result<(), EditError> {
    let axes = [("x", value.x), ("y", value.y), ("z", value.z)];
    axes.into_iter().try_for_each(|(axis, value)| check(&format!("{name} {axis}"), value, range))
}
