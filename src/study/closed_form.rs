//! Motions whose outcome is known in closed form. The hard cases and the tests measure against these.

use std::f64::consts::PI;

use glam::DVec3;

/// Position (m) and velocity (m/s) of a throw after `t` seconds: x₀ + v₀t + ½gt².
pub fn throw(start: DVec3, velocity: DVec3, gravity: DVec3, t: f64) -> (DVec3, DVec3) {
    (start + velocity * t + 0.5 * gravity * t * t, velocity + gravity * t)
}

/// A ball that falls on a level floor again and again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounces {
    /// Duration of the first fall, s: √(2h/g).
    pub first_fall: f64,
    /// m/s².
    pub gravity: f64,
    /// Part of the speed that an impact leaves, e.
    pub restitution: f64,
}

impl Bounces {
    /// From rest, `height` metres (surface to surface) above the floor; `gravity` in m/s².
    pub fn dropped(height: f64, gravity: f64, restitution: f64) -> Self {
        Self { first_fall: (2.0 * height / gravity).sqrt(), gravity, restitution }
    }

    /// Time of the k-th impact, from 0, s. Flight k lasts 2t₁eᵏ, so it is t₁(1 + 2e(1 − eᵏ)/(1 − e)).
    pub fn impact_time(&self, k: u32) -> f64 {
        let e = self.restitution;
        let flights = if e == 1.0 {
            2.0 * f64::from(k)
        } else {
            2.0 * e * (1.0 - libm::pow(e, f64::from(k))) / (1.0 - e)
        };
        self.first_fall * (1.0 + flights)
    }

    /// How many impacts come up to `until`, s, where none is lossy.
    pub fn elastic_count(&self, until: f64) -> f64 {
        ((until / self.first_fall + 1.0) / 2.0).floor()
    }

    /// Height over the floor at a time, m; `gravity` in m/s² as before.
    pub fn height(&self, t: f64) -> f64 {
        let fall = 0.5 * self.gravity * (self.first_fall * self.first_fall - t * t);
        if t <= self.first_fall {
            return fall;
        }
        let (mut since, mut flight) = (t - self.first_fall, 2.0 * self.restitution * self.first_fall);
        // Shorter ones are lower than any rounding.
        while flight > f64::EPSILON * self.first_fall {
            if since <= flight {
                return 0.5 * self.gravity * since * (flight - since);
            }
            since -= flight;
            flight *= self.restitution;
        }
        0.0
    }

    /// When all bounces have ended, s: t₁(1 + e)/(1 − e). Infinite without losses.
    pub fn end(&self) -> f64 {
        self.first_fall * (1.0 + self.restitution) / (1.0 - self.restitution)
    }
}

/// Newton's cradle of equal balls that lose nothing: as many leave at the far end as came in, and just as fast.
/// Velocities along the row, in its order.
pub fn cradle(balls: usize, incoming: usize, velocity: DVec3) -> Vec<DVec3> {
    (0..balls).map(|nth| if nth + incoming < balls { DVec3::ZERO } else { velocity }).collect()
}

/// Impacts of a ball, a ball 100ᵏ times as heavy that runs into it, and a wall: the first k + 1 digits of π
/// (Galperin 2003).
pub fn pi_collisions(k: u32) -> u64 {
    (PI * libm::pow(10.0, f64::from(k))) as u64
}

/// Where a ball that flies along x touches the edge or corner of a plate that stands across, with its centre
/// `beyond` the half sides in y and z: how far it stops before the plate, m, and the unit normal from the plate
/// to the ball.
pub fn touch_beyond_edge(radius: f64, beyond: [f64; 2]) -> (f64, DVec3) {
    let [dy, dz] = beyond;
    let depth = (radius * radius - dy * dy - dz * dz).sqrt();
    (depth, DVec3::new(-depth, dy, dz) / radius)
}

/// A Kepler ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Semi-major axis, m.
    pub axis: f64,
    pub eccentricity: f64,
    /// Of the attractor, m³/s².
    pub intensity: f64,
    /// Mean anomaly at t = 0: 0 at the periapsis, π at the apoapsis.
    pub phase: f64,
}

impl Ellipse {
    /// s.
    pub fn period(&self) -> f64 {
        2.0 * PI * (self.axis * self.axis * self.axis / self.intensity).sqrt()
    }

    /// Offset from the attractor, m: along the axis towards the periapsis, and across, the way it first goes from
    /// there. Kepler's equation M = E − e sin E is solved by bisection.
    pub fn offset(&self, t: f64) -> [f64; 2] {
        let turns = t / self.period();
        let mean = self.phase + 2.0 * PI * (turns - turns.floor());
        let e = self.eccentricity;
        let anomaly = rising_root(mean - e, mean + e, |guess| guess - e * libm::sin(guess) - mean);
        let (sin, cos) = libm::sincos(anomaly);
        [self.axis * (cos - e), self.axis * (1.0 - e * e).sqrt() * sin]
    }
}

/// A fall from rest into the centre of an attractor and back out, again and again: the limit of thin ellipses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plunge {
    /// From the centre at rest, m.
    pub distance: f64,
    /// Of the attractor, m³/s².
    pub intensity: f64,
}

impl Plunge {
    /// From rest to rest, s.
    pub fn period(&self) -> f64 {
        2.0 * PI * self.unit()
    }

    /// Time of the k-th pass through the centre, from 0, s.
    pub fn pass_time(&self, k: u32) -> f64 {
        (2.0 * f64::from(k) + 1.0) * PI * self.unit()
    }

    /// How many passes come up to `until`, s.
    pub fn pass_count(&self, until: f64) -> f64 {
        (until / self.period() + 0.5).floor()
    }

    /// Distance from the centre, m: r = ½d(1 + cos η), t = √(d³/8G)(η + sin η).
    pub fn offset(&self, t: f64) -> f64 {
        let turns = t / self.period();
        let mean = 2.0 * PI * (turns - turns.floor());
        let eta = rising_root(0.0, 2.0 * PI, |guess| guess + libm::sin(guess) - mean);
        0.5 * self.distance * (1.0 + libm::cos(eta))
    }

    fn unit(&self) -> f64 {
        (self.distance * self.distance * self.distance / (8.0 * self.intensity)).sqrt()
    }
}

/// Where a rising function goes through zero.
fn rising_root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    high
}

/// A sphere that falls from rest through air of drag coefficient ½.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallInAir {
    /// m/s².
    pub gravity: f64,
    /// v∞ = √(2mg/(½ρπr²)), m/s.
    pub terminal_speed: f64,
}

impl FallInAir {
    /// `gravity` in m/s², `mass` in kg, `radius` in m, `density` of the air in kg/m³.
    pub fn new(gravity: f64, mass: f64, radius: f64, density: f64) -> Self {
        let area = PI * radius * radius;
        Self { gravity, terminal_speed: (2.0 * mass * gravity / (0.5 * density * area)).sqrt() }
    }

    /// v∞ tanh(gt/v∞), m/s.
    pub fn speed(&self, t: f64) -> f64 {
        self.terminal_speed * libm::tanh(self.gravity * t / self.terminal_speed)
    }

    /// v∞²/g ln cosh(gt/v∞), m; ln cosh x = ½ ln(1 + sinh² x) keeps its digits where x is small.
    pub fn fallen(&self, t: f64) -> f64 {
        let sinh = libm::sinh(self.gravity * t / self.terminal_speed);
        self.terminal_speed * self.terminal_speed / self.gravity * 0.5 * libm::log1p(sinh * sinh)
    }
}
