//! The views: one, two or four cameras on the same scene, each with its own overlays.

mod canvas;
mod company;
mod corner;
mod drafts;
mod flying;
mod gestures;
mod gizmo;
mod linking;
mod manipulate;
mod pane;
mod rubber;
mod turns;

use std::sync::Arc;

use egui::{Rect, Ui};
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::context::{AppContext, Message, Shown};
use crate::design::Eye;
use crate::editor::ViewCommand;
use crate::record::{EventRow, Frame, PathSpan};
use crate::scene::{Motion, NodeKey};
use crate::view::{
    self, Bounds, Camera, OVERLAYS, OverlaySet, Pivot, Projection, Tool, VIEWS, ViewInput, Viewport,
    scene_bounds,
};

pub use canvas::Canvas;
use gestures::Gestures;
use pane::Pane;
use turns::Turns;

/// How many views are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Layout {
    One,
    Two,
    #[default]
    Four,
}

/// What outlives a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct Remembered {
    layout: Layout,
    snapping: bool,
    linked: bool,
    through: bool,
    /// Ids of the overlays shown, view by view.
    overlays: Vec<Vec<String>>,
}

impl Default for Remembered {
    fn default() -> Self {
        Self {
            layout: Layout::default(),
            snapping: false,
            linked: false,
            through: true,
            overlays: Vec::new(),
        }
    }
}

/// All views and what they share.
pub struct Views {
    panes: [Pane; 4],
    layout: Layout,
    active: usize,
    /// What the layout was before one view was maximised.
    before_maximized: Layout,
    pub snapping: bool,
    /// Whether the views along axes are moved and magnified together.
    pub linked: bool,
    /// Whether rectangles and outlines select also what lies behind other bodies.
    through: bool,
    pub tool: Tool,
    pivot: Pivot,
    /// Whether handles lie along the axes of the body, not of the world.
    pub local_axes: bool,
    pub canvas: Canvas,
    start: StartFrame,
    turns: Turns,
}

/// Ways of the bodies that are shown, s: what a person can follow.
pub const PATHS: PathSpan = PathSpan { past: 1.0, future: 1.0 };

/// The frame to draw while the simulation stands at its start: a body that is being dragged is where the
/// document has it, before the simulation knows.
#[derive(Default)]
struct StartFrame {
    of: Option<(u64, u64)>,
    frame: Option<Arc<Frame>>,
}

/// What the views share in one turn of the window.
struct Scenery<'a> {
    context: &'a AppContext<'a>,
    shown: &'a Shown,
    frame: Arc<Frame>,
    highlighted: Option<Arc<EventRow>>,
    canvas: &'a Canvas,
    snapping: bool,
    through: bool,
    tool: Tool,
    pivot: Pivot,
    local_axes: bool,
}

impl Scenery<'_> {
    fn input<'b>(&'b self, pane: &Pane, rect: Rect, pixels_per_point: f32) -> ViewInput<'b> {
        let size = rect.size();
        let viewport = Viewport::new(f64::from(size.x), f64::from(size.y), f64::from(pixels_per_point));
        ViewInput {
            scene: &self.shown.scene,
            frame: Some(&self.frame),
            camera: pane.camera,
            viewport,
            overlays: pane.overlays,
            theme: self.context.theme,
            selection: self.context.session.selection().keys(),
            hovered: None,
            inside: pane.company.and_then(company::Company::inside),
            highlighted: self.highlighted.as_deref(),
        }
    }
}

impl Views {
    pub fn new(canvas: Canvas, remembered: &Remembered) -> Self {
        let mut panes: [Pane; 4] = std::array::from_fn(|i| Pane::new(i, &VIEWS[i]));
        for (pane, ids) in panes.iter_mut().zip(&remembered.overlays) {
            pane.overlays = OverlaySet::from_ids(ids.iter().map(String::as_str));
        }
        Self {
            panes,
            layout: remembered.layout,
            active: 0,
            before_maximized: Layout::Four,
            snapping: remembered.snapping,
            linked: remembered.linked,
            through: remembered.through,
            tool: Tool::default(),
            pivot: Pivot::default(),
            local_axes: false,
            canvas,
            start: StartFrame::default(),
            turns: Turns::default(),
        }
    }

