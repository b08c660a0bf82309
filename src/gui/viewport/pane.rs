//! One view: its camera, its overlays, its picture and its title.

use egui::{Align2, FontId, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};
use glam::DVec3;

use super::company::Company;
use super::flying::Flying;
use super::gestures::{Gestures, Hover};
use super::{Scenery, bounds, gizmo, look_name};
use crate::gui::colors::{color32, tones};
use crate::gui::context::{AppContext, Message};
use crate::gui::numbers;
use crate::scene::{NodeKey, Shape};
use crate::view::{AxisView, Camera, ListCache, OverlaySet, Projection, ViewPreset};

pub struct Pane {
    pub(super) index: usize,
    preset: &'static ViewPreset,
    pub camera: Camera,
    pub overlays: OverlaySet,
    /// Look at all there is as soon as the view's size is known.
    pub wants_framing: bool,
    pub(super) company: Option<Company>,
    pub(super) flying: Option<Flying>,
    /// Whether the pointer was told to stay in the window.
    pub(super) holds_pointer: bool,
    /// What is being typed to save the present look under.
    pub(super) viewpoint_name: String,
    pub(super) gestures: Gestures,
    cache: ListCache,
    size: egui::Vec2,
    /// The view as a widget, once it was shown.
    pub(super) id: Option<egui::Id>,
}

/// What a turn of a view asks of the others.
#[derive(Default)]
pub struct Outcome {
    pub activated: bool,
    pub maximize: bool,
    /// The grip is dragged: the view goes to another place in the window.
    pub moved: bool,
    /// It shows what was before, and waits for its turn.
    pub behind: bool,
}

impl Pane {
    pub fn new(index: usize, preset: &'static ViewPreset) -> Self {
        Self {
            index,
            preset,
            camera: Camera::default(),
            overlays: preset.overlay_set(),
            wants_framing: true,
            company: None,
            flying: None,
            holds_pointer: false,
            viewpoint_name: String::new(),
            gestures: Gestures::default(),
            cache: ListCache::default(),
            size: egui::vec2(400.0, 300.0),
            id: None,
        }
    }

    /// Another document: no view shows the one before.
    pub(super) fn forget_picture(&mut self) {
        self.cache = ListCache::default();
    }

    pub fn aspect(&self) -> f64 {
        f64::from(self.size.x.max(1.0)) / f64::from(self.size.y.max(1.0))
    }

    /// Points from the top to the bottom.
    pub(super) fn points_high(&self) -> f64 {
        f64::from(self.size.y.max(1.0))
    }

    /// `tools` says whether the choice of handles is shown in this view, `is_next` whether it is drawn anew in this
    /// turn of the window however large the scene is.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        scenery: &Scenery<'_>,
        (marked, tools): (bool, bool),
        is_next: bool,
    ) -> Outcome {
        self.size = rect.size();
        if std::mem::take(&mut self.wants_framing)
            && let Some(bounds) = bounds(&scenery.shown.scene, &scenery.frame, None)
        {
            self.camera = self.preset.camera(bounds, self.aspect());
        }
        self.go_along(scenery);
        let id = ui.scope_id().with(("view", self.index));
        self.id = Some(id);
        let response = ui.interact(rect, id, Sense::click_and_drag());
        let name = format!("{} view", look_name(&self.camera));
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &name));

        let (hover, handles) = self.handle(ui, &response, rect, scenery);
        let pixels_per_point = ui.pixels_per_point();
        let mut input = scenery.input(self, rect, pixels_per_point);
        input.hovered = hover.as_ref().map(|hover| hover.key);
        let waits = !is_next && !response.contains_pointer();
        let kept = self.cache.kept().filter(|_| waits && !self.cache.knows(&input, scenery.shown.revision));
        let behind = kept.is_some();
        let list = kept.unwrap_or_else(|| self.cache.get(&input, scenery.shown.revision));
        scenery.canvas.draw(ui, (self.index, behind), rect, &list);

        self.draw_rubber_band(ui, rect);
        let seen = (&input.camera, input.viewport);
        if let Some(handles) = &handles {
            gizmo::show(ui, (id, rect), handles, seen, scenery);
        }
        if let Some(pulling) = &self.gestures.pulling {
            gizmo::show_pull(ui, rect, seen, pulling, scenery);
        }
        hover_label(ui, rect, &response, scenery, hover);
        if marked {
            let pen = Stroke::new(1.0, tones(ui).accent);
            ui.painter().rect_stroke(rect, 0.0, pen, StrokeKind::Inside);
        }
        if response.has_focus() {
            let pen = Stroke::new(1.5, tones(ui).accent);
            ui.painter().rect_stroke(rect.shrink(1.0), 0.0, pen, StrokeKind::Inside);
        }
        Self::context_menu(&response, scenery);
        let asked = self.corners(ui, rect, scenery);
        // last: what is shown only in the active view would change the identity of all that comes after it
        if tools {
            Self::tools(ui, rect, scenery);
        }
        let pressed = response.is_pointer_button_down_on() || response.clicked();
        let activated = pressed || asked.activate;
        Outcome { activated, maximize: asked.maximize, moved: asked.moved, behind }
    }

    pub fn look_from(&mut self, axis: Option<AxisView>) {
        match axis {
            Some(axis) => {
                self.camera.projection = Projection::Orthographic;
                self.camera.set_axis(axis);
            }
            None => {
                let (target, height) = (self.camera.target, self.camera.height);
                self.camera = Camera { target, height, ..Camera::default() };
            }
        }
    }
}

