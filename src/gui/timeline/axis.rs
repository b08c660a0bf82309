//! A stretch of the screen that stands for a stretch of time.

use egui::Rect;

/// From left to right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    pub line: Rect,
    /// s.
    pub from: f64,
    pub to: f64,
}

/// Points between two marks of a scale that can be told apart and written to.
const APART: f64 = 84.0;

impl Axis {
    pub fn x(&self, time: f64) -> f32 {
        let share = (time - self.from) / (self.to - self.from);
        // What lies far outside stays a number that can be drawn.
        self.line.left() + self.line.width() * share.clamp(-10.0, 10.0) as f32
    }

    /// The time at a place, within what is shown.
    pub fn time(&self, x: f32) -> f64 {
        let share = ((x - self.line.left()) / self.line.width().max(1.0)).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * f64::from(share)
    }

    /// Seconds per point.
    pub fn scale(&self) -> f64 {
        (self.to - self.from) / f64::from(self.line.width().max(1.0))
    }

    /// The same stretch of the screen for `factor` times the time, with the time at `x` where it was, but not outside
    /// `whole`.
    pub fn zoomed(&self, factor: f64, x: f32, whole: (f64, f64)) -> (f64, f64) {
        let (length, most) = (self.to - self.from, whole.1 - whole.0);
        let wanted = (length * factor).clamp(SHORTEST * most, most);
        let at = self.time(x);
        let from = at - (at - self.from) * wanted / length;
        moved_inside((from, from + wanted), whole)
    }

    /// The part shown after moving by so many points, not outside `whole`.
    pub fn panned(&self, points: f32, whole: (f64, f64)) -> (f64, f64) {
        let by = f64::from(points) * self.scale();
        moved_inside((self.from - by, self.to - by), whole)
    }

    /// Round times to be written below a scale, with their distance: 1, 2 or 5 times a power of ten.
    pub fn marks(&self) -> (Vec<f64>, f64) {
        let least = APART * self.scale();
        if !(least.is_finite() && least > 0.0) {
            return (Vec::new(), 1.0);
        }
        let power = libm::pow(10.0, libm::floor(libm::log10(least)));
        let step = [1.0, 2.0, 5.0, 10.0].map(|times| times * power).into_iter().find(|step| *step >= least);
        let step = step.unwrap_or(10.0 * power);
        let (first, last) = ((self.from / step).ceil(), (self.to / step).floor());
        let count = (last - first).clamp(-1.0, 1000.0) as i64;
        ((0..=count).map(|nth| (first + nth as f64) * step).collect(), step)
    }
}

/// Shortest part of the whole that can be shown: beyond it the digits of times end.
const SHORTEST: f64 = 1e-9;

fn moved_inside((from, to): (f64, f64), whole: (f64, f64)) -> (f64, f64) {
    let by = (whole.0 - from).max(0.0) - (to - whole.1).max(0.0);
    (from + by, to + by)
}

#[cfg(test)]
mod tests {
    use egui::{pos2, vec2};

    use super::*;

    fn axis(from: f64, to: f64) -> Axis {
        Axis { line: Rect::from_min_size(pos2(10.0, 0.0), vec2(840.0, 20.0)), from, to }
    }

    #[test]
    fn places_and_times_belong_together() {
        let axis = axis(2.0, 4.0);
        assert_eq!((axis.x(2.0), axis.x(4.0), axis.x(3.0)), (10.0, 850.0, 430.0));
        assert_eq!((axis.time(10.0), axis.time(850.0), axis.time(-100.0)), (2.0, 4.0, 2.0));
    }

    #[test]
    fn zooming_keeps_the_time_under_the_pointer_and_stays_inside() {
        let (from, to) = axis(0.0, 10.0).zoomed(0.5, 430.0, (0.0, 10.0));
        assert!((from - 2.5).abs() < 1e-12 && (to - 7.5).abs() < 1e-12);
        assert_eq!(axis(2.5, 7.5).zoomed(100.0, 430.0, (0.0, 10.0)), (0.0, 10.0));
        assert_eq!(axis(0.0, 5.0).panned(1e6, (0.0, 10.0)), (0.0, 5.0));
        assert_eq!(axis(0.0, 5.0).panned(-1e6, (0.0, 10.0)), (5.0, 10.0));
    }

    #[test]
    fn marks_are_round_and_apart() {
        let (marks, step) = axis(0.0, 9.0).marks();
        assert_eq!((marks.len(), step), (10, 1.0));
        let (marks, step) = axis(0.123, 0.12309).marks();
        assert!((step - 1e-5).abs() < 1e-12 && (9..=10).contains(&marks.len()), "{step}: {marks:?}");
        assert!(axis(1.0, 1.0).marks().0.is_empty());
    }
}
