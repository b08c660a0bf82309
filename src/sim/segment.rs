//! A segment: how one body moves between two events, as a polynomial in the time since its start.

use glam::DVec3;

/// Highest power of the acceleration series of a field segment.
pub(super) const SERIES: usize = 7;

/// Motion of one body from `start` on, valid until `end` (absolute model time, s).
///
/// With τ = t − start:  x(τ) = x + vτ + ½aτ² (+ the series of a field segment, see [`Series`]).
/// Aligned, for predictions read the segments of many bodies and each should cost as few cache lines as it can.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Segment {
    pub start: f64,
    /// Infinite where the closed form holds for ever.
    pub end: f64,
    pub x: DVec3,
    pub v: DVec3,
    pub a: DVec3,
    /// Upper bound of |ẍ| over the whole segment, m/s².
    pub acceleration_bound: f64,
    /// Length of the integrator step whose [`Series`] continues the polynomial; 0 without one.
    pub step: f64,
    /// Whether contact forces took part in it.
    pub constrained: bool,
}

/// The part of a field segment beyond ½aτ². With s = τ/step:
/// ẍ = a + Σ b[k] s^(k+1), so the position is a polynomial of degree 9.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct Series {
    pub b: [DVec3; SERIES],
    /// What the start has beyond the digits of `Segment::x`, m: near an attractor far from the origin the
    /// force needs them.
    pub low: DVec3,
}

impl Segment {
    pub fn ballistic(start: f64, x: DVec3, v: DVec3, a: DVec3) -> Self {
        Self {
            start,
            end: f64::INFINITY,
            x,
            v,
            a,
            acceleration_bound: a.length(),
            step: 0.0,
            constrained: false,
        }
    }

    /// The motion of what never moves.
    pub fn resting(x: DVec3) -> Self {
        Self::ballistic(0.0, x, DVec3::ZERO, DVec3::ZERO)
    }
}

/// A segment with the series that belongs to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path<'a> {
    pub segment: &'a Segment,
    pub series: Option<&'a Series>,
}

impl Path<'_> {
    pub fn position(&self, time: f64) -> DVec3 {
        self.segment.x + self.way(time)
    }

    /// The position, and what it has beyond its own digits.
    pub fn position_split(&self, time: f64) -> (DVec3, DVec3) {
        split(self.segment.x, self.way(time))
    }

    /// How far the body has come since the start of the segment.
    fn way(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        let tau = time - seg.start;
        let base = tau * (seg.v + (0.5 * tau) * seg.a);
        match self.series {
            None => base,
            Some(series) => series.low + (base + (tau * tau) * series.position_term(tau / seg.step)),
        }
    }

    pub fn velocity(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        let tau = time - seg.start;
        let base = seg.v + tau * seg.a;
        match self.series {
            None => base,
            Some(series) => base + tau * series.velocity_term(tau / seg.step),
        }
    }

    pub fn acceleration(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        match self.series {
            None => seg.a,
            Some(series) => seg.a + series.acceleration_term((time - seg.start) / seg.step),
        }
    }
}

/// x + way, and what is lost in that sum.
pub(super) fn split(x: DVec3, way: DVec3) -> (DVec3, DVec3) {
    let sum = x + way;
    // Knuth's exact sum of two, for either may be the larger.
    let of_way = sum - x;
    (sum, (x - (sum - of_way)) + (way - of_way))
}

impl Series {
    /// Σ b[k] s^(k+1) / ((k+2)(k+3)): to be multiplied by τ².
    pub fn position_term(&self, s: f64) -> DVec3 {
        self.horner(s, |k| 1.0 / ((k + 2) * (k + 3)) as f64)
    }

    /// Σ b[k] s^(k+1) / (k+2): to be multiplied by τ.
    pub fn velocity_term(&self, s: f64) -> DVec3 {
        self.horner(s, |k| 1.0 / (k + 2) as f64)
    }

    /// Σ b[k] s^(k+1).
    pub fn acceleration_term(&self, s: f64) -> DVec3 {
        self.horner(s, |_| 1.0)
    }

    /// Upper bound of |Σ b[k] s^(k+1)| for s in 0..=1.
    pub fn bound(&self) -> f64 {
        self.b.iter().map(|b| b.length()).sum()
    }

    fn horner(&self, s: f64, weight: impl Fn(usize) -> f64) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for k in (0..SERIES).rev() {
            sum = s * (sum + weight(k) * self.b[k]);
        }
        sum
    }
}
