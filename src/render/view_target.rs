//! A view's own framebuffer, with its own depth and antialiasing. Drawn only when its content changes.

use super::RenderError;
use super::gl::Gl;

/// How well a picture is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// Every pixel, antialiased.
    #[default]
    Full,
    /// Half as many pixels each way, and not antialiased: while things move and drawing takes long.
    Draft,
}

impl Quality {
    /// Samples per pixel.
    fn samples(self) -> i32 {
        match self {
            Self::Full => 4,
            Self::Draft => 0,
        }
    }

    /// Pixels that are drawn for so many that are shown.
    pub(super) fn pixels(self, shown: u32) -> u32 {
        match self {
            Self::Full => shown,
            Self::Draft => shown.div_ceil(2),
        }
    }
}

/// A multisampled framebuffer and the plain one it is resolved into.
pub(super) struct ViewTarget {
    gl: Gl,
    drawn: glow::Framebuffer,
    color: glow::Renderbuffer,
    depth: glow::Renderbuffer,
    resolved: glow::Framebuffer,
    resolved_color: glow::Renderbuffer,
    /// Of what is shown; how it is drawn decides how many pixels there are.
    size: [u32; 2],
    quality: Quality,
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
            quality: Quality::Full,
            revision: 0,
            gl,
        })
    }

    /// Whether the picture of that revision and size is there already, as well or better drawn; revision 0 never is.
    pub fn shows(&self, revision: u64, size: [u32; 2], quality: Quality) -> bool {
        let is_good = self.quality == quality || self.quality == Quality::Full;
        revision != 0 && self.revision == revision && self.size == size && is_good
    }

    /// Makes the framebuffer right for this size, if it is not; its content is then lost.
    pub fn resize(&mut self, shown: [u32; 2], quality: Quality) -> Result<(), RenderError> {
        if (self.size, self.quality) == (shown, quality) {
            return Ok(());
        }
        (self.size, self.revision) = ([0, 0], 0);
        let size = shown.map(|side| quality.pixels(side));
        let (limit, most_samples) = self.gl.limits();
        if size[0] > limit || size[1] > limit {
            return Err(RenderError::Size(size[0], size[1], limit));
        }
        let samples = quality.samples().min(most_samples);
        let signed = size.map(|side| side as i32);
        let attach = |framebuffer, point, buffer| self.gl.attach(framebuffer, point, buffer, signed);
        attach(self.resolved, glow::COLOR_ATTACHMENT0, (self.resolved_color, glow::RGBA8, 0));
        attach(self.drawn, glow::COLOR_ATTACHMENT0, (self.color, glow::RGBA8, samples));
        attach(self.drawn, glow::DEPTH_ATTACHMENT, (self.depth, glow::DEPTH_COMPONENT24, samples));
        self.gl.check_framebuffer()?;
        (self.size, self.quality) = (shown, quality);
        Ok(())
    }

    /// Draws and resolves. Leaves its own framebuffers bound.
    pub fn draw(&mut self, revision: u64, draw: impl FnOnce()) {
        self.gl.bind_framebuffer(Some(self.drawn));
        draw();
        self.gl.no_scissor();
        let size = self.drawn_size();
        self.gl.copy((self.drawn, size), (Some(self.resolved), size), [0, 0]);
        self.revision = revision;
    }

    /// Copies the resolved picture to `to` (x, y from the bottom) of another framebuffer, within the
    /// current scissor box. Leaves that framebuffer bound.
    pub fn copy_to(&self, framebuffer: Option<glow::Framebuffer>, to: [i32; 2]) {
        let shown = self.size.map(|side| side as i32);
        self.gl.copy((self.resolved, self.drawn_size()), (framebuffer, shown), to);
        self.gl.bind_framebuffer(framebuffer);
    }

    /// The resolved picture's bytes, RGBA, bottom row first.
    pub fn read(&self) -> Vec<u8> {
        self.gl.read(self.resolved, self.drawn_size().map(|side| side as u32))
    }

    fn drawn_size(&self) -> [i32; 2] {
        self.size.map(|side| self.quality.pixels(side) as i32)
    }
}

impl Drop for ViewTarget {
    fn drop(&mut self) {
        [self.drawn, self.resolved].into_iter().for_each(|buffer| self.gl.delete_framebuffer(buffer));
        let buffers = [self.color, self.depth, self.resolved_color];
        buffers.into_iter().for_each(|buffer| self.gl.delete_renderbuffer(buffer));
    }
}
