//! Everything a picture of the scene depends on.

use glam::DVec2;

use super::{Camera, OverlaySet, Theme};
use crate::record::{EventRow, Frame};
use crate::scene::{NodeKey, Scene};

/// Size of a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// In points: pixels divided by `pixels_per_point`. All widths and text sizes are in points.
    pub width: f64,
    pub height: f64,
    pub pixels_per_point: f64,
}

impl Viewport {
    pub fn new(width: f64, height: f64, pixels_per_point: f64) -> Self {
        Self { width: width.max(1.0), height: height.max(1.0), pixels_per_point }
    }

    pub fn aspect(&self) -> f64 {
        self.width / self.height
    }

    /// Points from the top left corner to normalised device coordinates.
    pub fn ndc(&self, points: DVec2) -> DVec2 {
        DVec2::new(2.0 * points.x / self.width - 1.0, 1.0 - 2.0 * points.y / self.height)
    }

    /// Normalised device coordinates to points from the top left corner.
    pub fn points(&self, ndc: DVec2) -> DVec2 {
        DVec2::new(0.5 * (ndc.x + 1.0) * self.width, 0.5 * (1.0 - ndc.y) * self.height)
    }
}

/// What to show and from where. Borrowed for one frame.
#[derive(Clone, Copy)]
pub struct ViewInput<'a> {
    pub scene: &'a Scene,
    /// The simulation's picture: its positions override the scene's, by key.
    pub frame: Option<&'a Frame>,
    pub camera: Camera,
    pub viewport: Viewport,
    pub overlays: OverlaySet,
    pub theme: Theme,
    /// Bodies and forces, by document key.
    pub selection: &'a [NodeKey],
    pub hovered: Option<NodeKey>,
    /// The body whose centre the eye is at: it is not seen.
    pub inside: Option<NodeKey>,
    /// The event whose place is marked.
    pub highlighted: Option<&'a EventRow>,
}

impl<'a> ViewInput<'a> {
    /// A picture of the scene's start, nothing selected, default overlays.
    pub fn new(scene: &'a Scene, camera: Camera, viewport: Viewport) -> Self {
        Self {
            scene,
            frame: None,
            camera,
            viewport,
            overlays: OverlaySet::default(),
            theme: Theme::Dark,
            selection: &[],
            hovered: None,
            inside: None,
            highlighted: None,
        }
    }
}
