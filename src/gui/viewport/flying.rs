//! Flying through the scene in a perspective view: keys move the eye, the mouse turns it.

use egui::viewport::CursorGrab;
use egui::{CursorIcon, Event, Key, Response, Ui, ViewportCommand};

use super::pane::Pane;
use super::{AppContext, Message, Scenery, Views};
use crate::view::Projection;

/// Sizes of the map a second.
const SPEED: f64 = 0.2;

/// How often that where Shift is held.
const FASTER: f64 = 4.0;

/// Speeds that the wheel can reach, sizes of the map a second, and how many points of it make one e times the other.
const SPEEDS: (f64, f64) = (0.002, 20.0);
const WHEEL: f64 = 250.0;

/// Radians that the head turns per point of the mouse's way.
const TURN_PER_POINT: f64 = 0.004;

/// Nearer things are not drawn, as a share of the map's size: one flies up to them.
const NEAR: f64 = 1e-3;

/// A turn of the window counts at most so long, s: after a pause one is where one was.
const LONGEST: f64 = 0.1;

#[derive(Clone, Copy)]
pub(super) struct Flying {
    /// Sizes of the map a second.
    speed: f64,
}

impl Views {
    /// Flies in the active view, or if it has no perspective in the first that has one.
    pub(super) fn fly(&mut self, context: &AppContext<'_>) {
        let Some(shown) = context.shown else { return };
        let in_perspective = |index: &usize| {
            let camera = self.panes.get(*index).map(|pane| pane.camera.projection);
            self.is_shown(*index) && camera == Some(Projection::Perspective)
        };
        let known = std::iter::once(self.active).chain(0..self.panes.len()).find(in_perspective);
        self.active = known.unwrap_or(self.active);
        let pane = &mut self.panes[self.active];
        pane.part();
        if known.is_none() {
            pane.look_from(None);
        }
        let eye = pane.camera.eye();
        pane.camera.stand_at(eye, NEAR * shown.scene.map.size.max_element());
        pane.flying = Some(Flying { speed: SPEED });
        let text = "Flying: W A S D, Q and E down and up, the mouse turns, Shift is faster, the wheel sets the \
                    speed, Esc or a click ends";
        context.outbox.send(Message::Tell(text.to_owned()));
    }

    /// Whether a view has all keys for itself.
    pub fn are_flying(&self) -> bool {
        self.panes.iter().any(|pane| pane.flying.is_some())
    }
}

impl Flying {
    pub fn words(self) -> String {
        format!("flies, {} maps/s ×", crate::gui::numbers::significant(self.speed, 2))
    }
}

impl Pane {
    /// One turn of the window; whether the view flies and takes all input for that.
    pub(super) fn go_flying(&mut self, ui: &Ui, response: &Response, scenery: &Scenery<'_>) -> bool {
        self.hold_pointer(ui);
        let Some(mut flying) = self.flying else { return false };
        response.request_focus();
        let (ended, mouse, wheel) = ui.input(|input| {
            let ended = input.key_pressed(Key::Escape)
                || input.pointer.any_pressed()
                || input.events.contains(&Event::WindowFocused(false));
            let mouse = input.pointer.motion().unwrap_or(input.pointer.delta());
            (ended, mouse, input.smooth_scroll_delta().y)
        });
        if ended {
            self.flying = None;
            self.hold_pointer(ui);
            return true;
        }
        ui.set_cursor_icon(CursorIcon::None);
        self.camera.turn_head(f64::from(mouse.x) * TURN_PER_POINT, -f64::from(mouse.y) * TURN_PER_POINT);
        flying.speed = (flying.speed * libm::exp(f64::from(wheel) / WHEEL)).clamp(SPEEDS.0, SPEEDS.1);
        self.flying = Some(flying);
        self.move_by_keys(ui, flying.speed * scenery.shown.scene.map.size.max_element());
        true
    }

    /// At `speed` m/s, for as long as keys are held.
    fn move_by_keys(&mut self, ui: &Ui, speed: f64) {
        let ([right, up, ahead], way) = ui.input(|input| {
            let along = |plus, minus| {
                f64::from(u8::from(input.key_down(plus))) - f64::from(u8::from(input.key_down(minus)))
            };
            let faster = if input.modifiers.shift { FASTER } else { 1.0 };
            let time = f64::from(input.stable_dt).min(LONGEST);
            let axes = [along(Key::D, Key::A), along(Key::E, Key::Q), along(Key::W, Key::S)];
            (axes, speed * faster * time)
        });
        if [right, up, ahead] != [0.0; 3] {
            self.camera.fly(right * way, up * way, ahead * way);
            ui.ctx().request_repaint();
        }
    }

    /// Keeps the pointer in the window while the view flies, where the system can.
    fn hold_pointer(&mut self, ui: &Ui) {
        let wanted = self.flying.is_some();
        if std::mem::replace(&mut self.holds_pointer, wanted) != wanted {
            let hold = if cfg!(target_os = "macos") { CursorGrab::Locked } else { CursorGrab::Confined };
            let grab = if wanted { hold } else { CursorGrab::None };
            ui.ctx().send_viewport_cmd(ViewportCommand::CursorGrab(grab));
        }
    }
}
