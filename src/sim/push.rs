//! What contacts do to a body in the steps of a group, as people are told of it.
//!
//! A step of length h begins with the impulses P of its contacts and goes on along a parabola: a body that lies still is
//! thrown up by ½ g h and falls back by as much, a few micrometres in a millisecond. What lasts of P/(m h), the part that the
//! step before had too, is told as a force over the whole step, of the same velocity in its middle:
//! v(τ) + (τ − h/2) P/(m h). A body that lies still is told to, and of a blow the body is told as it goes on.

use glam::DVec3;

/// Of a body in one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Push {
    /// Acceleration by the contacts that lasts, m/s².
    lasting: DVec3,
    /// The middle of the step, s.
    middle: f64,
}

impl Push {
    /// From the accelerations of the step before and of this one, m/s².
    pub fn of(before: DVec3, now: DVec3, middle: f64) -> Self {
        // Of the squares of what is very small nothing is left: 0/0 is no share.
        let share = before.dot(now) / now.length_squared();
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        Self { lasting: share * now, middle }
    }

    /// The velocity that is told for this one of its parabola, m/s.
    pub fn velocity(&self, of_parabola: DVec3, time: f64) -> DVec3 {
        of_parabola + (time - self.middle) * self.lasting
    }

    /// And the acceleration, m/s².
    pub fn acceleration(&self, of_parabola: DVec3) -> DVec3 {
        of_parabola + self.lasting
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const H: f64 = 1.0 / 1024.0;
    const G: DVec3 = DVec3::new(0.0, -10.0, 0.0);

    #[test]
    fn a_body_that_lies_still_is_told_to() {
        let push = Push::of(-G, -G, 0.5 * H);
        for part in [0.0, 0.25, 0.5, 1.0] {
            let of_parabola = -0.5 * H * G + part * H * G;
            assert_eq!(push.velocity(of_parabola, part * H), DVec3::ZERO);
        }
        assert_eq!(push.acceleration(G), DVec3::ZERO);
    }

    #[test]
    fn a_blow_is_told_as_it_is() {
        let blow = DVec3::new(0.0, 2.0 / H, 0.0);
        assert_eq!(Push::of(DVec3::ZERO, blow, 0.5 * H).velocity(DVec3::Y, H), DVec3::Y);
        let struck_while_it_lies = Push::of(-G, -G + blow, 0.5 * H);
        assert!((struck_while_it_lies.velocity(DVec3::Y, H) - DVec3::Y).length() < 0.01);
        assert_eq!(Push::of(-blow, blow, 0.5 * H).velocity(DVec3::Y, H), DVec3::Y);
        assert_eq!(Push::of(DVec3::ZERO, DVec3::ZERO, 0.5 * H).velocity(G, H), G);
    }
}
