//! Bricks: cubes of 4×4×4 tiles. A set of tiles of one brick is a 64-bit mask, so that a box of tiles costs
//! one look-up in each brick it touches, and empty tiles cost nothing.

use super::grid::{self, Grid, TileRange};

/// Tiles along the edge of a brick.
const EDGE: u32 = 4;

/// Tiles in a brick: as many as a mask has bits.
pub(super) const BRICK_TILES: usize = 64;

/// One tile by the key of its brick and its place in there, 0..64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct BrickTile {
    pub brick: u64,
    pub slot: usize,
}

impl BrickTile {
    pub fn new(grid: &Grid, tile: [u32; 3]) -> Self {
        let [x, y, z] = tile.map(|index| index % EDGE);
        let brick = grid::key(counts(grid), tile.map(|index| index / EDGE));
        Self { brick, slot: ((x * EDGE + y) * EDGE + z) as usize }
    }

    pub fn tile(self, grid: &Grid) -> [u32; 3] {
        let brick = grid::tile_of_key(counts(grid), self.brick);
        let slot = self.slot as u32;
        let within = [slot / (EDGE * EDGE), slot / EDGE % EDGE, slot % EDGE];
        std::array::from_fn(|axis| brick[axis] * EDGE + within[axis])
    }
}

/// Bricks along each axis.
fn counts(grid: &Grid) -> [u32; 3] {
    grid.counts.map(|count| count.div_ceil(EDGE))
}

/// Goes through the bricks with tiles that are in `range` but not in `except`: their keys, and those tiles
/// as a mask.
pub(in crate::sim) fn for_each_brick(
    grid: &Grid,
    range: TileRange,
    except: Option<TileRange>,
    mut visit: impl FnMut(u64, u64),
) {
    let counts = counts(grid);
    let [low, high] = [range.low, range.high].map(|tile| tile.map(|index| index / EDGE));
    for x in low[0]..=high[0] {
        for y in low[1]..=high[1] {
            for z in low[2]..=high[2] {
                let brick = [x, y, z];
                let mask = mask_of(&range, brick) & !except.map_or(0, |except| mask_of(&except, brick));
                if mask != 0 {
                    visit(grid::key(counts, brick), mask);
                }
            }
        }
    }
}

/// The places of the bits of a mask.
pub(super) fn slots(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let slot = mask.trailing_zeros();
        mask &= mask.wrapping_sub(1);
        (slot < u64::BITS).then_some(slot as usize)
    })
}

/// The tiles of a range that lie in a brick. Bit (x·4 + y)·4 + z: along each axis a run of indices is a
/// run of bits, nibbles or 16 bits, and the box is what the three have in common.
fn mask_of(range: &TileRange, brick: [u32; 3]) -> u64 {
    const REPEAT: [u64; 3] = [1, 0x0001_0001_0001_0001, 0x1111_1111_1111_1111];
    const WIDTH: [u32; 3] = [16, 4, 1];
    let mut mask = u64::MAX;
    for axis in 0..3 {
        let first = brick[axis] * EDGE;
        let low = range.low[axis].max(first);
        let high = range.high[axis].min(first + EDGE - 1);
        if low > high {
            return 0;
        }
        let run = u64::MAX >> (u64::BITS - WIDTH[axis] * (high - low + 1)) << (WIDTH[axis] * (low - first));
        mask &= run * REPEAT[axis];
    }
    mask
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::random::Random;
    use crate::scene::Map;

    /// Every tile of random boxes, against going through the tiles one by one.
    #[test]
    fn a_box_is_its_tiles() {
        let counts = [9, 30, 5];
        let grid = Grid::new(&Map { size: DVec3::ONE, tiles: counts }, 0.0);
        let mut source = Random::new(1);
        let mut random = move |below: u32| source.below(below as usize) as u32;
        let mut range = || {
            let ends = counts.map(|count| {
                let (a, b) = (random(count), random(count));
                (a.min(b), a.max(b))
            });
            TileRange { low: ends.map(|end| end.0), high: ends.map(|end| end.1) }
        };
        for _ in 0..500 {
            let (all, except) = (range(), range());
            let alone = |tile: &[u32; 3]| !except.overlaps(&TileRange { low: *tile, high: *tile });
            let mut expected: Vec<BrickTile> =
                all.tiles().filter(alone).map(|tile| BrickTile::new(&grid, tile)).collect();
            expected.sort_unstable();
            let mut got = Vec::new();
            for_each_brick(&grid, all, Some(except), |brick, mask| {
                got.extend(slots(mask).map(|slot| BrickTile { brick, slot }));
            });
            got.sort_unstable();
            assert_eq!(got, expected, "{all:?} without {except:?}");
            assert!(all.tiles().all(|tile| BrickTile::new(&grid, tile).tile(&grid) == tile));
        }
    }
}
