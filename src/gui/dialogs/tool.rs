//! Asks what a tool needs to know, in place beside the views, and says beforehand what it will do.

use egui::{
    Align, Button, ComboBox, Context, DragValue, Grid, Id, Key, Layout, Modifiers, RichText, Ui, vec2,
};

use crate::design::{self, Extent, Eye, Given, Input, Kind, Plan, TOOLS, Tool, TroubleKind};
use crate::editor::{Action, parse_number};
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::gui::numbers::{count, significant};
use crate::scene::{Edit, NodeKey, Scene};

/// Most new bodies whose overlaps are looked for while typing.
const MOST_CHECKED: usize = 5000;

/// Digits shown of a value that has more.
const DIGITS: usize = 8;

pub struct ToolDialog {
    tool: &'static Tool,
    eye: Eye,
    /// One for each input; `None` until the scene was seen.
    values: Option<Vec<f64>>,
    /// Whether a person has said where a part goes; until then it goes where it is free.
    is_placed: bool,
    /// What the free place was looked for with last.
    placed_for: Option<Asked>,
    /// What was asked and what came out, until either changes.
    preview: Option<(Asked, Result<Preview, String>)>,
    /// Whether a field had the keyboard at the end of the last turn.
    was_typing: bool,
    /// Previews made, which number them.
    previews: u64,
}

/// What a preview depends on.
type Asked = (u64, u64, Vec<NodeKey>, Vec<u64>);

fn asked(context: &AppContext<'_>, given: &Given<'_>, values: &[f64]) -> Asked {
    let session = context.session;
    let bits = values.iter().map(|value| value.to_bits()).collect();
    (session.opened_count(), session.document_state(), given.keys.to_vec(), bits)
}

struct Preview {
    plan: Plan,
    text: String,
    warning: Option<String>,
    /// The scene as it would be, for the views.
    shown: Option<Shown>,
}

impl ToolDialog {
    /// `None` for a tool that does not exist.
    pub fn new(index: usize, eye: Eye) -> Option<Self> {
        Some(Self {
            tool: TOOLS.get(index)?,
            eye,
            values: None,
            is_placed: false,
            placed_for: None,
            preview: None,
            was_typing: false,
            previews: 0,
        })
    }

    /// The scene as it would be with what is asked for.
    pub fn preview(&self) -> Option<&Shown> {
        let (_, preview) = self.preview.as_ref()?;
        preview.as_ref().ok()?.shown.as_ref()
    }

    /// Whether it is done with.
    pub fn show(&mut self, ctx: &Context, context: &AppContext<'_>) -> bool {
        let Some(given) = context.session.given(self.eye) else { return true };
        let mut values = self.values.take().unwrap_or_else(|| self.tool.defaults(&given));
        let mut open = true;
        let mut decided = None;
        let title = self.tool.label.trim_end_matches('…');
        egui::Window::new(title)
            .id(Id::unique("tool"))
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            // over the tree's lower part, so that the views show what it does
            .default_pos(ctx.content_rect().left_top() + vec2(12.0, 250.0))
            .show(ctx, |ui| {
                ui.set_width(320.0);
                ui.label(RichText::new(self.tool.help).color(tones(ui).weak));
                ui.add_space(6.0);
                Grid::new("tool values").num_columns(3).spacing([8.0, 4.0]).show(ui, |ui| {
                    for (at, input) in self.tool.inputs.iter().enumerate() {
                        let Some(value) = values.get_mut(at) else { continue };
                        let before = *value;
                        field(ui, input, value);
                        if *value != before {
                            self.is_placed |= design::is_place(input.label);
                            self.tool.follow.iter().for_each(|follow| follow(&mut values, at));
                        }
                    }
                });
                ui.add_space(6.0);
                self.place(context, &given, &mut values);
                self.refresh(context, &given, &values);
                let plan = self.outcome(ui);
                ui.add_space(6.0);
                decided = self.buttons(ui, plan.as_ref());
                if let (Some(true), Some(plan)) = (decided, plan) {
                    context.outbox.act(Action::Apply(plan));
                }
            });
        self.was_typing = ctx.text_edit_focused();
        self.values = Some(values);
        !open || decided.is_some()
    }

    /// Looks for a free place, until a person says where the part goes.
    fn place(&mut self, context: &AppContext<'_>, given: &Given<'_>, values: &mut Vec<f64>) {
        if self.is_placed || self.placed_for.as_ref() == Some(&asked(context, given, values)) {
            return;
        }
        for (input, value) in self.tool.inputs.iter().zip(values.iter_mut()) {
            if design::is_place(input.label) {
                *value = (input.default)(given);
            }
        }
        *values = design::free_place(self.tool, given, values);
        self.placed_for = Some(asked(context, given, values));
    }

    /// Makes the plan again if what it depends on has changed.
    fn refresh(&mut self, context: &AppContext<'_>, given: &Given<'_>, values: &[f64]) {
        let asked = asked(context, given, values);
        if self.preview.as_ref().is_none_or(|(of, _)| *of != asked) {
            self.previews += 1;
            let revision = u64::MAX - self.previews;
            let preview = self.tool.plan(given, values).map(|plan| preview(context, given, plan, revision));
            self.preview = Some((asked, preview));
        }
    }

    /// What will come of it, or why nothing can.
    fn outcome(&self, ui: &mut Ui) -> Option<Plan> {
        let tones = tones(ui);
        match self.preview.as_ref().map(|(_, preview)| preview) {
            Some(Ok(preview)) => {
                ui.label(&preview.text);
                if let Some(warning) = &preview.warning {
                    ui.label(RichText::new(warning).color(tones.warning));
                }
                Some(preview.plan.clone())
            }
            Some(Err(reason)) => {
                ui.label(RichText::new(reason).color(tones.error));
                None
            }
            None => None,
        }
    }

