//! Shapes: the one child of a body that says what it looks like.

use super::body::{SHAPES, unbuilt};
use super::log::Log;
use crate::scene::Shape;
use crate::scene::rules::Range;
use crate::scene::tree::View;

/// Reads a body's shape. One that cannot be used is an error and keeps its element's name.
pub(super) fn read<'a>(
    body: View<'a>,
    log: &mut Log<'a>,
    shapes: [Option<View<'a>>; SHAPES.len()],
    dynamic: bool,
) -> Shape {
    let mut present = shapes.into_iter().flatten().collect::<Vec<_>>();
    present.sort_by_key(|el| el.place());
    if let [_, second, ..] = present[..] {
        log.error(second.place(), "the body has more than one shape", "remove all but one");
    }
    let Some(&el) = present.first() else {
        let hint = "write <Sphere><Radius F32=\"…\" /></Sphere>";
        log.error(body.place(), "the body has no shape", hint);
        return Shape::Unbuilt { element: String::new() };
    };
    let shape = log.within(el, |log| match el.name() {
        "Sphere" => sphere(log, el),
        "Plane" => plane(log, el, dynamic),
        name => {
            unbuilt(log, el, name);
            None
        }
    });
    shape.unwrap_or_else(|| Shape::Unbuilt { element: el.name().to_owned() })
}

fn sphere<'a>(log: &mut Log<'a>, el: View<'a>) -> Option<Shape> {
    log.check_attributes(el, &[]);
    let [radius] = log.children(el, ["Radius"]);
    Some(Shape::Sphere { radius: size(log, el, radius, "Radius")? })
}

fn plane<'a>(log: &mut Log<'a>, el: View<'a>, dynamic: bool) -> Option<Shape> {
    if dynamic {
        let hint = "make the body a HardObject, or give it a Sphere";
        log.error(el.place(), "a plane cannot be a dynamic body", hint);
    }
    log.check_attributes(el, &[]);
    let [x, y] = log.children(el, ["HalfSideX", "HalfSideY"]);
    let (half_x, half_y) = (size(log, el, x, "HalfSideX"), size(log, el, y, "HalfSideY"));
    Some(Shape::Plane { half_x: half_x?, half_y: half_y? })
}

fn size<'a>(log: &mut Log<'a>, shape: View<'a>, el: Option<View<'a>>, name: &str) -> Option<f64> {
    if el.is_none() {
        let hint = format!("write <{name} F32=\"…\" />");
        log.error(shape.place(), format!("the {} has no {name}", shape.name()), hint);
    }
    log.scalar(el?, Range::Positive)
}
