//! Which bodies may be seen at a place of the picture: by a grid of cells, so that not all are asked for every place.

use glam::{DVec2, DVec3};

use super::stage::{Posed, Stage};

/// Cells along each side of the picture: some ten bodies stand in each where ten thousand fill it.
const SIDE: usize = 64;

/// Whoever covers more cells is asked for everywhere.
const MOST_CELLS: usize = 256;

/// The bodies of a stage by where they are seen. What lies beyond the picture counts to its outermost cells.
pub(super) struct Sight {
    /// Places in [`Stage::bodies`].
    cells: Vec<Vec<usize>>,
    everywhere: Vec<usize>,
}

impl Sight {
    /// `reach` is the radius around its place within which a body is seen, m.
    pub fn of(stage: &Stage<'_>, reach: impl Fn(&Posed<'_>) -> f64) -> Self {
        let mut sight = Self { cells: vec![Vec::new(); SIDE * SIDE], everywhere: Vec::new() };
        for (index, posed) in stage.bodies.iter().enumerate() {
            match bounds(stage, posed.position, reach(posed)).map(|ends| ends.map(cell)) {
                Some([[left, top], [right, bottom]])
                    if (right - left + 1) * (bottom - top + 1) <= MOST_CELLS =>
                {
                    for row in top..=bottom {
                        (left..=right).for_each(|column| sight.cells[row * SIDE + column].push(index));
                    }
                }
                _ => sight.everywhere.push(index),
            }
        }
        sight
    }

    /// All bodies that may be seen there, and others.
    pub fn at(&self, ndc: DVec2) -> impl Iterator<Item = usize> {
        let [column, row] = cell(ndc);
        self.cells[row * SIDE + column].iter().chain(&self.everywhere).copied()
    }
}

/// Column and row.
fn cell(ndc: DVec2) -> [usize; 2] {
    let place = (0.5 * (ndc + 1.0) * SIDE as f64).clamp(DVec2::ZERO, DVec2::splat(SIDE as f64 - 1.0));
    place.to_array().map(|place| place as usize)
}

/// Corners of what holds the picture of a ball; `None` where it reaches behind the eye. The cube around it, along the
/// axes of the view, is seen around it.
fn bounds(stage: &Stage<'_>, center: DVec3, radius: f64) -> Option<[DVec2; 2]> {
    let camera = &stage.camera;
    let (right, up, back) = (camera.right() * radius, camera.up() * radius, camera.backward() * radius);
    let (mut least, mut most) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for corner in [right + up, right - up, up - right, -right - up] {
        for depth in [back, -back] {
            let seen = camera.project(center + corner + depth, stage.input.viewport.aspect())?.truncate();
            (least, most) = (least.min(seen), most.max(seen));
        }
    }
    Some([least, most])
}
