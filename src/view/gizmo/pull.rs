//! What dragging a handle means: a way, an angle, a size, a vector.

use glam::{DVec2, DVec3};

use super::handles::{Sides, Vector, VectorKind};
use super::snap::{FINE_FACTOR, ROUND_FACTOR, fine_angle};
use super::{Axis, Freedom, Handle, Subject, snap_angle, snap_value};
use crate::view::{Camera, Viewport};

/// A change to the subject as it was when it was taken hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pull {
    /// m.
    Move(DVec3),
    /// About a unit vector through the pivot, radians.
    Turn { axis: DVec3, angle: f64 },
    /// m.
    Radius(f64),
    /// How often the sizes, and the ways from the pivot.
    Scale(f64),
    /// A plate's new half sides, and how far its middle moves.
    Sides { half: [f64; 2], shift: DVec3 },
    /// m.
    Map(DVec3),
    /// m/s or m/s².
    Vector(DVec3),
}

/// A handle taken hold of.
#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    pub handle: Handle,
    pub subject: Subject,
    /// The place in the world that is dragged.
    pub grabbed: DVec3,
    /// Where the pointer took hold.
    pub from: DVec2,
    /// The only axis along which something is to change.
    pub only: Option<Axis>,
    /// Cannot be smaller than this, m.
    pub smallest: f64,
}

/// What the pointer at `to` makes of a grip. `before` is the last pull, so that a ring can be turned
/// several times around. `None` where the pointer has no place.
pub fn pull(
    grip: &Grip,
    camera: &Camera,
    viewport: Viewport,
    to: DVec2,
    before: Option<&Pull>,
) -> Option<Pull> {
    let aspect = viewport.aspect();
    let moved = |freedom: Freedom| freedom.offset(camera, aspect, grip.grabbed, (grip.from, to));
    let subject = &grip.subject;
    match (grip.handle, subject.sides, subject.vector) {
        (Handle::TurnAbout(_) | Handle::TurnFacing, ..) => {
            let axis = grip.turn_axis(camera)?;
            let angle = turned(camera, aspect, axis, subject.pivot, (grip.from, to))?;
            Some(Pull::Turn { axis, angle: unwrapped(angle, before) })
        }
        (Handle::Radius, Some(Sides::Sphere { radius }), _) => {
            let from_pivot = grip.grabbed - subject.pivot;
            let now = from_pivot + moved(Freedom::facing(camera))?;
            let grown = radius + now.length() - from_pivot.length();
            Some(Pull::Radius(grown.max(grip.smallest)))
        }
        (Handle::Scale, ..) => {
            let from_pivot = grip.grabbed - subject.pivot;
            let now = from_pivot + moved(Freedom::facing(camera))?;
            let factor = now.length() / from_pivot.length();
            factor.is_finite().then(|| Pull::Scale(factor.max(FINE_FACTOR)))
        }
        (Handle::Side { along, positive }, Some(Sides::Plate { half, along: units }), _) => {
            let unit = units[along as usize & 1] * if positive { 1.0 } else { -1.0 };
            let by = moved(Freedom::Line(unit))?.dot(unit);
            Some(side(half, along, unit, half[along as usize & 1] + 0.5 * by, grip.smallest))
        }
        (Handle::MapSide(axis), Some(Sides::Map(size)), _) => {
            let by = moved(Freedom::Line(axis.unit()))?;
            Some(Pull::Map((size + by).max(DVec3::splat(grip.smallest))))
        }
        (Handle::Vector, _, Some(Vector { value, metres_per_unit, .. })) => {
            Some(Pull::Vector(value + moved(grip.freedom(camera))? / metres_per_unit))
        }
        _ => Some(Pull::Move(moved(grip.freedom(camera))?)),
    }
}

impl Grip {
    /// Takes hold of a handle with the pointer at `from`. `None` where the pointer has no place.
    pub fn take(
        handle: Handle,
        subject: Subject,
        camera: &Camera,
        viewport: Viewport,
        from: DVec2,
    ) -> Option<Self> {
        let smallest = camera.world_per_pixel_at(subject.pivot, viewport.height);
        let grabbed = subject.pivot;
        let mut grip = Self { handle, subject, grabbed, from, only: None, smallest };
        grip.grabbed = grip.place_of_handle(camera, viewport)?;
        Some(grip)
    }

