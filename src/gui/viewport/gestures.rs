//! Mouse and keys in a view: turn, move and magnify it; point at, select and drag bodies.

use egui::{CursorIcon, Key, PointerButton, Pos2, Rect, Response, Ui};
use glam::{DVec2, DVec3};

use super::manipulate::{Asked, Manipulation};
use super::pane::Pane;
use super::rubber::Rubber;
use super::{Scenery, gizmo, ndc};
use crate::editor::{Action, Drag, Gesture, ViewCommand};
use crate::gui::context::Message;
use crate::scene::{NodeKey, Shape};
use crate::view::{
    Axis, Grip, Handle, Hit, Knob, Pivot, Projection, Subject, ViewInput, Viewport, handle_at, knobs, pick,
    snap_step,
};

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
    /// Something drawn to select what is in it.
    pub(super) rubber: Option<Rubber>,
    /// A handle or body that is being dragged.
    pub(super) pulling: Option<Manipulation>,
    /// Where the last click was, and how many went to that place.
    last_click: Option<(Pos2, usize)>,
    hover: Option<(HoverKey, Option<Hover>)>,
}

/// The handles of a view in one turn of the window.
pub(super) struct Handles {
    pub subject: Subject,
    pub knobs: Vec<Knob>,
    /// The one under the pointer, or being dragged.
    pub active: Option<Handle>,
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
        self.pulling.is_some() || self.rubber.is_some()
    }
}

impl Pane {
    /// Takes in the mouse and the keys; returns what the pointer is over, and the handles to draw.
    pub(super) fn handle(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
    ) -> (Option<Hover>, Option<Handles>) {
        if self.go_flying(ui, response, scenery) {
            return (None, None);
        }
        self.move_camera(ui, response, rect);
        let viewport = scenery.input(self, rect, ui.pixels_per_point()).viewport;
        self.keys(ui, response, scenery, viewport);
        let input = scenery.input(self, rect, ui.pixels_per_point());
        let handles = self.handles(response, rect, scenery, &input);
        let on_handle = handles.as_ref().is_some_and(|handles| handles.active.is_some());
        if on_handle {
            ui.set_cursor_icon(CursorIcon::Grab);
        }
        let hover = if on_handle { None } else { self.hover(response, rect, scenery, &input) };
        // Enter, which takes a typed number, is a click of what has the keyboard
        if response.clicked() && !self.gestures.is_dragging() {
            response.request_focus();
            self.click(ui, response, rect, scenery, &input);
        }
        if response.secondary_clicked() {
            point_out(response, rect, scenery, &input);
        }
        if response.double_clicked() && hover.is_some() {
            scenery.context.outbox.command(ViewCommand::FrameSelection);
        }
        if response.drag_started_by(PointerButton::Primary) {
            // what is typed now is meant for the drag
            response.request_focus();
            self.take_hold(ui, rect, scenery, &input);
        }
        if self.gestures.is_dragging() {
            self.drag(ui, response, scenery, &input);
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            self.let_go(ui, rect, scenery, &input);
        }
        (hover, handles)
    }

