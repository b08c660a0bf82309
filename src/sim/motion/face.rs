//! A ball that rubs on a flat face under a constant acceleration: it slides, rolls or rests.
//!
//! With the normal n from the face to the centre, the load a_n along it, the rest a_t of the acceleration, R the radius
//! and I = k m R², k = ⅖, the slip is s = v_t − R ω×n. Sliding, v̇ = a_t − μ a_n ŝ and ω̇ = (μ a_n/kR) n×ŝ, so that
//!
//! ṡ = a_t − B ŝ,  B = μ a_n (1 + 1/k),  v̇ = (k ṡ + a_t)/(1 + k),  ω̇ = n×(a_t − ṡ)/((1 + k) R).
//!
//! Rolling, v̇ = a_t/(1 + k) − ρ v̂ and ω̇ = n×v̇/R with ρ = min(μ_R a_n, μ a_n − k|a_t|/(1 + k)), if that is not negative. Both
//! are a vector w with ẇ = c − B ŵ: [`super::straight`] knows how that goes on.

use glam::DVec3;

use super::SegmentError;
use super::law::limits;
use super::radau::{RadauStart, radau_step};
use super::straight::{Course, course};
use crate::scene::Roughness;
use crate::sim::model::Model;
use crate::sim::place::Place;
use crate::sim::segment::{Segment, Series};
use crate::sim::state::FieldColumn;
use crate::sim::tolerance::{LAST_OF_SLIP, NO_SLIP, SHARE_OF_SLIP};
use crate::sim::turn::{Due, Hold, INERTIA, Rubbing, Turn};

/// A ball on a face.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct OnFace {
    pub body: u32,
    pub time: f64,
    /// From the face to the centre.
    pub normal: DVec3,
    /// m/s².
    pub load: f64,
    pub along: DVec3,
    pub law: Roughness,
    pub x: DVec3,
    pub v: DVec3,
    /// rad/s.
    pub spin: DVec3,
    /// What ends now.
    pub due: Due,
    /// Step that was to be tried next along a slip that turns, s; 0 if unknown.
    pub hint: f64,
}

/// How it goes on. `turn` has no orientation yet.
pub(in crate::sim) struct Going {
    pub segment: Segment,
    pub column: Option<FieldColumn>,
    pub turn: Turn,
}

/// What a vector w with ẇ = c − B ŵ is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum What {
    Slip,
    Velocity,
}

/// Lets the ball go on.
pub(in crate::sim) fn go_on_face(
    model: &Model,
    on: &OnFace,
    evaluations: &mut u64,
) -> Result<Going, SegmentError> {
    let mut on = *on;
    if on.due == Due::Stop {
        on.v = DVec3::ZERO;
    }
    let arm = model.radius(on.body) * on.normal;
    let slip = on.v - on.spin.cross(arm);
    let size = on.v.length() + on.spin.length() * model.radius(on.body);
    if on.due == Due::Nothing && slip.length() > NO_SLIP * size {
        return slide(model, &on, slip, evaluations);
    }
    // The spin of a ball that rolls, n×v/R, and what it has about the normal.
    on.spin = on.normal.cross(on.v) / model.radius(on.body) + on.spin.dot(on.normal) * on.normal;
    match rolling(&on) {
        Some((c, resistance)) => roll(model, &on, (c, resistance), evaluations),
        None => slide(model, &on, DVec3::ZERO, evaluations),
    }
}

/// What drives a ball that rolls, and what resists it, m/s²; `None` if friction can't make it roll. Rolling takes k a_t/(1 + k)
/// of friction, and rolling friction no more than that leaves: else it would block the ball.
fn rolling(on: &OnFace) -> Option<(DVec3, f64)> {
    let drive = on.along / (1.0 + INERTIA);
    let left = on.law.friction * on.load - (on.along - drive).length();
    (left >= 0.0).then_some((drive, left.min(on.law.rolling * on.load)))
}

fn roll(
    model: &Model,
    on: &OnFace,
    (drive, resistance): (DVec3, f64),
    evaluations: &mut u64,
) -> Result<Going, SegmentError> {
    let mut going = follow(model, on, What::Velocity, (on.v, drive, resistance), evaluations)?;
    let is_still = going.segment.v == DVec3::ZERO && going.segment.a == DVec3::ZERO;
    going.turn.hold = if is_still { Hold::Rests } else { Hold::Rolls };
    let mass = model.mass(on.body);
    // The torque takes (1 + k) times the force that it would need at the centre.
    let roll = (1.0 + INERTIA) * mass * resistance;
    going.turn.rubbing = Rubbing { slide: 0.0, roll, arm: model.radius(on.body) * on.normal };
    Ok(going)
}

