//! The window with its views drawn: egui's own painter and the views' OpenGL, in a windowless context.
#![allow(unsafe_code, reason = "glow declares every OpenGL call unsafe")]
#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "one reason for all: the context is current on this thread, objects and buffers are its own"
)]
#![allow(clippy::iter_over_hash_type, reason = "the order in which textures are set makes no difference")]

use std::collections::BTreeSet;
use std::sync::Arc;

use eframe::egui_glow;
use egui::{Key, Rect};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{Harness, TestRenderer};
use glow::HasContext as _;
use image::RgbaImage;
use polyscene::gui::App;
use polyscene::render::Offscreen;

use super::gui_support::{SIZE, parts, sample_path};

/// Stands in for the window: a framebuffer that egui paints into.
struct GlowRenderer {
    painter: egui_glow::Painter,
    gl: Arc<glow::Context>,
    framebuffer: glow::Framebuffer,
    size: [u32; 2],
    // last: the context must outlive what is made in it
    _context: Offscreen,
}

impl GlowRenderer {
    fn new() -> Self {
        let context = Offscreen::new().expect("OpenGL in software");
        let gl = context.gl().clone();
        let painter = egui_glow::Painter::new(gl.clone(), "", None, false).unwrap();
        let size = SIZE.map(|side| side as u32);
        let framebuffer = unsafe {
            let framebuffer = gl.create_framebuffer().unwrap();
            let color = gl.create_renderbuffer().unwrap();
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(color));
            let [width, height] = size.map(|side| side as i32);
            gl.renderbuffer_storage(glow::RENDERBUFFER, glow::RGBA8, width, height);
            let (target, point) = (glow::FRAMEBUFFER, glow::COLOR_ATTACHMENT0);
            gl.framebuffer_renderbuffer(target, point, glow::RENDERBUFFER, Some(color));
            framebuffer
        };
        Self { painter, gl, framebuffer, size, _context: context }
    }
}

impl TestRenderer for GlowRenderer {
    fn setup_eframe(&self, cc: &mut eframe::CreationContext<'_>, _frame: &mut eframe::Frame) {
        cc.gl = Some(self.gl.clone());
    }

    #[allow(clippy::iter_over_hash_type, reason = "textures do not depend on each other")]
    fn handle_delta(&mut self, delta: &mut egui::TexturesDelta) {
        for (id, images) in delta.set.drain() {
            for image in images {
                self.painter.set_texture(id, &image);
            }
        }
        for id in delta.free.drain() {
            self.painter.free_texture(id);
        }
    }

    fn render(&mut self, ctx: &egui::Context, output: &egui::FullOutput) -> Result<RgbaImage, String> {
        let [width, height] = self.size;
        unsafe { self.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer)) };
        self.painter.clear(self.size, [0.0, 0.0, 0.0, 1.0]);
        self.painter.paint_primitives(self.size, 1.0, &ctx.tessellate(output.shapes.clone(), 1.0));
        let mut bytes = vec![0; (width * height * 4) as usize];
        unsafe {
            self.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(self.framebuffer));
            let into = glow::PixelPackData::Slice(Some(&mut bytes));
            self.gl.read_pixels(0, 0, width as i32, height as i32, glow::RGBA, glow::UNSIGNED_BYTE, into);
        }
        let mut picture = RgbaImage::from_raw(width, height, bytes).ok_or("an incomplete picture")?;
        image::imageops::flip_vertical_in_place(&mut picture);
        Ok(picture)
    }
}

impl Drop for GlowRenderer {
    fn drop(&mut self) {
        self.painter.destroy();
    }
}

fn window() -> Harness<'static, App> {
    let path = sample_path("thesis-appendix-2");
    let mut harness = Harness::builder()
        .with_size(SIZE)
        .with_max_steps(12)
        .renderer(GlowRenderer::new())
        .build_eframe(move |cc| App::new(cc, parts(Some(path))));
    harness.run();
    harness
}

fn rect(harness: &Harness<'_, App>, view: &str) -> Rect {
    harness.get_by_role_and_label(egui::accesskit::Role::Canvas, view).rect()
}

/// Different colours inside a view, away from its title.
fn colors(picture: &RgbaImage, rect: Rect) -> BTreeSet<[u8; 4]> {
    let rect = rect.shrink(4.0).with_min_y(rect.min.y + 34.0);
    let (xs, ys) = (rect.min.x as u32..rect.max.x as u32, rect.min.y as u32..rect.max.y as u32);
    ys.flat_map(|y| xs.clone().map(move |x| (x, y))).map(|(x, y)| picture.get_pixel(x, y).0).collect()
}

