//! A board of pegs between two panes, as Galton's.

use glam::DVec3;

use super::inputs::{BALL_RADIUS, LENGTH, PLACE_X, PLACE_Y, PLACE_Z, always, place};
use crate::design::builder::{Ball, Builder, Plate};
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};

/// Distance of the panes over the diameter of a ball.
const PLAY: f64 = 1.1;

pub const PEGBOARD: Tool = Tool {
    id: "pegboard",
    label: "Pegboard…",
    group: ToolGroup::Part,
    help: "Adds rows of pegs, every other one shifted by half, between two panes, sides and a floor; the front pane is hidden",
    inputs: &[
        Input { label: "Rows", unit: "", help: "Of pegs", kind: Kind::Whole(1.0, 500.0), default: |_| 8.0 },
        Input {
            label: "Pegs in a row",
            unit: "",
            help: "In the longer rows",
            kind: Kind::Whole(1.0, 500.0),
            default: |_| 9.0,
        },
        Input {
            label: "Spacing",
            unit: "m",
            help: "From peg to peg",
            kind: LENGTH,
            default: |given| of_map(given, 0.06),
        },
        Input {
            label: "Peg radius",
            unit: "m",
            help: "Of each peg",
            kind: LENGTH,
            default: |given| of_map(given, 0.01),
        },
        Input {
            help: "The panes leave room for balls of this size",
            default: |given| of_map(given, 0.01),
            ..BALL_RADIUS
        },
        PLACE_X,
        PLACE_Y,
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let (rows, columns) = (values.count("Rows"), values.count("Pegs in a row"));
        let [spacing, peg, radius] =
            ["Spacing", "Peg radius", "Ball radius"].map(|label| values.number(label));
        if spacing <= 2.0 * (peg + radius) {
            return Err("No ball falls between pegs that near: give them more spacing".into());
        }
        // Rows of equilateral triangles, with room for the balls below and above.
        let rise = spacing * libm::sqrt(3.0) / 2.0;
        let half =
            DVec3::new(spacing * columns as f64 / 2.0, (rise * (rows + 3) as f64) / 2.0, radius * PLAY);
        let foot = place(values);
        let middle = foot + DVec3::Y * half.y;
        let mut builder = Builder::part(given, "pegboard");
        for (name, normal, across, sides) in [
            ("pane back", DVec3::Z, DVec3::X, [half.x, half.y]),
            ("pane front", DVec3::NEG_Z, DVec3::X, [half.x, half.y]),
            ("side left", DVec3::X, DVec3::Z, [half.z, half.y]),
            ("side right", DVec3::NEG_X, DVec3::Z, [half.z, half.y]),
            ("floor", DVec3::Y, DVec3::X, [half.x, half.z]),
        ] {
            let plate = Plate { middle: middle - normal * half, normal, across, half: sides, bounce: 0.5 };
            builder.plate(name, &plate);
            if name == "pane front" {
                builder.hide_last();
            }
        }
        for row in 0..rows {
            let in_row = columns - row % 2 * usize::from(columns > 1);
            for nth in 0..in_row {
                let x = spacing * (nth as f64 - (in_row - 1) as f64 / 2.0);
                let at = foot + DVec3::new(x, rise * (row + 2) as f64, 0.0);
                builder.ball("peg", &Ball { at, radius: peg, mass: 0.0, velocity: DVec3::ZERO, bounce: 0.5 });
            }
        }
        Ok(builder.finish("Add a pegboard"))
    },
};
