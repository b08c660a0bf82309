//! The nearest feature of a shape as a point sees it.

use glam::DVec3;

/// What a point sees of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Near {
    /// m.
    pub distance: f64,
    /// Unit vector towards the nearest point of the shape.
    pub towards: DVec3,
    pub feature: Feature,
    /// Distance to the centre (or axis) round which the surface bends, m; the distance itself for a sharp edge or
    /// corner.
    pub to_center: f64,
}

/// Which part of a shape is nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) enum Feature {
    /// It is flat there.
    Face,
    /// It bends in one direction. Unit vector along the other.
    Edge(DVec3),
    /// It bends in both, as a corner or a sphere does.
    Corner,
}

/// What is touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) enum Surface {
    /// A face; the unit vector points from the body into it.
    Flat(DVec3),
    /// A sphere, an edge or a corner.
    Round,
}

impl Near {
    /// How fast the distance bends away because the point moves past something round, an edge or a corner:
    /// |v⊥|²/ρ, m/s².
    pub fn turn_away(&self, velocity: DVec3) -> f64 {
        let across = match self.feature {
            Feature::Face => return 0.0,
            Feature::Edge(along) => velocity - velocity.dot(along) * along,
            Feature::Corner => velocity,
        };
        (across - across.dot(self.towards) * self.towards).length_squared()
            / self.to_center.max(f64::MIN_POSITIVE)
    }

    pub fn surface(&self) -> Surface {
        if self.feature == Feature::Face { Surface::Flat(self.towards) } else { Surface::Round }
    }
}
