//! The line above the rows that says which predicted impacts the event shown cancelled.

use std::fmt::Write as _;

use egui::{Label, RichText, Sense, Ui};

use super::columns::joined;
use crate::editor::Action;
use crate::gui::colors::tones;
use crate::gui::context::AppContext;
use crate::gui::numbers::{count, significant};
use crate::record::{Cancelled, CancelledImpact};
use crate::scene::NodeKey;

/// Impacts that are written out; of more the earliest.
const MOST: usize = 30;

/// Says it in one line, with one for each impact when pointed at; a click selects the bodies that were to meet.
pub(super) fn show(ui: &mut Ui, context: &AppContext<'_>) {
    let frame = context.session.frame();
    let weak = |text: String| RichText::new(text).small().color(tones(ui).weak);
    let Some(cancelled) = &frame.cancelled else {
        let text = if frame.seeks_cancelled {
            format!("Looking for what event {} cancelled…", frame.event_count)
        } else {
            "Go to an event to see which predicted impacts it cancelled".to_owned()
        };
        ui.add(Label::new(weak(text)).truncate());
        return;
    };
    let text = weak(line(context, cancelled));
    if cancelled.impacts.is_empty() {
        ui.add(Label::new(text).truncate());
        return;
    }
    let label = Label::new(text).truncate().sense(Sense::click()).show_tooltip_when_elided(false);
    let response = ui.add(label).on_hover_ui(|ui| {
        ui.label(format!("{}\nClick: select these bodies", lines(context, cancelled)));
    });
    if response.clicked() {
        let mut keys: Vec<NodeKey> = cancelled.impacts.iter().flat_map(|impact| impact.keys).collect();
        keys.sort_unstable();
        keys.dedup();
        context.outbox.act(Action::Select(keys));
    }
}

/// All in one line.
fn line(context: &AppContext<'_>, cancelled: &Cancelled) -> String {
    let event = cancelled.event;
    if let Some(problem) = &cancelled.problem {
        return format!("What event {event} cancelled cannot be told: {problem}");
    }
    if cancelled.impacts.is_empty() {
        return format!("Event {event} cancelled no predicted impact");
    }
    let shown: Vec<String> =
        cancelled.impacts.iter().take(MOST).map(|impact| described(context, impact)).collect();
    let plural = if cancelled.impacts.len() == 1 { "" } else { "s" };
    let number = count(cancelled.impacts.len() as u64);
    format!("Event {event} cancelled {number} predicted impact{plural}: {}", shown.join("; "))
}

/// Each in its own line.
fn lines(context: &AppContext<'_>, cancelled: &Cancelled) -> String {
    let mut text = "Predicted before this event, and no more after it. What is not predicted now may still come: bodies far off, and \
        ways that are integrated, are searched piece by piece."
        .to_owned();
    for impact in cancelled.impacts.iter().take(MOST) {
        let _ = write!(text, "\n{}", described(context, impact));
    }
    if let Some(more) = cancelled.impacts.len().checked_sub(MOST + 1) {
        let _ = write!(text, "\nand {} more", count(more as u64 + 1));
    }
    text
}

fn described(context: &AppContext<'_>, impact: &CancelledImpact) -> String {
    let name = |nth: usize| {
        let name = context.shown.and_then(|shown| shown.name(*impact.keys.get(nth)?));
        name.unwrap_or_else(|| impact.labels.get(nth).map_or("", |label| label))
    };
    let bodies = joined(name(0), name(1));
    let time = significant(impact.time, 7);
    match impact.now {
        Some(now) => format!("{bodies} at {time} s, now {} s", significant(now, 7)),
        None => format!("{bodies} at {time} s, not predicted now"),
    }
}
