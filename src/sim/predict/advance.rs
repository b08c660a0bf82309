//! First contact by conservative advancement (Mirtich 1996, §2.3).
//!
//! The distance d to a convex set lies above its tangent plane at any point. With n the direction away from
//! the set, d(t+δ) ≥ d(t) + ḋ(t)δ + ½ n·ẍ δ² along a parabola, and ≥ d(t) + ḋ(t)δ − ½Aδ² where |ẍ| ≤ A.
//! Stepping to the first root of the right side never passes a contact, however thin the body or long the
//! step, and converges like Newton's method from the side that does not penetrate. Beside a contact that is none
//! it crawls: there the root is isolated first (`approach`).

use super::gap::Gap;
use crate::sim::roots::first_root;
use crate::sim::tolerance::{ADVANCES_BEFORE_SKIP, MOST_ADVANCES};

/// Where a search starts and ends, and what bounds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub from: f64,
    pub until: f64,
    /// Upper bound of the relative acceleration, m/s²; `None` if it is constant, along parabolas.
    pub acceleration_bound: Option<f64>,
    /// Depth to which touching surfaces may part or slide without counting as contact, m.
    pub slack: f64,
}

/// What isolating the root tells about the rest of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Skip {
    /// Nothing.
    Unknown,
    /// No contact before the end.
    Never,
    /// None before this time; perhaps one soon after it.
    To(f64),
}

/// First time in `from..=until` at which the gap is closed and closing, or pressed shut.
///
/// When the search takes too many steps it gives the time reached, which is not later than the contact:
/// whoever handles the event looks at the gap again. `skip` says how it may go on at a time.
pub(super) fn first_contact(
    search: Span,
    gap_at: impl Fn(f64) -> Gap,
    skip: impl Fn(f64) -> Skip,
) -> Option<f64> {
    let mut time = search.from;
    for step in 1..=MOST_ADVANCES {
        let gap = gap_at(time);
        let closing = gap.is_closing();
        if gap.distance <= 0.0 && closing {
            return Some(time);
        }
        let bend = search.acceleration_bound.map_or(gap.drive, |bound| -bound);
        let distance = if closing { gap.distance } else { parting_distance(&gap, bend, search.slack) };
        let mut next = time + first_root(distance, gap.rate, bend)?;
        if step % ADVANCES_BEFORE_SKIP == 0 {
            match skip(time) {
                Skip::Unknown => {}
                Skip::Never => return None,
                Skip::To(later) if later <= time => return Some(time),
                Skip::To(later) => next = next.max(later),
            }
        }
        if !(next <= search.until && next.is_finite()) {
            return None;
        }
        if next <= time {
            return Some(time);
        }
        time = next;
    }
    Some(time)
}

/// From where a parting pair falls back. It may be a rounding inside: if it gets out, it meets again where it
/// would have met; if not, a slack deeper, for without one it would never get away.
fn parting_distance(gap: &Gap, bend: f64, slack: f64) -> f64 {
    let gets_out = gap.rate > 0.0 && gap.rate * gap.rate > 2.0 * bend.abs() * (slack - gap.distance.min(0.0));
    if gets_out { gap.distance } else { gap.distance.max(0.0) + slack }
}