    /// Whether a view waits for its turn to show what is now, or to be drawn in full.
    pub fn are_behind(&self) -> bool {
        self.turns.are_behind() || self.canvas.has_drafts(|view| self.is_shown(view))
    }

    pub fn remembered(&self) -> Remembered {
        let ids = |pane: &Pane| pane.overlays.ids().map(str::to_owned).collect();
        Remembered {
            layout: self.layout,
            snapping: self.snapping,
            linked: self.linked,
            through: self.through,
            overlays: self.panes.iter().map(ids).collect(),
        }
    }

    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// How the active view looks at the scene.
    pub fn eye(&self) -> Eye {
        let camera = &self.panes[self.active].camera;
        Eye { focus: camera.target, right: camera.right(), towards: camera.backward() }
    }

    pub fn active_overlays(&self) -> OverlaySet {
        self.panes[self.active].overlays
    }

    /// The switches that are on, for marks in menus.
    pub fn switched_on(&self) -> Vec<ViewCommand> {
        let switches = [
            (self.snapping, ViewCommand::ToggleSnapping),
            (self.linked, ViewCommand::ToggleLinked),
            (self.through, ViewCommand::ToggleThrough),
            (true, ViewCommand::Pivot(self.pivot)),
        ];
        switches.into_iter().filter_map(|(on, command)| on.then_some(command)).collect()
    }

    /// How often a view was drawn anew since the start.
    pub fn redraws(&self) -> u64 {
        self.canvas.redraws()
    }

    /// Another document: look at the whole of it.
    pub fn opened(&mut self) {
        for pane in &mut self.panes {
            pane.wants_framing = true;
            pane.company = None;
            pane.flying = None;
            pane.forget_picture();
            // what was being dragged belongs to the scene before
            pane.gestures = Gestures::default();
        }
    }

    /// Whether any view shows an overlay.
    pub fn show_overlay(&self, id: &str) -> bool {
        let mut shown = self.panes.iter().enumerate().filter(|(index, _)| self.is_shown(*index));
        shown.any(|(_, pane)| pane.overlays.contains(id))
    }

    /// Whether the layout shows a view.
    pub fn is_shown(&self, index: usize) -> bool {
        match self.layout {
            Layout::One => index == self.active,
            Layout::Two if self.active == 0 => index < 2,
            Layout::Two => index == 0 || index == self.active,
            Layout::Four => true,
        }
    }

