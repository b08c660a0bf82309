//! Checks that look at geometry and change nothing: overlaps, bodies outside the map, occupied tiles.

use glam::DVec3;

use super::body::{BodyId, Identity};
use super::geometry::{contact_distance, gap_of};
use super::model::Model;
use super::pair::Pair;
use super::report::Tiling;
use super::state::State;
use crate::scene::{Diagnostic, Severity};

/// Deepest overlap at `time` of any two bodies that share a tile, m, ≥ 0.
pub(super) fn worst_overlap(model: &Model, state: &State, time: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for_each_neighbour(model, state, |pair| {
        worst = worst.max(-gap_of(model, state, pair, time).distance);
        true
    });
    worst
}

/// Warnings about the start: what overlaps, and what lies outside the map.
pub(super) fn start_warnings(model: &Model, state: &State) -> Vec<Diagnostic> {
    let mut warnings = Vec::new();
    for_each_neighbour(model, state, |pair| {
        let gap = gap_of(model, state, pair, state.now);
        let depth = -gap.distance;
        if depth > contact_distance(model, pair, gap.point) {
            let (a, b) = (&model.body(pair.a).identity, &model.body(pair.b).identity);
            warnings.push(warning(
                a,
                format!("bodies {} and {} overlap by {} m at the start", a.name, b.name, meters(depth)),
                "move them apart; the run goes on, but they can part only by moving away from each other",
            ));
        }
        warnings.len() < MOST_WARNINGS
    });
    if warnings.len() >= MOST_WARNINGS {
        let more = "there may be more overlaps: only the first are listed".to_owned();
        warnings
            .push(Diagnostic { key: None, ..warning(&model.dynamic(0).identity, more, "mend these first") });
    }
    let size = model.grid.tile_size * DVec3::from(model.grid.counts.map(f64::from));
    for body in model.present() {
        let at = state.position(body, state.now);
        if at.cmplt(DVec3::ZERO).any() || at.cmpgt(size).any() {
            let identity = &model.dynamic(body).identity;
            warnings.push(warning(
                identity,
                format!("body {} starts outside the map", identity.name),
                "move it inside or enlarge the map; it is simulated all the same",
            ));
        }
    }
    warnings.sort_by_key(|warning| warning.key);
    warnings
}

/// Four digits, without an exponent where a person would write none.
fn meters(length: f64) -> String {
    if (1e-3..1e4).contains(&length) { format!("{length:.4}") } else { format!("{length:.3e}") }
}

fn warning(identity: &Identity, message: String, hint: &str) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        position: None,
        path: String::new(),
        message,
        hint: hint.into(),
        key: Some(identity.key),
    }
}

/// Overlaps listed at most: bodies piled on one point would give as many as there are pairs.
const MOST_WARNINGS: usize = 200;

/// Every pair that shares a tile, once, in order, until `visit` says that it has seen enough.
fn for_each_neighbour(model: &Model, state: &State, mut visit: impl FnMut(Pair) -> bool) {
    let mut others = Vec::new();
    for body in model.present() {
        others.clear();
        let range = state.registered[body as usize];
        state.dynamic_tiles.visit(&model.grid, range, None, |other| {
            if other > body {
                others.push(BodyId::of_dynamic(other));
            }
        });
        model.static_tiles.visit(&model.grid, range, None, |other| others.push(BodyId::of_static(other)));
        others.extend(model.static_tiles.large().iter().map(|other| BodyId::of_static(*other)));
        others.sort_unstable();
        others.dedup();
        if !others.iter().all(|other| visit(Pair::of(body, *other))) {
            return;
        }
    }
}

/// The occupied tiles, at most `limit` of them, those with dynamic bodies first.
pub(super) fn tiling(model: &Model, state: &State, limit: usize) -> Tiling {
    let grid = &model.grid;
    let mut tiles = state.dynamic_tiles.occupied(grid);
    let with_dynamic = tiles.len();
    let only_static: Vec<[u32; 3]> = (model.static_tiles.occupied().iter().copied())
        .filter(|tile| tiles[..with_dynamic].binary_search(tile).is_err())
        .take(limit + 1)
        .collect();
    tiles.extend(only_static);
    let truncated = tiles.len() > limit;
    tiles.truncate(limit);
    tiles.sort_unstable();
    let occupied = tiles
        .into_iter()
        .map(|tile| {
            let statics = model.static_tiles.bodies(grid, tile).len() as u32;
            (tile, statics, state.dynamic_tiles.bodies(grid, tile).len() as u32)
        })
        .collect();
    Tiling { tile_size: grid.tile_size, tiles: grid.counts, occupied, truncated }
}
