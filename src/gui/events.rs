//! The table of the last Δt's events. A click shows the place, a double click goes there.

use std::fmt::Write as _;
use std::sync::Arc;

use egui::{RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder, TableRow};

use super::colors::tones;
use super::context::{AppContext, Message};
use super::numbers::significant;
use super::theme::ROW_HEIGHT;
use super::widgets::{cell, mono};
use crate::editor::Action;
use crate::record::{EventRow, Frame};
use crate::sim::EventKind;

const TITLES: [(&str, &str); 8] = [
    ("#", "Number of the event since the start"),
    ("t [s]", "Model time"),
    ("Δt", "Where in the Δt it happened, 0 % to 100 %"),
    ("Kind", "What happened"),
    ("Bodies", "Who took part; the contacts of bodies that touch are resolved together"),
    (
        "Normal speed before → after [m/s]",
        "Speed along the normal, of the second body relative to the first: negative when closing",
    ),
    ("Impulse [N·s]", "Momentum handed over along the normal"),
    ("Place [m]", "The point where they touched"),
];

pub fn show(ui: &mut Ui, context: &AppContext<'_>) {
    let frame = context.session.frame();
    if frame.events.is_empty() {
        ui.add_space(8.0);
        let text = if frame.dt_index == 0 && frame.open_step.is_none() {
            "No events yet. Step forward (.) or go to the next event (N)."
        } else if frame.stepped.is_some() {
            "No events in this Δt: contacts of stepped bodies are none. The overlay Force chains shows them."
        } else {
            "No events in this Δt. Next event (N) goes on to one."
        };
        ui.label(RichText::new(text).color(tones(ui).weak));
        return;
    }
    if frame.events_truncated {
        ui.label(RichText::new("Only the last events of this Δt are listed.").color(tones(ui).warning));
    }
    let table = TableBuilder::new(ui)
        .id_salt("events")
        .striped(true)
        .sense(Sense::click())
        // a low panel shows few rows, not a list that runs out of it
        .min_scrolled_height(0.0)
        .stick_to_bottom(true)
        .column(Column::initial(52.0).resizable(true))
        .column(Column::initial(104.0).resizable(true))
        .column(Column::initial(52.0).resizable(true))
        .column(Column::initial(84.0).resizable(true))
        .column(Column::initial(150.0).resizable(true).clip(true))
        .column(Column::initial(204.0).resizable(true))
        .column(Column::initial(96.0).resizable(true))
        .column(Column::remainder().clip(true));
    table
        .header(ROW_HEIGHT, |mut header| {
            for (title, help) in TITLES {
                cell(&mut header, RichText::new(title).small().weak(), help);
            }
        })
        .body(|body| {
            body.rows(ROW_HEIGHT, frame.events.len(), |mut row| {
                if let Some(event) = frame.events.get(row.index()) {
                    show_row(&mut row, context, frame, event);
                }
            });
        });
}

fn show_row(row: &mut TableRow<'_, '_>, context: &AppContext<'_>, frame: &Frame, event: &Arc<EventRow>) {
    let [nth, of] = event.event.row_in_group;
    let group = (of > 1).then_some((nth, of));
    let chosen = context.session.shown_event().is_some_and(|shown| shown.event.seq == event.event.seq);
    row.set_selected(chosen);
    let labels = joined(&event.a_label, &event.b_label);
    for (column, text) in cells(context, frame, event).into_iter().enumerate() {
        let (text, grouped) = match group {
            Some((nth, of)) if column == 3 => {
                let help = format!(
                    "{}\nContact {nth} of {of} of impact group {}, resolved together",
                    event.event.kind.meaning(),
                    event.event.group
                );
                (format!("{text} {nth}/{of}"), help)
            }
            _ => (text, String::new()),
        };
        let help = match column {
            3 if group.is_some() => &grouped,
            3 => event.event.kind.meaning(),
            4 if text != labels => &labels,
            _ => "",
        };
        let text = if matches!(column, 3 | 4) { RichText::new(text) } else { mono(text) };
        cell(row, text, help);
    }
    let response = row.response();
    if response.clicked() {
        let keys = [Some(event.a_key), event.b_key].into_iter().flatten().collect();
        context.outbox.act(Action::Select(keys));
        context.outbox.act(Action::ShowEvent((!chosen).then(|| event.clone())));
    }
    if response.double_clicked() {
        context.outbox.act(Action::ShowEvent(Some(event.clone())));
        context.outbox.send(Message::FramePlace(event.event.point));
    }
}

fn cells(context: &AppContext<'_>, frame: &Frame, row: &EventRow) -> [String; 8] {
    let event = &row.event;
    let touching = matches!(event.kind, EventKind::Impact | EventKind::Collapse);
    let if_touching = |text: String| if touching { text } else { String::new() };
    // what is left of a sum that should be 0 says nothing
    let rounding = 1e-12 * event.point.abs().max_element().max(1.0);
    let clean = |value: f64| if value.abs() < rounding { 0.0 } else { value };
    let [x, y, z] = event.point.to_array().map(|value| significant(clean(value), 5));
    [
        event.seq.to_string(),
        format!("{:.9}", event.time),
        share(frame, event.time),
        event.kind.name().replace('_', " "),
        bodies(context, row),
        if_touching(format!("{} → {}", significant(event.vn_before, 6), significant(event.vn_after, 6))),
        if_touching(significant(event.impulse, 6)),
        if event.point.is_finite() { format!("{x}, {y}, {z}") } else { String::new() },
    ]
}

/// Who took part, by the names in the scene; what is no longer there by its label.
pub fn bodies(context: &AppContext<'_>, row: &EventRow) -> String {
    let name = |key| context.shown.and_then(|shown| shown.name(key));
    let a = name(row.a_key).unwrap_or(&row.a_label);
    if row.b_key.is_none() && row.event.bodies > 1 {
        return format!("{a} and {} more", significant(f64::from(row.event.bodies - 1), 9));
    }
    joined(a, row.b_key.and_then(name).unwrap_or(&row.b_label))
}

fn joined(a: &str, b: &str) -> String {
    if b.is_empty() { a.to_owned() } else { format!("{a} – {b}") }
}

/// Where in the Δt.
fn share(frame: &Frame, time: f64) -> String {
    match frame.step {
        Some((from, to)) if to > from => format!("{:.0} %", 100.0 * (time - from) / (to - from)),
        _ => String::new(),
    }
}

/// All events as text with tabs, full digits.
pub fn as_text(frame: &Frame) -> String {
    let mut text = String::from("seq\tt\tkind\ta\tb\tvn_before\tvn_after\timpulse\tx\ty\tz\tbodies\n");
    for row in &frame.events {
        let event = &row.event;
        let [x, y, z] = event.point.to_array();
        // writing to a string cannot fail
        let _ = writeln!(
            text,
            "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{x}\t{y}\t{z}\t{}",
            event.seq,
            event.time,
            event.kind.name(),
            row.a_label,
            row.b_label,
            event.vn_before,
            event.vn_after,
            event.impulse,
            event.bodies,
        );
    }
    text
}
