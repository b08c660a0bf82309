//! The rows of the tree: which there are, and what each looks like.

use std::collections::BTreeSet;

use egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::dropping::{Dragged, Target};
use super::named::{self, Named};
use super::signs::{Chip, paint_contact};
use super::{Renamed, Tree, look_at};
use crate::editor::{self, Action, Command, Place, SessionCommand, ViewCommand, WindowCommand};
use crate::gui::colors::{color32, tones};
use crate::gui::context::{AppContext, Message, Shown};
use crate::gui::theme::ROW_HEIGHT;
use crate::gui::{icons, menu, numbers, widgets};
use crate::scene::{Body, BodyChange, Edit, Force, ForceChange, ForceKind, NodeKey, Scene, Shape};
use crate::sim::ContactState;

/// Points that a group shifts what is in it.
pub(super) const INDENT: f32 = 12.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Forces,
    Dynamic,
    Static,
}

impl Group {
    fn label(self) -> &'static str {
        match self {
            Self::Forces => "Forces",
            Self::Dynamic => "Moving bodies",
            Self::Static => "Static bodies",
        }
    }
}

pub enum Row {
    Place(Place),
    Group {
        group: Group,
        /// How many there are, those in named groups included.
        count: usize,
        /// Of those, how many the filter lets through.
        shown: usize,
        /// Of all, how many stand in named groups.
        grouped: usize,
        open: bool,
    },
    /// Apart: there are few of them, and many bodies.
    Named(Box<Named>),
    /// How deep in groups it stands.
    Body {
        index: usize,
        key: NodeKey,
        depth: usize,
    },
    Force {
        index: usize,
        key: NodeKey,
        depth: usize,
    },
}

impl Row {
    pub fn key(&self) -> Option<NodeKey> {
        match self {
            Self::Body { key, .. } | Self::Force { key, .. } => Some(*key),
            Self::Place(_) | Self::Group { .. } | Self::Named(_) => None,
        }
    }

    /// The row of a body or force at another depth.
    pub fn at_depth(&self, depth: usize) -> Self {
        match *self {
            Self::Force { index, key, .. } => Self::Force { index, key, depth },
            Self::Body { index, key, .. } => Self::Body { index, key, depth },
            Self::Place(place) => Self::Place(place),
            Self::Group { group, count, shown, grouped, open } => {
                Self::Group { group, count, shown, grouped, open }
            }
            Self::Named(ref named) => Self::Named(named.clone()),
        }
    }
}

/// All rows that the filter lets through: what has a group stands there, all else by its kind.
pub fn collect(scene: &Scene, filter: &str, closed: &[Group], open_named: &BTreeSet<String>) -> Vec<Row> {
    let words: Vec<String> = filter.split_whitespace().map(str::to_lowercase).collect();
    let mut rows = Vec::new();
    if words.is_empty() {
        rows.extend([Row::Place(Place::Map), Row::Place(Place::Simulation)]);
    }
    let is_found = |group: &Option<String>, texts: &[&str]| {
        words.is_empty() || matches(&words, &[texts, &[group.as_deref().unwrap_or_default()]].concat())
    };
    let force_found =
        |force: &Force| is_found(&force.group, &[force.display_name(), &force.label, force_kind(force)]);
    let body_found =
        |body: &Body| is_found(&body.group, &[body.display_name(), &body.label, body_kind(body)]);
    let in_groups: BTreeSet<NodeKey> = {
        let forces = scene.forces.iter().filter(|force| force.group.is_some() && force_found(force));
        let bodies = scene.bodies.iter().filter(|body| body.group.is_some() && body_found(body));
        forces.map(|force| force.key).chain(bodies.map(|body| body.key)).collect()
    };
    let found = named::collect(scene, &|key| in_groups.contains(&key), !words.is_empty(), open_named);
    rows.extend(found);
    let of_forces = scene.forces.iter().enumerate().map(|(index, force)| {
        let row = Row::Force { index, key: force.key, depth: 0 };
        (row, force.group.is_some(), force_found(force))
    });
    add_group(&mut rows, Group::Forces, of_forces, &words, closed);
    for (group, dynamic) in [(Group::Dynamic, true), (Group::Static, false)] {
        let bodies = scene.bodies.iter().enumerate().filter(|(_, body)| body.is_dynamic() == dynamic);
        let of_bodies = bodies.map(|(index, body)| {
            let row = Row::Body { index, key: body.key, depth: 0 };
            (row, body.group.is_some(), body_found(body))
        });
        add_group(&mut rows, group, of_bodies, &words, closed);
    }
    rows
}

