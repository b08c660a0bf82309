//! Times of impact against samples and bisection: random parabolas, near misses, lift-off, huge and tiny scales.

use std::cell::Cell;

use glam::DVec3;

use super::advance::{Skip, Span, first_contact as advance};
use super::{Ball, Gap, Target, first_contact, gap, surely_stay_apart};
use super::{sphere_plate, sphere_sphere};
use crate::random::Random;
use crate::sim::segment::{Path, Segment, Series};
use crate::sim::shape::Plate;
use crate::sim::tolerance::{ADVANCES_BEFORE_SKIP, TOUCH};

/// A ball on a parabola until `end`.
fn flight(x: DVec3, v: DVec3, a: DVec3, end: f64) -> Segment {
    Segment { end, ..Segment::ballistic(0.0, x, v, a) }
}

fn ball(segment: &Segment, radius: f64) -> Ball<'_> {
    Ball { path: Path { segment, series: None }, radius }
}

/// A plate about the origin with its sides along two of the axes.
fn plate(half_x: f64, half_y: f64) -> Plate {
    let [axis_x, axis_y, normal] = DVec3::AXES;
    Plate { center: DVec3::ZERO, axis_x, axis_y, normal, half_x, half_y }
}

/// First time at which the gap closes, by samples of its rate: each minimum is bisected, then each root before one.
fn sampled(ball: Ball<'_>, target: Target<'_>, end: f64) -> Option<f64> {
    const SAMPLES: u32 = 3000;
    let at = |time: f64| gap(ball, target, time);
    let halve = |mut low: f64, mut high: f64, holds: &dyn Fn(&Gap) -> bool| {
        for _ in 0..70 {
            let middle = 0.5 * (low + high);
            if holds(&at(middle)) { high = middle } else { low = middle }
        }
        high
    };
    let mut low = 0.0;
    for sample in 1..=SAMPLES {
        let high = end * f64::from(sample) / f64::from(SAMPLES);
        let turns = at(low).rate < 0.0 && at(high).rate > 0.0;
        let lowest = if turns { halve(low, high, &|gap| gap.rate >= 0.0) } else { high };
        if at(low).distance > 0.0 && at(lowest).distance <= 0.0 {
            return Some(halve(low, lowest, &|gap| gap.distance <= 0.0));
        }
        low = high;
    }
    None
}

/// What the isolation alone says from the start.
fn isolated(ball: Ball<'_>, target: Target<'_>, end: f64) -> Skip {
    let slack = ball.tolerance();
    match target {
        Target::Plate(plate) => sphere_plate::skip(ball, plate, slack, 0.0),
        Target::Sphere(other) | Target::Dynamic(other) => {
            let acceleration_bound = ball.path.series.map(|_| ball.path.segment.acceleration_bound);
            let search = Span { from: 0.0, until: end, acceleration_bound, slack };
            sphere_sphere::skip(ball, other, search, 0.0)
        }
        Target::Convex(..) => Skip::Unknown,
    }
}

/// Holds search and isolation against the samples; gives whether there is a contact.
fn agrees(ball: Ball<'_>, target: Target<'_>, end: f64) -> bool {
    let expected = sampled(ball, target, end);
    let (got, skip) = (first_contact(ball, target, f64::NEG_INFINITY), isolated(ball, target, end));
    let what = format!("{got:?}, {skip:?} and {expected:?} of {ball:?} and {}", target_name(target));
    let Some(expected) = expected else {
        assert!(got.is_none() && skip == Skip::Never, "{what}");
        return false;
    };
    // In the rounding of a place, 8 of which are the slack, the surfaces come nearer at the rate of the contact.
    let rate = gap(ball, target, expected).rate.abs();
    let rounding = 100.0 * ball.tolerance().max(TOUCH * (expected * rate)) / rate + 1e-15 * expected;
    assert!(got.is_some_and(|got| (got - expected).abs() <= rounding), "{what}: off by more than {rounding}");
    let Skip::To(early) = skip else { panic!("{what}") };
    assert!(
        early <= expected + 0.05 * rounding && early >= expected - rounding,
        "{what}: not within {rounding}"
    );
    true
}

