//! Rows of the tree that are dragged onto others: into groups, and out of them.

use egui::{Align2, FontId, Id, LayerId, Order, Response, Stroke, StrokeKind, Ui, vec2};

use super::Tree;
use crate::design::{self, Eye, Given, Plan};
use crate::editor::Action;
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::scene::NodeKey;

/// What is being dragged.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Dragged {
    Things(Vec<NodeKey>),
    /// A group with all that is in it, by its path.
    Group(String),
}

/// The group that something dropped here goes into; `None` is outside of all groups.
pub(super) struct Target(pub Option<String>);

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
        let plan = match self {
            Self::Things(keys) => design::regroup(&given(keys), target.0.as_deref()),
            Self::Group(path) => {
                let inside = target.0.as_deref().and_then(|to| to.strip_prefix(path.as_str()));
                if inside.is_some_and(|rest| rest.is_empty() || rest.starts_with('/')) {
                    return None;
                }
                let name = path.rsplit('/').next().unwrap_or_default();
                let to = target.0.as_ref().map_or(name.to_owned(), |group| format!("{group}/{name}"));
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
    /// Where a body or force is.
    pub fn beside(shown: &Shown, key: NodeKey) -> Self {
        let body = shown.body(key).and_then(|body| body.group.clone());
        Self(body.or_else(|| shown.force(key).and_then(|force| force.group.clone())))
    }

    fn words(&self) -> String {
        self.0.as_ref().map_or("out of its group".to_owned(), |group| format!("into {group}"))
    }
}

impl Tree {
    /// Shows what a drop on this row would do, and does it.
    pub(super) fn take_drop(
        &mut self,
        ui: &Ui,
        context: &AppContext<'_>,
        response: &Response,
        target: Target,
    ) {
        if let Some(dragged) = response.dnd_hover_payload::<Dragged>()
            && dragged.plan(context, &target).is_some()
        {
            let pen = Stroke::new(1.5, tones(ui).accent);
            ui.painter().rect_stroke(response.rect, 2.0, pen, StrokeKind::Inside);
            tell_beside_pointer(ui, &target.words());
        }
        if let Some(dragged) = response.dnd_release_payload::<Dragged>()
            && let Some(plan) = dragged.plan(context, &target)
        {
            self.open_named.extend(target.0);
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
