//! The occupied tiles of the collision grid.

use std::collections::BTreeSet;

use glam::{DVec3, UVec3};

use crate::view::DrawList;
use crate::view::stage::{Pen, Stage};

const MOST: usize = 4000;

/// Indices, statics in it, dynamic bodies in it.
type Tile = ([u32; 3], u32, u32);

/// An edge of the grid: where it starts, in tiles, and the axis along which it is one tile long.
type Edge = ([u32; 3], usize);

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(tiling) = stage.input.frame.map(|frame| &frame.tiling) else { return };
    // Tiles with moving bodies first: they are what collisions are searched in.
    let (moving, fixed): (Vec<&Tile>, Vec<&Tile>) =
        tiling.occupied.iter().partition(|(_, _, dynamic)| *dynamic > 0);
    let left = MOST.saturating_sub(moving.len());
    let moving: BTreeSet<Edge> = moving.iter().take(MOST).flat_map(|tile| edges(tile.0)).collect();
    let fixed: BTreeSet<Edge> = fixed.iter().take(left).flat_map(|tile| edges(tile.0)).collect();

    // Neighbours share edges: each is drawn once, or faint lines would add up.
    let faint = Pen::hidden_by_bodies(stage.palette.tile, 1.0);
    let bright = Pen::over_bodies(stage.palette.tile_dynamic, 1.25);
    let fixed = fixed.difference(&moving).map(|edge| (edge, faint));
    for ((start, axis), pen) in fixed.chain(moving.iter().map(|edge| (edge, bright))) {
        let from = UVec3::from_array(*start).as_dvec3() * tiling.tile_size;
        let to = from + DVec3::AXES[*axis] * tiling.tile_size;
        stage.add_line(list, [from, to], pen);
    }
    let occupied = tiling.occupied.len();
    if occupied > MOST || tiling.truncated {
        let of = if tiling.truncated { "more than " } else { "" };
        list.notes.push(format!("Tiles: {} of {of}{occupied} occupied ones.", occupied.min(MOST)));
    }
}

/// The twelve edges of a tile.
fn edges(tile: [u32; 3]) -> impl Iterator<Item = Edge> {
    (0..3).flat_map(move |axis| {
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[a, b]| {
            let mut start = tile;
            start[(axis + 1) % 3] += a;
            start[(axis + 2) % 3] += b;
            (start, axis)
        })
    })
}
