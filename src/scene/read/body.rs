//! Bodies: `SoftObject` and `HardObject`.

use std::borrow::Cow;

use compact_str::CompactString;
use glam::DVec3;

use super::cosmetic::Cosmetics;
use super::feature::{self, Use};
use super::log::{Log, place_in};
use super::shape;
use crate::scene::rules::Range;
use crate::scene::tree::View;
use crate::scene::{Body, Motion, Roughness, shown};

pub(super) const BODIES: [&str; 2] = ["SoftObject", "HardObject"];

/// The children of a body in the order in which they are written. A static body has no mass or motion.
pub(in crate::scene) const BODY_ORDER: [&str; 16] = [
    "Translation",
    "Rotation",
    "Bounce",
    "Friction",
    "RollingFriction",
    "Tangential",
    "Material",
    "Weight",
    "InitialVelocity",
    "InitialAngularVelocity",
    "Sphere",
    "Plane",
    "Box",
    "Cylinder",
    "Mesh",
    "Compound",
];

/// The shapes among them.
pub(in crate::scene) const SHAPES: [&str; 6] = ["Sphere", "Plane", "Box", "Cylinder", "Mesh", "Compound"];

/// Reads a body. What is wrong is reported and takes its default, so that the body can be shown and repaired.
pub(super) fn read<'a>(el: View<'a>, log: &mut Log<'a>, cosmetics: Cosmetics, uses: &mut Vec<Use>) -> Body {
    let dynamic = el.name() == "SoftObject";
    let [
        translation,
        rotation,
        bounce,
        friction,
        rolling,
        tangential,
        material,
        weight,
        velocity,
        spin,
        shapes @ ..,
    ] = log.children(el, BODY_ORDER);
    for child in [friction, rolling, tangential, material, spin].into_iter().chain(shapes).flatten() {
        feature::note(uses, child.name(), child.place());
    }
    if translation.is_none() {
        let hint = "write <Translation X=\"…\" Y=\"…\" Z=\"…\" />";
        log.error(el.place(), "the body has no Translation", hint);
    }
    let roughness = read_roughness(log, [friction, rolling, tangential]);
    let mut vector =
        |el: Option<View<'a>>| el.and_then(|el| log.vector(el, Range::Any)).unwrap_or(DVec3::ZERO);
    let (position, rotation) = (vector(translation), vector(rotation));
    let mut turns = DVec3::ZERO;
    let motion = if dynamic {
        let velocity = vector(velocity);
        turns = vector(spin);
        let mass = weight.and_then(|el| log.scalar(el, Range::Positive)).unwrap_or(1.0);
        Motion::Dynamic { mass, velocity }
    } else {
        for child in [weight, velocity, spin].into_iter().flatten() {
            let message = format!("{} means nothing on a static body", child.name());
            log.warn(child.place(), message, "it is kept as it is; a SoftObject would use it");
        }
        Motion::Static
    };
    Body {
        key: el.node.key,
        id: 0,
        label: CompactString::default(),
        name: cosmetics.name,
        group: cosmetics.group,
        color: cosmetics.color,
        hidden: cosmetics.hidden,
        locked: cosmetics.locked,
        position,
        rotation,
        bounce: read_bounce(log, bounce),
        roughness,
        spin: turns,
        material: material.and_then(|el| read_material(log, el)),
        motion,
        shape: shape::read(el, log, shapes, dynamic),
    }
}

fn read_bounce<'a>(log: &mut Log<'a>, el: Option<View<'a>>) -> f64 {
    let Some(el) = el else { return 1.0 };
    let bounce = log.scalar(el, Range::NotNegative).unwrap_or(1.0);
    if bounce > 1.0 {
        let at = el.attribute("F32").and_then(|attr| place_in(el, attr.value.start));
        let hint = "impacts add energy unless the other body's Bounce makes up for it";
        log.within(el, |log| log.warn(at, "Bounce is greater than 1", hint));
    }
    bounce
}

fn read_roughness<'a>(log: &mut Log<'a>, els: [Option<View<'a>>; 3]) -> Roughness {
    let ranges = [Range::NotNegative, Range::NotNegative, Range::Between(0.0, 1.0)];
    let mut pairs = els.into_iter().zip(ranges);
    let mut next = || pairs.next().and_then(|(el, range)| log.scalar(el?, range)).unwrap_or(0.0);
    Roughness { friction: next(), rolling: next(), tangential: next() }
}

fn read_material<'a>(log: &mut Log<'a>, el: View<'a>) -> Option<String> {
    log.within(el, |log| {
        log.leaf(el, &["Text"]);
        let text = el.value("Text");
        if text.is_none() {
            log.error(el.place(), "the attribute Text is missing", "write Text=\"…\"");
        }
        text.map(Cow::into_owned).filter(|text| !text.is_empty())
    })
}

/// Reports what the format knows and this version cannot simulate.
pub(super) fn unbuilt(log: &mut Log<'_>, el: View<'_>, what: &str) {
    let message = format!("{} cannot be simulated by this version", shown(what));
    log.error(el.place(), message, "it is kept in the file; remove it to run the scene");
}
