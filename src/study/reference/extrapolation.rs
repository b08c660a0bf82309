//! One step of differential equations: Gragg's modified midpoint rule, extrapolated to substeps of no length
//! until the digits stop changing (Bulirsch & Stoer 1966).

use glam::DVec3;

/// Rows of the extrapolation table before a step is given up.
const ROWS: usize = 9;

/// Changes of all unknowns over a step of this length; `rate` is asked for at changes from its start. `None` where they do not
/// converge, unless they are wanted `at_any_rate`.
pub(super) fn extrapolated<const N: usize>(
    length: f64,
    at_any_rate: bool,
    rate: impl Fn([DVec3; N]) -> [DVec3; N],
    converged: impl Fn([DVec3; N], [DVec3; N]) -> bool,
) -> Option<[DVec3; N]> {
    let mut row = [[DVec3::ZERO; N]; ROWS];
    for j in 0..ROWS {
        let substeps = 2 * (j + 1);
        let mut next = [[DVec3::ZERO; N]; ROWS];
        next[0] = midpoint(length, substeps, &rate);
        for k in 1..=j {
            // T(j,k) = T(j,k-1) + (T(j,k-1) − T(j−1,k-1)) / ((n_j/n_(j−k))² − 1)
            let ratio = substeps as f64 / (2 * (j - k + 1)) as f64;
            let (new, old) = (next[k - 1], row[k - 1]);
            next[k] = std::array::from_fn(|i| new[i] + (new[i] - old[i]) / (ratio * ratio - 1.0));
        }
        if j > 0 && converged(next[j], next[j - 1]) {
            return Some(next[j]);
        }
        row = next;
    }
    // A number that is no longer finite converges nowhere.
    let last = row[ROWS - 1];
    (at_any_rate || !last.iter().all(|change| change.is_finite())).then_some(last)
}

fn midpoint<const N: usize>(
    length: f64,
    substeps: usize,
    rate: &impl Fn([DVec3; N]) -> [DVec3; N],
) -> [DVec3; N] {
    let h = length / substeps as f64;
    let step = |from: [DVec3; N], rate: [DVec3; N], h: f64| std::array::from_fn(|i| from[i] + rate[i] * h);
    let mut before = [DVec3::ZERO; N];
    let mut now = step(before, rate(before), h);
    for _ in 1..substeps {
        (before, now) = (now, step(before, rate(now), 2.0 * h));
    }
    let last = step(before, rate(now), h);
    std::array::from_fn(|i| (now[i] + last[i]) / 2.0)
}
