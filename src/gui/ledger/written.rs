//! The rows of the ledger as text, written in the background: what `run --events` writes of an event, and what the ledger knows
//! beyond that.

use std::collections::BTreeMap;

use egui::Context;
use serde::Serialize;

use super::columns::{fraction, tile};
use super::filter::Filter;
use super::listed::{Listed, Order};
use crate::editor::ExportedFile;
use crate::gui::background::{Background, GoOn};
use crate::gui::context::{AppContext, Message};
use crate::record::{COST_COLUMNS, Column, Cost, EVENT_COLUMNS, EventLine, EventRow, Ledger, Who, cells};
use crate::scene::{Map, NodeKey};

/// What a [`Line`] has besides the columns of an event.
const OWN_COLUMNS: &[Column] = &[
    Column::new("fraction", "/fraction"),
    Column::new("energy_change", "/energy_change"),
    Column::new("row", "/row"),
    Column::new("rows", "/rows"),
    Column::new("tile_x", "/tile/0"),
    Column::new("tile_y", "/tile/1"),
    Column::new("tile_z", "/tile/2"),
];

#[derive(Serialize)]
struct Line<'a> {
    #[serde(flatten)]
    event: EventLine<'a>,
    /// Share of its Δt that was gone.
    fraction: Option<f64>,
    /// J.
    energy_change: Option<f64>,
    /// Which row of its impact group it is, and of how many.
    row: u32,
    rows: u32,
    tile: Option<[u32; 3]>,
    /// Where it is asked for.
    #[serde(flatten)]
    cost: Option<Cost>,
}

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// With tabs, for the clipboard.
    Copy,
    Csv,
    Json,
}

/// What is written: a copy of the ledger shares its rows.
pub(super) struct Rows {
    pub kind: Kind,
    pub ledger: Ledger,
    pub filter: Filter,
    pub order: Order,
    /// Whether with what each event took.
    costs: bool,
    step: Option<(f64, f64)>,
    map: Option<Map>,
    /// Of the bodies of the scene that have one.
    names: BTreeMap<NodeKey, String>,
}

impl Rows {
    pub fn new(context: &AppContext<'_>, kind: Kind, filter: Filter, (order, costs): (Order, bool)) -> Self {
        let frame = context.session.frame();
        let map = context.scene().map(|scene| scene.map);
        let bodies = context.scene().into_iter().flat_map(|scene| &scene.bodies);
        let names = bodies.filter_map(|body| Some((body.key, body.name.clone()?))).collect();
        Self { kind, ledger: frame.ledger.clone(), filter, order, costs, step: frame.step, map, names }
    }

    /// Begins to write them.
    pub fn start(self, ctx: &Context) -> Writing {
        Writing { kind: self.kind, job: Background::start(ctx, move |go_on| self.text(go_on)) }
    }

    fn text(&self, go_on: GoOn<'_>) -> Result<String, String> {
        let cancelled = || Err("the rows were not written: it was cancelled".to_owned());
        let mut listed = Listed::default();
        while listed.look(&self.ledger, &self.filter, self.order) {
            if !go_on(0.0) {
                return cancelled();
            }
        }
        let costs = if self.costs { COST_COLUMNS } else { &[] };
        let columns: Vec<&Column> = EVENT_COLUMNS.iter().chain(OWN_COLUMNS).chain(costs).collect();
        let mut text = String::new();
        if let Some(separator) = self.separator() {
            text = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(separator) + "\n";
        }
        for (nth, row) in listed.rows(&self.ledger).enumerate() {
            if nth.is_multiple_of(LOOK) && !go_on(nth as f64 / listed.len() as f64) {
                return cancelled();
            }
            let line = self.line(row);
            match self.separator() {
                Some(separator) => text.push_str(&cells(&line, columns.iter().copied()).join(separator)),
                // numbers and text are always JSON
                None => text.push_str(&serde_json::to_string(&line).unwrap_or_default()),
            }
            text.push('\n');
        }
        Ok(text)
    }

    /// Between the cells of a table.
    fn separator(&self) -> Option<&'static str> {
        match self.kind {
            Kind::Copy => Some("\t"),
            Kind::Csv => Some(","),
            Kind::Json => None,
        }
    }

    fn line<'a>(&'a self, row: &'a EventRow) -> Line<'a> {
        let [nth, of] = row.event.row_in_group;
        let who = |key, label| Who { label, name: self.names.get(&key).map(String::as_str) };
        let cost = self.costs.then(|| self.ledger.cost(row.event.seq)).flatten();
        Line {
            event: EventLine::new(
                &row.event,
                who(row.a_key, &row.a_label),
                row.b_key.map(|key| who(key, &row.b_label)),
            ),
            cost,
            fraction: fraction(self.step, row),
            energy_change: row.energy_change(),
            row: nth,
            rows: of,
            tile: tile(self.map, row),
        }
    }
}

/// Rows between two looks at whether to go on.
const LOOK: usize = 1024;

/// Rows that are being written.
pub(super) struct Writing {
    kind: Kind,
    job: Background<String>,
}

impl Writing {
    /// From 0 to 1.
    pub fn part(&self) -> f32 {
        self.job.part()
    }

    /// Hands on what was written; whether that is done.
    pub fn finish(&self, ctx: &Context, context: &AppContext<'_>) -> bool {
        let Some(outcome) = self.job.take() else { return false };
        match (self.kind, outcome) {
            (_, Err(problem)) => context.outbox.send(Message::Warn(problem)),
            (Kind::Copy, Ok(text)) => ctx.copy_text(text),
            (Kind::Csv, Ok(text)) => context.outbox.send(request(context, "csv", text)),
            (Kind::Json, Ok(text)) => context.outbox.send(request(context, "jsonl", text)),
        }
        true
    }
}

/// Asks where a file of rows goes.
fn request(context: &AppContext<'_>, extension: &'static str, text: String) -> Message {
    let title = context.session.title();
    let stem = title.strip_suffix(".xml").unwrap_or(title);
    Message::AskWhere {
        title: "Save the events as",
        file: ExportedFile { extension, bytes: text.into_bytes().into() },
        file_name: format!("{stem}-events.{extension}"),
    }
}
