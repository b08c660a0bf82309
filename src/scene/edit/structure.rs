//! Edits that add and remove bodies and forces.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::body::check_shape;
use super::force::check_kind;
use super::pen::{Pen, Spot, check, check_text, check_vector};
use super::style::lead_at;
use super::work::Work;
use super::{EditError, compose};
use crate::scene::locate::List;
use crate::scene::rules::Range;
use crate::scene::tree::{Child, Element};
use crate::scene::{Body, Force, Motion, NodeKey, number};

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
            added = el.children.iter().rev().find_map(Child::element).map(|node| node.key);
            Ok(el)
        })?;
        self.added.extend(added);
        self.forget_places();
        Ok(())
    }

    pub fn delete(&mut self, keys: &[NodeKey]) -> Result<(), EditError> {
        for (list, at) in self.last_first(keys)? {
            self.section(list.path(), |pen, el, _| Ok(Arc::new(pen.without_child(el, at))))?;
        }
        self.forget_places();
        Ok(())
    }

    pub fn duplicate(&mut self, keys: &[NodeKey], offset: DVec3) -> Result<(), EditError> {
        check_vector("the offset", offset, Range::Any)?;
        let places = self.last_first(keys)?;
        // Ids are given in file order, though the copies are made from the end.
        let fresh = places.iter().rev().map(|&(list, _)| self.ids(list).fresh()).collect::<Vec<_>>();
        let mut added = Vec::new();
        for (&(list, at), id) in places.iter().zip(fresh.into_iter().rev()) {
            let source = self.pen.source;
            self.section(list.path(), |pen, el, lead| {
                let Some(original) = el.children.get(at).and_then(Child::element) else {
                    return Err(EditError::Gone);
                };
                let item_lead = lead_at(&el.children, at, &source.text);
                let copy = Arc::new(pen.copy(original));
                let copy = pen.with_text(&copy, "UserID", &id.to_string());
                let copy = moved(pen, &copy, &item_lead, offset)?;
                added.push(copy.key);
                let end = pen.line_end(el, at);
                Ok(Arc::new(pen.with_inserted(el, lead, end, item_lead, vec![Child::Element(copy)])))
            })?;
        }
        self.added.extend(added.into_iter().rev());
        self.forget_places();
        Ok(())
    }

    /// Gives fresh ids to all but the first of each id.
    pub fn make_ids_unique(&mut self) -> Result<(), EditError> {
        for list in [List::Bodies, List::Forces] {
            let mut seen = FxHashSet::default();
            for item in self.items(list) {
                let Some(id) = self.written_id(&item) else { continue };
                if !seen.insert(id) {
                    let fresh = self.ids(list).fresh().to_string();
                    self.item(list, item.key, |pen, el, _| Ok(pen.with_text(el, "UserID", &fresh)))?;
                }
            }
        }
        Ok(())
    }

    /// Where elements stand, each once, from the end of each list, so that changes leave the rest in place.
    fn last_first(&mut self, keys: &[NodeKey]) -> Result<Vec<(List, usize)>, EditError> {
        let places = keys.iter().map(|&key| self.find(key).ok_or(EditError::Gone));
        let mut places = places.collect::<Result<Vec<_>, _>>()?;
        places.sort_by_key(|&(list, at)| (list as usize, std::cmp::Reverse(at)));
        places.dedup();
        Ok(places)
    }
}

/// A body or force shifted; what has no place, or none that can be read, stays.
fn moved(pen: Pen<'_>, el: &Arc<Element>, lead: &str, offset: DVec3) -> super::pen::Changed {
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
    if let Motion::Dynamic { mass, velocity } = body.motion {
        check("the mass", mass, Range::Positive)?;
        check_vector("the velocity", velocity, Range::Any)?;
    }
    body.name.as_deref().map_or(Ok(()), check_text)?;
    body.material.as_deref().map_or(Ok(()), check_text)?;
    check_shape(&body.shape, body.is_dynamic())
}
