//! Gauss–Legendre quadrature, for work and impulse along a segment.

/// Positive nodes and weights of the 8-point rule on [−1, 1] (Abramowitz & Stegun, table 25.4).
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// ∫ f dt from `from` to `to`, exact for polynomials up to degree 15.
pub(in crate::sim) fn integrate<T>(from: f64, to: f64, zero: T, mut f: impl FnMut(f64) -> T) -> T
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let middle = 0.5 * (from + to);
    let half = 0.5 * (to - from);
    let mut sum = zero;
    for (node, weight) in NODES {
        sum = sum + (f(middle - half * node) + f(middle + half * node)) * weight;
    }
    sum * half
}
