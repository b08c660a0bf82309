//! The naive simulator: small steps, every pair in every step, bisection where surfaces cross.

use super::face::Hold;
use super::flight::{Ball, Sum};
use super::geometry::{Surface, SurfaceGap, dynamic_radius, gap_along};
use super::rubbing::{against, mean};
use super::{End, ReferenceSettings, Unsupported};
use crate::scene::{Body, Force, Motion, Roughness, Scene};
use glam::DVec3;

/// One impact, as the core's ledger would report it: `a` has the smaller UserID.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// s.
    pub time: f64,
    /// UserIDs.
    pub a: i64,
    pub b: i64,
    /// Indices of a and b in the scene's bodies.
    pub bodies: [usize; 2],
    /// On the surface, m.
    pub point: DVec3,
    /// Unit vector from a to b.
    pub normal: DVec3,
    /// N·s.
    pub impulse: f64,
    /// Of a ball on what stands still: its index in the scene's bodies, and the unit vector from it to that.
    pub onto: Option<(usize, DVec3)>,
}

/// A ball on a face that ceased to slip, or came to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// s.
    pub time: f64,
    /// UserID.
    pub ball: i64,
    pub hold: Hold,
}

/// What one step of the reference led to.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    /// Nothing was met.
    Flew,
    Impact(Impact),
    /// The time asked for is reached.
    Done,
}

/// A running scene.
#[derive(Clone, Debug)]
pub struct Reference {
    time: f64,
    /// Kahan's rest of `time`, so that a thousand steps do not add a thousand roundings.
    time_rest: f64,
    /// In the order of the file.
    balls: Vec<Ball>,
    statics: Vec<Fixture>,
    forces: Vec<Force>,
    settings: ReferenceSettings,
    changes: Vec<Change>,
    end: Option<End>,
}

#[derive(Clone, Debug)]
struct Fixture {
    id: i64,
    body: usize,
    bounce: f64,
    roughness: Roughness,
    surface: Surface,
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
/// Longest step, s.
const LONGEST: f64 = 0.05;
/// Impacts this close in time, s, may have come in either order, as far as rounding allows to know.
const SAME_INSTANT: f64 = 1e-13;
/// A closing speed below this part of the two speeds that it is the difference of is their rounding: the pair
/// touches in passing. Each of the three products of v·n is rounded, and so is n itself.
const SPEED_ROUNDING: f64 = 8.0 * f64::EPSILON;
/// A ball that is no further from a surface than this part of its coordinates touches it.
const TOUCH: f64 = 8.0 * f64::EPSILON;
/// Lasting contact: the bounces that are left take less than this together, s, ...
const ALL_BOUNCES: f64 = 1e-4;
/// ... or one of them less than this.
const ONE_BOUNCE: f64 = 1e-6;

impl Reference {
    /// The scene at t = 0.
    pub fn new(scene: &Scene, settings: ReferenceSettings) -> Result<Self, Unsupported> {
        let (mut balls, mut statics) = (Vec::new(), Vec::new());
        for (index, body) in scene.bodies.iter().enumerate() {
            match (body.motion, dynamic_radius(body), Surface::of(body)) {
                (Motion::Dynamic { mass, velocity }, Some(radius), _) => balls.push(Ball {
                    id: body.id,
                    body: index,
                    position: Sum::new(body.position),
                    velocity: Sum::new(velocity),
                    radius,
                    mass,
                    bounce: body.bounce,
                    roughness: body.roughness,
                    spin: body.spin,
                    on: None,
                }),
                (Motion::Static, _, Some(surface)) => statics.push(Fixture {
                    id: body.id,
                    body: index,
                    bounce: body.bounce,
                    roughness: body.roughness,
                    surface,
                }),
                _ => return Err(unsupported(body)),
            }
        }
        let forces = scene.forces.clone();
        let (changes, end) = (Vec::new(), None);
        let mut all = Self { time: 0.0, time_rest: 0.0, balls, statics, forces, settings, changes, end };
        (0..all.balls.len()).for_each(|ball| all.lay_if_touching(ball));
        Ok(all)
    }

