//! One event as a row of JSON or of a table: what `run --events` and the ledger of the window write alike.

use serde::Serialize;
use serde_json::Value;

use crate::sim::{Event, EventKind};

/// A column of a table and where its value stands in the JSON of a row.
#[derive(Debug)]
pub struct Column {
    pub name: &'static str,
    pub at: &'static str,
}

impl Column {
    pub const fn new(name: &'static str, at: &'static str) -> Self {
        Self { name, at }
    }
}

/// Of an [`EventLine`].
pub const EVENT_COLUMNS: &[Column] = &[
    Column::new("seq", "/seq"),
    Column::new("t", "/t"),
    Column::new("kind", "/kind"),
    Column::new("a", "/a"),
    Column::new("b", "/b"),
    Column::new("a_name", "/a_name"),
    Column::new("b_name", "/b_name"),
    Column::new("point_x", "/point/0"),
    Column::new("point_y", "/point/1"),
    Column::new("point_z", "/point/2"),
    Column::new("normal_x", "/normal/0"),
    Column::new("normal_y", "/normal/1"),
    Column::new("normal_z", "/normal/2"),
    Column::new("impulse", "/impulse"),
    Column::new("vn_before", "/vn_before"),
    Column::new("vn_after", "/vn_after"),
    Column::new("group", "/group"),
    Column::new("bodies", "/bodies"),
    Column::new("gap", "/gap"),
    Column::new("rounds", "/rounds"),
];

/// What an event took, where that is asked for: a [`Cost`](super::Cost) beside an [`EventLine`].
pub const COST_COLUMNS: &[Column] =
    &[Column::new("searches", "/searches"), Column::new("dropped", "/dropped")];

/// A body of an event: its label, and its name if it has one.
#[derive(Clone, Copy, Debug)]
pub struct Who<'a> {
    pub label: &'a str,
    pub name: Option<&'a str>,
}

/// One contact of one event. Units as in [`Event`]; to a reader −0 is 0.
#[derive(Clone, Debug, Serialize)]
pub struct EventLine<'a> {
    seq: u64,
    t: f64,
    kind: &'static str,
    a: &'a str,
    b: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    a_name: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    b_name: Option<&'a str>,
    point: [f64; 3],
    normal: [f64; 3],
    impulse: f64,
    vn_before: f64,
    vn_after: f64,
    group: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<u32>,
    gap: f64,
    rounds: u32,
}

impl<'a> EventLine<'a> {
    pub fn new(event: &Event, a: Who<'a>, b: Option<Who<'a>>) -> Self {
        Self {
            seq: event.seq,
            t: event.time,
            kind: event.kind.name(),
            a: a.label,
            b: b.map(|b| b.label),
            a_name: a.name,
            b_name: b.and_then(|b| b.name),
            point: (event.point + glam::DVec3::ZERO).to_array(),
            normal: (event.normal + glam::DVec3::ZERO).to_array(),
            impulse: event.impulse,
            vn_before: event.vn_before,
            vn_after: event.vn_after,
            group: event.group,
            bodies: is_about_many(event.kind).then_some(event.bodies),
            gap: event.gap + 0.0,
            rounds: event.rounds,
        }
    }
}

/// Whether a kind of event is about a whole group of bodies.
fn is_about_many(kind: EventKind) -> bool {
    matches!(kind, EventKind::Dense | EventKind::GroupRest)
}

/// The cells of a row, in quotes where RFC 4180 asks for them: names may have anything in them. What is not there is empty.
pub fn cells<'a>(row: &impl Serialize, columns: impl IntoIterator<Item = &'a Column>) -> Vec<String> {
    let row = serde_json::to_value(row).unwrap_or_default();
    columns.into_iter().map(|column| row.pointer(column.at).map(text).unwrap_or_default()).collect()
}

fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) if text.contains(['"', ',', '\n', '\r', '\t']) => {
            format!("\"{}\"", text.replace('"', "\"\""))
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
