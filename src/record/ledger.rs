//! The ledger of a whole run: every event with the names a person knows. Copies share all blocks of rows but the last, so that a
//! million rows go into a frame at the price of a few.

use std::sync::{Arc, OnceLock};

use super::cost::Cost;
use crate::scene::NodeKey;
use crate::sim::{BodyRef, Event, EventKind, Simulation};

/// One ledger row with the names a person knows.
#[derive(Clone, Debug, PartialEq)]
pub struct EventRow {
    pub event: Event,
    pub a_key: NodeKey,
    pub b_key: Option<NodeKey>,
    pub a_label: Arc<str>,
    /// Empty for events of one body alone.
    pub b_label: Arc<str>,
}

impl EventRow {
    fn new(names: &Names, event: &Event) -> Self {
        let (a_key, a_label) = names.get(event.a);
        let b = event.b.map(|b| names.get(b));
        let b_key = b.as_ref().map(|(key, _)| *key);
        Self { event: *event, a_key, b_key, a_label, b_label: b.map(|(_, label)| label).unwrap_or_default() }
    }

    /// Numbers of the first and the last row of the impact that this one belongs to.
    pub fn rows(&self) -> (u64, u64) {
        let [nth, of] = self.event.row_in_group.map(u64::from);
        (self.event.seq - nth.saturating_sub(1), self.event.seq + of.saturating_sub(nth))
    }

    /// Energy that the impact left the bodies with, less what they came with, J, ≤ 0 but for rounding: of an impulse J
    /// along the normal ½ J (v⁻ + v⁺), with the normal speeds before and after.
    pub fn energy_change(&self) -> Option<f64> {
        Self::energy_change_of(&self.event)
    }

    pub fn energy_change_of(event: &Event) -> Option<f64> {
        let is_impact = matches!(event.kind, EventKind::Impact | EventKind::Collapse);
        is_impact.then_some(0.5 * event.impulse * (event.vn_before + event.vn_after))
    }
}

/// Keys and labels of all bodies, by their numbers.
#[derive(Debug, Default)]
pub(super) struct Names {
    dynamic: Vec<(NodeKey, Arc<str>)>,
    statics: Vec<(NodeKey, Arc<str>)>,
}

impl Names {
    pub(super) fn of(simulation: &Simulation) -> Self {
        let name = |body| (simulation.key(body), Arc::from(simulation.label(body)));
        let (dynamic, statics) = simulation.body_numbers();
        Self {
            dynamic: dynamic.map(BodyRef::Dynamic).map(name).collect(),
            statics: statics.map(BodyRef::Static).map(name).collect(),
        }
    }

    fn find(&self, body: BodyRef) -> Option<&(NodeKey, Arc<str>)> {
        match body {
            BodyRef::Dynamic(number) => self.dynamic.get(number as usize),
            BodyRef::Static(number) => self.statics.get(number as usize),
        }
    }

    fn get(&self, body: BodyRef) -> (NodeKey, Arc<str>) {
        self.find(body).cloned().unwrap_or_default()
    }

    fn key(&self, body: BodyRef) -> NodeKey {
        self.find(body).map_or_else(NodeKey::default, |(key, _)| *key)
    }
}

/// Rows of one block: what a copy does not share.
const BLOCK: usize = 512;

/// Events as they come, and the rows with their names, each made when it is asked for first. Room for rows is made for the first of
/// them: to write down that there are none would cost as much as a part of the event.
#[derive(Clone, Debug, Default)]
struct Block {
    events: Vec<Event>,
    costs: Vec<Cost>,
    rows: OnceLock<Rows>,
    names: Arc<Names>,
}

/// A row that is taken away, with what it took.
pub(super) type Tail = (Arc<EventRow>, Cost);

type Rows = Box<[OnceLock<Arc<EventRow>>]>;

impl Block {
    fn new(names: Arc<Names>) -> Self {
        let (events, costs) = (Vec::with_capacity(BLOCK), Vec::with_capacity(BLOCK));
        Self { events, costs, rows: OnceLock::new(), names }
    }