fn target_name(target: Target<'_>) -> String {
    match target {
        Target::Plate(plate) => format!("{plate:?}"),
        Target::Dynamic(other) | Target::Sphere(other) => format!("{other:?}"),
        Target::Convex(..) => String::new(),
    }
}

#[test]
fn random_parabolas_agree_with_samples() {
    let (mut random, mut hits) = (Random::new(7), 0);
    for _ in 0..600 {
        let radius = random.range(0.05, 0.5);
        let (start, aim) = (random.vector(1.0).normalize() * 4.0, random.vector(1.3));
        let (end, a) = (2.0, random.vector(8.0));
        // It is at the aim at half time, but for the curvature.
        let way = flight(start, aim - start - 0.5 * a, a, end);
        let other = flight(random.vector(0.3), random.vector(0.5), random.vector(3.0), end);
        let rest = Segment::resting(DVec3::ZERO);
        let [x, y] = [random.range(0.2, 1.0), random.range(0.2, 1.0)];
        for target in
            [Target::Plate(&plate(x, y)), Target::Sphere(ball(&rest, x)), Target::Dynamic(ball(&other, y))]
        {
            hits += u32::from(agrees(ball(&way, radius), target, end));
        }
    }
    assert!((500..1500).contains(&hits), "{hits} hits of 1800: aim better");
}

#[test]
fn random_paths_through_fields_agree_with_samples() {
    let (mut random, mut hits) = (Random::new(11), 0);
    for _ in 0..300 {
        let radius = random.range(0.05, 0.5);
        let (start, aim) = (random.vector(1.0).normalize() * 4.0, random.vector(1.3));
        let (end, a) = (2.0, random.vector(8.0));
        let series = Series { b: std::array::from_fn(|_| random.vector(6.0)), low: DVec3::ZERO };
        let mut way = flight(start, DVec3::ZERO, a, end);
        way.step = end;
        way.acceleration_bound = a.length() + series.bound();
        // It is at the aim at half time.
        let drift = Path { segment: &way, series: Some(&series) }.position(0.5 * end) - start;
        way.v = (aim - start - drift) / (0.5 * end);
        let moving = Ball { path: Path { segment: &way, series: Some(&series) }, radius };
        let other = flight(random.vector(0.3), random.vector(0.5), random.vector(3.0), end);
        let rest = Segment::resting(DVec3::ZERO);
        let [x, y] = [random.range(0.2, 1.0), random.range(0.2, 1.0)];
        let plate = plate(x, y);
        for target in
            [Target::Plate(&plate), Target::Sphere(ball(&rest, x)), Target::Dynamic(ball(&other, y))]
        {
            hits += u32::from(agrees(moving, target, end));
        }
    }
    assert!((250..750).contains(&hits), "{hits} hits of 900: aim better");
}

#[test]
fn those_that_surely_stay_apart_do_so_in_samples() {
    let (mut random, mut apart, mut near) = (Random::new(12), 0, 0);
    for _ in 0..2000 {
        let mut through_a_field = |reach: f64| {
            let (a, end) = (random.vector(2.0), random.range(0.1, 1.0));
            let series = Series { b: std::array::from_fn(|_| random.vector(0.5)), low: DVec3::ZERO };
            let mut way = flight(random.vector(reach), random.vector(2.0), a, end);
            (way.start, way.step) = (random.range(0.0, 0.1), end);
            way.acceleration_bound = a.length() + series.bound();
            (way, series)
        };
        let ways = [through_a_field(2.0), through_a_field(2.0)];
        let [a, b] = ways.each_ref().map(|(segment, series)| Path { segment, series: Some(series) });
        let (from, until) = (a.segment.start.max(b.segment.start), a.segment.end.min(b.segment.end));
        let at = |k: i32| from + (until - from) * f64::from(k) / 200.0;
        let least =
            (0..=200).map(|k| (b.position(at(k)) - a.position(at(k))).length()).fold(f64::INFINITY, f64::min);
        if surely_stay_apart(a, b, 0.4, 0.1) {
            assert!(least > 0.5, "{least}");
            apart += 1;
        } else {
            near += u32::from(least > 0.5);
        }
    }
    assert!(apart > near, "{apart} are told, {near} are not");
}

