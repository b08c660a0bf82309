//! What is wrong with a scene as one designs it: overlaps, bodies outside the map, tiles, masses.

use std::collections::BTreeMap;

use glam::DVec3;

use super::gap::deep_overlap;
use super::measure::{Repair, fitting_tiles, is_outside, may_part, middle_radius};
use super::near::for_each_near;
use crate::scene::{Body, BodyList, Motion, NodeKey, Scene};

/// Troubles of one kind listed at most; the rest are counted. A list is for people.
const MOST_LISTED: usize = 200;

/// Pairs looked at until there are surely too many to tell apart: bodies at one place give n²/2.
const MOST_PAIRS: usize = 100_000;

/// Tiles in all: more cost seconds and gigabytes before the first step.
const MOST_TILES: f64 = 4e6;

/// Tiles that a ball of the middle size may lie in: each move registers it in all of them.
const MOST_TILES_OF_BALL: f64 = 256.0;

/// Balls in a tile, on average over tiles that hold any: each is compared with all others of its tile.
const MOST_BALLS_IN_TILE: usize = 16;

/// Below so many balls no tiling is slow.
const FEW_BALLS: usize = 100;

/// Mass ratio at which an impact loses a digit of six: (m₁ − m₂)/(m₁ + m₂) no longer tells the lighter mass.
const LARGEST_MASS_RATIO: f64 = 1e6;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TroubleKind {
    Overlap,
    Outside,
    Tiles,
    Masses,
}

/// One trouble, and what would put it right.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    pub kind: TroubleKind,
    /// What to select and frame; empty where it is about the map.
    pub keys: Vec<NodeKey>,
    pub message: String,
    pub hint: String,
    /// Where it is clear what to do.
    pub repair: Option<Repair>,
}

/// All troubles of a scene, by kind and then in file order.
pub fn troubles(scene: &Scene) -> Vec<Trouble> {
    let mut all = overlaps(scene);
    all.extend(outside(scene));
    all.extend(tiles(scene));
    all.extend(masses(scene));
    all
}

/// Pairs that overlap by more than a heap does, by their places among the bodies, with how deep, m.
pub(super) fn overlapping(scene: &Scene, bodies: &BodyList) -> Vec<(usize, usize, f64)> {
    let mut pairs = Vec::new();
    for_each_near(bodies, 0.0, |a, b| {
        if let Some(depth) = deep_overlap(scene, &bodies[a], &bodies[b]) {
            // The moving one first, then by UserID: as the simulation, its warnings and its events name them.
            let rank = |nth: usize| (!bodies[nth].is_dynamic(), bodies[nth].id, nth);
            pairs.push(if rank(a) <= rank(b) { (a, b, depth) } else { (b, a, depth) });
        }
        pairs.len() < MOST_PAIRS
    });
    pairs
}

fn overlaps(scene: &Scene) -> Vec<Trouble> {
    let bodies = &scene.bodies;
    let mut pairs = overlapping(scene, bodies);
    pairs.sort_by_key(|(a, b, _)| (*a, *b));
    let listed = pairs.iter().take(MOST_LISTED).map(|&(a, b, depth)| {
        let (a, b) = (&bodies[a], &bodies[b]);
        Trouble {
            kind: TroubleKind::Overlap,
            keys: vec![a.key, b.key],
            message: format!("{} and {} overlap by {} m", a.display_name(), b.display_name(), digits(depth)),
            hint: "they can part only by moving away from each other".into(),
            repair: may_part(a, b).then_some(Repair::PushApart(a.key, b.key)),
        }
    });
    with_rest(listed.collect(), pairs.len(), TroubleKind::Overlap, "pairs overlap", Repair::PushAllApart)
}

