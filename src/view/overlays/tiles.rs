//! The occupied tiles of the collision grid.

use glam::{DVec3, UVec3};

use crate::view::stage::{Pen, Stage};
use crate::view::{Bounds, DrawList};

const MOST: usize = 3000;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(tiling) = stage.input.frame.map(|frame| &frame.tiling) else { return };
    // Tiles with moving bodies first: they are what collisions are searched in.
    let (moving, fixed): (Vec<_>, Vec<_>) = tiling.occupied.iter().partition(|(_, _, dynamic)| *dynamic > 0);
    for (index, _, dynamic) in moving.iter().chain(&fixed).take(MOST) {
        let min = UVec3::from_array(*index).as_dvec3() * tiling.tile_size;
        let pen = match dynamic {
            0 => Pen::hidden_by_bodies(stage.palette.tile, 1.0),
            _ => Pen::over_bodies(stage.palette.tile_dynamic, 1.5),
        };
        // A hair smaller than the tile, so that neighbours' edges stay apart.
        let inset = DVec3::splat(0.004) * tiling.tile_size;
        stage.add_box(list, Bounds { min: min + inset, max: min + tiling.tile_size - inset }, pen);
    }
    let occupied = tiling.occupied.len();
    if occupied > MOST || tiling.truncated {
        list.notes.push(format!("Tiles: {} of more than {occupied} occupied ones.", occupied.min(MOST)));
    }
}