    /// `true` to go ahead, `false` to leave it.
    fn buttons(&self, ui: &mut Ui, plan: Option<&Plan>) -> Option<bool> {
        let mut decided = None;
        let verb = if plan.is_some_and(|plan| plan.added() == 0) { "Apply" } else { "Create" };
        let row = vec2(ui.available_width(), 24.0);
        ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
            let button = Button::new(verb).fill(ui.visuals().selection.bg_fill).min_size(vec2(76.0, 24.0));
            let go = ui.add_enabled(plan.is_some(), button);
            if go.on_hover_text("Enter, or Ctrl+Enter while typing").clicked() {
                decided = Some(true);
            }
            let cancel = ui.add(Button::new("Cancel").min_size(vec2(76.0, 24.0)));
            if cancel.on_hover_text("Escape").clicked() {
                decided = Some(false);
            }
        });
        let idle = !self.was_typing && ui.memory(|memory| memory.focused().is_none());
        let (enter, at_once, escape) = ui.input_mut(|input| {
            let at_once = input.consume_key(Modifiers::COMMAND, Key::Enter);
            (input.key_pressed(Key::Enter), at_once, input.key_pressed(Key::Escape))
        });
        if (at_once || (enter && idle)) && plan.is_some() {
            decided = Some(true);
        } else if escape && !self.was_typing {
            decided = Some(false);
        }
        decided
    }
}

/// One row: what it is, its value, its unit.
fn field(ui: &mut Ui, input: &Input, value: &mut f64) {
    ui.label(input.label).on_hover_text(input.help);
    let response = match input.kind {
        Kind::Number(low, high) => {
            let speed = 0.01 * value.abs().max(1e-3 * high.min(1.0));
            number(ui, value, speed, (low, high), false)
        }
        Kind::Whole(low, high) => number(ui, value, 0.1, (low, high), true),
        Kind::Choice(choices) => {
            let mut chosen = (*value as usize).min(choices.len().saturating_sub(1));
            let shown = choices.get(chosen).copied().unwrap_or_default();
            let combo = ComboBox::from_id_salt(input.label).selected_text(shown).width(130.0);
            let response = combo.show_ui(ui, |ui| {
                for (index, choice) in choices.iter().enumerate() {
                    ui.selectable_value(&mut chosen, index, *choice);
                }
            });
            *value = chosen as f64;
            response.response
        }
        Kind::Flag => {
            let mut on = *value != 0.0;
            let response = ui.checkbox(&mut on, "");
            *value = f64::from(u8::from(on));
            response
        }
    };
    response.accessible_name(input.label).on_hover_text(input.help);
    ui.label(RichText::new(input.unit).color(tones(ui).weak));
    ui.end_row();
}

/// Drags stop at the range; what is typed outside of it is refused by the tool, in words.
fn number(ui: &mut Ui, value: &mut f64, speed: f64, range: (f64, f64), whole: bool) -> egui::Response {
    let before = *value;
    let widget = DragValue::new(value)
        .speed(speed)
        .min_decimals(0)
        .max_decimals(if whole { 0 } else { 9 })
        .update_while_editing(false)
        .min_size(vec2(130.0, 20.0))
        .custom_formatter(|value, _| significant(value, DIGITS))
        .custom_parser(parse_number);
    let response = ui.add(widget);
    if response.dragged() {
        let dragged = value.clamp(range.0, range.1);
        *value = if whole { dragged.round() } else { dragged };
        if !value.is_finite() {
            *value = before;
        }
    }
    response
}

fn preview(context: &AppContext<'_>, given: &Given<'_>, plan: Plan, revision: u64) -> Preview {
    let added = plan.added();
    let changed = plan.edits.len();
    let mut text = match (added, changed) {
        (0, 0) => "Nothing would change".to_owned(),
        (0, 1) => "Changes 1 object".to_owned(),
        (0, _) => format!("Changes {} objects", count(changed as u64)),
        (1, _) => "Adds 1 object".to_owned(),
        _ => format!("Adds {} objects", count(added as u64)),
    };
    let mut warning = plan.remark.clone();
    let shown = (added + changed <= MOST_CHECKED && changed > 0)
        .then(|| context.session.document().apply(&Edit::All(plan.edits.clone())).ok())
        .flatten()
        .and_then(|after| after.document.scene_shared())
        .map(|after| Shown::new(after, revision));
    if let Some(after) = &shown {
        text.push_str(&size_of_new(given.scene, &after.scene));
        let more = overlaps(&after.scene).saturating_sub(overlaps(given.scene));
        if more > 0 {
            let pairs = if more == 1 { "pair" } else { "pairs" };
            warning = Some(format!("{more} more {pairs} of bodies would overlap"));
        }
    }
    Preview { plan, text, warning, shown }
}

/// Size of the box around what was added.
fn size_of_new(before: &Scene, after: &Scene) -> String {
    let old: std::collections::BTreeSet<NodeKey> = before.bodies.iter().map(|body| body.key).collect();
    let new = after.bodies.iter().filter(|body| !old.contains(&body.key));
    let Some(extent) = Extent::around(new) else { return String::new() };
    let [x, y, z] = extent.size().to_array().map(|side| significant(side, 4));
    format!(", together {x} × {y} × {z} m")
}

fn overlaps(scene: &Scene) -> usize {
    design::troubles(scene).iter().filter(|trouble| trouble.kind == TroubleKind::Overlap).count()
}
