//! Which static bodies lie in which tile: exact, made when the scene is compiled and after edits of static bodies.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::bricks::{BrickTile, for_each_brick, slots};
use super::grid::{Grid, TileRange};
use crate::sim::body::{Bodies, BodyId};
use crate::sim::shape::Convex;

/// Lists of static bodies by tile, one after the other in one array; only bricks with bodies in them are
/// stored.
#[derive(Clone, Debug, Default)]
pub(in crate::sim) struct StaticTiles {
    bricks: FxHashMap<u64, Brick>,
    /// Where the list of each occupied tile begins in `items`, brick by brick, and the end of the last.
    starts: Vec<u32>,
    items: Vec<u32>,
    /// The occupied tiles, sorted.
    occupied: Vec<[u32; 3]>,
    /// Static bodies that fill too many tiles to be listed in each.
    large: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Brick {
    /// Tiles with bodies in them.
    occupied: u64,
    /// Place in `starts` of the first of them.
    first: u32,
}

/// Listings that no scene is denied, and those that each of its bodies adds. More take memory and time to make
/// them that finer tiles do not save: a static body over 64 tiles is four tiles wide.
const FREE_LISTINGS: u64 = 1 << 20;
const LISTINGS_PER_BODY: u64 = 64;

/// Merges tiles as long as the static bodies would be listed too often in all. Results do not depend on the grid.
/// What fills the grid's whole box does not count, for that no grid helps.
pub(in crate::sim) fn coarse_enough(mut grid: Grid, bodies: &Bodies, tile_limit: u64) -> Grid {
    let count = bodies.dynamic().len() + bodies.static_len();
    let most = FREE_LISTINGS + LISTINGS_PER_BODY * count as u64;
    while grid.counts != [1; 3] && listings(&grid, bodies, tile_limit) > most {
        grid = grid.coarser();
    }
    grid
}

/// At least as many listings as there would be, for bodies that are no plates along the axes about twice as many.
fn listings(grid: &Grid, bodies: &Bodies, tile_limit: u64) -> u64 {
    let all = grid.all();
    let ranges = bodies.present_statics().map(|index| {
        let (shape, at) = placed(bodies, index);
        range_of(grid, shape, at).0
    });
    ranges.filter(|range| *range != all).map(|range| range.len().min(tile_limit)).sum()
}

impl StaticTiles {
    pub fn new(grid: &Grid, bodies: &Bodies, tile_limit: u64) -> Self {
        let mut entries: Vec<(BrickTile, u32)> = Vec::new();
        let mut large = Vec::new();
        for index in bodies.present_statics() {
            let (shape, at) = placed(bodies, index);
            let (range, margin) = range_of(grid, shape, at);
            if range.len() > tile_limit.saturating_mul(64) {
                large.push(index);
                continue;
            }
            let first = entries.len();
            entries.extend(
                range
                    .tiles()
                    .filter(|tile| touches(grid, *tile, (shape, at), margin))
                    .map(|tile| (BrickTile::new(grid, tile), index)),
            );
            if (entries.len() - first) as u64 > tile_limit {
                entries.truncate(first);
                large.push(index);
            }
        }
        entries.sort_unstable();
        let mut tiles = Self { large, ..Self::default() };
        for list in entries.chunk_by(|a, b| a.0 == b.0) {
            let BrickTile { brick, slot } = list[0].0;
            let first = tiles.starts.len() as u32;
            tiles.bricks.entry(brick).or_insert(Brick { occupied: 0, first }).occupied |= 1 << slot;
            tiles.starts.push(tiles.items.len() as u32);
            tiles.items.extend(list.iter().map(|entry| entry.1));
            tiles.occupied.push(list[0].0.tile(grid));
        }
        tiles.occupied.sort_unstable();
        tiles.starts.push(tiles.items.len() as u32);
        tiles
    }

    /// Visits the bodies in tiles of `range` that are not in `except`, once for each such tile. Large ones
    /// are left out.
    pub fn visit(
        &self,
        grid: &Grid,
        range: TileRange,
        except: Option<TileRange>,
        mut visit: impl FnMut(u32),
    ) {
        for_each_brick(grid, range, except, |key, mask| self.visit_brick(key, mask, &mut visit));
    }

