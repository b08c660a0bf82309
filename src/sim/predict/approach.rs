//! When a ball comes near a point, a line or a plane, by root isolation (Lane & Riesenfeld 1981).
//!
//! Along segments the way P from the feature to the centre of the ball is a polynomial, and so are |P|² − R² and
//! P·Ṗ. A polynomial lies between the least and the largest of its Bernstein coefficients. So a piece of time is
//! passed if either polynomial is seen not to fall below its bound in it: the surfaces are apart, or do not come
//! nearer. Else it is halved, until nothing moves in it that could be measured.

use glam::DVec3;

use super::advance::Skip;
use crate::sim::roots::first_root;
use crate::sim::segment::{Path, SERIES};
use crate::sim::tolerance::{MOST_PIECES, SLACKS_BEFORE_CONTACT};

/// Coefficients of a position, at most.
const TERMS: usize = SERIES + 3;
/// Those of the square of one.
const SQUARE_TERMS: usize = 2 * TERMS - 1;

/// A polynomial way Σ c[k] sᵏ in a piece of time, with s from 0 to 1, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub c: [DVec3; TERMS],
    /// How many there are.
    pub terms: usize,
}

/// The way from what is nearest of another body to the centre of a ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct Across {
    pub way: Way,
    /// What P·Ṗ may be less than that of the way, m² per piece.
    pub less: f64,
}

/// What a search is about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach {
    pub from: f64,
    pub until: f64,
    /// The surfaces touch at |P| = reach, m.
    pub reach: f64,
    /// Distance now, m.
    pub distance: f64,
    /// Speeds up to this neither close nor part, m/s.
    pub still: f64,
    /// As of [`super::advance::Span`], m.
    pub slack: f64,
}

impl Approach {
    /// Down to which distance the way is passed, m: to shortly before contact from afar, to the contact itself from
    /// there; what touches meets again a slack deeper.
    fn level(&self) -> f64 {
        let near = SLACKS_BEFORE_CONTACT * self.slack;
        if self.distance > 2.0 * near {
            near
        } else if self.distance > self.slack {
            0.0
        } else {
            self.distance.min(0.0) - self.slack
        }
    }

    /// Up to when there is no contact. `across` gives the way in a piece of time from its start and length.
    pub fn skip(&self, across: impl Fn(f64, f64) -> Across) -> Skip {
        let level = self.level();
        let length = self.until - self.from;
        if !length.is_finite() {
            return Skip::Unknown;
        }
        let (mut at, mut span) = (0.0, length);
        for _ in 0..MOST_PIECES {
            let across = across(self.from + at, span);
            if across.is_free(self.reach, level, self.still * span) {
                at += span;
                if at >= length {
                    return Skip::Never;
                }
                span = (2.0 * span).min(length - at);
                continue;
            }
            let is_short = self.from + (at + 0.5 * span) <= self.from + at;
            if is_short || across.way.motion() <= self.slack {
                return Skip::To(self.from + at);
            }
            span *= 0.5;
        }
        Skip::To(self.from + at)
    }
}

impl Across {
    /// Whether in this piece the surfaces are farther apart than `level`, or come nearer by no more than `still`, m.
    fn is_free(&self, reach: f64, level: f64, still: f64) -> bool {
        let unit = power_of_two(self.way.size().max(reach));
        let way = self.way.scaled(1.0 / unit);
        let (reach, level, still) = (reach / unit, level / unit, still / unit);
        let (mut square, terms) = way.dot(&way);
        let (start, bound) = (way.c[0].length(), (reach + level).max(0.0));
        square[0] = (start - bound) * (start + bound);
        if range(&square[..terms]).0 > 0.0 {
            return true;
        }
        let (mut rate, terms) = way.dot(&way.derivative());
        rate[0] += still * reach - self.less / unit / unit;
        range(&rate[..terms]).0 >= 0.0
    }
}