/// A heading and what stands under it, of all of a kind: each with its row, whether it stands in a named group instead, and
/// whether the filter finds it. The heading counts those in groups too.
fn add_group(
    rows: &mut Vec<Row>,
    group: Group,
    all: impl Iterator<Item = (Row, bool, bool)>,
    words: &[String],
    closed: &[Group],
) {
    // a filter shows what it finds, also in groups that are closed
    let open = !words.is_empty() || !closed.contains(&group);
    let heading = rows.len();
    rows.push(Row::Group { group, count: 0, shown: 0, grouped: 0, open });
    let (mut count, mut shown, mut grouped) = (0, 0, 0);
    for (row, is_grouped, is_found) in all {
        count += 1;
        grouped += usize::from(is_grouped);
        shown += usize::from(is_found);
        if open && is_found && !is_grouped {
            rows.push(row);
        }
    }
    rows[heading] = Row::Group { group, count, shown, grouped, open };
}

fn matches(words: &[String], texts: &[&str]) -> bool {
    words.iter().all(|word| texts.iter().any(|text| text.to_lowercase().contains(word.as_str())))
}

pub fn body_kind(body: &Body) -> &'static str {
    match body.shape {
        Shape::Sphere { .. } => "sphere",
        Shape::Plane { .. } => "plane",
        Shape::Unbuilt { .. } => "not simulated",
    }
}

pub fn force_kind(force: &Force) -> &'static str {
    match force.kind {
        ForceKind::GravityPlane { .. } => "uniform gravity",
        ForceKind::GravityPoint { .. } => "point gravity",
        ForceKind::Drag { .. } => "air drag",
    }
}

impl Tree {
    pub(super) fn show_row(
        &mut self,
        ui: &mut Ui,
        context: &AppContext<'_>,
        shown: &Shown,
        rows: &[Row],
        row: &Row,
    ) {
        match row {
            Row::Place(place) => place_row(ui, context, *place),
            Row::Group { group, count, shown, grouped, open } => {
                let response = group_row(ui, *group, &counted(*count, *shown, *grouped), *open);
                self.take_drop(ui, context, &response, &Target::Group(None));
                if response.clicked() {
                    match self.closed.iter().position(|closed| closed == group) {
                        Some(index) => drop(self.closed.remove(index)),
                        None => self.closed.push(*group),
                    }
                }
            }
            Row::Named(named) => self.named_row(ui, context, shown, named),
            Row::Body { index, key, depth } => {
                if let Some(body) = shown.scene.bodies.get(*index) {
                    let detail = body_detail(body);
                    let marks = Marks { hidden: body.hidden, locked: body.locked };
                    let chip = Chip::of(body);
                    let looks =
                        Looks { name: body.display_name(), detail: &detail, chip, marks, depth: *depth };
                    self.item_row(ui, context, shown, rows, *key, &looks);
                }
            }
            Row::Force { index, key, depth } => {
                if let Some(force) = shown.scene.forces.get(*index) {
                    let marks = Marks { hidden: force.hidden, locked: force.locked };
                    let looks = Looks {
                        name: force.display_name(),
                        detail: force_kind(force),
                        chip: Chip::Diamond,
                        marks,
                        depth: *depth,
                    };
                    self.item_row(ui, context, shown, rows, *key, &looks);
                }
            }
        }
    }

    fn item_row(
        &mut self,
        ui: &mut Ui,
        context: &AppContext<'_>,
        shown: &Shown,
        rows: &[Row],
        key: NodeKey,
        looks: &Looks<'_>,
    ) {
        let selected = context.session.selection().contains(key);
        let (rect, response) = row_space(ui, selected, looks.name);
        let indent = INDENT * looks.depth as f32;
        let faded = looks.marks.faded();
        if let Some(color) = shown.color(key, context.palette()) {
            looks.chip.paint(
                ui,
                pos2(rect.left() + indent + 28.0, rect.center().y),
                color32(color).gamma_multiply(faded),
            );
        }
        let contact = self.contacts.of(key);
        paint_contact(ui, context, pos2(rect.left() + indent + 12.0, rect.center().y), contact);
        let name_rect = Rect::from_min_max(pos2(rect.left() + indent + 40.0, rect.top()), rect.max);
        if self.is_renaming(&Renamed::Item(key)) {
            let builder = egui::UiBuilder::new().max_rect(name_rect);
            ui.scope_builder(builder, |ui| {
                ui.horizontal_centered(|ui| self.rename_field(ui, context, shown));
            });
        } else {
            draw_name(ui, name_rect, looks, selected);
        }
        let marked = Marked {
            id: ui.scope_id().with(("mark", key)),
            name: looks.name,
            marks: looks.marks,
            helps: ["in the views; it always takes part in the simulation", "against moving and deleting"],
        };
        if let Some(mark) = mark_buttons(ui, rect, &marked, response.contains_pointer()) {
            context.outbox.act(Action::Edit { edit: mark_edit(shown, key, mark), gesture: None });
        }
        response.context_menu(|ui| context_menu(ui, context));
        response.dnd_set_drag_payload(Dragged::of(context, key));
        self.take_drop(ui, context, &response, &Target::beside(ui, shown, key, rect));
        if contact != ContactState::Flight {
            let (state, meaning) = (contact.name(), contact.meaning());
            response.clone().on_hover_text(format!("{}, {state}: {meaning}", looks.name));
        }
        if response.clicked() {
            self.click(ui, context, rows, key);
        }
        if response.secondary_clicked() && !selected {
            self.click(ui, context, rows, key);
        }
        if response.double_clicked() {
            if response.interact_pointer_pos().is_some_and(|at| at.x > rect.left() + indent + 38.0) {
                context.outbox.send(Message::Rename(key));
            } else {
                look_at(context, key);
            }
        }
    }
}

