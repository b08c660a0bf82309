//! The scene tree: map, simulation, forces and bodies in groups, with filter, marks and renaming.

mod dropping;
mod named;
mod rows;
mod signs;

use std::collections::BTreeSet;

use egui::{RichText, ScrollArea, TextEdit, Ui};
use rustc_hash::FxHashMap;

use super::colors::tones;
use super::context::{AppContext, Message, Shown};
use super::theme::ROW_HEIGHT;
use crate::design::{self, Eye};
use crate::editor::{Action, SessionCommand};
use crate::record::Frame;
use crate::scene::{BodyChange, Edit, ForceChange, NodeKey};
use crate::sim::ContactState;
use dropping::Target;
pub use rows::force_kind;
use rows::{Group, Row, collect};

#[derive(Default)]
pub struct Tree {
    filter: String,
    wants_filter: bool,
    closed: Vec<Group>,
    /// Named groups that are open; others are closed.
    open_named: BTreeSet<String>,
    /// The selection whose groups were opened last.
    revealed: Option<NodeKey>,
    renaming: Option<Renaming>,
    /// Where a range of rows begins, for Shift and click.
    anchor: Option<NodeKey>,
    /// The selection that was scrolled to last.
    scrolled_to: Option<NodeKey>,
    known: Known,
    contacts: Contacts,
}

/// The rows, made again only when something they depend on has changed.
#[derive(Default)]
struct Known {
    of: Option<(u64, String, Vec<Group>, BTreeSet<String>)>,
    rows: Vec<Row>,
}

/// Which bodies are in lasting contact or stepped, as one frame has it.
#[derive(Default)]
struct Contacts {
    revision: u64,
    states: FxHashMap<NodeKey, ContactState>,
}

impl Contacts {
    fn refresh(&mut self, frame: &Frame) {
        if self.revision != frame.revision {
            let touching = frame.bodies.iter().filter(|body| body.contact != ContactState::Flight);
            self.states = touching.map(|body| (body.key, body.contact)).collect();
            self.revision = frame.revision;
        }
    }

    fn of(&self, key: NodeKey) -> ContactState {
        self.states.get(&key).copied().unwrap_or(ContactState::Flight)
    }
}

/// What gets another name.
#[derive(Clone, Debug, PartialEq)]
enum Renamed {
    Item(NodeKey),
    /// A group, by its path.
    Group(String),
}

struct Renaming {
    what: Renamed,
    text: String,
    started: bool,
}

impl Tree {
    /// Another scene: a filter made for the last one would hide it.
    pub fn opened(&mut self) {
        self.filter.clear();
        self.renaming = None;
        self.anchor = None;
        self.open_named.clear();
    }

    pub fn find(&mut self) {
        self.wants_filter = true;
    }

    pub fn rename(&mut self, key: NodeKey, context: &AppContext<'_>) {
        let Some(shown) = context.shown else { return };
        let body = shown.body(key).map(|body| body.name.clone());
        let name = body.or_else(|| shown.force(key).map(|force| force.name.clone()));
        if let Some(name) = name {
            self.start_renaming(Renamed::Item(key), name.unwrap_or_default());
        }
    }

    fn start_renaming(&mut self, what: Renamed, text: String) {
        self.renaming = Some(Renaming { what, text, started: false });
    }

