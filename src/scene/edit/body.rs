//! Edits of one body.

use std::sync::Arc;

use super::cosmetic;
use super::patch::reading_after;
use super::pen::{Changed, Pen, Spot, check, check_text, check_vector};
use super::settings::vector;
use super::{BodyChange, EditError, compose};
use crate::scene::Shape;
use crate::scene::read::{BODY_ORDER, SHAPES};
use crate::scene::rules::Range;
use crate::scene::tree::{Child, Element};

/// Applies one change to a body's element, which is not read again where the change says what it means.
pub(super) fn change(pen: Pen<'_>, el: &Arc<Element>, lead: &str, change: &BodyChange) -> Changed {
    let changed = written(pen, el, lead, change)?;
    let before = el.reading.get().filter(|_| !Arc::ptr_eq(&changed, el));
    if let Some(now) = before.and_then(|before| reading_after(before, change)) {
        changed.reading.get_or_init(|| Arc::new(now));
    }
    Ok(changed)
}

fn written(pen: Pen<'_>, el: &Arc<Element>, lead: &str, change: &BodyChange) -> Changed {
    let dynamic = pen.view(el).name() == "SoftObject";
    let leaf = |name, numbers: &[_], default| pen.with_leaf(el, lead, (name, &BODY_ORDER), numbers, default);
    match change {
        BodyChange::Id(id) => Ok(pen.with_text(el, "UserID", &id.to_string())),
        BodyChange::Name(name) => {
            let name = name.as_deref().filter(|name| !name.is_empty());
            name.map_or(Ok(()), check_text)?;
            cosmetic::set(pen, el, lead, "name", name)
        }
        BodyChange::Group(group) => {
            let group = group.as_deref().filter(|group| !group.is_empty());
            group.map_or(Ok(()), check_text)?;
            cosmetic::set(pen, el, lead, "group", group)
        }
        BodyChange::Color(color) => {
            cosmetic::set(pen, el, lead, "color", color.map(cosmetic::color).as_deref())
        }
        BodyChange::Hidden(on) => cosmetic::set(pen, el, lead, "hidden", cosmetic::flag(*on)),
        BodyChange::Locked(on) => cosmetic::set(pen, el, lead, "locked", cosmetic::flag(*on)),
        BodyChange::Position(position) => {
            check_vector("the position", *position, Range::Any)?;
            leaf("Translation", &vector(*position), None)
        }
        BodyChange::Rotation(rotation) => {
            check_vector("the rotation", *rotation, Range::Any)?;
            leaf("Rotation", &vector(*rotation), Some(0.0))
        }
        BodyChange::Bounce(bounce) => {
            check("the bounce", *bounce, Range::NotNegative)?;
            leaf("Bounce", &[("F32", *bounce)], Some(1.0))
        }
        BodyChange::Friction(_) | BodyChange::RollingFriction(_) | BodyChange::Tangential(_) => {
            set_roughness(pen, el, lead, change)
        }
        BodyChange::Material(material) => set_material(pen, el, lead, material.as_deref()),
        BodyChange::Mass(_) | BodyChange::Velocity(_) | BodyChange::Spin(_) if !dynamic => {
            Err(EditError::Invalid("a static body has no mass and no velocity".into()))
        }
        BodyChange::Mass(mass) => {
            check("the mass", *mass, Range::Positive)?;
            leaf("Weight", &[("F32", *mass)], Some(1.0))
        }
        BodyChange::Velocity(velocity) => {
            check_vector("the velocity", *velocity, Range::Any)?;
            leaf("InitialVelocity", &vector(*velocity), Some(0.0))
        }
        BodyChange::Spin(spin) => {
            check_vector("the angular velocity", *spin, Range::Any)?;
            new_leaf(pen, el, lead, "InitialAngularVelocity", &vector(*spin))
        }
        BodyChange::Shape(shape) => {
            check_shape(shape, dynamic)?;
            set_shape(pen, el, lead, shape)
        }
    }
}

