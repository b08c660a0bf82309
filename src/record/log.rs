//! How all bodies moved: one log of their pieces in the order begun, written one after the other. A piece knows the one
//! before it of its body, and a block the last one of every body, so that nothing is sorted into place while it is written.

use std::collections::VecDeque;
use std::sync::Arc;

use super::moment::Moment;
use crate::sim::{Begun, BodyRef, Piece};

/// A piece with the event from which on its body is seen to follow it, and the body's piece before.
#[derive(Clone, Debug)]
pub(super) struct Noted {
    piece: Piece,
    event: u64,
    before: Address,
    body: u32,
    by_event: bool,
}

/// Where a piece stands: the number of the block, those dropped included, and the place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Address {
    block: u32,
    place: u32,
}

/// Pieces of one block at least; in a scene of more bodies as many as there are, so that the list of their last ones, of
/// which each block has one, takes a share of the memory only.
const SMALLEST_BLOCK: usize = 512;

/// Some pieces in order, and the last one of every body before them.
#[derive(Clone, Debug, Default)]
struct Block {
    pieces: Vec<Noted>,
    last_before: Vec<Address>,
    /// How many pieces it takes.
    size: usize,
}

/// An event and a time, each for itself.
#[derive(Clone, Copy, Debug)]
struct Bound {
    event: u64,
    time: f64,
}

/// Bodies that are stepped in turn begin pieces out of the order of time: what is nowhere undercut from a block on, and
/// nowhere exceeded up to it.
#[derive(Clone, Copy, Debug)]
struct Span {
    least: Bound,
    greatest: Bound,
}

/// The pieces of each body in the order begun, so that both their events and their starts only grow. Copies share all
/// blocks but the last.
#[derive(Clone, Debug, Default)]
pub(super) struct Log {
    full: VecDeque<Arc<Block>>,
    open: Block,
    /// Of the full blocks, then of the open one, if it has any.
    spans: VecDeque<Span>,
    /// The last piece of every body.
    last: Vec<Address>,
    /// How many blocks were dropped, and the pieces of them that bodies still followed.
    dropped: u32,
    kept: Arc<Vec<Option<Noted>>>,
    /// Pieces ever noted, those dropped included.
    count: u64,
    bytes: usize,
}

/// A moment in the log, found once for all bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Then<'a> {
    log: &'a Log,
    /// The last pieces that may have begun.
    last: &'a [Address],
    moment: Moment,
}

impl Noted {
    fn from(&self) -> Moment {
        Moment { event: self.event, time: self.piece.start(), is_over: !self.by_event }
    }

    fn is_not_after(&self, moment: Moment) -> bool {
        self.from().is_not_after(moment)
    }

    /// Bytes that it takes.
    pub(super) fn bytes(&self) -> usize {
        Self::bytes_with(&self.piece)
    }

    fn bytes_with(piece: &Piece) -> usize {
        size_of::<Self>() - size_of::<Piece>() + piece.bytes()
    }
}

impl<'a> Then<'a> {
    fn noted(&self, body: u32) -> Option<&'a Noted> {
        let mut noted = self.log.get(body, *self.last.get(body as usize)?)?;
        while !noted.is_not_after(self.moment) {
            noted = self.log.get(body, noted.before)?;
        }
        Some(noted)
    }

    /// The piece that a body follows.
    pub(super) fn piece(&self, body: BodyRef) -> Option<&'a Piece> {
        let BodyRef::Dynamic(body) = body else { return None };
        Some(&self.noted(body)?.piece)
    }
}

impl Address {
    const NONE: Self = Self { block: u32::MAX, place: u32::MAX };
}

impl Bound {
    const LATEST: Self = Self { event: u64::MAX, time: f64::INFINITY };

    fn of(noted: &Noted) -> Self {
        Self { event: noted.event, time: noted.piece.start() }
    }

    fn min(self, other: Self) -> Self {
        Self { event: self.event.min(other.event), time: self.time.min(other.time) }
    }

    fn max(self, other: Self) -> Self {
        Self { event: self.event.max(other.event), time: self.time.max(other.time) }
    }

