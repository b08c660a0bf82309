//! First contact by conservative advancement (Mirtich 1996, §2.3).
//!
//! The distance d to a convex set is convex, so along a path with |ẍ| ≤ A
//!     d(t+δ) ≥ d(t) + ḋ(t)δ − ½Aδ².
//! Stepping to the first root of the right side never passes a contact, however thin the body or large
//! the step, and converges like Newton's method from the side that does not penetrate.

use super::Gap;

/// Steps before the search hands back the time it has reached, to be looked at again from there.
const MAX_STEPS: u32 = 400;

/// Where a search starts and ends, and what bounds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search {
    pub from: f64,
    pub until: f64,
    /// Upper bound of the relative acceleration, m/s².
    pub acceleration_bound: f64,
    /// Depth to which touching surfaces may part or slide without counting as contact, m.
    pub slack: f64,
}

/// First time in `from..=until` at which the gap is closed and closing, or pressed shut.
///
/// When the search takes too many steps it gives the time reached, which is not later than the contact:
/// whoever handles the event looks at the gap again.
pub(super) fn first_contact(search: Search, gap_at: impl Fn(f64) -> Gap) -> Option<f64> {
    let mut time = search.from;
    for _ in 0..MAX_STEPS {
        let gap = gap_at(time);
        let closing = gap.rate < 0.0 || (gap.rate == 0.0 && gap.bend < 0.0);
        if gap.distance <= 0.0 && closing {
            return Some(time);
        }
        // A parting pair may be a rounding apart or inside: without the slack it would never get away.
        let distance = if closing { gap.distance } else { gap.distance.max(0.0) + search.slack };
        let step = shortest_time_to_close(distance, gap.rate, search.acceleration_bound)?;
        let next = time + step;
        if next > search.until {
            return None;
        }
        if next <= time {
            return Some(time);
        }
        time = next;
    }
    Some(time)
}

/// First positive root of distance + rate·δ − ½·bound·δ², for distance ≥ 0; `None` if there is none.
pub(super) fn shortest_time_to_close(distance: f64, rate: f64, bound: f64) -> Option<f64> {
    let root = (rate * rate + 2.0 * bound * distance).sqrt();
    if rate < 0.0 {
        Some(2.0 * distance / (root - rate))
    } else if bound > 0.0 {
        Some((rate + root) / bound)
    } else {
        None
    }
}