#[test]
fn every_view_shows_the_thesis_scene() {
    let mut harness = window();
    let picture = harness.render().unwrap();
    for view in ["Perspective view", "Top view", "Front view", "Right view"] {
        // three shaded spheres in colours of their own; a background alone has a few dozen greys
        let colors = colors(&picture, rect(&harness, view));
        let has = |what: &str, like: fn(i32, i32, i32) -> bool| {
            let found = colors.iter().any(|[r, g, b, _]| like((*r).into(), (*g).into(), (*b).into()));
            assert!(found, "no {what} in {view}");
        };
        has("blue sphere", |r, _, b| b > r + 60);
        has("orange sphere", |r, _, b| r > b + 80);
        has("green sphere", |r, g, b| g > r + 40 && g > b + 20);
        assert!(colors.len() > 500, "{view}: {} colours", colors.len());
    }
}

#[test]
fn views_are_drawn_anew_only_when_they_change() {
    let mut harness = window();
    harness.render().unwrap();
    let first = harness.state().view_redraws();
    assert!(first >= 4);
    // the mouse over a panel, a menu: the window repaints, the views do not
    harness.hover_at(egui::pos2(60.0, 200.0));
    harness.run();
    harness.render().unwrap();
    assert_eq!(harness.state().view_redraws(), first);
    harness.key_press(Key::Period);
    harness.run();
    harness.render().unwrap();
    assert_eq!(harness.state().view_redraws(), first + 4);
    // turning one view draws that one
    let center = rect(&harness, "Perspective view").center();
    let button = egui::PointerButton::Middle;
    let press = |pressed| egui::Event::PointerButton {
        pos: center,
        button,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    harness.event(egui::Event::PointerMoved(center));
    harness.event(press(true));
    harness.run();
    harness.render().unwrap();
    let before = harness.state().view_redraws();
    harness.event(egui::Event::PointerMoved(center + egui::vec2(30.0, 0.0)));
    harness.run();
    harness.render().unwrap();
    assert_eq!(harness.state().view_redraws(), before + 1);
}

/// Holds the handle of a selected body and moves the pointer on, without letting go.
fn hold(harness: &mut Harness<'_, App>, body: &str, knob: &str, way: egui::Vec2, modifiers: egui::Modifiers) {
    harness.get_by_role_and_label(egui::accesskit::Role::TreeItem, body).click();
    harness.run();
    let handle = egui::accesskit::Role::GraphicsSymbol;
    let pos = harness.get_by_role_and_label(handle, knob).rect().center();
    harness.event(egui::Event::PointerMoved(pos));
    harness.step();
    let button = egui::PointerButton::Primary;
    harness.event(egui::Event::PointerButton { pos, button, pressed: true, modifiers });
    harness.step();
    for share in [0.5, 1.0] {
        harness.event_modifiers(egui::Event::PointerMoved(pos + share * way), modifiers);
        harness.step();
    }
}

/// How many pixels of a view two pictures have otherwise.
fn differing(a: &RgbaImage, b: &RgbaImage, rect: Rect) -> usize {
    let (xs, ys) = (rect.min.x as u32..rect.max.x as u32, rect.min.y as u32..rect.max.y as u32);
    let pixels = ys.flat_map(|y| xs.clone().map(move |x| (x, y)));
    pixels.filter(|(x, y)| a.get_pixel(*x, *y) != b.get_pixel(*x, *y)).count()
}

#[test]
fn a_drag_shows_where_it_leads() {
    let drags = [
        ("15921", "Move in the picture in Top view", "Top view", egui::vec2(28.0, 50.0)),
        ("28100", "Turn about y in Perspective view", "Perspective view", egui::vec2(-40.0, -14.0)),
        ("5853", "Tip of the arrow in Front view", "Front view", egui::vec2(40.0, -60.0)),
    ];
    for (index, (body, knob, view, way)) in drags.into_iter().enumerate() {
        let mut harness = window();
        if index == 1 {
            harness.key_press(Key::E);
        }
        let before = harness.render().unwrap();
        hold(&mut harness, body, knob, way, egui::Modifiers::COMMAND);
        let during = harness.render().unwrap();
        let changed = differing(&before, &during, rect(&harness, view));
        assert!(changed > 800, "{knob}: {changed} pixels");
    }
}