#[test]
fn parabolas_that_graze_hit_and_miss_by_a_billionth_at_any_scale() {
    // The vertex of the parabola is above or beside the highest point of a sphere, an edge or a corner: gravity bends
    // it less than they are round.
    for exponent in [-400, -60, -20, 0, 20, 60, 400] {
        let scale = libm::ldexp(1.0, exponent);
        let radius = 0.25 * scale;
        let rest = Segment::resting(DVec3::ZERO);
        let plate = plate(scale, 2.0 * scale);
        let corner = DVec3::new(scale, 2.0 * scale, 0.0);
        let out = DVec3::new(1.0, 2.0, 3.0).normalize();
        let cases = [
            (Target::Sphere(ball(&rest, scale)), DVec3::ZERO, 1.25, DVec3::Z, DVec3::X),
            (Target::Plate(&plate), scale * DVec3::X, 0.25, DVec3::new(0.6, 0.0, 0.8), DVec3::Y),
            (
                Target::Plate(&plate),
                scale * DVec3::X,
                0.25,
                DVec3::new(0.6, 0.0, 0.8),
                DVec3::new(0.8, 0.0, -0.6),
            ),
            (Target::Plate(&plate), corner, 0.25, out, out.any_orthonormal_vector()),
        ];
        for (target, at, reach, up, along) in cases {
            for (part, hits) in [(1.0 - 1e-9, true), (1.0 + 1e-9, false)] {
                // Along an edge only a drive away from it leaves a single lowest point.
                let drive = if along == DVec3::Y { 1.0 } else { -0.5 };
                let vertex = at + (part * reach * scale) * up;
                let (v, a) = (scale * 2.0 * along, scale * drive * up);
                let way = flight(vertex - v + 0.5 * a, v - a, a, 3.0);
                assert_eq!(
                    agrees(ball(&way, radius), target, 3.0),
                    hits,
                    "2^{exponent}, {part}, {target:?}",
                    target = target_name(target)
                );
            }
        }
    }
}

#[test]
fn what_parts_tangentially_meets_again_only_where_it_comes_back() {
    // Symptom: a ball that lifts off an edge, a corner or a sphere where n·a + v²/r = 0 took millions of steps. Expected:
    // none. Cause: the bound by the tangent plane lets a gap that grows by the third power be stepped over in steps
    // of its square root only.
    let rest = Segment::resting(DVec3::ZERO);
    let plate = plate(0.5, 0.7);
    let targets = [
        (Target::Sphere(ball(&rest, 1.0)), DVec3::ZERO, 1.0),
        (Target::Plate(&plate), DVec3::new(0.5, 0.0, 0.0), 0.0),
        (Target::Plate(&plate), DVec3::new(0.5, 0.7, 0.0), 0.0),
    ];
    for (target, at, size) in targets {
        for (angle, radius) in [(0.3, 0.2), (0.7, 0.21), (0.7, 1.3)] {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let (out, along) = (DVec3::new(sin, 0.0, cos), DVec3::new(cos, 0.0, -sin));
            let reach: f64 = radius + size;
            let way =
                flight(at + reach * out, (9.8 * cos * reach).sqrt() * along, -9.8 * DVec3::Z, f64::INFINITY);
            let moving = ball(&way, radius);
            let steps = Cell::new(0);
            let search =
                Span { from: 0.0, until: f64::INFINITY, acceleration_bound: None, slack: moving.tolerance() };
            let found = advance(
                search,
                |time| {
                    steps.set(steps.get() + 1);
                    gap(moving, target, time)
                },
                |_| isolated(moving, target, f64::INFINITY),
            );
            assert_eq!(found, None, "{angle} {radius} {}", target_name(target));
            assert!(steps.get() <= ADVANCES_BEFORE_SKIP, "{} steps", steps.get());
            assert_eq!(first_contact(moving, target, f64::NEG_INFINITY), None);
        }
    }
}

