//! What really happens, as far as it can be known: two runs of the reference that work differently, side by
//! side. Where they part, nothing is known any more.

use std::time::{Duration, Instant};

use glam::DVec3;

use super::hits::Onto;
use super::reference::{Ball, Impact, Reference, ReferenceSettings, Step};
use super::{Control, Horizon, HorizonCause, PairImpact, StudySettings};
use crate::scene::Scene;

/// The reference at one time.
#[derive(Clone, Debug)]
pub struct TruthSample {
    /// s.
    pub time: f64,
    /// Centre (m) and velocity (m/s) of each dynamic body, in the order of the file.
    pub states: Vec<(DVec3, DVec3)>,
    /// The largest position error so far that the reference admits, m.
    pub error: f64,
}

/// The reference's account of a scene, up to its horizon.
#[derive(Clone, Debug)]
pub struct Truth {
    pub samples: Vec<TruthSample>,
    pub hits: Vec<PairImpact>,
    pub horizon: Horizon,
}

/// Two sample times this close, relative to the time, are one.
const SAME_TIME: f64 = 1e-12;

impl Truth {
    /// Runs the reference to each of these times, as far as it can be trusted.
    pub fn find(scene: &Scene, times: &[f64], settings: &StudySettings, control: &mut Control) -> Self {
        let deadline = Instant::now() + Duration::from_secs_f64(settings.reference_limit.min(1e9));
        let mut truth = Self {
            samples: Vec::new(),
            hits: Vec::new(),
            horizon: Horizon { time: 0.0, cause: HorizonCause::WholeRun, error: 0.0, impacts: 0 },
        };
        let runs =
            [ReferenceSettings::default(), ReferenceSettings::check()].map(|how| Reference::new(scene, how));
        let [mut main, mut check] = match runs {
            [Ok(main), Ok(check)] => [main, check],
            [Err(error), _] | [_, Err(error)] => {
                truth.horizon.cause = HorizonCause::Unknown(error.to_string());
                return truth;
            }
        };
        let mut unused = Vec::new();
        for time in merged(times) {
            control.show(time / settings.until);
            let outcome = advance(&mut main, time, &mut truth.hits, deadline, control)
                .and_then(|()| advance(&mut check, time, &mut unused, deadline, control));
            let error = truth.horizon.error.max(distance(&main, &check));
            truth.horizon.cause = match outcome {
                Err(cause) => cause,
                Ok(()) if error > settings.trusted_error => HorizonCause::ReferenceError,
                Ok(()) => {
                    truth.horizon = Horizon { time, error, ..truth.horizon };
                    truth.samples.push(TruthSample { time, states: states(main.balls()), error });
                    continue;
                }
            };
            break;
        }
        truth.horizon.impacts = truth.hits.iter().filter(|hit| hit.time <= truth.horizon.time).count();
        truth
    }

    /// Whether an impact of the reference lies within `window` of a time.
    pub(super) fn is_near_hit(&self, time: f64, window: f64) -> bool {
        let next = self.hits.partition_point(|hit| hit.time < time - window);
        self.hits.get(next).is_some_and(|hit| hit.time <= time + window)
    }

    /// The sample at this time, if it was asked for and lies before the horizon.
    pub fn at(&self, time: f64) -> Option<&TruthSample> {
        let nth = self.samples.partition_point(|sample| sample.time < time * (1.0 - 2.0 * SAME_TIME));
        self.samples.get(nth).filter(|sample| (sample.time - time).abs() <= 2.0 * SAME_TIME * time)
    }
}

/// In order, each once.
fn merged(times: &[f64]) -> Vec<f64> {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    times.dedup_by(|next, kept| *next - *kept <= SAME_TIME * *next);
    times
}

fn advance(
    reference: &mut Reference,
    until: f64,
    hits: &mut Vec<PairImpact>,
    deadline: Instant,
    control: &Control,
) -> Result<(), HorizonCause> {
    loop {
        match reference.step(until) {
            Ok(Step::Flew) => {}
            Ok(Step::Impact(impact)) => {
                let Impact { time, bodies, onto, .. } = impact;
                let onto = onto.map(|(ball, towards)| Onto { ball, towards });
                hits.push(PairImpact { time, bodies, onto });
            }
            Ok(Step::Done) => return Ok(()),
            Err(end) => {
                return Err(HorizonCause::Unknown(format!("the reference ends where {end}")));
            }
        }
        if control.is_cancelled() {
            return Err(HorizonCause::Cancelled);
        }
        if Instant::now() > deadline {
            return Err(HorizonCause::ReferenceLimit);
        }
    }
}

/// How far two runs are apart, at least the rounding of the positions.
fn distance(left: &Reference, right: &Reference) -> f64 {
    let apart = |(a, b): (&Ball, &Ball)| {
        let (a, b) = (a.position.value, b.position.value);
        (a - b).length().max(f64::EPSILON * a.length())
    };
    left.balls().iter().zip(right.balls()).map(apart).fold(0.0, f64::max)
}

fn states(balls: &[Ball]) -> Vec<(DVec3, DVec3)> {
    balls.iter().map(|ball| (ball.position.value, ball.velocity.value)).collect()
}
