//! Which dynamic bodies lie in which tile.

use rustc_hash::FxHashMap;

use super::bricks::{BRICK_TILES, BrickTile, for_each_brick, slots};
use super::grid::{Grid, TileRange};

/// Lists of dynamic bodies by tile; only bricks with bodies in them are stored. A list is a chain of small
/// blocks out of one array.
#[derive(Clone, Debug, Default)]
pub(in crate::sim) struct DynamicTiles {
    by_key: FxHashMap<u64, u32>,
    bricks: Vec<Brick>,
    blocks: Vec<Block>,
    /// Bricks and blocks to be used again.
    free_bricks: Vec<u32>,
    free_blocks: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Brick {
    /// Tiles with bodies in them.
    occupied: u64,
    /// First block of each occupied tile.
    chains: [u32; BRICK_TILES],
}

/// Bodies in a block: with them it fills half a cache line.
const BLOCK: usize = 6;
const NONE: u32 = u32::MAX;

/// Some of the bodies of a tile. Only the first block of a chain may have room left.
#[derive(Clone, Debug)]
#[repr(align(32))]
struct Block {
    bodies: [u32; BLOCK],
    len: u32,
    next: u32,
}

impl DynamicTiles {
    pub fn insert(&mut self, grid: &Grid, range: TileRange, body: u32) {
        self.insert_except(grid, range, None, body);
    }

    /// Moves a body from one range to another, touching only tiles in one of them.
    pub fn change(&mut self, grid: &Grid, from: TileRange, to: TileRange, body: u32) {
        self.remove_except(grid, from, Some(to), body);
        self.insert_except(grid, to, Some(from), body);
    }

    pub fn remove(&mut self, grid: &Grid, range: TileRange, body: u32) {
        self.remove_except(grid, range, None, body);
    }

    /// Visits the bodies in tiles of `range` that are not in `except`, once for each such tile.
    pub fn visit(
        &self,
        grid: &Grid,
        range: TileRange,
        except: Option<TileRange>,
        mut visit: impl FnMut(u32),
    ) {
        for_each_brick(grid, range, except, |key, mask| self.visit_brick(key, mask, &mut visit));
    }

    fn visit_brick(&self, key: u64, mask: u64, visit: &mut impl FnMut(u32)) {
        self.blocks_of(key, mask, |block| {
            block.bodies.iter().take(block.len as usize).for_each(|body| visit(*body));
        });
    }

    /// Appends the bodies in tiles of one brick to a list, once for each such tile.
    #[inline]
    pub fn gather(&self, key: u64, mask: u64, list: &mut Vec<u32>) {
        self.blocks_of(key, mask, |block| {
            // A block is copied as a whole: how full it is nobody can foretell.
            list.extend_from_slice(&block.bodies);
            list.truncate(list.len() - (BLOCK - block.len as usize));
        });
    }

    #[inline]
    fn blocks_of(&self, key: u64, mask: u64, mut visit: impl FnMut(&Block)) {
        let Some(index) = self.by_key.get(&key) else { return };
        let brick = &self.bricks[*index as usize];
        for slot in slots(mask & brick.occupied) {
            let mut next = brick.chains[slot];
            while next != NONE {
                let block = &self.blocks[next as usize];
                visit(block);
                next = block.next;
            }
        }
    }

    /// The bodies in one tile.
    pub fn bodies(&self, grid: &Grid, tile: [u32; 3]) -> Vec<u32> {
        let mut bodies = Vec::new();
        self.visit(grid, TileRange { low: tile, high: tile }, None, |body| bodies.push(body));
        bodies
    }

    /// The occupied tiles, sorted.
    pub fn occupied(&self, grid: &Grid) -> Vec<[u32; 3]> {
        let mut tiles = Vec::new();
        #[allow(clippy::iter_over_hash_type, reason = "they are sorted")]
        for (brick, index) in &self.by_key {
            let occupied = slots(self.bricks[*index as usize].occupied);
            tiles.extend(occupied.map(|slot| BrickTile { brick: *brick, slot }.tile(grid)));
        }
        tiles.sort_unstable();
        tiles
    }

