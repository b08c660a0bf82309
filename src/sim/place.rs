//! A position with twice the digits of an f64. Near an attractor far from the origin the force needs them.

use glam::DVec3;

/// x + low, of which x is the nearest f64 (Dekker's double-double, in each coordinate).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// m.
    pub x: DVec3,
    /// What the position has beyond the digits of `x`, m.
    pub low: DVec3,
}

impl Place {
    /// A position that has no more digits than an f64.
    pub fn exact(x: DVec3) -> Self {
        Self { x, low: DVec3::ZERO }
    }

    /// The position `way` farther on.
    pub fn moved(self, way: DVec3) -> Self {
        let way = self.low + way;
        let x = self.x + way;
        // Knuth's exact sum of two, for either may be the larger.
        let of_way = x - self.x;
        Self { x, low: (self.x - (x - of_way)) + (way - of_way) }
    }

    /// The way from here to a point, m.
    pub fn way_to(self, point: DVec3) -> DVec3 {
        (point - self.x) - self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_ways_add_up_far_from_the_origin() {
        // At 1e5 m an f64 is 1.5e-11 m: a thousand steps of 1e-14 m would each be lost.
        let start = Place::exact(DVec3::splat(1e5 + 0.3));
        let step = DVec3::new(1e-14, -3e-14, 2e-12);
        let end = (0..1000).fold(start, |place, _| place.moved(step));
        let off = -end.way_to(start.x) - 1000.0 * step;
        assert!(off.length() <= 1e-22, "{off}");
        assert!(end.low.abs().max_element() <= 0.5 * 1.5e-11, "{end:?}");
    }

    #[test]
    fn a_long_way_from_a_small_place_is_exact() {
        let start = Place::exact(DVec3::splat(1e-20));
        let end = start.moved(DVec3::splat(1e3));
        assert_eq!((end.x, end.low), (DVec3::splat(1e3), DVec3::splat(1e-20)));
    }
}
