//! Draw lists onto the window: the picture by OpenGL, its labels by egui.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use eframe::egui_glow;
use egui::{Align2, FontId, Rect, Ui, vec2};

use super::drafts::Drafts;
use crate::gui::colors::color32;
use crate::render::{PixelRect, Quality, Renderer, Showing};
use crate::view::{Color, DrawList, Label};

/// What draws the views; without OpenGL (in tests) it draws only their labels.
#[derive(Clone, Default)]
pub struct Canvas {
    gpu: Option<Arc<Gpu>>,
}

struct Gpu {
    renderer: Mutex<Renderer>,
    /// Why the pictures of some views were not drawn.
    failures: Mutex<BTreeMap<usize, String>>,
    drafts: Mutex<Drafts>,
    redraws: AtomicU64,
}

impl Canvas {
    /// Compiles the shaders. The error says why views stay empty.
    pub fn new(gl: Option<&Arc<glow::Context>>) -> (Self, Option<String>) {
        match gl.map(|gl| Renderer::new(gl.clone())) {
            None => (Self::default(), None),
            Some(Err(error)) => (Self::default(), Some(error.to_string())),
            Some(Ok(renderer)) => {
                let gpu = Gpu {
                    renderer: Mutex::new(renderer),
                    failures: Mutex::default(),
                    drafts: Mutex::default(),
                    redraws: AtomicU64::new(0),
                };
                (Self { gpu: Some(Arc::new(gpu)) }, None)
            }
        }
    }

    pub fn redraws(&self) -> u64 {
        self.gpu.as_ref().map_or(0, |gpu| gpu.redraws.load(Ordering::Relaxed))
    }

    /// Whether every picture is drawn in full from now on.
    pub fn draw_in_full(&self, on: bool) {
        if let Some(gpu) = &self.gpu {
            gpu.drafts().in_full = on;
        }
    }

    /// Whether one of the views that are shown is a draft yet.
    pub fn has_drafts(&self, is_shown: impl Fn(usize) -> bool) -> bool {
        self.gpu.as_ref().is_some_and(|gpu| gpu.drafts().has_drafts(is_shown))
    }

    /// Puts a view's picture and labels at `rect`. `view` distinguishes the views; `waits` says that it is to show something
    /// else as soon as it has its turn.
    pub fn draw(&self, ui: &Ui, (view, waits): (usize, bool), rect: Rect, list: &Arc<DrawList>) {
        let painter = ui.painter_at(rect);
        if let Some(gpu) = &self.gpu {
            let failure = gpu.failures().get(&view).cloned();
            if failure.is_some() {
                let [ground, _] = list.background;
                painter.rect_filled(rect, 0.0, color32(ground));
            }
            let now_s = ui.input(|input| input.time);
            let (quality, again_s) = gpu.drafts().quality(view, (list.revision, waits), now_s);
            if let Some(again_s) = again_s {
                ui.ctx().request_repaint_after(Duration::from_secs_f64(again_s));
            }
            let (gpu, list) = (gpu.clone(), list.clone());
            let callback =
                egui_glow::CallbackFn::new(move |info, _| gpu.paint((view, quality), &list, &info));
            painter.add(egui::PaintCallback { rect, callback: Arc::new(callback) });
            if let Some(failure) = failure {
                let font = FontId::proportional(13.0);
                let color = ui.visuals().error_fg_color;
                painter.text(rect.center(), Align2::CENTER_CENTER, failure, font, color);
            }
        }
        for label in &list.labels {
            draw_label(&painter, rect, label);
        }
        draw_notes(&painter, rect, list);
    }
}

impl Gpu {
    fn drafts(&self) -> MutexGuard<'_, Drafts> {
        self.drafts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn failures(&self) -> MutexGuard<'_, BTreeMap<usize, String>> {
        self.failures.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn paint(&self, (view, quality): (usize, Quality), list: &DrawList, info: &egui::PaintCallbackInfo) {
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        let rect = pixel_rect(&info.viewport_in_pixels());
        let clip = pixel_rect(&info.clip_rect_in_pixels());
        let begun = Instant::now();
        match renderer.paint(view, list, Showing { rect, clip, quality }) {
            Ok(false) => {}
            Ok(true) => {
                self.failures().remove(&view);
                self.drafts().note(view, quality, begun.elapsed().as_secs_f64());
                self.redraws.fetch_add(1, Ordering::Relaxed);
            }
            Err(error) => {
                self.failures().insert(view, error.to_string());
            }
        }
    }
}

fn pixel_rect(rect: &egui::epaint::ViewportInPixels) -> PixelRect {
    PixelRect { x: rect.left_px, y: rect.from_bottom_px, width: rect.width_px, height: rect.height_px }
}

fn draw_label(painter: &egui::Painter, rect: Rect, label: &Label) {
    let font = FontId::proportional(label.size);
    let galley = painter.layout_no_wrap(label.text.clone(), font, color32(label.color));
    let (across, down) = label.align.fractions();
    let size = galley.size();
    let at = rect.min + vec2(label.position.x - across * size.x, label.position.y - down * size.y);
    if label.back != Color::NONE {
        let back = Rect::from_min_size(at, size).expand2(vec2(3.0, 0.0));
        painter.rect_filled(back, 2.0, color32(label.back));
    }
    painter.galley(at, galley, color32(label.color));
}

/// What the picture leaves out, under the view's title.
fn draw_notes(painter: &egui::Painter, rect: Rect, list: &DrawList) {
    let visuals = &painter.ctx().style_of(painter.ctx().theme()).visuals;
    for (line, note) in list.notes.iter().enumerate() {
        let at = rect.left_top() + vec2(10.0, 32.0 + 17.0 * line as f32);
        let font = FontId::proportional(11.5);
        let galley = painter.layout_no_wrap(note.clone(), font, visuals.warn_fg_color);
        let back = Rect::from_min_size(at, galley.size()).expand2(vec2(4.0, 1.0));
        painter.rect_filled(back, 2.0, visuals.panel_fill.gamma_multiply(0.85));
        painter.galley(at, galley, visuals.warn_fg_color);
    }
}
