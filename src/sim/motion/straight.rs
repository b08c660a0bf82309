//! A vector w that something drives and friction resists, ẇ = c − B ŵ: how it goes on, and when it is zero.
//!
//! Along c it is straight. Else it turns towards c like the velocity of a point that slides on an incline (Aghamohammadi &
//! Aghamohammadi 2011): with φ the angle from c to w, u = tan(φ/2), A = |c| and κ = B/A,
//!
//! |w| = C u^κ/sin φ,  and it is zero after  (C/2A) (u^(κ−1)/(κ−1) + u^(κ+1)/(κ+1))  for κ > 1, for κ ≤ 1 never.

use glam::DVec3;

use crate::sim::tolerance::ONE_LINE;

/// How w goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Course {
    /// It is zero and stays so.
    Still,
    /// At a constant rate until it is zero, after a time in s that may be infinite.
    Straight { rate: DVec3, stop: f64 },
    /// It turns; its rate now.
    Turns { rate: DVec3, stop: f64 },
}

pub(super) fn course(w: DVec3, c: DVec3, against: f64) -> Course {
    let (speed, drive) = (w.length(), c.length());
    if speed == 0.0 {
        return if drive <= against {
            Course::Still
        } else {
            Course::Straight { rate: (1.0 - against / drive) * c, stop: f64::INFINITY }
        };
    }
    let direction = w / speed;
    let (along, across) = (c.dot(direction), c.cross(direction).length());
    if across <= ONE_LINE * drive {
        let stop = if against > along { speed / (against - along) } else { f64::INFINITY };
        return Course::Straight { rate: (along - against) * direction, stop };
    }
    Course::Turns { rate: c - against * direction, stop: stop_of(speed, [along, across], against) }
}

/// When a vector that turns is zero, s.
fn stop_of(speed: f64, [along, across]: [f64; 2], against: f64) -> f64 {
    let drive = libm::hypot(along, across);
    let ratio = against / drive;
    if ratio <= 1.0 {
        return f64::INFINITY;
    }
    // u = tan(φ/2) = sin φ/(1 + cos φ), or (1 − cos φ)/sin φ where that does not cancel. C u^κ = |w| sin φ.
    let u = if along > 0.0 { across / (drive + along) } else { (drive - along) / across };
    let scaled = speed * (across / drive) / (2.0 * drive);
    scaled * (1.0 / (u * (ratio - 1.0)) + u / (ratio + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against small steps of the equation itself (Runge–Kutta).
    #[test]
    fn a_vector_that_turns_stops_when_the_formula_says() {
        for (angle, ratio) in [(0.5, 3.0), (1.8, 2.2), (2.9, 5.0)] {
            let (c, against) = (DVec3::X * 2.0, 2.0 * ratio);
            let mut w = 1.5 * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
            let Course::Turns { stop, .. } = course(w, c, against) else { panic!("it turns") };
            let rate = |w: DVec3| c - against * w.normalize();
            let steps = 100_000;
            // The last thousandth is singular.
            let h = 0.999 * stop / f64::from(steps);
            for _ in 0..steps {
                let k1 = rate(w);
                let k2 = rate(w + 0.5 * h * k1);
                let k3 = rate(w + 0.5 * h * k2);
                let k4 = rate(w + h * k3);
                w += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
            }
            let Course::Turns { stop: left, .. } = course(w, c, against) else { panic!("it turns") };
            assert!((left / (0.001 * stop) - 1.0).abs() <= 1e-8, "{left} of {stop}");
        }
    }
}
