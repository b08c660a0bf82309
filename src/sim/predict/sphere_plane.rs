//! Sphere against bounded plane (plate): the distance of the centre to the rectangle, less the radius.
//! That one function covers the two faces, four edges and four corners.

use glam::DVec3;

use super::advance::{Search, first_contact as advance};
use super::{Gap, Mover, snap, snap_pressure, touch_tolerance};
use crate::sim::model::Plate;
use crate::sim::roots::first_root;

pub(super) fn first_contact(mover: Mover<'_>, plate: &Plate, from: f64) -> Option<f64> {
    let seg = mover.path.segment;
    let slack = touch_tolerance(seg.x, mover.radius).max(touch_tolerance(plate.center, mover.radius));
    let mut from = seg.start.max(from);
    // Along a parabola the time at which the sphere reaches the plane of the plate has a closed form. It
    // is the contact if the foot lies on the plate, and not later than any contact if it does not.
    if mover.path.series.is_none() {
        match reach_plane(mover, plate, from, slack) {
            Reach::Never => return None,
            Reach::Within => {}
            Reach::At(time) => {
                if time > seg.end {
                    return None;
                }
                if plate.covers(plate.local_of(mover.path.position(time))) {
                    return Some(time);
                }
                from = time;
            }
        }
    }
    let acceleration_bound = mover.path.series.map(|_| seg.acceleration_bound);
    let search = Search { from, until: seg.end, acceleration_bound, slack };
    advance(search, |time| gap(mover, plate, time))
}

pub(super) fn gap(mover: Mover<'_>, plate: &Plate, time: f64) -> Gap {
    let at = mover.path.position(time);
    let velocity = mover.path.velocity(time);
    let acceleration = mover.path.acceleration(time);
    let near = closest_on_plate(plate, at);
    let turn = near.turn_away(velocity);
    let drive = -near.towards.dot(acceleration);
    Gap {
        distance: near.distance - mover.radius,
        rate: snap(-near.towards.dot(velocity), velocity.length()),
        bend: snap_pressure(turn + drive, acceleration.length() + turn),
        drive,
        normal: near.towards,
        point: at + mover.radius * near.towards,
    }
}

/// What a point sees of a plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct NearPlate {
    pub distance: f64,
    /// Unit vector towards the nearest point of the plate.
    pub towards: DVec3,
    pub feature: Feature,
}

/// Which part of a plate is nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) enum Feature {
    Face,
    /// Unit vector along the edge.
    Edge(DVec3),
    Corner,
}

impl NearPlate {
    /// How fast the distance bends away because the point moves past an edge or a corner: |v⊥|²/d.
    pub fn turn_away(&self, velocity: DVec3) -> f64 {
        let across = match self.feature {
            Feature::Face => return 0.0,
            Feature::Edge(along) => velocity - velocity.dot(along) * along,
            Feature::Corner => velocity,
        };
        (across - across.dot(self.towards) * self.towards).length_squared() / self.distance
    }
}

/// The nearest part of a plate. A point in the plate itself counts as above it, whatever its velocity:
/// else an impact there would repeat for ever.
pub(in crate::sim) fn closest_on_plate(plate: &Plate, at: DVec3) -> NearPlate {
    let local = plate.local_of(at);
    let over_x = local.x.abs() - plate.half_x;
    let over_y = local.y.abs() - plate.half_y;
    let feature = match (over_x > 0.0, over_y > 0.0) {
        (false, false) => {
            let side = if local.z < 0.0 { -1.0 } else { 1.0 };
            return NearPlate {
                distance: local.z.abs(),
                towards: -side * plate.normal,
                feature: Feature::Face,
            };
        }
        (true, false) => Feature::Edge(plate.axis_y),
        (false, true) => Feature::Edge(plate.axis_x),
        (true, true) => Feature::Corner,
    };
    let out_x = over_x.max(0.0).copysign(local.x);
    let out_y = over_y.max(0.0).copysign(local.y);
    let distance = DVec3::new(out_x, out_y, local.z).length();
    let towards = -(out_x * plate.axis_x + out_y * plate.axis_y + local.z * plate.normal) / distance;
    NearPlate { distance, towards, feature }
}

enum Reach {
    /// The sphere stays off the plane for ever.
    Never,
    /// The sphere cuts the plane at the start already.
    Within,
    At(f64),
}

/// First τ ≥ 0 with |z(τ)| = r, approaching, for z(τ) = z + ż τ + ½ z̈ τ² in the plate's frame.
fn reach_plane(mover: Mover<'_>, plate: &Plate, from: f64, slack: f64) -> Reach {
    let z = plate.local_of(mover.path.position(from)).z;
    let side = if z < 0.0 { -1.0 } else { 1.0 };
    let distance = side * z - mover.radius;
    let velocity = mover.path.velocity(from);
    let rate = snap(side * plate.normal.dot(velocity), velocity.length());
    let acceleration = side * plate.normal.dot(mover.path.segment.a);
    if distance < -slack || (distance <= 0.0 && (rate < 0.0 || (rate == 0.0 && acceleration < 0.0))) {
        return Reach::Within;
    }
    let tau = first_root(distance, rate, acceleration);
    tau.map_or(Reach::Never, |tau| Reach::At(from + tau))
}
