//! Scenes that the tests of views and pictures share, from the plain types.

use glam::{DVec3, dvec3};
use polyscene::record::{BodyFrame, ContactFrame, EventRow, Frame};
use polyscene::scene::{Body, BodyList, Force, ForceKind, Map, Motion, NodeKey, Scene, Shape, SimParams};
use polyscene::sim::{BodyRef, ContactState, Event, EventKind, Tiling};
use std::sync::Arc;

pub fn empty() -> Scene {
    Scene {
        map: Map { size: DVec3::splat(10.0), tiles: [10; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: Vec::new(),
        bodies: BodyList::new(),
    }
}

pub fn body(key: u64, position: DVec3, motion: Motion, shape: Shape) -> Body {
    Body::new(key as i64, position, motion, shape)
}

pub fn ball(key: u64, position: DVec3, radius: f64) -> Body {
    body(key, position, Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO }, Shape::Sphere { radius })
}

pub fn plate(key: u64, position: DVec3, rotation: DVec3, half: [f64; 2]) -> Body {
    let shape = Shape::Plane { half_x: half[0], half_y: half[1] };
    Body { rotation, ..body(key, position, Motion::Static, shape) }
}

/// Six walls with half sides 5 around the map, normals inwards; keys 1 to 6.
#[allow(clippy::approx_constant, reason = "rotations with the digits that files have")]
pub fn closed_box() -> Scene {
    const HALF_PI: f64 = 1.570796;
    let walls = [
        (dvec3(10.0, 5.0, 5.0), dvec3(0.0, -HALF_PI, 0.0)),
        (dvec3(0.0, 5.0, 5.0), dvec3(0.0, HALF_PI, 0.0)),
        (dvec3(5.0, 5.0, 10.0), dvec3(3.14159, 0.0, 0.0)),
        (dvec3(5.0, 0.0, 5.0), dvec3(-HALF_PI, 0.0, 0.0)),
        (dvec3(5.0, 5.0, 0.0), DVec3::ZERO),
        (dvec3(5.0, 10.0, 5.0), dvec3(HALF_PI, 0.0, 3.141593)),
    ];
    let mut scene = empty();
    for (i, (position, rotation)) in walls.into_iter().enumerate() {
        scene.bodies.push(plate(i as u64 + 1, position, rotation, [5.0, 5.0]));
    }
    scene
}

/// The closed box with four plates and three balls in it, as the thesis's own scene has them.
pub fn furnished_box() -> Scene {
    let mut scene = closed_box();
    scene.bodies.extend([
        plate(11, dvec3(5.0, 4.0, 3.0), dvec3(0.0, 0.5, 0.0), [1.0, 1.0]),
        plate(12, dvec3(5.0, 5.0, 8.0), dvec3(0.2, 0.0, 0.5), [1.0, 1.0]),
        plate(13, dvec3(7.0, 3.0, 5.0), dvec3(0.9, 1.0, 0.3), [2.0, 1.0]),
        plate(14, dvec3(2.0, 7.0, 5.0), dvec3(1.5, 1.0, 1.0), [1.0, 1.5]),
        ball(21, dvec3(5.0, 3.0, 6.0), 1.0),
        ball(22, dvec3(2.0, 2.0, 1.0), 0.5),
        ball(23, dvec3(8.0, 8.0, 8.0), 0.7),
    ]);
    scene.forces = vec![
        Force::new(
            31,
            ForceKind::GravityPlane { position: dvec3(6.0, 0.0, 3.0), acceleration: dvec3(0.0, -3.0, 0.0) },
        ),
        Force::new(32, ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity: 8.0 }),
    ];
    scene
}

pub fn pressed(keys: [u64; 2], ends: [DVec3; 2], force: f64) -> ContactFrame {
    ContactFrame { keys: keys.map(NodeKey), ends, force }
}

/// A frame with the furnished box's balls moved on, one impact, and a few tiles.
pub fn frame() -> Frame {
    let now = |key, position, velocity: DVec3, contact| BodyFrame {
        turn: None,
        key: NodeKey(key),
        position,
        velocity,
        acceleration: DVec3::ZERO,
        force: dvec3(0.0, -3.0, 0.0),
        kinetic: 0.5 * velocity.length_squared(),
        contact,
    };
    let event = Event {
        seq: 7,
        time: 0.4,
        kind: EventKind::Impact,
        a: BodyRef::Dynamic(0),
        b: Some(BodyRef::Static(3)),
        point: dvec3(4.0, 0.0, 6.0),
        normal: dvec3(0.0, -1.0, 0.0),
        impulse: 4.0,
        vn_before: -2.0,
        vn_after: 2.0,
        group: 5,
        row_in_group: [1; 2],
        bodies: 2,
        gap: 0.0,
        rounds: 0,
    };
    let row = EventRow {
        event,
        a_key: NodeKey(21),
        b_key: Some(NodeKey(4)),
        a_label: "21".into(),
        b_label: "4".into(),
    };
    Frame {
        revision: 9,
        time: 0.5,
        bodies: vec![
            now(21, dvec3(4.0, 1.5, 6.0), dvec3(-3.0, 2.0, -4.0), ContactState::Flight),
            now(22, dvec3(2.0, 0.5, 1.0), DVec3::ZERO, ContactState::Rest),
            now(23, dvec3(8.0, 0.7, 8.0), dvec3(2.0, 0.0, 0.0), ContactState::Slide),
        ],
        events: vec![Arc::new(row)],
        contacts: vec![
            pressed([22, 5], [dvec3(2.0, 0.5, 1.0), dvec3(2.0, 0.0, 1.0)], 9.0),
            pressed([23, 22], [dvec3(8.0, 0.7, 8.0), dvec3(2.0, 0.5, 1.0)], 1.0),
        ],
        tiling: Arc::new(Tiling {
            tile_size: DVec3::ONE,
            tiles: [10; 3],
            occupied: vec![([2, 0, 1], 1, 1), ([4, 1, 6], 0, 1), ([5, 4, 3], 1, 0)],
            truncated: false,
        }),
        ..Frame::default()
    }
}
