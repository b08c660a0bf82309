//! Rows as JSON Lines or as CSV (RFC 4180), of the bodies, kinds and columns that were asked for.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use clap::{Args, ValueEnum};
use serde::Serialize;

use super::CliError;
use super::output::LineSink;
use super::rows::{EventRow, StateRow, event_columns, state_columns};
use crate::record::{COST_COLUMNS, Column, Cost, Who, cells};
use crate::scene::{Body, Scene};
use crate::sim::{BodyRef, Event, EventKind, Simulation};

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Style {
    Jsonl,
    Csv,
}

/// What of the rows is written.
#[derive(Clone, Debug, Default, Args)]
pub struct RowArgs {
    /// How rows are written; by default csv for a file that ends so, else jsonl
    #[arg(long = "rows", value_name = "FORMAT")]
    style: Option<Style>,

    /// Only rows of these bodies, by UserID or name, separated by commas: of an event one of the two is enough
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    bodies: Vec<String>,

    /// Only events of these kinds, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "events")]
    kinds: Vec<String>,

    /// Only these columns of CSV, separated by commas, in this order
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    columns: Vec<String>,

    /// Also what the core did since the event before: pairs whose time of impact it searched for (searches), and predictions
    /// that it dropped since a body had changed (dropped). Unlike all else they depend on the tiles
    #[arg(long, requires = "events")]
    costs: bool,
}

/// The bodies and kinds that are wanted; all unless some were named. And what bodies are called.
pub struct Wanted {
    labels: Option<BTreeSet<String>>,
    kinds: Option<Vec<EventKind>>,
    /// By label, of those that have one.
    names: BTreeMap<String, String>,
}

/// An event that is to be written.
pub struct Happened<'a> {
    pub event: &'a Event,
    /// Labels of its bodies.
    pub a: &'a str,
    pub b: Option<&'a str>,
    pub dt_index: u64,
    pub cost: Cost,
}

impl RowArgs {
    /// Refuses bodies and kinds that there are not.
    pub fn wanted(&self, scene: &Scene) -> Result<Wanted, CliError> {
        let mut labels = BTreeSet::new();
        for name in self.bodies.iter().map(|name| name.trim()) {
            let named = |body: &&Body| body.label == name || body.name.as_deref() == Some(name);
            let found: Vec<_> =
                scene.bodies.iter().filter(named).map(|body| body.label.to_string()).collect();
            if found.is_empty() {
                return Err(CliError::Usage(format!("--bodies: no body has the UserID or name {name}")));
            }
            labels.extend(found);
        }
        let mut kinds = Vec::new();
        for name in self.kinds.iter().map(|name| name.trim()) {
            let known = EventKind::ALL.into_iter().find(|kind| kind.name() == name);
            kinds.push(known.ok_or_else(|| {
                let names: Vec<_> = EventKind::ALL.iter().map(|kind| kind.name()).collect();
                CliError::Usage(format!("--kinds: {name} is none of {}", names.join(", ")))
            })?);
        }
        let labels = (!self.bodies.is_empty()).then_some(labels);
        let kinds = (!self.kinds.is_empty()).then_some(kinds);
        let mut wanted = Wanted { labels, kinds, names: BTreeMap::new() };
        wanted.name(&scene.bodies);
        Ok(wanted)
    }

    pub fn states(&self, path: &Path) -> Result<Table, CliError> {
        Table::create(path, self.style_of(path), self.chosen(state_columns(), &[])?)
    }

    pub fn events(&self, path: &Path) -> Result<Table, CliError> {
        let columns = self.chosen(event_columns(), COST_COLUMNS)?;
        Ok(Table { costs: self.costs, ..Table::create(path, self.style_of(path), columns)? })
    }

    /// Refuses what fits no output, before the run. `options` are those that write rows.
    pub fn check(&self, states: Option<&Path>, events: Option<&Path>, options: &str) -> Result<(), CliError> {
        let outputs = [states, events].into_iter().flatten();
        if let (None, Some(given)) = (outputs.clone().next(), self.given()) {
            return Err(CliError::Usage(format!(
                "{given} is about rows, and none are written: add {options}"
            )));
        }
        if !self.columns.is_empty() && outputs.clone().any(|path| self.style_of(path) == Style::Jsonl) {
            return Err(CliError::Usage("--columns are those of CSV: add --rows csv".into()));
        }
        let of_events = event_columns().into_iter().chain(COST_COLUMNS).collect();
        let tables = [(states, state_columns()), (events, of_events)];
        let tables = tables.into_iter().filter(|(path, _)| path.is_some());
        let known: Vec<&str> = tables.flat_map(|(_, columns)| columns).map(|column| column.name).collect();
        match self.columns.iter().find(|name| !known.contains(&name.trim())) {
            Some(unknown) if !known.is_empty() => {
                Err(CliError::Usage(format!("--columns: {unknown} is none of {}", known.join(", "))))
            }
            _ => Ok(()),
        }
    }