/// What a person set of a body, a force, or all of a group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marks {
    pub hidden: bool,
    pub locked: bool,
}

impl Marks {
    /// What is hidden is drawn at half strength.
    fn faded(self) -> f32 {
        if self.hidden { 0.5 } else { 1.0 }
    }
}

/// What a row shows.
pub(super) struct Looks<'a> {
    pub name: &'a str,
    pub detail: &'a str,
    pub chip: Chip,
    pub marks: Marks,
    pub depth: usize,
}

fn body_detail(body: &Body) -> String {
    match body.shape {
        Shape::Sphere { radius } => format!("r {} m", numbers::significant(radius, 4)),
        Shape::Plane { half_x, half_y } => {
            format!("{} × {} m", numbers::significant(2.0 * half_x, 4), numbers::significant(2.0 * half_y, 4))
        }
        Shape::Unbuilt { ref element } if element.is_empty() => "no shape".to_owned(),
        Shape::Unbuilt { ref element } => format!("{element}, not simulated"),
    }
}

pub(super) fn row_space(ui: &mut Ui, selected: bool, name: &str) -> (Rect, egui::Response) {
    let size = vec2(ui.available_width(), ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let visuals = ui.visuals();
    if selected {
        ui.painter().rect_filled(rect, 0.0, visuals.selection.bg_fill);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, 0.0, visuals.widgets.inactive.weak_bg_fill);
    }
    response.widget_info(|| WidgetInfo::selected(Role::TreeItem, true, selected, name));
    (rect, response)
}

pub(super) fn draw_name(ui: &Ui, rect: Rect, looks: &Looks<'_>, selected: bool) {
    let faded = looks.marks.faded();
    let painter = ui.painter_at(rect.with_max_x(rect.right() - 44.0));
    let color = if selected { ui.visuals().selection.stroke.color } else { ui.visuals().text_color() };
    let font = FontId::proportional(13.0);
    let at = pos2(rect.left(), rect.center().y);
    let drawn = painter.text(at, Align2::LEFT_CENTER, looks.name, font, color.gamma_multiply(faded));
    let weak = tones(ui).weak.gamma_multiply(faded);
    let at = pos2(drawn.right() + 8.0, at.y);
    painter.text(at, Align2::LEFT_CENTER, looks.detail, FontId::proportional(11.0), weak);
}

/// What eye and lock at the right of a row belong to.
pub(super) struct Marked<'a> {
    pub id: egui::Id,
    pub name: &'a str,
    pub marks: Marks,
    /// What follows the verb of the eye and of the lock in their tooltips.
    pub helps: [&'a str; 2],
}

/// A mark to set.
#[derive(Clone, Copy)]
pub(super) enum Mark {
    Hidden(bool),
    Locked(bool),
}

/// Eye and lock at the right: shown when they say something, or under the pointer. Gives what was clicked.
pub(super) fn mark_buttons(ui: &mut Ui, row: Rect, marked: &Marked<'_>, pointed: bool) -> Option<Mark> {
    let Marks { hidden, locked } = marked.marks;
    let [of_eye, of_lock] = marked.helps;
    let mut clicked = None;
    for (column, is_eye, on, help) in [(0.0, true, hidden, of_eye), (1.0, false, locked, of_lock)] {
        let center = pos2(row.right() - 13.0 - 19.0 * column, row.center().y);
        let rect = Rect::from_center_size(center, vec2(18.0, ROW_HEIGHT));
        let response = ui.interact(rect, marked.id.with(is_eye), Sense::click());
        let verb = match (is_eye, on) {
            (true, false) => "Hide",
            (true, true) => "Show",
            (false, false) => "Lock",
            (false, true) => "Unlock",
        };
        widgets::name_button(ui, &response, &format!("{verb} {}", marked.name), on);
        if pointed || on || response.hovered() || response.has_focus() {
            let color = if response.hovered() { tones(ui).strong } else { tones(ui).weak };
            let square = Rect::from_center_size(center, vec2(13.0, 13.0));
            if is_eye {
                icons::paint_eye(ui.painter(), square, color, on);
            } else {
                icons::paint_lock(ui.painter(), square, color, on);
            }
        }
        if response.on_hover_text(format!("{verb} {help}")).clicked() {
            clicked = Some(if is_eye { Mark::Hidden(!on) } else { Mark::Locked(!on) });
        }
    }
    clicked
}