    /// Whether what begins here can have begun at a moment.
    fn may_be_before(self, moment: Moment) -> bool {
        self.event <= moment.event && self.time <= moment.time
    }

    /// Whether all that begins up to here has begun at a moment.
    fn is_surely_before(self, moment: Moment) -> bool {
        self.may_be_before(moment) && (self.event < moment.event || self.time < moment.time)
    }
}

impl Log {
    /// Pieces ever noted, those dropped included.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Notes a piece that a body has begun.
    pub(super) fn note(&mut self, begun: Begun) {
        let BodyRef::Dynamic(body) = begun.body else { return };
        let Begun { event, by_event, piece, .. } = begun;
        let before = self.enter(body, Bound { event, time: piece.start() }, Noted::bytes_with(&piece));
        self.open.pieces.push(Noted { piece, event, before, body, by_event });
    }

    fn push(&mut self, noted: Noted) {
        let before = self.enter(noted.body, Bound::of(&noted), noted.bytes());
        self.open.pieces.push(Noted { before, ..noted });
    }

    /// Makes room for the next piece of a body, which begins at a bound and takes so many bytes; gives the one before.
    fn enter(&mut self, body: u32, bound: Bound, bytes: usize) -> Address {
        if self.open.pieces.len() >= self.open.size {
            self.begin_block();
        }
        let body = body as usize;
        if self.last.len() <= body {
            self.last.resize(body + 1, Address::NONE);
        }
        self.widen(bound);
        let here =
            Address { block: self.dropped + self.full.len() as u32, place: self.open.pieces.len() as u32 };
        self.count += 1;
        self.bytes += bytes;
        std::mem::replace(&mut self.last[body], here)
    }

    /// Makes the open block a full one, and begins another.
    fn begin_block(&mut self) {
        let size = SMALLEST_BLOCK.max(self.last.len());
        // Many scenes never need more than one.
        let reserved = if self.count == 0 { 0 } else { size };
        let next = Block { pieces: Vec::with_capacity(reserved), last_before: self.last.clone(), size };
        let block = std::mem::replace(&mut self.open, next);
        self.bytes += size_of_val(&*self.open.last_before);
        if block.size > 0 {
            self.full.push_back(Arc::new(block));
        }
    }

    /// The open block reaches to a bound.
    fn widen(&mut self, bound: Bound) {
        if self.spans.len() <= self.full.len() {
            let greatest = self.spans.back().map_or(bound, |span| span.greatest);
            self.spans.push_back(Span { least: Bound::LATEST, greatest });
        }
        if let Some(span) = self.spans.back_mut() {
            span.greatest = span.greatest.max(bound);
        }
        for span in self.spans.iter_mut().rev() {
            if span.least.event <= bound.event && span.least.time <= bound.time {
                break;
            }
            span.least = span.least.min(bound);
        }
    }

    fn block(&self, nth: usize) -> &Block {
        self.full.get(nth).map_or(&self.open, |block| block)
    }

    /// A piece of a body; of those dropped the one that it followed last.
    fn get(&self, body: u32, at: Address) -> Option<&Noted> {
        match at.block.checked_sub(self.dropped) {
            _ if at == Address::NONE => None,
            Some(nth) => self.block(nth as usize).pieces.get(at.place as usize),
            None => self.kept.get(body as usize)?.as_ref(),
        }
    }

