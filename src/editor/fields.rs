//! The numbers that the inspector shows and edits, one row of a table each, for one object or several.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Typed;
use crate::design::Instance;
use crate::record::BodyFrame;
use crate::scene::{Body, BodyChange, Edit, Force, ForceChange, ForceKind, Motion, NodeKey, Scene, Shape};

/// A number or vector of a `T`. A number is the x of its vector.
pub struct Field<T: 'static, C: 'static> {
    pub label: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    /// What each component is called; one empty name for a number.
    pub axes: &'static [&'static str],
    /// What a drag stays within; the document has the last word.
    pub range: (f64, f64),
    /// `None` where the object has no such number.
    pub get: fn(&T) -> Option<DVec3>,
    /// The change that sets it; `None` where the object has no such number.
    pub set: fn(&T, DVec3) -> Option<C>,
    /// What it is at the frame's time, where the simulation changes it.
    pub now: Option<fn(&BodyFrame) -> Option<DVec3>>,
}

/// What a range allows, in words; `None` where it allows everything.
pub fn limits(range: (f64, f64)) -> Option<String> {
    match range {
        (low, high) if low.is_finite() && high.is_finite() => {
            Some(format!("must lie between {low} and {high}"))
        }
        POSITIVE => Some("must be above 0".to_owned()),
        NOT_NEGATIVE => Some("must not be negative".to_owned()),
        (low, _) if low.is_finite() => Some(format!("must be at least {low}")),
        (_, high) if high.is_finite() => Some(format!("must be at most {high}")),
        _ => None,
    }
}

/// Whether a range allows a typed value; drags of what must be above 0 stop a little earlier.
pub fn allows(range: (f64, f64), value: f64) -> bool {
    if range == POSITIVE { value > 0.0 } else { (range.0..=range.1).contains(&value) }
}

/// What several objects have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shared {
    /// No object has it.
    None,
    Same(f64),
    Mixed {
        smallest: f64,
        largest: f64,
    },
}

/// Puts the values of several objects together; objects without the number do not count.
pub fn shared(values: impl IntoIterator<Item = Option<f64>>) -> Shared {
    values.into_iter().flatten().fold(Shared::None, |so_far, value| match so_far {
        Shared::None => Shared::Same(value),
        Shared::Same(same) if same == value => so_far,
        Shared::Same(same) => Shared::Mixed { smallest: same.min(value), largest: same.max(value) },
        Shared::Mixed { smallest, largest } => {
            Shared::Mixed { smallest: smallest.min(value), largest: largest.max(value) }
        }
    })
}

impl<T, C> Field<T, C> {
    /// One component; `None` where the object has no such number.
    pub fn value(&self, of: &T, axis: usize) -> Option<f64> {
        (self.get)(of).and_then(|vector| vector.to_array().get(axis).copied())
    }

    /// The change that sets one component and leaves the others.
    pub fn change(&self, of: &T, axis: usize, value: f64) -> Option<C> {
        let mut components = (self.get)(of)?.to_array();
        *components.get_mut(axis)? = value;
        (self.set)(of, DVec3::from_array(components))
    }

    /// Such as `Position y`.
    pub fn accessible_name(&self, axis: usize) -> String {
        match self.axes.get(axis) {
            Some(name) if !name.is_empty() => format!("{} {name}", self.label),
            _ => self.label.to_owned(),
        }
    }
}

impl<T, C> Field<T, C> {
    /// The changes that set one component of all of these that have it, in the order given. The error names the first
    /// whose value is refused.
    fn changes<'a>(
        &self,
        of: impl Iterator<Item = &'a T>,
        axis: usize,
        typed: &Typed,
        name: impl Fn(&T) -> String,
    ) -> Result<Vec<(&'a T, C)>, String> {
        let having: Vec<(&T, f64)> = of.filter_map(|one| Some((one, self.value(one, axis)?))).collect();
        let count = having.len();
        let changes = having.into_iter().enumerate().map(|(index, (one, old))| {
            let value = typed.value(Instance { old, index, count });
            let value = value.ok_or_else(|| format!("For {} that is no number", name(one)))?;
            if !allows(self.range, value) {
                let (what, must) = (self.label.to_lowercase(), limits(self.range).unwrap_or_default());
                return Err(format!("For {} that gives {value}: the {what} {must}", name(one)));
            }
            Ok(self.change(one, axis, value).map(|change| (one, change)))
        });
        Ok(changes.collect::<Result<Vec<_>, String>>()?.into_iter().flatten().collect())
    }
}

