//! Friction and spin of single balls on flat faces, and of impacts, against closed forms and invariants.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Roughness, Scene};
use polyscene::sim::{ContactState, Event, EventKind, Method, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, plate};
use crate::common::drive::{
    SAMPLINGS, Sampling, advance, assert_books, assert_same_bits, run, simulation, state_of, watch,
};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.1;

/// A ball on an incline that falls towards +x, with the directions downhill and from the face.
struct Incline {
    scene: Scene,
    downhill: DVec3,
    normal: DVec3,
    start: DVec3,
}

fn incline(angle: f64, roughness: Roughness, along: [f64; 2], spin: DVec3) -> Incline {
    let (sin, cos) = angle.sin_cos();
    let (normal, downhill) = (dvec3(sin, cos, 0.0), dvec3(cos, -sin, 0.0));
    let start = DVec3::splat(5.0) + RADIUS * normal;
    let mut face = plate(1, DVec3::splat(5.0), dvec3(-FRAC_PI_2, angle, 0.0), 300.0, 300.0);
    let velocity = along[0] * downhill + along[1] * DVec3::Z;
    let mut body = ball(2, start, velocity).bounce(0.5).radius(RADIUS).mass(2.0).spin(spin);
    (face.roughness, body.roughness) = (roughness, roughness);
    let scene = empty().gravity(-GRAVITY).body(face).body(body);
    Incline { scene, downhill, normal, start }
}

fn rough(friction: f64) -> Roughness {
    Roughness { friction, ..Roughness::default() }
}

fn first(events: &[Event], kind: EventKind) -> &Event {
    events.iter().find(|event| event.kind == kind).unwrap_or_else(|| panic!("no {}: {events:?}", kind.name()))
}

fn spin_of(sim: &Simulation, id: i64) -> DVec3 {
    state_of(sim, id).turn.expect("a scene that rubs").spin
}

/// Rolling 5/7 g sin θ, sliding g (sin θ − μ cos θ), each from rest.
#[test]
fn ball_from_rest_rolls_or_slides_down_an_incline() {
    let cases = [
        (0.3, 2.396_584_004_303_436, ContactState::Roll),
        (0.05, 2.894_298_375_529_322, ContactState::Slide),
    ];
    for (friction, expected, state) in cases {
        let Incline { scene, downhill, start, .. } =
            incline(20_f64.to_radians(), rough(friction), [0.0; 2], DVec3::ZERO);
        for sampling in SAMPLINGS {
            let mut sim = simulation(&scene);
            watch(&mut sim, 4.0, sampling, |sim, _| {
                let (t, now) = (sim.time(), state_of(sim, 2));
                let off = (now.position - start - 0.5 * expected * t * t * downhill).length();
                assert!(off <= 1e-12 * (1.0 + t * t), "μ {friction}, t {t}: {off:e} m off");
                assert_books(sim, 1e-12);
            });
            assert_eq!(state_of(&sim, 2).contact, state);
        }
    }
}

/// Least friction to roll is (2/7) tan θ.
#[test]
fn ball_rolls_from_the_least_friction_on() {
    let angle = 20_f64.to_radians();
    let least = 2.0 / 7.0 * angle.tan();
    for (friction, expected) in
        [(least * (1.0 + 1e-9), ContactState::Roll), (least * (1.0 - 1e-9), ContactState::Slide)]
    {
        let mut sim = simulation(&incline(angle, rough(friction), [0.0; 2], DVec3::ZERO).scene);
        advance(&mut sim, 1.0, Sampling::Events);
        assert_eq!(state_of(&sim, 2).contact, expected, "μ {friction}");
    }
}

/// v₀ = 1 m/s downhill without spin, μ = 0.3: it rolls at |s₀|/(B − A); uphill at |s₀|/(A + B).
#[test]
fn slip_along_the_fall_line_ends_when_the_closed_form_says() {
    let angle = 20_f64.to_radians();
    let (sin, cos) = angle.sin_cos();
    for (speed, expected) in
        [(1.0, 0.158_125_611_027_182_4), (-1.0, 1.0 / (GRAVITY * sin + 3.5 * 0.3 * GRAVITY * cos))]
    {
        let Incline { scene, downhill, .. } = incline(angle, rough(0.3), [speed, 0.0], DVec3::ZERO);
        let mut sim = simulation(&scene);
        let events = advance(&mut sim, 2.0, Sampling::Every(0.1));
        let rolls = first(&events, EventKind::Roll).time;
        assert!((rolls / expected - 1.0).abs() <= 1e-14, "{rolls} instead of {expected}");
        // s = 0 in v = v₀ + (s − s₀) 2/7 + 5/7 a_t t.
        let v = downhill * (speed * 5.0 / 7.0 + 5.0 / 7.0 * GRAVITY * sin * 2.0);
        assert!((state_of(&sim, 2).velocity - v).length() <= 1e-14 * v.length());
        assert_books(&sim, 1e-12);
    }
}

