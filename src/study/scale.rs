//! Logarithmic scales with whole decades, where zero has a row of its own; for any painter.

use std::ops::Range;

use super::{Axis, StudyReport, seconds, short};
use crate::sim::Method;

/// A logarithmic scale over whole decades. Places on it are decimal logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    low: i32,
    high: i32,
    /// Whether one decade below `low` stands for zero.
    has_zero: bool,
}

impl Scale {
    /// The scale that holds all values; `None` without any.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (mut least, mut most, mut has_zero, mut any) = (f64::INFINITY, 0.0_f64, false, false);
        for value in values.filter(|value| value.is_finite()) {
            any = true;
            if value > 0.0 {
                (least, most) = (least.min(value), most.max(value));
            } else {
                has_zero = true;
            }
        }
        if !any {
            return None;
        }
        if most == 0.0 {
            return Some(Self { low: 0, high: 1, has_zero });
        }
        let low = libm::floor(libm::log10(least)) as i32;
        let high = (libm::ceil(libm::log10(most)) as i32).max(low + 1);
        Some(Self { low, high, has_zero })
    }

    /// From the lowest to the highest place, with a little room.
    pub fn range(&self) -> Range<f64> {
        let low = if self.has_zero { self.low - 1 } else { self.low };
        f64::from(low) - 0.15..f64::from(self.high) + 0.25
    }

    /// Where a value stands.
    pub fn place(&self, value: f64) -> f64 {
        if value > 0.0 { libm::log10(value) } else { f64::from(self.low - 1) }
    }

    /// Places to mark, about `most` of them at most.
    pub fn ticks(&self, most: usize) -> Vec<f64> {
        let decades = (self.high - self.low) as usize + 1;
        let step = decades.div_ceil(most.max(1));
        let zero = self.has_zero.then(|| f64::from(self.low - 1));
        zero.into_iter().chain((self.low..=self.high).rev().step_by(step).map(f64::from)).collect()
    }

    /// What to write at a mark: `0`, `1` to `1000`, or a power of ten.
    pub fn label(&self, place: f64) -> String {
        let exponent = libm::round(place) as i32;
        if exponent < self.low {
            return "0".into();
        }
        match exponent {
            0 => "1".into(),
            1 => "10".into(),
            2 => "100".into(),
            3 => "1000".into(),
            -1 => "0.1".into(),
            -2 => "0.01".into(),
            _ => format!("10{}", superscript(exponent)),
        }
    }

    /// What to write at a mark of a time in seconds.
    pub fn time_label(&self, place: f64) -> String {
        let exponent = libm::round(place) as i32;
        if exponent < self.low {
            return "0".into();
        }
        let (unit, of) = match exponent {
            ..=-7 => ("ns", -9),
            -6..=-4 => ("µs", -6),
            -3..=-1 => ("ms", -3),
            _ => ("s", 0),
        };
        format!("{} {unit}", short(libm::pow(10.0, f64::from(exponent - of))))
    }
}

fn superscript(number: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        // ⁴ to ⁹ follow each other.
        _ => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
    };
    number.to_string().chars().map(digit).collect()
}

/// One point of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Wall time per simulated second, s.
    pub wall: f64,
    pub error: f64,
    /// The Δt, the tolerance or the group step.
    pub label: String,
}

/// The curve of one method on one diagram.
pub fn series_of(report: &StudyReport, method: Method, axis: &Axis) -> Vec<CurvePoint> {
    let of = report.points.iter().filter(|point| point.method == method);
    of.filter_map(|point| {
        let (wall, error) = (point.wall_per_s?, (axis.get)(point)?);
        let label = match (point.dt.or(point.group_step), point.tolerance) {
            (Some(step), _) => seconds(step),
            (_, Some(tolerance)) => short(tolerance),
            _ => String::new(),
        };
        (wall.is_finite() && error.is_finite()).then_some(CurvePoint { wall, error, label })
    })
    .collect()
}