    fn rows(&self) -> &Rows {
        self.rows.get_or_init(|| (0..BLOCK).map(|_| OnceLock::new()).collect())
    }

    fn row(&self, nth: usize) -> Option<&Arc<EventRow>> {
        let event = self.events.get(nth)?;
        Some(self.rows().get(nth)?.get_or_init(|| Arc::new(EventRow::new(&self.names, event))))
    }

    /// Keys of the bodies of an event, without making its row.
    fn keys(&self, nth: usize) -> Option<(NodeKey, Option<NodeKey>)> {
        let event = self.events.get(nth)?;
        let made = self.rows.get().and_then(|rows| rows.get(nth)?.get()).map(|row| (row.a_key, row.b_key));
        Some(made.unwrap_or_else(|| (self.names.key(event.a), event.b.map(|b| self.names.key(b)))))
    }

    fn truncate(&mut self, len: usize) {
        self.events.truncate(len);
        self.costs.truncate(len);
        if let Some(rows) = self.rows.get_mut() {
            rows.iter_mut().skip(len).for_each(|row| drop(row.take()));
        }
    }
}

/// Which past a ledger has. While it is the same one, rows that were there once stay what they are.
#[derive(Clone, Debug, Default)]
pub struct Past(Arc<()>);

impl PartialEq for Past {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Rows in the order of their numbers, without a gap.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    /// Full blocks, then the one that is written to: not shared, since looking whether anyone else reads it would wait for all
    /// that was written just before.
    blocks: Vec<Arc<Block>>,
    open: Block,
    len: usize,
    /// Of the events that are noted from now on.
    names: Arc<Names>,
    past: Past,
}

impl FromIterator<EventRow> for Ledger {
    /// Rows in the order of their numbers, without a gap.
    fn from_iter<I: IntoIterator<Item = EventRow>>(rows: I) -> Self {
        let mut ledger = Self::default();
        rows.into_iter().for_each(|row| ledger.push((Arc::new(row), Cost::default())));
        ledger
    }
}

impl Ledger {
    /// An empty one for the events of a simulation.
    pub(super) fn of(simulation: &Simulation) -> Self {
        Self { names: Arc::new(Names::of(simulation)), ..Self::default() }
    }

    pub(super) fn names(&self) -> &Arc<Names> {
        &self.names
    }

    /// Other names for events that are noted from now on.
    pub(super) fn rename(&mut self, names: Arc<Names>) {
        (0..self.open.events.len()).for_each(|nth| _ = self.open.row(nth));
        self.open.names = names.clone();
        self.names = names;
    }

    pub fn len(&self) -> usize {
        self.len
    }

    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Number of the first row kept; 1 while nothing was dropped, and for an empty ledger.
    pub fn first(&self) -> u64 {
        self.block(0).and_then(|block| block.events.first()).map_or(1, |event| event.seq)
    }

    pub fn past(&self) -> &Past {
        &self.past
    }

    fn block(&self, nth: usize) -> Option<&Block> {
        let open = (nth == self.blocks.len()).then_some(&self.open);
        self.blocks.get(nth).map(|block| &**block).or(open)
    }

    /// The n-th row that is kept.
    pub fn at(&self, index: usize) -> Option<&Arc<EventRow>> {
        self.block(index / BLOCK)?.row(index % BLOCK)
    }

    /// The keys of the bodies of the n-th row that is kept. Unlike a row, they and [`Self::event_at`] take no memory.
    pub fn keys_at(&self, index: usize) -> Option<(NodeKey, Option<NodeKey>)> {
        self.block(index / BLOCK)?.keys(index % BLOCK)
    }

    /// The event of the n-th row that is kept.
    pub fn event_at(&self, index: usize) -> Option<&Event> {
        self.block(index / BLOCK)?.events.get(index % BLOCK)
    }

    /// What the event of this number took. It is no part of the event: it depends on the tiles.
    pub fn cost(&self, number: u64) -> Option<Cost> {
        let index = self.index_of(number)?;
        self.block(index / BLOCK)?.costs.get(index % BLOCK).copied()
    }