impl Field<Body, BodyChange> {
    /// Sets one component of all these bodies that have it, in this order.
    pub fn edit(&self, scene: &Scene, keys: &[NodeKey], axis: usize, typed: &Typed) -> Result<Edit, String> {
        let all: BTreeMap<NodeKey, &Body> = scene.bodies.iter().map(|body| (body.key, body)).collect();
        let chosen = keys.iter().filter_map(|key| all.get(key).copied());
        let changes = self.changes(chosen, axis, typed, |body| body.display_name().to_owned())?;
        Ok(Edit::All(
            changes.into_iter().map(|(body, change)| Edit::Body { key: body.key, change }).collect(),
        ))
    }
}

impl Field<Force, ForceChange> {
    /// Sets one component of all these forces that have it, in this order.
    pub fn edit(&self, scene: &Scene, keys: &[NodeKey], axis: usize, typed: &Typed) -> Result<Edit, String> {
        let all: BTreeMap<NodeKey, &Force> = scene.forces.iter().map(|force| (force.key, force)).collect();
        let chosen = keys.iter().filter_map(|key| all.get(key).copied());
        let changes = self.changes(chosen, axis, typed, |force| force.label.to_string())?;
        Ok(Edit::All(
            changes.into_iter().map(|(force, change)| Edit::Force { key: force.key, change }).collect(),
        ))
    }
}

const XYZ: &[&str] = &["x", "y", "z"];
const NUMBER: &[&str] = &[""];
const ANY: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const POSITIVE: (f64, f64) = (1e-9, f64::INFINITY);
const NOT_NEGATIVE: (f64, f64) = (0.0, f64::INFINITY);

/// What bodies have, in the order of the inspector.
pub const BODY_FIELDS: &[Field<Body, BodyChange>] = &[
    Field {
        label: "Position",
        unit: "m",
        axes: XYZ,
        range: ANY,
        get: |body| Some(body.position),
        set: |_, position| Some(BodyChange::Position(position)),
        now: Some(|frame| Some(frame.position)),
    },
    Field {
        label: "Rotation",
        unit: "rad",
        axes: &["α", "β", "γ"],
        range: ANY,
        get: |body| Some(body.rotation),
        set: |_, rotation| Some(BodyChange::Rotation(rotation)),
        now: None,
    },
    Field {
        label: "Velocity",
        unit: "m/s",
        axes: XYZ,
        range: ANY,
        get: |body| match body.motion {
            Motion::Dynamic { velocity, .. } => Some(velocity),
            Motion::Static => None,
        },
        set: |body, velocity| body.is_dynamic().then_some(BodyChange::Velocity(velocity)),
        now: Some(|frame| Some(frame.velocity)),
    },
    Field {
        label: "Angular velocity",
        unit: "rad/s",
        axes: XYZ,
        range: ANY,
        get: |body| body.is_dynamic().then_some(body.spin),
        set: |body, spin| body.is_dynamic().then_some(BodyChange::Spin(spin)),
        now: Some(|frame| Some(frame.turn?.spin)),
    },
    Field {
        label: "Mass",
        unit: "kg",
        axes: NUMBER,
        range: POSITIVE,
        get: |body| match body.motion {
            Motion::Dynamic { mass, .. } => Some(number(mass)),
            Motion::Static => None,
        },
        set: |body, mass| body.is_dynamic().then_some(BodyChange::Mass(mass.x)),
        now: None,
    },
    Field {
        label: "Bounce",
        unit: "",
        axes: NUMBER,
        range: (0.0, 1.0),
        get: |body| Some(number(body.bounce)),
        set: |_, bounce| Some(BodyChange::Bounce(bounce.x)),
        now: None,
    },
    Field {
        label: "Friction",
        unit: "",
        axes: NUMBER,
        range: NOT_NEGATIVE,
        get: |body| Some(number(body.roughness.friction)),
        set: |_, friction| Some(BodyChange::Friction(friction.x)),
        now: None,
    },
    Field {
        label: "Rolling friction",
        unit: "",
        axes: NUMBER,
        range: NOT_NEGATIVE,
        get: |body| Some(number(body.roughness.rolling)),
        set: |_, rolling| Some(BodyChange::RollingFriction(rolling.x)),
        now: None,
    },
    Field {
        label: "Tangential",
        unit: "",
        axes: NUMBER,
        range: (0.0, 1.0),
        get: |body| Some(number(body.roughness.tangential)),
        set: |_, tangential| Some(BodyChange::Tangential(tangential.x)),
        now: None,
    },
    Field {
        label: "Radius",
        unit: "m",
        axes: NUMBER,
        range: POSITIVE,
        get: |body| match body.shape {
            Shape::Sphere { radius } => Some(number(radius)),
            Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
        },
        set: |body, radius| match body.shape {
            Shape::Sphere { .. } => Some(BodyChange::Shape(Shape::Sphere { radius: radius.x })),
            Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
        },
        now: None,
    },
    Field {
        label: "Half side",
        unit: "m",
        axes: &["x", "y"],
        range: POSITIVE,
        get: |body| match body.shape {
            Shape::Plane { half_x, half_y } => Some(DVec3::new(half_x, half_y, 0.0)),
            Shape::Sphere { .. } | Shape::Unbuilt { .. } => None,
        },
        set: |body, half| match body.shape {
            Shape::Plane { .. } => Some(BodyChange::Shape(Shape::Plane { half_x: half.x, half_y: half.y })),
            Shape::Sphere { .. } | Shape::Unbuilt { .. } => None,
        },
        now: None,
    },
];

