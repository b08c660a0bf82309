//! What a family makes a scene of.

use crate::study::Random;

pub(super) struct Recipe {
    /// Balls.
    pub n: usize,
    /// Restitution of a pair.
    pub e: f64,
    pub random: Random,
}
