//! The naive simulator: small steps, every pair in every step, bisection where surfaces cross.

use glam::DVec3;
use polyscene::scene::{Force, Motion, Scene};

use super::flight::{Ball, Sum};
use super::geometry::{Gap, Surface, dynamic_radius, sphere_gap};

/// One impact, as the core's ledger would tell it: `a` has the smaller UserID.
#[derive(Clone, Copy, Debug)]
pub struct Impact {
    pub time: f64,
    pub a: i64,
    pub b: i64,
    pub point: DVec3,
    /// Unit vector from a to b.
    pub normal: DVec3,
    pub impulse: f64,
}

#[derive(Clone, Debug)]
pub struct Reference {
    time: f64,
    /// Kahan's rest of `time`, so that a thousand steps do not add a thousand roundings.
    time_rest: f64,
    pub balls: Vec<Ball>,
    statics: Vec<(i64, f64, Surface)>,
    forces: Vec<Force>,
    /// Longest way of a body in one step, over its radius.
    stride: f64,
}

/// A pair of a ball and another ball or a static, by index.
#[derive(Clone, Copy, Debug)]
enum Pair {
    Balls(usize, usize),
    Static(usize, usize),
}

/// Places at which a step looks at every pair.
const LOOKS: usize = 4;
/// Halvings of an interval: from 0.1 s to less than an ulp.
const HALVINGS: usize = 70;

impl Reference {
    pub fn new(scene: &Scene) -> Self {
        Self::with_stride(scene, 0.2)
    }

    /// With another step length, to see how much the result owes to it.
    pub fn with_stride(scene: &Scene, stride: f64) -> Self {
        let (mut balls, mut statics) = (Vec::new(), Vec::new());
        for body in &scene.bodies {
            match (body.motion, dynamic_radius(body)) {
                (Motion::Dynamic { mass, velocity }, Some(radius)) => balls.push(Ball {
                    id: body.id,
                    position: Sum::new(body.position),
                    velocity: Sum::new(velocity),
                    radius,
                    mass,
                    bounce: body.bounce,
                }),
                _ => statics.push((body.id, body.bounce, Surface::of(body))),
            }
        }
        Self { time: 0.0, time_rest: 0.0, balls, statics, forces: scene.forces.clone(), stride }
    }

    pub fn energy(&self) -> f64 {
        self.balls.iter().map(|ball| ball.energy(&self.forces)).sum()
    }

    pub fn ball(&self, id: i64) -> &Ball {
        self.balls.iter().find(|ball| ball.id == id).unwrap_or_else(|| panic!("no ball {id}"))
    }

    /// The next impact not after `until`, or `None`: then the time is `until`.
    pub fn next_impact(&mut self, until: f64) -> Option<Impact> {
        while self.time < until {
            let duration = self.step_length().min((until - self.time) - self.time_rest);
            let looks: Vec<Vec<Ball>> =
                (0..=LOOKS).map(|k| self.flown(duration * k as f64 / LOOKS as f64)).collect();
            let hit = self
                .pairs()
                .into_iter()
                .filter_map(|pair| self.first_contact(pair, duration, &looks).map(|after| (after, pair)))
                .min_by(|left, right| left.0.total_cmp(&right.0));
            let Some((after, pair)) = hit else {
                self.go(duration);
                continue;
            };
            self.go(after);
            return Some(self.respond(pair));
        }
        None
    }

    /// All impacts up to `until`.
    pub fn impacts(&mut self, until: f64) -> Vec<Impact> {
        std::iter::from_fn(|| self.next_impact(until)).collect()
    }

    fn go(&mut self, duration: f64) {
        self.balls = self.flown(duration);
        let small = duration + self.time_rest;
        let time = self.time + small;
        self.time_rest = small - (time - self.time);
        self.time = time;
    }

    fn flown(&self, duration: f64) -> Vec<Ball> {
        self.balls.iter().map(|ball| ball.flown(&self.forces, duration)).collect()
    }

    /// So long that no ball goes further than `stride` radii, with room for acceleration.
    fn step_length(&self) -> f64 {
        let time_to_go = |ball: &Ball| {
            let acceleration = ball.acceleration_now(&self.forces).length();
            let way = self.stride * ball.radius;
            let by_speed = way / ball.velocity.value.length();
            let by_force = (way / acceleration).sqrt();
            by_speed.min(by_force).min(0.05)
        };
        self.balls.iter().map(time_to_go).fold(0.05, f64::min)
    }

    fn pairs(&self) -> Vec<Pair> {
        let mut pairs = Vec::new();
        for i in 0..self.balls.len() {
            pairs.extend((i + 1..self.balls.len()).map(|j| Pair::Balls(i, j)));
            pairs.extend((0..self.statics.len()).map(|j| Pair::Static(i, j)));
        }
        pairs
    }