/// What forces have.
pub const FORCE_FIELDS: &[Field<Force, ForceChange>] = &[
    Field {
        label: "Position",
        unit: "m",
        axes: XYZ,
        range: ANY,
        get: |force| force.kind.position(),
        set: |force, position| force.kind.at(position).and_then(kind),
        now: None,
    },
    Field {
        label: "Acceleration",
        unit: "m/s²",
        axes: XYZ,
        range: ANY,
        get: |force| match force.kind {
            ForceKind::GravityPlane { acceleration, .. } => Some(acceleration),
            _ => None,
        },
        set: |force, acceleration| match force.kind {
            ForceKind::GravityPlane { position, .. } => {
                kind(ForceKind::GravityPlane { position, acceleration })
            }
            _ => None,
        },
        now: None,
    },
    Field {
        label: "Intensity",
        unit: "m³/s²",
        axes: NUMBER,
        range: ANY,
        get: |force| match force.kind {
            ForceKind::GravityPoint { intensity, .. } => Some(number(intensity)),
            _ => None,
        },
        set: |force, value| match force.kind {
            ForceKind::GravityPoint { position, .. } => {
                kind(ForceKind::GravityPoint { position, intensity: value.x })
            }
            _ => None,
        },
        now: None,
    },
    Field {
        label: "Density",
        unit: "kg/m³",
        axes: NUMBER,
        range: NOT_NEGATIVE,
        get: |force| match force.kind {
            ForceKind::Drag { density } => Some(number(density)),
            _ => None,
        },
        set: |force, density| match force.kind {
            ForceKind::Drag { .. } => kind(ForceKind::Drag { density: density.x }),
            _ => None,
        },
        now: None,
    },
];

/// What the map and the simulation have; the solver's numbers are in [`crate::scene::PARAMS`].
pub const SCENE_FIELDS: &[Field<Scene, Edit>] = &[
    Field {
        label: "Size",
        unit: "m",
        axes: XYZ,
        range: POSITIVE,
        get: |scene| Some(scene.map.size),
        set: |_, size| Some(Edit::MapSize(size)),
        now: None,
    },
    Field {
        label: "Tiles",
        unit: "",
        axes: XYZ,
        range: (1.0, 65_536.0),
        get: |scene| Some(DVec3::from_array(scene.map.tiles.map(f64::from))),
        // the cast saturates, and the document refuses what is out of range
        set: |_, tiles| Some(Edit::MapTiles(tiles.to_array().map(|count| count.round() as u32))),
        now: None,
    },
    Field {
        label: "Time speed",
        unit: "×",
        axes: NUMBER,
        range: POSITIVE,
        get: |scene| Some(number(scene.time_speed)),
        set: |_, speed| Some(Edit::TimeSpeed(speed.x)),
        now: None,
    },
];

fn number(value: f64) -> DVec3 {
    DVec3::new(value, 0.0, 0.0)
}

fn kind(kind: ForceKind) -> Option<ForceChange> {
    Some(ForceChange::Kind(kind))
}