    /// The first option about rows that was given.
    fn given(&self) -> Option<&'static str> {
        let options = [
            ("--rows", self.style.is_some()),
            ("--bodies", !self.bodies.is_empty()),
            ("--columns", !self.columns.is_empty()),
        ];
        options.into_iter().find_map(|(option, is_given)| is_given.then_some(option))
    }

    fn style_of(&self, path: &Path) -> Style {
        let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        self.style.unwrap_or(if is_csv { Style::Csv } else { Style::Jsonl })
    }

    /// The columns asked for, of those that a table has, and of its costs; all of the table's unless some were named.
    fn chosen(
        &self,
        mut all: Vec<&'static Column>,
        costs: &'static [Column],
    ) -> Result<Vec<&'static Column>, CliError> {
        if !self.columns.is_empty() || self.costs {
            all.extend(costs);
        }
        if self.columns.is_empty() {
            return Ok(all);
        }
        let named = |name: &String| all.iter().copied().find(|column| column.name == name.trim());
        let chosen: Vec<_> = self.columns.iter().filter_map(named).collect();
        if chosen.is_empty() {
            let names: Vec<_> = all.iter().map(|column| column.name).collect();
            let text = format!("--columns leaves no column of one output; it has {}", names.join(", "));
            return Err(CliError::Usage(text));
        }
        Ok(chosen)
    }
}

impl Wanted {
    /// Takes over what bodies are called.
    pub fn name<'b>(&mut self, bodies: impl IntoIterator<Item = &'b Body>) {
        let named = bodies.into_iter().filter_map(|body| Some((body.label.to_string(), body.name.clone()?)));
        self.names.extend(named);
    }

    pub fn body(&self, sim: &Simulation, body: BodyRef) -> bool {
        self.has(sim.label(body))
    }

    fn has(&self, label: &str) -> bool {
        self.labels.as_ref().is_none_or(|labels| labels.contains(label))
    }

    fn event(&self, happened: &Happened<'_>) -> bool {
        let kind = self.kinds.as_ref().is_none_or(|kinds| kinds.contains(&happened.event.kind));
        kind && (self.has(happened.a) || happened.b.is_some_and(|b| self.has(b)))
    }

    fn who<'a>(&'a self, label: &'a str) -> Who<'a> {
        Who { label, name: self.names.get(label).map(String::as_str) }
    }
}

/// Where rows of one sort go.
pub struct Table {
    pub sink: LineSink,
    style: Style,
    columns: Vec<&'static Column>,
    costs: bool,
}

impl Table {
    fn create(path: &Path, style: Style, columns: Vec<&'static Column>) -> Result<Self, CliError> {
        let mut sink = LineSink::create(path)?;
        if style == Style::Csv {
            let names: Vec<_> = columns.iter().map(|column| column.name).collect();
            sink.line(&names.join(","))?;
        }
        Ok(Self { sink, style, columns, costs: false })
    }

    /// One row for JSON, one for each body for CSV.
    pub fn state(&mut self, sim: &Simulation, wanted: &Wanted) -> Result<(), CliError> {
        let row = StateRow::new(sim, |body| wanted.body(sim, body));
        if self.style == Style::Jsonl {
            return self.sink.row(&row);
        }
        row.bodies().try_for_each(|body| self.csv(&body))
    }

    pub fn event(&mut self, happened: &Happened<'_>, wanted: &Wanted) -> Result<(), CliError> {
        if !wanted.event(happened) {
            return Ok(());
        }
        let bodies = (wanted.who(happened.a), happened.b.map(|b| wanted.who(b)));
        let cost = (self.costs || self.style == Style::Csv).then_some(happened.cost);
        let row = EventRow::new(happened.event, bodies, happened.dt_index, cost);
        if self.style == Style::Jsonl { self.sink.row(&row) } else { self.csv(&row) }
    }

    fn csv(&mut self, row: &impl Serialize) -> Result<(), CliError> {
        self.sink.line(&cells(row, self.columns.iter().copied()).join(","))
    }
}
