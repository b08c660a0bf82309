//! The words of the format: every element with its attributes, defaults and the version that brought it. One table, from
//! which the XML schemas are written and which the tests compare with the reader and with docs/format.md.

use super::params::PARAMS;

/// Which version of the format knows something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Since {
    V1_0,
    V1_1,
}

/// What an attribute may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueKind {
    Number,
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NotNegative,
    /// A number between two limits, these included.
    Between(f64, f64),
    /// A whole number from 1 to 65 536.
    Tiles,
    /// A whole number of 64 bits.
    Id,
    Version,
    Text,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttributeInfo {
    pub name: &'static str,
    pub kind: ValueKind,
    /// Of an element that is there.
    pub required: bool,
}

/// What an element holds.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// Each at most once, in any order.
    Parts(&'static [Part]),
    /// Any number of them, in any order.
    List(&'static [ElementInfo]),
    /// Known by name and not simulated, with whatever it holds.
    Anything,
}

/// A child that may be there once.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub element: ElementInfo,
    pub need: Need,
}

/// What it means that a child is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    Required,
    /// One of those with this mark has to be there, and no other.
    Shape,
    /// Each of its attributes is then this.
    Default(&'static str),
    /// Nothing then.
    Optional,
}

#[derive(Clone, Copy, Debug)]
pub struct ElementInfo {
    pub name: &'static str,
    pub since: Since,
    /// What it says, with its unit.
    pub meaning: &'static str,
    pub attributes: &'static [AttributeInfo],
    pub content: Content,
}

impl ElementInfo {
    /// The children it may have, by whatever rule.
    pub fn children(&self) -> impl Iterator<Item = &'static ElementInfo> {
        let (parts, list): (&'static [Part], &'static [ElementInfo]) = match self.content {
            Content::Parts(parts) => (parts, &[]),
            Content::List(list) => (&[], list),
            Content::Anything => (&[], &[]),
        };
        parts.iter().map(|part| &part.element).chain(list)
    }
}

const fn required(name: &'static str, kind: ValueKind) -> AttributeInfo {
    AttributeInfo { name, kind, required: true }
}

const fn optional(name: &'static str, kind: ValueKind) -> AttributeInfo {
    AttributeInfo { name, kind, required: false }
}

const fn f32(kind: ValueKind) -> [AttributeInfo; 1] {
    [required("F32", kind)]
}

const fn xyz(kind: ValueKind) -> [AttributeInfo; 3] {
    [required("X", kind), required("Y", kind), required("Z", kind)]
}

const NUMBER: &[AttributeInfo] = &f32(ValueKind::Number);
const POSITIVE: &[AttributeInfo] = &f32(ValueKind::Positive);
const SHARE: &[AttributeInfo] = &f32(ValueKind::Between(0.0, 1.0));
const NOT_NEGATIVE: &[AttributeInfo] = &f32(ValueKind::NotNegative);
const VECTOR: &[AttributeInfo] = &xyz(ValueKind::Number);
const USER_ID: &[AttributeInfo] = &[optional("UserID", ValueKind::Id)];

/// An element of attributes only.
const fn leaf(
    name: &'static str,
    since: Since,
    attributes: &'static [AttributeInfo],
    meaning: &'static str,
) -> ElementInfo {
    ElementInfo { name, since, meaning, attributes, content: Content::Parts(&[]) }
}

const fn group(name: &'static str, content: Content, meaning: &'static str) -> ElementInfo {
    ElementInfo { name, since: Since::V1_0, meaning, attributes: &[], content }
}

const fn must(element: ElementInfo) -> Part {
    Part { element, need: Need::Required }
}

const fn may(element: ElementInfo) -> Part {
    Part { element, need: Need::Optional }
}

const fn or(element: ElementInfo, default: &'static str) -> Part {
    Part { element, need: Need::Default(default) }
}

const fn shape(element: ElementInfo) -> Part {
    Part { element, need: Need::Shape }
}

/// A shape that this version knows by name.
const fn unbuilt(name: &'static str) -> Part {
    let (since, meaning) = (Since::V1_1, "known and not simulated by this version");
    shape(ElementInfo { name, since, meaning, attributes: &[], content: Content::Anything })
}