    fn insert_except(&mut self, grid: &Grid, range: TileRange, except: Option<TileRange>, body: u32) {
        for_each_brick(grid, range, except, |key, mask| {
            let (bricks, free) = (&mut self.bricks, &mut self.free_bricks);
            let empty = Brick { occupied: 0, chains: [NONE; BRICK_TILES] };
            let index = *self.by_key.entry(key).or_insert_with(|| place(bricks, free, empty));
            let brick = &mut self.bricks[index as usize];
            brick.occupied |= mask;
            for slot in slots(mask) {
                let chain = &mut brick.chains[slot];
                match self.blocks.get_mut(*chain as usize) {
                    Some(block) if (block.len as usize) < BLOCK => {
                        block.bodies[block.len as usize] = body;
                        block.len += 1;
                    }
                    _ => {
                        let mut block = Block { bodies: [NONE; BLOCK], len: 1, next: *chain };
                        block.bodies[0] = body;
                        *chain = place(&mut self.blocks, &mut self.free_blocks, block);
                    }
                }
            }
        });
    }

    fn remove_except(&mut self, grid: &Grid, range: TileRange, except: Option<TileRange>, body: u32) {
        for_each_brick(grid, range, except, |key, mask| {
            let Some(index) = self.by_key.get(&key).copied() else { return };
            for slot in slots(mask & self.bricks[index as usize].occupied) {
                self.remove_from_tile(index, slot, body);
            }
            if self.bricks[index as usize].occupied == 0 {
                self.by_key.remove(&key);
                self.free_bricks.push(index);
            }
        });
    }

    /// Puts the last body of the chain's first block in the place of the one removed.
    fn remove_from_tile(&mut self, brick: u32, slot: usize, body: u32) {
        let brick = &mut self.bricks[brick as usize];
        let first = brick.chains[slot];
        let mut at = first;
        while at != NONE {
            let block = &self.blocks[at as usize];
            let found = block.bodies.iter().take(block.len as usize).position(|other| *other == body);
            let Some(place) = found else {
                at = block.next;
                continue;
            };
            let head = &mut self.blocks[first as usize];
            head.len -= 1;
            let (last, left, next) = (head.bodies[head.len as usize], head.len, head.next);
            self.blocks[at as usize].bodies[place] = last;
            if left == 0 {
                brick.chains[slot] = next;
                self.free_blocks.push(first);
            }
            if brick.chains[slot] == NONE {
                brick.occupied &= !(1 << slot);
            }
            return;
        }
    }
}

/// Puts an item in a free place, or at the end; gives where.
fn place<T>(items: &mut Vec<T>, free: &mut Vec<u32>, item: T) -> u32 {
    match free.pop() {
        Some(index) => {
            items[index as usize] = item;
            index
        }
        None => {
            items.push(item);
            items.len() as u32 - 1
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use glam::DVec3;

    use super::*;
    use crate::random::Random;
    use crate::scene::Map;

    /// Random moves of many bodies in a few tiles, against sets by tile.
    #[test]
    fn lists_are_those_of_sets_by_tile() {
        let grid = Grid::new(&Map { size: DVec3::ONE, tiles: [6, 5, 9] }, 0.0);
        let mut source = Random::new(1);
        let mut random = move |below: u32| source.below(below as usize) as u32;
        let mut range = || {
            let low = grid.counts.map(&mut random);
            let high = std::array::from_fn(|axis| (low[axis] + random(3)).min(grid.counts[axis] - 1));
            (TileRange { low, high }, random(60))
        };
        let mut tiles = DynamicTiles::default();
        let mut places: BTreeMap<u32, TileRange> = BTreeMap::new();
        for round in 0..3000 {
            let (to, body) = range();
            match places.insert(body, to) {
                None => tiles.insert(&grid, to, body),
                Some(from) if round % 3 > 0 => tiles.change(&grid, from, to, body),
                Some(from) => {
                    tiles.remove(&grid, from, body);
                    places.remove(&body);
                }
            }
            let mut expected: BTreeMap<[u32; 3], BTreeSet<u32>> = BTreeMap::new();
            for (body, place) in &places {
                place.tiles().for_each(|tile| {
                    expected.entry(tile).or_default().insert(*body);
                });
            }
            assert_eq!(tiles.occupied(&grid), expected.keys().copied().collect::<Vec<_>>());
            for (tile, bodies) in &expected {
                let mut got = tiles.bodies(&grid, *tile);
                got.sort_unstable();
                assert_eq!(got, bodies.iter().copied().collect::<Vec<_>>(), "in {tile:?}, round {round}");
            }
        }
        for (body, place) in places {
            tiles.remove(&grid, place, body);
        }
        assert!(tiles.by_key.is_empty());
        assert_eq!(tiles.free_blocks.len(), tiles.blocks.len(), "every block is given back");
    }
}