    fn is_renaming(&self, what: &Renamed) -> bool {
        self.renaming.as_ref().is_some_and(|renaming| renaming.what == *what)
    }

    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        self.filter_field(ui, context);
        let Some(shown) = context.shown else {
            ui.label(RichText::new("  The file has errors; see Problems.").color(tones(ui).weak));
            return;
        };
        self.reveal(context, shown);
        self.refresh(shown);
        self.contacts.refresh(context.session.frame());
        let rows = std::mem::take(&mut self.known.rows);
        let target = self.row_to_scroll_to(&rows, context);
        let mut area = ScrollArea::vertical().auto_shrink([false, false]).id_salt("tree");
        if let Some(index) = target {
            let pitch = ROW_HEIGHT;
            let height = ui.available_height();
            area = area.vertical_scroll_offset((index as f32 * pitch - 0.4 * height).max(0.0));
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let response = area.show_rows(ui, ROW_HEIGHT, rows.len(), |ui, range| {
            for row in rows.get(range).unwrap_or_default() {
                self.show_row(ui, context, shown, &rows, row);
            }
        });
        // below the rows: a click there selects nothing
        let rest = egui::Rect::from_min_max(
            egui::pos2(ui.min_rect().left(), response.inner_rect.top() + response.content_size.y),
            response.inner_rect.max,
        );
        if rest.is_positive() {
            let free = ui.interact(rest, ui.scope_id().with("below rows"), egui::Sense::click());
            self.take_drop(ui, context, &free, &Target::Group(None));
            if free.clicked() {
                context.outbox.command(SessionCommand::SelectNone);
            }
        }
        self.known.rows = rows;
    }

    fn filter_field(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 4)).show(ui, |ui| {
            ui.horizontal(|ui| {
                let width = ui.available_width() - if self.filter.is_empty() { 0.0 } else { 26.0 };
                let edit = TextEdit::singleline(&mut self.filter)
                    .hint_text("Filter by name, ID or kind")
                    .desired_width(width);
                let response = ui.add(edit).accessible_name("Filter");
                let help = "Shows rows that hold all these words (Ctrl+F); Enter selects all that are found";
                let response = response.on_hover_text(help);
                if response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter)) {
                    self.select_found(context);
                }
                if std::mem::take(&mut self.wants_filter) {
                    response.request_focus();
                }
                if !self.filter.is_empty() && ui.small_button("×").on_hover_text("Clear the filter").clicked()
                {
                    self.filter.clear();
                }
            });
        });
    }

    /// Selects all that the filter lets through.
    fn select_found(&mut self, context: &AppContext<'_>) {
        let (Some(shown), false) = (context.shown, self.filter.trim().is_empty()) else { return };
        self.refresh(shown);
        let keys: Vec<NodeKey> = self.known.rows.iter().filter_map(Row::key).collect();
        self.scrolled_to = keys.last().copied();
        context.outbox.act(Action::Select(keys));
    }

    fn refresh(&mut self, shown: &Shown) {
        let of = (shown.revision, self.filter.clone(), self.closed.clone(), self.open_named.clone());
        if self.known.of.as_ref() != Some(&of) {
            self.known.rows = collect(&shown.scene, &self.filter, &self.closed, &self.open_named);
            self.known.of = Some(of);
        }
    }

    /// The row of a selection made elsewhere.
    fn row_to_scroll_to(&mut self, rows: &[Row], context: &AppContext<'_>) -> Option<usize> {
        let primary = context.session.selection().primary();
        if primary == self.scrolled_to {
            return None;
        }
        self.scrolled_to = primary;
        rows.iter().position(|row| row.key().is_some() && row.key() == primary)
    }

    /// All rows between two keys, in the order of the tree.
    fn range(rows: &[Row], from: NodeKey, to: NodeKey) -> Vec<NodeKey> {
        let place = |key| rows.iter().position(|row| row.key() == Some(key));
        let (Some(a), Some(b)) = (place(from), place(to)) else { return vec![to] };
        let mut keys: Vec<NodeKey> =
            rows.get(a.min(b)..=a.max(b)).unwrap_or_default().iter().filter_map(Row::key).collect();
        if b < a {
            keys.reverse();
        }
        keys
    }

    fn click(&mut self, ui: &Ui, context: &AppContext<'_>, rows: &[Row], key: NodeKey) {
        let modifiers = ui.input(|input| input.modifiers);
        // the row is in sight already
        self.scrolled_to = Some(key);
        match self.anchor.filter(|_| modifiers.shift) {
            Some(anchor) => {
                let keys = Self::range(rows, anchor, key);
                self.scrolled_to = keys.last().copied();
                context.outbox.act(if modifiers.command {
                    Action::AddToSelection(keys)
                } else {
                    Action::Select(keys)
                });
            }
            None => {
                self.anchor = Some(key);
                context.outbox.act(if modifiers.command {
                    Action::ToggleSelected(key)
                } else {
                    Action::Select(vec![key])
                });
            }
        }
    }

    /// The field that takes the place of a name while it is typed.
    fn rename_field(&mut self, ui: &mut Ui, context: &AppContext<'_>, shown: &Shown) {
        let Some(renaming) = &mut self.renaming else { return };
        let edit = TextEdit::singleline(&mut renaming.text)
            .hint_text("Name")
            .desired_width(ui.available_width() - 46.0)
            .margin(egui::Margin::symmetric(4, 0));
        let response = ui.add(edit).accessible_name("New name");
        if !std::mem::replace(&mut renaming.started, true) {
            response.request_focus();
        }
        if response.lost_focus() {
            let cancelled = ui.input(|input| input.key_pressed(egui::Key::Escape));
            let text = match renaming.what {
                Renamed::Item(_) => renaming.text.trim(),
                // Names of groups inside others are parted by these, and none is empty.
                Renamed::Group(_) => renaming.text.trim_matches(|c: char| c == '/' || c.is_whitespace()),
            };
            let action = rename_action(context, shown, &renaming.what, text).filter(|_| !cancelled);
            if let (Some(action), Renamed::Group(_)) = (&action, &renaming.what) {
                // It stays open under its new name.
                self.open_named.insert(text.to_owned());
                context.outbox.act(action.clone());
            } else if let Some(action) = action {
                context.outbox.act(action);
            }
            self.renaming = None;
        }
    }
}

