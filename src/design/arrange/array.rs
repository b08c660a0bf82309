//! Copies at regular places: in rows, on a circle, along a line.

use glam::DVec3;

use super::inputs::{ANYWHERE, AXES, around, axis, check_count, pitch, with_bodies};
use crate::design::plan::{Given, Plan};
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::design::turn::{turn, turned};
use crate::scene::{Body, BodyChange, BodyCopy, Edit};

const COUNT: Kind = Kind::Whole(1.0, 10_000.0);

pub const ARRAY: Tool = Tool {
    id: "array",
    label: "Array…",
    group: ToolGroup::Arrange,
    help: "Repeats the selection in rows, columns and layers",
    inputs: &[
        Input {
            label: "Count x",
            unit: "",
            help: "In all, the original included",
            kind: COUNT,
            default: |_| 3.0,
        },
        Input {
            label: "Count y",
            unit: "",
            help: "In all, the original included",
            kind: COUNT,
            default: |_| 1.0,
        },
        Input {
            label: "Count z",
            unit: "",
            help: "In all, the original included",
            kind: COUNT,
            default: |_| 1.0,
        },
        Input {
            label: "Step x",
            unit: "m",
            help: "From copy to copy",
            kind: ANYWHERE,
            default: |given| pitch(given, 0),
        },
        Input {
            label: "Step y",
            unit: "m",
            help: "From copy to copy",
            kind: ANYWHERE,
            default: |given| pitch(given, 1),
        },
        Input {
            label: "Step z",
            unit: "m",
            help: "From copy to copy",
            kind: ANYWHERE,
            default: |given| pitch(given, 2),
        },
    ],
    follow: None,
    enabled: with_bodies,
    plan: |given, values| {
        let counts = ["Count x", "Count y", "Count z"].map(|label| values.count(label).max(1));
        let step = values.vector(["Step x", "Step y", "Step z"]);
        let cells = counts.iter().try_fold(1usize, |all, count| all.checked_mul(*count));
        let cells = cells.ok_or("That would be too many")?;
        let offsets = (1..cells).map(|nth| {
            let at = [nth % counts[0], nth / counts[0] % counts[1], nth / (counts[0] * counts[1])];
            step * DVec3::from_array(at.map(|at| at as f64))
        });
        repeated(given, cells, offsets)
    },
};

pub const LINE: Tool = Tool {
    id: "line",
    label: "Repeat along a line…",
    group: ToolGroup::Arrange,
    help: "Repeats the selection at equal steps up to a place this far away",
    inputs: &[
        Input {
            label: "Count",
            unit: "",
            help: "In all, the original included",
            kind: Kind::Whole(2.0, 10_000.0),
            default: |_| 5.0,
        },
        Input {
            label: "To x",
            unit: "m",
            help: "From the original to the last copy",
            kind: ANYWHERE,
            default: |given| 4.0 * pitch(given, 0),
        },
        Input {
            label: "To y",
            unit: "m",
            help: "From the original to the last copy",
            kind: ANYWHERE,
            default: |_| 0.0,
        },
        Input {
            label: "To z",
            unit: "m",
            help: "From the original to the last copy",
            kind: ANYWHERE,
            default: |_| 0.0,
        },
    ],
    follow: None,
    enabled: with_bodies,
    plan: |given, values| {
        let count = values.count("Count").max(2);
        let way = values.vector(["To x", "To y", "To z"]);
        let offsets = (1..count).map(|nth| way * (nth as f64 / (count - 1) as f64));
        repeated(given, count, offsets)
    },
};

pub const CIRCLE: Tool = Tool {
    id: "circle",
    label: "Repeat on a circle…",
    group: ToolGroup::Arrange,
    help: "Repeats the selection around an axis and turns copies and velocities along; 360° go all around",
    inputs: &[
        Input {
            label: "Count",
            unit: "",
            help: "In all, the original included",
            kind: Kind::Whole(2.0, 10_000.0),
            default: |_| 6.0,
        },
        Input { label: "Axis", unit: "", help: "The axis turned about", kind: AXES, default: |_| 1.0 },
        Input {
            label: "Angle",
            unit: "°",
            help: "From the original to the last copy",
            kind: Kind::Number(-360.0, 360.0),
            default: |_| 360.0,
        },
        Input {
            label: "Centre x",
            unit: "m",
            help: "A point of the axis",
            kind: ANYWHERE,
            default: |given| given.scene.map.size.x / 2.0,
        },
        Input {
            label: "Centre y",
            unit: "m",
            help: "A point of the axis",
            kind: ANYWHERE,
            default: |given| given.scene.map.size.y / 2.0,
        },
        Input {
            label: "Centre z",
            unit: "m",
            help: "A point of the axis",
            kind: ANYWHERE,
            default: |given| given.scene.map.size.z / 2.0,
        },
    ],
    follow: None,
    enabled: with_bodies,
    plan: |given, values| {
        let count = values.count("Count").max(2);
        let whole = values.number("Angle").to_radians();
        // A whole turn ends where it began, so its last copy stands one step before.
        let steps = if values.number("Angle").abs() == 360.0 { count } else { count - 1 };
        let axis = axis(values.count("Axis"));
        let centre = values.vector(["Centre x", "Centre y", "Centre z"]);
        let around = around(given).middle() - centre;
        if (around - around.dot(axis) * axis).length() == 0.0 {
            return Err("The selection lies on the axis: all copies would be at one place".into());
        }
        let bodies = given.bodies();
        check_count(bodies.len() * (count - 1))?;
        let turns = (1..count).map(|nth| turn(axis, whole * nth as f64 / steps as f64));
        let copies = turns.flat_map(|turn| {
            let copy = move |body: &&Body| BodyCopy { of: body.key, changes: turned(body, turn, centre) };
            bodies.iter().map(copy)
        });
        Ok(Plan::new(
            format!("Repeat {} bodies on a circle", bodies.len()),
            vec![Edit::CopyBodies(copies.collect())],
        ))
    },
};

/// Copies of the selection at each of these offsets.
fn repeated(
    given: &Given<'_>,
    cells: usize,
    offsets: impl Iterator<Item = DVec3> + Clone,
) -> Result<Plan, String> {
    let (bodies, forces) = (given.bodies(), given.forces());
    check_count(bodies.len().saturating_mul(cells.saturating_sub(1)))?;
    let copies = offsets.clone().flat_map(|offset| {
        bodies.iter().map(move |body| BodyCopy {
            of: body.key,
            changes: vec![BodyChange::Position(body.position + offset)],
        })
    });
    let mut edits = vec![Edit::CopyBodies(copies.collect())];
    let keys: Vec<_> = forces.iter().map(|force| force.key).collect();
    if !keys.is_empty() {
        edits.extend(offsets.map(|offset| Edit::Duplicate { keys: keys.clone(), offset }));
    }
    Ok(Plan::new(format!("Repeat {} objects", bodies.len() + forces.len()), edits))
}
