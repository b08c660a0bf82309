//! Which rows of the ledger are listed, in which order. A million rows are looked through in portions, so that no repaint
//! waits for them.

use std::cmp::Ordering;
use std::sync::Arc;

use super::columns::{COLUMNS, SortKey};
use super::filter::Filter;
use crate::record::{EventRow, Ledger, Past};

/// Rows that are looked through in one repaint: some milliseconds where they are also put in order.
const PORTION: usize = 50_000;

/// The column that rows are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Order {
    pub column: usize,
    pub falling: bool,
}

/// A place in the ledger, with what it is sorted by; 0 where rows are in the order of their numbers, as they come.
#[derive(Clone, Copy, Debug)]
struct Place {
    key: f64,
    at: u32,
}

/// Places in the ledger of the rows listed.
#[derive(Default)]
pub(super) struct Listed {
    rows: Vec<Place>,
    /// How many rows have been looked through, of which past, and the first that was kept.
    seen: usize,
    past: Past,
    first: u64,
    filter: Filter,
    order: Order,
}

impl Order {
    /// What rows are to be sorted by; `None` where they come in order.
    fn key(self) -> Option<SortKey> {
        if self == Self::default() { None } else { COLUMNS.get(self.column)?.key }
    }

    fn compare(self, a: Place, b: Place) -> Ordering {
        let order = a.key.total_cmp(&b.key);
        (if self.falling { order.reverse() } else { order }).then(a.at.cmp(&b.at))
    }

    /// How many of the places that are in order stay before another: looked for from the end on, in steps that double, for it
    /// is mostly near there.
    fn count_before(self, place: Place, rows: &[Place]) -> usize {
        let is_after = |row: &Place| self.compare(place, *row) == Ordering::Less;
        let (mut end, mut step) = (rows.len(), 1);
        while step <= end && is_after(&rows[end - step]) {
            (end, step) = (end - step, 2 * step);
        }
        let start = end.saturating_sub(step);
        start + rows[start..end].partition_point(|row| !is_after(row))
    }
}

impl Listed {
    /// Looks through what is new; whether there is more.
    pub fn look(&mut self, ledger: &Ledger, filter: &Filter, order: Order) -> bool {
        let is_same = self.past == *ledger.past() && self.first == ledger.first();
        if !is_same || self.filter != *filter || self.order != order {
            let (past, first) = (ledger.past().clone(), ledger.first());
            let seen = ledger.count_before(filter.from);
            *self = Self { seen, past, first, filter: filter.clone(), order, ..Self::default() };
            self.rows.reserve(ledger.count_until(filter.to).saturating_sub(seen));
        }
        // Rows are in the order of their times: there is nothing to list outside of the filter's.
        let last = ledger.count_until(filter.to).max(self.seen);
        let end = last.min(self.seen + PORTION);
        let new = (self.seen..end).filter(|nth| filter.holds(ledger, *nth));
        match order.key() {
            None => self.rows.extend(new.map(|nth| Place { key: 0.0, at: nth as u32 })),
            Some(key) => {
                let place = |nth| {
                    let (a, _) = ledger.keys_at(nth)?;
                    Some(Place { key: key(ledger.event_at(nth)?, a), at: nth as u32 })
                };
                let mut new: Vec<Place> = new.filter_map(place).collect();
                new.sort_unstable_by(|a, b| order.compare(*a, *b));
                self.merge(&new);
            }
        }
        self.seen = end;
        end < last
    }

