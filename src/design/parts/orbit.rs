//! A body on a circle around an attractor.

use glam::DVec3;

use super::inputs::{BALL_BOUNCE, BALL_MASS, BALL_RADIUS, LENGTH, always};
use crate::design::builder::{Ball, Builder};
use crate::design::place::of_map;
use crate::design::plan::Given;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::scene::ForceKind;

pub const ORBIT: Tool = Tool {
    id: "orbit",
    label: "Orbit…",
    group: ToolGroup::Part,
    help: "Adds a ball on a circle around the selected point gravity, or around a new one in the middle of the map",
    inputs: &[
        Input {
            label: "Distance",
            unit: "m",
            help: "From the attractor",
            kind: LENGTH,
            default: |given| of_map(given, 0.3),
        },
        Input {
            label: "Intensity",
            unit: "m³/s²",
            help: "Of a new attractor; a selected one keeps its own",
            kind: LENGTH,
            default: |given| centre(given).map_or(8.0, |(_, intensity)| intensity),
        },
        Input {
            label: "Inclination",
            unit: "°",
            help: "Of the circle to the level",
            kind: Kind::Number(-180.0, 180.0),
            default: |_| 0.0,
        },
        BALL_RADIUS,
        BALL_MASS,
        BALL_BOUNCE,
    ],
    follow: None,
    enabled: always,
    plan: |given, values| {
        let mut builder = Builder::part(given, "orbit");
        let (centre, intensity) = centre(given).unwrap_or_else(|| {
            let (position, intensity) = (given.scene.map.size / 2.0, values.number("Intensity"));
            builder.force("attractor", ForceKind::GravityPoint { position, intensity });
            (position, intensity)
        });
        if intensity <= 0.0 {
            return Err("The selected point gravity repels: nothing circles it".into());
        }
        let distance = values.number("Distance");
        let tilt = values.number("Inclination").to_radians();
        // The attraction G/r² turns a circle of v²/r.
        let speed = libm::sqrt(intensity / distance);
        builder.ball(
            "satellite",
            &Ball {
                at: centre + DVec3::X * distance,
                radius: values.number("Ball radius"),
                mass: values.number("Ball mass"),
                velocity: DVec3::new(0.0, libm::sin(tilt), -libm::cos(tilt)) * speed,
                bounce: values.number("Ball bounce"),
            },
        );
        Ok(builder.finish("Add an orbit"))
    },
};

/// Place and intensity of the attractor that is selected.
fn centre(given: &Given<'_>) -> Option<(DVec3, f64)> {
    given.forces().iter().find_map(|force| match force.kind {
        ForceKind::GravityPoint { position, intensity } => Some((position, intensity)),
        _ => None,
    })
}
