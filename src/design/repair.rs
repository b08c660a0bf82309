//! Putting a scene right where it is clear how: overlapping bodies move apart along the shortest way, the map grows,
//! tiles fit, UserIDs become unique.

use glam::DVec3;

use super::extent::Extent;
use super::gap::{gap, overlap};
use super::measure::{MOST_ON_AXIS, Repair, fitting_tiles, is_outside, may_move, may_part};
use super::near::for_each_near;
use super::plan::Plan;
use super::tool::{Tool, ToolGroup};
use super::trouble::{overlapping, troubles};
use crate::scene::{Body, BodyChange, Document, Edit, EditError, ForceChange, NodeKey, Scene, Touched};

/// Rounds in which all pairs are pushed apart: chains of balls take about as many as they are long.
const ROUNDS: usize = 400;

/// Pairs looked at in all rounds together: a second or so, for the window waits.
const MOST_PUSHES: usize = 1_000_000;

pub(super) const PUSH_APART: Tool = Tool {
    id: "push_apart",
    label: "Push overlapping bodies apart",
    group: ToolGroup::Repair,
    help: "Moves overlapping bodies along their shortest ways until they touch; static and locked ones stay",
    inputs: &[],
    follow: None,
    enabled: |given| {
        if first_overlap(given.scene) { Ok(()) } else { Err("no bodies overlap that may be moved") }
    },
    plan: |given, _| repair(given.scene, Repair::PushAllApart).ok_or_else(|| "nothing could be moved".into()),
};

pub(super) const GROW_MAP: Tool = Tool {
    id: "grow_map",
    label: "Grow the map to hold all",
    group: ToolGroup::Repair,
    help: "Enlarges the map by whole tiles until all moving bodies start inside",
    inputs: &[],
    follow: None,
    enabled: |given| {
        let any = given.scene.bodies.iter().any(|body| is_outside(given.scene, body));
        if any { Ok(()) } else { Err("no moving body starts outside the map") }
    },
    plan: |given, _| {
        repair(given.scene, Repair::GrowMap).ok_or_else(|| "the map cannot grow that far".into())
    },
};

pub(super) const FIT_TILES: Tool = Tool {
    id: "fit_tiles",
    label: "Fit tiles",
    group: ToolGroup::Repair,
    help: "Chooses the number of tiles by the size of the balls; changes the speed, never the result",
    inputs: &[],
    follow: None,
    enabled: |given| {
        let fits = fitting_tiles(given.scene) == given.scene.map.tiles;
        if fits { Err("the tiles fit") } else { Ok(()) }
    },
    plan: |given, _| repair(given.scene, Repair::FitTiles).ok_or_else(|| "the tiles fit".into()),
};

/// The edits that put this right; `None` where there is nothing to do or it cannot be done.
pub fn repair(scene: &Scene, repair: Repair) -> Option<Plan> {
    match repair {
        Repair::PushApart(a, b) => push_pair(scene, a, b),
        Repair::PushAllApart => push_all(scene),
        Repair::GrowMap => grow_map(scene),
        Repair::FitTiles => {
            let tiles = fitting_tiles(scene);
            (tiles != scene.map.tiles).then(|| Plan::new("Fit tiles", vec![Edit::MapTiles(tiles)]))
        }
        Repair::MakeIdsUnique => Some(Plan::new("Make IDs unique", vec![Edit::MakeIdsUnique])),
    }
}

/// A document with all put right that can be.
pub struct Repaired {
    pub document: Document,
    pub touched: Touched,
    /// What was done, one line each.
    pub done: Vec<String>,
}

/// Puts right all that can be.
pub fn repair_all(document: &Document) -> Result<Repaired, EditError> {
    let mut repaired = Repaired { document: document.clone(), touched: Touched::default(), done: Vec::new() };
    let steps = [
        (Repair::MakeIdsUnique, "gave new UserIDs to what repeated one"),
        (Repair::PushAllApart, "pushed overlapping bodies apart"),
        (Repair::GrowMap, "enlarged the map to hold all moving bodies"),
        (Repair::FitTiles, "fitted the tiles to the balls"),
    ];
    for (step, what) in steps {
        let Some(scene) = repaired.document.scene() else { break };
        let is_wanted = match step {
            Repair::MakeIdsUnique => scene.has_repeated_ids(),
            _ => troubles(scene).iter().any(|trouble| solves(step, trouble.repair)),
        };
        let Some(plan) = is_wanted.then(|| repair(scene, step)).flatten() else { continue };
        let remark = plan.remark.map_or(String::new(), |remark| format!(" ({remark})"));
        let edited = repaired.document.apply(&Edit::All(plan.edits))?;
        repaired.document = edited.document;
        repaired.touched.extend(&edited.touched);
        repaired.done.push(format!("{what}{remark}"));
    }
    Ok(repaired)
}

fn solves(step: Repair, wanted: Option<Repair>) -> bool {
    wanted == Some(step) || (step == Repair::PushAllApart && matches!(wanted, Some(Repair::PushApart(..))))
}

