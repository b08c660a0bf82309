//! Numbers that a format cannot hold: a scene has any of 64 bits, and what another program works out of them, or keeps in 32
//! bits, may be none.

use super::error::ExportError;
use super::format::Source;
use crate::scene::{Body, Motion, Shape, escaped};

type Checked = Result<(), ExportError>;

const LARGEST_SINGLE: f64 = f32::MAX as f64;

/// What each body has as numbers, with the unit.
fn quantities(body: &Body) -> Vec<(&'static str, &'static str, f64)> {
    let largest = |vector: glam::DVec3| vector.abs().max_element();
    let mut found = match body.shape {
        Shape::Sphere { radius } => vec![("radius", "m", radius)],
        Shape::Plane { half_x, half_y } => vec![("half side", "m", half_x), ("half side", "m", half_y)],
        Shape::Unbuilt { .. } => Vec::new(),
    };
    found.push(("friction", "", body.roughness.friction));
    if let Motion::Dynamic { mass, velocity } = body.motion {
        found.push(("mass", "kg", mass));
        found.push(("velocity", "m/s", largest(velocity)));
        found.push(("spin", "degrees/s", largest(body.spin).to_degrees()));
    }
    found
}

/// Numbers of 64 bits, and what programs that simulate work out of them: moments of inertia, whole sides, all gravity.
pub(super) fn doubles(source: &Source<'_>, format: &str) -> Checked {
    for body in &source.scene.bodies {
        match (body.motion, &body.shape) {
            (Motion::Dynamic { mass, .. }, Shape::Sphere { radius }) => {
                let moment = 0.4 * mass * radius * radius;
                if !(moment > 0.0 && moment.is_finite()) {
                    let why = format!("radius {radius:?} m and mass {mass:?} kg give a moment of inertia of");
                    return beyond(&whom(body), &why, moment, "kg·m²", format);
                }
            }
            (_, Shape::Plane { half_x, half_y }) => {
                let side = 2.0 * half_x.max(*half_y);
                if !side.is_finite() {
                    return beyond(&whom(body), "twice its half side is", side, "m", format);
                }
            }
            _ => {}
        }
    }
    let gravity = source.gravity().abs().max_element();
    match gravity.is_finite() {
        true => Ok(()),
        false => beyond("uniform gravity", "the sum of all is", gravity, "m/s²", format),
    }
}

/// What is written of the map and of the air, as numbers of 64 bits.
pub(super) fn surroundings(source: &Source<'_>, format: &str) -> Checked {
    let (size, density) = (source.scene.map.size, source.air_density());
    if !size.length().is_finite() {
        let largest = size.abs().max_element();
        return beyond(
            "map",
            "its diagonal is beyond all numbers, its longest side is",
            largest,
            "m",
            format,
        );
    }
    match density.is_finite() {
        true => Ok(()),
        false => beyond("air", "the sum of all densities is", density, "kg/m³", format),
    }
}

/// Numbers of 32 bits for bodies and gravity.
pub(super) fn singles(source: &Source<'_>, format: &str) -> Checked {
    for body in &source.scene.bodies {
        for (what, unit, value) in quantities(body) {
            // a mass of 0 would be one to work out
            let vanishes = what == "mass" && value as f32 == 0.0;
            if value.abs() > LARGEST_SINGLE || vanishes {
                return beyond(&whom(body), &format!("its {what} is"), value, unit, format);
            }
        }
    }
    let gravity = source.gravity().length();
    match gravity <= LARGEST_SINGLE {
        true => Ok(()),
        false => beyond("uniform gravity", "the sum of all is", gravity, "m/s²", format),
    }
}

/// Numbers of 32 bits for what is seen: places, sizes, and how far cameras reach.
pub(super) fn seen(source: &Source<'_>, format: &str) -> Checked {
    for body in &source.scene.bodies {
        let place = body.position.abs().max_element();
        let sizes = quantities(body).into_iter().filter(|(what, ..)| ["radius", "half side"].contains(what));
        for (what, unit, value) in sizes.chain([("position", "m", place)]) {
            if value > LARGEST_SINGLE {
                return beyond(&whom(body), &format!("its {what} is"), value, unit, format);
            }
        }
    }
    let size = source.scene.map.size;
    let is_seen_far = !source.document.viewpoints().is_empty() && size.length() > LARGEST_SINGLE;
    match is_seen_far {
        true => beyond("map", "its longest side is", size.abs().max_element(), "m", format),
        false => Ok(()),
    }
}

/// A place (m) on the way of a body, at a time (s), beyond numbers of 32 bits.
pub(super) fn too_far(body: &Body, place: glam::DVec3, time: f64, format: &str) -> Checked {
    let what = format!("its position at t = {time} s is");
    beyond(&whom(body), &what, place.abs().max_element(), "m", format)
}

fn whom(body: &Body) -> String {
    format!("body {}", escaped(body.display_name()))
}

fn beyond(whom: &str, what: &str, value: f64, unit: &str, format: &str) -> Checked {
    let number = format!("{value:?} {unit}");
    Err(ExportError::Beyond(format!("{whom}: {what} {}, which {format} cannot hold", number.trim_end())))
}
