//! A table with cushions, for balls that roll.

use glam::DVec3;

use super::inputs::{LENGTH, PLACE_X, PLACE_Y, PLACE_Z, always, place};
use crate::design::builder::{Builder, Plate};
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};

const SHARE: Kind = Kind::Number(0.0, 1.0);

pub const TABLE: Tool = Tool {
    id: "table",
    label: "Table with cushions…",
    group: ToolGroup::Part,
    help: "Adds a level bed with four low walls around it",
    inputs: &[
        Input {
            label: "Length x",
            unit: "m",
            help: "Inside the cushions",
            kind: LENGTH,
            default: |given| of_map(given, 0.6),
        },
        Input {
            label: "Width z",
            unit: "m",
            help: "Inside the cushions",
            kind: LENGTH,
            default: |given| of_map(given, 0.3),
        },
        Input {
            label: "Cushion height",
            unit: "m",
            help: "Higher than a ball's radius, or balls jump over it",
            kind: LENGTH,
            default: |given| of_map(given, 0.04),
        },
        Input { label: "Bed bounce", unit: "", help: "0: balls stay on it", kind: SHARE, default: |_| 0.0 },
        Input { label: "Cushion bounce", unit: "", help: "1 loses nothing", kind: SHARE, default: |_| 0.8 },
        PLACE_X,
        Input { help: "Height of the bed", default: |given| super::inputs::raised(given, 0.1), ..PLACE_Y },
        PLACE_Z,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let half =
            DVec3::new(values.number("Length x"), values.number("Cushion height"), values.number("Width z"))
                / 2.0;
        let bed = place(values);
        let mut builder = Builder::part(given, "table");
        builder.plate(
            "bed",
            &Plate {
                middle: bed,
                normal: DVec3::Y,
                across: DVec3::X,
                half: [half.x, half.z],
                bounce: values.number("Bed bounce"),
            },
        );
        for (name, normal, across, side) in [
            ("cushion left", DVec3::X, DVec3::Z, half.z),
            ("cushion right", DVec3::NEG_X, DVec3::Z, half.z),
            ("cushion back", DVec3::Z, DVec3::X, half.x),
            ("cushion front", DVec3::NEG_Z, DVec3::X, half.x),
        ] {
            builder.plate(
                name,
                &Plate {
                    middle: bed - normal * half + DVec3::Y * half.y,
                    normal,
                    across,
                    half: [side, half.y],
                    bounce: values.number("Cushion bounce"),
                },
            );
        }
        Ok(builder.finish("Add a table"))
    },
};