fn set_roughness(pen: Pen<'_>, el: &Arc<Element>, lead: &str, change: &BodyChange) -> Changed {
    let (element, name, value, range) = match *change {
        BodyChange::Friction(value) => ("Friction", "the friction", value, Range::NotNegative),
        BodyChange::RollingFriction(value) => {
            ("RollingFriction", "the rolling friction", value, Range::NotNegative)
        }
        BodyChange::Tangential(value) => {
            ("Tangential", "the tangential restitution", value, Range::Between(0.0, 1.0))
        }
        _ => return Ok(el.clone()),
    };
    check(name, value, range)?;
    new_leaf(pen, el, lead, element, &[("F32", value)])
}

/// Sets the numbers of an element of 1.1, which goes where they become 0: so older tools read the file again. One that
/// was written with 0 all along stays.
fn new_leaf(pen: Pen<'_>, el: &Arc<Element>, lead: &str, name: &str, numbers: &[(&str, f64)]) -> Changed {
    let changed = pen.with_leaf(el, lead, (name, &BODY_ORDER), numbers, Some(0.0))?;
    let is_gone = numbers.iter().all(|(_, value)| *value == 0.0) && !Arc::ptr_eq(&changed, el);
    match pen.child_at(&changed, name).filter(|_| is_gone) {
        Some(at) => Ok(Arc::new(pen.without_child(&changed, at))),
        None => Ok(changed),
    }
}

fn set_material(pen: Pen<'_>, el: &Arc<Element>, lead: &str, material: Option<&str>) -> Changed {
    let material = material.filter(|material| !material.is_empty());
    material.map_or(Ok(()), check_text)?;
    match (pen.child_at(el, "Material"), material) {
        (Some(at), Some(text)) => pen.with_child(el, at, |child, _| Ok(pen.with_text(child, "Text", text))),
        (Some(at), None) => Ok(Arc::new(pen.without_child(el, at))),
        (None, Some(text)) => {
            pen.with_new(el, lead, Spot::Ordered(&BODY_ORDER), "Material", |_| compose::material(pen, text))
        }
        (None, None) => Ok(el.clone()),
    }
}

/// Refuses what the reader would call an error.
pub(super) fn check_shape(shape: &Shape, dynamic: bool) -> Result<(), EditError> {
    match shape {
        Shape::Sphere { radius } => check("the radius", *radius, Range::Positive),
        Shape::Plane { .. } if dynamic => Err(EditError::Invalid(
            "a plane cannot be a dynamic body; make it a sphere, or the body static".into(),
        )),
        Shape::Plane { half_x, half_y } => {
            check("half the side x", *half_x, Range::Positive)?;
            check("half the side y", *half_y, Range::Positive)
        }
        Shape::Unbuilt { .. } => Err(EditError::Invalid("this version cannot simulate that shape".into())),
    }
}

/// Changes the numbers of the shape, or replaces all shapes by a new one.
fn set_shape(pen: Pen<'_>, el: &Arc<Element>, lead: &str, shape: &Shape) -> Changed {
    let source = &pen.source.text;
    let is_shape = |child: &Child| {
        child
            .element()
            .is_some_and(|node| SHAPES.contains(&crate::scene::tree::tag::name(node.open.get(source))))
    };
    let mut places =
        el.children(source).iter().enumerate().filter(|(_, child)| is_shape(child)).map(|(at, _)| at);
    let Some(first) = places.next() else {
        return pen.with_new(el, lead, Spot::Ordered(&BODY_ORDER), shape_name(shape), |lead| {
            compose::shape(pen, lead, shape)
        });
    };
    let surplus = places.collect::<Vec<_>>();
    let mut body = el.clone();
    for &at in surplus.iter().rev() {
        body = Arc::new(pen.without_child(&body, at));
    }
    pen.with_child(&body, first, |old, lead| {
        if pen.view(old).name() == shape_name(shape) {
            let sizes = compose::sizes(shape);
            let order = sizes.iter().map(|&(name, _)| name).collect::<Vec<_>>();
            sizes.iter().try_fold(old.clone(), |shape, &(name, size)| {
                pen.with_leaf(&shape, lead, (name, &order), &[("F32", size)], None)
            })
        } else {
            compose::element(pen, &compose::shape(pen, lead, shape))
        }
    })
}

pub(super) fn shape_name(shape: &Shape) -> &str {
    match shape {
        Shape::Sphere { .. } => "Sphere",
        Shape::Plane { .. } => "Plane",
        Shape::Unbuilt { element } => element,
    }
}
