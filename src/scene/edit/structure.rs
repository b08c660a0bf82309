//! Edits that add and remove bodies and forces.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::body::check_shape;
use super::force::check_kind;
use super::pen::{Changed, Pen, Spot, check, check_text, check_vector, unit};
use super::style::lead_at;
use super::work::Work;
use super::{BodyCopy, EditError, body, compose, cosmetic};
use crate::scene::locate::List;
use crate::scene::rules::Range;
use crate::scene::tree::{Child, Element};
use crate::scene::{Body, Force, Motion, NodeKey, number};

/// Children of a list, by index, each with its place in the keys of the edit.
type Places = (List, Vec<(usize, usize)>);

impl Work<'_> {
    pub fn add_body(&mut self, body: &Body) -> Result<(), EditError> {
        check_body(body)?;
        let id = self.ids(List::Bodies).take(body.id);
        let name = if body.is_dynamic() { "SoftObject" } else { "HardObject" };
        self.add(List::Bodies, name, |pen, lead| compose::body(pen, lead, id, body))
    }

    pub fn add_force(&mut self, force: &Force) -> Result<(), EditError> {
        check_kind(&force.kind)?;
        force.name.as_deref().map_or(Ok(()), check_text)?;
        force.group.as_deref().map_or(Ok(()), check_text)?;
        let id = self.ids(List::Forces).take(force.id);
        self.add(List::Forces, super::force::kind_name(&force.kind), |pen, lead| {
            compose::force(pen, lead, id, force)
        })
    }

    fn add(
        &mut self,
        list: List,
        name: &str,
        xml: impl FnOnce(Pen<'_>, &str) -> String,
    ) -> Result<(), EditError> {
        let mut added = None;
        self.section(list.path(), |pen, el, lead| {
            let el = pen.with_new(el, lead, Spot::Last, name, |lead| xml(pen, lead))?;
            added = el.children(&pen.source.text).iter().rev().find_map(Child::element).map(|node| node.key);
            Ok(el)
        })?;
        self.touched.keys.extend(added);
        self.added.extend(added);
        self.forget_places();
        Ok(())
    }

    pub fn delete(&mut self, keys: &[NodeKey]) -> Result<(), EditError> {
        let source = self.pen.source;
        for (list, places) in self.places(keys)? {
            self.section(list.path(), |pen, el, _| {
                let unit = |at| unit(el.children(&source.text), at, &source.text);
                let ranges = places.iter().map(|&(at, _)| unit(at));
                Ok(pen.with_splices(el, ranges.map(|(start, end)| (start..end, Vec::new()))))
            })?;
        }
        self.touched.keys.extend(keys);
        self.forget_places();
        Ok(())
    }

    pub fn duplicate(&mut self, keys: &[NodeKey], offset: DVec3) -> Result<(), EditError> {
        check_vector("the offset", offset, Range::Any)?;
        let mut added = Vec::new();
        for (list, places) in self.places(keys)? {
            let (orders, places): (Vec<_>, Vec<_>) = places.iter().map(|&(at, order)| (order, at)).unzip();
            let copies =
                self.append_copies(list, &places, |pen, _, copy, lead| moved(pen, copy, lead, offset))?;
            added.extend(orders.into_iter().zip(copies));
        }
        added.sort_unstable();
        self.touched.keys.extend(added.iter().map(|(_, key)| key));
        self.added.extend(added.into_iter().map(|(_, key)| key));
        Ok(())
    }

    pub fn copy_bodies(&mut self, copies: &[BodyCopy]) -> Result<(), EditError> {
        let mut places = Vec::with_capacity(copies.len());
        for copy in copies {
            match self.find(copy.of) {
                Some((List::Bodies, at)) => places.push(at),
                _ => return Err(EditError::Gone),
            }
        }
        let added = self.append_copies(List::Bodies, &places, |pen, nth, copy, lead| {
            let changes = copies.get(nth).map_or(&[][..], |copy| &copy.changes);
            changes.iter().try_fold(copy.clone(), |el, change| body::change(pen, &el, lead, change))
        })?;
        self.touched.keys.extend(&added);
        self.added.extend(added);
        Ok(())
    }

    /// Appends copies of the elements at these places of a list, each with an id and a name of its own and as
    /// `change` makes it, which also gets its number. Gives their keys.
    fn append_copies(
        &mut self,
        list: List,
        places: &[usize],
        change: impl Fn(Pen<'_>, usize, &Arc<Element>, &str) -> Changed,
    ) -> Result<Vec<NodeKey>, EditError> {
        let mut added = Vec::with_capacity(places.len());
        if places.is_empty() {
            return Ok(added);
        }
        let ids = places.iter().map(|_| self.ids(list).fresh()).collect::<Vec<_>>();
        let mut names = std::mem::take(self.names(list));
        self.section(list.path(), |pen, el, _| {
            let mut copies = Vec::with_capacity(places.len());
            for ((nth, &at), id) in places.iter().enumerate().zip(ids) {
                let original =
                    el.children(&pen.source.text).get(at).and_then(Child::element).ok_or(EditError::Gone)?;
                let lead = lead_at(el.children(&pen.source.text), at, &pen.source.text);
                let copy = pen.with_text(&Arc::new(pen.copy(original)), "UserID", &id.to_string());
                let name = cosmetic::get(pen, &copy, "name").filter(|name| !name.is_empty());
                let copy = match name {
                    Some(name) => cosmetic::set(pen, &copy, &lead, "name", Some(&names.take(&name)))?,
                    None => copy,
                };
                let copy = change(pen, nth, &copy, &lead)?;
                added.push(copy.key);
                copies.push(Child::Element(copy));
            }
            Ok(Arc::new(pen.with_appended(el, copies)))
        })?;
        *self.names(list) = names;
        self.forget_places();
        Ok(added)
    }

    /// Gives fresh ids to all but the first of each id.
    pub fn make_ids_unique(&mut self) -> Result<(), EditError> {
        for list in [List::Bodies, List::Forces] {
            let mut seen = FxHashSet::default();
            let mut changes = Vec::new();
            for item in self.items(list) {
                if self.written_id(&item).is_some_and(|id| !seen.insert(id)) {
                    changes.push((item.key, self.ids(list).fresh().to_string()));
                }
            }
            if !changes.is_empty() {
                let changes = changes.iter().map(|(key, id)| (*key, id)).collect::<Vec<_>>();
                self.items_changed(list, &changes, |pen, el, _, id| Ok(pen.with_text(el, "UserID", id)))?;
            }
        }
        Ok(())
    }

    /// Where elements stand in their lists, in file order, each once with its place in `keys`.
    fn places(&mut self, keys: &[NodeKey]) -> Result<[Places; 2], EditError> {
        let mut places = [(List::Bodies, Vec::new()), (List::Forces, Vec::new())];
        for (order, &key) in keys.iter().enumerate() {
            let (list, at) = self.find(key).ok_or(EditError::Gone)?;
            places[list as usize].1.push((at, order));
        }
        for (_, places) in &mut places {
            places.sort_unstable();
            places.dedup_by_key(|place| place.0);
        }
        Ok(places)
    }
}

/// A body or force shifted; what has no place, or none that can be read, stays.
fn moved(pen: Pen<'_>, el: &Arc<Element>, lead: &str, offset: DVec3) -> Changed {
    let view = pen.view(el);
    let place = view.child("Translation");
    if offset == DVec3::ZERO || view.name() == "SpaceAverse" {
        return Ok(el.clone());
    }
    let mut numbers = Vec::new();
    for (axis, shift) in super::settings::vector(offset) {
        let old = place.and_then(|place| place.value(axis));
        match old.map(|raw| number::parse(&raw)) {
            Some(Ok(old)) => numbers.push((axis, old + shift)),
            Some(Err(_)) => {}
            None => numbers.push((axis, shift)),
        }
    }
    pen.with_leaf(el, lead, ("Translation", &["Translation"]), &numbers, Some(0.0))
}

fn check_body(body: &Body) -> Result<(), EditError> {
    check_vector("the position", body.position, Range::Any)?;
    check_vector("the rotation", body.rotation, Range::Any)?;
    check("the bounce", body.bounce, Range::NotNegative)?;
    check("the friction", body.roughness.friction, Range::NotNegative)?;
    check("the rolling friction", body.roughness.rolling, Range::NotNegative)?;
    check("the tangential restitution", body.roughness.tangential, Range::Between(0.0, 1.0))?;
    check_vector("the angular velocity", body.spin, Range::Any)?;
    if let Motion::Dynamic { mass, velocity } = body.motion {
        check("the mass", mass, Range::Positive)?;
        check_vector("the velocity", velocity, Range::Any)?;
    }
    body.name.as_deref().map_or(Ok(()), check_text)?;
    body.group.as_deref().map_or(Ok(()), check_text)?;
    body.material.as_deref().map_or(Ok(()), check_text)?;
    check_shape(&body.shape, body.is_dynamic())
}
