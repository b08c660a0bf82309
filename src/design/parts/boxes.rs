//! Rooms and boxes: closed, open at the top, and filled with balls.

use glam::DVec3;

use super::inputs::{
    BALL_BOUNCE, BALL_MASS, BALL_RADIUS, FRICTION, LENGTH, PLACE_X, PLACE_Y, PLACE_Z, WALL_BOUNCE, always,
    place,
};
use crate::design::builder::{Ball, Builder, Plate};
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::random::Random;

/// Room between the balls of a container and around them, as a share of their diameter: they must not touch before
/// they fall, nor stand in columns then.
const SPACING: f64 = 1.15;

/// Height of a container's walls over that of its balls.
const HEADROOM: f64 = 1.25;

pub const ROOM: Tool = Tool {
    id: "room",
    label: "Room…",
    group: ToolGroup::Part,
    help: "Adds six walls around the middle of the map: a closed room, as large as the map unless you say otherwise",
    inputs: &[
        Input {
            label: "Width x",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| given.scene.map.size.x,
        },
        Input {
            label: "Height y",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| given.scene.map.size.y,
        },
        Input {
            label: "Depth z",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| given.scene.map.size.z,
        },
        WALL_BOUNCE,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let size = values.vector(["Width x", "Height y", "Depth z"]);
        let mut builder = Builder::part(given, "room");
        let middle = given.scene.map.size / 2.0;
        walls(&mut builder, middle, size, values.number("Bounce"), true);
        Ok(builder.finish("Add a room"))
    },
};

pub const OPEN_BOX: Tool = Tool {
    id: "open_box",
    label: "Open box…",
    group: ToolGroup::Part,
    help: "Adds a floor and four walls",
    inputs: &[
        Input {
            label: "Width x",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| of_map(given, 0.4),
        },
        Input {
            label: "Height y",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        Input {
            label: "Depth z",
            unit: "m",
            help: "Inside",
            kind: LENGTH,
            default: |given| of_map(given, 0.4),
        },
        WALL_BOUNCE,
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let size = values.vector(["Width x", "Height y", "Depth z"]);
        let middle = place(values) + DVec3::Y * (size.y / 2.0);
        let mut builder = Builder::part(given, "box");
        walls(&mut builder, middle, size, values.number("Bounce"), false);
        Ok(builder.finish("Add an open box"))
    },
};

pub const BLOCK: Tool = Tool {
    id: "block",
    label: "Block…",
    group: ToolGroup::Part,
    help: "Adds a static block: six plates whose outer faces bound it",
    inputs: &[
        Input {
            label: "Width x",
            unit: "m",
            help: "Outside",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        Input {
            label: "Height y",
            unit: "m",
            help: "Outside",
            kind: LENGTH,
            default: |given| of_map(given, 0.1),
        },
        Input {
            label: "Depth z",
            unit: "m",
            help: "Outside",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        WALL_BOUNCE,
        FRICTION,
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let size = values.vector(["Width x", "Height y", "Depth z"]);
        let middle = place(values) + DVec3::Y * (size.y / 2.0);
        let mut builder = Builder::part(given, "block").rubbing(values.number("Friction"));
        let bounce = values.number("Bounce");
        let faces = [
            ("top", DVec3::Y, DVec3::X),
            ("bottom", DVec3::NEG_Y, DVec3::X),
            ("side left", DVec3::NEG_X, DVec3::Z),
            ("side right", DVec3::X, DVec3::Z),
            ("side back", DVec3::NEG_Z, DVec3::X),
            ("side front", DVec3::Z, DVec3::X),
        ];
        for (name, normal, across) in faces {
            let half = [across, normal.cross(across)].map(|side| side.abs().dot(size) / 2.0);
            builder
                .plate(name, &Plate { middle: middle + normal * size / 2.0, normal, across, half, bounce });
        }
        Ok(builder.finish("Add a block"))
    },
};

pub const CONTAINER: Tool = Tool {
    id: "container",
    label: "Container of balls…",
    group: ToolGroup::Part,
    help: "Adds an open box with balls in layers, a little apart and a little out of line, so that they fall into a heap",
    inputs: &[
        Input {
            label: "Balls",
            unit: "",
            help: "How many",
            kind: Kind::Whole(1.0, 100_000.0),
            default: |_| 64.0,
        },
        Input {
            label: "Balls in a row",
            unit: "",
            help: "Along each side of a layer",
            kind: Kind::Whole(1.0, 1000.0),
            default: |_| 4.0,
        },
        BALL_RADIUS,
        BALL_MASS,
        Input { default: |_| 0.5, ..BALL_BOUNCE },
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let (count, row) = (values.count("Balls"), values.count("Balls in a row").max(1));
        let radius = values.number("Ball radius");
        let pitch = 2.0 * radius * SPACING;
        let layers = count.div_ceil(row * row);
        let size = DVec3::new(row as f64, layers as f64 * HEADROOM, row as f64) * pitch;
        let foot = place(values);
        let mut builder = Builder::part(given, "container");
        walls(&mut builder, foot + DVec3::Y * (size.y / 2.0), size, 1.0, false);
        let corner = foot - DVec3::new(size.x, 0.0, size.z) / 2.0 + DVec3::splat(pitch / 2.0);
        // Balls exactly above each other would stay so: each is somewhere in its cell.
        let mut random = Random::new(1);
        for nth in 0..count {
            let aside = random.vector(0.9 * (pitch / 2.0 - radius));
            let cell = [nth % row, nth / (row * row), nth / row % row].map(|at| at as f64);
            builder.ball(
                "ball",
                &Ball {
                    at: corner + DVec3::from_array(cell) * pitch + aside,
                    radius,
                    mass: values.number("Ball mass"),
                    velocity: DVec3::ZERO,
                    bounce: values.number("Ball bounce"),
                },
            );
        }
        Ok(builder.finish("Add a container of balls"))
    },
};

/// Four walls and a floor, and a ceiling if it is closed; their inner faces bound a box of this size.
fn walls(builder: &mut Builder, middle: DVec3, size: DVec3, bounce: f64, closed: bool) {
    let half = size / 2.0;
    let sides = [
        ("floor", DVec3::Y, DVec3::X, [half.x, half.z]),
        ("ceiling", DVec3::NEG_Y, DVec3::X, [half.x, half.z]),
        ("wall left", DVec3::X, DVec3::Z, [half.z, half.y]),
        ("wall right", DVec3::NEG_X, DVec3::Z, [half.z, half.y]),
        ("wall back", DVec3::Z, DVec3::X, [half.x, half.y]),
        ("wall front", DVec3::NEG_Z, DVec3::X, [half.x, half.y]),
    ];
    for (name, normal, across, half_sides) in sides.into_iter().filter(|side| closed || side.0 != "ceiling") {
        // Each looks inwards from its place.
        builder
            .plate(name, &Plate { middle: middle - normal * half, normal, across, half: half_sides, bounce });
    }
}