/// What lies under the pointer, in words, beside it.
fn hover_label(ui: &Ui, rect: Rect, response: &Response, scenery: &Scenery<'_>, hover: Option<Hover>) {
    let (Some(hover), Some(at)) = (hover, response.hover_pos()) else { return };
    if response.dragged() {
        return;
    }
    let Some(text) = describe(scenery, hover.key) else { return };
    let palette = scenery.context.palette();
    let painter = ui.painter_at(rect);
    let font = FontId::proportional(12.0);
    let galley = painter.layout_no_wrap(text, font, color32(palette.text));
    let mut corner = at + egui::vec2(14.0, 16.0);
    corner.x = corner.x.min(rect.right() - galley.size().x - 6.0).max(rect.left() + 4.0);
    if corner.y + galley.size().y > rect.bottom() - 4.0 {
        corner.y = at.y - galley.size().y - 8.0;
    }
    let back = Rect::from_min_size(corner, galley.size()).expand2(egui::vec2(5.0, 2.0));
    painter.rect_filled(back, 3.0, color32(palette.label_back));
    painter.galley(corner, galley, color32(palette.text));
}

fn describe(scenery: &Scenery<'_>, key: NodeKey) -> Option<String> {
    let name = scenery.shown.name(key)?;
    if let Some(body) = scenery.shown.body(key) {
        let kind = match (&body.shape, body.is_dynamic()) {
            (Shape::Sphere { .. }, true) => "sphere",
            (Shape::Sphere { .. }, false) => "static sphere",
            (Shape::Plane { .. }, _) => "static plane",
            (Shape::Unbuilt { .. }, _) => "not simulated",
        };
        let now = scenery.frame.bodies.iter().find(|now| now.key == key);
        let place = now.map_or(body.position, |now| now.position);
        let speed = now
            .map_or(String::new(), |now| format!("\n{} m/s", numbers::significant(now.velocity.length(), 4)));
        return Some(format!("{name} · {kind}\n{}{speed}", triple(place)));
    }
    Some(format!("{name} · force"))
}

fn triple(place: DVec3) -> String {
    let [x, y, z] = place.to_array().map(|value| numbers::significant(value, 4));
    format!("({x}, {y}, {z}) m")
}

/// In place of the views, when there is no scene to show.
pub fn nothing_to_show(ui: &mut Ui, area: Rect, context: &AppContext<'_>, says_why: bool) {
    let tones = tones(ui);
    if !says_why {
        return;
    }
    let center = area.center();
    let font = FontId::proportional(16.0);
    let text = format!("{} cannot be shown: the file has errors", context.session.title());
    ui.painter().text(center, Align2::CENTER_BOTTOM, text, font, tones.error);
    let below = Rect::from_center_size(center + egui::vec2(0.0, 24.0), egui::vec2(180.0, 26.0));
    if ui.put(below, egui::Button::new("Show the problems")).clicked() {
        context.outbox.send(Message::ShowProblems);
    }
}