/// On a level table the slip of any start ends after 2|s₀|/(7μg), and the ball rolls at v₀ − 2/7 s₀.
#[test]
fn ball_on_a_table_slides_straight_in_slip_and_rolls_on() {
    for (velocity, spin) in [
        ([2.0, 0.0], DVec3::ZERO),
        ([2.0, 1.0], dvec3(3.0, 50.0, -20.0)),
        ([1.0, 0.0], dvec3(0.0, 0.0, 10.0 / RADIUS)),
        ([0.0, 0.0], dvec3(-7.0, 3.0, 40.0)),
    ] {
        let Incline { scene, normal, start, .. } = incline(0.0, rough(0.2), velocity, spin);
        let v = dvec3(velocity[0], 0.0, velocity[1]);
        let slip = v - RADIUS * (spin - spin.dot(normal) * normal).cross(normal);
        let expected = 2.0 * slip.length() / (7.0 * 0.2 * GRAVITY);
        let mut sim = simulation(&scene);
        let events = advance(&mut sim, expected + 1.0, Sampling::Every(0.03));
        let rolls = first(&events, EventKind::Roll).time;
        assert!((rolls / expected - 1.0).abs() <= 1e-12, "{rolls} instead of {expected}");
        let rolling = v - 2.0 / 7.0 * slip;
        let now = state_of(&sim, 2);
        assert!((now.velocity - rolling).length() <= 1e-14 * (v.length() + slip.length()));
        let way = 0.5 * (v + rolling) * expected + rolling;
        let off = (now.position - start - way).length();
        assert!(off <= 1e-12 * (1.0 + way.length()), "{off:e} m off");
        let turning = spin_of(&sim, 2);
        assert!((turning.y - spin.y).abs() <= 1e-14 * spin.length(), "nothing rubs about the normal");
        assert!((turning.cross(RADIUS * normal) - rolling).length() <= 1e-13);
        assert_books(&sim, 1e-12);
    }
}

/// A slip across the fall line turns: |s| = C u^κ/sin φ, and it ends when the formula says. The way is compared with small
/// steps of the equations of motion.
#[test]
fn slip_that_turns_ends_when_the_formula_says() {
    let angle = 20_f64.to_radians();
    let (sin, cos) = angle.sin_cos();
    for (friction, along) in [(0.3, [1.0, 0.7]), (0.3, [-1.0, 0.2]), (0.15, [0.0, 1.0])] {
        let Incline { scene, downhill, normal, start } = incline(angle, rough(friction), along, DVec3::ZERO);
        let (a, b) = (GRAVITY * sin, 3.5 * friction * GRAVITY * cos);
        let (kappa, speed) = (b / a, along[0].hypot(along[1]));
        let phi = along[1].abs().atan2(along[0]);
        let u = (phi / 2.0).tan();
        let c = speed * phi.sin() / u.powf(kappa);
        let expected =
            c / (2.0 * a) * (u.powf(kappa - 1.0) / (kappa - 1.0) + u.powf(kappa + 1.0) / (kappa + 1.0));
        let mut sim = simulation(&scene);
        let mut events = advance(&mut sim, 0.5 * expected, Sampling::Events);
        let slip = |sim: &Simulation| state_of(sim, 2).velocity - spin_of(sim, 2).cross(RADIUS * normal);
        let half = slip(&sim);
        let phi = half.dot(DVec3::Z).abs().atan2(half.dot(downhill));
        let formula = c * (phi / 2.0).tan().powf(kappa) / phi.sin();
        assert!((half.length() / formula - 1.0).abs() <= 1e-9, "{} instead of {formula}", half.length());
        events.extend(advance(&mut sim, expected + 1.0, Sampling::Events));
        let rolls = first(&events, EventKind::Roll);
        assert!((rolls.time / expected - 1.0).abs() <= 1e-9, "{} instead of {expected}", rolls.time);
        let end = where_slip_ends(along, [a, b], expected);
        let end = start + end[0] * downhill + end[1] * DVec3::Z - RADIUS * normal;
        assert!((rolls.point - end).length() <= 1e-9, "{} instead of {end}", rolls.point);
        assert_books(&sim, 1e-12);
    }
}

