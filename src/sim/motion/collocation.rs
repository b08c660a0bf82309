//! The polynomials of a Gauss–Radau step: an acceleration given at eight nodes as a series in powers.

use glam::DVec3;

use super::tolerance::LONGEST_GUESS;
use crate::sim::segment::{SERIES, Series};

/// Left Radau nodes on [0, 1]: 0 and the zeros of a Jacobi polynomial (Everhart 1985, table 1).
#[allow(clippy::excessive_precision, reason = "the digits as published; the compiler rounds them")]
pub(super) const NODES: [f64; SERIES + 1] = [
    0.0,
    0.056_262_560_536_922_146_465_652_191_031_8,
    0.180_240_691_736_892_364_987_579_942_780,
    0.352_624_717_113_169_637_373_907_769_648,
    0.547_153_626_330_555_383_001_448_554_766,
    0.734_210_177_215_410_531_523_210_605_558,
    0.885_320_946_839_095_768_090_359_771_030,
    0.977_520_613_561_287_501_891_174_488_626,
];

/// `TO_POWERS[n][i]`: coefficient of s^(i+1) in s(s−h₁)…(s−hₙ), which turns divided differences into b.
const TO_POWERS: [[f64; SERIES]; SERIES] = to_powers();

const fn to_powers() -> [[f64; SERIES]; SERIES] {
    let mut table = [[0.0; SERIES]; SERIES];
    table[0][0] = 1.0;
    let mut n = 1;
    while n < SERIES {
        let mut i = 0;
        while i <= n {
            let raised = if i > 0 { table[n - 1][i - 1] } else { 0.0 };
            table[n][i] = raised - NODES[n] * table[n - 1][i];
            i += 1;
        }
        n += 1;
    }
    table
}

/// Reciprocals of the spacings, `SPACINGS[n][k]` = 1/(hₙ − hₖ): a product is several times quicker than a
/// quotient.
static SPACINGS: [[f64; SERIES]; SERIES + 1] = {
    let mut table = [[0.0; SERIES]; SERIES + 1];
    let mut n = 1;
    while n <= SERIES {
        let mut k = 0;
        while k < n {
            table[n][k] = 1.0 / (NODES[n] - NODES[k]);
            k += 1;
        }
        n += 1;
    }
    table
};

/// Weights of b[k] at each node: hₙ^(k+1)/((k+2)(k+3)) for the position, hₙ^(k+1)/(k+2) for the velocity.
static WEIGHTS: [[(f64, f64); SERIES]; SERIES + 1] = {
    let mut table = [[(0.0, 0.0); SERIES]; SERIES + 1];
    let mut n = 0;
    while n <= SERIES {
        let (mut power, mut k) = (NODES[n], 0);
        while k < SERIES {
            table[n][k] = (power / ((k + 2) * (k + 3)) as f64, power / (k + 2) as f64);
            power *= NODES[n];
            k += 1;
        }
        n += 1;
    }
    table
};

/// [`Series::position_term`] and [`Series::velocity_term`] at a node, summed from the smallest term up.
pub(super) fn terms_at(series: &Series, node: usize) -> (DVec3, DVec3) {
    let (mut position, mut velocity) = (DVec3::ZERO, DVec3::ZERO);
    for (b, (for_position, for_velocity)) in series.b.iter().zip(&WEIGHTS[node]).rev() {
        position += *for_position * b;
        velocity += *for_velocity * b;
    }
    (position, velocity)
}

/// Divided differences of a body's accelerations at the nodes.
pub(super) struct Differences([DVec3; SERIES]);

impl Differences {
    /// Those of a series given by powers: inverts [`TO_POWERS`], which is unit triangular.
    pub fn of(series: &Series) -> Self {
        let mut g = series.b;
        for n in (0..SERIES).rev() {
            for i in 0..n {
                let top = g[n];
                g[i] -= TO_POWERS[n][i] * top;
            }
        }
        Self(g)
    }

    /// Puts what the acceleration at node `n` has risen by since the start into the series; gives the change
    /// of the n-th coefficient.
    pub fn update(&mut self, series: &mut Series, n: usize, rise: DVec3) -> DVec3 {
        let mut value = rise * SPACINGS[n][0];
        for (difference, spacing) in self.0.iter().zip(&SPACINGS[n][1..n]) {
            value = (value - difference) * *spacing;
        }
        let delta = value - self.0[n - 1];
        self.0[n - 1] = value;
        for (b, power) in series.b.iter_mut().zip(TO_POWERS[n - 1]).take(n) {
            *b += power * delta;
        }
        delta
    }
}

/// The same polynomial, seen from the end of its step and scaled to a step `q` times as long.
pub(super) fn extrapolate(series: &Series, q: f64) -> Series {
    if q > LONGEST_GUESS {
        return Series::default();
    }
    // a(1 + s) = Σ b_k (1 + s)^(k+1): binomial expansion, without the constant term.
    let mut shifted = Series::default();
    let mut power = 1.0;
    for i in 0..SERIES {
        power *= q;
        let mut sum = DVec3::ZERO;
        let mut binomial = 1.0; // C(k+1, i+1) for k = i
        for k in i..SERIES {
            sum += binomial * series.b[k];
            binomial *= (k + 2) as f64 / (k + 1 - i) as f64;
        }
        shifted.b[i] = power * sum;
    }
    shifted
}

/// The beginning of a polynomial: the same over `share` of its step.
pub(super) fn beginning(series: &Series, share: f64) -> Series {
    let mut part = *series;
    let mut power = 1.0;
    for b in &mut part.b {
        power *= share;
        *b *= power;
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Series {
        let mut series = Series::default();
        for (k, b) in series.b.iter_mut().enumerate() {
            *b = DVec3::new(1.0, -0.5, 0.25) / (k + 1) as f64;
        }
        series
    }

    #[test]
    fn accelerations_at_the_nodes_give_their_polynomial_back() {
        let (expected, mut found) = (sample(), Series::default());
        let mut differences = Differences::of(&found);
        for (n, node) in NODES.iter().enumerate().skip(1) {
            differences.update(&mut found, n, expected.acceleration_term(*node));
        }
        // A coefficient is a sum of accelerations, here of 3 at most, with weights whose sizes add up to 4.7e4.
        let rounding = 4.7e4 * f64::EPSILON * 3.0 * 3_f64.sqrt();
        for (expected, found) in expected.b.iter().zip(&found.b) {
            assert!((*expected - *found).length() <= rounding, "{expected} {found}");
        }
        let again = Differences::of(&found);
        assert!((again.0[SERIES - 1] - differences.0[SERIES - 1]).length() <= 1e-12);
    }

    #[test]
    fn parts_and_continuations_are_the_same_polynomial() {
        let series = sample();
        let (part, further) = (beginning(&series, 0.3), extrapolate(&series, 0.5));
        for s in [0.1, 0.7, 1.0] {
            let off = part.acceleration_term(s) - series.acceleration_term(0.3 * s);
            assert!(off.length() <= 1e-15, "{s}: {off}");
            let rise = series.acceleration_term(1.0 + 0.5 * s) - series.acceleration_term(1.0);
            assert!((further.acceleration_term(s) - rise).length() <= 1e-13 * rise.length(), "{s}");
        }
    }
}
