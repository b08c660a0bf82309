//! The columns of the ledger: one table for the panel and the order of the rows.

use crate::gui::context::AppContext;
use crate::gui::numbers::significant;
use crate::record::{Cost, EventRow};
use crate::scene::{Map, NodeKey};
use crate::sim::{Event, EventKind};

/// What an event is sorted by; its first body by the key that it has in the scene.
pub type SortKey = fn(&Event, NodeKey) -> f64;

/// One column.
pub struct LedgerColumn {
    /// With its unit.
    pub title: &'static str,
    pub help: &'static str,
    /// Points.
    pub width: f32,
    /// What the panel shows.
    pub text: fn(&AppContext<'_>, &EventRow) -> String,
    /// What rows are sorted by.
    pub key: Option<SortKey>,
}

/// Place of the columns with text, which is not written in a font of fixed width.
pub const KIND: usize = 3;
pub const BODIES: usize = 4;

/// How many of the last columns are shown only when they are asked for.
pub const COSTS: usize = 2;

pub const COLUMNS: [LedgerColumn; 16] = [
    LedgerColumn {
        title: "#",
        help: "Number of the event since the start",
        width: 58.0,
        text: |_, row| row.event.seq.to_string(),
        key: Some(|event, _| event.seq as f64),
    },
    LedgerColumn {
        title: "t [s]",
        help: "Model time",
        width: 104.0,
        text: |_, row| format!("{:.9}", row.event.time),
        key: Some(|event, _| event.time),
    },
    LedgerColumn {
        title: "Δt",
        help: "Where in its Δt it happened, 0 % to 100 %, if all Δt are as long as that being looked at",
        width: 48.0,
        text: |context, row| {
            fraction(context.session.frame().step, row)
                .map_or(String::new(), |share| format!("{:.0} %", 100.0 * share))
        },
        key: None,
    },
    LedgerColumn {
        title: "Kind",
        help: "What happened",
        width: 92.0,
        text: |_, row| kind(row),
        key: Some(|event, _| EventKind::ALL.iter().position(|kind| *kind == event.kind).unwrap_or(0) as f64),
    },
    LedgerColumn {
        title: "Bodies",
        help: "Who took part; the contacts of bodies that touch are resolved together",
        width: 150.0,
        text: bodies,
        key: Some(|_, a| a.0 as f64),
    },
    LedgerColumn {
        title: "Normal speed before → after [m/s]",
        help: "Speed along the normal, of the second body relative to the first: negative when closing",
        width: 204.0,
        text: |_, row| {
            let event = &row.event;
            let speeds = [event.vn_before, event.vn_after].map(|speed| significant(speed, 6));
            if_impact(row, || speeds.join(" → "))
        },
        key: Some(|event, _| event.vn_before.abs()),
    },
    LedgerColumn {
        title: "Impulse [N·s]",
        help: "Momentum handed over along the normal",
        width: 92.0,
        text: |_, row| if_impact(row, || significant(row.event.impulse, 6)),
        key: Some(|event, _| event.impulse),
    },
    LedgerColumn {
        title: "ΔE [J]",
        help: "Energy that the impact left the bodies with, less what they came with, along the normal: what friction took is not in it",
        width: 88.0,
        text: |_, row| row.energy_change().map_or(String::new(), |change| significant(change, 5)),
        key: Some(|event, _| EventRow::energy_change_of(event).unwrap_or(0.0)),
    },
    LedgerColumn {
        title: "Group",
        help: "Number of the impact group, whose contacts are resolved together",
        width: 56.0,
        text: |_, row| if row.event.group > 0 { row.event.group.to_string() } else { String::new() },
        key: Some(|event, _| event.group as f64),
    },
    LedgerColumn {
        title: "Rounds",
        help: "In how many rounds the contacts of the group were resolved; 0 for two bodies alone, by Newton's law",
        width: 58.0,
        text: |_, row| if_impact(row, || row.event.rounds.to_string()),
        key: Some(|event, _| f64::from(event.rounds)),
    },
    LedgerColumn {
        title: "Gap left [m]",
        help: "Distance of the surfaces where the search for the time of contact ended: what its root left over",
        width: 88.0,
        text: |_, row| if_impact(row, || significant(row.event.gap, 2)),
        key: Some(|event, _| event.gap.abs()),
    },
    LedgerColumn {
        title: "Place [m]",
        help: "The point where they touched",
        width: 176.0,
        text: |_, row| vector(row.event.point, row.event.point.abs().max_element()),
        key: None,
    },
    LedgerColumn {
        title: "Normal",
        help: "Unit vector from the first body to the second where they touched",
        width: 150.0,
        text: |_, row| if_impact(row, || vector(row.event.normal, 1.0)),
        key: None,
    },
    LedgerColumn {
        title: "Tile",
        help: "Tile of the map that the place lies in, counted from 0",
        width: 76.0,
        text: |context, row| {
            let map = context.scene().map(|scene| scene.map);
            tile(map, row).map_or(String::new(), |tile| tile.map(|number| number.to_string()).join(", "))
        },
        key: None,
    },
    LedgerColumn {
        title: "Searches",
        help: "Pairs of bodies whose time of impact was searched for since the event before, as this one asked for too: other tiles, other numbers",
        width: 66.0,
        text: |context, row| cost(context, row, |cost| cost.searches),
        key: None,
    },
    LedgerColumn {
        title: "Dropped",
        help: "Predictions dropped since the event before, for a body had changed since they were made: other tiles, other numbers",
        width: 62.0,
        text: |context, row| cost(context, row, |cost| cost.dropped),
        key: None,
    },
];

fn cost(context: &AppContext<'_>, row: &EventRow, of: fn(Cost) -> u32) -> String {
    context.session.frame().ledger.cost(row.event.seq).map_or(String::new(), |cost| of(cost).to_string())
}

fn kind(row: &EventRow) -> String {
    let name = row.event.kind.name().replace('_', " ");
    match row.event.row_in_group {
        [nth, of] if of > 1 => format!("{name} {nth}/{of}"),
        _ => name,
    }
}

fn if_impact(row: &EventRow, text: impl FnOnce() -> String) -> String {
    let is_impact = matches!(row.event.kind, EventKind::Impact | EventKind::Collapse);
    if is_impact { text() } else { String::new() }
}

/// What is left of a sum that should be 0 says nothing.
fn vector(value: glam::DVec3, size: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let rounding = 1e-12 * size;
    let clean = |value: f64| if value.abs() < rounding { 0.0 } else { value };
    value.to_array().map(|part| significant(clean(part), 5)).join(", ")
}

/// Where in its Δt an event happened, if all Δt are as long as one from a start to an end.
pub(super) fn fraction(step: Option<(f64, f64)>, row: &EventRow) -> Option<f64> {
    let (start, end) = step.filter(|(start, end)| end > start)?;
    let share = (row.event.time - start) / (end - start);
    Some(if (0.0..=1.0).contains(&share) { share } else { share - share.floor() })
}

/// The tile of the map that an event was in, counted from 0.
pub(super) fn tile(map: Option<Map>, row: &EventRow) -> Option<[u32; 3]> {
    let map = map?;
    let place = row.event.point / map.size;
    let inside = place.cmpge(glam::DVec3::ZERO).all() && place.cmple(glam::DVec3::ONE).all();
    let tiles = map.tiles.map(f64::from);
    inside.then(|| {
        std::array::from_fn(|axis| (place[axis] * tiles[axis]).floor().min(tiles[axis] - 1.0) as u32)
    })
}

/// Who took part, by the names in the scene; what is no longer there by its label.
pub fn bodies(context: &AppContext<'_>, row: &EventRow) -> String {
    let name = |key| {
        let now = context.shown.and_then(|shown| shown.name(key));
        now.or_else(|| context.session.former_name(key))
    };
    let a = name(row.a_key).unwrap_or(&row.a_label);
    if row.b_key.is_none() && row.event.bodies > 1 {
        return format!("{a} and {} more", significant(f64::from(row.event.bodies - 1), 9));
    }
    joined(a, row.b_key.and_then(name).unwrap_or(&row.b_label))
}

pub fn joined(a: &str, b: &str) -> String {
    if b.is_empty() { a.to_owned() } else { format!("{a} – {b}") }
}
