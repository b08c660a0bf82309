//! The XML of new bodies, forces and shapes.

use std::sync::Arc;

use super::EditError;
use super::body::shape_name;
use super::cosmetic;
use super::force::kind_name;
use super::pen::{Changed, Pen};
use super::settings::vector;
use crate::scene::tree::Child;
use crate::scene::{Body, Force, ForceKind, Motion, Roughness, Shape, parse};

/// A body with the given id, its lines indented by `lead`.
pub(super) fn body(pen: Pen<'_>, lead: &str, id: i64, body: &Body) -> String {
    let inner = pen.style.inner_lead(lead);
    let mut parts = Vec::new();
    let color = body.color.map(cosmetic::color);
    let names = [body.name.as_deref(), body.group.as_deref(), color.as_deref()];
    parts.extend(cosmetics(pen, names, body.hidden, body.locked));
    parts.push(pen.leaf("Translation", &vector(body.position)));
    parts.push(pen.leaf("Rotation", &vector(body.rotation)));
    parts.push(pen.leaf("Bounce", &[("F32", body.bounce)]));
    let Roughness { friction, rolling, tangential } = body.roughness;
    let rough = [("Friction", friction), ("RollingFriction", rolling), ("Tangential", tangential)];
    let is_set = |(_, value): &(&str, f64)| *value != 0.0;
    parts.extend(rough.into_iter().filter(is_set).map(|(name, value)| pen.leaf(name, &[("F32", value)])));
    parts.extend(body.material.as_deref().filter(|text| !text.is_empty()).map(|text| material(pen, text)));
    let name = match body.motion {
        Motion::Static => "HardObject",
        Motion::Dynamic { mass, velocity } => {
            parts.push(pen.leaf("Weight", &[("F32", mass)]));
            parts.push(pen.leaf("InitialVelocity", &vector(velocity)));
            if body.spin != glam::DVec3::ZERO {
                parts.push(pen.leaf("InitialAngularVelocity", &vector(body.spin)));
            }
            "SoftObject"
        }
    };
    parts.push(shape(pen, &inner, &body.shape));
    nested(name, &pen.attribute("UserID", &id.to_string()), lead, &inner, &parts)
}

/// A force with the given id.
pub(super) fn force(pen: Pen<'_>, lead: &str, id: i64, force: &Force) -> String {
    let inner = pen.style.inner_lead(lead);
    let mut parts = Vec::new();
    parts.extend(cosmetics(
        pen,
        [force.name.as_deref(), force.group.as_deref(), None],
        force.hidden,
        force.locked,
    ));
    match force.kind {
        ForceKind::GravityPoint { position, intensity } => {
            parts.push(pen.leaf("Translation", &vector(position)));
            parts.push(pen.leaf("Gravity", &[("F32", intensity)]));
        }
        ForceKind::GravityPlane { position, acceleration } => {
            parts.push(pen.leaf("Translation", &vector(position)));
            parts.push(pen.leaf("Gravity", &vector(acceleration)));
        }
        ForceKind::Drag { density } => parts.push(pen.leaf("Density", &[("F32", density)])),
    }
    let attribute = pen.attribute("UserID", &id.to_string());
    nested(kind_name(&force.kind), &attribute, lead, &inner, &parts)
}

pub(super) fn shape(pen: Pen<'_>, lead: &str, shape: &Shape) -> String {
    let inner = pen.style.inner_lead(lead);
    let parts = sizes(shape).iter().map(|&(name, size)| pen.leaf(name, &[("F32", size)])).collect::<Vec<_>>();
    nested(shape_name(shape), "", lead, &inner, &parts)
}

/// The elements that give a shape its size.
pub(super) fn sizes(shape: &Shape) -> Vec<(&'static str, f64)> {
    match *shape {
        Shape::Sphere { radius } => vec![("Radius", radius)],
        Shape::Plane { half_x, half_y } => vec![("HalfSideX", half_x), ("HalfSideY", half_y)],
        Shape::Unbuilt { .. } => Vec::new(),
    }
}

pub(super) fn material(pen: Pen<'_>, text: &str) -> String {
    format!("<Material{}{}", pen.attribute("Text", text), pen.style.self_close)
}

/// One element parsed from XML of ours.
pub(super) fn element(pen: Pen<'_>, xml: &str) -> Changed {
    let nodes = parse::fragment(xml, &pen.source.keys).map_err(|fault| EditError::Invalid(fault.message))?;
    let element = nodes.iter().find_map(Child::element).map(Arc::clone);
    element.ok_or_else(|| EditError::Invalid("nothing was written".into()))
}

fn cosmetics(pen: Pen<'_>, names: [Option<&str>; 3], hidden: bool, locked: bool) -> Option<String> {
    let texts =
        ["name", "group", "color"].into_iter().zip(names.map(|text| text.filter(|text| !text.is_empty())));
    let flags = [("hidden", cosmetic::flag(hidden)), ("locked", cosmetic::flag(locked))];
    let all = texts.chain(flags);
    let text = all.filter_map(|(name, value)| Some(pen.attribute(name, value?))).collect::<String>();
    (!text.is_empty()).then(|| format!("<?polyscene{text}?>"))
}

fn nested(name: &str, attributes: &str, lead: &str, inner: &str, parts: &[String]) -> String {
    let parts = parts.iter().map(|part| format!("{inner}{part}")).collect::<String>();
    format!("<{name}{attributes}>{parts}{lead}</{name}>")
}
