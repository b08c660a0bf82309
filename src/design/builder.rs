//! New bodies and forces of one part: with names, a group and ids of their own.

use compact_str::CompactString;
use glam::DVec3;

use super::plan::{Given, Plan};
use super::turn::facing;
use crate::scene::{Body, Edit, Force, ForceKind, Motion, Names, NodeKey, Roughness, Shape};

pub(super) struct Builder {
    names: Names,
    group: Option<String>,
    next_id: i64,
    next_force: i64,
    /// Coefficient of friction of plates.
    friction: f64,
    edits: Vec<Edit>,
}

/// A plate to add.
pub(super) struct Plate {
    pub middle: DVec3,
    pub normal: DVec3,
    /// Direction of the first side.
    pub across: DVec3,
    /// Half the length of each side, m.
    pub half: [f64; 2],
    pub bounce: f64,
}

/// A ball to add; static if it has no mass.
pub(super) struct Ball {
    pub at: DVec3,
    pub radius: f64,
    pub mass: f64,
    pub velocity: DVec3,
    pub bounce: f64,
}

impl Builder {
    /// For bodies that do not belong together.
    pub fn single(given: &Given<'_>) -> Self {
        let scene = given.scene;
        let after = |ids: Option<i64>| ids.unwrap_or(0).saturating_add(1);
        Self {
            names: Names::new(scene.bodies.iter().filter_map(|body| body.name.as_deref())),
            group: None,
            next_id: after(scene.bodies.iter().map(|body| body.id).max()),
            next_force: after(scene.forces.iter().map(|force| force.id).max()),
            friction: 0.0,
            edits: Vec::new(),
        }
    }

    /// The plates to come rub with this coefficient.
    pub fn rubbing(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// For a part: its bodies are listed in a group of this name, or the next free one.
    pub fn part(given: &Given<'_>, group: &str) -> Self {
        let groups = given.scene.bodies.iter().filter_map(|body| body.group.as_deref());
        let outermost = groups.map(|group| group.split('/').next().unwrap_or(group));
        let group = Names::new(outermost).take(group);
        Self { group: Some(group), ..Self::single(given) }
    }

    pub fn plate(&mut self, name: &str, plate: &Plate) {
        let [half_x, half_y] = plate.half;
        let body = Body {
            bounce: plate.bounce,
            roughness: Roughness { friction: self.friction, ..Roughness::default() },
            rotation: facing(plate.normal, plate.across),
            ..Body::new(0, plate.middle, Motion::Static, Shape::Plane { half_x, half_y })
        };
        self.add(name, body);
    }

    pub fn ball(&mut self, name: &str, ball: &Ball) {
        let &Ball { at, radius, mass, velocity, bounce } = ball;
        let motion = if mass > 0.0 { Motion::Dynamic { mass, velocity } } else { Motion::Static };
        self.add(name, Body { bounce, ..Body::new(0, at, motion, Shape::Sphere { radius }) });
    }

    /// Keeps what was added last out of the views; it takes part all the same.
    pub fn hide_last(&mut self) {
        if let Some(Edit::AddBody(body)) = self.edits.last_mut() {
            body.hidden = true;
        }
    }

    /// As [`Self::ball`], outside of the group.
    pub fn ball_alone(&mut self, name: &str, ball: &Ball) {
        let group = self.group.take();
        self.ball(name, ball);
        self.group = group;
    }

    fn add(&mut self, name: &str, body: Body) {
        let name = Some(self.names.take(name));
        let body = Body {
            key: NodeKey::default(),
            id: self.next_id,
            label: CompactString::default(),
            name,
            group: self.group.clone(),
            ..body
        };
        self.next_id = self.next_id.saturating_add(1);
        self.edits.push(Edit::AddBody(Box::new(body)));
    }

    pub fn force(&mut self, name: &str, kind: ForceKind) {
        let force = Force {
            name: Some(name.to_owned()),
            group: self.group.clone(),
            ..Force::new(self.next_force, kind)
        };
        self.next_force = self.next_force.saturating_add(1);
        self.edits.push(Edit::AddForce(Box::new(force)));
    }

    pub fn finish(self, label: impl Into<String>) -> Plan {
        Plan::new(label, self.edits)
    }
}
