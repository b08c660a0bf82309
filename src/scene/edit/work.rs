//! An edit in the making: the tree so far, and what later steps need to know of it.

use std::sync::{Arc, OnceLock};

use super::patch::{self, Changes};
use super::pen::{Changed, Pen, Spot, check, check_text, check_vector};
use super::style::lead_at;
use super::{Edit, EditError, Edited, Touched, body, cosmetic, force, settings};
use crate::scene::document::Content;
use crate::scene::ids::Ids;
use crate::scene::locate::{self, Index, List};
use crate::scene::rules::{self, Range};
use crate::scene::tree::{Child, Children, Element, tag};
use crate::scene::{Document, Names, NodeKey, number, viewpoint};

/// Children of the root and of `Simulation`, in the order in which they are written.
const SECTIONS: [&str; 6] = ["Map", "Simulation", "Primitives", "TimeSpeed", "Forces", "Solver"];

pub(super) struct Work<'d> {
    document: &'d Document,
    pub pen: Pen<'d>,
    top: Children,
    /// Where bodies and forces stand; gone when an edit added or removed some.
    index: Option<Arc<Index>>,
    ids: [Option<Ids>; 2],
    names: [Option<Names>; 2],
    pub added: Vec<NodeKey>,
    pub touched: Touched,
    /// All that the edit did, as long as it only changed bodies.
    changes: Option<Changes>,
}

impl<'d> Work<'d> {
    pub fn on(document: &'d Document) -> Result<Self, EditError> {
        let Content::Tree(top) = document.content() else {
            let first = document.diagnostics().first().map(ToString::to_string).unwrap_or_default();
            let message =
                format!("the file cannot be edited before it is repaired in a text editor: {first}");
            return Err(EditError::Invalid(message));
        };
        let source = &*document.source;
        let style = source.style(top);
        let pen = Pen { source, style };
        let root = locate::root(top, &source.text).ok_or(EditError::Gone)?;
        if root.name() != "PolyPhysicsXml" {
            return Err(EditError::Invalid("the file is no scene, so it cannot be edited as one".into()));
        }
        let index = document.index.get().cloned();
        let (top, changes) = (top.clone(), Some(Changes::new()));
        Ok(Self {
            document,
            pen,
            top,
            index,
            ids: [None, None],
            names: [None, None],
            added: Vec::new(),
            touched: Touched::default(),
            changes,
        })
    }

    pub fn apply(&mut self, edit: &Edit) -> Result<(), EditError> {
        self.touched.settings |=
            matches!(edit, Edit::MapSize(_) | Edit::MapTiles(_) | Edit::TimeSpeed(_) | Edit::Params(_));
        self.touched.cosmetics |= matches!(edit, Edit::Viewpoints(_));
        match edit {
            Edit::MapSize(size) => {
                check_vector("the map's size", *size, Range::Positive)?;
                self.section(&["Map"], |pen, map, lead| settings::set_size(pen, map, lead, *size))
            }
            Edit::MapTiles(tiles) => {
                if let Some(must) = tiles.iter().find_map(|&tiles| rules::tiles_refusal(f64::from(tiles))) {
                    return Err(EditError::Invalid(format!("the number of tiles on an axis {must}")));
                }
                self.section(&["Map"], |pen, map, lead| settings::set_tiles(pen, map, lead, *tiles))
            }
            Edit::TimeSpeed(speed) => {
                check("the time speed", *speed, Range::NotNegative)?;
                self.section(&["Simulation"], |pen, el, lead| {
                    pen.with_leaf(el, lead, ("TimeSpeed", &SECTIONS), &[("F32", *speed)], Some(1.0))
                })
            }
            Edit::Params(params) => {
                settings::check_params(params)?;
                self.section(&["Simulation"], |pen, el, lead| {
                    settings::set_params(pen, el, lead, &SECTIONS, params)
                })
            }
            Edit::Viewpoints(viewpoints) => {
                viewpoints.iter().try_for_each(|viewpoint| check_text(&viewpoint.name))?;
                let text = viewpoint::write(viewpoints);
                self.section(&[], |pen, root, lead| {
                    cosmetic::set(pen, root, lead, viewpoint::ATTRIBUTE, text.as_deref())
                })
            }
            Edit::Body { key, change } => self.items_changed(List::Bodies, &[(*key, change)], body::change),
            Edit::Force { key, change } => self.items_changed(List::Forces, &[(*key, change)], force::change),
            Edit::AddBody(body) => self.add_body(body),
            Edit::AddForce(force) => self.add_force(force),
            Edit::Duplicate { keys, offset } => self.duplicate(keys, *offset),
            Edit::CopyBodies(copies) => self.copy_bodies(copies),
            Edit::Delete { keys } => self.delete(keys),
            Edit::Reorder { keys, side, anchor } => self.reorder(keys, *side, *anchor),
            Edit::MakeIdsUnique => self.make_ids_unique(),
            Edit::All(edits) => self.apply_all(edits),
        }
    }