    /// The gap of a pair and the rate at which it opens.
    fn gap(&self, pair: Pair, balls: &[Ball]) -> (Gap, f64) {
        let (gap, velocity) = match pair {
            Pair::Balls(i, j) => {
                let (a, b) = (&balls[i], &balls[j]);
                let gap = sphere_gap(a.position.value, a.radius, b.position.value, b.radius);
                (gap, b.velocity.value - a.velocity.value)
            }
            Pair::Static(i, j) => {
                let ball = &balls[i];
                (self.statics[j].2.gap(ball.position.value, ball.radius), -ball.velocity.value)
            }
        };
        (gap, velocity.dot(gap.towards))
    }

    /// When, counted from the start of a step, a pair first touches while closing.
    fn first_contact(&self, pair: Pair, duration: f64, looks: &[Vec<Ball>]) -> Option<f64> {
        let at = |k: usize| duration * k as f64 / LOOKS as f64;
        let mut before = self.gap(pair, &looks[0]);
        if before.0.distance > 4.0 * self.reach(pair) {
            return None;
        }
        for (k, look) in looks.iter().enumerate().skip(1) {
            let after = self.gap(pair, look);
            let contact = self.contact_between(pair, (at(k - 1), before), (at(k), after));
            if contact.is_some() {
                return contact;
            }
            before = after;
        }
        None
    }

    /// Further than this no ball of the pair goes in one step.
    fn reach(&self, pair: Pair) -> f64 {
        let radius = match pair {
            Pair::Balls(i, j) => self.balls[i].radius + self.balls[j].radius,
            Pair::Static(i, _) => self.balls[i].radius,
        };
        self.stride * radius
    }

    fn contact_between(&self, pair: Pair, from: (f64, (Gap, f64)), to: (f64, (Gap, f64))) -> Option<f64> {
        let (start, (gap_start, rate_start)) = from;
        let (end, (gap_end, rate_end)) = to;
        let is_open = |t: f64| self.gap_after(pair, t).0 > 0.0;
        let is_opening = |t: f64| self.gap_after(pair, t).1 > 0.0;
        // A pair that parts from its last impact is looked at from where its gap is widest.
        let open = if gap_start.distance > 0.0 && rate_start <= 0.0 {
            start
        } else if rate_start > 0.0 && rate_end < 0.0 {
            bisect(start, end, is_opening).0
        } else if gap_start.distance > 0.0 {
            start
        } else {
            return None;
        };
        let closed = if gap_end.distance <= 0.0 {
            end
        } else if rate_start < 0.0 && rate_end > 0.0 {
            // It may have touched in between: look where the gap is narrowest.
            bisect(start, end, |t| !is_opening(t)).1
        } else {
            return None;
        };
        (is_open(open) && !is_open(closed)).then(|| bisect(open, closed, is_open).1)
    }

    /// Gap and opening rate of a pair some time after the start of the step.
    fn gap_after(&self, pair: Pair, after: f64) -> (f64, f64) {
        let mut balls = Vec::new();
        let indices = match pair {
            Pair::Balls(i, j) => vec![i, j],
            Pair::Static(i, _) => vec![i],
        };
        for &index in &indices {
            balls.push(self.balls[index].flown(&self.forces, after));
        }
        let local = match pair {
            Pair::Balls(..) => Pair::Balls(0, 1),
            Pair::Static(_, j) => Pair::Static(0, j),
        };
        let (gap, rate) = self.gap(local, &balls);
        (gap.distance, rate)
    }

    /// Exchanges momentum along the normal: v' = v ± J n / m with J = (1+e) μ |v_n|.
    fn respond(&mut self, pair: Pair) -> Impact {
        let (gap, rate) = self.gap(pair, &self.balls);
        let (i, bounce, inverse_mass, other) = match pair {
            Pair::Balls(i, j) => {
                let (a, b) = (&self.balls[i], &self.balls[j]);
                (i, a.bounce * b.bounce, 1.0 / a.mass + 1.0 / b.mass, b.id)
            }
            Pair::Static(i, j) => {
                let a = &self.balls[i];
                (i, a.bounce * self.statics[j].1, 1.0 / a.mass, self.statics[j].0)
            }
        };
        let impulse = (1.0 + bounce) * -rate / inverse_mass;
        let first = &mut self.balls[i];
        first.push(gap.towards * -impulse);
        let (id, point) = (first.id, first.position.value + gap.towards * first.radius);
        if let Pair::Balls(_, j) = pair {
            self.balls[j].push(gap.towards * impulse);
        }
        let sign = if id < other { 1.0 } else { -1.0 };
        Impact {
            time: self.time,
            a: id.min(other),
            b: id.max(other),
            point,
            normal: gap.towards * sign,
            impulse,
        }
    }
}

/// Halves an interval on whose start `holds` is true and on whose end it is not.
fn bisect(start: f64, end: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    let (mut low, mut high) = (start, end);
    for _ in 0..HALVINGS {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) { low = middle } else { high = middle }
    }
    (low, high)
}
