//! Selected balls slide along an axis until they touch what is in their way.

use glam::DVec3;

use super::inputs::moved;
use crate::design::extent::Extent;
use crate::design::gap::{gap, radius};
use crate::design::plan::{Given, Plan};
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::scene::Body;

/// Newton's method on a convex gap comes near from one side and needs a few steps; a grazing way more.
const STEPS: usize = 200;

pub const PACK: Tool = Tool {
    id: "pack",
    label: "Pack until touching…",
    group: ToolGroup::Arrange,
    help: "Slides the selected balls along an axis, the foremost first, each until it touches what is in its way",
    inputs: &[Input {
        label: "Towards",
        unit: "",
        help: "Balls with nothing in their way stay; all others end up touching",
        kind: Kind::Choice(&["−x", "+x", "−y", "+y", "−z", "+z"]),
        default: |_| 2.0,
    }],
    follow: None,
    enabled: |given| {
        let any = given.movable().into_iter().any(|body| radius(body).is_some());
        if any { Ok(()) } else { Err("no ball is selected that is not locked") }
    },
    plan: |given, values| {
        let chosen = values.count("Towards").min(5);
        let way = DVec3::AXES[chosen / 2] * if chosen % 2 == 0 { -1.0 } else { 1.0 };
        Ok(packed(given, way))
    },
};

fn packed(given: &Given<'_>, way: DVec3) -> Plan {
    let mut balls: Vec<Body> =
        given.movable().into_iter().filter(|body| radius(body).is_some()).cloned().collect();
    let front = |ball: &Body| ball.position.dot(way) + radius(ball).unwrap_or_default();
    balls.sort_by(|a, b| front(b).total_cmp(&front(a)));
    let keys: std::collections::BTreeSet<_> = balls.iter().map(|ball| ball.key).collect();
    let mut fixed: Vec<Body> =
        given.scene.bodies.iter().filter(|body| !keys.contains(&body.key)).cloned().collect();
    let (mut edits, mut free) = (Vec::new(), 0);
    for mut ball in balls {
        match fixed.iter().filter_map(|other| way_to(&ball, other, way)).reduce(f64::min) {
            Some(length) if length != 0.0 => {
                ball.position += way * length;
                edits.push(moved(ball.key, ball.position));
            }
            Some(_) => {}
            None => free += 1,
        }
        fixed.push(ball);
    }
    let remark = (free > 0).then(|| format!("{free} with nothing in their way stayed"));
    Plan { remark, ..Plan::new(format!("Pack {} balls", keys.len()), edits) }
}

/// How far a ball slides until it touches another body; `None` if it never does or overlaps it already.
fn way_to(ball: &Body, other: &Body, way: DVec3) -> Option<f64> {
    let radius = radius(ball)?;
    let extent = Extent::of(other);
    // Only what the swept ball can meet.
    let (own, across) = (Extent::of(ball), DVec3::ONE - way.abs());
    let beside = (own.max * across).cmplt(extent.min * across).any()
        || (own.min * across).cmpgt(extent.max * across).any();
    if beside {
        return None;
    }
    let at = |length: f64| gap(&Body { position: ball.position + way * length, ..ball.clone() }, other);
    let touches =
        16.0 * f64::EPSILON * (ball.position.abs().max_element() + extent.max.abs().max_element() + radius);
    let mut length = 0.0;
    for _ in 0..STEPS {
        let now = at(length)?;
        if now.distance < -touches {
            return None;
        }
        if now.distance <= touches {
            // Touching and sliding past is no obstacle.
            return (now.towards.dot(way) > 1e-9).then_some(length);
        }
        let closing = now.towards.dot(way);
        if closing <= 1e-9 {
            return None;
        }
        length += now.distance / closing;
    }
    None
}