    /// Takes hold of a body at a place on it.
    pub fn take_body(subject: Subject, grabbed: DVec3, from: DVec2) -> Self {
        Self { handle: Handle::Body, subject, grabbed, from, only: None, smallest: 0.0 }
    }

    fn place_of_handle(&self, camera: &Camera, viewport: Viewport) -> Option<DVec3> {
        let Subject { pivot, sides, vector, .. } = &self.subject;
        let place = match (self.handle, sides, vector) {
            (Handle::TurnAbout(_) | Handle::TurnFacing, ..) => {
                let axis = self.turn_axis(camera)?;
                *pivot + arm(camera, viewport.aspect(), axis, *pivot, self.from)?
            }
            (Handle::Radius | Handle::Scale, ..) => {
                *pivot + arm(camera, viewport.aspect(), camera.backward(), *pivot, self.from)?
            }
            (Handle::Side { along, positive }, Some(Sides::Plate { half, along: units }), _) => {
                let at = along as usize & 1;
                *pivot + units[at] * if positive { half[at] } else { -half[at] }
            }
            (Handle::MapSide(axis), Some(Sides::Map(size)), _) => 0.5 * *size + 0.5 * *size * axis.unit(),
            (Handle::Vector, _, Some(vector)) => *pivot + vector.value * vector.metres_per_unit,
            _ => *pivot,
        };
        Some(place)
    }

    /// Where it may go, for what moves.
    pub fn freedom(&self, camera: &Camera) -> Freedom {
        let axes = self.subject.axes;
        let across = |axis: Axis| {
            let at = axis as usize;
            Freedom::Plane(axes[(at + 1) % 3], axes[(at + 2) % 3])
        };
        match (self.only, self.handle) {
            (Some(axis), _) | (None, Handle::MoveAlong(axis)) => Freedom::Line(axes[axis as usize]),
            (None, Handle::MoveAcross(axis)) => across(axis),
            (None, Handle::MoveFacing) => Freedom::facing(camera),
            (None, Handle::Vector) if self.is_acceleration() => Freedom::facing(camera),
            (None, _) => Freedom::natural(camera),
        }
    }

    fn is_acceleration(&self) -> bool {
        self.subject.vector.is_some_and(|vector| vector.kind == VectorKind::Acceleration)
    }

    fn turn_axis(&self, camera: &Camera) -> Option<DVec3> {
        match (self.only, self.handle) {
            (Some(axis), Handle::TurnAbout(_) | Handle::TurnFacing) | (None, Handle::TurnAbout(axis)) => {
                Some(self.subject.axes[axis as usize])
            }
            (_, Handle::TurnFacing) => Some(camera.backward()),
            _ => None,
        }
    }

    /// The pull with round numbers: places and sizes on multiples of `step`, angles of 15°. `origin` is where
    /// what moves began.
    pub fn snapped(&self, pull: Pull, camera: &Camera, origin: DVec3, step: f64) -> Pull {
        match pull {
            Pull::Move(offset) => Pull::Move(self.freedom(camera).snapped(origin, offset, step)),
            Pull::Turn { axis, angle } => Pull::Turn { axis, angle: snap_angle(angle) },
            Pull::Scale(factor) => Pull::Scale(snap_value(factor, ROUND_FACTOR).max(ROUND_FACTOR)),
            other => self.rounded(other, camera, origin, step),
        }
    }

