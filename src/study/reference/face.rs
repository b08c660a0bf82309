//! One ball that lies on one flat face and rubs on it: it slides, rolls or rests.
//!
//! Where friction of a direction ŵ brings a vector w to zero, ẇ = c − B ŵ, steps are taken in a time σ with dt = |w|/B dσ. Then
//! dw/dσ = c|w|/B − w has no bend, though ŵ turns ever quicker: w falls by e^σ and more, and what is left of it at the end
//! is straight.

use glam::DVec3;

use super::extrapolation::extrapolated;
use super::flight::{Ball, INERTIA};
use super::settings::End;
use crate::scene::{Force, Roughness};

/// What a ball on a face does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    Slides,
    Rolls,
    Rests,
}

/// A face that a ball lies on, and what became of it in the last step.
#[derive(Clone, Copy, Debug)]
pub struct OnFace {
    /// Index among the static bodies.
    pub(super) fixture: usize,
    /// From the face to the centre.
    pub normal: DVec3,
    /// Of the pair.
    pub law: Roughness,
    pub hold: Hold,
    /// The largest speed that centre and surface had on it, m/s.
    fastest: f64,
    /// When it began to roll and to rest, s from the start of the step.
    pub(super) began: [Option<f64>; 2],
    /// Why it can't be followed further.
    pub(super) end: Option<End>,
}

/// Forces of one instant on a ball on its face.
struct Load {
    /// Along the face, m/s².
    along: DVec3,
    /// Into it, m/s².
    pressing: f64,
}

/// Part of the speeds below which what is left of a slip or a velocity goes straight to zero.
const LAST: f64 = 1e-13;
/// Slips below this part of the speeds that they are the difference of are none.
const NO_SLIP: f64 = 1e-12;
/// Step in σ: w falls to e^-½.
const STRETCH: f64 = 0.5;
/// Part of a step in which a slip that begins goes straight.
const BEGINNING: f64 = 1e-7;
/// What is left of a duration below this part of it is its rounding.
const DONE: f64 = 8.0 * f64::EPSILON;
/// Halvings before a step is taken as it is, and pieces of a step at most.
const DEPTH: u32 = 40;
const MOST_PIECES: u32 = 100_000;
/// Newton steps to a time.
const MOST_TRIES: u32 = 30;

/// What rolling friction takes, m/s²: μ_R a_n, or what is left of μ a_n beside the k a_t/(1 + k) that rolling takes.
fn resistance(law: Roughness, load: &Load) -> f64 {
    let left = law.friction * load.pressing - load.along.length() * (INERTIA / (1.0 + INERTIA));
    left.min(law.rolling * load.pressing)
}

impl Ball {
    /// Lays the ball on a face, if it is pressed against it.
    pub(super) fn lay_on(&mut self, fixture: usize, normal: DVec3, law: Roughness, forces: &[Force]) {
        if law.friction == 0.0 || self.load(normal, forces, DVec3::ZERO, DVec3::ZERO).pressing <= 0.0 {
            return;
        }
        let into = self.velocity.value.dot(normal) * normal;
        self.velocity = self.velocity.plus(-into);
        let (hold, began, end) = (Hold::Slides, [None; 2], None);
        let mut on = OnFace { fixture, normal, law, hold, fastest: self.fastest(), began, end };
        if self.slip(normal).length() <= NO_SLIP * on.fastest {
            on.hold = Hold::Rolls;
            self.rolls_on(&mut on, forces);
        }
        self.on = Some(on);
    }

    fn fastest(&self) -> f64 {
        self.velocity.value.length() + self.radius * self.spin.length()
    }

    /// As [`Ball::flown`], on a face.
    pub(super) fn gone_on(&self, on: OnFace, forces: &[Force], duration: f64, tolerance: f64) -> Self {
        let mut ball = *self;
        let fastest = on.fastest.max(self.fastest());
        let (mut left, mut on) = (duration, OnFace { began: [None; 2], fastest, ..on });
        // Kept from piece to piece: as a difference of speeds it would lose its digits as it ends.
        let mut slip = self.slip(on.normal);
        for _ in 0..MOST_PIECES {
            if left <= DONE * duration || on.end.is_some() || on.hold == Hold::Rests {
                break;
            }
            left -= match on.hold {
                Hold::Slides if slip.length() <= NO_SLIP * ball.fastest() => {
                    ball.end_slip(&mut on, &mut slip, forces, left)
                }
                Hold::Slides => ball.slide(&mut on, &mut slip, forces, left, tolerance),
                Hold::Rolls | Hold::Rests => ball.roll(&mut on, forces, left, tolerance),
            };
            let at = duration - left;
            match on.hold {
                Hold::Slides => {}
                Hold::Rolls => on.began[0] = on.began[0].or(Some(at).filter(|_| self.slides())),
                Hold::Rests => on.began[1] = Some(at),
            }
        }
        if on.end.is_none() && ball.load(on.normal, forces, DVec3::ZERO, DVec3::ZERO).pressing <= 0.0 {
            on.end = Some(End::LeftFace);
        }
        ball.on = Some(on);
        ball
    }

