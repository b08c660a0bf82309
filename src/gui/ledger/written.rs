//! The rows of the ledger as text: what `run --events` writes of an event, and what the ledger knows beyond that.

use std::sync::Arc;

use serde::Serialize;

use super::columns::{fraction, tile};
use crate::editor::ExportedFile;
use crate::gui::context::{AppContext, Message};
use crate::record::{Column, EVENT_COLUMNS, EventLine, EventRow, cells};

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
}

impl<'a> Line<'a> {
    fn new(context: &AppContext<'_>, row: &'a EventRow) -> Self {
        let [nth, of] = row.event.row_in_group;
        Self {
            event: EventLine::new(&row.event, &row.a_label, row.b_key.map(|_| &*row.b_label)),
            fraction: fraction(context, row),
            energy_change: row.energy_change(),
            row: nth,
            rows: of,
            tile: tile(context, row),
        }
    }
}

/// A line with the names of the columns, and one for each row.
pub(super) fn table<'a>(
    context: &AppContext<'_>,
    rows: impl Iterator<Item = &'a Arc<EventRow>>,
    separator: &str,
) -> String {
    let columns = || EVENT_COLUMNS.iter().chain(OWN_COLUMNS);
    let mut text = columns().map(|column| column.name).collect::<Vec<_>>().join(separator) + "\n";
    for row in rows {
        text.push_str(&cells(&Line::new(context, row), columns()).join(separator));
        text.push('\n');
    }
    text
}

pub(super) fn json_lines<'a>(
    context: &AppContext<'_>,
    rows: impl Iterator<Item = &'a Arc<EventRow>>,
) -> String {
    let mut text = String::new();
    for row in rows {
        // numbers and text are always JSON
        text.push_str(&serde_json::to_string(&Line::new(context, row)).unwrap_or_default());
        text.push('\n');
    }
    text
}

/// Asks where a file of rows goes.
pub(super) fn request(context: &AppContext<'_>, extension: &'static str, text: String) -> Message {
    let title = context.session.title();
    let stem = title.strip_suffix(".xml").unwrap_or(title);
    Message::AskWhere {
        title: "Save the events as",
        file: ExportedFile { extension, bytes: text.into_bytes().into() },
        file_name: format!("{stem}-events.{extension}"),
    }
}
