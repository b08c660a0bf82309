//! Impacts of a run against those of the reference: which are missing, which are wrong.

use glam::DVec3;

/// Who met when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairImpact {
    /// s.
    pub time: f64,
    /// Indices in the scene's bodies, in any order.
    pub bodies: [usize; 2],
    /// Of a ball that met what stands still.
    pub onto: Option<Onto>,
}

/// How a ball met what stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onto {
    /// Index in the scene's bodies.
    pub ball: usize,
    /// Unit vector from the ball to where it met that.
    pub towards: DVec3,
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

/// Directions closer than this, in radians, are one: a ball that meets the edge of two walls meets either or both.
const SAME_DIRECTION: f64 = 1e-3;

/// Matches, pair by pair in order of time, impacts at most `window` apart. Those after `until` may be
/// partners but are not counted themselves, nor is one of a ball that the other list has from that direction at that time,
/// with another body.
pub fn compare(run: &[PairImpact], reference: &[PairImpact], until: f64, window: f64) -> Differences {
    let (run, reference) = (by_pair(run), by_pair(reference));
    let (run_by_ball, reference_by_ball) = (by_ball(&run), by_ball(&reference));
    let mut differences = Differences::default();
    let mut count =
        |hit: &PairImpact, others: &[(Onto, PairImpact)], counter: fn(&mut Differences) -> &mut u64| {
            let time = hit.time;
            if time <= until && !is_shared(hit, others, window) {
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
                    count(own, &reference_by_ball, |d| &mut d.wrong);
                    left.next();
                } else {
                    count(expected, &run_by_ball, |d| &mut d.missed);
                    right.next();
                }
            }
            (Some(own), None) => {
                count(own, &reference_by_ball, |d| &mut d.wrong);
                left.next();
            }
            (None, Some(expected)) => {
                count(expected, &run_by_ball, |d| &mut d.missed);
                right.next();
            }
            (None, None) => return differences,
        }
    }
}

/// Whether the impact of a ball is among others on another body that it met at the same place.
fn is_shared(hit: &PairImpact, others: &[(Onto, PairImpact)], window: f64) -> bool {
    let Some(Onto { ball, towards }) = hit.onto else { return false };
    let first = others.partition_point(|(onto, other)| (onto.ball, other.time) < (ball, hit.time - window));
    others[first..]
        .iter()
        .take_while(|(onto, other)| onto.ball == ball && other.time <= hit.time + window)
        .any(|(onto, other)| {
            other.bodies != hit.bodies && (onto.towards - towards).length() <= SAME_DIRECTION
        })
}

/// Those on what stands still, by ball and time.
fn by_ball(hits: &[PairImpact]) -> Vec<(Onto, PairImpact)> {
    let mut hits: Vec<_> = hits.iter().filter_map(|hit| Some((hit.onto?, *hit))).collect();
    hits.sort_by(|(left, one), (right, other)| {
        left.ball.cmp(&right.ball).then(one.time.total_cmp(&other.time))
    });
    hits
}

fn by_pair(hits: &[PairImpact]) -> Vec<PairImpact> {
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut hits: Vec<PairImpact> =
        hits.iter().map(|hit| PairImpact { bodies: sorted(hit.bodies), ..*hit }).collect();
    hits.sort_by(|left, right| left.bodies.cmp(&right.bodies).then(left.time.total_cmp(&right.time)));
    hits.dedup_by(|next, kept| next.bodies == kept.bodies && next.time - kept.time <= SAME_INSTANT);
    hits
}