pub(super) fn mark_edit(shown: &Shown, key: NodeKey, mark: Mark) -> Edit {
    let (of_body, of_force) = match mark {
        Mark::Hidden(on) => (BodyChange::Hidden(on), ForceChange::Hidden(on)),
        Mark::Locked(on) => (BodyChange::Locked(on), ForceChange::Locked(on)),
    };
    match shown.body(key) {
        Some(_) => Edit::Body { key, change: of_body },
        None => Edit::Force { key, change: of_force },
    }
}

fn place_row(ui: &mut Ui, context: &AppContext<'_>, place: Place) {
    let Some(scene) = context.scene() else { return };
    let (name, detail) = match place {
        Place::Map => {
            let [x, y, z] = scene.map.size.to_array().map(|side| numbers::significant(side, 4));
            ("Map", format!("{x} × {y} × {z} m"))
        }
        Place::Simulation => {
            ("Simulation", format!("time speed {}", numbers::significant(scene.time_speed, 4)))
        }
    };
    let selected = context.session.selection().place() == Some(place);
    let (rect, response) = row_space(ui, selected, name);
    let marks = Marks { hidden: false, locked: false };
    let looks = Looks { name, detail: &detail, chip: Chip::None, marks, depth: 0 };
    draw_name(ui, rect.with_min_x(rect.left() + 8.0).with_max_x(rect.right() + 44.0), &looks, selected);
    if response.clicked() {
        context.outbox.act(Action::SelectPlace(place));
    }
}

/// Before what opens and closes.
pub(super) fn triangle(ui: &Ui, center: egui::Pos2, open: bool) {
    let tip = if open { vec2(0.0, 3.5) } else { vec2(3.5, 0.0) };
    let side = if open { vec2(4.0, 0.0) } else { vec2(0.0, 4.0) };
    let corners = vec![center + tip, center - tip + side, center - tip - side];
    ui.painter().add(egui::Shape::convex_polygon(corners, tones(ui).weak, egui::Stroke::NONE));
}

/// Such as `15, 12 in groups`, or `3 of 15` under a filter.
pub(super) fn counted(count: usize, shown: usize, grouped: usize) -> String {
    let [count_text, shown_text, grouped_text] =
        [count, shown, grouped].map(|count| numbers::count(count as u64));
    if shown != count {
        format!("{shown_text} of {count_text}")
    } else if grouped > 0 {
        format!("{count_text}, {grouped_text} in groups")
    } else {
        count_text
    }
}

/// A click opens or closes it.
fn group_row(ui: &mut Ui, group: Group, count: &str, open: bool) -> egui::Response {
    let (rect, response) = row_space(ui, false, group.label());
    let tones = tones(ui);
    let center = pos2(rect.left() + 12.0, rect.center().y);
    triangle(ui, center, open);
    let at = pos2(rect.left() + 22.0, rect.center().y);
    let font = FontId::proportional(13.0);
    let drawn = ui.painter().text(at, Align2::LEFT_CENTER, group.label(), font, tones.strong);
    let at = pos2(drawn.right() + 8.0, at.y);
    ui.painter().text(at, Align2::LEFT_CENTER, count, FontId::proportional(11.0), tones.weak);
    response
}

pub(super) fn context_menu(ui: &mut Ui, context: &AppContext<'_>) {
    const COMMANDS: [Command; 13] = [
        Command::View(ViewCommand::FrameSelection),
        Command::Window(WindowCommand::Rename),
        Command::Session(SessionCommand::Cut),
        Command::Session(SessionCommand::Copy),
        Command::Session(SessionCommand::Paste),
        Command::Session(SessionCommand::Duplicate),
        Command::Session(SessionCommand::Delete),
        Command::Session(SessionCommand::Group),
        Command::Session(SessionCommand::Ungroup),
        Command::Session(SessionCommand::MoveUp),
        Command::Session(SessionCommand::MoveDown),
        Command::Session(SessionCommand::Hide),
        Command::Session(SessionCommand::Lock),
    ];
    ui.set_min_width(200.0);
    COMMANDS.iter().filter_map(|command| editor::info(*command)).for_each(|info| {
        menu::entry(ui, context, info);
    });
}
