//! Mouse and keys in a view: turn, move and magnify it; point at, select and drag bodies.

use egui::{Align2, FontId, Key, PointerButton, Pos2, Rect, Response, Stroke, StrokeKind, Ui};
use glam::{DVec2, DVec3};

use super::pane::Pane;
use super::{Scenery, ndc};
use crate::editor::{Action, Drag, Gesture, ViewCommand};
use crate::gui::colors::color32;
use crate::gui::context::Message;
use crate::gui::numbers;
use crate::scene::NodeKey;
use crate::view::{Hit, Projection, ViewInput, drag_in_plane, pick, pick_rect, snap, snap_step};

/// Radians that the scene turns per point of dragging.
const TURN_PER_POINT: f64 = 0.008;

/// Magnification per point of scrolling.
const ZOOM_PER_POINT: f64 = 0.0035;

/// Clicks this near to the last one go on to what lies below, points.
const SAME_PLACE: f32 = 4.0;

/// First of the numbers that distinguish drags in views from other gestures.
const DRAG_GESTURE: u64 = 0x6472_6167_0000;

/// What goes on in one view.
#[derive(Default)]
pub struct Gestures {
    /// Corners of a selection rectangle.
    rubber: Option<(Pos2, Pos2)>,
    moving: Option<Moving>,
    /// Where the last click was, and how many went to that place.
    last_click: Option<(Pos2, usize)>,
    hover: Option<(HoverKey, Option<Hover>)>,
}

struct Moving {
    drag: Drag,
    /// Where the pointer took hold, and the place in the world it drags.
    from: DVec2,
    grabbed: DVec3,
    offset: DVec3,
}

/// What the pointer is over.
#[derive(Clone, Copy, PartialEq)]
pub struct Hover {
    pub key: NodeKey,
}

/// What the answer to "what lies under the pointer" depends on.
#[derive(Clone, Copy, PartialEq)]
struct HoverKey {
    at: Pos2,
    scene: u64,
    frame: u64,
    camera: crate::view::Camera,
}

impl Gestures {
    pub fn is_dragging(&self) -> bool {
        self.moving.is_some() || self.rubber.is_some()
    }
}