impl Way {
    /// The way of a body from a time on, in a piece of `span`, s.
    pub fn of(path: Path<'_>, from: f64, span: f64) -> Self {
        let segment = path.segment;
        let mut c = [DVec3::ZERO; TERMS];
        (c[0], c[1]) = (path.position(from), span * path.velocity(from));
        let Some(series) = path.series else {
            c[2] = (0.5 * span * span) * segment.a;
            return Self { c, terms: 3 };
        };
        let mut drive = [segment.a; SERIES + 1];
        drive[1..].copy_from_slice(&series.b);
        shift(&mut drive, (from - segment.start) / segment.step);
        // From the power of the time in steps to that in pieces, and twice the integral.
        let mut weight = span * span;
        for (k, part) in drive.iter().enumerate() {
            c[k + 2] = (weight / ((k + 1) * (k + 2)) as f64) * *part;
            weight *= span / segment.step;
        }
        Self { c, terms: TERMS }
    }

    /// Another way less this one.
    pub fn to(&self, other: &Self) -> Self {
        let mut c = other.c;
        c.iter_mut().zip(&self.c).for_each(|(to, from)| *to -= *from);
        Self { c, terms: self.terms.max(other.terms) }
    }

    /// Every coefficient as `change` gives it.
    pub fn map(&self, change: impl Fn(DVec3) -> DVec3) -> Self {
        Self { c: self.c.map(change), terms: self.terms }
    }

    /// Least and largest value that one coordinate may take.
    pub fn range(&self, axis: usize) -> (f64, f64) {
        range(&self.c.map(|c| c[axis])[..self.terms])
    }

    pub fn derivative(&self) -> Self {
        let mut c = [DVec3::ZERO; TERMS];
        for k in 1..self.terms {
            c[k - 1] = k as f64 * self.c[k];
        }
        Self { c, terms: self.terms - 1 }
    }

    fn scaled(&self, factor: f64) -> Self {
        self.map(|c| factor * c)
    }

    fn dot(&self, other: &Self) -> ([f64; SQUARE_TERMS], usize) {
        let mut product = [0.0; SQUARE_TERMS];
        for (i, a) in self.c[..self.terms].iter().enumerate() {
            for (j, b) in other.c[..other.terms].iter().enumerate() {
                product[i + j] += a.dot(*b);
            }
        }
        (product, self.terms + other.terms - 1)
    }

    fn size(&self) -> f64 {
        self.c.iter().fold(0.0, |size, c| c.abs().max_element().max(size))
    }

    /// Upper bound of how far the way leads from its start.
    fn motion(&self) -> f64 {
        self.c[1..].iter().map(|c| c.length()).sum()
    }
}

/// Least and largest Bernstein coefficient of Σ c[k] sᵏ in 0..=1: Σ C(i, k) / C(n, k) c[k]. Anything may be where a
/// piece is so long that the numbers do not reach its end.
fn range(c: &[f64]) -> (f64, f64) {
    let n = c.len() - 1;
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..=n {
        let (mut sum, mut weight) = (0.0, 1.0);
        for (k, part) in c.iter().enumerate().take(i + 1) {
            sum += weight * part;
            weight *= (i - k) as f64 / (n - k).max(1) as f64;
        }
        if sum.is_nan() {
            return (f64::NEG_INFINITY, f64::INFINITY);
        }
        range = (range.0.min(sum), range.1.max(sum));
    }
    range
}

/// Σ c[k] (s + by)ᵏ as a polynomial in s (Horner).
fn shift(c: &mut [DVec3], by: f64) {
    for first in 0..c.len() {
        for k in (first..c.len() - 1).rev() {
            let higher = c[k + 1];
            c[k] += by * higher;
        }
    }
}

/// The time after which a body is out of a reach for ever along a parabola, s:
/// |P| ≥ ½|a|τ² − |v|τ − |p|, and ≥ |v|τ − |p| on a straight line.
pub(super) fn gone_after([p, v, a]: [DVec3; 3], reach: f64) -> f64 {
    let (far, speed, bend) = (p.length() + reach, v.length(), a.length());
    let gone = if bend > 0.0 { first_root(far, speed, -bend) } else { first_root(far, -speed, 0.0) };
    gone.unwrap_or(f64::INFINITY)
}

/// The largest power of two not above a positive number.
fn power_of_two(number: f64) -> f64 {
    f64::from_bits(number.max(f64::MIN_POSITIVE).to_bits() & f64::INFINITY.to_bits())
}
