//! Groups with names: folders of the tree that hold bodies and forces, nested by `/`, to select, hide and lock at once.

use std::collections::{BTreeMap, BTreeSet};

use egui::{Rect, Sense, Ui, pos2};

use super::dropping::{Dragged, Target};
use super::rows::{
    INDENT, Looks, Marked, Marks, Row, draw_name, mark_buttons, mark_edit, row_space, triangle,
};
use super::signs::Chip;
use super::{Renamed, Tree};
use crate::design;
use crate::editor::Action;
use crate::gui::context::{AppContext, Message, Shown};
use crate::gui::{numbers, widgets};
use crate::scene::{Edit, NodeKey, Scene};

/// How deep groups nest in the tree; a file may say anything, and what lies deeper has the rest of its path as its name.
const DEEPEST: usize = 12;

/// One row of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Such as `table/legs`.
    pub path: String,
    pub depth: usize,
    /// Everything in it, groups inside it included.
    pub keys: Vec<NodeKey>,
    pub open: bool,
    marks: Marks,
}

impl Named {
    fn name(&self) -> &str {
        let name = self.path.splitn(DEEPEST, '/').last().unwrap_or_default();
        if name.trim().is_empty() { "(no name)" } else { name }
    }
}

/// What of a group the filter lets through, and what is known of the whole of it.
#[derive(Default)]
struct Content {
    rows: Vec<Row>,
    keys: Vec<NodeKey>,
    visible: bool,
    free: bool,
}

/// The rows of all named groups. A filter opens those in which it finds something and leaves out the others.
pub fn collect(
    scene: &Scene,
    is_found: &dyn Fn(NodeKey) -> bool,
    filtered: bool,
    open: &BTreeSet<String>,
) -> Vec<Row> {
    let mut groups = BTreeMap::<Vec<&str>, Content>::new();
    let bodies = scene.bodies.iter().enumerate().filter_map(|(index, body)| {
        let row = Row::Body { index, key: body.key, depth: 0 };
        Some((body.group.as_deref()?, row, body.key, body.hidden, body.locked))
    });
    let forces = scene.forces.iter().enumerate().filter_map(|(index, force)| {
        let row = Row::Force { index, key: force.key, depth: 0 };
        Some((force.group.as_deref()?, row, force.key, force.hidden, force.locked))
    });
    for (group, row, key, hidden, locked) in forces.chain(bodies) {
        let path: Vec<&str> = group.splitn(DEEPEST, '/').collect();
        for depth in 1..=path.len() {
            let content = groups.entry(path[..depth].to_vec()).or_default();
            content.keys.push(key);
            content.visible |= !hidden;
            content.free |= !locked;
        }
        if is_found(key)
            && let Some(content) = groups.get_mut(&path)
        {
            content.rows.push(row);
        }
    }
    let mut rows = Vec::new();
    for (path, content) in in_order(scene, &groups) {
        let is_open = |path: &[&str]| filtered || open.contains(&path.join("/"));
        let found_below = || {
            groups
                .range(path.clone()..)
                .take_while(|(other, _)| other.starts_with(path))
                .any(|(_, content)| !content.rows.is_empty())
        };
        let in_sight = (1..path.len()).all(|depth| is_open(&path[..depth]));
        if !in_sight || (filtered && !found_below()) {
            continue;
        }
        let (depth, open) = (path.len() - 1, is_open(path));
        rows.push(Row::Named(Box::new(Named {
            path: path.join("/"),
            depth,
            keys: content.keys.clone(),
            open,
            marks: Marks { hidden: !content.visible, locked: !content.free },
        })));
        if open {
            rows.extend(content.rows.iter().map(|row| row.at_depth(depth + 1)));
        }
    }
    rows
}

