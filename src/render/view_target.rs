//! A view's own framebuffer, with its own depth and antialiasing. Drawn only when its content changes.

use std::sync::Arc;

use glow::HasContext as _;

use super::RenderError;

/// Samples per pixel.
const SAMPLES: i32 = 4;

/// A multisampled framebuffer and the plain one it is resolved into.
pub(super) struct ViewTarget {
    gl: Arc<glow::Context>,
    drawn: glow::Framebuffer,
    color: glow::Renderbuffer,
    depth: glow::Renderbuffer,
    resolved: glow::Framebuffer,
    resolved_color: glow::Renderbuffer,
    size: [u32; 2],
    /// What the resolved picture shows.
    pub revision: u64,
}

impl ViewTarget {
    pub fn new(gl: Arc<glow::Context>) -> Result<Self, RenderError> {
        // SAFETY: plain OpenGL calls on the current context, here and below.
        unsafe {
            Ok(Self {
                drawn: gl.create_framebuffer().map_err(RenderError::Gl)?,
                color: gl.create_renderbuffer().map_err(RenderError::Gl)?,
                depth: gl.create_renderbuffer().map_err(RenderError::Gl)?,
                resolved: gl.create_framebuffer().map_err(RenderError::Gl)?,
                resolved_color: gl.create_renderbuffer().map_err(RenderError::Gl)?,
                size: [0, 0],
                revision: 0,
                gl,
            })
        }
    }

    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Makes the framebuffer this large, if it isn't; its content is then lost.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        if self.size == size {
            return Ok(());
        }
        (self.size, self.revision) = ([0, 0], 0);
        let gl = &self.gl;
        let [width, height] = size.map(|side| side as i32);
        unsafe {
            let limit = gl.get_parameter_i32(glow::MAX_RENDERBUFFER_SIZE).max(1) as u32;
            if size[0] > limit || size[1] > limit {
                return Err(RenderError::Size(size[0], size[1], limit));
            }
            let samples = SAMPLES.min(gl.get_parameter_i32(glow::MAX_SAMPLES));
            let store = |buffer, samples, format| {
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, width, height);
            };
            store(self.color, samples, glow::RGBA8);
            store(self.depth, samples, glow::DEPTH_COMPONENT24);
            store(self.resolved_color, 0, glow::RGBA8);
            let attach = |framebuffer, point, buffer| {
                gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
                gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, point, glow::RENDERBUFFER, Some(buffer));
            };
            attach(self.resolved, glow::COLOR_ATTACHMENT0, self.resolved_color);
            attach(self.drawn, glow::COLOR_ATTACHMENT0, self.color);
            attach(self.drawn, glow::DEPTH_ATTACHMENT, self.depth);
            let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
            if status != glow::FRAMEBUFFER_COMPLETE {
                return Err(RenderError::Gl(format!(
                    "no framebuffer of {width}×{height} (status {status:#x})"
                )));
            }
        }
        self.size = size;
        Ok(())
    }

    /// Draws and resolves. Leaves its own framebuffers bound.
    pub fn draw(&mut self, revision: u64, draw: impl FnOnce()) {
        let [width, height] = self.size.map(|side| side as i32);
        unsafe {
            self.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.drawn));
            draw();
            self.gl.disable(glow::SCISSOR_TEST);
            self.gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(self.drawn));
            self.gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(self.resolved));
            blit(&self.gl, [0, 0, width, height], [0, 0, width, height]);
        }
        self.revision = revision;
    }

    /// Copies the resolved picture to `to` (x, y from the bottom) of another framebuffer, within the
    /// current scissor box. Leaves that framebuffer bound.
    pub fn copy_to(&self, framebuffer: Option<glow::Framebuffer>, to: [i32; 2]) {
        let [width, height] = self.size.map(|side| side as i32);
        unsafe {
            self.gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(self.resolved));
            self.gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer);
            blit(&self.gl, [0, 0, width, height], [to[0], to[1], to[0] + width, to[1] + height]);
            self.gl.bind_framebuffer(glow::FRAMEBUFFER, framebuffer);
        }
    }

    /// The resolved picture's bytes, RGBA, bottom row first.
    pub fn read(&self) -> Vec<u8> {
        let [width, height] = self.size;
        let mut bytes = vec![0; width as usize * height as usize * 4];
        unsafe {
            self.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.resolved));
            let pixels = glow::PixelPackData::Slice(Some(&mut bytes));
            self.gl.read_pixels(0, 0, width as i32, height as i32, glow::RGBA, glow::UNSIGNED_BYTE, pixels);
        }
        bytes
    }
}

unsafe fn blit(gl: &glow::Context, [x0, y0, x1, y1]: [i32; 4], [u0, v0, u1, v1]: [i32; 4]) {
    unsafe {
        gl.blit_framebuffer(x0, y0, x1, y1, u0, v0, u1, v1, glow::COLOR_BUFFER_BIT, glow::NEAREST);
    }
}

impl Drop for ViewTarget {
    fn drop(&mut self) {
        unsafe {
            self.gl.delete_framebuffer(self.drawn);
            self.gl.delete_framebuffer(self.resolved);
            self.gl.delete_renderbuffer(self.color);
            self.gl.delete_renderbuffer(self.depth);
            self.gl.delete_renderbuffer(self.resolved_color);
        }
    }
}