    fn slides(&self) -> bool {
        self.on.is_some_and(|on| on.hold == Hold::Slides)
    }

    /// Slip of the point that touches, m/s.
    fn slip(&self, normal: DVec3) -> DVec3 {
        let v = self.velocity.value;
        v - v.dot(normal) * normal - self.radius * self.spin.cross(normal)
    }

    fn load(&self, normal: DVec3, forces: &[Force], dx: DVec3, dv: DVec3) -> Load {
        let a = self.acceleration(forces, dx, dv);
        let pressing = -a.dot(normal);
        Load { along: a + pressing * normal, pressing }
    }

    /// Slides for so long at most; gives how long it did. With s the slip and p = ∫ a_t dt,
    /// ṡ = a_t − B ŝ, B = (1 + 1/k) μ a_n, and v = v₀ + (p + k Δs)/(1 + k), ω = ω₀ + n×(p − Δs)/((1 + k)R).
    fn slide(
        &mut self,
        on: &mut OnFace,
        slip: &mut DVec3,
        forces: &[Force],
        left: f64,
        tolerance: f64,
    ) -> f64 {
        let (ball, normal, start) = (*self, on.normal, *slip);
        let against = |load: &Load| (1.0 + 1.0 / INERTIA) * on.law.friction * load.pressing;
        let rate = |[dx, ds, push, _]: [DVec3; 4]| {
            let dv = (push + INERTIA * ds) / (1.0 + INERTIA);
            let load = ball.load(normal, forces, dx, dv);
            let slip = start + ds;
            let stretch = slip.length() / against(&load);
            let along = load.along * stretch;
            [(ball.velocity.value + dv) * stretch, along - slip, along, DVec3::X * stretch]
        };
        let [dx, ds, push, time] = ball.stretched(left, tolerance, start, rate);
        self.change_sliding(normal, dx, ds, push);
        *slip = start + ds;
        if slip.length() > LAST * on.fastest {
            return time.x;
        }
        let load = self.load(normal, forces, DVec3::ZERO, DVec3::ZERO);
        let rest = slip.length() / (against(&load) - load.along.dot(slip.normalize_or_zero()));
        self.change_sliding(normal, self.velocity.value * rest, -*slip, load.along * rest);
        *slip = DVec3::ZERO;
        on.hold = Hold::Rolls;
        self.rolls_on(on, forces);
        time.x + rest
    }

    fn change_sliding(&mut self, normal: DVec3, dx: DVec3, ds: DVec3, push: DVec3) {
        let share = 1.0 / (1.0 + INERTIA);
        self.change(dx, share * (push + INERTIA * ds), (share / self.radius) * normal.cross(push - ds));
    }

    /// A ball that does not slip rolls if friction can make it, or begins to slip; gives how long that took.
    fn end_slip(&mut self, on: &mut OnFace, slip: &mut DVec3, forces: &[Force], left: f64) -> f64 {
        on.hold = Hold::Rolls;
        self.rolls_on(on, forces);
        if on.hold != Hold::Slides {
            return 0.0;
        }
        let load = self.load(on.normal, forces, DVec3::ZERO, DVec3::ZERO);
        let against = (1.0 + 1.0 / INERTIA) * on.law.friction * load.pressing;
        let (time, normal) = (BEGINNING * left, on.normal);
        *slip = (load.along - against * load.along.normalize_or_zero()) * time;
        self.change_sliding(normal, self.velocity.value * time, *slip, load.along * time);
        time
    }

    /// Sets what a ball that does not slip does at its present speed: it rolls or rests, or must slip.
    fn rolls_on(&mut self, on: &mut OnFace, forces: &[Force]) {
        let load = self.load(on.normal, forces, DVec3::ZERO, DVec3::ZERO);
        let drive = load.along / (1.0 + INERTIA);
        let resists = resistance(on.law, &load);
        let rests = self.velocity.value == DVec3::ZERO && drive.length() <= resists;
        if resists < 0.0 {
            on.hold = Hold::Slides;
        } else if rests && resists > 0.0 {
            on.hold = Hold::Rests;
        }
    }

