//! Which dynamic bodies lie in which tile.

use rustc_hash::FxHashMap;

use super::{Grid, TileRange};

/// Lists of dynamic bodies by tile; only occupied tiles are stored.
#[derive(Clone, Debug, Default)]
pub(in crate::sim) struct MovingTiles {
    lists: FxHashMap<u64, Vec<u32>>,
    /// Emptied lists, to be used again.
    spare: Vec<Vec<u32>>,
}

/// As many emptied lists are kept as bodies can leave behind between two moves.
const MAX_SPARE: usize = 1024;

impl MovingTiles {
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

    pub fn bodies(&self, key: u64) -> &[u32] {
        self.lists.get(&key).map_or(&[], Vec::as_slice)
    }

    /// Keys of the occupied tiles, sorted.
    pub fn occupied(&self) -> Vec<u64> {
        let mut keys: Vec<u64> = self.lists.keys().copied().collect();
        keys.sort_unstable();
        keys
    }

    fn insert_except(&mut self, grid: &Grid, range: TileRange, except: Option<TileRange>, body: u32) {
        for tile in range.tiles().filter(|tile| !except.is_some_and(|other| other.contains(*tile))) {
            let spare = &mut self.spare;
            self.lists.entry(grid.key(tile)).or_insert_with(|| spare.pop().unwrap_or_default()).push(body);
        }
    }

    fn remove_except(&mut self, grid: &Grid, range: TileRange, except: Option<TileRange>, body: u32) {
        for tile in range.tiles().filter(|tile| !except.is_some_and(|other| other.contains(*tile))) {
            let std::collections::hash_map::Entry::Occupied(mut entry) = self.lists.entry(grid.key(tile))
            else {
                continue;
            };
            let list = entry.get_mut();
            if let Some(at) = list.iter().position(|other| *other == body) {
                list.swap_remove(at);
            }
            if list.is_empty() {
                let list = entry.remove();
                if self.spare.len() < MAX_SPARE {
                    self.spare.push(list);
                }
            }
        }
    }
}