#[test]
fn what_glides_along_an_edge_and_past_its_corner_meets_nothing() {
    let plate = plate(0.5, 0.7);
    for step in 0..16 {
        let angle = 0.1 * f64::from(step);
        let out = DVec3::new(libm::cos(angle), 0.0, libm::sin(angle));
        let start = DVec3::new(0.5, -0.3, 0.0) + 0.2 * out;
        for drive in [DVec3::ZERO, 0.1 * DVec3::Y, 1e-3 * out] {
            let way = flight(start, DVec3::Y, drive, f64::INFINITY);
            let moving = ball(&way, 0.2);
            assert_eq!(
                isolated(moving, Target::Plate(&plate), f64::INFINITY),
                Skip::Never,
                "{angle} {drive}"
            );
            assert_eq!(
                first_contact(moving, Target::Plate(&plate), f64::NEG_INFINITY),
                None,
                "{angle} {drive}"
            );
        }
    }
}

#[test]
fn what_touches_and_parts_meets_where_it_falls_back() {
    // Thrown up from the top of a sphere, with a rounding of overlap and without.
    for overlap in [0.0, 1e-16, 4e-16] {
        let rest = Segment::resting(DVec3::ZERO);
        let way = flight(DVec3::Z * (1.25 - overlap), 0.1 * DVec3::Z, -10.0 * DVec3::Z, f64::INFINITY);
        let (moving, target) = (ball(&way, 0.25), Target::Sphere(ball(&rest, 1.0)));
        let Skip::To(back) = isolated(moving, target, f64::INFINITY) else { panic!("it falls back") };
        assert!((back - 0.02).abs() <= 1e-13, "{back}");
        let found = first_contact(moving, target, f64::NEG_INFINITY);
        assert!(found.is_some_and(|found| (found - 0.02).abs() <= 1e-13), "{found:?}");
    }
}

#[test]
fn a_piece_longer_than_the_numbers_is_halved_until_they_reach() {
    // In the time given the ball would come to 1e400 m; it is at the sphere after one second.
    let rest = Segment::resting(DVec3::ZERO);
    let way = flight(3e100 * DVec3::X, -2e100 * DVec3::X, -1e-120 * DVec3::X, 1e300);
    let (moving, target) = (ball(&way, 0.5e100), Target::Sphere(ball(&rest, 0.5e100)));
    let Skip::To(early) = isolated(moving, target, 1e300) else { panic!("it hits") };
    assert!((early - 1.0).abs() <= 1e-12, "{early}");
}

#[test]
fn what_touches_and_closes_meets_now() {
    let rest = Segment::resting(DVec3::ZERO);
    for v in [DVec3::new(3.0, 0.0, -1e-3), DVec3::new(0.0, 0.0, -5.0)] {
        let way = flight(DVec3::Z * 1.25, v, -10.0 * DVec3::Z, f64::INFINITY);
        let (moving, target) = (ball(&way, 0.25), Target::Sphere(ball(&rest, 1.0)));
        let Skip::To(now) = isolated(moving, target, f64::INFINITY) else { panic!("it closes") };
        assert!(now <= 1e-11, "{now}");
        assert_eq!(first_contact(moving, target, f64::NEG_INFINITY), Some(0.0));
    }
}