/// Where a ball without spin has slid to, by Runge–Kutta steps on (x, s) in a time that stretches towards the end.
fn where_slip_ends(along: [f64; 2], [a, b]: [f64; 2], end: f64) -> [f64; 2] {
    let drive = dvec3(a, 0.0, 0.0);
    let slip = dvec3(along[0], along[1], 0.0);
    let velocity = |s: DVec3, t: f64| slip + (s - slip) * 2.0 / 7.0 + drive * (5.0 / 7.0 * t);
    // t = T (1 − e^−σ)
    let rate = |sigma: f64, s: DVec3| {
        let left = end * (-sigma).exp();
        (left * velocity(s, end - left), left * (drive - b * s.normalize_or_zero()))
    };
    let (steps, whole) = (400_000, 25.0);
    let h = whole / f64::from(steps);
    let (mut x, mut s) = (DVec3::ZERO, slip);
    for step in 0..steps {
        let sigma = f64::from(step) * h;
        let (k1, l1) = rate(sigma, s);
        let (k2, l2) = rate(sigma + 0.5 * h, s + 0.5 * h * l1);
        let (k3, l3) = rate(sigma + 0.5 * h, s + 0.5 * h * l2);
        let (k4, l4) = rate(sigma + h, s + h * l3);
        x += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        s += h / 6.0 * (l1 + 2.0 * (l2 + l3) + l4);
    }
    [x.x, x.y]
}

/// Rolling friction slows by μ_R g and ends in rest; on a slope below it a ball stays.
#[test]
fn rolling_friction_brings_a_ball_to_rest() {
    let law = Roughness { friction: 0.2, rolling: 0.01, tangential: 0.0 };
    let Incline { scene, .. } = incline(0.0, law, [0.5, 0.0], dvec3(0.0, 0.0, -0.5 / RADIUS));
    let mut sim = simulation(&scene);
    let events = advance(&mut sim, 20.0, Sampling::Every(0.1));
    let rest = events.last().expect("it rests");
    let expected = 0.5 / (0.01 * GRAVITY);
    assert_eq!(rest.kind, EventKind::Rest);
    assert!((rest.time / expected - 1.0).abs() <= 1e-12, "{} instead of {expected}", rest.time);
    assert_eq!((state_of(&sim, 2).contact, state_of(&sim, 2).velocity), (ContactState::Rest, DVec3::ZERO));
    assert_books(&sim, 1e-12);
    let Incline { scene, start, .. } = incline(0.01, law, [0.0; 2], DVec3::ZERO);
    let mut sim = simulation(&scene);
    advance(&mut sim, 100.0, Sampling::Every(10.0));
    assert_eq!(state_of(&sim, 2).position, start, "5/7 sin θ is less than 0.01");
}

/// Walton's law against a wall: J_t = min(μ J_n, 2/7 (1 + β) m |s|).
#[test]
fn a_ball_that_hits_a_wall_slips_or_grips() {
    for (friction, tangential) in [(0.1, 0.0), (0.1, 0.7), (5.0, 0.0), (5.0, 0.6), (5.0, 1.0)] {
        let wall = plate(1, dvec3(9.0, 5.0, 5.0), dvec3(0.0, FRAC_PI_2, 0.0), 5.0, 5.0);
        let (v, spin) = (dvec3(3.0, 1.0, -0.5), dvec3(4.0, 6.0, -3.0));
        let hit = ball(2, DVec3::splat(5.0), v).radius(0.5).mass(2.0).spin(spin).bounce(0.8);
        let law = |body: Body| body.friction(friction).tangential(tangential);
        let mut sim = simulation(&empty().body(law(wall)).body(law(hit)));
        advance(&mut sim, 2.0, Sampling::Events);
        let slip = dvec3(0.0, v.y, v.z) + spin.cross(dvec3(0.5, 0.0, 0.0));
        let pressing = 1.8 * 2.0 * 3.0;
        let size = (friction * pressing).min((1.0 + tangential) * 2.0 / 7.0 * 2.0 * slip.length());
        let impulse = -size * slip.normalize();
        let after = dvec3(-0.8 * 3.0, v.y, v.z) + impulse / 2.0;
        let turned = spin + dvec3(0.5, 0.0, 0.0).cross(impulse) / (0.4 * 2.0 * 0.25);
        assert!(
            (state_of(&sim, 2).velocity - after).length() <= 1e-15 * 10.0,
            "μ {friction}, β {tangential}"
        );
        assert!((spin_of(&sim, 2) - turned).length() <= 1e-14, "μ {friction}, β {tangential}");
        assert_books(&sim, 1e-14);
    }
}

