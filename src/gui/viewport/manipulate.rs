//! A drag of a handle or a body that goes on: from the pointer, the keys and what is near to an edit.

use egui::{Event, Key, Ui};
use glam::{DVec2, DVec3};

use super::Scenery;
use crate::editor::{Action, Drag, parse_angle, parse_number};
use crate::scene::{Body, NodeKey, Shape};
use crate::view::{
    Axis, Camera, Grip, Guide, Handle, Neighbour, Pull, Viewport, aligned, features, fine_step, pull,
    snap_step, touching,
};

/// How much of the pointer's way counts while Shift is held.
const PRECISION: f64 = 0.1;

/// Ways of snapping to a neighbour, points: to its surface, and to the level of its centre.
const CONTACT_REACH: f64 = 12.0;
const LEVEL_REACH: f64 = 7.0;

/// Letters of a number that is typed while dragging.
const NUMBER: &str = "0123456789.,+-*/()e°";

pub(super) struct Manipulation {
    drag: Drag,
    pub grip: Grip,
    /// The body that the pointer holds, among those that are dragged.
    lead: Option<NodeKey>,
    /// Where the pointer is, points from the view's top left corner, and where it would be if Shift did not
    /// slow it.
    seen: DVec2,
    at: DVec2,
    pub pull: Option<Pull>,
    pub typed: String,
    pub guides: Vec<Guide>,
    pub snaps: bool,
    /// Sides of the tiles, m, where they are shown.
    pub tiles: Option<DVec3>,
}

/// What the keys did.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    Nothing,
    Confirm,
    GiveUp,
}

impl Manipulation {
    pub fn new(drag: Drag, grip: Grip, lead: Option<NodeKey>, at: DVec2) -> Self {
        Self {
            drag,
            grip,
            lead,
            seen: at,
            at,
            pull: None,
            typed: String::new(),
            guides: Vec::new(),
            snaps: false,
            tiles: None,
        }
    }

    /// Takes in what is typed: a letter chooses an axis, digits are a number, Enter takes it.
    pub fn keys(&mut self, ui: &Ui) -> Asked {
        let (text, back, enter, escape) = ui.input(|input| {
            let text: String = input.events.iter().filter_map(typed_text).collect();
            let pressed = |key| input.key_pressed(key);
            (text, pressed(Key::Backspace), pressed(Key::Enter), pressed(Key::Escape))
        });
        for letter in text.chars() {
            match Axis::of_letter(letter) {
                Some(axis) if self.takes_axis() => {
                    self.grip.only = if self.grip.only == Some(axis) { None } else { Some(axis) };
                }
                _ if NUMBER.contains(letter) => self.typed.push(letter),
                _ => {}
            }
        }
        if back {
            self.typed.pop();
        }
        match (escape, enter) {
            (true, _) => Asked::GiveUp,
            (_, true) => Asked::Confirm,
            _ => Asked::Nothing,
        }
    }

    fn takes_axis(&self) -> bool {
        !matches!(self.grip.handle, Handle::Radius | Handle::Scale | Handle::Side { .. } | Handle::MapSide(_))
    }

    /// Follows the pointer to where it is now, points from the view's top left corner.
    pub fn follow(&mut self, ui: &Ui, to: DVec2, camera: &Camera, viewport: Viewport, scenery: &Scenery<'_>) {
        let (shift, flip) = ui.input(|input| (input.modifiers.shift, input.modifiers.command));
        let delta = to - std::mem::replace(&mut self.seen, to);
        self.at += if shift { delta * PRECISION } else { delta };
        self.snaps = scenery.snapping != flip;
        self.guides.clear();
        let now = self.typed_pull(camera).or_else(|| self.free_pull(camera, viewport, shift, scenery));
        if let Some(now) = now
            && self.pull != Some(now)
        {
            self.pull = Some(now);
            scenery.context.outbox.act(self.drag.pull(&now, self.grip.subject.pivot));
        }
    }

    /// What the typed number means; `None` while none is.
    fn typed_pull(&self, camera: &Camera) -> Option<Pull> {
        let number = parse_number(&self.typed)?;
        let degrees = format!("{}°", self.typed.trim_end_matches('°'));
        self.grip.typed(camera, number, parse_angle(&degrees).unwrap_or(number.to_radians()))
    }

