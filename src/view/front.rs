//! Which balls of a crowd are in front: a coarse picture of who is nearest where.

use glam::{DVec2, DVec3};

use super::{Camera, Viewport};

/// Side of a cell of that picture, points.
const CELL: f64 = 4.0;

/// How deep a place may lie behind the surface that hides it, as a share of the ball's radius: places where balls touch lie at
/// the edges of both.
const SKIN: f64 = 0.3;

/// A ball as it is seen.
struct Disc {
    /// Where the ball is, m.
    place: DVec3,
    /// Points from the top left corner.
    center: DVec2,
    size: f64,
    /// Of the centre along the view, and the radius, m.
    depth: f64,
    radius: f64,
}

impl Disc {
    fn of(camera: &Camera, viewport: Viewport, (place, radius): (DVec3, f64)) -> Option<Self> {
        let (center, depth) = seen(camera, viewport, place)?;
        let size = radius / camera.world_per_pixel_at(place, viewport.height);
        (center.is_finite() && size.is_finite()).then_some(Self { place, center, size, depth, radius })
    }

    /// Depth of its surface where it is seen, m; beyond its edge that of its edge.
    fn surface(&self, at: DVec2) -> f64 {
        let share = (at - self.center).length_squared() / (self.size * self.size);
        self.depth - self.radius * (1.0 - share.min(1.0)).sqrt()
    }

    fn covers(&self, at: DVec2) -> bool {
        self.center.distance_squared(at) < self.size * self.size
    }
}

/// Where a place is seen, points, and how far along the view, m.
fn seen(camera: &Camera, viewport: Viewport, place: DVec3) -> Option<(DVec2, f64)> {
    let seen = camera.project(place, viewport.aspect())?;
    Some((viewport.points(seen.truncate()), seen.z))
}

/// The nearest ball of each cell of a view.
pub(super) struct Front {
    camera: Camera,
    viewport: Viewport,
    discs: Vec<Disc>,
    columns: usize,
    /// Its place in `discs`, and the depth of its surface, m.
    cells: Vec<Option<(usize, f64)>>,
}

impl Front {
    /// Of balls by centre and radius, m.
    pub fn of(camera: Camera, viewport: Viewport, balls: impl Iterator<Item = (DVec3, f64)>) -> Self {
        let [columns, rows] =
            [viewport.width, viewport.height].map(|side| (side / CELL).ceil().max(1.0) as usize);
        let discs: Vec<_> = balls.filter_map(|ball| Disc::of(&camera, viewport, ball)).collect();
        let mut front = Self { camera, viewport, discs, columns, cells: vec![None; columns * rows] };
        for index in 0..front.discs.len() {
            front.enter(index, rows);
        }
        front
    }

    fn enter(&mut self, index: usize, rows: usize) {
        let disc = &self.discs[index];
        // One that is smaller than a cell is in that of its centre.
        let reach = disc.size.max(0.75 * CELL);
        let span = |middle: f64, count: usize| {
            let cell = |at: f64| ((at / CELL).floor().max(0.0) as usize).min(count);
            cell(middle - reach)..cell(middle + reach + CELL)
        };
        for row in span(disc.center.y, rows) {
            for column in span(disc.center.x, self.columns) {
                let at = (DVec2::new(column as f64, row as f64) + 0.5) * CELL;
                if at.distance_squared(disc.center) > reach * reach {
                    continue;
                }
                let surface = disc.surface(at);
                let cell = &mut self.cells[row * self.columns + column];
                if cell.is_none_or(|(_, nearest)| surface < nearest) {
                    *cell = Some((index, surface));
                }
            }
        }
    }

    /// Whether a ball that is nearest there or in a cell beside covers the place, and `lies_before` it: the ball, where the place is
    /// seen, and its depth, m.
    fn is_behind(&self, place: DVec3, lies_before: impl Fn(&Disc, DVec2, f64) -> bool) -> bool {
        let Some((at, depth)) = seen(&self.camera, self.viewport, place) else { return false };
        let [column, row] = (at / CELL).floor().to_array();
        let around = |middle: f64, count: usize| {
            let end = (middle + 2.0).clamp(0.0, count as f64);
            (middle - 1.0).max(0.0) as usize..end as usize
        };
        let rows = self.cells.len() / self.columns;
        around(row, rows).any(|row| {
            around(column, self.columns).any(|column| {
                let nearest = self.cells.get(row * self.columns + column).copied().flatten();
                nearest.is_some_and(|(index, _)| {
                    let disc = &self.discs[index];
                    disc.covers(at) && lies_before(disc, at, depth)
                })
            })
        })
    }

    /// Whether another ball lies before the one with its centre there.
    pub fn hides_ball_at(&self, center: DVec3) -> bool {
        self.is_behind(center, |disc, at, depth| disc.place != center && disc.surface(at) < depth)
    }

    /// Whether a ball lies before a place on the surface of balls.
    pub fn hides(&self, place: DVec3) -> bool {
        self.is_behind(place, |disc, at, depth| disc.surface(at) < depth - SKIN * disc.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Projection;

    #[test]
    fn balls_behind_others_are_hidden() {
        let (projection, target) = (Projection::Orthographic, DVec3::ZERO);
        let camera = Camera { projection, target, height: 10.0, ..Camera::default() };
        let near = camera.backward();
        let balls = [(DVec3::ZERO, 1.0), (near * 2.0, 0.9), (camera.right() * 1.5, 1.0), (-near * 9.0, 0.01)];
        let front = Front::of(camera, Viewport::new(400.0, 400.0, 1.0), balls.into_iter());
        let hidden = balls.map(|(center, _)| front.hides_ball_at(center));
        assert_eq!(hidden, [true, false, false, true]);
        assert!(front.hides(near), "behind the second");
        assert!(!front.hides(near * 2.9), "on it");
        assert!(!front.hides(camera.up() * 1.5 - near * 5.0), "beside all");
    }
}
