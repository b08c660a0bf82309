//! Order among the selected bodies: in line, and at equal gaps.

use std::collections::BTreeMap;

use super::inputs::{AXIS, around, axis, moved, with_several};
use crate::design::extent::Extent;
use crate::design::plan::{Given, Plan};
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::scene::{Body, NodeKey};

pub const ALIGN: Tool = Tool {
    id: "align",
    label: "Align…",
    group: ToolGroup::Arrange,
    help: "Moves the selected bodies along an axis until their sides or middles are in line",
    inputs: &[
        AXIS,
        Input {
            label: "Line up",
            unit: "",
            help: "The sides or middles that come into line, within the box around all",
            kind: Kind::Choice(&["lowest sides", "middles", "highest sides"]),
            default: |_| 1.0,
        },
    ],
    follow: None,
    enabled: with_several,
    plan: |given, values| {
        let (axis, which) = (values.count("Axis").min(2), values.count("Line up"));
        let line = |extent: Extent| match which {
            0 => extent.min[axis],
            1 => extent.middle()[axis],
            _ => extent.max[axis],
        };
        let goal = line(around(given));
        Ok(moves(given, axis, "Align", |body| goal - line(Extent::of(body))))
    },
};

pub const DISTRIBUTE: Tool = Tool {
    id: "distribute",
    label: "Distribute…",
    group: ToolGroup::Arrange,
    help: "Spaces the selected bodies evenly along an axis between the first and the last of them",
    inputs: &[
        AXIS,
        Input {
            label: "Make equal",
            unit: "",
            help: "The gaps between surfaces, or the distances of middles",
            kind: Kind::Choice(&["gaps", "distances of middles"]),
            default: |_| 0.0,
        },
    ],
    follow: None,
    enabled: with_several,
    plan: |given, values| {
        let axis = values.count("Axis").min(2);
        let mut bodies = given.movable();
        bodies.sort_by(|a, b| a.position[axis].total_cmp(&b.position[axis]));
        let sizes: Vec<f64> = bodies.iter().map(|body| Extent::of(body).size()[axis]).collect();
        let (Some(first), Some(last)) = (bodies.first(), bodies.last()) else { return Ok(Plan::default()) };
        let between = (bodies.len() - 1) as f64;
        let way = last.position[axis] - first.position[axis];
        // From middle to middle lie half of each neighbour and a gap.
        let inner: f64 = sizes.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).sum();
        let gap = (way - inner) / between;
        let mut places = vec![first.position[axis]];
        for (nth, pair) in sizes.windows(2).enumerate() {
            let step =
                if values.count("Make equal") == 0 { gap + (pair[0] + pair[1]) / 2.0 } else { way / between };
            let before = places.get(nth).copied().unwrap_or_default();
            places.push(before + step);
        }
        // The ends stay to the bit.
        let inside = bodies.iter().zip(places).take(bodies.len() - 1).skip(1);
        let goals: BTreeMap<NodeKey, f64> = inside.map(|(body, place)| (body.key, place)).collect();
        let by = |body: &Body| goals.get(&body.key).map_or(0.0, |goal| goal - body.position[axis]);
        Ok(moves(given, axis, "Distribute", by))
    },
};

/// Moves each movable body along an axis by what `by` says.
fn moves(given: &Given<'_>, along: usize, verb: &str, by: impl Fn(&Body) -> f64) -> Plan {
    let bodies = given.movable();
    let edits = bodies.iter().map(|body| (body, by(body))).filter(|(_, by)| *by != 0.0);
    let edits = edits.map(|(body, by)| moved(body.key, body.position + axis(along) * by)).collect();
    Plan::new(format!("{verb} {} bodies", bodies.len()), edits)
}
