//! Ways down: a ramp, stairs, a funnel.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::inputs::{FRICTION, LENGTH, PLACE_X, PLACE_Y, PLACE_Z, WALL_BOUNCE, always, place};
use crate::design::builder::{Builder, Plate};
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};

pub const RAMP: Tool = Tool {
    id: "ramp",
    label: "Ramp…",
    group: ToolGroup::Part,
    help: "Adds a plate that rises along x: say its length and angle, or its run and rise; each follows the others",
    inputs: &[
        Input {
            label: "Length",
            unit: "m",
            help: "Along the slope",
            kind: LENGTH,
            default: |given| {
                let (run, rise) = (of_map(given, RUN), of_map(given, RISE));
                libm::hypot(run, rise)
            },
        },
        Input {
            label: "Angle",
            unit: "°",
            help: "Of the slope to the level",
            kind: Kind::Number(0.01, 89.99),
            default: |given| libm::atan2(of_map(given, RISE), of_map(given, RUN)).to_degrees(),
        },
        Input {
            label: "Run x",
            unit: "m",
            help: "Along the floor",
            kind: LENGTH,
            default: |given| of_map(given, RUN),
        },
        Input {
            label: "Rise y",
            unit: "m",
            help: "Height gained",
            kind: LENGTH,
            default: |given| of_map(given, RISE),
        },
        Input {
            label: "Width z",
            unit: "m",
            help: "Side to side",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        WALL_BOUNCE,
        FRICTION,
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: Some(follow_slope),
    enabled: always,
    plan: |given, values| {
        let along = DVec3::new(values.number("Run x"), values.number("Rise y"), 0.0);
        let mut builder = Builder::single(given).rubbing(values.number("Friction"));
        builder.plate(
            "ramp",
            &Plate {
                middle: place(values) + DVec3::Y * (along.y / 2.0),
                normal: DVec3::new(-along.y, along.x, 0.0),
                across: along,
                half: [along.length() / 2.0, values.number("Width z") / 2.0],
                bounce: values.number("Bounce"),
            },
        );
        Ok(builder.finish("Add a ramp"))
    },
};

/// Of the map's smallest side.
const RUN: f64 = 0.4;
const RISE: f64 = 0.2;

/// Length and angle, or run and rise, whichever was changed, say what the others are. They are the first four inputs.
fn follow_slope(values: &mut [f64], changed: usize) {
    let [length, angle, run, rise, ..] = values else { return };
    match changed {
        0 | 1 => {
            let (sine, cosine) = libm::sincos(angle.to_radians());
            (*run, *rise) = (*length * cosine, *length * sine);
        }
        2 | 3 => {
            (*length, *angle) = (libm::hypot(*run, *rise), libm::atan2(*rise, *run).to_degrees());
        }
        _ => {}
    }
}

pub const STAIRS: Tool = Tool {
    id: "stairs",
    label: "Stairs…",
    group: ToolGroup::Part,
    help: "Adds steps that rise along x, each of a tread and a riser",
    inputs: &[
        Input {
            label: "Steps",
            unit: "",
            help: "How many",
            kind: Kind::Whole(1.0, 10_000.0),
            default: |_| 5.0,
        },
        Input {
            label: "Tread x",
            unit: "m",
            help: "Depth of a step",
            kind: LENGTH,
            default: |given| of_map(given, 0.1),
        },
        Input {
            label: "Riser y",
            unit: "m",
            help: "Height of a step",
            kind: LENGTH,
            default: |given| of_map(given, 0.05),
        },
        Input {
            label: "Width z",
            unit: "m",
            help: "Side to side",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        WALL_BOUNCE,
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let steps = values.count("Steps");
        let [tread, riser, width] = ["Tread x", "Riser y", "Width z"].map(|label| values.number(label));
        let bounce = values.number("Bounce");
        let start = place(values) - DVec3::X * (tread * steps as f64 / 2.0);
        let mut builder = Builder::part(given, "stairs");
        for nth in 0..steps {
            let corner = start + DVec3::new(tread, riser, 0.0) * nth as f64;
            builder.plate(
                "riser",
                &Plate {
                    middle: corner + DVec3::Y * (riser / 2.0),
                    normal: DVec3::NEG_X,
                    across: DVec3::Z,
                    half: [width / 2.0, riser / 2.0],
                    bounce,
                },
            );
            builder.plate(
                "tread",
                &Plate {
                    middle: corner + DVec3::new(tread / 2.0, riser, 0.0),
                    normal: DVec3::Y,
                    across: DVec3::X,
                    half: [tread / 2.0, width / 2.0],
                    bounce,
                },
            );
        }
        Ok(builder.finish("Add stairs"))
    },
};

pub const FUNNEL: Tool = Tool {
    id: "funnel",
    label: "Funnel…",
    group: ToolGroup::Part,
    help: "Adds plates around a vertical axis that lead to a hole at the bottom",
    inputs: &[
        Input {
            label: "Sides",
            unit: "",
            help: "How many plates",
            kind: Kind::Whole(3.0, 360.0),
            default: |_| 12.0,
        },
        Input {
            label: "Top radius",
            unit: "m",
            help: "To the middle of a side",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        Input {
            label: "Hole radius",
            unit: "m",
            help: "To the middle of a side",
            kind: LENGTH,
            default: |given| of_map(given, 0.04),
        },
        Input {
            label: "Height y",
            unit: "m",
            help: "From the hole to the top",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        WALL_BOUNCE,
        PLACE_X,
        Input { help: "Height of the hole", default: |given| super::inputs::raised(given, 0.2), ..PLACE_Y },
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let [top, hole, height] = ["Top radius", "Hole radius", "Height y"].map(|label| values.number(label));
        if top <= hole {
            return Err("The top must be wider than the hole".into());
        }
        let sides = values.count("Sides").max(3);
        let foot = place(values);
        let mut builder = Builder::part(given, "funnel");
        for nth in 0..sides {
            let angle = TAU * nth as f64 / sides as f64;
            let out = DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
            let across = DVec3::new(-out.z, 0.0, out.x);
            let slope = out * (top - hole) + DVec3::Y * height;
            // As wide as the top: lower down a plate reaches behind its neighbours, outside of the funnel.
            builder.plate(
                "funnel side",
                &Plate {
                    middle: foot + out * ((top + hole) / 2.0) + DVec3::Y * (height / 2.0),
                    normal: DVec3::Y * (top - hole) - out * height,
                    across,
                    half: [top * libm::tan(PI / sides as f64), slope.length() / 2.0],
                    bounce: values.number("Bounce"),
                },
            );
        }
        Ok(builder.finish("Add a funnel"))
    },
};
