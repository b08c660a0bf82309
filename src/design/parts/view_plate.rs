//! A plate that faces the view.

use super::inputs::{LENGTH, WALL_BOUNCE, always};
use crate::design::builder::{Builder, Plate};
use crate::design::place::of_map;
use crate::design::tool::{Input, Tool, ToolGroup};

pub const VIEW_PLATE: Tool = Tool {
    id: "view_plate",
    label: "Plate facing the view…",
    group: ToolGroup::Part,
    help: "Adds a plate where the active view looks, square to its line of sight",
    inputs: &[
        Input {
            label: "Width",
            unit: "m",
            help: "Across the view",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        Input {
            label: "Height",
            unit: "m",
            help: "Up the view",
            kind: LENGTH,
            default: |given| of_map(given, 0.2),
        },
        WALL_BOUNCE,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let mut builder = Builder::single(given);
        builder.plate(
            "plate",
            &Plate {
                middle: given.eye.focus,
                normal: given.eye.towards,
                across: given.eye.right,
                half: [values.number("Width") / 2.0, values.number("Height") / 2.0],
                bounce: values.number("Bounce"),
            },
        );
        Ok(builder.finish("Add a plate facing the view"))
    },
};
