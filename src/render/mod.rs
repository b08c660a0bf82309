//! Draw lists to pixels with OpenGL: into a window's framebuffer, or into a picture without a window.
//! Knows nothing of egui.

mod batch;
mod beads;
mod error;
mod gl;
mod offscreen;
mod passes;
mod picture;
mod programs;
mod renderer;
mod stand_in;
mod text;
mod view_target;

pub use error::RenderError;
pub use offscreen::Offscreen;
pub use picture::{Tile, check_png_name, png, render_picture, write_png};
pub use renderer::{PixelRect, Renderer, Showing};
pub use text::draw_labels;
pub use view_target::Quality;