    /// Lays a ball on the one thing that it touches without closing or parting, if that is a face.
    fn lay_if_touching(&mut self, i: usize) {
        let ball = self.balls[i];
        let size = ball.position.value.abs().max_element() + ball.radius;
        let touches = |pair: Pair| self.gap(pair, &self.balls).0.distance <= TOUCH * size;
        let with_balls = (0..self.balls.len()).any(|j| j != i && touches(Pair::Balls(i, j)));
        let mut touched = (0..self.statics.len()).filter(|j| touches(Pair::Static(i, *j)));
        if let (Some(j), None, false) = (touched.next(), touched.next(), with_balls) {
            let rate = self.gap(Pair::Static(i, j), &self.balls).1;
            if rate.abs() <= SPEED_ROUNDING * ball.velocity.value.length() {
                self.lay(i, j);
            }
        }
    }

    /// Lays a ball on a static body, if it touches that in a face that rubs.
    fn lay(&mut self, i: usize, j: usize) {
        let (ball, fixture) = (&mut self.balls[i], &self.statics[j]);
        if let Some(normal) = fixture.surface.face_under(ball.position.value) {
            let law = mean(ball.roughness, fixture.roughness);
            ball.lay_on(j, normal, law, &self.forces);
        }
    }

    /// Model time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// What balls on faces have come to, in the order of time.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// Dynamic bodies, in the order of the file.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// The first ball with this UserID.
    pub fn ball(&self, id: i64) -> Option<&Ball> {
        self.balls.iter().find(|ball| ball.id == id)
    }

    /// Kinetic and potential energy, J.
    pub fn energy(&self) -> f64 {
        self.balls.iter().map(|ball| ball.energy(&self.forces)).sum()
    }

    /// The next impact not after `until`, or `None`: then the time is `until`.
    pub fn next_impact(&mut self, until: f64) -> Result<Option<Impact>, End> {
        loop {
            match self.step(until)? {
                Step::Flew => {}
                Step::Impact(impact) => return Ok(Some(impact)),
                Step::Done => return Ok(None),
            }
        }
    }

    /// All impacts up to `until`.
    pub fn impacts(&mut self, until: f64) -> Result<Vec<Impact>, End> {
        let mut impacts = Vec::new();
        while let Some(impact) = self.next_impact(until)? {
            impacts.push(impact);
        }
        Ok(impacts)
    }

    /// One short step towards `until`, or to the first impact on the way.
    pub fn step(&mut self, until: f64) -> Result<Step, End> {
        if let Some(end) = self.end {
            return Err(end);
        }
        if self.time >= until {
            return Ok(Step::Done);
        }
        let duration = self.step_length().min((until - self.time) - self.time_rest);
        let looks: Vec<Vec<Ball>> =
            (0..=LOOKS).map(|k| self.flown(duration * k as f64 / LOOKS as f64)).collect();
        if looks[LOOKS].iter().any(|ball| !ball.position.value.is_finite()) {
            return Err(End::NotFinite);
        }
        let Some((after, pair)) = self.first_hit(duration, &looks) else {
            self.go(duration);
            return self.end.map_or(Ok(Step::Flew), Err);
        };
        if after > 0.0 {
            self.go(after);
        }
        let is_lying = |i: usize| self.balls[i].on.is_some();
        let more_than_two = match pair {
            Pair::Balls(i, j) => is_lying(i) || is_lying(j),
            Pair::Static(i, _) => is_lying(i),
        };
        if more_than_two {
            self.end = Some(End::MetOnFace);
        }
        if let Some(end) = self.end {
            return Err(end);
        }
        Ok(Step::Impact(self.respond(pair)))
    }

    /// The first impact of a step; of several at one instant the first or last in the order of the file.
    fn first_hit(&self, duration: f64, looks: &[Vec<Ball>]) -> Option<(f64, Pair)> {
        let mut hits = Vec::new();
        self.for_each_pair(|pair| {
            hits.extend(self.first_contact(pair, duration, looks).map(|after| (after, pair)));
        });
        let earliest = hits.iter().map(|hit| hit.0).fold(f64::INFINITY, f64::min);
        if self.settings.last_first {
            hits.into_iter().rfind(|hit| hit.0 <= earliest + SAME_INSTANT)
        } else {
            hits.into_iter().find(|hit| hit.0 <= earliest)
        }
    }

