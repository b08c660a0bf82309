//! A view's own framebuffer, with its own depth and antialiasing. Drawn only when its content changes.

use super::RenderError;
use super::gl::Gl;

/// Samples per pixel.
const SAMPLES: i32 = 4;

/// A multisampled framebuffer and the plain one it is resolved into.
pub(super) struct ViewTarget {
    gl: Gl,
    drawn: glow::Framebuffer,
    color: glow::Renderbuffer,
    depth: glow::Renderbuffer,
    resolved: glow::Framebuffer,
    resolved_color: glow::Renderbuffer,
    size: [u32; 2],
    /// What the resolved picture shows.
    revision: u64,
}

impl ViewTarget {
    pub fn new(gl: Gl) -> Result<Self, RenderError> {
        Ok(Self {
            drawn: gl.create_framebuffer()?,
            color: gl.create_renderbuffer()?,
            depth: gl.create_renderbuffer()?,
            resolved: gl.create_framebuffer()?,
            resolved_color: gl.create_renderbuffer()?,
            size: [0, 0],
            revision: 0,
            gl,
        })
    }

    /// Whether the picture of that revision and size is there already; revision 0 never is.
    pub fn shows(&self, revision: u64, size: [u32; 2]) -> bool {
        revision != 0 && self.revision == revision && self.size == size
    }

    /// Makes the framebuffer this large, if it is not; its content is then lost.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        if self.size == size {
            return Ok(());
        }
        (self.size, self.revision) = ([0, 0], 0);
        let (limit, most_samples) = self.gl.limits();
        if size[0] > limit || size[1] > limit {
            return Err(RenderError::Size(size[0], size[1], limit));
        }
        let samples = SAMPLES.min(most_samples);
        let signed = size.map(|side| side as i32);
        let attach = |framebuffer, point, buffer| self.gl.attach(framebuffer, point, buffer, signed);
        attach(self.resolved, glow::COLOR_ATTACHMENT0, (self.resolved_color, glow::RGBA8, 0));
        attach(self.drawn, glow::COLOR_ATTACHMENT0, (self.color, glow::RGBA8, samples));
        attach(self.drawn, glow::DEPTH_ATTACHMENT, (self.depth, glow::DEPTH_COMPONENT24, samples));
        self.gl.check_framebuffer()?;
        self.size = size;
        Ok(())
    }

    /// Draws and resolves. Leaves its own framebuffers bound.
    pub fn draw(&mut self, revision: u64, draw: impl FnOnce()) {
        self.gl.bind_framebuffer(Some(self.drawn));
        draw();
        self.gl.no_scissor();
        self.gl.copy(self.drawn, self.signed_size(), Some(self.resolved), [0, 0]);
        self.revision = revision;
    }

    /// Copies the resolved picture to `to` (x, y from the bottom) of another framebuffer, within the
    /// current scissor box. Leaves that framebuffer bound.
    pub fn copy_to(&self, framebuffer: Option<glow::Framebuffer>, to: [i32; 2]) {
        self.gl.copy(self.resolved, self.signed_size(), framebuffer, to);
        self.gl.bind_framebuffer(framebuffer);
    }

    /// The resolved picture's bytes, RGBA, bottom row first.
    pub fn read(&self) -> Vec<u8> {
        self.gl.read(self.resolved, self.size)
    }

    fn signed_size(&self) -> [i32; 2] {
        self.size.map(|side| side as i32)
    }
}

impl Drop for ViewTarget {
    fn drop(&mut self) {
        [self.drawn, self.resolved].into_iter().for_each(|buffer| self.gl.delete_framebuffer(buffer));
        let buffers = [self.color, self.depth, self.resolved_color];
        buffers.into_iter().for_each(|buffer| self.gl.delete_renderbuffer(buffer));
    }
}