fn first_overlap(scene: &Scene) -> bool {
    let mut found = false;
    for_each_near(&scene.bodies, 0.0, |a, b| {
        let (a, b) = (&scene.bodies[a], &scene.bodies[b]);
        found = may_part(a, b) && overlap(scene, a, b).is_some();
        !found
    });
    found
}

fn push_pair(scene: &Scene, a: NodeKey, b: NodeKey) -> Option<Plan> {
    let find = |key| scene.bodies.iter().find(|body| body.key == key);
    let (mut a, mut b) = (find(a)?.clone(), find(b)?.clone());
    let label = format!("Push {} and {} apart", a.display_name(), b.display_name());
    overlap(scene, &a, &b)?;
    push(&mut a, &mut b)?;
    let changed = [a, b].into_iter().filter(may_move);
    Some(Plan::new(label, changed.map(|body| placed(&body)).collect()))
}

/// Moves two overlapping bodies along their shortest way until they touch, each by half if both may move.
fn push(a: &mut Body, b: &mut Body) -> Option<()> {
    let now = gap(a, b)?;
    let way = now.towards * -now.distance;
    match (may_move(a), may_move(b)) {
        (true, true) => {
            a.position -= way / 2.0;
            b.position += way / 2.0;
        }
        (true, false) => a.position -= way,
        (false, true) => b.position += way,
        (false, false) => return None,
    }
    Some(())
}

fn push_all(scene: &Scene) -> Option<Plan> {
    let mut bodies = scene.bodies.clone();
    let mut pushes = 0;
    for _ in 0..ROUNDS {
        let mut pairs = Vec::new();
        for_each_near(&bodies, 0.0, |a, b| {
            if may_part(&bodies[a], &bodies[b]) && overlap(scene, &bodies[a], &bodies[b]).is_some() {
                pairs.push((a, b));
            }
            true
        });
        if pairs.is_empty() || pushes > MOST_PUSHES {
            break;
        }
        pushes += pairs.len();
        // Plates last, so that no round ends with a ball behind one.
        pairs.sort_by_key(|&(a, b)| (!(bodies[a].is_dynamic() && bodies[b].is_dynamic()), a, b));
        for (a, b) in pairs {
            let [one, other] = bodies.get_two_mut(a, b)?;
            if overlap(scene, one, other).is_some() {
                push(one, other);
            }
        }
    }
    let moved = bodies.iter().zip(&scene.bodies).filter(|(now, before)| now.position != before.position);
    let edits: Vec<Edit> = moved.map(|(now, _)| placed(now)).collect();
    // As many as are listed after it.
    let left = overlapping(scene, &bodies).len();
    let remark =
        (left > 0).then(|| format!("{left} pairs still overlap: push them apart again, or make room"));
    let label = format!("Push {} bodies apart", edits.len());
    (!edits.is_empty()).then(|| Plan { remark, ..Plan::new(label, edits) })
}

fn placed(body: &Body) -> Edit {
    Edit::Body { key: body.key, change: BodyChange::Position(body.position) }
}

/// Enlarges the map by whole tiles; where something lies below 0, all moves up by whole tiles.
fn grow_map(scene: &Scene) -> Option<Plan> {
    let map = &scene.map;
    let side = map.size / DVec3::from_array(map.tiles.map(f64::from));
    let moving = Extent::around(scene.bodies.iter().filter(|body| body.is_dynamic()))?;
    let shift = (-moving.min.min(DVec3::ZERO) / side).ceil() * side;
    let (low, high) = (map.size + shift, moving.max + shift);
    let counts = (low.max(high) / side).ceil();
    // A map that is an exact number of tiles must not gain one by rounding.
    let counts = DVec3::select(high.cmple(low), (low / side).round(), counts);
    if !(counts.is_finite() && counts.cmple(DVec3::splat(MOST_ON_AXIS)).all()) {
        return None;
    }
    let size = DVec3::select((shift.cmpeq(DVec3::ZERO)) & high.cmple(map.size), map.size, counts * side);
    let mut edits = vec![Edit::MapSize(size), Edit::MapTiles(counts.to_array().map(|count| count as u32))];
    let mut label = "Grow the map".to_owned();
    if shift != DVec3::ZERO {
        edits.extend(shifted(scene, shift));
        label = format!("Grow the map and move all by ({}, {}, {}) m", shift.x, shift.y, shift.z);
    }
    (size != map.size).then(|| Plan::new(label, edits))
}

/// Moves every body and force.
fn shifted(scene: &Scene, by: DVec3) -> impl Iterator<Item = Edit> {
    let bodies = scene.bodies.iter().map(move |body| {
        let change = BodyChange::Position(body.position + by);
        Edit::Body { key: body.key, change }
    });
    let forces = scene.forces.iter().filter_map(move |force| {
        let kind = force.kind.moved(by)?;
        Some(Edit::Force { key: force.key, change: ForceChange::Kind(kind) })
    });
    forces.chain(bodies)
}
