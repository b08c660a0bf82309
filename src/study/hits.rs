//! Impacts of a run against those of the reference: which are missing, which are wrong.

/// Who met when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairImpact {
    /// s.
    pub time: f64,
    /// Indices in the scene's bodies, in any order.
    pub bodies: [usize; 2],
}

/// What two lists of impacts differ in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Differences {
    /// In the reference alone.
    pub missed: u64,
    /// In the run alone.
    pub wrong: u64,
    /// Time of the first of them, s.
    pub first: Option<f64>,
}

/// Impacts of one pair closer in time than this, s, are one: a group may be resolved in several rows.
const SAME_INSTANT: f64 = 1e-10;

/// Matches, pair by pair in order of time, impacts at most `window` apart. Those after `until` may be
/// partners but are not counted themselves.
pub fn compare(run: &[PairImpact], reference: &[PairImpact], until: f64, window: f64) -> Differences {
    let (run, reference) = (by_pair(run), by_pair(reference));
    let mut differences = Differences::default();
    let mut count = |time: f64, counter: fn(&mut Differences) -> &mut u64| {
        if time <= until {
            *counter(&mut differences) += 1;
            differences.first = Some(differences.first.map_or(time, |first| first.min(time)));
        }
    };
    let (mut left, mut right) = (run.iter().peekable(), reference.iter().peekable());
    loop {
        match (left.peek(), right.peek()) {
            (Some(own), Some(expected)) => {
                let is_same_pair = own.bodies == expected.bodies;
                if is_same_pair && (own.time - expected.time).abs() <= window {
                    left.next();
                    right.next();
                } else if (own.bodies, own.time) < (expected.bodies, expected.time) {
                    count(own.time, |d| &mut d.wrong);
                    left.next();
                } else {
                    count(expected.time, |d| &mut d.missed);
                    right.next();
                }
            }
            (Some(own), None) => {
                count(own.time, |d| &mut d.wrong);
                left.next();
            }
            (None, Some(expected)) => {
                count(expected.time, |d| &mut d.missed);
                right.next();
            }
            (None, None) => return differences,
        }
    }
}

fn by_pair(hits: &[PairImpact]) -> Vec<PairImpact> {
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut hits: Vec<PairImpact> =
        hits.iter().map(|hit| PairImpact { bodies: sorted(hit.bodies), ..*hit }).collect();
    hits.sort_by(|left, right| left.bodies.cmp(&right.bodies).then(left.time.total_cmp(&right.time)));
    hits.dedup_by(|next, kept| next.bodies == kept.bodies && next.time - kept.time <= SAME_INSTANT);
    hits
}
