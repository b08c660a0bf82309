//! Which static bodies lie in which tile: exact, made once when the scene is compiled.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::{Grid, TileRange};
use crate::sim::model::{Fixture, FixtureShape, Plate};

/// Lists of static bodies by tile, one after the other in one array; only occupied tiles are stored.
#[derive(Clone, Debug, Default)]
pub(in crate::sim) struct StaticTiles {
    spans: FxHashMap<u64, (u32, u32)>,
    items: Vec<u32>,
    /// Static bodies that fill too many tiles to be listed in each.
    large: Vec<u32>,
}

impl StaticTiles {
    pub fn new(grid: &Grid, fixtures: &[Fixture], tile_limit: u64) -> Self {
        let mut entries: Vec<(u64, u32)> = Vec::new();
        let mut large = Vec::new();
        for (index, fixture) in (0u32..).zip(fixtures).filter(|(_, fixture)| fixture.present) {
            let margin = margin(fixture);
            let (low, high) = fixture.bounds();
            let range = grid.range(low - margin, high + margin);
            if range.len() > tile_limit.saturating_mul(64) {
                large.push(index);
                continue;
            }
            let first = entries.len();
            entries.extend(
                range
                    .tiles()
                    .filter(|tile| touches(grid, *tile, fixture, margin))
                    .map(|tile| (grid.key(tile), index)),
            );
            if (entries.len() - first) as u64 > tile_limit {
                entries.truncate(first);
                large.push(index);
            }
        }
        entries.sort_unstable();
        Self { spans: spans(&entries), items: entries.iter().map(|entry| entry.1).collect(), large }
    }

    pub fn bodies(&self, key: u64) -> &[u32] {
        self.spans.get(&key).map_or(&[], |(first, last)| &self.items[*first as usize..*last as usize])
    }

    pub fn large(&self) -> &[u32] {
        &self.large
    }

    /// Keys of the occupied tiles, sorted.
    pub fn occupied(&self) -> Vec<u64> {
        let mut keys: Vec<u64> = self.spans.keys().copied().collect();
        keys.sort_unstable();
        keys
    }
}

fn spans(entries: &[(u64, u32)]) -> FxHashMap<u64, (u32, u32)> {
    let mut spans = FxHashMap::default();
    let mut first = 0;
    while first < entries.len() {
        let key = entries[first].0;
        let count = entries[first..].partition_point(|entry| entry.0 == key);
        spans.insert(key, (first as u32, (first + count) as u32));
        first += count;
    }
    spans
}

/// By how much a static body is taken as larger: above the rounding of the tests below, m.
fn margin(fixture: &Fixture) -> f64 {
    let (low, high) = fixture.bounds();
    1e-12 * low.abs().max(high.abs()).max_element().max((high - low).max_element())
}

/// Whether a static body touches a tile (a border tile reaches as far as the body does).
fn touches(grid: &Grid, tile: [u32; 3], fixture: &Fixture, margin: f64) -> bool {
    let (body_low, body_high) = fixture.bounds();
    let (low, high) = grid.bounds(&TileRange { low: tile, high: tile });
    let low = low.max(body_low - 1.0) - margin;
    let high = high.min(body_high + 1.0) + margin;
    match &fixture.shape {
        FixtureShape::Sphere { radius } => {
            let nearest = fixture.position.clamp(low, high);
            (nearest - fixture.position).length() <= *radius
        }
        FixtureShape::Plate(plate) => plate_touches_box(plate, low, high),
    }
}

/// Separating axes of a rectangle and a box (Akenine-Möller 2001, for a rectangle instead of a triangle):
/// the box's three, the plate's normal, and the nine cross products of their edges.
fn plate_touches_box(plate: &Plate, low: DVec3, high: DVec3) -> bool {
    let center = 0.5 * (low + high) - plate.center;
    let half = 0.5 * (high - low);
    let separated = |axis: DVec3| {
        let reach = half.dot(axis.abs())
            + plate.half_x * plate.axis_x.dot(axis).abs()
            + plate.half_y * plate.axis_y.dot(axis).abs();
        // Rounding of nearly parallel edges must not separate what touches.
        axis.dot(center).abs() > reach + 1e-12 * (half.element_sum() + center.abs().element_sum())
    };
    let crosses =
        DVec3::AXES.into_iter().flat_map(|edge| [edge.cross(plate.axis_x), edge.cross(plate.axis_y)]);
    !DVec3::AXES.into_iter().chain([plate.normal]).chain(crosses).any(separated)
}
