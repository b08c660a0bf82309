//! The ledger: every recorded event of the run. A click goes to the event and selects its bodies, a double click shows its
//! place large, a click on a title sorts.

mod cancelled;
mod columns;
mod filter;
mod listed;
mod written;

use std::sync::Arc;

use egui::{Context, ProgressBar, Rect, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder, TableRow};

use super::colors::tones;
use super::context::{AppContext, Message};
use super::theme::ROW_HEIGHT;
use super::widgets::{mono, short_cell};
use crate::editor::Action;
use crate::record::EventRow;
use columns::{BODIES, COLUMNS, COSTS, KIND, LedgerColumn, joined};
use filter::FilterBar;
use listed::{Listed, Order};
use written::{Kind, Rows, Writing};

pub use columns::bodies;

/// Keeps what is listed.
#[derive(Default)]
pub struct LedgerPanel {
    bar: FilterBar,
    order: Order,
    listed: Listed,
    /// Whether the columns of costs are shown and written.
    costs: bool,
    /// Whether there was a place for what the event shown cancelled, this turn.
    tells_cancelled: bool,
    /// The event shown when the list was scrolled to it last.
    scrolled_to: Option<u64>,
    /// Where to scroll to next, as a share of all rows.
    wanted: Option<f64>,
    /// Rows that are being written for a file or a copy.
    writing: Option<Writing>,
}

impl LedgerPanel {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let frame = context.session.frame();
        if frame.ledger.is_empty() {
            ui.add_space(8.0);
            ui.label(RichText::new(what_to_do(context)).color(tones(ui).weak));
            return;
        }
        self.bar.show(ui, context);
        if self.listed.look(&frame.ledger, &self.bar.wanted(context), self.order) {
            ui.ctx().request_repaint();
        }
        if self.costs {
            self.tells_cancelled = true;
            cancelled::show(ui, context);
        }
        self.table(ui, context);
    }

    /// As a tick at Costs.
    pub fn show_costs(&mut self) {
        self.costs = true;
    }

    /// Whether it said in the last turn what the event shown cancelled.
    pub fn told_cancelled(&mut self) -> bool {
        std::mem::take(&mut self.tells_cancelled)
    }

    /// What the row of tabs says of it.
    pub fn title(context: &AppContext<'_>) -> String {
        format!("Events ({})", super::numbers::count(context.session.frame().ledger.len() as u64))
    }

    fn table(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let ledger = &context.session.frame().ledger;
        let mut table = TableBuilder::new(ui)
            .id_salt("ledger")
            .striped(true)
            .sense(Sense::click())
            // a low panel shows few rows, not a list that runs out of it
            .min_scrolled_height(0.0)
            .auto_shrink(false);
        let shown = self.columns();
        for column in shown {
            table = table.column(Column::initial(column.width).resizable(true).clip(true));
        }
        if let Some(row) = self.row_to_scroll_to(context) {
            table = table.scroll_to_row(row, None);
        }
        let (order, listed) = (self.order, &self.listed);
        let mut chosen = None;
        table
            .header(ROW_HEIGHT, |mut header| {
                for nth in 0..shown.len() {
                    header.col(|ui| chosen = title(ui, nth, order).or(chosen));
                }
            })
            .body(|mut body| {
                let clip = body.ui_mut().clip_rect();
                body.rows(ROW_HEIGHT, listed.len(), |mut row| {
                    if let Some(event) = listed.row(ledger, row.index()) {
                        show_row(&mut row, context, event, (shown, clip));
                    }
                });
            });
        self.order = chosen.unwrap_or(self.order);
    }

    fn columns(&self) -> &'static [LedgerColumn] {
        let hidden = if self.costs { 0 } else { COSTS };
        COLUMNS.split_at(COLUMNS.len() - hidden).0
    }

    /// Scrolls to a place in the list, from 0 at its beginning to 1 at its end.
    pub fn scroll_to(&mut self, share: f64) {
        self.wanted = Some(share);
    }

    /// The row of the event shown, once for every one; of an impact group the first.
    fn row_to_scroll_to(&mut self, context: &AppContext<'_>) -> Option<usize> {
        if let Some(share) = self.wanted.take() {
            return Some((share * self.listed.len().saturating_sub(1) as f64) as usize);
        }
        let frame = context.session.frame();
        let event = frame.event_count;
        if self.scrolled_to.replace(event) == Some(event) {
            return None;
        }
        let nth = frame.event(event).map_or(0, |row| u64::from(row.event.row_in_group[0]).saturating_sub(1));
        Some(self.listed.place_of(&frame.ledger, event - nth)?.saturating_sub(1))
    }

    /// What takes the rows listed away: a copy, files. A million rows take seconds, with a way to give up.
    pub fn buttons(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        if let Some(writing) = &self.writing {
            let bar = ProgressBar::new(writing.part()).desired_width(120.0).desired_height(12.0);
            ui.add(bar).on_hover_text("Writing the rows listed");
            if ui.small_button("Cancel writing").clicked() {
                self.writing = None;
            }
            return;
        }
        let help = "Also shows and writes what the core did for each event: searches, and predictions dropped; of the event shown the \
             predicted impacts that it cancelled";
        ui.checkbox(&mut self.costs, "Costs").on_hover_text(help);
        let buttons = [
            (Kind::Copy, "Copy", "The rows listed as text with tabs, for a spreadsheet"),
            (Kind::Csv, "CSV…", "Writes the rows listed to a file, with all digits"),
            (Kind::Json, "JSON…", "Writes the rows listed to a file of JSON Lines, with all digits"),
        ];
        for (kind, name, help) in buttons {
            if ui.small_button(name).on_hover_text(help).clicked() {
                let rows = Rows::new(context, kind, self.bar.wanted(context), (self.order, self.costs));
                self.writing = Some(rows.start(ui.ctx()));
            }
        }
    }

    /// Hands on rows that have been written, whichever panel is in front.
    pub fn finish_writing(&mut self, ctx: &Context, context: &AppContext<'_>) {
        self.writing.take_if(|writing| writing.finish(ctx, context));
    }
}