    /// The same for the tiles of one brick.
    pub fn visit_brick(&self, key: u64, mask: u64, visit: &mut impl FnMut(u32)) {
        let Some(brick) = self.bricks.get(&key) else { return };
        for slot in slots(mask & brick.occupied) {
            let before = brick.occupied & ((1 << slot) - 1);
            let list = (brick.first + before.count_ones()) as usize;
            let (from, to) = (self.starts[list] as usize, self.starts[list + 1] as usize);
            self.items[from..to].iter().for_each(|body| visit(*body));
        }
    }

    /// The bodies in one tile, without large ones.
    pub fn bodies(&self, grid: &Grid, tile: [u32; 3]) -> Vec<u32> {
        let mut bodies = Vec::new();
        self.visit(grid, TileRange { low: tile, high: tile }, None, |body| bodies.push(body));
        bodies
    }

    pub fn large(&self) -> &[u32] {
        &self.large
    }

    /// The occupied tiles, sorted.
    pub fn occupied(&self) -> &[[u32; 3]] {
        &self.occupied
    }
}

fn placed(bodies: &Bodies, index: u32) -> (&dyn Convex, DVec3) {
    let shape = bodies.get(BodyId::of_static(index)).shape.convex();
    (shape, bodies.static_segment(index).x)
}

/// The tiles of a body's box, and by how much it is taken as larger, m.
fn range_of(grid: &Grid, shape: &dyn Convex, at: DVec3) -> (TileRange, f64) {
    let (low, high) = shape.bounds(at);
    let margin = margin(low, high);
    (grid.range(low - margin, high + margin), margin)
}

/// By how much a static body is taken as larger: above the rounding of the tests below, m.
fn margin(low: DVec3, high: DVec3) -> f64 {
    1e-12 * low.abs().max(high.abs()).max_element().max((high - low).max_element())
}

/// Whether a static body touches a tile (a border tile reaches as far as the body does).
fn touches(grid: &Grid, tile: [u32; 3], (shape, at): (&dyn Convex, DVec3), margin: f64) -> bool {
    let (body_low, body_high) = shape.bounds(at);
    let (low, high) = grid.bounds(&TileRange { low: tile, high: tile });
    let beyond = (body_high - body_low).max_element();
    shape.touches_box(at, low.max(body_low - beyond) - margin, high.min(body_high + beyond) + margin)
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::random::Random;
    use crate::scene::{Map, NodeKey};
    use crate::sim::body::{Body, Identity, Rare};
    use crate::sim::shape::{Plate, Shape, Sphere};

    fn only(position: DVec3, shape: Shape) -> Bodies {
        let mut bodies = Bodies::default();
        add(&mut bodies, position, shape);
        bodies
    }

    fn add(bodies: &mut Bodies, position: DVec3, shape: Shape) {
        let body = Body::new((0, 0), f64::INFINITY, 1.0, shape, Rare::default());
        bodies.push(Identity::new(NodeKey(0), "0", "0"), body, position);
    }

    fn random_plate(random: &mut Random, scale: f64) -> (Bodies, Plate) {
        let center = scale * (5.0 + random.vector(7.0));
        let turn = random.vector(3.0);
        let frame = DQuat::from_scaled_axis(turn);
        let plate = Plate {
            center,
            axis_x: frame * DVec3::X,
            axis_y: frame * DVec3::Y,
            normal: frame * DVec3::Z,
            half_x: scale * (0.05 + 4.0 * random.unit()),
            half_y: scale * (0.05 + 4.0 * random.unit()),
        };
        (only(center, Shape::Plate(Box::new(plate))), plate)
    }

    /// Every point of a plate lies in a tile that lists it; a listed tile has a point near the plate.
    #[test]
    fn plates_are_in_the_tiles_they_touch_and_in_no_others() {
        let mut random = Random::new(7);
        for (counts, scale) in
            [([1, 1, 1], 1.0), ([10, 10, 10], 1.0), ([10, 10, 10], 1e-14), ([7, 31, 3], 1.0)]
        {
            let grid = Grid::new(&Map { size: DVec3::splat(10.0 * scale), tiles: counts }, 0.0);
            for _ in 0..60 {
                let (bodies, plate) = random_plate(&mut random, scale);
                let tiles = StaticTiles::new(&grid, &bodies, 1_000_000);
                for _ in 0..300 {
                    let u = plate.half_x * (2.0 * random.unit() - 1.0);
                    let v = plate.half_y * (2.0 * random.unit() - 1.0);
                    let point = plate.center + u * plate.axis_x + v * plate.axis_y;
                    let TileRange { low, .. } = grid.range(point, point);
                    assert_eq!(tiles.bodies(&grid, low), [0], "{point} of {plate:?}");
                }
                for tile in tiles.occupied() {
                    assert!(samples_hit(&grid, *tile, &plate), "tile {tile:?} lists {plate:?} in vain");
                }
            }
        }
    }

    /// Whether the plate comes near a tile, by sampling the plate densely: a tile is a hundred times as
    /// large as the samples are apart.
    fn samples_hit(grid: &Grid, tile: [u32; 3], plate: &Plate) -> bool {
        const SAMPLES: i32 = 150;
        let (low, high) = grid.bounds(&TileRange { low: tile, high: tile });
        let near = 4.0 / f64::from(SAMPLES) * plate.half_x.max(plate.half_y);
        (-SAMPLES..=SAMPLES).any(|i| {
            (-SAMPLES..=SAMPLES).any(|j| {
                let (u, v) = (f64::from(i) / f64::from(SAMPLES), f64::from(j) / f64::from(SAMPLES));
                let point = plate.center + u * plate.half_x * plate.axis_x + v * plate.half_y * plate.axis_y;
                point.cmpge(low - near).all() && point.cmple(high + near).all()
            })
        })
    }

    #[test]
    fn a_huge_plate_goes_to_the_list_of_large_ones() {
        let grid = Grid::new(&Map { size: DVec3::splat(10.0), tiles: [1000, 1000, 1000] }, 0.0);
        let plate = Plate {
            center: DVec3::splat(5.0),
            axis_x: DVec3::X,
            axis_y: DVec3::Y,
            normal: DVec3::Z,
            half_x: 5.0,
            half_y: 5.0,
        };
        let wall = only(plate.center, Shape::Plate(Box::new(plate)));
        let tiles = StaticTiles::new(&grid, &wall, 4096);
        assert_eq!(tiles.large(), [0]);
        assert!(tiles.occupied().is_empty());
    }

    #[test]
    fn spheres_leave_out_the_corners_of_their_boxes() {
        let grid = Grid::new(&Map { size: DVec3::splat(10.0), tiles: [10, 10, 10] }, 0.0);
        let ball = only(DVec3::splat(5.0), Shape::Sphere(Sphere { radius: 2.5 }));
        let tiles = StaticTiles::new(&grid, &ball, 4096);
        assert_eq!(tiles.bodies(&grid, [4, 4, 4]), [0]);
        assert_eq!(tiles.bodies(&grid, [2, 5, 5]), [0]);
        assert_eq!(tiles.bodies(&grid, [2, 2, 2]), [0_u32; 0]);
    }

    /// Symptom: 10⁵ static spheres over the finest tiles took gigabytes and half a minute before the start.
    /// Expected: as many listings as 64 for each body and a million for all; a scene below that keeps its grid.
    /// Cause: each body was listed in every tile up to its own limit, whatever that summed up to.
    #[test]
    fn many_bodies_over_fine_tiles_coarsen_the_grid() {
        let map = Map { size: DVec3::splat(1000.0), tiles: [65536; 3] };
        let fine = Grid::new(&map, 0.01);
        let mut random = Random::new(11);
        let mut bodies = Bodies::default();
        for _ in 0..20_000 {
            let at = 500.0 + random.vector(500.0);
            add(&mut bodies, at, Shape::Sphere(Sphere { radius: 0.1 + random.unit() }));
        }
        let grid = coarse_enough(fine, &bodies, 4096);
        let tiles = StaticTiles::new(&grid, &bodies, 4096);
        let most = FREE_LISTINGS + 20_000 * LISTINGS_PER_BODY;
        assert!(tiles.items.len() as u64 <= most, "{} listings, {most} at most", tiles.items.len());
        assert!(tiles.items.len() as u64 > most / 32, "coarsened too far: {} listings", tiles.items.len());
        assert!(tiles.large().is_empty());

        let few = only(DVec3::splat(500.0), Shape::Sphere(Sphere { radius: 5.0 }));
        assert_eq!(coarse_enough(fine, &few, 4096), fine);
    }
}