    /// Runs of changes of bodies are made together, so that many bodies move as quickly as one.
    fn apply_all(&mut self, edits: &[Edit]) -> Result<(), EditError> {
        let body_change = |edit: &'_ Edit| matches!(edit, Edit::Body { .. });
        for run in edits.chunk_by(|a, b| body_change(a) && body_change(b)) {
            if run.len() == 1 || !body_change(&run[0]) {
                run.iter().try_for_each(|edit| self.apply(edit))?;
                continue;
            }
            let changes = run.iter().filter_map(|edit| match edit {
                Edit::Body { key, change } => Some((*key, change)),
                _ => None,
            });
            self.items_changed(List::Bodies, &changes.collect::<Vec<_>>(), body::change)?;
        }
        Ok(())
    }

    /// The document after the edit, its version raised or lowered if its use of 1.1 began or ended.
    pub fn finish(mut self) -> Result<Edited, EditError> {
        if self.is_unchanged() {
            let (document, touched) = (self.document.clone(), Touched::default());
            return Ok(Edited { document, added: self.added, touched });
        }
        let mut document = self.make();
        if let Some(changes) = &self.changes
            && let Some(meaning) = patch::patched(self.pen, self.document.meaning(), changes)
        {
            document.meaning = OnceLock::from(Arc::new(meaning));
        }
        let (before, now) = (&self.document.meaning().features, &document.meaning().features);
        let version = if now.exceeds(before) {
            Some("1.1")
        } else if now.is_empty() && !before.is_empty() {
            Some("1.0")
        } else {
            None
        };
        if let Some(version) = version {
            let pen = self.pen;
            self.section(&[], |_, root, _| Ok(with_version(pen, root, version)))?;
            document = self.make();
        }
        Ok(Edited { document, added: self.added, touched: self.touched })
    }

