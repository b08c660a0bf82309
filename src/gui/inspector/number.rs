//! A number to drag or type, with comma or point, as a fraction if need be; what it was is kept to the bit
//! unless another is typed.

use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use egui::{DragValue, Id, Key, Response, RichText, Ui, vec2};

use crate::design::{Formula, Instance};
use crate::editor::{Action, Gesture, Shared, Typed, allows, limits};
use crate::gui::context::{Message, Outbox};
use crate::gui::numbers::significant;
use crate::gui::widgets::mono;
use crate::scene::Edit;

/// Width of a number, points.
pub const WIDTH: f32 = 86.0;

/// Told where a formula draws random numbers.
const SEED: &str = "Drawn with seed 1 unless you gave one: rand(1, 2, 7) draws others";

/// Digits shown; all of them are shown while typing and in the tooltip.
const DIGITS: usize = 8;

pub struct Number<'a> {
    /// For screen readers and tests, such as `Position x`.
    pub name: &'a str,
    pub value: Shared,
    pub range: (f64, f64),
    /// Change per point of dragging.
    pub speed: f64,
    /// Points; [`WIDTH`] in lists.
    pub width: f32,
    pub help: &'a str,
    /// An angle in radians, which can be typed in degrees too.
    pub angle: bool,
    /// A count, which has no fractions.
    pub whole: bool,
}

/// Shows a number; a change is sent up as the edit that `edit` makes of it, or the reason why it makes none.
pub fn number(
    ui: &mut Ui,
    outbox: &Outbox,
    number: &Number<'_>,
    edit: impl FnOnce(&Typed) -> Result<Edit, String>,
) {
    let (value, mixed) = match number.value {
        Shared::None => return,
        Shared::Same(value) => (value, None),
        Shared::Mixed { smallest, largest } => (smallest, Some((smallest, largest))),
    };
    let (response, typed) = drag_value(ui, number, value, mixed.is_some());
    let gesture = Gesture(gesture_of(&response));
    match typed.map(|typed| typed.and_then(|typed| Ok((edit(&typed)?, typed)))) {
        Some(Ok((edit, typed))) => {
            let gesture = response.dragged().then_some(gesture);
            outbox.act(Action::Edit { edit, gesture });
            if matches!(&typed, Typed::Formula(formula) if formula.is_random()) {
                outbox.send(Message::Tell(SEED.to_owned()));
            }
        }
        Some(Err(reason)) => outbox.send(Message::Warn(reason)),
        None => {}
    }
    if response.drag_stopped() {
        outbox.act(Action::EndGesture);
    }
    tooltip(response, number, value, mixed);
}

/// The one value that was typed, where there are not many.
pub fn single(typed: &Typed, old: f64) -> Result<f64, String> {
    typed.value(Instance { old, index: 0, count: 1 }).ok_or_else(|| "That is no number".to_owned())
}

/// The widget, and what was typed or dragged, or why it is refused.
fn drag_value(
    ui: &mut Ui,
    number: &Number<'_>,
    value: f64,
    mixed: bool,
) -> (Response, Option<Result<Typed, String>>) {
    let id = ui.next_auto_id();
    let is_typing = ui.memory(|memory| memory.has_focus(id));
    let is_discarded = is_discarded(ui, id, is_typing);
    // drags stop at the range, typed values outside are refused instead
    let dragged = ui.ctx().is_being_dragged(id);
    let range = if dragged { number.range } else { (f64::NEG_INFINITY, f64::INFINITY) };
    let read = RefCell::new(None);
    let shown = match (mixed, is_typing) {
        (true, _) => "mixed".to_owned(),
        (false, true) => value.to_string(),
        (false, false) => significant(value, DIGITS),
    };
    let known = shown.clone();
    let mut edited = value;
    let widget = DragValue::new(&mut edited)
        .speed(if mixed { 0.0 } else { number.speed })
        .range(range.0..=range.1)
        .clamp_existing_to_range(false)
        .update_while_editing(false)
        .clip_text(true)
        .min_size(vec2(number.width, 20.0))
        .custom_formatter(move |now, _| if now == value { shown.clone() } else { significant(now, DIGITS) })
        .custom_parser(|text| {
            if is_discarded || text.trim() == known || text.trim() == value.to_string() {
                return Some(value);
            }
            match number.read(text) {
                Ok(Typed::Value(value)) => Some(value),
                other => {
                    *read.borrow_mut() = Some(other);
                    None
                }
            }
        });
    let response = ui.add(widget).accessible_name(number.name);
    let read = read.into_inner();
    let is_formula = matches!(read, Some(Ok(_)));
    if is_formula && !is_new(ui, id) {
        return (response, None);
    }
    // of values that differ, the one shown can be typed as well: then all become it
    let typed_same = mixed && response.changed();
    let typed = (edited != value || typed_same).then_some(Ok(Typed::Value(edited)));
    (response, read.or(typed))
}

