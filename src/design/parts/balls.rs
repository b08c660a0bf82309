//! Balls that touch: a rack, a row, a pyramid. Neighbours touch to the rounding of their places, so that an impact
//! meets them as one group.

use glam::DVec3;

use super::inputs::{BALL_BOUNCE, BALL_MASS, BALL_RADIUS, LENGTH, PLACE_X, PLACE_Y, PLACE_Z, always, place};
use crate::design::builder::{Ball, Builder};
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup, Values};

/// Radii from the tip of a rack to the cue ball.
const CUE_DISTANCE: f64 = 8.0;

pub const RACK: Tool = Tool {
    id: "rack",
    label: "Rack of balls…",
    group: ToolGroup::Part,
    help: "Adds a triangle of balls that touch, its tip towards −x, as in billiards",
    inputs: &[
        Input {
            label: "Rows",
            unit: "",
            help: "5 rows are 15 balls",
            kind: Kind::Whole(1.0, 200.0),
            default: |_| 5.0,
        },
        BALL_RADIUS,
        BALL_MASS,
        BALL_BOUNCE,
        Input {
            label: "Cue ball",
            unit: "",
            help: "One more ball before the tip, to be given a velocity",
            kind: Kind::Flag,
            default: |_| 0.0,
        },
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let (rows, radius) = (values.count("Rows"), values.number("Ball radius"));
        let pitch = radius * libm::sqrt(3.0);
        let tip = place(values) + DVec3::new(-pitch * rows.saturating_sub(1) as f64 / 2.0, radius, 0.0);
        let mut builder = Builder::part(given, "rack");
        for row in 0..rows {
            for nth in 0..=row {
                let across = 2.0 * nth as f64 - row as f64;
                let at = tip + DVec3::new(pitch * row as f64, 0.0, radius * across);
                builder.ball("ball", &ball(values, at, DVec3::ZERO));
            }
        }
        if values.is_on("Cue ball") {
            let far = DVec3::X * (radius * CUE_DISTANCE);
            builder.ball_alone("cue ball", &ball(values, tip - far, DVec3::ZERO));
        }
        Ok(builder.finish("Add a rack"))
    },
};

pub const CRADLE: Tool = Tool {
    id: "cradle",
    label: "Cradle…",
    group: ToolGroup::Part,
    help: "Adds a row of balls that touch, and one that runs into them along x, as in Newton's cradle",
    inputs: &[
        Input {
            label: "Balls",
            unit: "",
            help: "In the row, with the one that moves",
            kind: Kind::Whole(2.0, 10_000.0),
            default: |_| 5.0,
        },
        BALL_RADIUS,
        BALL_MASS,
        BALL_BOUNCE,
        Input {
            label: "Run-up",
            unit: "m",
            help: "Gap before the first impact",
            kind: LENGTH,
            default: |given| of_map(given, 0.1),
        },
        Input {
            label: "Speed",
            unit: "m/s",
            help: "Of the ball that moves",
            kind: Kind::Number(0.0, 1e9),
            default: |_| 1.0,
        },
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let (count, radius) = (values.count("Balls"), values.number("Ball radius"));
        let first = place(values) + DVec3::new(-radius * count.saturating_sub(1) as f64, radius, 0.0);
        let mut builder = Builder::part(given, "cradle");
        let runner = first - DVec3::X * values.number("Run-up");
        builder.ball("runner", &ball(values, runner, DVec3::X * values.number("Speed")));
        for nth in 1..count {
            builder.ball("ball", &ball(values, first + DVec3::X * (2.0 * radius * nth as f64), DVec3::ZERO));
        }
        Ok(builder.finish("Add a cradle"))
    },
};

pub const PYRAMID: Tool = Tool {
    id: "pyramid",
    label: "Pyramid of balls…",
    group: ToolGroup::Part,
    help: "Adds square layers of balls that touch, each a ball narrower than the one below",
    inputs: &[
        Input {
            label: "Layers",
            unit: "",
            help: "4 layers are 30 balls",
            kind: Kind::Whole(1.0, 60.0),
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
        let (layers, radius) = (values.count("Layers"), values.number("Ball radius"));
        let foot = place(values) + DVec3::Y * radius;
        let mut builder = Builder::part(given, "pyramid");
        for layer in 0..layers {
            let side = layers - layer;
            // A ball on four that touch in a square lies √2 of a radius above them.
            let height = DVec3::Y * (libm::sqrt(2.0) * radius * layer as f64);
            for nth in 0..side * side {
                let cell = [nth % side, nth / side].map(|at| 2.0 * at as f64 - (side - 1) as f64);
                let at = foot + height + DVec3::new(cell[0], 0.0, cell[1]) * radius;
                builder.ball("ball", &ball(values, at, DVec3::ZERO));
            }
        }
        Ok(builder.finish("Add a pyramid"))
    },
};

fn ball(values: &Values<'_>, at: DVec3, velocity: DVec3) -> Ball {
    let [radius, mass, bounce] =
        ["Ball radius", "Ball mass", "Ball bounce"].map(|label| values.number(label));
    Ball { at, radius, mass, velocity, bounce }
}
