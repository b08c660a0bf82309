//! Axis views that are linked: one place in the middle of all, one magnification.

use glam::DVec3;

use super::Views;
use super::pane::Pane;
use crate::view::{Camera, Projection};

/// What linked views have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Middle {
    place: DVec3,
    metres_per_point: f64,
}

impl Pane {
    /// `None` for a view that takes no part.
    pub(super) fn middle(&self) -> Option<Middle> {
        let Camera { projection, target, height, .. } = self.camera;
        let along = projection == Projection::Orthographic && self.camera.axis_view().is_some();
        along.then(|| Middle { place: target, metres_per_point: height / self.points_high() })
    }

    fn take_middle(&mut self, middle: Middle) {
        if self.middle().is_some() {
            self.camera.target = middle.place;
            self.camera.height = middle.metres_per_point * self.points_high();
            self.camera = self.camera.usable();
        }
    }
}

impl Views {
    /// The other axis views look where this one looks now, if it moved.
    pub(super) fn share_if_moved(&mut self, index: usize, before: Option<Middle>) {
        let now = self.panes.get(index).and_then(Pane::middle);
        match now {
            Some(now) if self.linked && before.is_some_and(|before| before != now) => {
                self.panes.iter_mut().for_each(|pane| pane.take_middle(now));
            }
            _ => {}
        }
    }

    /// All axis views see what one of them saw, at the coarsest of their magnifications.
    pub(super) fn share_widest(&mut self) {
        if !self.linked {
            return;
        }
        let active = self.panes.get(self.active).and_then(Pane::middle);
        let known = || self.panes.iter().filter(|pane| !pane.wants_framing).filter_map(Pane::middle);
        let widest = known().map(|middle| middle.metres_per_point).fold(0.0, f64::max);
        if let Some(first) = active.or_else(|| known().next()).filter(|_| widest > 0.0) {
            let middle = Middle { metres_per_point: widest, ..first };
            self.panes.iter_mut().for_each(|pane| pane.take_middle(middle));
        }
    }
}
