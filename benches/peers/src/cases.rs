//! The scenes that are measured, and with which engines: a row each.

use std::ops::Range;
use std::path::Path;

use glam::DVec3;
use polyscene::scene::{Body, Document, Force, ForceKind, Map, Motion, Roughness, Scene, Shape, SimParams};

use crate::engines::Engine;
use crate::peer::{Precision, RATES, SETTINGS, Walls};
use crate::reference::Reference;
use crate::scenes::{gas, pile};

pub struct Case {
    pub name: &'static str,
    pub scene: Scene,
    /// Model time that is simulated, s.
    pub until: f64,
    pub reference: Reference,
    /// How many times less time than rapier3d at 1/240 s PolyScene must need; `None` where nothing is promised.
    pub promised: Option<f64>,
    /// Besides PolyScene.
    pub peers: Vec<Engine>,
    /// Timings, of which the median counts.
    pub repeats: usize,
    /// Processor time after which PolyScene gives up, s.
    pub patience: f64,
}

/// A scene file under `scenes/` and what is asked of it.
struct Row(&'static str, &'static str, f64, Reference);

#[rustfmt::skip]
const FILES: [Row; 6] = [
    Row("ballistic", "hard/throw.xml", 10.0, Reference::Throw),
    Row("bounce", "bounce.xml", 20.0, Reference::Bounce),
    Row("cradle", "cradle.xml", 20.0, Reference::Row),
    Row("cradle, 3 balls", "hard/cradle-3.xml", 20.0, Reference::Row),
    Row("kepler e=0.6", "orbit.xml", 80.0, Reference::Kepler),
    Row("counting pi", "counting-pi.xml", 8.0, Reference::Pi),
];

/// Longer than any run takes that gets anywhere, s.
const PATIENCE: f64 = 60.0;

pub fn all() -> Result<Vec<Case>, String> {
    let mut cases = files()?;
    cases.extend(rolling());
    cases.extend(gases());
    cases.extend(piles());
    Ok(cases)
}

fn files() -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for Row(name, file, until, reference) in FILES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(file);
        let document = Document::open(&path);
        let scene = document.scene().cloned().ok_or_else(|| format!("{} does not load", path.display()))?;
        let mut peers = boxes(&RATES, 0..SETTINGS.len());
        peers.extend(half_spaces(&RATES, 0..SETTINGS.len()));
        let promised = Some(10.0);
        cases.push(Case { name, scene, until, reference, promised, peers, repeats: 7, patience: PATIENCE });
    }
    Ok(cases)
}

/// A ball of 10 cm that slides at first and then rolls, or rolls from the start: on the level and on a slope of 20°.
fn rolling() -> Vec<Case> {
    let rows = [
        ("friction, level, 1 m/s", 0.0, 1.0),
        ("friction, incline, 1 m/s", 20.0, 1.0),
        ("friction, incline, from rest", 20.0, 0.0),
    ];
    let case = |(name, degrees, speed): (&'static str, f64, f64)| {
        let scene = ball_on_slope(degrees.to_radians(), speed);
        let peers = boxes(&RATES, 0..SETTINGS.len());
        let reference = Reference::Roll;
        Case { name, scene, until: 3.0, reference, promised: None, peers, repeats: 3, patience: PATIENCE }
    };
    rows.into_iter().map(case).collect()
}

/// Downhill is along x; the friction of the pair is 0.3.
fn ball_on_slope(angle: f64, speed: f64) -> Scene {
    let (half, radius) = (30.0, 0.1);
    let map = Map { size: DVec3::new(2.0 * half, half, half), tiles: [6, 3, 3] };
    let (sin, cos) = libm::sincos(angle);
    let (normal, downhill) = (DVec3::new(sin, cos, 0.0), DVec3::new(cos, -sin, 0.0));
    let middle = 0.5 * map.size;
    let roughness = Roughness { friction: 0.3, ..Roughness::default() };
    let plate = Shape::Plane { half_x: 0.9 * half, half_y: 0.4 * half };
    let slope = Body {
        rotation: DVec3::new(-std::f64::consts::FRAC_PI_2, angle, 0.0),
        bounce: 0.0,
        roughness,
        ..Body::new(1, middle, Motion::Static, plate)
    };
    let motion = Motion::Dynamic { mass: 1.0, velocity: speed * downhill };
    let start = middle - 8.0 * downhill + radius * normal;
    let ball = Body { bounce: 0.0, roughness, ..Body::new(2, start, motion, Shape::Sphere { radius }) };
    let acceleration = DVec3::new(0.0, -9.81, 0.0);
    let gravity = Force::new(1, ForceKind::GravityPlane { position: middle, acceleration });
    Scene {
        map,
        time_speed: 1.0,
        params: SimParams::default(),
        forces: vec![gravity],
        bodies: [slope, ball].into(),
    }
}

fn gases() -> Vec<Case> {
    let rows = [
        ("gas 1000, 0.1", 1000, 0.1),
        ("gas 1000, 0.3", 1000, 0.3),
        ("gas 10000, 0.1", 10_000, 0.1),
        ("gas 10000, 0.3", 10_000, 0.3),
    ];
    let case = |(name, count, packing)| {
        let mut peers = boxes(&RATES[..2], 0..SETTINGS.len());
        // What half-spaces cost, once.
        peers.extend(half_spaces(&RATES[..1], 1..2));
        let scene = gas(count, packing);
        let reference = Reference::None;
        Case { name, scene, until: 2.0, reference, promised: None, peers, repeats: 3, patience: PATIENCE }
    };
    rows.into_iter().map(case).collect()
}

/// Dropped into a box, until they lie.
fn piles() -> Vec<Case> {
    let rows = [
        ("pile 27", 27, &RATES[..2], 0..3),
        ("pile 1000", 1000, &RATES[..2], 1..3),
        ("pile 5000", 5000, &RATES[..1], 1..2),
    ];
    let case = |(name, count, rates, settings)| Case {
        name,
        scene: pile(count, 0.2),
        until: 4.0,
        reference: Reference::Pile,
        promised: None,
        peers: boxes(rates, settings),
        repeats: 1,
        patience: 20.0,
    };
    rows.into_iter().map(case).collect()
}

/// With plates as boxes, in both precisions.
fn boxes(rates: &[f64], settings: Range<usize>) -> Vec<Engine> {
    let mut engines = combined(rates, settings.clone(), Walls::Boxes, Precision::Single);
    engines.extend(combined(rates, settings, Walls::Boxes, Precision::Double));
    engines
}

/// With plates as half-spaces.
fn half_spaces(rates: &[f64], settings: Range<usize>) -> Vec<Engine> {
    combined(rates, settings, Walls::HalfSpaces, Precision::Single)
}

fn combined(rates: &[f64], settings: Range<usize>, walls: Walls, precision: Precision) -> Vec<Engine> {
    let mut engines = Vec::new();
    for rate in rates {
        for settings in &SETTINGS[settings.clone()] {
            engines.push(Engine::Rapier { dt: 1.0 / rate, settings, walls, precision });
        }
    }
    engines
}