fn rename_action(context: &AppContext<'_>, shown: &Shown, what: &Renamed, text: &str) -> Option<Action> {
    match what {
        Renamed::Item(key) => {
            let edit = rename_edit(shown, *key, (!text.is_empty()).then(|| text.to_owned()))?;
            Some(Action::Edit { edit, gesture: None })
        }
        Renamed::Group(path) if text.is_empty() || text == path => None,
        Renamed::Group(path) => {
            let given = context.session.given(Eye::default())?;
            Some(Action::Apply(design::rename_group(&given, path, text)))
        }
    }
}

fn rename_edit(shown: &Shown, key: NodeKey, name: Option<String>) -> Option<Edit> {
    if let Some(body) = shown.body(key) {
        return (body.name != name).then_some(Edit::Body { key, change: BodyChange::Name(name) });
    }
    let force = shown.force(key)?;
    (force.name != name).then_some(Edit::Force { key, change: ForceChange::Name(name) })
}

/// Double click on a row.
fn look_at(context: &AppContext<'_>, key: NodeKey) {
    context.outbox.send(Message::Frame(vec![key]));
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

    use glam::DVec3;

    use super::rows::counted;
    use super::*;
    use crate::scene::{Body, Document, Motion, NumberStyle, Shape};

    /// Symptom: `Moving bodies 0` over a scene whose balls all stood in groups.
    #[test]
    fn headings_count_what_stands_in_groups_too() {
        let document = Document::new(NumberStyle::Point);
        let ball = |id: i64, group: Option<&str>| {
            let motion = Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO };
            let mut body = Body::new(id, DVec3::ONE, motion, Shape::Sphere { radius: 0.1 });
            body.group = group.map(str::to_owned);
            Edit::AddBody(Box::new(body))
        };
        let edits = vec![ball(1, Some("rack")), ball(2, Some("rack")), ball(3, None)];
        let document = document.apply(&Edit::All(edits)).unwrap().document;
        let heading = |filter: &str| {
            let rows = collect(document.scene().unwrap(), filter, &[], &BTreeSet::new());
            let heading = rows.iter().find_map(|row| match row {
                Row::Group { group: Group::Dynamic, count, shown, grouped, .. } => {
                    Some(counted(*count, *shown, *grouped))
                }
                _ => None,
            });
            heading.unwrap()
        };
        assert_eq!(heading(""), "3, 2 in groups");
        assert_eq!(heading("rack"), "2 of 3");
    }
}