    pub fn title(&self, index: usize) -> &'static str {
        self.panes.get(index).map_or("View", |pane| look_name(&pane.camera))
    }

    /// Shows one view in all the room there is; whether its grip is dragged, to put it elsewhere.
    pub fn show(&mut self, ui: &mut Ui, index: usize, context: &AppContext<'_>) -> bool {
        let area = ui.available_rect_before_wrap();
        ui.advance_cursor_after_rect(area);
        let Some(shown) = context.shown else {
            pane::nothing_to_show(ui, area, context, index == self.active);
            return false;
        };
        let frame = self.start.frame(context, shown);
        let scenery = Scenery {
            context,
            shown,
            frame,
            highlighted: context.session.shown_event().cloned(),
            canvas: &self.canvas,
            snapping: self.snapping,
            through: self.through,
            tool: self.tool,
            pivot: self.pivot,
            local_axes: self.local_axes,
        };
        let rect = snapped(area, ui.pixels_per_point());
        let marked = index == self.active && self.layout != Layout::One;
        let shown: [bool; VIEWS.len()] = std::array::from_fn(|view| self.is_shown(view));
        self.turns.begin(ui.ctx().cumulative_frame_nr(), |view| view != self.active && shown[view]);
        let is_next = index == self.active || self.turns.has(index);
        let Some(pane) = self.panes.get_mut(index) else { return false };
        let (framed, before) = (pane.wants_framing, pane.middle());
        let outcome = pane.show(ui, rect, &scenery, (marked, index == self.active), is_next);
        if outcome.behind {
            self.turns.wait();
            ui.ctx().request_repaint();
        }
        if framed {
            self.share_widest();
        } else {
            self.share_if_moved(index, before);
        }
        if outcome.activated || outcome.maximize {
            self.active = index;
        }
        if outcome.maximize {
            context.outbox.command(ViewCommand::Maximize);
        }
        outcome.moved
    }

    /// Carries out a command about views.
    pub fn execute(&mut self, command: ViewCommand, context: &AppContext<'_>) {
        let before = self.panes[self.active].middle();
        if command.is_a_look() && self.panes[self.active].company.is_some_and(company::Company::is_inside) {
            self.panes[self.active].part();
        }
        self.carry_out(command, context);
        self.share_if_moved(self.active, before);
    }

    fn carry_out(&mut self, command: ViewCommand, context: &AppContext<'_>) {
        match command {
            ViewCommand::FrameAll => self.frame(context, None, Some(self.active)),
            ViewCommand::FrameSelection => {
                let keys = context.session.selection().keys();
                self.frame(context, Some(keys), Some(self.active));
            }
            ViewCommand::FrameMap => {
                if let Some(shown) = context.shown {
                    let pane = &mut self.panes[self.active];
                    let map = Bounds { min: DVec3::ZERO, max: shown.scene.map.size };
                    pane.camera.frame(map, pane.aspect());
                }
            }
            ViewCommand::Follow => self.follow(context),
            ViewCommand::LookFromBody => self.look_from_body(context),
            ViewCommand::Fly => self.fly(context),
            ViewCommand::ToggleLinked => {
                self.linked = !self.linked;
                self.share_widest();
            }
            ViewCommand::Perspective => self.panes[self.active].look_from(None),
            ViewCommand::Along(axis) => self.panes[self.active].look_from(Some(axis)),
            ViewCommand::ToggleProjection => {
                let camera = &mut self.panes[self.active].camera;
                camera.projection = match camera.projection {
                    Projection::Perspective => Projection::Orthographic,
                    Projection::Orthographic => Projection::Perspective,
                };
            }
            ViewCommand::Maximize => {
                let one = self.layout == Layout::One;
                let next = if one { self.before_maximized } else { Layout::One };
                self.set_layout(next);
            }
            ViewCommand::OneView => self.set_layout(Layout::One),
            ViewCommand::TwoViews => self.set_layout(Layout::Two),
            ViewCommand::FourViews => self.set_layout(Layout::Four),
            ViewCommand::ToggleSnapping => {
                self.snapping = !self.snapping;
                let text = if self.snapping {
                    "Snapping is on: dragged bodies stop at round steps (G)"
                } else {
                    "Snapping is off: bodies are dragged freely (G)"
                };
                context.outbox.send(Message::Tell(text.to_owned()));
            }
            ViewCommand::Tool(tool) => self.tool = tool,
            ViewCommand::Pivot(pivot) => self.pivot = pivot,
            ViewCommand::ToggleThrough => self.through = !self.through,
            ViewCommand::ToggleLocalAxes => self.local_axes = !self.local_axes,
            ViewCommand::ToggleOverlay(index) => {
                if let Some(overlay) = OVERLAYS.get(index) {
                    self.panes[self.active].overlays.toggle(overlay.id);
                }
            }
        }
    }

    fn set_layout(&mut self, layout: Layout) {
        if self.layout != Layout::One {
            self.before_maximized = self.layout;
        }
        self.layout = layout;
    }

    /// Brings bodies, or all there is, into one view or all of them.
    pub fn frame(&mut self, context: &AppContext<'_>, keys: Option<&[NodeKey]>, only: Option<usize>) {
        let Some(shown) = context.shown else { return };
        let frame = self.start.frame(context, shown);
        let Some(bounds) = bounds(&shown.scene, &frame, keys) else { return };
        for (index, pane) in self.panes.iter_mut().enumerate() {
            let stays = only.is_none() && pane.company.is_some_and(company::Company::is_inside);
            if only.is_none_or(|only| only == index) && !stays {
                pane.camera.frame(padded(bounds, keys.is_some()), pane.aspect());
            }
        }
        if only.is_none() {
            self.share_widest();
        }
    }

    /// Whether one of the views has the keyboard.
    pub fn have_focus(&self, ctx: &egui::Context) -> bool {
        let focused = ctx.memory(egui::Memory::focused);
        focused.is_some() && self.panes.iter().any(|pane| pane.id == focused)
    }

    /// Turns the first view, for measuring.
    pub fn turn_first(&mut self, angle: f64) {
        let [first, ..] = &mut self.panes;
        first.camera.orbit(angle, 0.0);
    }

    /// Turns all views.
    pub fn turn_all(&mut self, angle: f64) {
        self.panes.iter_mut().for_each(|pane| pane.camera.orbit(angle, 0.0));
    }

    pub fn set_overlays(&mut self, overlays: OverlaySet) {
        self.panes.iter_mut().for_each(|pane| pane.overlays = overlays);
    }

    /// Whether a drag in a view goes on, which Escape gives up.
    pub fn is_dragging(&self) -> bool {
        self.panes.iter().any(|pane| pane.gestures.is_dragging())
    }

    /// Brings a place into all views, keeping their magnification unless it is far too small.
    pub fn frame_place(&mut self, context: &AppContext<'_>, place: DVec3) {
        let Some(shown) = context.shown else { return };
        let reach = 0.25 * shown.scene.map.size.max_element();
        for pane in &mut self.panes {
            pane.camera.target = place;
            pane.camera.height = pane.camera.height.min(reach);
        }
        self.share_widest();
    }
}

