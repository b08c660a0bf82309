//! What to show, as plain data: cameras, draw lists, overlays, picking, snapping. Knows neither egui nor OpenGL.
//!
//! [`build_draw_list`] turns a scene, a frame and a camera into a [`DrawList`]; `render` draws it.

mod bodies;
mod bounds;
mod build;
mod camera;
mod color;
mod draw_list;
mod first_person;
mod forces;
mod format;
mod front;
mod furniture;
mod gizmo;
mod input;
mod list_cache;
mod measure;
mod overlays;
mod pick;
mod see_through;
mod sight;
mod stage;
mod viewpoint;
mod views;

pub use bounds::{Bounds, scene_bounds};
pub use build::build_draw_list;
pub use camera::{AxisView, Camera, Projection, Ray};
pub use color::{Color, Palette, Theme, body_color};
pub use draw_list::{Align, Arrow, DrawList, Label, Line, Plate, Point, PointShape, Sphere, Stroke};
pub use format::{number, with_unit};
pub use gizmo::{
    Axis, Freedom, Grip, Guide, Handle, Knob, Neighbour, Pivot, Pull, Sides, Subject, Tool, Vector,
    VectorKind, aligned, features, fine_step, handle_at, knobs, pull, snap, snap_angle, snap_step,
    snap_value, touching,
};
pub use input::{ViewInput, Viewport};
pub use list_cache::ListCache;
pub use measure::{Measurable, Measured};
pub use overlays::{OVERLAYS, Overlay, OverlaySet, velocity_scale};
pub use pick::{Hit, pick, pick_outline, pick_rect};
pub use see_through::is_see_through;
pub use views::{VIEWS, ViewPreset};