impl Pane {
    /// Takes in the mouse and the keys; returns what the pointer is over.
    pub(super) fn handle(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
    ) -> Option<Hover> {
        self.move_camera(ui, response, rect);
        self.keys(ui, response);
        let input = scenery.input(self, rect, ui.pixels_per_point());
        let hover = self.hover(response, rect, scenery, &input);
        if response.clicked() {
            response.request_focus();
            self.click(ui, response, rect, scenery, &input);
        }
        if response.double_clicked() && hover.is_some() {
            scenery.context.outbox.command(ViewCommand::FrameSelection);
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.take_hold(ui, rect, scenery, &input);
        }
        if self.gestures.is_dragging() && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.give_up(scenery);
        }
        if response.dragged_by(PointerButton::Primary) {
            self.pull(ui, response, rect, scenery, &input);
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            self.let_go(ui, rect, scenery, &input);
        }
        hover
    }

    fn move_camera(&mut self, ui: &Ui, response: &Response, rect: Rect) {
        let delta = response.drag_delta();
        let delta = DVec2::new(f64::from(delta.x), f64::from(delta.y));
        let shift = ui.input(|input| input.modifiers.shift);
        let turning =
            response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary);
        if turning && delta != DVec2::ZERO {
            // views along an axis stay along it, as the drawings of a CAD program do
            let fixed =
                self.camera.projection == Projection::Orthographic && self.camera.axis_view().is_some();
            if shift || fixed {
                self.camera.pan(delta, f64::from(rect.height()));
            } else {
                self.camera.orbit(delta.x * TURN_PER_POINT, delta.y * TURN_PER_POINT);
            }
        }
        if response.contains_pointer()
            && let Some(at) = response.hover_pos()
        {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = libm::exp(f64::from(scroll) * ZOOM_PER_POINT) * f64::from(pinch);
            if factor != 1.0 {
                let viewport = crate::view::Viewport::new(rect.width().into(), rect.height().into(), 1.0);
                self.camera.zoom_to_cursor(ndc(&viewport, rect, at), viewport.aspect(), factor);
            }
        }
    }

    /// Arrows turn or move the view that has the keyboard, Page Up and Page Down magnify.
    fn keys(&mut self, ui: &Ui, response: &Response) {
        if !response.has_focus() {
            return;
        }
        let filter = egui::EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..egui::EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let (across, up, nearer) = ui.input(|input| {
            let axis = |plus, minus| {
                f64::from(u8::from(input.key_pressed(plus))) - f64::from(u8::from(input.key_pressed(minus)))
            };
            (
                axis(Key::ArrowRight, Key::ArrowLeft),
                axis(Key::ArrowUp, Key::ArrowDown),
                axis(Key::PageUp, Key::PageDown),
            )
        });
        let fixed = self.camera.projection == Projection::Orthographic && self.camera.axis_view().is_some();
        if fixed {
            self.camera.pan(DVec2::new(-across, up) * 30.0, f64::from(response.rect.height()));
        } else {
            self.camera.orbit(-across * 0.08, up * 0.08);
        }
        if nearer != 0.0 {
            self.camera.zoom_to_cursor(DVec2::ZERO, 1.0, libm::exp(0.2 * nearer));
        }
    }

    /// Looks only when pointer, scene, frame or camera have changed.
    fn hover(
        &mut self,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
        input: &ViewInput<'_>,
    ) -> Option<Hover> {
        let at = response.hover_pos().filter(|_| response.hovered() && !response.dragged())?;
        let key = HoverKey {
            at,
            scene: scenery.shown.revision,
            frame: scenery.frame.revision,
            camera: self.camera,
        };
        if let Some((known, hover)) = self.gestures.hover
            && known == key
        {
            return hover;
        }
        let hits = pick(input, ndc(&input.viewport, rect, at));
        let hover = hits.first().map(|hit| Hover { key: hit.key });
        self.gestures.hover = Some((key, hover));
        hover
    }

    fn click(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
        input: &ViewInput<'_>,
    ) {
        let Some(at) = response.interact_pointer_pos() else { return };
        let hits = pick(input, ndc(&input.viewport, rect, at));
        let again = match self.gestures.last_click {
            Some((last, count)) if last.distance(at) < SAME_PLACE && !response.double_clicked() => count + 1,
            Some((last, count)) if last.distance(at) < SAME_PLACE => count,
            _ => 0,
        };
        self.gestures.last_click = Some((at, again));
        let hit = (!hits.is_empty()).then(|| hits[again % hits.len()].key);
        let outbox = scenery.context.outbox;
        let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
        match (hit, add) {
            (Some(key), true) => outbox.act(Action::ToggleSelected(key)),
            (Some(key), false) => outbox.act(Action::Select(vec![key])),
            (None, true) => {}
            (None, false) => outbox.act(Action::Select(Vec::new())),
        }
    }

    /// A press that became a drag: moves bodies in views along an axis, else draws a rectangle.
    fn take_hold(&mut self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        let Some(at) = ui.input(|input| input.pointer.press_origin()) else { return };
        let from = ndc(&input.viewport, rect, at);
        let hits = pick(input, from);
        let movable = self.camera.projection == Projection::Orthographic;
        match movable.then(|| self.grab(&hits, scenery)).flatten() {
            Some((_, hit)) if self.waits_for_start(hit.key, scenery) => {
                let text = "Moving bodies are dragged where they start: Reset first (R)";
                scenery.context.outbox.send(Message::Tell(text.to_owned()));
            }
            Some((drag, hit)) => {
                let moving = Moving { drag, from, grabbed: hit.point, offset: DVec3::ZERO };
                self.gestures.moving = Some(moving);
            }
            None => self.gestures.rubber = Some((at, at)),
        }
    }

    /// What to drag: the selection, if some of it is under the pointer; else the moving body there.
    fn grab(&self, hits: &[Hit], scenery: &Scenery<'_>) -> Option<(Drag, Hit)> {
        let session = scenery.context.session;
        let gesture = Gesture(DRAG_GESTURE + self.index as u64);
        if let Some(hit) = hits.iter().find(|hit| session.selection().contains(hit.key)) {
            return Some((Drag::of_selection(session, gesture)?, *hit));
        }
        let hit = hits.first()?;
        scenery.shown.body(hit.key).filter(|body| body.is_dynamic())?;
        scenery.context.outbox.act(Action::Select(vec![hit.key]));
        Some((Drag::of(session, &[hit.key], gesture)?, *hit))
    }

    /// Whether a body is drawn where the simulation has it, not where the document has it.
    fn waits_for_start(&self, key: NodeKey, scenery: &Scenery<'_>) -> bool {
        let is_dynamic = scenery.shown.body(key).is_some_and(crate::scene::Body::is_dynamic);
        is_dynamic && !scenery.context.session.shows_start()
    }

    fn pull(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
        input: &ViewInput<'_>,
    ) {
        let Some(at) = response.interact_pointer_pos() else { return };
        if let Some((_, corner)) = &mut self.gestures.rubber {
            *corner = at;
        }
        let Some(moving) = &mut self.gestures.moving else { return };
        let to = ndc(&input.viewport, rect, at);
        let mut offset =
            drag_in_plane(&input.camera, input.viewport.aspect(), moving.grabbed, moving.from, to);
        let flip = ui.input(|input| input.modifiers.command);
        if scenery.snapping != flip {
            let step = snap_step(&input.camera, input.viewport);
            let start = moving.drag.origin();
            let free = offset;
            offset = snap(start + free, step) - start;
            // along the view nothing was dragged, so nothing snaps
            let back = input.camera.backward();
            offset -= back * offset.dot(back);
        }
        if offset != moving.offset {
            moving.offset = offset;
            scenery.context.outbox.act(moving.drag.move_by(offset));
        }
    }

    fn let_go(&mut self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        let outbox = scenery.context.outbox;
        if self.gestures.moving.take().is_some() {
            outbox.act(Action::EndGesture);
        }
        if let Some((a, b)) = self.gestures.rubber.take() {
            let keys = pick_rect(input, ndc(&input.viewport, rect, a), ndc(&input.viewport, rect, b));
            let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
            outbox.act(if add { Action::AddToSelection(keys) } else { Action::Select(keys) });
        }
    }

    /// Escape: everything is again as it was before the drag, whose rest does nothing.
    fn give_up(&mut self, scenery: &Scenery<'_>) {
        if self.gestures.moving.take().is_some() {
            scenery.context.outbox.act(Action::AbandonGesture);
        }
        self.gestures.rubber = None;
    }

    pub(super) fn draw_rubber_band(&self, ui: &Ui, rect: Rect) {
        let Some((a, b)) = self.gestures.rubber else { return };
        let accent = crate::gui::colors::tones(ui).accent;
        let painter = ui.painter_at(rect);
        let band = Rect::from_two_pos(a, b);
        painter.rect_filled(band, 0.0, accent.gamma_multiply(0.12));
        painter.rect_stroke(band, 0.0, Stroke::new(1.0, accent), StrokeKind::Inside);
    }

    /// How far a drag has gone and where to, in numbers.
    pub(super) fn draw_drag_text(&self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>) {
        let Some(moving) = &self.gestures.moving else { return };
        let triple = |v: DVec3| {
            let [x, y, z] = v.to_array().map(|value| numbers::significant(value, 5));
            format!("({x}, {y}, {z})")
        };
        let snapping = if scenery.snapping { " · snapping" } else { "" };
        let place = moving.drag.origin() + moving.offset;
        let text = format!(
            "to {} m\nby {} m{snapping} · Esc cancels, Ctrl switches snapping",
            triple(place),
            triple(moving.offset)
        );
        let palette = scenery.context.palette();
        let painter = ui.painter_at(rect);
        let at = rect.center_bottom() - egui::vec2(0.0, 12.0);
        let font = FontId::proportional(12.0);
        let galley = painter.layout_no_wrap(text, font, color32(palette.text));
        let place = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
        painter.rect_filled(place.expand(5.0), 3.0, color32(palette.label_back));
        painter.galley(place.min, galley, color32(palette.text));
    }
}