fn slide(model: &Model, on: &OnFace, slip: DVec3, evaluations: &mut u64) -> Result<Going, SegmentError> {
    let rubs = on.law.friction * on.load;
    let against = rubs * (1.0 + 1.0 / INERTIA);
    let mut going = follow(model, on, What::Slip, (slip, on.along, against), evaluations)?;
    going.turn.hold = Hold::Slides;
    let slide = model.mass(on.body) * rubs;
    going.turn.rubbing = Rubbing { slide, roll: 0.0, arm: model.radius(on.body) * on.normal };
    Ok(going)
}

/// The motion in which w, the slip or the velocity, obeys ẇ = c − B ŵ.
fn follow(
    model: &Model,
    on: &OnFace,
    what: What,
    (w, c, against): (DVec3, DVec3, f64),
    evaluations: &mut u64,
) -> Result<Going, SegmentError> {
    let due = if what == What::Slip { Due::NoSlip } else { Due::Stop };
    // A velocity that ends is itself all the speed there is: beside that of a fall by a radius it is the rest of one.
    let radius = model.radius(on.body);
    let speed = (on.v.length() + w.length()).max((on.load * radius).sqrt());
    let straight = |rate: DVec3, stop: f64| {
        let turn = Turn { due: if stop.is_finite() { due } else { Due::Nothing }, ..on.turn() };
        on.going(model, what, rate, None, on.time + stop, turn)
    };
    Ok(match course(w, c, against) {
        Course::Still => straight(DVec3::ZERO, f64::INFINITY),
        Course::Straight { rate, stop } => straight(rate, stop),
        Course::Turns { stop, .. } if stop * against <= LAST_OF_SLIP * speed => straight(-w / stop, stop),
        Course::Turns { stop, .. } => {
            let mut bounds = limits(model);
            bounds.longest = bounds.longest.min(SHARE_OF_SLIP * stop);
            let start = RadauStart {
                time: on.time,
                place: Place::exact(DVec3::ZERO),
                v: w,
                reads_position: false,
                step: on.hint,
                previous: None,
                radius,
                drag: 0.0,
                limits: bounds,
            };
            let (part, column) =
                radau_step(&start, evaluations, |_, _, w| c - against * w.normalize_or_zero())?;
            let series = (column.series, part.step, column.next_step);
            on.going(model, what, part.a, Some(series), part.end, on.turn())
        }
    })
}

impl OnFace {
    fn turn(&self) -> Turn {
        Turn::steady(self.time, glam::DQuat::IDENTITY, self.spin)
    }

    /// The motion of centre and spin to that of w, of which they are linear.
    fn going(
        &self,
        model: &Model,
        what: What,
        rate: DVec3,
        series: Option<(Series, f64, f64)>,
        end: f64,
        turn: Turn,
    ) -> Going {
        let radius = model.radius(self.body);
        let share = |rate: DVec3, along: DVec3| match what {
            What::Slip => (
                (INERTIA * rate + along) / (1.0 + INERTIA),
                self.normal.cross(along - rate) / ((1.0 + INERTIA) * radius),
            ),
            What::Velocity => (rate, self.normal.cross(rate) / radius),
        };
        let (a, ramp) = share(rate, self.along);
        let ballistic = Segment::ballistic(self.time, self.x, self.v, a);
        let Some((of_rate, step, next_step)) = series else {
            let segment = Segment { end, ..ballistic };
            return Going { segment, column: None, turn: Turn { ramp, ..turn } };
        };
        let (mut of_centre, mut of_spin) = (Series::default(), Series::default());
        for (k, b) in of_rate.b.iter().enumerate() {
            (of_centre.b[k], of_spin.b[k]) = share(*b, DVec3::ZERO);
        }
        let acceleration_bound = a.length() + of_centre.bound();
        let segment = Segment { end, step, acceleration_bound, ..ballistic };
        let column = Some(FieldColumn { series: of_centre, next_step });
        Going { segment, column, turn: Turn { ramp, series: of_spin, step, ..turn } }
    }
}