    /// The row of an event's number.
    pub fn get(&self, number: u64) -> Option<&Arc<EventRow>> {
        self.at(self.index_of(number)?)
    }

    /// Where the row of an event's number lies, or would.
    fn index_of(&self, number: u64) -> Option<usize> {
        usize::try_from(number.checked_sub(self.first())?).ok()
    }

    /// Rows from the n-th that is kept on.
    pub fn iter_from(&self, index: usize) -> impl DoubleEndedIterator<Item = &Arc<EventRow>> {
        (index..self.len).filter_map(|nth| self.at(nth))
    }

    /// How many rows happened before a time, or not after it.
    pub fn count_before(&self, time: f64) -> usize {
        self.count_while(|event| event.time < time)
    }

    pub fn count_until(&self, time: f64) -> usize {
        self.count_while(|event| event.time <= time)
    }

    /// How many rows happened before each of many times in ascending order.
    pub fn counts_before(&self, times: impl Iterator<Item = f64>) -> Vec<usize> {
        let mut first = 0;
        let mut count = |time: f64| {
            let is_before = |block: &Arc<Block>| block.events.last().is_some_and(|event| event.time < time);
            // In ever longer strides, for the next time is mostly near.
            let mut stride = 1;
            while self.blocks.get(first + stride - 1).is_some_and(is_before) {
                first += stride;
                stride *= 2;
            }
            let within = self.blocks.len().min(first + stride - 1);
            first += self.blocks[first..within].partition_point(is_before);
            let inside = |block: &Block| block.events.partition_point(|event| event.time < time);
            (first * BLOCK + self.block(first).map_or(0, inside)).min(self.len)
        };
        times.map(&mut count).collect()
    }

    /// How many of the first rows fulfil what no later one does after the first that does not.
    fn count_while(&self, holds: impl Fn(&Event) -> bool) -> usize {
        let before = self.blocks.partition_point(|block| block.events.last().is_some_and(&holds));
        let inside = self.block(before).map_or(0, |block| block.events.partition_point(&holds));
        (before * BLOCK + inside).min(self.len)
    }

    /// Number of the last event not after a time; 0, or that of the last dropped, before the first.
    pub(super) fn number_until(&self, time: f64) -> u64 {
        self.first() + self.count_until(time) as u64 - 1
    }

    /// Adds a row that is made already.
    fn push(&mut self, (row, cost): Tail) {
        self.note(&row.event, cost);
        let place = self.open.events.len() - 1;
        if let Some(free) = self.open.rows().get(place) {
            // It is the first there: what was taken away has left none.
            let _ = free.set(row);
        }
    }

    pub(super) fn note(&mut self, event: &Event, cost: Cost) {
        if self.len.is_multiple_of(BLOCK) {
            let full = std::mem::replace(&mut self.open, Block::new(self.names.clone()));
            if !full.events.is_empty() {
                self.blocks.push(Arc::new(full));
            }
        }
        self.open.events.push(*event);
        self.open.costs.push(cost);
        self.len += 1;
    }

    /// Takes the rows after an event.
    pub(super) fn split_off(&mut self, event: u64) -> Vec<Tail> {
        let kept =
            usize::try_from((event + 1).saturating_sub(self.first())).unwrap_or(usize::MAX).min(self.len);
        let costs = |row: &Arc<EventRow>| self.cost(row.event.seq).unwrap_or_default();
        let rows: Vec<Tail> = self.iter_from(kept).map(|row| (row.clone(), costs(row))).collect();
        if kept / BLOCK < self.blocks.len() {
            self.blocks.truncate(kept / BLOCK + 1);
            self.open = self.blocks.pop().map(Arc::unwrap_or_clone).unwrap_or_default();
        }
        self.open.truncate(kept % BLOCK);
        if !rows.is_empty() {
            self.past = Past::default();
        }
        self.len = kept;
        rows
    }

    pub(super) fn append(&mut self, rows: Vec<Tail>) {
        for row in rows {
            self.push(row);
        }
    }