    /// The handles of the selection, and which one the pointer is over.
    fn handles(
        &self,
        response: &Response,
        rect: Rect,
        scenery: &Scenery<'_>,
        input: &ViewInput<'_>,
    ) -> Option<Handles> {
        if self.gestures.rubber.is_some() {
            return None;
        }
        let subject = gizmo::subject(scenery, &input.camera, input.viewport)?;
        let mut knobs = knobs(&subject, &input.camera, input.viewport);
        let active = match &self.gestures.pulling {
            Some(pulling) => {
                // only what is dragged: the others would be in the way of what one looks at
                knobs.retain(|knob| knob.handle == pulling.grip.handle);
                Some(pulling.grip.handle)
            }
            None => {
                let over = response.hover_pos().filter(|_| response.hovered() && !response.dragged());
                over.and_then(|at| handle_at(&knobs, points(rect, at)))
            }
        };
        Some(Handles { subject, knobs, active })
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
                let viewport = Viewport::new(rect.width().into(), rect.height().into(), 1.0);
                self.camera.zoom_to_cursor(ndc(&viewport, rect, at), viewport.aspect(), factor);
            }
        }
    }

    /// Arrows move the selection by a round step, or without one, or with Alt, turn or move the view that has the
    /// keyboard. Page Up and Page Down magnify.
    fn keys(&mut self, ui: &Ui, response: &Response, scenery: &Scenery<'_>, viewport: Viewport) {
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
        let of_view = ui.input(|input| input.modifiers.alt) || scenery.context.session.selection().is_empty();
        let fixed = self.camera.projection == Projection::Orthographic && self.camera.axis_view().is_some();
        // With Ctrl they order the tree.
        let of_tree = ui.input(|input| input.modifiers.command);
        if !of_view && !of_tree {
            self.nudge(scenery, snap_step(&self.camera, viewport), across, up);
        } else if fixed {
            self.camera.pan(DVec2::new(-across, up) * 30.0, f64::from(response.rect.height()));
        } else {
            self.camera.orbit(-across * 0.08, up * 0.08);
        }
        if nearer != 0.0 {
            self.camera.zoom_to_cursor(DVec2::ZERO, 1.0, libm::exp(0.2 * nearer));
        }
    }

    /// Moves the selection along the axes that lie most across and most up the view.
    fn nudge(&self, scenery: &Scenery<'_>, step: f64, across: f64, up: f64) {
        if across == 0.0 && up == 0.0 {
            return;
        }
        let along = |direction: DVec3| {
            let largest = direction.abs().max_element();
            let axis = DVec3::AXES.into_iter().find(|axis| direction.dot(*axis).abs() == largest);
            axis.map_or(DVec3::ZERO, |axis| axis * direction.dot(axis).signum())
        };
        let right = along(self.camera.right());
        let offset = (right * across + along(self.camera.up()) * up) * step;
        if let Some(edit) = scenery.context.session.nudge(offset) {
            scenery.context.outbox.act(Action::Edit { edit, gesture: None });
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

    /// A press that became a drag: takes a handle or a body, else draws a rectangle; with Alt an
    /// outline, whatever is there.
    fn take_hold(&mut self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        let Some(at) = ui.input(|input| input.pointer.press_origin()) else { return };
        if ui.input(|input| input.modifiers.alt) {
            self.gestures.rubber = Some(Rubber::begin(at, true));
            return;
        }
        let from = ndc(&input.viewport, rect, at);
        let taken = self.take_handle(rect, at, scenery, input);
        let grabbed = || self.grab(&pick(input, from), scenery);
        match taken.map_or_else(grabbed, Taken::Pull) {
            Taken::Pull(pulling) => self.gestures.pulling = Some(*pulling),
            Taken::Refused => {
                let text = "Moving bodies are dragged where they start: Reset first (R)";
                scenery.context.outbox.send(Message::Tell(text.to_owned()));
            }
            Taken::Body(drag, hit) => {
                let subject = Subject {
                    tool: scenery.tool,
                    pivot: drag.origin(),
                    axes: Axis::ALL.map(Axis::unit),
                    sides: None,
                    vector: None,
                };
                let grip = Grip::take_body(subject, hit.point, from);
                let pulling = Manipulation::new(drag, grip, Some(hit.key), points(rect, at));
                self.gestures.pulling = Some(pulling);
            }
            Taken::Nothing => self.gestures.rubber = Some(Rubber::begin(at, false)),
        }
    }

    /// The handle under the pointer.
    fn take_handle(
        &self,
        rect: Rect,
        at: Pos2,
        scenery: &Scenery<'_>,
        input: &ViewInput<'_>,
    ) -> Option<Box<Manipulation>> {
        let subject = gizmo::subject(scenery, &input.camera, input.viewport)?;
        let knobs = knobs(&subject, &input.camera, input.viewport);
        let handle = handle_at(&knobs, points(rect, at))?;
        let session = scenery.context.session;
        let drag = match handle {
            Handle::MapSide(_) => Drag::of_map(self.gesture()),
            _ => {
                let drag = Drag::of_selection(session, self.gesture())?;
                drag.each_by_itself(scenery.pivot == Pivot::Each)
            }
        };
        let from = ndc(&input.viewport, rect, at);
        let grip = Grip::take(handle, subject, &input.camera, input.viewport, from)?;
        Some(Box::new(Manipulation::new(drag, grip, None, points(rect, at))))
    }

    /// What a body under the pointer drags: the selection, if it is in it, else itself if it moves. Plates are
    /// dragged by their handles alone: a floor fills the view, where most drags are meant to be rectangles.
    fn grab(&self, hits: &[Hit], scenery: &Scenery<'_>) -> Taken {
        let session = scenery.context.session;
        let is_plate = |key: NodeKey| {
            scenery.shown.body(key).is_some_and(|body| !matches!(body.shape, Shape::Sphere { .. }))
        };
        let selected = |hit: &&Hit| session.selection().contains(hit.key) && !is_plate(hit.key);
        let moves = |hit: &&Hit| scenery.shown.body(hit.key).is_some_and(crate::scene::Body::is_dynamic);
        let (drag, hit) = match (hits.iter().find(selected), hits.first().filter(moves)) {
            (Some(hit), _) => (Drag::of_selection(session, self.gesture()), *hit),
            (None, Some(hit)) => (Drag::of(session, &[hit.key], self.gesture()), *hit),
            (None, None) => return Taken::Nothing,
        };
        let Some(drag) = drag else { return Taken::Nothing };
        if self.waits_for_start(&drag, scenery) {
            return Taken::Refused;
        }
        if !session.selection().contains(hit.key) {
            scenery.context.outbox.act(Action::Select(vec![hit.key]));
        }
        Taken::Body(drag, hit)
    }

    fn gesture(&self) -> Gesture {
        Gesture(DRAG_GESTURE + self.index as u64)
    }

    /// Whether a body is drawn where the simulation has it, not where the document has it.
    fn waits_for_start(&self, drag: &Drag, scenery: &Scenery<'_>) -> bool {
        drag.bodies().iter().any(crate::scene::Body::is_dynamic) && !scenery.context.session.shows_start()
    }

    /// One turn of the window in a drag.
    fn drag(&mut self, ui: &Ui, response: &Response, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        if let (Some(rubber), Some(at)) = (&mut self.gestures.rubber, response.interact_pointer_pos()) {
            rubber.draw_to(at);
        }
        let Some(pulling) = &mut self.gestures.pulling else {
            if ui.input(|input| input.key_pressed(Key::Escape)) {
                self.gestures.rubber = None;
            }
            return;
        };
        let asked = pulling.keys(ui);
        if asked == Asked::GiveUp {
            // everything is again as it was before the drag, whose rest does nothing
            scenery.context.outbox.act(Action::AbandonGesture);
            self.gestures.pulling = None;
            return;
        }
        if let Some(at) = response.interact_pointer_pos() {
            let map = &scenery.shown.scene.map;
            let tile = map.size / glam::UVec3::from_array(map.tiles).as_dvec3();
            pulling.tiles = self.overlays.contains("tiles").then_some(tile);
            pulling.follow(ui, points(response.rect, at), &input.camera, input.viewport, scenery);
        }
        if asked == Asked::Confirm {
            pulling.confirm(scenery);
            self.gestures.pulling = None;
        }
    }

    fn let_go(&mut self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        if let Some(pulling) = self.gestures.pulling.take() {
            pulling.confirm(scenery);
        }
        if let Some(rubber) = self.gestures.rubber.take() {
            rubber.select(ui, rect, scenery, input);
        }
    }
}

/// What a drag took hold of.
enum Taken {
    Pull(Box<Manipulation>),
    Body(Drag, Hit),
    /// A moving body that is not where it starts.
    Refused,
    Nothing,
}

/// A right click selects what it points at, unless that is part of the selection: its menu is about that.
fn point_out(response: &Response, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
    let Some(at) = response.interact_pointer_pos() else { return };
    let hits = pick(input, ndc(&input.viewport, rect, at));
    let selection = scenery.context.session.selection();
    if let Some(hit) = hits.first()
        && !hits.iter().any(|hit| selection.contains(hit.key))
    {
        scenery.context.outbox.act(Action::Select(vec![hit.key]));
    }
}

/// Points from a view's top left corner.
fn points(rect: Rect, at: Pos2) -> DVec2 {
    DVec2::new(f64::from(at.x - rect.min.x), f64::from(at.y - rect.min.y))
}