fn outside(scene: &Scene) -> Vec<Trouble> {
    let out: Vec<&Body> = scene.bodies.iter().filter(|body| is_outside(scene, body)).collect();
    let listed = out.iter().take(MOST_LISTED).map(|body| Trouble {
        kind: TroubleKind::Outside,
        keys: vec![body.key],
        message: format!("{} starts outside the map", body.display_name()),
        hint: "move it inside or enlarge the map; it is simulated all the same, more slowly".into(),
        repair: Some(Repair::GrowMap),
    });
    with_rest(
        listed.collect(),
        out.len(),
        TroubleKind::Outside,
        "bodies start outside the map",
        Repair::GrowMap,
    )
}

fn with_rest(
    mut listed: Vec<Trouble>,
    all: usize,
    kind: TroubleKind,
    what: &str,
    repair: Repair,
) -> Vec<Trouble> {
    if all > listed.len() {
        let (message, hint) = (format!("and {} more {what}", all - listed.len()), String::new());
        listed.push(Trouble { kind, keys: Vec::new(), message, hint, repair: Some(repair) });
    }
    listed
}

fn tiles(scene: &Scene) -> Option<Trouble> {
    let [x, y, z] = scene.map.tiles;
    let counts = DVec3::new(x.into(), y.into(), z.into());
    let (side, total) = (scene.map.size / counts, counts.element_product());
    let message = if total > MOST_TILES {
        format!("{x} × {y} × {z} tiles are {} million", (total / 1e6).round())
    } else if let Some(of_ball) = tiles_of_ball(scene, side).filter(|count| *count > MOST_TILES_OF_BALL) {
        format!("the tiles are fine: a ball of the middle size lies in {} of them", of_ball.round())
    } else if let Some(balls) = balls_in_tile(scene, side).filter(|count| *count > MOST_BALLS_IN_TILE) {
        format!("the tiles are coarse: those that hold balls hold {balls} each")
    } else {
        return None;
    };
    let fitting = fitting_tiles(scene);
    let [x, y, z] = fitting;
    (fitting != scene.map.tiles).then(|| Trouble {
        kind: TroubleKind::Tiles,
        keys: Vec::new(),
        message,
        hint: format!("{x} × {y} × {z} would fit; tiles change the speed, never the result"),
        repair: Some(Repair::FitTiles),
    })
}

/// Tiles that the box around a ball of the middle size meets.
fn tiles_of_ball(scene: &Scene, side: DVec3) -> Option<f64> {
    let diameter = 2.0 * middle_radius(scene)?;
    Some((DVec3::splat(diameter) / side + DVec3::ONE).element_product())
}

fn balls_in_tile(scene: &Scene, side: DVec3) -> Option<usize> {
    let mut counts = BTreeMap::<[i64; 3], usize>::new();
    let balls = scene.bodies.iter().filter(|body| body.is_dynamic());
    for body in balls {
        let tile = (body.position / side).to_array().map(|at| at.floor() as i64);
        *counts.entry(tile).or_default() += 1;
    }
    let all: usize = counts.values().sum();
    (all > FEW_BALLS).then(|| all / counts.len().max(1))
}

fn masses(scene: &Scene) -> Option<Trouble> {
    let mass = |body: &Body| match body.motion {
        Motion::Dynamic { mass, .. } => Some(mass),
        Motion::Static => None,
    };
    let with_mass = || scene.bodies.iter().filter_map(|body| Some((body, mass(body)?)));
    let (light, least) = with_mass().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (heavy, most) = with_mass().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (most > LARGEST_MASS_RATIO * least).then(|| Trouble {
        kind: TroubleKind::Masses,
        keys: vec![light.key, heavy.key],
        message: format!(
            "{} has {} times the mass of {}",
            heavy.display_name(),
            digits(most / least),
            light.display_name()
        ),
        hint: "where they meet, the lighter one costs digits; a static body is exact".into(),
        repair: None,
    })
}

/// Three significant digits, without an exponent where a person would write none.
pub(super) fn digits(value: f64) -> String {
    if !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let decimals = (2.0 - libm::floor(libm::log10(value.abs()))).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
