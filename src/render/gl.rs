//! The few OpenGL calls beside three-d's, made safe: all `unsafe` of drawing is in this file.
#![allow(unsafe_code, reason = "glow declares every OpenGL call unsafe")]
#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "one reason for all: the arguments are valid for any state of the context, objects come from \
              the same context, and buffers are as large as the call says"
)]

use std::sync::Arc;

use glow::HasContext as _;

use super::{PixelRect, RenderError};

/// A context that is current on this thread.
#[derive(Clone)]
pub(super) struct Gl(pub Arc<glow::Context>);

impl Gl {
    /// The framebuffer that is being drawn into; `None` is the window's.
    pub fn bound_framebuffer(&self) -> Option<glow::Framebuffer> {
        unsafe { self.0.get_parameter_framebuffer(glow::DRAW_FRAMEBUFFER_BINDING) }
    }

    pub fn bind_framebuffer(&self, framebuffer: Option<glow::Framebuffer>) {
        unsafe { self.0.bind_framebuffer(glow::FRAMEBUFFER, framebuffer) }
    }

    /// What draws, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.
    pub fn device_name(&self) -> String {
        unsafe { self.0.get_parameter_string(glow::RENDERER) }
    }

    /// Whether the processor draws, not a GPU.
    pub fn is_software(&self) -> bool {
        const NAMES: [&str; 4] = ["llvmpipe", "softpipe", "SwiftShader", "Microsoft Basic Render"];
        let name = self.device_name();
        NAMES.iter().any(|software| name.contains(software))
    }

    /// Waits until all is drawn.
    pub fn finish(&self) {
        unsafe { self.0.finish() }
    }

    /// Limits drawing and copying to a rectangle.
    pub fn scissor(&self, rect: PixelRect) {
        unsafe {
            self.0.enable(glow::SCISSOR_TEST);
            self.0.scissor(rect.x, rect.y, rect.width, rect.height);
        }
    }

    /// Colour and depth of the whole bound framebuffer; alpha becomes 1.
    pub fn clear(&self) {
        unsafe {
            self.0.disable(glow::SCISSOR_TEST);
            self.0.color_mask(true, true, true, true);
            self.0.depth_mask(true);
            self.0.clear_color(0.0, 0.0, 0.0, 1.0);
            self.0.clear_depth_f32(1.0);
            self.0.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
        }
    }

    /// What lies beyond the near and far limit is drawn at the limit and not cut off. OpenGL ES cannot.
    pub fn clamp_depth(&self, on: bool) {
        if !self.0.version().is_embedded {
            self.switch(glow::DEPTH_CLAMP, on);
        }
    }

    /// A fragment's alpha decides how many of its samples it covers.
    pub fn cover_by_alpha(&self, on: bool) {
        self.switch(glow::SAMPLE_ALPHA_TO_COVERAGE, on);
    }

    /// Draws the first vertices of the buffers that are bound, each as a point of the size that its shader gives it.
    pub fn draw_points(&self, count: u32) {
        // OpenGL ES always asks the shader.
        let is_asked = !self.0.version().is_embedded;
        if is_asked {
            self.switch(glow::PROGRAM_POINT_SIZE, true);
        }
        unsafe { self.0.draw_arrays(glow::POINTS, 0, count as i32) };
        if is_asked {
            self.switch(glow::PROGRAM_POINT_SIZE, false);
        }
    }

    fn switch(&self, capability: u32, on: bool) {
        unsafe { if on { self.0.enable(capability) } else { self.0.disable(capability) } }
    }

    pub fn create_framebuffer(&self) -> Result<glow::Framebuffer, RenderError> {
        unsafe { self.0.create_framebuffer() }.map_err(RenderError::Gl)
    }

    pub fn create_renderbuffer(&self) -> Result<glow::Renderbuffer, RenderError> {
        unsafe { self.0.create_renderbuffer() }.map_err(RenderError::Gl)
    }

    pub fn delete_framebuffer(&self, framebuffer: glow::Framebuffer) {
        unsafe { self.0.delete_framebuffer(framebuffer) }
    }

    pub fn delete_renderbuffer(&self, renderbuffer: glow::Renderbuffer) {
        unsafe { self.0.delete_renderbuffer(renderbuffer) }
    }

    /// Longest side of a framebuffer, pixels, and most samples per pixel.
    pub fn limits(&self) -> (u32, i32) {
        unsafe {
            let side = self.0.get_parameter_i32(glow::MAX_RENDERBUFFER_SIZE);
            (side.max(1) as u32, self.0.get_parameter_i32(glow::MAX_SAMPLES))
        }
    }

    /// Gives a renderbuffer its memory and attaches it to a framebuffer, which stays bound.
    pub fn attach(
        &self,
        framebuffer: glow::Framebuffer,
        point: u32,
        (buffer, format, samples): (glow::Renderbuffer, u32, i32),
        [width, height]: [i32; 2],
    ) {
        unsafe {
            self.0.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
            self.0.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, width, height);
            self.0.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            self.0.framebuffer_renderbuffer(glow::FRAMEBUFFER, point, glow::RENDERBUFFER, Some(buffer));
        }
    }

    /// Whether the bound framebuffer can be drawn into.
    pub fn check_framebuffer(&self) -> Result<(), RenderError> {
        match unsafe { self.0.check_framebuffer_status(glow::FRAMEBUFFER) } {
            glow::FRAMEBUFFER_COMPLETE => Ok(()),
            status => Err(RenderError::Gl(format!("a framebuffer is refused (status {status:#x})"))),
        }
    }

    /// Copies the colours of one framebuffer to `to` (x, y from the bottom) of another, in the size that is wanted there.
    pub fn copy(
        &self,
        (from, [width, height]): (glow::Framebuffer, [i32; 2]),
        (onto, [wide, high]): (Option<glow::Framebuffer>, [i32; 2]),
        [x, y]: [i32; 2],
    ) {
        unsafe {
            self.0.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(from));
            self.0.bind_framebuffer(glow::DRAW_FRAMEBUFFER, onto);
            let filter = if [width, height] == [wide, high] { glow::NEAREST } else { glow::LINEAR };
            self.0.blit_framebuffer(
                0,
                0,
                width,
                height,
                x,
                y,
                x + wide,
                y + high,
                glow::COLOR_BUFFER_BIT,
                filter,
            );
        }
    }

    pub fn no_scissor(&self) {
        self.switch(glow::SCISSOR_TEST, false);
    }

    /// A framebuffer's bytes, RGBA, bottom row first.
    pub fn read(&self, framebuffer: glow::Framebuffer, [width, height]: [u32; 2]) -> Vec<u8> {
        let mut bytes = vec![0; width as usize * height as usize * 4];
        unsafe {
            self.0.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            self.0.pixel_store_i32(glow::PACK_ALIGNMENT, 1);
            let pixels = glow::PixelPackData::Slice(Some(&mut bytes));
            self.0.read_pixels(0, 0, width as i32, height as i32, glow::RGBA, glow::UNSIGNED_BYTE, pixels);
        }
        bytes
    }
}
