//! Draws views into a window's framebuffer, and keeps each view's picture until its draw list changes.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use super::RenderError;
use super::passes::Passes;
use super::view_target::{Quality, ViewTarget};
use crate::view::DrawList;

/// A rectangle of a framebuffer in pixels; `y` counts from the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    pub x: i32,
    pub y: i32,
    pub width: i32,
    pub height: i32,
}

impl PixelRect {
    /// What both cover; may be empty.
    pub fn intersection(self, other: Self) -> Self {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let right = (self.x + self.width).min(other.x + other.width);
        let top = (self.y + self.height).min(other.y + other.height);
        Self { x, y, width: (right - x).max(0), height: (top - y).max(0) }
    }

    fn is_empty(self) -> bool {
        self.width <= 0 || self.height <= 0
    }
}

/// Where a view's picture goes in the bound framebuffer, what of that is seen, and how it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Showing {
    pub rect: PixelRect,
    pub clip: PixelRect,
    pub quality: Quality,
}

/// Everything that lives in one OpenGL context. All calls must be made with that context current.
pub struct Renderer {
    passes: Passes,
    views: BTreeMap<usize, ViewTarget>,
    is_software: bool,
}

impl Renderer {
    /// Compiles the shaders.
    pub fn new(gl: Arc<glow::Context>) -> Result<Self, RenderError> {
        let context = three_d::Context::from_gl_context(gl)?;
        let passes = Passes::new(context)?;
        let is_software = passes.gl().is_software();
        Ok(Self { passes, views: BTreeMap::new(), is_software })
    }

    /// Puts the picture of `list` where it is to be shown; redraws it only if `list.revision` or the size differs from what
    /// this `view` (any number the caller chooses) showed last, or if it was drawn less well. Leaves the bound framebuffer
    /// bound; other state (scissor, blending, program) is not restored. Returns whether it was redrawn. The labels are left
    /// to the caller. Where the processor draws, it is done when this returns: the caller can see how long it takes.
    pub fn paint(&mut self, view: usize, list: &DrawList, showing: Showing) -> Result<bool, RenderError> {
        let Showing { rect, clip, quality } = showing;
        let visible = rect.intersection(clip);
        if visible.is_empty() {
            return Ok(false);
        }
        let gl = self.passes.gl();
        let bound = gl.bound_framebuffer();
        let redrawn = self.update(view, list, [rect.width as u32, rect.height as u32], quality);
        if self.is_software && matches!(redrawn, Ok(true)) {
            gl.finish();
        }
        gl.scissor(visible);
        gl.bind_framebuffer(bound);
        let redrawn = redrawn?;
        if let Some(target) = self.views.get(&view) {
            target.copy_to(bound, [rect.x, rect.y]);
        }
        Ok(redrawn)
    }

    /// Forgets the pictures of views that are no longer shown.
    pub fn keep_views(&mut self, keep: impl Fn(usize) -> bool) {
        self.views.retain(|view, _| keep(*view));
    }

    /// Draws `list` at that size and returns the pixels: RGBA, top row first, without labels.
    pub(super) fn read(&mut self, list: &DrawList, size: [u32; 2]) -> Result<Vec<u8>, RenderError> {
        const PICTURE: usize = usize::MAX;
        self.update(PICTURE, list, size, Quality::Full)?;
        let bottom_up = self.views.get(&PICTURE).map(ViewTarget::read).unwrap_or_default();
        let row = size[0] as usize * 4;
        Ok(bottom_up.chunks_exact(row.max(1)).rev().flatten().copied().collect())
    }

    fn update(
        &mut self,
        view: usize,
        list: &DrawList,
        size: [u32; 2],
        quality: Quality,
    ) -> Result<bool, RenderError> {
        let target = match self.views.entry(view) {
            Entry::Occupied(entry) => entry.into_mut(),
            Entry::Vacant(entry) => entry.insert(ViewTarget::new(self.passes.gl())?),
        };
        if target.shows(list.revision, size, quality) {
            return Ok(false);
        }
        target.resize(size, quality)?;
        target.draw(list.revision, || self.passes.draw(list, size, quality));
        Ok(true)
    }
}