fn what_to_do(context: &AppContext<'_>) -> &'static str {
    let frame = context.session.frame();
    if frame.is_at_start() {
        "No events yet. Step forward (.) or go to the next event (N)."
    } else if frame.stepped.is_some() {
        "No events so far: contacts of stepped bodies are none. The overlay Force chains shows them."
    } else {
        "No events so far. Next event (N) goes on to one."
    }
}

/// The title of a column; a click on it changes the order of the rows.
fn title(ui: &mut Ui, nth: usize, order: Order) -> Option<Order> {
    let column = COLUMNS.get(nth)?;
    let arrow = match order {
        Order { column, falling } if column == nth => {
            if falling {
                " ↓"
            } else {
                " ↑"
            }
        }
        _ => "",
    };
    let text = RichText::new(format!("{}{arrow}", column.title)).small().weak();
    if column.key.is_none() {
        ui.label(text).on_hover_text(column.help);
        return None;
    }
    let response = ui.add(egui::Label::new(text).sense(Sense::click()));
    let help = format!("{}\nClick: sort by it; again: the other way round", column.help);
    let clicked = response.on_hover_text(help).clicked();
    clicked.then_some(Order { column: nth, falling: order.column == nth && !order.falling })
}

fn show_row(
    row: &mut TableRow<'_, '_>,
    context: &AppContext<'_>,
    event: &Arc<EventRow>,
    (columns, clip): (&[LedgerColumn], Rect),
) {
    let frame = context.session.frame();
    let is_shown = context.session.shown_event().is_some_and(|shown| shown.event.seq == event.event.seq);
    let is_to_come = event.event.seq > frame.event_count;
    row.set_selected(is_shown);
    for (nth, column) in columns.iter().enumerate() {
        let text = (column.text)(context, event);
        let help = help(nth, event, &text);
        let text = if matches!(nth, KIND | BODIES) { RichText::new(text) } else { mono(text) };
        short_cell(row, clip, if is_to_come { text.weak() } else { text }, &help);
    }
    let response = row.response();
    if response.clicked() {
        let act = if is_shown { Action::ShowEvent(None) } else { Action::GoToEvent(event.event.seq) };
        context.outbox.act(act);
    }
    if response.double_clicked() {
        context.outbox.act(Action::GoToEvent(event.event.seq));
        context.outbox.send(Message::FramePlace(event.event.point));
    }
}

fn help(nth: usize, event: &EventRow, text: &str) -> String {
    let labels = joined(&event.a_label, &event.b_label);
    match (nth, event.event.row_in_group) {
        (KIND, [row, of]) if of > 1 => format!(
            "{}\nContact {row} of {of} of impact group {}, resolved together",
            event.event.kind.meaning(),
            event.event.group
        ),
        (KIND, _) => event.event.kind.meaning().to_owned(),
        (BODIES, _) if text != labels => labels,
        _ => String::new(),
    }
}