    /// Puts more rows among those that are in order, from the end on.
    fn merge(&mut self, new: &[Place]) {
        let (mut old, order) = (self.rows.len(), self.order);
        self.rows.extend(new);
        let mut free = self.rows.len();
        for place in new.iter().rev() {
            let before = order.count_before(*place, &self.rows[..old]);
            let moved = old - before;
            self.rows.copy_within(before..old, free - moved);
            (old, free) = (before, free - moved - 1);
            self.rows[free] = *place;
        }
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// The n-th row listed.
    pub fn row<'a>(&self, ledger: &'a Ledger, nth: usize) -> Option<&'a Arc<EventRow>> {
        ledger.at(self.rows.get(nth)?.at as usize)
    }

    /// All rows listed.
    pub fn rows<'a>(&'a self, ledger: &'a Ledger) -> impl Iterator<Item = &'a Arc<EventRow>> {
        self.rows.iter().filter_map(|place| ledger.at(place.at as usize))
    }

    /// How many of the rows happened up to an event, where they are in the order of their numbers.
    pub fn place_of(&self, ledger: &Ledger, event: u64) -> Option<usize> {
        (self.order == Order::default()).then(|| {
            let is_past =
                |place: &Place| ledger.event_at(place.at as usize).is_some_and(|row| row.seq <= event);
            self.rows.partition_point(is_past)
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

    use std::time::Instant;

    use super::*;
    use crate::record::{InlineRunner, RunCommand, Runner as _};
    use crate::scene::NodeKey;
    use crate::sim::{BodyRef, Event};

    /// Event `seq` of a run in which impulses come in no order.
    fn row(seq: u64) -> EventRow {
        let impulse = (seq.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 44) as f64;
        let event = Event::impact_of_one(seq, seq as f64, BodyRef::Dynamic((seq % 7) as u32), impulse);
        EventRow { event, a_key: NodeKey(seq % 7), b_key: None, a_label: "1".into(), b_label: Arc::default() }
    }

    fn ledger(count: u64) -> Ledger {
        (1..=count).map(row).collect()
    }

    const BY_IMPULSE: usize = 6;

    fn look_through(listed: &mut Listed, ledger: &Ledger, filter: &Filter, order: Order) -> u32 {
        let mut looks = 1;
        while listed.look(ledger, filter, order) {
            looks += 1;
        }
        looks
    }

    #[test]
    fn portions_put_in_order_are_the_order_of_all() {
        let count = 2 * PORTION as u64 + 777;
        let ledger = ledger(count);
        for falling in [false, true] {
            let order = Order { column: BY_IMPULSE, falling };
            let mut listed = Listed::default();
            assert_eq!(look_through(&mut listed, &ledger, &Filter::default(), order), 3);
            let mut naive: Vec<EventRow> = (1..=count).map(row).collect();
            naive.sort_by(|a, b| {
                let order = a.event.impulse.total_cmp(&b.event.impulse);
                if falling { order.reverse() } else { order }
            });
            let numbers: Vec<u64> = listed.rows(&ledger).map(|row| row.event.seq).collect();
            assert_eq!(numbers, naive.iter().map(|row| row.event.seq).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_filter_of_bodies_and_impulses_lists_what_it_holds_of() {
        let ledger = ledger(1000);
        let filter = Filter { of: crate::record::Of::Body(NodeKey(3)), impulse: 1e5, ..Filter::default() };
        let mut listed = Listed::default();
        listed.look(&ledger, &filter, Order::default());
        let numbers: Vec<u64> = listed.rows(&ledger).map(|row| row.event.seq).collect();
        let holds = |seq: &u64| seq % 7 == 3 && row(*seq).event.impulse >= 1e5;
        let naive: Vec<u64> = (1..=1000).filter(holds).collect();
        assert!(naive.len() > 50 && numbers == naive, "{numbers:?}");
    }

    // Symptom: with "Only this Δt" the list stayed empty while a long run played, for each Δt began with the first row of the run.
    // Expected: a short time is listed at once, wherever it is.
    #[test]
    fn a_short_time_far_in_a_run_is_listed_at_once() {
        let far = 5 * PORTION as u64;
        let ledger = ledger(far + 1000);
        let filter = Filter { from: far as f64, to: far as f64 + 9.0, ..Filter::default() };
        let mut listed = Listed::default();
        assert!(!listed.look(&ledger, &filter, Order::default()));
        let numbers: Vec<u64> = listed.rows(&ledger).map(|row| row.event.seq).collect();
        assert_eq!(numbers, (far..=far + 9).collect::<Vec<_>>());
    }

    // Symptom: with the ledger in front the list of a long run could begin anew with a picture while it played, and showed its
    // first rows only. Expected: it goes on. Cause: whether the past is the same was told from the last row, which a picture
    // makes again when it is asked for it after the run has gone on.
    #[test]
    fn a_list_goes_on_with_the_rows_of_the_next_picture() {
        let document = crate::scene::Document::from_bytes(include_bytes!("../../../scenes/bounce.xml"));
        let mut runner = InlineRunner::new();
        runner.send(RunCommand::Load(Arc::new(document.scene().unwrap().clone())));
        let mut listed = Listed::default();
        let mut pictures = 0;
        for _ in 0..400 {
            let picture = runner.frame();
            runner.send(RunCommand::Step { dt: 0.01, count: 1 });
            let is_begun = listed.len() > 0;
            assert!(!is_begun || listed.past == *picture.ledger.past());
            listed.look(&picture.ledger, &Filter::default(), Order::default());
            assert_eq!(listed.rows(&picture.ledger).count(), picture.ledger.len());
            pictures += u32::from(is_begun && picture.events.is_empty());
        }
        assert!(pictures > 10, "there were events, and Δt without any");
    }

    /// Run by `cargo test --release --features inspection --lib million -- --ignored --nocapture`.
    #[test]
    #[ignore = "it measures time, which the tests' build and busy machines do not give"]
    fn a_million_rows_take_milliseconds_in_each_repaint() {
        let ledger = ledger(1_000_000);
        for (name, order) in
            [("as they come", Order::default()), ("by impulse", Order { column: BY_IMPULSE, falling: true })]
        {
            let mut listed = Listed::default();
            let mut longest = 0.0_f64;
            loop {
                let start = Instant::now();
                let more = listed.look(&ledger, &Filter::default(), order);
                longest = longest.max(start.elapsed().as_secs_f64());
                if !more {
                    break;
                }
            }
            assert!(longest < 0.016, "{name}: {} ms", 1e3 * longest);
        }
    }
}
