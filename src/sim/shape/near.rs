//! The nearest feature of a shape as a point sees it.

use glam::DVec3;

use crate::sim::tolerance::SAME_PART;

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

/// An edge or a corner by itself, as if the shape went on so: smooth where the shape has another part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Part {
    /// A point round which it bends, m.
    center: DVec3,
    /// How deep that lies in the shape, m.
    depth: f64,
    feature: Feature,
}

impl Part {
    /// Whether this is what is nearest to a point, which sees `near` of the shape.
    pub fn is_seen(&self, near: &Near, point: DVec3) -> bool {
        let off = self.across(point + near.to_center * near.towards);
        near.feature == self.feature && off.length() <= SAME_PART * near.to_center
    }

    /// What a point sees of it.
    pub fn seen_from(&self, point: DVec3) -> Near {
        let way = -self.across(point);
        let to_center = way.length();
        let towards = way / to_center.max(f64::MIN_POSITIVE);
        Near { distance: to_center - self.depth, towards, feature: self.feature, to_center }
    }

    /// The way to a point, without what leads along an edge.
    fn across(&self, point: DVec3) -> DVec3 {
        let way = point - self.center;
        match self.feature {
            Feature::Edge(along) => way - way.dot(along) * along,
            Feature::Face | Feature::Corner => way,
        }
    }
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

    /// How the direction towards the nearest point turns for a point that moves, 1/s.
    pub fn turning(&self, velocity: DVec3) -> DVec3 {
        let across = match self.feature {
            Feature::Face => return DVec3::ZERO,
            Feature::Edge(along) => velocity - velocity.dot(along) * along,
            Feature::Corner => velocity,
        };
        -(across - across.dot(self.towards) * self.towards) / self.to_center.max(f64::MIN_POSITIVE)
    }

    /// The part that a point sees.
    pub fn part(&self, point: DVec3) -> Part {
        let center = point + self.to_center * self.towards;
        Part { center, depth: self.to_center - self.distance, feature: self.feature }
    }

    pub fn surface(&self) -> Surface {
        if self.feature == Feature::Face { Surface::Flat(self.towards) } else { Surface::Round }
    }
}