    /// Drops whole blocks of rows before a time.
    pub(super) fn drop_before(&mut self, time: f64) {
        let old = |block: &Arc<Block>| block.events.last().is_some_and(|event| event.time < time);
        let last = usize::from(self.open.events.is_empty());
        let gone = self.blocks.partition_point(old).min(self.blocks.len().saturating_sub(last));
        self.blocks.drain(..gone);
        self.len -= gone * BLOCK;
    }

    /// Bytes that the rows take once all of them are made.
    pub(super) fn bytes(&self) -> usize {
        let row = size_of::<EventRow>() + 2 * size_of::<usize>();
        self.len * (size_of::<Event>() + size_of::<Cost>() + size_of::<OnceLock<Arc<EventRow>>>() + row)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

    use super::*;
    use crate::sim::BodyRef;

    fn row(seq: u64) -> EventRow {
        let event = Event::impact_of_one(seq, (seq / 2) as f64, BodyRef::Dynamic(0), 2.0);
        EventRow { event, a_key: NodeKey(1), b_key: None, a_label: "1".into(), b_label: Arc::default() }
    }

    fn ledger(count: u64) -> Ledger {
        (1..=count).map(row).collect()
    }

    #[test]
    fn rows_are_found_by_number_and_time() {
        let ledger = ledger(2000);
        for seq in [1, 2, 511, 512, 513, 1024, 1025, 2000] {
            assert_eq!(ledger.get(seq).unwrap().event.seq, seq);
        }
        assert!(ledger.get(0).is_none() && ledger.get(2001).is_none());
        for time in [0.0, 1.0, 1.5, 255.0, 256.0, 999.0, 1000.0, 5000.0] {
            let naive = (1..=2000).filter(|seq| (seq / 2) as f64 <= time).count();
            assert_eq!(ledger.count_until(time), naive, "at {time}");
            let naive = (1..=2000).filter(|seq| ((seq / 2) as f64) < time).count();
            assert_eq!(ledger.count_before(time), naive, "before {time}");
        }
        for times in [vec![-1.0, 0.0, 0.5, 1.0, 254.0, 700.0, 999.5, 1000.0, 2000.0], vec![3.0; 4]] {
            let each: Vec<usize> = times.iter().map(|time| ledger.count_before(*time)).collect();
            assert_eq!(ledger.counts_before(times.into_iter()), each);
        }
        assert_eq!(
            ledger.iter_from(700).map(|row| row.event.seq).collect::<Vec<_>>(),
            (701..=2000).collect::<Vec<_>>()
        );
    }

    #[test]
    fn a_copy_keeps_what_is_split_off_and_appended_again() {
        for kept in [0, 1, 511, 512, 513, 1999, 2000] {
            let mut ledger = ledger(2000);
            let copy = ledger.clone();
            let rest = ledger.split_off(kept);
            assert_eq!((ledger.len() as u64, rest.len() as u64), (kept, 2000 - kept));
            assert!(ledger.get(kept + 1).is_none());
            assert_eq!(copy.len(), 2000);
            assert_eq!(ledger.past() == copy.past(), kept == 2000, "what is taken away may come otherwise");
            ledger.append(rest);
            let numbers = |ledger: &Ledger| ledger.iter_from(0).map(|row| row.event.seq).collect::<Vec<_>>();
            assert_eq!(numbers(&ledger), numbers(&copy));
        }
    }

    #[test]
    fn what_is_dropped_leaves_the_numbers_of_the_others() {
        let mut ledger = ledger(2000);
        ledger.drop_before(600.0);
        assert_eq!(ledger.first(), 1025);
        assert_eq!(ledger.len(), 976);
        assert_eq!(ledger.get(1500).unwrap().event.seq, 1500);
        assert_eq!(ledger.number_until(0.0), 1024);
    }

    #[test]
    fn the_energy_change_is_that_of_newtons_law() {
        // 1 kg at 3 m/s against a wall that gives 1 m/s back: 0.5 (1 - 9) = -4 J with an impulse of 4 N s.
        let mut one = row(1);
        one.event.impulse = 4.0;
        assert_eq!(one.energy_change(), Some(-4.0));
    }
}
