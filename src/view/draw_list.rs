//! A picture as plain data. Positions are metres relative to [`DrawList::origin`], so that they keep
//! their precision as f32 wherever in the world the view looks; widths and sizes are in points.

use glam::{DVec3, Mat4, Vec2, Vec3};

use super::{Color, Viewport};

/// Everything that one view shows, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawList {
    /// Differs whenever the content may differ; 0 = not known, never cached. Set by [`super::ListCache`].
    pub revision: u64,
    /// World position of the list's zero.
    pub origin: DVec3,
    pub viewport: Viewport,
    /// From the list's coordinates to the eye's, and from there to clip space.
    pub view: Mat4,
    pub projection: Mat4,
    pub is_perspective: bool,
    /// Top and bottom of the background.
    pub background: [Color; 2],
    pub spheres: Vec<Sphere>,
    /// Solid ones first, then glass.
    pub plates: Vec<Plate>,
    pub lines: Vec<Line>,
    pub arrows: Vec<Arrow>,
    pub points: Vec<Point>,
    /// Drawn last, flat on the view: axis triad, scale bar.
    pub strokes: Vec<Stroke>,
    /// Text to draw over the picture.
    pub labels: Vec<Label>,
    /// What the colours and arrows of this picture mean; already among the labels.
    pub legend: Vec<(Color, String)>,
    /// What this picture leaves out, one sentence each; to be shown to the user.
    pub notes: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    pub center: Vec3,
    pub radius: f32,
    pub color: Color,
    /// Ring around the silhouette (selected, hovered); width in points, 0 = none.
    pub outline: Color,
    pub outline_width: f32,
    /// Static bodies are hatched, as fixed parts are in engineering drawings.
    pub hatched: bool,
}

/// A two-sided rectangle with a corner and the edges from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    pub corner: Vec3,
    pub edge_x: Vec3,
    pub edge_y: Vec3,
    /// Alpha < 1 is drawn in the transparent pass.
    pub color: Color,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub from: Vec3,
    pub to: Vec3,
    pub color: Color,
    pub width: f32,
    /// Drawn over everything, else hidden by what is nearer.
    pub on_top: bool,
}

/// A line with a head whose size is in points. Always over the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    pub from: Vec3,
    pub to: Vec3,
    pub color: Color,
    pub width: f32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointShape {
    Disc,
    Ring,
    Diamond,
    Square,
    Cross,
}

/// A marker of constant size on the screen, over the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub position: Vec3,
    pub color: Color,
    pub size: f32,
    pub shape: PointShape,
}

/// A line flat on the view; points from its top left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    pub from: Vec2,
    pub to: Vec2,
    pub color: Color,
    pub width: f32,
}

/// Which point of the text's box lies at the label's position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    LeftCenter,
    Center,
    RightCenter,
    CenterTop,
    CenterBottom,
    LeftTop,
    RightBottom,
}

impl Align {
    /// The point's place in the box: 0 = left and top, 1 = right and bottom.
    pub fn fractions(self) -> (f32, f32) {
        match self {
            Self::LeftCenter => (0.0, 0.5),
            Self::Center => (0.5, 0.5),
            Self::RightCenter => (1.0, 0.5),
            Self::CenterTop => (0.5, 0.0),
            Self::CenterBottom => (0.5, 1.0),
            Self::LeftTop => (0.0, 0.0),
            Self::RightBottom => (1.0, 1.0),
        }
    }
}

/// Text over the picture; points from the view's top left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    pub position: Vec2,
    pub text: String,
    pub color: Color,
    /// Height of the font, points.
    pub size: f32,
    pub align: Align,
    /// Of a soft plate behind the text that keeps it legible over the scene; alpha 0 = none.
    pub back: Color,
}

impl DrawList {
    /// World position in the list's coordinates.
    pub fn local(&self, world: DVec3) -> Vec3 {
        (world - self.origin).as_vec3()
    }
}