    /// Changes the element at a path below the root; those missing on the way are added if need be.
    pub fn section(
        &mut self,
        path: &[&str],
        change: impl FnOnce(Pen<'_>, &Arc<Element>, &str) -> Changed,
    ) -> Result<(), EditError> {
        self.changes = None;
        let source = &self.pen.source.text;
        let at = self.top.iter().position(|child| child.element().is_some()).ok_or(EditError::Gone)?;
        let root = self.top.get(at).and_then(Child::element).ok_or(EditError::Gone)?;
        debug_assert_eq!(tag::name(root.open.get(source)), "PolyPhysicsXml");
        let new = descend(self.pen, root, &self.pen.style.newline, path, change)?;
        if !Arc::ptr_eq(&new, root) {
            self.top = self.top.splice(at..at + 1, vec![Child::Element(new)]);
        }
        Ok(())
    }

    /// Changes bodies or forces, in the order of the changes.
    pub fn items_changed<C>(
        &mut self,
        list: List,
        changes: &[(NodeKey, &C)],
        change: impl Fn(Pen<'_>, &Arc<Element>, &str, &C) -> Changed,
    ) -> Result<(), EditError> {
        let mut places = Vec::with_capacity(changes.len());
        for (key, _) in changes {
            match self.find(*key) {
                Some((found, at)) if found == list => places.push(at),
                _ => return Err(EditError::Gone),
            }
        }
        let before = self.changes.take().filter(|_| list == List::Bodies);
        let mut changed = Changes::new();
        self.section(list.path(), |pen, el, _| {
            for (at, (_, to)) in places.into_iter().zip(changes) {
                let old =
                    el.children(&pen.source.text).get(at).and_then(Child::element).ok_or(EditError::Gone)?;
                let lead = lead_at(el.children(&pen.source.text), at, &pen.source.text);
                let new = change(pen, changed.get(&at).map_or(old, |(_, new)| new), &lead, to)?;
                if !Arc::ptr_eq(&new, old) {
                    changed.insert(at, (old.clone(), new));
                }
            }
            let splices =
                changed.iter().map(|(&at, (_, new))| (at..at + 1, vec![Child::Element(new.clone())]));
            Ok(pen.with_splices(el, splices))
        })?;
        self.touched.keys.extend(changed.values().map(|(_, new)| new.key));
        self.changes = before.map(|mut all| {
            for (at, (old, new)) in changed {
                let old = all.remove(&at).map_or(old, |(old, _)| old);
                all.insert(at, (old, new));
            }
            all
        });
        Ok(())
    }

    /// The tree so far.
    pub fn tree(self) -> Children {
        self.top
    }

    pub fn find(&mut self, key: NodeKey) -> Option<(List, usize)> {
        let (top, source) = (&self.top, &self.pen.source.text);
        let index = self.index.get_or_insert_with(|| Arc::new(locate::index(top, source)));
        index.get(&key).copied()
    }

    /// To be called when places in a list have shifted.
    pub fn forget_places(&mut self) {
        self.index = None;
    }

    /// The elements of a list.
    pub fn items(&self, list: List) -> Vec<Arc<Element>> {
        self.items_with_places(list).into_iter().map(|(_, item)| item).collect()
    }

    /// The elements of a list, with their places among its children.
    pub fn items_with_places(&self, list: List) -> Vec<(usize, Arc<Element>)> {
        let root = locate::root(&self.top, &self.pen.source.text);
        let el = root.and_then(|root| list.find(root));
        let children = el.into_iter().flat_map(|el| el.node.children(el.source).iter().enumerate());
        children.filter_map(|(at, child)| Some((at, child.element()?.clone()))).collect()
    }

    /// The ids in use, including those that the reader gives to elements without.
    pub fn ids(&mut self, list: List) -> &mut Ids {
        let slot = list as usize;
        let ids = self.ids[slot].take().unwrap_or_else(|| self.all_ids(list));
        self.ids[slot].insert(ids)
    }

    /// The names in use.
    pub fn names(&mut self, list: List) -> &mut Names {
        let scene = self.document.scene();
        self.names[list as usize].get_or_insert_with(|| match (scene, list) {
            (Some(scene), List::Bodies) => {
                Names::new(scene.bodies.iter().filter_map(|body| body.name.as_deref()))
            }
            (Some(scene), List::Forces) => {
                Names::new(scene.forces.iter().filter_map(|force| force.name.as_deref()))
            }
            (None, _) => Names::default(),
        })
    }

    fn all_ids(&self, list: List) -> Ids {
        let scene = self.document.scene();
        let given: Vec<i64> = match list {
            List::Bodies => scene.map(|scene| scene.bodies.iter().map(|body| body.id).collect()),
            List::Forces => scene.map(|scene| scene.forces.iter().map(|force| force.id).collect()),
        }
        .unwrap_or_default();
        let written = self.items(list);
        Ids::new(written.iter().filter_map(|el| self.written_id(el)).chain(given))
    }

    pub fn written_id(&self, el: &Arc<Element>) -> Option<i64> {
        self.pen.view(el).value("UserID")?.trim_matches(number::is_space).parse().ok()
    }

    fn is_unchanged(&self) -> bool {
        let Content::Tree(before) = self.document.content() else { return false };
        let root = |top: &Children| top.iter().find_map(Child::element).cloned();
        match (root(before), root(&self.top)) {
            (Some(before), Some(now)) => Arc::ptr_eq(&before, &now),
            _ => false,
        }
    }

    fn make(&self) -> Document {
        Document {
            source: self.document.source.clone(),
            content: OnceLock::from(Content::Tree(self.top.clone())),
            unwritten: None,
            meaning: OnceLock::new(),
            index: self.index.clone().map(OnceLock::from).unwrap_or_default(),
        }
    }
}

fn descend(
    pen: Pen<'_>,
    el: &Arc<Element>,
    lead: &str,
    path: &[&str],
    change: impl FnOnce(Pen<'_>, &Arc<Element>, &str) -> Changed,
) -> Changed {
    let [name, rest @ ..] = path else { return change(pen, el, lead) };
    let (parent, at) = match pen.child_at(el, name) {
        Some(at) => (el.clone(), at),
        None => {
            let empty = |_: &str| format!("<{name}{}", pen.style.self_close);
            let parent = pen.with_new(el, lead, Spot::Ordered(&SECTIONS), name, empty)?;
            let at = pen.child_at(&parent, name).ok_or(EditError::Gone)?;
            (parent, at)
        }
    };
    let changed = pen.with_child(&parent, at, |child, lead| descend(pen, child, lead, rest, change))?;
    // What was only added on the way is not worth a change.
    Ok(if Arc::ptr_eq(&changed, &parent) { el.clone() } else { changed })
}

/// Only 1.0 and 1.1 are changed: any other version is a claim of its own.
fn with_version(pen: Pen<'_>, root: &Arc<Element>, version: &str) -> Arc<Element> {
    let written = pen.view(root).value("Version");
    match written.as_deref().map(|written| written.trim().replace(',', ".")).as_deref() {
        None | Some("1" | "1.0" | "1.1") => pen.with_text(root, "Version", version),
        Some(_) => root.clone(),
    }
}
