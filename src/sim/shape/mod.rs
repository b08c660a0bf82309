//! Shapes: one file each with all that is known about it alone, and the table of them. Times of impact, which
//! are about two shapes, are in `predict`.

#[cfg(test)]
mod capsule;
mod convex;
mod near;
mod plate;
mod sphere;

pub(super) use convex::Convex;
pub(super) use near::{Feature, Near, Part, Surface};
pub(super) use plate::Plate;
pub(super) use sphere::{Sphere, direction};

/// The table of shapes.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Sphere(Sphere),
    /// Apart, so that a body stays small.
    Plate(Box<Plate>),
    #[cfg(test)]
    Capsule(capsule::Capsule),
}

impl Shape {
    /// The table: one line for each shape.
    pub fn convex(&self) -> &dyn Convex {
        match self {
            Self::Sphere(sphere) => sphere,
            Self::Plate(plate) => &**plate,
            #[cfg(test)]
            Self::Capsule(capsule) => capsule,
        }
    }

    /// Radius of a sphere, m; 0 for what is none.
    pub fn radius(&self) -> f64 {
        if let Self::Sphere(sphere) = self { sphere.radius } else { 0.0 }
    }
}