    /// As [`Self::snapped`], for a step too fine to be noticed, and angles of a tenth of a degree.
    pub fn rounded(&self, pull: Pull, camera: &Camera, origin: DVec3, step: f64) -> Pull {
        match (pull, self.handle, self.subject.sides) {
            (Pull::Move(offset), ..) => Pull::Move(self.freedom(camera).snapped(origin, offset, step)),
            (Pull::Radius(radius), ..) => Pull::Radius(snap_value(radius, step).max(self.smallest)),
            (Pull::Scale(factor), ..) => Pull::Scale(snap_value(factor, FINE_FACTOR).max(FINE_FACTOR)),
            (Pull::Map(size), ..) => {
                let snapped = super::snap(size, step).max(DVec3::splat(self.smallest));
                let Some(Sides::Map(before)) = self.subject.sides else { return pull };
                // sides that were not dragged keep their bits
                Pull::Map(DVec3::select(size.cmpeq(before), before, snapped))
            }
            (
                Pull::Sides { half, .. },
                Handle::Side { along, positive },
                Some(Sides::Plate { half: before, along: units }),
            ) => {
                let at = along as usize & 1;
                let unit = units[at] * if positive { 1.0 } else { -1.0 };
                side(before, along, unit, 0.5 * snap_value(2.0 * half[at], step), self.smallest)
            }
            (Pull::Vector(value), ..) => {
                let Some(vector) = self.subject.vector else { return pull };
                let change = value - vector.value;
                let free = self.freedom(camera).snapped(vector.value, change, step / vector.metres_per_unit);
                Pull::Vector(vector.value + free)
            }
            (Pull::Turn { axis, angle }, ..) => Pull::Turn { axis, angle: fine_angle(angle) },
            (Pull::Sides { .. }, ..) => pull,
        }
    }
}

impl Grip {
    /// What a number typed in the pointer's place means for this handle; `angle` is it read as an angle,
    /// radians. `None` where a number alone says nothing, such as for a move in a plane.
    pub fn typed(&self, camera: &Camera, number: f64, angle: f64) -> Option<Pull> {
        match (self.handle, self.subject.sides, self.subject.vector) {
            (Handle::TurnAbout(_) | Handle::TurnFacing, ..) => {
                Some(Pull::Turn { axis: self.turn_axis(camera)?, angle })
            }
            (Handle::Radius, ..) => (number > 0.0).then_some(Pull::Radius(number)),
            (Handle::Scale, ..) => (number > 0.0).then_some(Pull::Scale(number)),
            (Handle::Side { along, positive }, Some(Sides::Plate { half, along: units }), _) => {
                let unit = units[along as usize & 1] * if positive { 1.0 } else { -1.0 };
                (number > 0.0).then(|| side(half, along, unit, 0.5 * number, 0.0))
            }
            (Handle::MapSide(axis), Some(Sides::Map(mut size)), _) => {
                size[axis as usize] = number;
                (number > 0.0).then_some(Pull::Map(size))
            }
            (Handle::Vector, _, Some(Vector { mut value, .. })) => match self.only {
                Some(axis) => {
                    value[axis as usize] = number;
                    Some(Pull::Vector(value))
                }
                // a length
                None => Some(Pull::Vector(value.try_normalize()? * number)),
            },
            _ => match self.freedom(camera) {
                Freedom::Line(unit) => Some(Pull::Move(unit * number)),
                Freedom::Plane(..) => None,
            },
        }
    }
}

/// A plate of which one side was moved and the opposite one stays.
fn side(half: [f64; 2], along: Axis, unit: DVec3, to: f64, smallest: f64) -> Pull {
    let at = along as usize & 1;
    let mut sides = half;
    sides[at] = to.max(0.5 * smallest);
    Pull::Sides { half: sides, shift: unit * (sides[at] - half[at]) }
}

/// The angle that the pointer turns about an axis through `pivot`, −π..=π.
fn turned(
    camera: &Camera,
    aspect: f64,
    axis: DVec3,
    pivot: DVec3,
    (from, to): (DVec2, DVec2),
) -> Option<f64> {
    let arm = |ndc| arm(camera, aspect, axis, pivot, ndc);
    let (a, b) = (arm(from)?, arm(to)?);
    Some(libm::atan2(axis.dot(a.cross(b)), a.dot(b)))
}

/// From the pivot to where the pointer is in the plane at right angles to an axis.
fn arm(camera: &Camera, aspect: f64, axis: DVec3, pivot: DVec3, ndc: DVec2) -> Option<DVec3> {
    let ray = camera.ray(ndc, aspect);
    let distance = (pivot - ray.origin).dot(axis) / ray.direction.dot(axis);
    let arm = ray.at(distance) - pivot;
    (arm.is_finite() && arm != DVec3::ZERO).then_some(arm)
}

/// The same angle, as many whole turns on as it takes to be next to the one before.
fn unwrapped(angle: f64, before: Option<&Pull>) -> f64 {
    let Some(Pull::Turn { angle: before, .. }) = before else { return angle };
    angle + std::f64::consts::TAU * ((before - angle) / std::f64::consts::TAU).round()
}
