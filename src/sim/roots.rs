//! Roots of parabolas, in the form that does not cancel.

/// First τ ≥ 0 at which distance + rate·τ + ½·bend·τ² is no longer above zero and falls; `None` if never.
/// A negative distance counts as zero.
#[inline]
pub(super) fn first_root(distance: f64, rate: f64, bend: f64) -> Option<f64> {
    if distance <= 0.0 && rate < 0.0 {
        return Some(0.0);
    }
    let distance = distance.max(0.0);
    if bend < 0.0 {
        let root = (rate * rate - 2.0 * bend * distance).sqrt();
        return Some(if rate < 0.0 { 2.0 * distance / (root - rate) } else { (rate + root) / -bend });
    }
    if bend == 0.0 {
        return (rate < 0.0).then(|| distance / -rate);
    }
    let discriminant = rate * rate - 2.0 * bend * distance;
    (rate < 0.0 && discriminant >= 0.0).then(|| 2.0 * distance / (discriminant.sqrt() - rate))
}