/// Attributes of `Solver`, one for each of [`PARAMS`].
const SOLVER: [AttributeInfo; PARAMS.len()] = {
    let mut attributes = [optional("", ValueKind::Number); PARAMS.len()];
    let mut at = 0;
    while at < PARAMS.len() {
        let (low, high) = PARAMS[at].range;
        attributes[at] = optional(PARAMS[at].name, ValueKind::Between(low, high));
        at += 1;
    }
    attributes
};

const MAP: ElementInfo = group(
    "Map",
    Content::Parts(&[
        must(leaf("Size", Since::V1_0, &xyz(ValueKind::Positive), "the box [0,X]×[0,Y]×[0,Z], m")),
        must(leaf("Tiles", Since::V1_0, &xyz(ValueKind::Tiles), "cells of the search grid")),
    ]),
    "where the scene is; it does not collide",
);

const FORCE_PLACE: ElementInfo = leaf("Translation", Since::V1_0, VECTOR, "place, m");

const FORCES: &[ElementInfo] = &[
    ElementInfo {
        name: "GravityPlane",
        since: Since::V1_0,
        meaning: "uniform gravity",
        attributes: USER_ID,
        content: Content::Parts(&[
            or(FORCE_PLACE, "0"),
            or(leaf("Gravity", Since::V1_0, VECTOR, "g, m/s²"), "0"),
        ]),
    },
    ElementInfo {
        name: "GravityPoint",
        since: Since::V1_0,
        meaning: "gravity towards a point",
        attributes: USER_ID,
        content: Content::Parts(&[
            must(FORCE_PLACE),
            or(leaf("Gravity", Since::V1_0, NUMBER, "G, m³/s²; negative repels"), "0"),
        ]),
    },
    ElementInfo {
        name: "SpaceAverse",
        since: Since::V1_1,
        meaning: "drag of the air",
        attributes: USER_ID,
        content: Content::Parts(&[or(leaf("Density", Since::V1_1, NOT_NEGATIVE, "ρ, kg/m³"), "1.276")]),
    },
];

const SIMULATION: ElementInfo = group(
    "Simulation",
    Content::Parts(&[
        or(leaf("TimeSpeed", Since::V1_0, NOT_NEGATIVE, "model seconds per second while watching"), "1"),
        may(group("Forces", Content::List(FORCES), "what moves the bodies")),
        may(leaf("Solver", Since::V1_1, &SOLVER, "settings of the core that differ from their defaults")),
    ]),
    "forces and settings",
);

const TRANSLATION: Part = must(leaf("Translation", Since::V1_0, VECTOR, "centre, m"));
const ROTATION: Part =
    or(leaf("Rotation", Since::V1_0, VECTOR, "α, β, γ about x, y, z, rad: R = Rx(α)·Ry(β)·Rz(γ)"), "0");
const BOUNCE: Part =
    or(leaf("Bounce", Since::V1_0, NOT_NEGATIVE, "restitution; a pair has the product"), "1");
const FRICTION: Part =
    or(leaf("Friction", Since::V1_1, NOT_NEGATIVE, "μ of Coulomb's friction; a pair has √(μ₁μ₂)"), "0");
const ROLLING: Part = or(
    leaf("RollingFriction", Since::V1_1, NOT_NEGATIVE, "share of the load that slows a rolling ball; √ too"),
    "0",
);
const TANGENTIAL: Part =
    or(leaf("Tangential", Since::V1_1, SHARE, "part of the slip that an impact gives back; √ too"), "0");
const MATERIAL: Part = may(leaf(
    "Material",
    Since::V1_1,
    &[required("Text", ValueKind::Text)],
    "a name that custom forces may look at",
));
const SPHERE: Part = shape(group(
    "Sphere",
    Content::Parts(&[must(leaf("Radius", Since::V1_0, POSITIVE, "m"))]),
    "a ball, solid when it moves",
));
const PLANE: Part = shape(group(
    "Plane",
    Content::Parts(&[
        must(leaf("HalfSideX", Since::V1_0, POSITIVE, "m")),
        must(leaf("HalfSideY", Since::V1_0, POSITIVE, "m")),
    ]),
    "a bounded plane, local xy, hit from both sides; of static bodies",
));

