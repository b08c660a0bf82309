//! OpenGL without a window, an X server or a GPU: EGL's device platform, in software if need be.

use std::sync::Arc;

use glutin::api::egl::context::PossiblyCurrentContext;
use glutin::api::egl::{device::Device, display::Display};
use glutin::config::{ConfigSurfaceTypes, ConfigTemplateBuilder};
use glutin::context::{ContextApi, ContextAttributesBuilder, GlProfile, Version};
use glutin::prelude::*;

use super::gl::Gl;
use super::stand_in::StandIn;
use super::{RenderError, Renderer, draw_labels};
use crate::view::DrawList;

/// A windowless context, current on the thread that made it, and a renderer in it.
pub struct Offscreen {
    // First: their objects must be deleted while the context lives.
    renderer: Renderer,
    window: StandIn,
    gl: Arc<glow::Context>,
    _context: PossiblyCurrentContext,
    _display: Display,
}

impl Offscreen {
    /// Tries every device that EGL offers. The error says what to install.
    pub fn new() -> Result<Self, RenderError> {
        let devices = Device::query_devices().map_err(|error| RenderError::NoContext(error.to_string()))?;
        let mut failures = Vec::new();
        for device in devices {
            match Self::on(&device) {
                Ok(offscreen) => return Ok(offscreen),
                Err(error) => failures.push(format!("{}: {error}", device.name().unwrap_or("device"))),
            }
        }
        let why = if failures.is_empty() { "EGL offers no device".to_owned() } else { failures.join("; ") };
        Err(RenderError::NoContext(why))
    }

    #[allow(unsafe_code, reason = "glutin cannot know that the display outlives what is made from it")]
    fn on(device: &Device) -> Result<Self, Box<dyn std::error::Error>> {
        let template = ConfigTemplateBuilder::new().with_surface_type(ConfigSurfaceTypes::empty()).build();
        let attributes = ContextAttributesBuilder::new()
            .with_context_api(ContextApi::OpenGl(Some(Version::new(3, 3))))
            .with_profile(GlProfile::Core)
            .build(None);
        // SAFETY: the display comes from a device of this process, the configuration and the context from
        // the display, and both are kept alive as long as `gl`.
        unsafe {
            let display = Display::with_device(device, None)?;
            let config = display.find_configs(template)?.next().ok_or("no configuration")?;
            let context = display.create_context(&config, &attributes)?.make_current_surfaceless()?;
            let gl = glow::Context::from_loader_function_cstr(|name| display.get_proc_address(name));
            let gl = Arc::new(gl);
            let renderer = Renderer::new(Arc::clone(&gl))?;
            let window = StandIn::new(Gl(Arc::clone(&gl)))?;
            Ok(Self { renderer, window, gl, _context: context, _display: display })
        }
    }

    pub fn gl(&self) -> &Arc<glow::Context> {
        &self.gl
    }

    /// What draws, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.
    pub fn device_name(&self) -> String {
        Gl(Arc::clone(&self.gl)).device_name()
    }

    /// Binds a framebuffer of that size in place of a window's, for what expects to draw into one.
    pub fn bind_window(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        self.window.bind(size)
    }

    /// What was drawn since into the framebuffer of [`Self::bind_window`].
    pub fn read_window(&self) -> Result<image::RgbaImage, RenderError> {
        let (size, bytes) = self.window.read();
        let mut picture = to_picture(size, bytes)?;
        image::imageops::flip_vertical_in_place(&mut picture);
        Ok(picture)
    }

    /// The picture of a list at its viewport's size, labels included.
    pub fn render(&mut self, list: &DrawList) -> Result<image::RgbaImage, RenderError> {
        let viewport = list.viewport;
        let side = |points: f64| (points * viewport.pixels_per_point).round().clamp(1.0, 65_536.0) as u32;
        let size = [side(viewport.width), side(viewport.height)];
        let bytes = self.renderer.read(list, size)?;
        let mut picture = to_picture(size, bytes)?;
        draw_labels(&mut picture, list)?;
        Ok(picture)
    }
}

fn to_picture([width, height]: [u32; 2], bytes: Vec<u8>) -> Result<image::RgbaImage, RenderError> {
    image::RgbaImage::from_raw(width, height, bytes)
        .ok_or_else(|| RenderError::Gl("the picture came back incomplete".to_owned()))
}