    fn go(&mut self, duration: f64) {
        self.balls = self.flown(duration);
        for ball in &self.balls {
            let Some(on) = ball.on else { continue };
            for (after, hold) in on.began.into_iter().zip([Hold::Rolls, Hold::Rests]) {
                let time = after.map(|after| self.time + (after + self.time_rest));
                self.changes.extend(time.map(|time| Change { time, ball: ball.id, hold }));
            }
            let leaves = self.statics[on.fixture].surface.face_under(ball.position.value).is_none();
            self.end = on.end.or(self.end).or(leaves.then_some(End::LeftFace));
        }
        let small = duration + self.time_rest;
        let time = self.time + small;
        self.time_rest = small - (time - self.time);
        self.time = time;
    }

    fn flown(&self, duration: f64) -> Vec<Ball> {
        self.balls.iter().map(|ball| ball.flown(&self.forces, duration, self.settings.tolerance)).collect()
    }

    /// So long that no ball goes further than `stride` radii, with room for acceleration.
    fn step_length(&self) -> f64 {
        let time_to_go = |ball: &Ball| {
            let acceleration = ball.acceleration_now(&self.forces).length();
            let way = self.settings.stride * ball.radius;
            let by_speed = way / ball.velocity.value.length();
            let by_force = (way / acceleration).sqrt();
            by_speed.min(by_force)
        };
        self.balls.iter().map(time_to_go).fold(LONGEST, f64::min)
    }

    fn for_each_pair(&self, mut visit: impl FnMut(Pair)) {
        for i in 0..self.balls.len() {
            (i + 1..self.balls.len()).for_each(|j| visit(Pair::Balls(i, j)));
            (0..self.statics.len()).for_each(|j| visit(Pair::Static(i, j)));
        }
    }

    /// The gap of a pair and the rate at which it opens.
    fn gap(&self, pair: Pair, balls: &[Ball]) -> (SurfaceGap, f64) {
        let (gap, velocity) = match pair {
            Pair::Balls(i, j) => {
                let (a, b) = (&balls[i], &balls[j]);
                let gap = gap_along(b.position.minus(a.position), a.radius + b.radius);
                (gap, b.velocity.value - a.velocity.value)
            }
            Pair::Static(i, j) => {
                let ball = &balls[i];
                (self.statics[j].surface.gap_of(ball.position, ball.radius), -ball.velocity.value)
            }
        };
        (gap, velocity.dot(gap.towards))
    }

    /// When, counted from the start of a step, a pair first touches while closing.
    fn first_contact(&self, pair: Pair, duration: f64, looks: &[Vec<Ball>]) -> Option<f64> {
        if let Pair::Static(i, j) = pair
            && self.balls[i].on.is_some_and(|on| on.fixture == j)
        {
            return None;
        }
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
        self.settings.stride * radius
    }

    fn contact_between(
        &self,
        pair: Pair,
        from: (f64, (SurfaceGap, f64)),
        to: (f64, (SurfaceGap, f64)),
    ) -> Option<f64> {
        let (start, (gap_start, rate_start)) = from;
        let (end, (gap_end, rate_end)) = to;
        let is_open = |t: f64| self.gap_after(pair, t).0 > 0.0;
        let is_opening = |t: f64| self.gap_after(pair, t).1 > 0.0;
        let is_closing = |rate: f64| rate < -SPEED_ROUNDING * self.speeds(pair);
        // A pair that touches and approaches meets now: hit by a third one, or its gap stayed below rounding.
        if gap_start.distance <= 0.0 && is_closing(rate_start) {
            return Some(start);
        }
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
        if !is_open(open) || is_open(closed) {
            return None;
        }
        let contact = bisect(open, closed, is_open).1;
        is_closing(self.gap_after(pair, contact).1).then_some(contact)
    }

