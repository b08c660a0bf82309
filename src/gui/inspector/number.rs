//! A number to drag or type, with comma or point, as a fraction if need be; what it was is kept to the bit
//! unless another is typed.

use egui::{DragValue, Response, RichText, Ui, vec2};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use crate::editor::{Action, Gesture, Shared, parse_number};
use crate::gui::context::Outbox;
use crate::gui::numbers::significant;
use crate::gui::widgets::mono;
use crate::scene::Edit;

/// Width of a number, points.
pub const WIDTH: f32 = 92.0;

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
}

/// Shows a number; a change is sent up as the edit that `edit` makes of it.
pub fn number(ui: &mut Ui, outbox: &Outbox, number: &Number<'_>, edit: impl FnOnce(f64) -> Edit) {
    let (value, mixed) = match number.value {
        Shared::None => return,
        Shared::Same(value) => (value, None),
        Shared::Mixed { smallest, largest } => (smallest, Some((smallest, largest))),
    };
    let response = drag_value(ui, number, value, mixed.is_some());
    let (response, changed) = (response.0, response.1);
    let gesture = Gesture(gesture_of(&response));
    if let Some(value) = changed {
        let gesture = response.dragged().then_some(gesture);
        outbox.act(Action::Edit { edit: edit(value), gesture });
    }
    if response.drag_stopped() {
        outbox.act(Action::EndGesture);
    }
    tooltip(response, number, value, mixed);
}

/// The widget, and the value if it was changed.
fn drag_value(ui: &mut Ui, number: &Number<'_>, value: f64, mixed: bool) -> (Response, Option<f64>) {
    let is_typing = ui.memory(|memory| memory.has_focus(ui.next_auto_id()));
    let shown = match (mixed, is_typing) {
        (true, _) => "mixed".to_owned(),
        (false, true) => value.to_string(),
        (false, false) => significant(value, DIGITS),
    };
    let known = shown.clone();
    let mut edited = value;
    let widget = DragValue::new(&mut edited)
        .speed(if mixed { 0.0 } else { number.speed })
        .range(number.range.0..=number.range.1)
        .clamp_existing_to_range(false)
        .update_while_editing(false)
        .clip_text(true)
        .min_size(vec2(number.width, 20.0))
        .custom_formatter(move |now, _| if now == value { shown.clone() } else { significant(now, DIGITS) })
        .custom_parser(move |text| if text.trim() == known { Some(value) } else { parse_number(text) });
    let response = ui.add(widget).accessible_name(number.name);
    // of values that differ, the one shown can be typed as well: then all become it
    let typed_same = mixed && response.changed();
    (response, (edited != value || typed_same).then_some(edited))
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
        let range = match number.range {
            (low, high) if low.is_finite() && high.is_finite() => format!("Range: {low} to {high}. "),
            (low, _) if low > 0.0 => "Must be above 0. ".to_owned(),
            (0.0, _) => "Must not be negative. ".to_owned(),
            _ => String::new(),
        };
        ui.label(RichText::new(format!("{range}Drag, or click and type: 0.5 or 0,5 or 1/60.")).weak());
    });
}
