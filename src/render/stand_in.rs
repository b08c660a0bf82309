//! A framebuffer that stands in for a window's, where there is no window.

use super::RenderError;
use super::gl::Gl;

pub(super) struct StandIn {
    gl: Gl,
    framebuffer: glow::Framebuffer,
    color: glow::Renderbuffer,
    depth: glow::Renderbuffer,
    size: [u32; 2],
}

impl StandIn {
    pub fn new(gl: Gl) -> Result<Self, RenderError> {
        let (framebuffer, color) = (gl.create_framebuffer()?, gl.create_renderbuffer()?);
        Ok(Self { framebuffer, color, depth: gl.create_renderbuffer()?, size: [0, 0], gl })
    }

    /// Makes it this large, if it is not, and binds it.
    pub fn bind(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        if self.size != size {
            self.size = [0, 0];
            let signed = size.map(|side| side as i32);
            let attach = |point, buffer, format| {
                self.gl.attach(self.framebuffer, point, (buffer, format, 0), signed);
            };
            attach(glow::COLOR_ATTACHMENT0, self.color, glow::RGBA8);
            attach(glow::DEPTH_ATTACHMENT, self.depth, glow::DEPTH_COMPONENT24);
            self.gl.check_framebuffer()?;
            self.size = size;
        }
        self.gl.bind_framebuffer(Some(self.framebuffer));
        Ok(())
    }

    /// Its size and bytes, RGBA, bottom row first.
    pub fn read(&self) -> ([u32; 2], Vec<u8>) {
        (self.size, self.gl.read(self.framebuffer, self.size))
    }
}

impl Drop for StandIn {
    fn drop(&mut self) {
        self.gl.delete_framebuffer(self.framebuffer);
        self.gl.delete_renderbuffer(self.color);
        self.gl.delete_renderbuffer(self.depth);
    }
}