impl StartFrame {
    fn frame(&mut self, context: &AppContext<'_>, shown: &Shown) -> Arc<Frame> {
        let frame = context.session.frame();
        if !context.session.shows_start() {
            return frame.clone();
        }
        let of = (shown.revision, frame.revision);
        match &self.frame {
            Some(known) if self.of == Some(of) => known.clone(),
            _ => {
                let made = at_start(frame, shown);
                (self.of, self.frame) = (Some(of), Some(made.clone()));
                made
            }
        }
    }
}

/// The frame with every body where the document has it.
fn at_start(frame: &Arc<Frame>, shown: &Shown) -> Arc<Frame> {
    let differs = |body: &&crate::record::BodyFrame| {
        shown.body(body.key).is_none_or(|wanted| {
            let velocity = match wanted.motion {
                Motion::Dynamic { velocity, .. } => velocity,
                Motion::Static => DVec3::ZERO,
            };
            wanted.position != body.position || velocity != body.velocity
        })
    };
    if !frame.bodies.iter().any(|body| differs(&body)) {
        return frame.clone();
    }
    let bodies = frame.bodies.iter().filter(|body| !differs(body)).cloned().collect();
    Arc::new(Frame { bodies, ..(**frame).clone() })
}

fn bounds(scene: &crate::scene::Scene, frame: &Frame, keys: Option<&[NodeKey]>) -> Option<Bounds> {
    let input = ViewInput {
        frame: Some(frame),
        ..ViewInput::new(scene, Camera::default(), Viewport::new(100.0, 100.0, 1.0))
    };
    let bounds = scene_bounds(&input, keys);
    bounds.size().is_finite().then_some(bounds)
}

/// A selected body with some of its surroundings.
fn padded(bounds: Bounds, selection: bool) -> Bounds {
    let factor = if selection { 1.6 } else { 1.0 };
    Bounds::around(bounds.center(), bounds.size() * 0.5 * factor)
}

/// On whole pixels, so that pictures are not resampled.
fn snapped(rect: Rect, pixels_per_point: f32) -> Rect {
    use egui::emath::GuiRounding as _;
    rect.round_to_pixels(pixels_per_point)
}

/// What to call what a camera shows.
fn look_name(camera: &Camera) -> &'static str {
    match (camera.projection, camera.axis_view()) {
        (Projection::Perspective, _) => "Perspective",
        (Projection::Orthographic, Some(axis)) => axis.label(),
        (Projection::Orthographic, None) => "Parallel",
    }
}

/// View coordinates of a place on the screen.
fn ndc(viewport: &Viewport, rect: Rect, at: egui::Pos2) -> glam::DVec2 {
    let from_corner = at - rect.min;
    viewport.ndc(glam::DVec2::new(f64::from(from_corner.x), f64::from(from_corner.y)))
}

fn egui_theme(theme: egui::Theme) -> view::Theme {
    match theme {
        egui::Theme::Dark => view::Theme::Dark,
        egui::Theme::Light => view::Theme::Light,
    }
}

/// The theme that views are drawn in.
pub fn theme_of(ctx: &egui::Context) -> view::Theme {
    egui_theme(ctx.theme())
}
