//! Balls that rub on more than a face: on a fixed ball, in a groove, on each other, in air, in a rack.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, ForceKind, Scene};
use polyscene::sim::{BodyRef, BodyState, ContactState, Event, EventKind, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{
    SAMPLINGS, Sampling, advance, assert_books, assert_same_bits, run, simulation, state_of, states,
};
use crate::common::load::load;

const GRAVITY: f64 = 9.81;

/// Rolling down a fixed ball, N = mg (17 cos θ − 10 cos θ₀)/7 and T = 2/7 mg sin θ: it slips where T = μN, and leaves later,
/// but before a smooth one would have rolled on without friction to cos θ = 10/17 cos θ₀.
#[test]
fn ball_rolls_down_a_fixed_one_slips_and_leaves() {
    let (start, friction) = (0.1_f64, 0.5);
    let fixed = static_ball(1, DVec3::splat(5.0), 1.0).friction(friction).bounce(0.5);
    let place = DVec3::splat(5.0) + 1.1 * dvec3(start.sin(), start.cos(), 0.0);
    let rolling = ball(2, place, DVec3::ZERO).radius(0.1).bounce(0.5).friction(friction);
    let scene = empty().gravity(-GRAVITY).body(fixed).body(rolling);
    let excess = |angle: f64| 2.0 * angle.sin() - friction * (17.0 * angle.cos() - 10.0 * start.cos());
    let (mut low, mut high) = (start, 1.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    let mut sim = simulation(&scene);
    let events = advance(&mut sim, 1.5, Sampling::Every(0.1));
    let at = |kind: EventKind| {
        let event = events.iter().find(|event| event.kind == kind).expect("an event of each kind");
        let way = event.point - DVec3::splat(5.0);
        way.x.atan2(way.y)
    };
    assert!((at(EventKind::Slide) - low).abs() <= 1e-10, "{} instead of {low}", at(EventKind::Slide));
    let leaves = at(EventKind::LiftOff);
    assert!(low < leaves && leaves < (10.0 / 17.0 * start.cos()).acos(), "{leaves}");
    assert_books(&sim, 1e-14);
    let whole = run(&scene, 1.5, Sampling::Events);
    for sampling in SAMPLINGS {
        assert_same_bits(&whole, &run(&scene, 1.5, sampling), "dome");
    }
}

/// A ball in a groove of half-opening α, that gravity drives along with g∥.
fn groove(friction: f64, speed: f64) -> (Scene, f64) {
    let (half, tilt) = (45_f64.to_radians(), 20_f64.to_radians());
    let acceleration = GRAVITY * dvec3(0.0, -tilt.cos(), tilt.sin());
    let side = |id: i64, sign: f64| {
        let angle = sign * (FRAC_PI_2 - half);
        let face = plate(id, DVec3::splat(5.0), dvec3(-FRAC_PI_2, angle, 0.0), 100.0, 100.0);
        face.friction(friction).bounce(0.2)
    };
    let place = DVec3::splat(5.0) + DVec3::Y * 0.1 / half.sin();
    let rolling = ball(3, place, DVec3::Z * speed).radius(0.1).bounce(0.2).friction(friction);
    let force = ForceKind::GravityPlane { position: DVec3::ZERO, acceleration };
    (empty().force(force).body(side(1, 1.0)).body(side(2, -1.0)).body(rolling), acceleration.z)
}

/// Rolling on both faces it turns about the line through the contacts: a = g∥/(1 + k/sin² α); sliding with each load N,
/// a = g∥ − 2 μN/m.
#[test]
fn ball_rolls_or_slides_along_a_groove() {
    for (friction, expected) in [
        (0.5, GRAVITY * 20_f64.to_radians().sin() / 1.8),
        (0.05, GRAVITY * (20_f64.to_radians().sin() - 0.05 * 2_f64.sqrt() * 20_f64.to_radians().cos())),
    ] {
        let (scene, _) = groove(friction, 0.0);
        let mut sim = simulation(&scene);
        advance(&mut sim, 2.0, Sampling::Every(0.1));
        let found = state_of(&sim, 3).velocity.z / 2.0;
        assert!((found / expected - 1.0).abs() <= 1e-12, "μ {friction}: {found} instead of {expected}");
        assert_books(&sim, 1e-13);
    }
    let (scene, _) = groove(0.5, 1.0);
    let mut sim = simulation(&scene);
    advance(&mut sim, 2.0, Sampling::Every(0.1));
    assert_eq!(state_of(&sim, 3).contact, ContactState::Roll);
    assert_books(&sim, 1e-12);
}

/// A ball on a ball on a floor, both free: they roll on each other, part, and all that is kept is kept.
#[test]
fn balls_that_roll_on_each_other_keep_what_is_to_be_kept() {
    let law = |body: Body| body.radius(0.1).bounce(0.2).friction(0.5);
    let floor =
        plate(9, dvec3(5.0, 0.0, 5.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 50.0, 50.0).friction(0.5).bounce(0.2);
    let upper = dvec3(5.0 + 0.2 * 0.1_f64.sin(), 0.1 + 0.2 * 0.1_f64.cos(), 5.0);
    let scene = empty()
        .gravity(-GRAVITY)
        .body(floor)
        .body(law(ball(1, dvec3(5.0, 0.1, 5.0), DVec3::ZERO)))
        .body(law(ball(2, upper, DVec3::ZERO)));
    let mut sim = simulation(&scene);
    let events = advance(&mut sim, 0.5, Sampling::Every(0.01));
    assert!(events.iter().any(|event| event.kind == EventKind::LiftOff), "{events:?}");
    assert_books(&sim, 1e-13);
    assert!(sim.counters().steps == 0, "nothing is stepped");
}

/// In air a ball slides, rolls, and slows: the work of drag and of friction are told apart from drift.
#[test]
fn ball_rolls_in_air() {
    let floor =
        plate(1, dvec3(5.0, 0.0, 5.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 50.0, 50.0).friction(0.3).bounce(0.5);
    let rolling = ball(2, dvec3(5.0, 0.1, 5.0), DVec3::X * 3.0).radius(0.1).bounce(0.5).friction(0.3);
    let mut sim = simulation(&empty().gravity(-GRAVITY).air(1.2).body(floor).body(rolling));
    let events = advance(&mut sim, 5.0, Sampling::Every(0.1));
    assert!(events.iter().any(|event| event.kind == EventKind::Roll), "{events:?}");
    let now = state_of(&sim, 2);
    // Rolling, v̇ = −c v²/(1 + k): 1/v grows evenly.
    let later = {
        advance(&mut sim, 7.0, Sampling::Every(0.1));
        state_of(&sim, 2)
    };
    let rate = 0.25 * 1.2 * std::f64::consts::PI * 0.01 / 1.4;
    let expected = 1.0 / (1.0 / now.velocity.x + rate * 2.0);
    assert!((later.velocity.x / expected - 1.0).abs() <= 1e-12, "{} {expected}", later.velocity.x);
    assert_books(&sim, 1e-12);
}

/// How far a scene is from its own mirror image at a plane z, in radii and in the largest speed.
fn asymmetry(sim: &Simulation, plane: f64, radius: f64) -> f64 {
    let states: Vec<BodyState> = states(sim).into_iter().map(|(_, state)| state).collect();
    let fastest = states.iter().map(|state| state.velocity.length()).fold(0.0, f64::max);
    let image = |v: DVec3| dvec3(v.x, v.y, -v.z);
    let of = |state: &BodyState| {
        let place = image(state.position) + 2.0 * plane * DVec3::Z;
        let off = |other: &BodyState| (other.position - place).length();
        let other = states.iter().min_by(|a, b| off(a).total_cmp(&off(b))).expect("a ball");
        // An angular velocity is an axial vector.
        let [own, others] = [state, other].map(|state| state.turn.expect("a scene that rubs").spin);
        let spin = radius * (own + image(others)).length();
        let speed = (state.velocity - image(other.velocity)).length();
        (off(other) / radius).max(speed.max(spin) / fastest)
    };
    states.iter().map(of).fold(0.0, f64::max)
}

/// Goes on to the first impact of two balls, and gives it.
fn first_of_balls(sim: &mut Simulation) -> Event {
    sim.begin(1.0);
    loop {
        let event = sim.next_event().expect("a run without faults").expect("the cue ball arrives");
        let is_ball = |body: BodyRef| matches!(body, BodyRef::Dynamic(_));
        if event.kind == EventKind::Impact && is_ball(event.a) && event.b.is_some_and(is_ball) {
            return event;
        }
    }
}

/// A break along the axis of a rack that rubs leaves its own mirror image: as one group of balls that touch, and as impacts
/// of balls a little apart.
#[test]
fn a_break_is_its_own_mirror_image() {
    let mut tight = load("hard/billiard-break.xml");
    tight.bodies.iter_mut().for_each(|body| body.roughness.friction = 0.3);
    for (scene, plane, radius, least) in
        [(tight, 0.75, 0.031_25, 15), (load("break-on-cloth.xml"), 0.935, 0.028_575, 1)]
    {
        let mut sim = simulation(&scene);
        let impact = first_of_balls(&mut sim);
        assert!(impact.row_in_group[1] >= least, "{impact:?}");
        sim.begin(impact.time + 1e-4);
        sim.finish(&mut |_, _| {}).expect("a run without faults");
        let asymmetry = asymmetry(&sim, plane, radius);
        assert!(asymmetry <= 1e-12, "{asymmetry:e}");
        let spun =
            states(&sim).iter().filter(|(_, state)| state.turn.expect("it rubs").spin.y != 0.0).count();
        assert!(spun >= 2, "{spun} balls rub on others");
    }
}
