//! How one body moved: its pieces of motion in order.

use std::collections::VecDeque;
use std::sync::Arc;

use super::moment::Moment;
use crate::sim::Piece;

/// A piece and the moment from which on the body is seen to follow it.
#[derive(Clone, Debug)]
pub(super) struct Noted {
    pub(super) from: Moment,
    pub(super) piece: Piece,
}

impl Noted {
    fn is_not_after(&self, moment: Moment) -> bool {
        self.from.is_not_after(moment)
    }
}

/// Pieces of one block, which are dropped together.
const BLOCK: usize = 64;

/// Pieces in the order begun, so that both their events and their starts only grow. Copies share their blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    blocks: VecDeque<Arc<Vec<Noted>>>,
    /// How many there were, those dropped included.
    count: u64,
}

impl Track {
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    pub(super) fn push(&mut self, noted: Noted) {
        self.count += 1;
        match self.blocks.back_mut() {
            Some(block) if block.len() < BLOCK => Arc::make_mut(block).push(noted),
            // Most bodies of large scenes have few pieces; one with many will have more.
            _ => {
                let mut block = Vec::with_capacity(if self.blocks.is_empty() { 1 } else { BLOCK });
                block.push(noted);
                self.blocks.push_back(Arc::new(block));
            }
        }
    }

    /// The piece that the body follows at a moment.
    pub(super) fn at(&self, moment: Moment) -> Option<&Piece> {
        let (block, after) = self.place_after(moment);
        Some(&self.blocks.get(block)?.get(after.checked_sub(1)?)?.piece)
    }

    /// Pieces that the body follows from one moment to another, in order.
    pub(super) fn between(&self, from: Moment, to: Moment) -> impl Iterator<Item = &Piece> {
        let (block, after) = self.place_after(from);
        let first = after.saturating_sub(1);
        let rest = self.blocks.iter().enumerate().skip(block);
        let pieces = rest.flat_map(move |(nth, pieces)| {
            pieces.get(if nth == block { first } else { 0 }..).unwrap_or_default()
        });
        pieces.take_while(move |noted| noted.is_not_after(to)).map(|noted| &noted.piece)
    }

    /// The block that a moment lies in, and how many of its pieces are not after it: none only before the first of all.
    fn place_after(&self, moment: Moment) -> (usize, usize) {
        let begun = |block: &Arc<Vec<Noted>>| block.first().is_some_and(|first| first.is_not_after(moment));
        let after = self.blocks.partition_point(begun);
        let Some(block) = after.checked_sub(1) else { return (0, 0) };
        let inside =
            self.blocks.get(block).map_or(0, |pieces| pieces.partition_point(|p| p.is_not_after(moment)));
        (block, inside)
    }

    /// Takes the pieces after a moment.
    pub(super) fn split_off(&mut self, moment: Moment) -> Vec<Noted> {
        let (block, inside) = self.place_after(moment);
        let Some(pieces) = self.blocks.get_mut(block) else { return Vec::new() };
        let mut rest = Arc::make_mut(pieces).split_off(inside);
        rest.extend(self.blocks.drain(block + 1..).flat_map(Arc::unwrap_or_clone));
        if self.blocks.back().is_some_and(|block| block.is_empty()) {
            self.blocks.pop_back();
        }
        self.count -= rest.len() as u64;
        rest
    }

    /// Drops the newest pieces until so many are left; gives the bytes that were freed.
    pub(super) fn truncate(&mut self, count: u64) -> usize {
        let mut freed = 0;
        while self.count > count
            && let Some(noted) = self.blocks.back_mut().and_then(|block| Arc::make_mut(block).pop())
        {
            freed += bytes_of(&noted);
            self.count -= 1;
            if self.blocks.back().is_some_and(|block| block.is_empty()) {
                self.blocks.pop_back();
            }
        }
        freed
    }

    pub(super) fn append(&mut self, rest: Vec<Noted>) {
        rest.into_iter().for_each(|noted| self.push(noted));
    }

    /// Drops whole blocks of pieces that ended before a time; gives the bytes that were freed.
    pub(super) fn drop_before(&mut self, time: f64) -> usize {
        let mut freed = 0;
        while self.blocks.get(1).and_then(|next| next.first()).is_some_and(|next| next.piece.start() <= time)
        {
            let block = self.blocks.pop_front();
            freed += block.iter().flat_map(|block| block.iter()).map(bytes_of).sum::<usize>();
        }
        freed
    }
}

/// Bytes that a piece takes in a track.
pub(super) fn bytes_of(noted: &Noted) -> usize {
    size_of::<Noted>() - size_of::<Piece>() + noted.piece.bytes()
}