/// Whether a formula is read for the first time. egui reads the text once more in the pass after the field has lost
/// its focus, and what sees the old value must not be worked out twice.
fn is_new(ui: &Ui, id: Id) -> bool {
    const PASSES: u64 = 3;
    let memory_id = id.with("formula");
    let now = ui.ctx().cumulative_pass_nr();
    let last = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or(memory_id, 0), now));
    last == 0 || now.saturating_sub(last) > PASSES
}

/// Whether typing was left with Escape. egui reads the text once more after the field has lost its focus,
/// in a pass that no longer sees the key, so it is remembered until somebody types here again.
fn is_discarded(ui: &Ui, id: Id, is_typing: bool) -> bool {
    let memory_id = id.with("discarded");
    let was_typing = ui.memory(|memory| memory.had_focus_last_frame(id));
    if was_typing && !is_typing && ui.input(|input| input.key_pressed(Key::Escape)) {
        ui.data_mut(|data| data.insert_temp(memory_id, true));
    } else if is_typing {
        ui.data_mut(|data| data.remove_temp::<bool>(memory_id));
    }
    ui.data(|data| data.get_temp(memory_id).unwrap_or(false))
}

impl Number<'_> {
    /// What was typed, or why it cannot be taken.
    fn read(&self, text: &str) -> Result<Typed, String> {
        let (text, name) = (text.trim(), self.name.to_lowercase());
        if text.is_empty() {
            return Err(format!("Nothing was typed: the {name} stays as it was"));
        }
        let tries = if self.angle { "0.5, pi/6 or 30°" } else { "0.5, 1/60 or 2*3" };
        let unusable = || format!("“{text}” is not a number that can be used: try {tries}");
        let formula = Formula::parse(text, self.angle).ok_or_else(unusable)?;
        if !formula.is_constant() {
            return Ok(Typed::Formula(formula));
        }
        let value = formula.value(Instance { old: 0.0, index: 0, count: 1 }).ok_or_else(unusable)?;
        if !allows(self.range, value) {
            let limits = limits(self.range).unwrap_or_default();
            return Err(format!("{text} is out of range: the {name} {limits}"));
        }
        if self.whole && value.fract() != 0.0 {
            return Err(format!("{text} is not a whole number: the {name} cannot be a fraction"));
        }
        Ok(Typed::Value(value))
    }
}

fn gesture_of(response: &Response) -> u64 {
    let mut hasher = DefaultHasher::new();
    response.id.hash(&mut hasher);
    hasher.finish()
}

fn tooltip(response: Response, number: &Number<'_>, value: f64, mixed: Option<(f64, f64)>) {
    if response.dragged() || response.has_focus() {
        return;
    }
    response.on_hover_ui(|ui| {
        ui.label(RichText::new(number.name).strong());
        match mixed {
            Some((smallest, largest)) => {
                ui.label(mono(format!("from {smallest} to {largest}")));
            }
            None => drop(ui.label(mono(value.to_string()))),
        }
        if !number.help.is_empty() {
            ui.label(number.help);
        }
        let range = limits(number.range).map_or(String::new(), |limits| format!("It {limits}. "));
        let angles = if number.angle { " or pi/6 or 30°" } else { "" };
        let text = format!(
            "{range}Drag, or click and type: 0.5 or 0,5 or 1/60 or sqrt(2){angles}. From the old value x: *2, += 0.1; of \
             many, also by their number i from 0: =x+0.5*i, rand(1,2)."
        );
        ui.label(RichText::new(text).weak());
    });
}
