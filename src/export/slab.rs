//! Bounded planes for programs whose planes are infinite: thin boxes, with the face where the plane is.

use glam::DVec3;

use super::contact::Yielding;
use super::format::Source;
use crate::scene::{Body, rotation_matrix};

/// Half of a box's thickness, in radii of the smallest moving sphere.
const HALF_THICKNESS: f64 = 0.01;

/// A box in place of a plate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    /// m.
    pub half_thickness: f64,
    /// Where its centre lies along the plate's normal, m: behind the plate, or 0 where bodies are on both sides.
    pub offset: f64,
}

/// What the boxes of a scene come from.
pub(super) struct Slabs {
    centers: Vec<DVec3>,
    half_thickness: f64,
}

impl Slabs {
    pub fn of(source: &Source<'_>, contact: &Yielding) -> Self {
        let centers = source.dynamic().map(|body| body.position).collect();
        Self { centers, half_thickness: HALF_THICKNESS * contact.radius }
    }

    pub fn of_plate(&self, plate: &Body) -> Slab {
        let normal = rotation_matrix(plate.rotation).z_axis;
        let (mut above, mut below) = (false, false);
        for center in &self.centers {
            let height = normal.dot(*center - plate.position);
            above |= height >= 0.0;
            below |= height < 0.0;
        }
        let half_thickness = self.half_thickness;
        let offset = match (above, below) {
            (true, false) => -half_thickness,
            (false, true) => half_thickness,
            _ => 0.0,
        };
        Slab { half_thickness, offset }
    }

    /// What a report says about them.
    pub fn how(&self, two_sided: usize) -> String {
        let thickness = 2.0 * self.half_thickness;
        let both = match two_sided {
            0 => String::new(),
            1 => "; 1 with bodies on both sides reaches half of that too far".to_owned(),
            more => format!("; {more} with bodies on both sides reach half of that too far"),
        };
        format!(
            "as boxes {thickness:.3e} m thick, with the face in place (its own planes are infinite){both}"
        )
    }
}
