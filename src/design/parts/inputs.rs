//! What several parts ask for.

use glam::DVec3;

use crate::design::place::{of_map, stand};
use crate::design::plan::Given;
use crate::design::tool::{Input, Kind, Values};

/// Any length above 0, m.
pub const LENGTH: Kind = Kind::Number(1e-9, 1e9);
pub const ANYWHERE: Kind = Kind::Number(-1e9, 1e9);

pub const PLACE_X: Input = Input {
    label: "Place x",
    unit: "m",
    help: "Middle of the part",
    kind: ANYWHERE,
    default: |given| stand(given).x,
};
pub const PLACE_Y: Input = Input {
    label: "Place y",
    unit: "m",
    help: "Where it stands: the floor below the middle of the map, if there is one",
    kind: ANYWHERE,
    default: |given| stand(given).y,
};
pub const PLACE_Z: Input = Input {
    label: "Place z",
    unit: "m",
    help: "Middle of the part",
    kind: ANYWHERE,
    default: |given| stand(given).z,
};

pub const BALL_RADIUS: Input = Input {
    label: "Ball radius",
    unit: "m",
    help: "Of each ball",
    kind: LENGTH,
    default: |given| of_map(given, 0.02),
};
pub const BALL_MASS: Input =
    Input { label: "Ball mass", unit: "kg", help: "Of each ball", kind: LENGTH, default: |_| 1.0 };
pub const BALL_BOUNCE: Input = Input {
    label: "Ball bounce",
    unit: "",
    help: "1 loses nothing, 0 does not bounce; a pair uses the product of both",
    kind: Kind::Number(0.0, 1.0),
    default: |_| 1.0,
};
pub const WALL_BOUNCE: Input = Input {
    label: "Bounce",
    unit: "",
    help: "1 loses nothing, 0 does not bounce; a pair uses the product of both",
    kind: Kind::Number(0.0, 1.0),
    default: |_| 1.0,
};

pub const FRICTION: Input = Input {
    label: "Friction",
    unit: "",
    help: "Coefficient of friction; a pair uses the geometric mean of both, so against balls with 0 nothing rubs. Above 0 \
           makes the file Version 1.1",
    kind: Kind::Number(0.0, 1e3),
    default: |_| 0.0,
};

pub fn place(values: &Values<'_>) -> DVec3 {
    values.vector(["Place x", "Place y", "Place z"])
}

/// Parts can be added wherever there is a scene.
pub fn always(_: &Given<'_>) -> Result<(), &'static str> {
    Ok(())
}

/// Above the floor by a share of the map.
pub fn raised(given: &Given<'_>, share: f64) -> f64 {
    stand(given).y + of_map(given, share)
}
