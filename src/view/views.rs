//! The standard views of a quad window, in reading order, with what each shows at first.

use super::{AxisView, Bounds, Camera, OverlaySet};

/// One standard view.
pub struct ViewPreset {
    /// As the command line and settings write it.
    pub id: &'static str,
    pub label: &'static str,
    /// `None` is the oblique perspective.
    pub axis: Option<AxisView>,
    /// Ids of the overlays shown at first.
    pub overlays: &'static [&'static str],
}

/// Perspective at the top left, then top, front and right.
pub const VIEWS: [ViewPreset; 4] = [
    ViewPreset {
        id: "perspective",
        label: "Perspective",
        axis: None,
        overlays: &["map", "contacts", "impact", "velocities", "turning", "states", "distances"],
    },
    ViewPreset { id: "top", label: "Top", axis: Some(AxisView::Top), overlays: ORTHO },
    ViewPreset { id: "front", label: "Front", axis: Some(AxisView::Front), overlays: ORTHO },
    ViewPreset { id: "right", label: "Right", axis: Some(AxisView::Right), overlays: ORTHO },
];

const ORTHO: &[&str] = &["map", "grid", "contacts", "impact", "turning", "states", "distances"];

impl ViewPreset {
    /// This view of the whole of `bounds`.
    pub fn camera(&self, bounds: Bounds, aspect: f64) -> Camera {
        match self.axis {
            Some(axis) => Camera::axis(axis, bounds, aspect),
            None => Camera::perspective(bounds, aspect),
        }
    }

    pub fn overlay_set(&self) -> OverlaySet {
        OverlaySet::from_ids(self.overlays.iter().copied())
    }
}
