//! Rows of the tree that are dragged: between others, into groups, and out of them.

use egui::{Align2, DragAndDrop, FontId, Id, LayerId, Order, Rect, Response, Stroke, StrokeKind, Ui, vec2};

use super::Tree;
use crate::design::{self, Eye, Given, Plan};
use crate::editor::Action;
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::scene::{Edit, NodeKey, Side};

/// What is being dragged.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Dragged {
    Things(Vec<NodeKey>),
    /// A group with all that is in it, by its path.
    Group(String),
}

/// Where something that is dropped here goes.
pub(super) enum Target {
    /// `None` is outside of all groups.
    Group(Option<String>),
    /// Before or after a row, and into its group.
    Beside { key: NodeKey, side: Side, group: Option<String> },
    /// Before or after a group, for another group.
    BesideGroup { path: String, side: Side },
}

impl Dragged {
    /// The selection, if this is in it, else this alone.
    pub fn of(context: &AppContext<'_>, key: NodeKey) -> Self {
        let selection = context.session.selection();
        Self::Things(if selection.contains(key) { selection.keys().to_vec() } else { vec![key] })
    }

    /// What dropping it does; `None` where it would change nothing, or put a group into itself.
    fn plan(&self, context: &AppContext<'_>, target: &Target) -> Option<Plan> {
        let scene = context.scene()?;
        let given = |keys| Given { scene, keys, eye: Eye::default() };
        let plan = match (self, target) {
            (Self::Things(keys), Target::Group(group)) => design::regroup(&given(keys), group.as_deref()),
            (Self::Things(keys), Target::Beside { key, side, .. }) => {
                design::put_beside(&given(keys), *side, *key)
            }
            (Self::Things(keys), Target::BesideGroup { path, .. }) => {
                design::regroup(&given(keys), Some(path))
            }
            (Self::Group(from), Target::BesideGroup { path, side }) => {
                design::put_group_beside(&given(&[]), from, *side, path)
            }
            (Self::Group(path), _) => {
                let group = target.group();
                let inside = group.and_then(|to| to.strip_prefix(path.as_str()));
                if inside.is_some_and(|rest| rest.is_empty() || rest.starts_with('/')) {
                    return None;
                }
                let name = path.rsplit('/').next().unwrap_or_default();
                let to = group.map_or(name.to_owned(), |group| format!("{group}/{name}"));
                if to == *path {
                    return None;
                }
                design::rename_group(&given(&[]), path, &to)
            }
        };
        (!plan.edits.is_empty()).then_some(plan)
    }
}

impl Target {
    /// Beside a body or force: before it over the upper half of its row, else after it.
    pub fn beside(ui: &Ui, shown: &Shown, key: NodeKey, row: Rect) -> Self {
        let body = shown.body(key).and_then(|body| body.group.clone());
        let group = body.or_else(|| shown.force(key).and_then(|force| force.group.clone()));
        let at = ui.input(|input| input.pointer.interact_pos());
        let side = if at.is_some_and(|at| at.y < row.center().y) { Side::Before } else { Side::After };
        Self::Beside { key, side, group }
    }

    /// A group's row: a group that is dragged goes before or after it at its edges; all else goes into it.
    pub fn of_group(ui: &Ui, path: &str, row: Rect) -> Self {
        const EDGE: f32 = 0.3;
        let is_group = DragAndDrop::payload::<Dragged>(ui.ctx())
            .is_some_and(|dragged| matches!(*dragged, Dragged::Group(_)));
        let at = ui.input(|input| input.pointer.interact_pos()).filter(|_| is_group);
        let side = at.and_then(|at| match (at.y - row.top()) / row.height() {
            share if share < EDGE => Some(Side::Before),
            share if share > 1.0 - EDGE => Some(Side::After),
            _ => None,
        });
        match side {
            Some(side) => Self::BesideGroup { path: path.to_owned(), side },
            None => Self::Group(Some(path.to_owned())),
        }
    }

    fn group(&self) -> Option<&str> {
        match self {
            Self::BesideGroup { path, .. } => path.rsplit_once('/').map(|(parent, _)| parent),
            Self::Group(group) | Self::Beside { group, .. } => group.as_deref(),
        }
    }

    /// Shows on a row where the edits of a drop put things: a line between rows, or a frame around the row whose group
    /// they go into.
    fn show(&self, ui: &Ui, row: Rect, edits: &[Edit]) {
        let is_order = |edit: &Edit| matches!(edit, Edit::Reorder { .. });
        let pen = Stroke::new(1.5, tones(ui).accent);
        match self {
            Self::Beside { side, .. } | Self::BesideGroup { side, .. } if edits.iter().any(is_order) => {
                let y = if *side == Side::Before { row.top() } else { row.bottom() };
                ui.painter().hline(row.x_range(), y, Stroke::new(2.5, pen.color));
            }
            _ => drop(ui.painter().rect_stroke(row, 2.0, pen, StrokeKind::Inside)),
        }
        if !edits.iter().all(is_order) {
            let group = self.group();
            tell_beside_pointer(
                ui,
                &group.map_or("out of its group".to_owned(), |group| format!("into {group}")),
            );
        }
    }
}

impl Tree {
    /// Shows what a drop on this row would do, and does it.
    pub(super) fn take_drop(
        &mut self,
        ui: &Ui,
        context: &AppContext<'_>,
        response: &Response,
        target: &Target,
    ) {
        if let Some(dragged) = response.dnd_hover_payload::<Dragged>()
            && let Some(plan) = dragged.plan(context, target)
        {
            target.show(ui, response.rect, &plan.edits);
        }
        if let Some(dragged) = response.dnd_release_payload::<Dragged>()
            && let Some(plan) = dragged.plan(context, target)
        {
            self.open_named.extend(target.group().map(str::to_owned));
            context.outbox.act(Action::Apply(plan));
        }
    }
}

fn tell_beside_pointer(ui: &Ui, text: &str) {
    let Some(at) = ui.input(|input| input.pointer.hover_pos()) else { return };
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("dragged row")));
    let color = ui.visuals().text_color();
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), color);
    let place = Align2::LEFT_CENTER.anchor_size(at + vec2(16.0, 10.0), galley.size());
    painter.rect_filled(place.expand(4.0), 3.0, ui.visuals().window_fill);
    painter.galley(place.min, galley, color);
}
