//! Edits of the map and of the solver's parameters.

use std::sync::Arc;

use glam::DVec3;

use super::EditError;
use super::pen::{Changed, Pen, Spot, check};
use crate::scene::rules::Range;
use crate::scene::tree::{Child, Element, tag};
use crate::scene::{PARAMS, SimParams, number};

const MAP_ORDER: [&str; 2] = ["Size", "Tiles"];

pub(super) fn set_size(pen: Pen<'_>, map: &Arc<Element>, lead: &str, size: DVec3) -> Changed {
    pen.with_leaf(map, lead, ("Size", &MAP_ORDER), &vector(size), None)
}

pub(super) fn set_tiles(pen: Pen<'_>, map: &Arc<Element>, lead: &str, tiles: [u32; 3]) -> Changed {
    let tiles = DVec3::from(tiles.map(f64::from));
    pen.with_leaf(map, lead, ("Tiles", &MAP_ORDER), &vector(tiles), None)
}

/// A vector as the attributes `X Y Z`.
pub(super) fn vector(v: DVec3) -> [(&'static str, f64); 3] {
    [("X", v.x), ("Y", v.y), ("Z", v.z)]
}

pub(super) fn check_params(params: &SimParams) -> Result<(), EditError> {
    PARAMS.iter().try_for_each(|info| check(info.label, (info.get)(params), Range::of_param(info)))
}

/// Writes the parameters that are not the default; `Solver` goes when it says nothing any more.
pub(super) fn set_params(
    pen: Pen<'_>,
    simulation: &Arc<Element>,
    lead: &str,
    order: &[&str],
    params: &SimParams,
) -> Changed {
    let defaults = SimParams::default();
    let differs =
        PARAMS.iter().filter(|info| (info.get)(params).to_bits() != (info.get)(&defaults).to_bits());
    let wanted = differs.map(|info| (info.name, (info.get)(params))).collect::<Vec<_>>();
    let Some(at) = pen.child_at(simulation, "Solver") else {
        if wanted.is_empty() {
            return Ok(simulation.clone());
        }
        return pen
            .with_new(simulation, lead, Spot::Ordered(order), "Solver", |_| pen.leaf("Solver", &wanted));
    };
    let Some(solver) = simulation.children(&pen.source.text).get(at).and_then(Child::element) else {
        return Err(EditError::Gone);
    };
    let solver = without_defaults(pen, &pen.with_numbers(solver, &wanted), params);
    if pen.view(&solver).attributes().next().is_none() && solver.children(&pen.source.text).len() == 0 {
        return Ok(Arc::new(pen.without_child(simulation, at)));
    }
    pen.with_child(simulation, at, |_, _| Ok(solver))
}

/// Removes the attributes whose parameter went back to its default. One that was written with the
/// default value all along stays.
fn without_defaults(pen: Pen<'_>, solver: &Arc<Element>, params: &SimParams) -> Arc<Element> {
    let view = pen.view(solver);
    let mut open = view.tag().to_owned();
    for info in PARAMS {
        let written = view.value(info.name).map(|raw| number::parse(&raw));
        let now = (info.get)(params);
        if written.is_some_and(|written| written.ok().map(f64::to_bits) != Some(now.to_bits())) {
            open = tag::without(&open, info.name);
        }
    }
    if open == view.tag() { solver.clone() } else { Arc::new(solver.with_open(open)) }
}