    /// Sum of the speeds that a closing speed of the pair is the difference of, m/s.
    fn speeds(&self, pair: Pair) -> f64 {
        let speed = |i: usize| self.balls[i].velocity.value.length();
        match pair {
            Pair::Balls(i, j) => speed(i) + speed(j),
            Pair::Static(i, _) => speed(i),
        }
    }

    /// SurfaceGap and opening rate of a pair some time after the start of the step.
    fn gap_after(&self, pair: Pair, after: f64) -> (f64, f64) {
        let mut balls = Vec::new();
        let indices = match pair {
            Pair::Balls(i, j) => vec![i, j],
            Pair::Static(i, _) => vec![i],
        };
        for &index in &indices {
            balls.push(self.balls[index].flown(&self.forces, after, self.settings.tolerance));
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
                (i, a.bounce * b.bounce, 1.0 / a.mass + 1.0 / b.mass, (b.id, b.body))
            }
            Pair::Static(i, j) => {
                let (a, b) = (&self.balls[i], &self.statics[j]);
                (i, a.bounce * b.bounce, 1.0 / a.mass, (b.id, b.body))
            }
        };
        if self.is_lasting(pair, gap.towards, bounce, bounce * -rate) {
            self.end = Some(End::LastingContact);
        }
        let impulse = (1.0 + bounce) * -rate / inverse_mass;
        let rubbing = self.rubbing(pair, gap.towards, impulse, inverse_mass);
        let first = &mut self.balls[i];
        first.push(gap.towards * -impulse);
        first.rub(gap.towards, -rubbing);
        let (own, point) = ((first.id, first.body), first.position.value + gap.towards * first.radius);
        match pair {
            Pair::Balls(_, j) => {
                self.balls[j].push(gap.towards * impulse);
                self.balls[j].rub(-gap.towards, rubbing);
            }
            Pair::Static(_, j) if self.end.is_some() && bounce == 0.0 => {
                self.lay(i, j);
                self.end = self.end.filter(|_| self.balls[i].on.is_none());
            }
            Pair::Static(..) => {}
        }
        let ((a, b), normal) =
            if own <= other { ((own, other), gap.towards) } else { ((other, own), -gap.towards) };
        let onto = matches!(pair, Pair::Static(..)).then_some((own.1, gap.towards));
        Impact { time: self.time, onto, a: a.0, b: b.0, bodies: [a.1, b.1], point, normal, impulse }
    }

    /// The impulse of friction on the second body, N·s.
    fn rubbing(&self, pair: Pair, towards: DVec3, pressing: f64, inverse_mass: f64) -> DVec3 {
        let surface = |ball: &Ball, to: DVec3| ball.velocity.value + ball.spin.cross(ball.radius * to);
        let (first, roughness, other) = match pair {
            Pair::Balls(i, j) => {
                let other = &self.balls[j];
                (&self.balls[i], other.roughness, surface(other, -towards))
            }
            Pair::Static(i, j) => (&self.balls[i], self.statics[j].roughness, DVec3::ZERO),
        };
        let apart = other - surface(first, towards);
        let slip = apart - apart.dot(towards) * towards;
        against(slip, pressing, mean(first.roughness, roughness), inverse_mass)
    }

    /// Whether a pair that parts at `speed` falls back so soon that its bounces end before they matter:
    /// one flight lasts 2v/a, all that follow 2v/(a(1−e)).
    fn is_lasting(&self, pair: Pair, towards: DVec3, bounce: f64, speed: f64) -> bool {
        let acceleration = |i: usize| self.balls[i].acceleration_now(&self.forces);
        let pressing = match pair {
            Pair::Balls(i, j) => (acceleration(i) - acceleration(j)).dot(towards),
            Pair::Static(i, _) => acceleration(i).dot(towards),
        };
        let is_plastic = bounce == 0.0 && pressing >= 0.0;
        let shortest = (ALL_BOUNCES * (1.0 - bounce)).max(ONE_BOUNCE);
        is_plastic || 2.0 * speed < pressing * shortest
    }
}

fn unsupported(body: &Body) -> Unsupported {
    Unsupported { label: body.label.to_string(), what: format!("{:?} that is {:?}", body.shape, body.motion) }
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
