//! The mirror image of the selection.

use glam::{DMat3, DVec3};

use super::inputs::{ANYWHERE, AXES, around, axis, with_bodies};
use crate::design::plan::Plan;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::scene::{Body, BodyChange, BodyCopy, Edit, Motion, Shape, euler_near, rotation_matrix};

pub const MIRROR: Tool = Tool {
    id: "mirror",
    label: "Mirror…",
    group: ToolGroup::Arrange,
    help: "Reflects places, rotations and velocities in a plane square to an axis",
    inputs: &[
        Input { label: "Axis", unit: "", help: "Square to the mirror", kind: AXES, default: |_| 0.0 },
        Input {
            label: "Mirror at",
            unit: "m",
            help: "Where the mirror cuts the axis: the middle of the map by default",
            kind: ANYWHERE,
            default: |given| given.scene.map.size.x / 2.0,
        },
        Input {
            label: "Keep the originals",
            unit: "",
            help: "Or move them",
            kind: Kind::Flag,
            default: |_| 1.0,
        },
    ],
    follow: None,
    enabled: with_bodies,
    plan: |given, values| {
        let axis = axis(values.count("Axis"));
        let at = values.number("Mirror at");
        if values.is_on("Keep the originals") {
            let flat = around(given);
            if (flat.size() * axis).length() == 0.0 && flat.middle().dot(axis) == at {
                return Err("The selection lies in the mirror: its image would be at the same place".into());
            }
            let copies = given
                .bodies()
                .into_iter()
                .map(|body| BodyCopy { of: body.key, changes: image(body, axis, at) });
            return Ok(Plan::new("Add a mirror image", vec![Edit::CopyBodies(copies.collect())]));
        }
        let edits = given.movable().into_iter().flat_map(|body| {
            image(body, axis, at).into_iter().map(|change| Edit::Body { key: body.key, change })
        });
        Ok(Plan::new("Mirror", edits.collect()))
    },
};

/// What a mirror square to `axis` at `at` makes of a body.
fn image(body: &Body, axis: DVec3, at: f64) -> Vec<BodyChange> {
    let flip = DVec3::ONE - 2.0 * axis;
    let mut changes = vec![BodyChange::Position(body.position * flip + 2.0 * at * axis)];
    if let Shape::Plane { .. } = body.shape {
        // Both faces of a plate are alike: turning the normal back makes a rotation of the reflection.
        let DMat3 { x_axis, y_axis, z_axis } = rotation_matrix(body.rotation);
        let image = DMat3::from_cols(x_axis * flip, y_axis * flip, -(z_axis * flip));
        changes.push(BodyChange::Rotation(euler_near(image, body.rotation)));
    }
    if let Motion::Dynamic { velocity, .. } = body.motion {
        changes.push(BodyChange::Velocity(velocity * flip));
        if body.spin != DVec3::ZERO {
            // The image of a spin turns the other way round.
            changes.push(BodyChange::Spin(-(body.spin * flip)));
        }
    }
    changes
}