/// Two balls that meet alone keep momentum and angular momentum; a superball of both laws keeps its energy.
#[test]
fn balls_that_meet_keep_momentum_and_angular_momentum() {
    for (friction, tangential) in [(0.06, 0.0), (0.5, 0.4), (100.0, 1.0)] {
        let law = |body: Body| body.friction(friction).tangential(tangential);
        let one = ball(1, dvec3(2.0, 5.0, 5.0), dvec3(2.0, 0.1, 0.0)).spin(dvec3(0.0, 30.0, 5.0));
        let other =
            ball(2, dvec3(6.0, 5.2, 5.3), DVec3::ZERO).mass(2.5).radius(0.4).spin(dvec3(1.0, 2.0, 3.0));
        let mut sim = simulation(&empty().body(law(one)).body(law(other)));
        let before = (sim.energy().kinetic, sim.angular_momentum().unwrap().value, sim.momentum().value);
        let events = advance(&mut sim, 3.0, Sampling::Events);
        assert_eq!(events.len(), 1);
        let after = (sim.energy().kinetic, sim.angular_momentum().unwrap().value, sim.momentum().value);
        assert!((after.1 - before.1).length() <= 1e-14 * before.1.length());
        assert!((after.2 - before.2).length() <= 1e-15 * before.2.length());
        assert!(after.0 <= before.0 * (1.0 + 1e-15));
        if tangential == 1.0 {
            assert!((after.0 / before.0 - 1.0).abs() <= 1e-15, "nothing is lost without sliding");
        }
        assert_books(&sim, 1e-15);
    }
}

/// Without friction, whatever the spin, the bits of a scene are those without spin, and nothing is stored of it.
#[test]
fn spin_without_friction_changes_no_bit() {
    let smooth = |spin: DVec3| {
        let one = ball(1, dvec3(2.0, 5.0, 5.0), dvec3(2.0, 0.1, 0.0)).bounce(0.8).spin(spin).friction(0.5);
        empty().gravity(-GRAVITY).walls(10).body(one).ball(2, dvec3(5.0, 4.0, 5.0), DVec3::X)
    };
    let plain = run(&smooth(DVec3::ZERO), 5.0, Sampling::Events);
    assert_same_bits(&plain, &run(&smooth(dvec3(1.0, -20.0, 3.0)), 5.0, Sampling::Events), "spin");
    assert!(plain.states.iter().all(|(_, state)| state.turn.is_none()));
    let one = empty().gravity(-GRAVITY).walls(10).ball(2, dvec3(5.0, 4.0, 5.0), DVec3::X);
    assert!(!simulation(&one).plan().spin);
}

/// Two balls on a cloth, struck off centre: the cloth, both balls and the hop between them, in every way of sampling.
#[test]
fn a_cut_shot_has_the_same_bits_however_time_is_divided() {
    let cloth = plate(1, dvec3(5.0, 0.0, 5.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 5.0, 5.0);
    let radius = 0.028_575;
    let billiard = |id: i64, x: f64, z: f64, v: DVec3, spin: DVec3| {
        let on = ball(id, dvec3(x, radius, z), v).radius(radius).mass(0.17);
        on.bounce(0.95).friction(0.06).rolling(0.01).spin(spin)
    };
    let scene = empty()
        .gravity(-GRAVITY)
        .body(cloth.bounce(0.5).friction(0.6).rolling(0.01))
        .body(billiard(2, 3.0, 5.0, DVec3::X * 1.5, dvec3(0.0, 30.0, -1.5 / radius)))
        .body(billiard(3, 4.0, 5.02, DVec3::ZERO, DVec3::ZERO));
    let events = run(&scene, 12.0, Sampling::Events);
    for sampling in SAMPLINGS {
        assert_same_bits(&events, &run(&scene, 12.0, sampling), &format!("{sampling:?}"));
    }
    let rests = events.events.iter().filter(|event| event.kind == EventKind::Rest).count();
    assert!(rests >= 2, "{:?}", events.events);
    assert!(events.states.iter().all(|(_, state)| state.contact == ContactState::Rest));
}

#[test]
fn the_thesis_says_that_it_has_no_friction() {
    let Incline { scene, .. } = incline(0.3, rough(0.3), [0.0; 2], DVec3::ZERO);
    let sim = Simulation::with_method(&scene, Method::Thesis).unwrap();
    assert!(sim.plan().left_out.iter().any(|what| what.contains("friction")), "{:?}", sim.plan());
    assert!(sim.start_warnings().iter().any(|warning| warning.message.contains("friction")));
}
