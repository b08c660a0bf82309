//! The grid: map size and counts, and the tiles a box touches. Border tiles reach to infinity, so that
//! nothing is lost outside the map.

use glam::DVec3;

use crate::scene::Map;

/// nx×ny×nz tiles over the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Grid {
    pub tile_size: DVec3,
    pub counts: [u32; 3],
    /// Of the map, m: whatever the tiles are.
    pub size: DVec3,
}

/// A box of tiles, both ends included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::sim) struct TileRange {
    pub low: [u32; 3],
    pub high: [u32; 3],
}

/// Tiles per axis that the largest moving body may span. Each move to other tiles costs as many list
/// changes as it has tiles on a side, so a finer grid only costs.
const MOST_SPANNED: f64 = 16.0;

impl Grid {
    /// The map's grid. Tiles far finer than the largest moving body (radius in m) are merged 2×2×2, as
    /// often as it takes: results do not depend on the grid, but time and memory do.
    pub fn new(map: &Map, largest_radius: f64) -> Self {
        let mut counts = map.tiles;
        let tile_size = |counts: [u32; 3]| map.size / DVec3::from_array(counts.map(f64::from));
        for axis in 0..3 {
            while counts[axis] > 1 && 2.0 * largest_radius > MOST_SPANNED * tile_size(counts)[axis] {
                counts[axis] = counts[axis].div_ceil(2);
            }
        }
        Self { tile_size: tile_size(counts), counts, size: map.size }
    }

    /// The same map with its tiles merged 2×2×2.
    pub fn coarser(&self) -> Self {
        let size = self.tile_size * DVec3::from_array(self.counts.map(f64::from));
        let counts = self.counts.map(|count| count.div_ceil(2));
        Self { tile_size: size / DVec3::from_array(counts.map(f64::from)), counts, ..*self }
    }

    pub fn all(&self) -> TileRange {
        TileRange { low: [0; 3], high: self.counts.map(|count| count - 1) }
    }

    /// Tiles that the box from `low` to `high` (m) touches.
    pub fn range(&self, low: DVec3, high: DVec3) -> TileRange {
        let index = |at: DVec3| -> [u32; 3] {
            let tile = (at / self.tile_size).to_array();
            // The cast saturates, so that anything outside the map goes to a border tile.
            std::array::from_fn(|axis| (tile[axis].max(0.0) as u32).min(self.counts[axis] - 1))
        };
        TileRange { low: index(low), high: index(high) }
    }

    /// Planes that bound a range, m; infinite on a side that ends at the border.
    pub fn bounds(&self, range: &TileRange) -> (DVec3, DVec3) {
        let size = self.tile_size.to_array();
        let low = std::array::from_fn(|axis| match range.low[axis] {
            0 => f64::NEG_INFINITY,
            index => f64::from(index) * size[axis],
        });
        let high = std::array::from_fn(|axis| match range.high[axis] {
            index if index + 1 >= self.counts[axis] => f64::INFINITY,
            index => f64::from(index + 1) * size[axis],
        });
        (DVec3::from_array(low), DVec3::from_array(high))
    }

    /// One number for a tile, whose order is that of the indices.
    pub fn key(&self, tile: [u32; 3]) -> u64 {
        key(self.counts, tile)
    }

    pub fn tile_of_key(&self, key: u64) -> [u32; 3] {
        tile_of_key(self.counts, key)
    }
}

impl TileRange {
    pub fn len(&self) -> u64 {
        (0..3).map(|axis| u64::from(self.high[axis] - self.low[axis]) + 1).product()
    }

    /// Whether a tile is in both.
    pub fn overlaps(&self, other: &Self) -> bool {
        // Without branches: half of the answers nobody can foretell.
        let meets = |axis: usize| (self.low[axis] <= other.high[axis]) & (other.low[axis] <= self.high[axis]);
        meets(0) & meets(1) & meets(2)
    }

    pub fn tiles(self) -> impl Iterator<Item = [u32; 3]> {
        let Self { low, high } = self;
        (low[0]..=high[0]).flat_map(move |x| {
            (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z]))
        })
    }
}

/// Position in row-major order.
pub(super) fn key(counts: [u32; 3], index: [u32; 3]) -> u64 {
    let [x, y, z] = index.map(u64::from);
    let [_, ny, nz] = counts.map(u64::from);
    (x * ny + y) * nz + z
}

/// The inverse of [`key`].
pub(super) fn tile_of_key(counts: [u32; 3], key: u64) -> [u32; 3] {
    let [_, ny, nz] = counts.map(u64::from);
    [(key / (ny * nz)) as u32, ((key / nz) % ny) as u32, (key % nz) as u32]
}