    /// Rolls for so long at most; gives how long it did: v̇ = a_t/(1 + k) − μ_R a_n v̂, ω = n×v/R + ω_n n.
    fn roll(&mut self, on: &mut OnFace, forces: &[Force], left: f64, tolerance: f64) -> f64 {
        let (ball, normal, rolling) = (*self, on.normal, on.law.rolling);
        let used = if rolling == 0.0 {
            let rate = |[dx, dv, ..]: [DVec3; 4]| {
                let drive = ball.load(normal, forces, dx, dv).along / (1.0 + INERTIA);
                [ball.velocity.value + dv, drive, DVec3::ZERO, DVec3::X]
            };
            let (length, [dx, dv, ..]) = ball.piece(left, tolerance, ball.velocity.value, &rate);
            self.change(dx, dv, DVec3::ZERO);
            length
        } else {
            self.roll_to_rest(on, forces, left, tolerance)
        };
        let about = self.spin.dot(normal) * normal;
        self.spin = normal.cross(self.velocity.value) / self.radius + about;
        let before = on.hold;
        self.rolls_on(on, forces);
        if before == Hold::Rolls && on.hold == Hold::Slides {
            on.end = Some(End::SlippedAnew);
        }
        used
    }

    fn roll_to_rest(&mut self, on: &OnFace, forces: &[Force], left: f64, tolerance: f64) -> f64 {
        let (normal, law) = (on.normal, on.law);
        if self.velocity.value == DVec3::ZERO {
            let load = self.load(normal, forces, DVec3::ZERO, DVec3::ZERO);
            let drive = load.along / (1.0 + INERTIA);
            let downhill = drive.normalize_or_zero();
            let push = (drive - resistance(on.law, &load) * downhill) * (BEGINNING * left);
            self.change(push * (BEGINNING * left / 2.0), push, DVec3::ZERO);
            return BEGINNING * left;
        }
        let ball = *self;
        let rate = |[dx, dv, ..]: [DVec3; 4]| {
            let load = ball.load(normal, forces, dx, dv);
            let v = ball.velocity.value + dv;
            let stretch = v.length() / resistance(law, &load);
            [v * stretch, load.along * (stretch / (1.0 + INERTIA)) - v, DVec3::ZERO, DVec3::X * stretch]
        };
        let [dx, dv, _, time] = ball.stretched(left, tolerance, ball.velocity.value, rate);
        self.change(dx, dv, DVec3::ZERO);
        let v = self.velocity.value;
        if v.length() > LAST * on.fastest {
            return time.x;
        }
        let load = self.load(normal, forces, DVec3::ZERO, DVec3::ZERO);
        let slows = resistance(law, &load) - load.along.dot(v.normalize_or_zero()) / (1.0 + INERTIA);
        let rest = v.length() / slows;
        self.change(v * (rest / 2.0), -v, DVec3::ZERO);
        time.x + rest
    }

    fn change(&mut self, dx: DVec3, dv: DVec3, dspin: DVec3) {
        self.position = self.position.plus(dx);
        self.velocity = self.velocity.plus(dv);
        self.spin += dspin;
    }

    /// One step in the stretched time, or to the end of the time that is left: the last of the four changes is the time.
    fn stretched(
        &self,
        left: f64,
        tolerance: f64,
        start: DVec3,
        rate: impl Fn([DVec3; 4]) -> [DVec3; 4],
    ) -> [DVec3; 4] {
        let rounding = 4.0 * f64::EPSILON * left;
        let (mut length, mut changes) = self.piece(STRETCH, tolerance, start, &rate);
        let mut over = changes[3].x - left;
        if over <= rounding {
            return changes;
        }
        // Newton's method, with the rate of the time at the end.
        for _ in 0..MOST_TRIES {
            let next = length - over / rate(changes)[3].x;
            length = if next > 0.0 { next.min(STRETCH) } else { length / 2.0 };
            (length, changes) = self.piece(length, tolerance, start, &rate);
            over = changes[3].x - left;
            if over.abs() <= rounding {
                break;
            }
        }
        changes
    }

    /// A step of this length, or half of it and so on, with its length: changes of the place, of a vector with this start, of
    /// a third one and of the time.
    fn piece(
        &self,
        length: f64,
        tolerance: f64,
        start: DVec3,
        rate: &impl Fn([DVec3; 4]) -> [DVec3; 4],
    ) -> (f64, [DVec3; 4]) {
        let speed = self.fastest();
        let converged = |new: [DVec3; 4], old: [DVec3; 4]| {
            let time = new[3].x.abs();
            let scales = [speed * time, start.length() + new[1].length(), speed + new[2].length(), time];
            (0..4).all(|i| (new[i] - old[i]).length() <= tolerance * scales[i])
        };
        let mut length = length;
        for depth in 0..=DEPTH {
            if let Some(changes) = extrapolated(length, depth == DEPTH, rate, converged) {
                return (length, changes);
            }
            length /= 2.0;
        }
        (length, [DVec3::ZERO; 4])
    }
}