    fn free_pull(
        &mut self,
        camera: &Camera,
        viewport: Viewport,
        shift: bool,
        scenery: &Scenery<'_>,
    ) -> Option<Pull> {
        let free = pull(&self.grip, camera, viewport, viewport.ndc(self.at), self.pull.as_ref())?;
        let origin = self.origin();
        if !self.snaps {
            let step = fine_step(camera, viewport, origin) * if shift { PRECISION } else { 1.0 };
            return Some(self.grip.rounded(free, camera, origin, step));
        }
        let step = snap_step(camera, viewport);
        match free {
            Pull::Move(offset) => Some(Pull::Move(self.snapped_move(offset, camera, viewport, scenery))),
            other => Some(self.grip.snapped(other, camera, origin, step)),
        }
    }

    /// To the surface of a neighbour, else level with one, else to the grid, or to faces and middles of tiles where those
    /// are shown.
    fn snapped_move(
        &mut self,
        offset: DVec3,
        camera: &Camera,
        viewport: Viewport,
        scenery: &Scenery<'_>,
    ) -> DVec3 {
        let freedom = self.grip.freedom(camera);
        let origin = self.origin();
        let place = origin + offset;
        let point = camera.world_per_pixel_at(place, viewport.height);
        let neighbours = neighbours(scenery, &self.drag);
        if let Some(&Body { shape: Shape::Sphere { radius }, .. }) = self.lead() {
            let near = neighbours.iter().copied();
            if let Some((at, guide)) = touching(radius, place, freedom, near, CONTACT_REACH * point) {
                self.guides.push(guide);
                return at - origin;
            }
        }
        let own = self.lead().map_or(vec![DVec3::ZERO], features);
        let (level, guides) = aligned(place, &own, freedom, neighbours.iter().copied(), LEVEL_REACH * point);
        let steps = self.tiles.map_or(DVec3::splat(snap_step(camera, viewport)), |tile| 0.5 * tile);
        let on_grid = freedom.snapped_to_tiles(origin, offset, steps);
        let at = DVec3::select(level.cmpne(place), level, origin + on_grid);
        // What else snapped, snapped along other axes.
        let to = |guide: Guide| guide.to + (at - level);
        self.guides = guides.into_iter().map(|guide| Guide { to: to(guide), ..guide }).collect();
        at - origin
    }

    fn lead(&self) -> Option<&Body> {
        let bodies = self.drag.bodies();
        match self.lead {
            Some(key) => bodies.iter().find(|body| body.key == key),
            None if bodies.len() == 1 => bodies.first(),
            None => None,
        }
    }

    /// Where what moves began.
    pub fn origin(&self) -> DVec3 {
        self.lead().map_or(self.drag.origin(), |body| body.position)
    }

    /// The drag is over and stays.
    pub fn confirm(&self, scenery: &Scenery<'_>) {
        scenery.context.outbox.act(Action::EndGesture);
    }
}

/// Other bodies that are seen, where they are seen.
fn neighbours<'s>(scenery: &'s Scenery<'_>, drag: &Drag) -> Vec<Neighbour<'s>> {
    let dragged: std::collections::BTreeSet<NodeKey> = drag.bodies().iter().map(|body| body.key).collect();
    let others =
        scenery.shown.scene.bodies.iter().filter(|body| !body.hidden && !dragged.contains(&body.key));
    let moved = !scenery.context.session.shows_start();
    let now: rustc_hash::FxHashMap<NodeKey, DVec3> = if moved {
        scenery.frame.bodies.iter().map(|body| (body.key, body.position)).collect()
    } else {
        rustc_hash::FxHashMap::default()
    };
    let placed =
        |body: &'s Body| Neighbour { body, position: now.get(&body.key).copied().unwrap_or(body.position) };
    others.map(placed).collect()
}

fn typed_text(event: &Event) -> Option<&str> {
    match event {
        Event::Text(text) => Some(text),
        _ => None,
    }
}
