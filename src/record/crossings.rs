//! When bodies cross from one tile of the map to another, from their recorded motion: of parabolas in closed form.

use std::collections::HashMap;

use super::run::Run;
use super::ways::Crossing;
use crate::scene::{Map, NodeKey};
use crate::sim::{BodyRef, Piece};

/// Crossings that are found in one Δt.
const MOST: usize = 10_000;
/// Parts in which a way of higher degree goes up or down only, for all that is shown of it.
const PARTS: u32 = 32;
/// Halvings, after which the bits of a time are used up.
const HALVINGS: u32 = 60;

/// The crossings of some bodies in the Δt around the moment shown, as far as it is recorded, in order.
pub(super) fn crossings(run: &Run, keys: &[NodeKey]) -> Vec<Crossing> {
    let Some((start, end)) = run.grid.span() else { return Vec::new() };
    let (from, to) = (start.max(run.recording.from().time), end.min(run.recording.end.time));
    if keys.is_empty() {
        return Vec::new();
    }
    let mut found = Vec::new();
    // To find each for itself would take a look at all bodies each time.
    let bodies: HashMap<NodeKey, BodyRef> =
        run.simulation.dynamic_bodies().map(|body| (run.simulation.key(body), body)).collect();
    for (key, body) in keys.iter().filter_map(|key| Some((*key, *bodies.get(key)?))) {
        if found.len() >= MOST {
            break;
        }
        let mut pieces = run.recording.pieces(body, from, to).peekable();
        while let Some(piece) = pieces.next() {
            let end = pieces.peek().map_or(to, |next| next.start().min(to));
            add_crossings(piece, key, run.scene.map, (piece.start().max(from), end), &mut found);
        }
    }
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    found
}

/// Those on one piece between two times.
fn add_crossings(piece: &Piece, key: NodeKey, map: Map, (from, to): (f64, f64), found: &mut Vec<Crossing>) {
    for axis in 0..3 {
        let tile = map.size[axis] / f64::from(map.tiles[axis]);
        let last = map.tiles[axis].saturating_sub(1);
        // From 0 to the last, also beyond the map.
        let number =
            |time: f64| (piece.position(time)[axis] / tile).floor().clamp(0.0, f64::from(last)) as u32;
        for (from, to) in one_way(piece, axis, from, to) {
            let (mut left, entered) = (number(from), number(to));
            while left != entered && found.len() < MOST {
                let next = if entered > left { left + 1 } else { left - 1 };
                let time = time_at(piece, axis, tile * f64::from(left.max(next)), (from, to));
                found.push(Crossing { key, time, axis, tiles: [left, next] });
                left = next;
            }
        }
    }
}

/// Stretches in which the coordinate only grows or only falls.
fn one_way(piece: &Piece, axis: usize, from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut ends = vec![from];
    if piece.degree() <= 2 {
        let start = piece.at(piece.start());
        let turning = piece.start() - start.velocity[axis] / start.acceleration[axis];
        ends.extend(Some(turning).filter(|time| from < *time && *time < to));
    } else {
        let part = |nth: u32| from + (to - from) * f64::from(nth) / f64::from(PARTS);
        ends.extend((1..PARTS).map(part));
    }
    ends.push(to);
    ends.windows(2).map(|pair| (pair[0], pair[1])).collect()
}

/// When the coordinate has a value, in a stretch in which it comes to it.
fn time_at(piece: &Piece, axis: usize, value: f64, (from, to): (f64, f64)) -> f64 {
    if piece.degree() > 2 {
        return halved(piece, axis, value, (from, to));
    }
    let start = piece.at(piece.start());
    let (x, v, a) = (start.position[axis] - value, start.velocity[axis], start.acceleration[axis]);
    // x + vτ + ½aτ² = 0; with q = −(v ± √(v² − 2ax)) of equal signs the roots are q/a and 2x/q.
    let q = -(v + (v * v - 2.0 * a * x).max(0.0).sqrt().copysign(v));
    let outside = |time: f64| (from - time).max(time - to);
    let roots = [q / a, 2.0 * x / q].map(|tau| piece.start() + tau);
    let nearest =
        roots.into_iter().filter(|time| time.is_finite()).min_by(|s, t| outside(*s).total_cmp(&outside(*t)));
    nearest.unwrap_or(from).clamp(from, to)
}

fn halved(piece: &Piece, axis: usize, value: f64, (mut from, mut to): (f64, f64)) -> f64 {
    let is_above = |time: f64| piece.position(time)[axis] >= value;
    let begins_above = is_above(from);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if is_above(middle) == begins_above { from = middle } else { to = middle }
    }
    to
}
