//! What engines that step by Δt and let bodies sink into each other need: a step and a stiffness that suit the scene,
//! and the damping that gives a restitution.

use super::format::Source;
use crate::scene::{Motion, Shape};

/// Lengths and times of a scene for contact that gives way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Yielding {
    /// Of the smallest moving sphere, m.
    pub radius: f64,
    /// Length of a step, s.
    pub step: f64,
    /// K of x″ = −K x, 1/s².
    pub stiffness: f64,
}

/// How far a body may go in one step, in its radii.
const WAY_PER_STEP: f64 = 0.01;
/// How far the fastest may sink in, v/√K, in its radii. With the above, √K Δt = 0.1: a contact takes 30 steps.
const DEPTH: f64 = 0.1;
/// s; where nothing moves no step is better than another.
const ANY_STEP: f64 = 1e-3;

impl Yielding {
    pub fn of(source: &Source<'_>) -> Self {
        let radii = source.dynamic().filter_map(|body| match body.shape {
            Shape::Sphere { radius } => Some(radius),
            Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
        });
        let radius = Some(radii.fold(f64::INFINITY, f64::min)).filter(|radius| radius.is_finite());
        let step = radius.map(|radius| WAY_PER_STEP * radius / speed(source));
        let step = step.filter(|step| stiffness(*step).is_normal()).unwrap_or(ANY_STEP);
        Self { radius: radius.unwrap_or(1.0), step, stiffness: stiffness(step) }
    }
}

/// Of contact for a step.
fn stiffness(step: f64) -> f64 {
    let root = WAY_PER_STEP / DEPTH / step;
    root * root
}

/// The largest speed to expect: the fastest at the start, and a fall along the whole map, m/s.
fn speed(source: &Source<'_>) -> f64 {
    let start = source.dynamic().map(|body| match body.motion {
        Motion::Dynamic { velocity, .. } => velocity.length(),
        Motion::Static => 0.0,
    });
    let fall = 2.0 * source.gravity().abs().dot(source.scene.map.size);
    start.fold(0.0, f64::max).max(libm::sqrt(fall))
}

/// More damping than this needs shorter steps; e is below 0.01 here.
const MOST_DAMPED: f64 = 5.0;

/// The damping ratio ζ of x″ = −2ζ√K x′ − K x at which a body leaves with e times its speed. It leaves when the force
/// would pull: e = exp(−ζ/√(1−ζ²) (π − atan(2ζ√(1−ζ²)/(1−2ζ²)))), and for ζ > 1 its continuation
/// (Schwager & Pöschel 2007).
pub(super) fn damping_ratio(restitution: f64) -> f64 {
    let (mut low, mut high) = (0.0, MOST_DAMPED);
    if restitution >= 1.0 {
        return low;
    }
    if restitution <= restitution_of(high) {
        return high;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if restitution_of(middle) > restitution { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The inverse of the above: how fast a body leaves a spring of damping ratio ζ, as a share of how fast it came.
pub fn restitution_of_damping(zeta: f64) -> f64 {
    if zeta >= MOST_DAMPED { 0.0 } else { restitution_of(zeta) }
}

fn restitution_of(zeta: f64) -> f64 {
    let square = 1.0 - zeta * zeta;
    let root = libm::sqrt(square.abs());
    let exponent = if root < 1e-6 {
        2.0
    } else if square > 0.0 {
        zeta / root * (std::f64::consts::PI - libm::atan2(2.0 * zeta * root, 1.0 - 2.0 * zeta * zeta))
    } else {
        zeta / root * libm::log((zeta + root) / (zeta - root))
    };
    libm::exp(-exponent)
}

/// Rolling friction of these engines is a lever, in m: the torque about the contact for each newton of load. A torque τ slows a
/// solid sphere that rolls by 5/7 τ/(m r), and this program's coefficient by μ N/m, so that the lever is 7/5 μ r.
pub fn rolling_lever(coefficient: f64, radius: f64) -> f64 {
    1.4 * coefficient * radius
}

/// The inverse of the above.
pub fn rolling_of_lever(lever: f64, radius: f64) -> f64 {
    lever / (1.4 * radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the oscillator integrated by small steps until its force pulls.
    #[test]
    fn damping_gives_the_restitution() {
        for e in [1.0, 0.9, 0.5, 0.2, 0.135, 0.1, 0.03] {
            let zeta = damping_ratio(e);
            let (mut x, mut v, h) = (0.0, -1.0, 1e-5);
            loop {
                let a = -2.0 * zeta * v - x;
                if a < 0.0 {
                    break;
                }
                let (mid_x, mid_v) = (x + 0.5 * h * v, v + 0.5 * h * a);
                x += h * mid_v;
                v += h * (-2.0 * zeta * mid_v - mid_x);
            }
            assert!((v - e).abs() < 1e-4, "{e}: {zeta} gives {v}");
        }
    }
}