/// Groups beside each other in the order of the file, each with those inside it behind it.
fn in_order<'a, 'b>(
    scene: &Scene,
    groups: &'b BTreeMap<Vec<&'a str>, Content>,
) -> Vec<(&'b Vec<&'a str>, &'b Content)> {
    let ranks = design::group_ranks(scene);
    let mut ordered: Vec<_> = groups.iter().collect();
    ordered.sort_by_cached_key(|(path, _)| {
        let rank = |depth: usize| ranks.get(path[..depth].join("/").as_str()).copied();
        (1..=path.len()).map(|depth| (rank(depth), path[depth - 1].to_owned())).collect::<Vec<_>>()
    });
    ordered
}

impl Tree {
    /// Opens the groups in which something lies that was selected elsewhere, alone.
    pub(super) fn reveal(&mut self, context: &AppContext<'_>, shown: &Shown) {
        let [key] = context.session.selection().keys() else { return };
        if self.revealed == Some(*key) {
            return;
        }
        self.revealed = Some(*key);
        let body = shown.body(*key).and_then(|body| body.group.as_deref());
        let group = body.or_else(|| shown.force(*key).and_then(|force| force.group.as_deref()));
        let Some(group) = group else { return };
        let ends = group.match_indices('/').take(DEEPEST - 1).map(|(at, _)| at).chain([group.len()]);
        self.open_named.extend(ends.map(|end| group[..end].to_owned()));
    }

    pub(super) fn named_row(&mut self, ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, named: &Named) {
        let selection = context.session.selection();
        let selected = named.keys.iter().all(|key| selection.contains(*key));
        let (rect, response) = row_space(ui, selected, named.name());
        let left = rect.left() + 12.0 + INDENT * named.depth as f32;
        let folder = Rect::from_min_max(rect.min, pos2(left + 8.0, rect.bottom()));
        let toggle = ui.interact(folder, ui.scope_id().with(("folder", &named.path)), Sense::click());
        let verb = if named.open { "Close" } else { "Open" };
        widgets::name_button(ui, &toggle, &format!("{verb} {}", named.path), named.open);
        triangle(ui, pos2(left, rect.center().y), named.open);
        let name = Rect::from_min_max(pos2(left + 10.0, rect.top()), rect.max);
        if self.is_renaming(&Renamed::Group(named.path.clone())) {
            ui.scope_builder(egui::UiBuilder::new().max_rect(name), |ui| {
                ui.horizontal_centered(|ui| self.rename_field(ui, context, shown));
            });
        } else {
            let count = numbers::count(named.keys.len() as u64);
            let looks =
                Looks { name: named.name(), detail: &count, chip: Chip::None, marks: named.marks, depth: 0 };
            draw_name(ui, name, &looks, selected);
        }
        let (name, help) = (format!("group {}", named.path), format!("all in {}", named.path));
        let marked = Marked {
            id: ui.scope_id().with(("named mark", &named.path)),
            name: &name,
            marks: named.marks,
            helps: [&help; 2],
        };
        if let Some(mark) = mark_buttons(ui, rect, &marked, response.contains_pointer()) {
            let edits = named.keys.iter().map(|key| mark_edit(shown, *key, mark));
            context.outbox.act(Action::Edit { edit: Edit::All(edits.collect()), gesture: None });
        }
        response.context_menu(|ui| super::rows::context_menu(ui, context));
        response.dnd_set_drag_payload(Dragged::Group(named.path.clone()));
        self.take_drop(ui, context, &response, &Target::of_group(ui, &named.path, rect));
        if toggle.clicked() {
            if !self.open_named.remove(&named.path) {
                self.open_named.insert(named.path.clone());
            }
        } else if response.double_clicked() {
            self.start_renaming(Renamed::Group(named.path.clone()), named.path.clone());
        } else if response.clicked() || (response.secondary_clicked() && !selected) {
            // Many at once: nothing to scroll to.
            self.scrolled_to = named.keys.last().copied();
            let adds = ui.input(|input| input.modifiers.command || input.modifiers.shift);
            let keys = named.keys.clone();
            context.outbox.act(if adds { Action::AddToSelection(keys) } else { Action::Select(keys) });
        }
        if toggle.double_clicked() {
            context.outbox.send(Message::Frame(named.keys.clone()));
        }
    }
}
