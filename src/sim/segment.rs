//! A segment: how one body moves between two events, as a polynomial in the time since its start.

use glam::DVec3;

use super::place::Place;

/// Highest power of the acceleration series of a field segment.
pub(super) const SERIES: usize = 7;

/// Motion of one body from `start` on, valid until `end` (absolute model time, s).
///
/// With τ = t − start:  x(τ) = x + vτ + ½aτ² (+ the series of a field segment, see [`Series`]).
/// Predictions read the segments of many bodies, of most of them no more than straight flight needs: that is the first
/// cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(128))]
pub(super) struct Segment {
    pub start: f64,
    pub x: DVec3,
    pub v: DVec3,
    /// Upper bound of |ẍ| over the whole segment, m/s²; 0 if the flight is straight.
    pub acceleration_bound: f64,
    pub a: DVec3,
    /// Infinite where the closed form holds for ever.
    pub end: f64,
    /// Length of the integrator step whose [`Series`] continues the polynomial; 0 without one.
    pub step: f64,
    /// Length of all that the acceleration is the sum of, m/s²: contact forces may all but cancel the others,
    /// and their rounding stays.
    pub acceleration_size: f64,
    /// Whether contact forces took part in it.
    pub constrained: bool,
}

/// The part of a field segment beyond ½aτ². With s = τ/step:
/// ẍ = a + Σ b[k] s^(k+1), so the position is a polynomial of degree 9.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct Series {
    pub b: [DVec3; SERIES],
    /// What the start has beyond the digits of `Segment::x`, m: see [`Place`].
    pub low: DVec3,
}

impl Segment {
    #[inline]
    pub fn ballistic(start: f64, x: DVec3, v: DVec3, a: DVec3) -> Self {
        Self {
            start,
            end: f64::INFINITY,
            x,
            v,
            a,
            // The square of what is very small is 0.
            acceleration_bound: a.length().max(a.abs().max_element()),
            acceleration_size: a.length(),
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
    #[inline]
    pub fn position(&self, time: f64) -> DVec3 {
        let way = self.way(time);
        self.segment.x + self.series.map_or(way, |series| series.low + way)
    }

    /// The position in all its digits.
    pub fn place(&self, time: f64) -> Place {
        self.start().moved(self.way(time))
    }

    fn start(&self) -> Place {
        Place { x: self.segment.x, low: self.series.map_or(DVec3::ZERO, |series| series.low) }
    }

    /// How far the body has come since the start of the segment.
    #[inline]
    fn way(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        let tau = time - seg.start;
        let base = tau * (seg.v + (0.5 * tau) * seg.a);
        match self.series {
            None => base,
            Some(series) => base + (tau * tau) * series.position_term(tau / seg.step),
        }
    }

    #[inline]
    pub fn velocity(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        let tau = time - seg.start;
        let base = seg.v + tau * seg.a;
        match self.series {
            None => base,
            Some(series) => base + tau * series.velocity_term(tau / seg.step),
        }
    }

    /// Length of what an acceleration on this path is the sum of.
    #[inline]
    pub fn acceleration_size(&self, acceleration: DVec3) -> f64 {
        acceleration.length().max(self.segment.acceleration_size)
    }

    #[inline]
    pub fn acceleration(&self, time: f64) -> DVec3 {
        let seg = self.segment;
        match self.series {
            None => seg.a,
            Some(series) => seg.a + series.acceleration_term((time - seg.start) / seg.step),
        }
    }
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
