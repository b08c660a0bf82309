//! A view that goes along with a body: beside it, or as seen from its centre.

use glam::DVec3;

use super::pane::Pane;
use super::{AppContext, Message, Scenery, Views};
use crate::record::BodyFrame;
use crate::scene::{Body, Motion, NodeKey, Shape};
use crate::sim::ContactState;
use crate::view::Camera;

/// What an eye in the middle of a body does not see, as a share of the body's size: within a ball there is nothing.
const UNSEEN: f64 = 0.25;

/// As [`UNSEEN`], for a plate, on which things lie.
const UNSEEN_ON_PLATE: f64 = 0.005;

/// A body that a view goes along with.
#[derive(Clone, Copy)]
pub(super) struct Company {
    pub key: NodeKey,
    way: Way,
}

#[derive(Clone, Copy)]
enum Way {
    /// Where the body was in the last picture; `None` before the first.
    Beside {
        last: Option<DVec3>,
    },
    Inside(Inside),
}

/// The eye is the body's centre.
#[derive(Clone, Copy)]
struct Inside {
    /// The camera to go back to.
    before: Camera,
    /// Yaw and pitch of the body's way, the last that it had.
    heading: [f64; 2],
    /// How far the head is turned from that, radians.
    turned: [f64; 2],
    /// Yaw and pitch that the last picture had; what differs is what a person turned since.
    shown: [f64; 2],
}

impl Views {
    /// The active view follows what was selected last, or nothing any more.
    pub(super) fn follow(&mut self, context: &AppContext<'_>) {
        let key = self.body_for_company(context, "follow");
        let pane = &mut self.panes[self.active];
        let before = pane.company;
        pane.part();
        if before.is_none_or(Company::is_inside) {
            pane.company = key.map(|key| Company { key, way: Way::Beside { last: None } });
        }
    }

    /// The active view looks from what was selected last, or again from where it did before.
    pub(super) fn look_from_body(&mut self, context: &AppContext<'_>) {
        let key = self.body_for_company(context, "look from");
        let pane = &mut self.panes[self.active];
        let before = pane.company;
        pane.part();
        if before.is_some_and(Company::is_inside) {
            return;
        }
        let camera = pane.camera;
        let heading = [camera.yaw, camera.pitch];
        let inside = Inside { before: camera, heading, turned: [0.0; 2], shown: heading };
        pane.company = key.map(|key| Company { key, way: Way::Inside(inside) });
    }

    /// The body selected last; without one a person is told, unless this ends what the view does.
    fn body_for_company(&self, context: &AppContext<'_>, what: &str) -> Option<NodeKey> {
        let bodies = |key: &NodeKey| context.shown.is_some_and(|shown| shown.body(*key).is_some());
        let key = context.session.selection().keys().iter().rev().copied().find(bodies);
        if key.is_none() && self.panes[self.active].company.is_none() {
            context.outbox.send(Message::Warn(format!("Select the body to {what} first")));
        }
        key
    }
}

impl Company {
    pub fn is_inside(self) -> bool {
        matches!(self.way, Way::Inside(_))
    }

    /// The body that the eye is in the middle of.
    pub fn inside(self) -> Option<NodeKey> {
        self.is_inside().then_some(self.key)
    }

    pub fn words(self, name: &str) -> String {
        if self.is_inside() { format!("looks from {name} ×") } else { format!("follows {name} ×") }
    }
}

impl Pane {
    /// Goes along with no body any more; from inside one, back to where the view was.
    pub(super) fn part(&mut self) {
        if let Some(Company { way: Way::Inside(inside), .. }) = self.company.take() {
            self.camera = inside.before;
        }
    }

    /// Moves the camera to where the body is now.
    pub(super) fn go_along(&mut self, scenery: &Scenery<'_>) {
        let Some(company) = &mut self.company else { return };
        let now = scenery.frame.bodies.iter().find(|body| body.key == company.key);
        let Some(body) = scenery.shown.body(company.key) else {
            self.part();
            return;
        };
        let place = now.map_or(body.position, |now| now.position);
        match &mut company.way {
            Way::Beside { last } => match last.replace(place) {
                Some(last) => self.camera.target += place - last,
                None => self.camera.target = place,
            },
            Way::Inside(inside) => inside.look(&mut self.camera, place, direction(body, now), unseen(body)),
        }
    }
}

impl Inside {
    fn look(&mut self, camera: &mut Camera, place: DVec3, direction: DVec3, unseen: f64) {
        let seen = [camera.yaw, camera.pitch];
        let own: [f64; 2] = std::array::from_fn(|i| self.turned[i] + (seen[i] - self.shown[i]));
        self.turned = own;
        if let Some(heading) = camera.angles_along(direction) {
            self.heading = heading;
        }
        camera.yaw = self.heading[0] + own[0];
        camera.pitch = self.heading[1] + own[1];
        *camera = camera.usable();
        camera.stand_at(place, unseen);
        self.shown = [camera.yaw, camera.pitch];
    }
}

/// Along which a body goes; none at rest.
fn direction(body: &Body, now: Option<&BodyFrame>) -> DVec3 {
    match now {
        Some(now) if now.contact == ContactState::Rest => DVec3::ZERO,
        Some(now) => now.velocity,
        None => match body.motion {
            Motion::Dynamic { velocity, .. } => velocity,
            Motion::Static => DVec3::ZERO,
        },
    }
}

fn unseen(body: &Body) -> f64 {
    match body.shape {
        Shape::Sphere { radius } => UNSEEN * radius,
        Shape::Plane { half_x, half_y } => UNSEEN_ON_PLATE * half_x.min(half_y),
        Shape::Unbuilt { .. } => UNSEEN,
    }
}