/// Of both kinds of body, before what a kind has of its own.
const FIRST: [Part; 7] = [TRANSLATION, ROTATION, BOUNCE, FRICTION, ROLLING, TANGENTIAL, MATERIAL];
/// And after it.
const LAST: [Part; 4] = [unbuilt("Box"), unbuilt("Cylinder"), unbuilt("Mesh"), unbuilt("Compound")];

/// What a kind of body holds: its own parts between those that both have. `N` is the number of all.
const fn body_parts<const N: usize>(own: &[Part]) -> [Part; N] {
    assert!(N == FIRST.len() + own.len() + LAST.len());
    let mut parts = [TRANSLATION; N];
    let mut at = 0;
    while at < N {
        parts[at] = if at < FIRST.len() {
            FIRST[at]
        } else if at < FIRST.len() + own.len() {
            own[at - FIRST.len()]
        } else {
            LAST[at - FIRST.len() - own.len()]
        };
        at += 1;
    }
    parts
}

const BODIES: &[ElementInfo] = &[
    ElementInfo {
        name: "SoftObject",
        since: Since::V1_0,
        meaning: "a dynamic body",
        attributes: USER_ID,
        content: Content::Parts(&body_parts::<15>(&[
            or(leaf("Weight", Since::V1_0, POSITIVE, "mass, kg"), "1"),
            or(leaf("InitialVelocity", Since::V1_0, VECTOR, "m/s"), "0"),
            or(leaf("InitialAngularVelocity", Since::V1_1, VECTOR, "rad/s, about the axes of the map"), "0"),
            SPHERE,
        ])),
    },
    ElementInfo {
        name: "HardObject",
        since: Since::V1_0,
        meaning: "a static body",
        attributes: USER_ID,
        content: Content::Parts(&body_parts::<13>(&[SPHERE, PLANE])),
    },
];

/// The root element, and through it all others.
pub const VOCABULARY: ElementInfo = ElementInfo {
    name: "PolyPhysicsXml",
    since: Since::V1_0,
    meaning: "a scene",
    attributes: &[optional("Version", ValueKind::Version)],
    content: Content::Parts(&[
        must(MAP),
        may(SIMULATION),
        may(group("Primitives", Content::List(BODIES), "the bodies")),
    ]),
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::read::{BODY_ORDER, FORCES as READ_FORCES, NEW, SHAPES};

    fn all(element: &ElementInfo, found: &mut Vec<(&'static str, Since)>) {
        found.push((element.name, element.since));
        element.children().for_each(|child| all(child, found));
    }

    /// What the reader's own lists name is what stands here.
    #[test]
    fn it_has_the_names_that_the_reader_has() {
        let soft: Vec<_> = BODIES[0].children().map(|child| child.name).collect();
        let mut order = BODY_ORDER.to_vec();
        order.retain(|name| *name != "Plane");
        assert_eq!(soft, order);
        let hard: Vec<_> = BODIES[1].children().map(|child| child.name).collect();
        assert!(hard.iter().all(|name| BODY_ORDER.contains(name)));
        let Content::Parts(parts) = BODIES[1].content else { panic!() };
        let shapes = parts.iter().filter(|part| part.need == Need::Shape).map(|part| part.element.name);
        assert_eq!(shapes.collect::<Vec<_>>(), SHAPES);
        let mut forces: Vec<_> = FORCES.iter().map(|force| force.name).collect();
        forces.sort_unstable();
        let mut read = READ_FORCES.to_vec();
        read.sort_unstable();
        assert_eq!(forces, read);

        let mut found = Vec::new();
        all(&VOCABULARY, &mut found);
        let is_new = |name: &str| found.contains(&(name, Since::V1_1));
        assert!(NEW.iter().all(|name| is_new(name)), "a name of 1.1 is missing");
        for (name, _) in found.iter().filter(|(_, since)| *since == Since::V1_1) {
            assert!(NEW.contains(name) || *name == "Density", "{name} is not counted as new");
        }
    }
}
