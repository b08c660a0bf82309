//! Checks that look at geometry and change nothing: overlaps, bodies outside the map, occupied tiles.

use glam::DVec3;

use super::body::{BodyId, Identity};
use super::geometry::{contact_distance, gap_of};
use super::method::Method;
use super::model::Model;
use super::pair::Pair;
use super::predict::touch_tolerance;
use super::report::Tiling;
use super::state::State;
use crate::scene::{Diagnostic, HEAP_OVERLAP, NodeKey, Severity};

/// Deepest overlap at `time` of any two bodies that share a tile, m, ≥ 0.
pub(super) fn worst_overlap(model: &Model, state: &State, time: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for_each_neighbour(model, state, |pair| {
        worst = worst.max(-gap_of(model, state, pair, time).distance);
        true
    });
    worst
}

/// Warnings about the start: what overlaps by more than a heap does, and what lies outside the map. An error if so much overlaps that
/// no simulation could begin in a sensible time.
pub(super) fn start_warnings(model: &Model, state: &State) -> Result<Vec<Diagnostic>, Diagnostic> {
    let mut warnings = overlap_warnings(model, state)?;
    warnings.extend(outside_warnings(model, state));
    warnings.extend(tiny_warnings(model, state));
    warnings.extend(friction_warning(model));
    // What is about no body sums up the others.
    warnings.sort_by_key(|warning| (warning.key.is_none(), warning.key));
    Ok(warnings)
}

fn overlap_warnings(model: &Model, state: &State) -> Result<Vec<Diagnostic>, Diagnostic> {
    let mut warnings = Vec::new();
    let bodies = model.bodies.dynamic().len() + model.bodies.static_len();
    let most = MOST_OVERLAPS.max(MOST_OVERLAPS_PER_BODY * bodies);
    let mut count = 0;
    for_each_neighbour(model, state, |pair| {
        let gap = gap_of(model, state, pair, state.now);
        let depth = -gap.distance;
        if depth > contact_distance(model, pair, gap.point).max(HEAP_OVERLAP * smallest_radius(model, pair)) {
            count += 1;
            if count <= MOST_WARNINGS {
                let (a, b) = (model.identity(pair.a), model.identity(pair.b));
                warnings.push(warning(
                    a,
                    format!(
                        "bodies {} and {} overlap by {} m at the start",
                        a.name(),
                        b.name(),
                        meters(depth)
                    ),
                    "move them apart; the run goes on, but they can part only by moving away from each other",
                ));
            }
        }
        count <= most
    });
    if count > most {
        return Err(Diagnostic {
            severity: Severity::Error,
            ..about_all(
                format!("more than {most} pairs of bodies overlap at the start"),
                "move them apart; are many of them at one place?",
            )
        });
    }
    if count > MOST_WARNINGS {
        let more = count - MOST_WARNINGS;
        warnings.push(about_all(format!("and {more} more overlaps at the start"), "fix the first ones"));
    }
    Ok(warnings)
}

/// Radius of the smaller sphere of a pair, m.
fn smallest_radius(model: &Model, pair: Pair) -> f64 {
    let radii = [pair.a, pair.b].map(|body| model.body(body).shape.radius());
    // That of a plate is 0.
    radii.into_iter().filter(|radius| *radius > 0.0).fold(f64::INFINITY, f64::min)
}

fn outside_warnings(model: &Model, state: &State) -> Vec<Diagnostic> {
    let size = model.grid.tile_size * DVec3::from(model.grid.counts.map(f64::from));
    let is_outside = |body: &u32| {
        let at = state.position(*body, state.now);
        at.cmplt(DVec3::ZERO).any() || at.cmpgt(size).any()
    };
    let mut outside = model.present().filter(is_outside);
    let first = outside.by_ref().take(MOST_WARNINGS).map(|body| {
        let identity = model.identity(BodyId::of_dynamic(body));
        let message = format!("body {} starts outside the map", identity.name());
        warning(identity, message, "move it inside or enlarge the map; it is simulated all the same")
    });
    let mut warnings: Vec<Diagnostic> = first.collect();
    let more = outside.count();
    if more > 0 {
        warnings.push(about_all(
            format!("and {more} more bodies start outside the map"),
            "move them inside or enlarge the map",
        ));
    }
    warnings
}

/// Bodies that are smaller than the rounding of where they are.
fn tiny_warnings(model: &Model, state: &State) -> Vec<Diagnostic> {
    let is_tiny = |body: &u32| {
        let radius = model.radius(*body);
        radius <= touch_tolerance(state.position(*body, state.now), radius)
    };
    let warn = |body: u32| {
        let identity = model.identity(BodyId::of_dynamic(body));
        let message = format!("body {} is smaller than the last digit of its position", identity.name());
        warning(identity, message, "make it larger: it may pass through others unseen")
    };
    model.present().filter(is_tiny).take(MOST_WARNINGS).map(warn).collect()
}

/// A method that leaves friction out says so, and so does friction that nothing has to rub on.
fn friction_warning(model: &Model) -> Option<Diagnostic> {
    let roughness = |body| model.dynamic(body).roughness();
    let is_rough = model.present().any(|body| roughness(body).friction > 0.0);
    let mut statics = (0..model.bodies.static_len() as u32).map(BodyId::of_static);
    let mut is_rough_below = || statics.any(|body| model.body(body).roughness().friction > 0.0);
    if model.present().next().is_some() && !is_rough && is_rough_below() {
        let message = "there is friction on static bodies alone, and none acts: a pair has √(μ₁μ₂)";
        return Some(about_all(message.into(), "give the moving bodies friction, too"));
    }
    let resists = model.present().any(|body| roughness(body).rolling > 0.0);
    let (message, hint) = match model.method {
        Method::Thesis if is_rough => {
            ("the method thesis has no friction: bodies slide as if they were smooth", "use exact or fixed")
        }
        Method::Fixed if is_rough && resists => {
            ("the method fixed has no rolling friction: nothing slows a body that rolls", "use exact")
        }
        _ => return None,
    };
    Some(about_all(message.into(), hint))
}

/// Four digits, without an exponent where a person would write none.
fn meters(length: f64) -> String {
    if (1e-3..1e4).contains(&length) { format!("{length:.4}") } else { format!("{length:.3e}") }
}

fn warning(identity: &Identity, message: String, hint: &str) -> Diagnostic {
    about(Some(identity.key), message, hint)
}

fn about(key: Option<NodeKey>, message: String, hint: &str) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        position: None,
        path: String::new(),
        message,
        hint: hint.into(),
        key,
    }
}

/// A warning about no body in particular.
fn about_all(message: String, hint: &str) -> Diagnostic {
    about(None, message, hint)
}

/// Overlaps, and bodies outside the map, listed at most: bodies piled on one point would give as many as there
/// are pairs.
const MOST_WARNINGS: usize = 200;

/// Overlapping pairs per body with which a simulation still begins. A ball touches at most 12 of its own size,
/// and even a heap that overlaps badly has some dozens; n balls at one place have n/2 each, and every prediction
/// would cost as much.
const MOST_OVERLAPS_PER_BODY: usize = 50;

/// So many pairs are looked at in a fraction of a second, however few bodies there are.
const MOST_OVERLAPS: usize = 100_000;

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
