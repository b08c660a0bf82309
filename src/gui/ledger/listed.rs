//! Which rows of the ledger are listed, in which order. A million rows are looked through in portions, so that no repaint
//! waits for them.

use std::sync::Arc;

use super::columns::COLUMNS;
use super::filter::Filter;
use crate::record::{EventRow, Ledger};

/// Rows that are looked through in one repaint.
const PORTION: usize = 100_000;

/// The column that rows are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Order {
    pub column: usize,
    pub falling: bool,
}

/// Places in the ledger of the rows listed.
#[derive(Default)]
pub(super) struct Listed {
    rows: Vec<u32>,
    /// How many rows have been looked through, and the last of them: if it is another one, the future is another.
    seen: usize,
    last: Option<Arc<EventRow>>,
    /// First row that is kept.
    first: u64,
    filter: Filter,
    order: Order,
    /// How many of the rows are in order.
    sorted: usize,
}

impl Listed {
    /// Looks through what is new; whether there is more.
    pub fn look(&mut self, ledger: &Ledger, filter: &Filter, order: Order) -> bool {
        let last = self.seen.checked_sub(1).and_then(|last| ledger.at(last));
        let is_same = match (&self.last, last) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => self.seen == 0,
            _ => false,
        };
        if !is_same || self.filter != *filter || self.order != order || self.first != ledger.first() {
            *self = Self { filter: filter.clone(), order, first: ledger.first(), ..Self::default() };
        }
        let end = ledger.len().min(self.seen + PORTION);
        let new = ledger.iter_from(self.seen).take(end - self.seen).enumerate();
        let listed = new.filter(|(_, row)| filter.holds(row)).map(|(nth, _)| (self.seen + nth) as u32);
        self.rows.extend(listed);
        self.seen = end;
        self.last = end.checked_sub(1).and_then(|last| ledger.at(last)).cloned();
        if end < ledger.len() {
            return true;
        }
        self.sort(ledger);
        false
    }

    /// Puts the rows in order: by number they are already.
    fn sort(&mut self, ledger: &Ledger) {
        let Order { column, falling } = self.order;
        let Some(key) = COLUMNS.get(column).and_then(|column| column.key) else { return };
        if self.sorted == self.rows.len() || self.order == Order::default() {
            return;
        }
        let keyed = self.rows.iter().filter_map(|at| Some((key(ledger.at(*at as usize)?), *at)));
        let mut keyed: Vec<(f64, u32)> = keyed.collect();
        keyed.sort_unstable_by(|(a, nth), (b, other)| {
            let order = a.total_cmp(b);
            (if falling { order.reverse() } else { order }).then(nth.cmp(other))
        });
        self.rows = keyed.into_iter().map(|(_, at)| at).collect();
        self.sorted = self.rows.len();
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// The n-th row listed.
    pub fn row<'a>(&self, ledger: &'a Ledger, nth: usize) -> Option<&'a Arc<EventRow>> {
        ledger.at(*self.rows.get(nth)? as usize)
    }

    /// All rows listed.
    pub fn rows<'a>(&'a self, ledger: &'a Ledger) -> impl Iterator<Item = &'a Arc<EventRow>> {
        self.rows.iter().filter_map(|at| ledger.at(*at as usize))
    }

    /// How many of the rows happened up to an event, where they are in the order of their numbers.
    pub fn place_of(&self, ledger: &Ledger, event: u64) -> Option<usize> {
        (self.order == Order::default()).then(|| {
            self.rows.partition_point(|at| ledger.at(*at as usize).is_some_and(|row| row.event.seq <= event))
        })
    }
}