    /// What all bodies follow at a moment.
    pub(super) fn at(&self, moment: Moment) -> Then<'_> {
        // Everything in later blocks begins after the moment.
        let blocks = self.spans.partition_point(|span| span.least.may_be_before(moment));
        let last = match self.full.get(blocks) {
            Some(next) => &next.last_before,
            None if blocks == self.full.len() && blocks < self.spans.len() => &self.open.last_before,
            None => &self.last,
        };
        Then { log: self, last, moment }
    }

    /// Pieces that a body follows from one moment to another, in order.
    pub(super) fn between(&self, body: BodyRef, from: Moment, to: Moment) -> impl Iterator<Item = &Piece> {
        let mut pieces = Vec::new();
        if let BodyRef::Dynamic(body) = body {
            let mut next = self.at(to).noted(body);
            while let Some(noted) = next {
                pieces.push(&noted.piece);
                let goes_on = !noted.is_not_after(from);
                next = if goes_on { self.get(body, noted.before) } else { None };
            }
        }
        pieces.into_iter().rev()
    }

    /// Takes the pieces after a moment.
    pub(super) fn split_off(&mut self, moment: Moment) -> Vec<Noted> {
        let sure = self.spans.partition_point(|span| span.greatest.is_surely_before(moment));
        let mut popped = Vec::new();
        while self.full.len() >= sure
            && let Some(noted) = self.pop()
        {
            popped.push(noted);
        }
        popped.reverse();
        let (kept, rest) = popped.into_iter().partition(|noted: &Noted| noted.is_not_after(moment));
        self.append(kept);
        rest
    }

    pub(super) fn append(&mut self, pieces: Vec<Noted>) {
        pieces.into_iter().for_each(|noted| self.push(noted));
    }

    /// Drops the newest pieces until so many were ever noted.
    pub(super) fn truncate(&mut self, count: u64) {
        while self.count > count && self.pop().is_some() {}
    }

    /// Takes the newest piece.
    fn pop(&mut self) -> Option<Noted> {
        let noted = self.open.pieces.pop()?;
        self.last[noted.body as usize] = noted.before;
        self.count -= 1;
        self.bytes -= noted.bytes();
        if self.open.pieces.is_empty() {
            self.spans.pop_back();
            self.bytes -= size_of_val(&*self.open.last_before);
            self.open = self.full.pop_back().map(Arc::unwrap_or_clone).unwrap_or_default();
        }
        Some(noted)
    }

    /// Drops full blocks of pieces that begin before a time, but what bodies follow at their end.
    pub(super) fn drop_before(&mut self, time: f64) {
        let old = self.spans.partition_point(|span| span.greatest.time < time).min(self.full.len());
        let kept = Arc::make_mut(&mut self.kept);
        kept.resize(kept.len().max(self.last.len()), None);
        for block in self.full.drain(..old).map(Arc::unwrap_or_clone) {
            self.bytes -= size_of_val(&*block.last_before);
            for noted in block.pieces {
                let body = noted.body as usize;
                let replaced = kept[body].replace(Noted { before: Address::NONE, ..noted });
                self.bytes -= replaced.map_or(0, |replaced| replaced.bytes());
            }
        }
        self.spans.drain(..old);
        self.dropped += old as u32;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

    use super::*;
    use crate::sim::Simulation;

    const BODIES: u32 = 7;

    /// Knuth's linear congruential generator: numbers without a pattern that the test could have in common with the log.
    struct Random(u64);

    impl Random {
        fn below(&mut self, count: u64) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) % count
        }
    }

    /// What is compared: a body's pieces, each with its moment, in one list of its own.
    type Naive = Vec<(u32, Moment)>;

    fn a_piece() -> Piece {
        let document = crate::scene::Document::from_bytes(include_bytes!("../../scenes/bounce.xml"));
        let mut simulation = Simulation::new(document.scene().unwrap()).unwrap();
        let mut pieces = Vec::new();
        simulation.trace_motion();
        simulation.take_motion(|begun| pieces.push(begun.piece));
        pieces.swap_remove(0)
    }

    fn noted(piece: &Piece, body: u32, from: Moment) -> Noted {
        let piece = piece.starting_at(from.time);
        Noted { piece, event: from.event, before: Address::NONE, body, by_event: !from.is_over }
    }

    /// Notes more pieces: bodies go on in turn, and some begin theirs ahead of the time of the others.
    fn go_on(log: &mut Log, naive: &mut Naive, random: &mut Random, count: u32, piece: &Piece) {
        for _ in 0..count {
            let body = random.below(u64::from(BODIES) - 1) as u32;
            let latest = naive.iter().map(|(_, from)| from.event).max().unwrap_or(0);
            let own = naive.iter().rev().find(|(other, _)| *other == body).map_or(0.0, |(_, from)| from.time);
            let event = latest + random.below(2);
            let time = own.max(event as f64) + random.below(3) as f64;
            let from = Moment { event, time, is_over: false };
            log.push(noted(piece, body, from));
            naive.push((body, from));
        }
    }

    fn check(log: &Log, naive: &Naive, moments: impl Iterator<Item = Moment>) {
        for moment in moments {
            for body in 0..BODIES {
                let expected =
                    naive.iter().rev().find(|(other, from)| *other == body && from.is_not_after(moment));
                let found = log.at(moment).noted(body).map(|noted| (body, noted.from()));
                assert_eq!(found, expected.copied(), "of body {body} at {moment:?}");
            }
        }
    }

    fn moments(naive: &Naive) -> impl Iterator<Item = Moment> + use<> {
        let last = naive.last().map_or(0.0, |(_, from)| from.time);
        (0..40).map(move |nth| {
            let time = (last * f64::from(nth) / 38.0).floor();
            Moment::after_all(time as u64, time)
        })
    }

    #[test]
    fn a_log_finds_what_a_list_of_all_pieces_does() {
        let (piece, mut random) = (a_piece(), Random(3));
        let (mut log, mut naive) = (Log::default(), Naive::new());
        go_on(&mut log, &mut naive, &mut random, 3000, &piece);
        check(&log, &naive, moments(&naive));
        assert_eq!(log.count(), 3000);
    }

    #[test]
    fn what_is_split_off_comes_back() {
        let (piece, mut random) = (a_piece(), Random(4));
        let (mut log, mut naive) = (Log::default(), Naive::new());
        go_on(&mut log, &mut naive, &mut random, 3000, &piece);
        let bytes = log.bytes();
        for part in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let last = naive.last().unwrap().1.time;
            let at = Moment::after_all((part * last) as u64, (part * last).floor());
            let rest = log.split_off(at);
            let kept: Naive = naive.iter().filter(|(_, from)| from.is_not_after(at)).copied().collect();
            assert_eq!(log.count() as usize, kept.len());
            check(&log, &kept, moments(&naive));
            let (before, mut other) = (log.count(), kept.clone());
            go_on(&mut log, &mut other, &mut random, 700, &piece);
            check(&log, &other, moments(&other));
            log.truncate(before);
            log.append(rest);
            check(&log, &naive, moments(&naive));
        }
        assert!(log.bytes().abs_diff(bytes) < bytes / 100, "{} of {bytes} bytes", log.bytes());
    }

    #[test]
    fn dropping_the_oldest_leaves_what_bodies_follow() {
        let (piece, mut random) = (a_piece(), Random(5));
        let (mut log, mut naive) = (Log::default(), Naive::new());
        // A body that never goes on after its first piece.
        let first = (BODIES - 1, Moment::default());
        log.push(noted(&piece, first.0, first.1));
        naive.push(first);
        go_on(&mut log, &mut naive, &mut random, 4000, &piece);
        let (copy, bytes) = (log.clone(), log.bytes());
        for part in [0.3, 0.6] {
            let time = part * naive.last().unwrap().1.time;
            log.drop_before(time);
            check(&log, &naive, moments(&naive).filter(|moment| moment.time >= time));
        }
        assert!(log.bytes() < bytes / 2, "{} of {bytes} bytes", log.bytes());
        check(&copy, &naive, moments(&naive));
    }

    #[test]
    fn a_way_is_the_pieces_between_two_moments() {
        let (piece, mut random) = (a_piece(), Random(6));
        let (mut log, mut naive) = (Log::default(), Naive::new());
        go_on(&mut log, &mut naive, &mut random, 2000, &piece);
        let last = naive.last().unwrap().1.time;
        let [from, to] = [0.3 * last, 0.7 * last].map(|time| Moment::after_all(time as u64, time.floor()));
        for body in 0..BODIES - 1 {
            let own = || naive.iter().filter(|(other, _)| *other == body).map(|(_, from)| *from);
            let first = own().filter(|begun| begun.is_not_after(from)).count() - 1;
            let expected: Vec<f64> =
                own().skip(first).filter(|begun| begun.is_not_after(to)).map(|begun| begun.time).collect();
            let found: Vec<f64> = log.between(BodyRef::Dynamic(body), from, to).map(Piece::start).collect();
            assert_eq!(found, expected);
        }
    }
}
