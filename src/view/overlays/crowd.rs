//! How much smaller marks are drawn where many share a view, so that they leave to be seen what they mark.

use crate::view::Viewport;

/// Distance from each other at which marks have their full size, if they were spread evenly, points.
const ROOMY: f64 = 40.0;

/// Smaller ones would not be seen themselves.
const LEAST: f64 = 0.25;

/// The share of their full size at which so many marks are drawn. It goes in steps of √2: marks that change their number from
/// picture to picture would breathe.
pub(super) fn share_of_size(viewport: Viewport, count: usize) -> f64 {
    let apart = (viewport.width * viewport.height / count.max(1) as f64).sqrt();
    let halvings = (2.0 * libm::log2((ROOMY / apart).max(1.0))).ceil() / 2.0;
    libm::exp2(-halvings).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_marks_are_large_and_many_small() {
        let share = |count| share_of_size(Viewport::new(400.0, 400.0, 2.0), count);
        assert_eq!([0, 1, 100].map(share), [1.0; 3]);
        assert_eq!(share(200), 0.5_f64.sqrt());
        assert_eq!([400, 1600, 1_000_000].map(share), [0.5, 0.25, 0.25]);
    }
}
