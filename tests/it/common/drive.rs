//! Drives a simulation through a span of time in different ways, which must all give the same bits.

use polyscene::scene::{Scene, Shape};
use polyscene::sim::{BodyRef, BodyState, Event, EventKind, Simulation};
use polyscene::study::Random;

/// Where the sample times of a run come from.
#[derive(Clone, Copy, Debug)]
pub enum Sampling {
    /// Every Δt seconds.
    Every(f64),
    /// At seeded random times, between 0 and 0.2 s apart.
    Random(u64),
    /// One `begin` for the whole span, then event by event.
    Events,
}

/// The ways of sampling that every invariance test goes through.
pub const SAMPLINGS: [Sampling; 5] = [
    Sampling::Every(1.0),
    Sampling::Every(1.0 / 60.0),
    Sampling::Every(1e-3),
    Sampling::Random(7),
    Sampling::Events,
];

/// What came out of a run.
pub struct Run {
    pub events: Vec<Event>,
    pub states: Vec<(BodyRef, BodyState)>,
    pub hash: u64,
}

pub fn simulation(scene: &Scene) -> Simulation {
    Simulation::new(scene).unwrap_or_else(|err| panic!("{err}: {:?}", err.problems))
}

/// Runs a scene from its start.
pub fn run(scene: &Scene, until: f64, sampling: Sampling) -> Run {
    let mut sim = simulation(scene);
    let events = advance(&mut sim, until, sampling);
    finished(&sim, events)
}

/// Collects the end of a run.
pub fn finished(sim: &Simulation, events: Vec<Event>) -> Run {
    Run { events, states: states(sim), hash: sim.hash() }
}

/// Goes on to a later time and gives the events on the way.
pub fn advance(sim: &mut Simulation, until: f64, sampling: Sampling) -> Vec<Event> {
    let mut events = Vec::new();
    watch(sim, until, sampling, |sim, event| {
        // Looking must not change anything.
        std::hint::black_box((sim.energy(), sim.momentum()));
        events.extend(event);
    });
    events
}

/// Goes on to a later time; `see` is called at each event and, with `None`, at each sample.
pub fn watch(
    sim: &mut Simulation,
    until: f64,
    sampling: Sampling,
    mut see: impl FnMut(&Simulation, Option<&Event>),
) {
    let start = sim.time();
    let mut random = Random::new(if let Sampling::Random(seed) = sampling { seed } else { 0 });
    let mut last = start;
    for sample in 1.. {
        let target = match sampling {
            Sampling::Every(dt) => start + sample as f64 * dt,
            Sampling::Random(_) => last + random.range(0.0, 0.2),
            Sampling::Events => until,
        };
        last = target.min(until);
        sim.begin(last);
        if matches!(sampling, Sampling::Events) {
            while let Some(event) = sim.next_event().expect("a run without faults") {
                see(sim, Some(&event));
            }
        }
        sim.finish(&mut |sim, event| see(sim, Some(event))).expect("a run without faults");
        assert_eq!(sim.time(), last, "a step must end exactly where it was asked to");
        see(sim, None);
        if last >= until {
            return;
        }
    }
}

pub fn states(sim: &Simulation) -> Vec<(BodyRef, BodyState)> {
    sim.dynamic_bodies().map(|body| (body, sim.state(body).expect("a listed body has a state"))).collect()
}

/// The state of the dynamic body with this UserID.
pub fn state_of(sim: &Simulation, id: i64) -> BodyState {
    let label = id.to_string();
    let body = sim.dynamic_bodies().find(|&body| sim.label(body) == label);
    sim.state(body.unwrap_or_else(|| panic!("no body {id}"))).expect("a listed body has a state")
}

/// What is promised of overlaps and of energy: exactness from event to event, and bounds once bodies are stepped.
#[derive(Clone, Copy, Debug)]
pub struct Promise {
    /// m.
    pub overlap: f64,
    /// Climb of the total energy, J.
    pub climb: f64,
}

impl Promise {
    /// Of stepped groups: a thousandth of the smallest radius, and a hundredth of the work of moving the heaviest body
    /// by its radius.
    pub fn of_steps(sim: &Simulation, scene: &Scene) -> Self {
        let radii = scene.bodies.iter().filter_map(|body| match (&body.shape, body.is_dynamic()) {
            (Shape::Sphere { radius }, true) => Some((body.key, *radius)),
            _ => None,
        });
        let (mut smallest, mut work) = (f64::INFINITY, 0.0_f64);
        for (key, radius) in radii {
            smallest = smallest.min(radius);
            let force = sim.find(key).map_or(0.0, |body| sim.total_force(body).length());
            work = work.max(force * radius);
        }
        Self { overlap: 1e-3 * smallest, climb: 1e-2 * work }
    }
}

/// Whether any bodies have been stepped.
pub fn was_stepped(sim: &Simulation) -> bool {
    sim.counters().steps > 0
}

/// Fails where energy, momentum or angular momentum is not what the books say.
pub fn assert_books(sim: &Simulation, limit: f64) {
    let residual = sim.energy().residual.expect("gravity has a potential");
    assert!(residual.abs() <= limit, "t {}: energy residual {residual:e}", sim.time());
    assert!(sim.momentum().residual <= 1e-13, "momentum residual {:e}", sim.momentum().residual);
    let angular = sim.angular_momentum().expect("a scene that rubs").residual;
    assert!(angular <= 1e-13, "angular momentum residual {angular:e}");
}

pub fn impacts(events: &[Event]) -> Vec<&Event> {
    events.iter().filter(|event| event.kind == EventKind::Impact).collect()
}

/// Fails at the first difference of any bit.
pub fn assert_same_bits(expected: &Run, got: &Run, what: &str) {
    for (left, right) in expected.events.iter().zip(&got.events) {
        assert_eq!(event_bits(left), event_bits(right), "{what}: events differ: {left:?} and {right:?}");
    }
    assert_eq!(expected.events.len(), got.events.len(), "{what}: number of events");
    assert_eq!(expected.states.len(), got.states.len(), "{what}: number of bodies");
    for ((body, left), (_, right)) in expected.states.iter().zip(&got.states) {
        assert_eq!(state_bits(left), state_bits(right), "{what}: {body:?} differs: {left:?} and {right:?}");
    }
    assert_eq!(expected.hash, got.hash, "{what}: hash");
}

fn event_bits(event: &Event) -> impl PartialEq + std::fmt::Debug {
    let numbers = [event.time, event.impulse, event.vn_before, event.vn_after].map(f64::to_bits);
    let vectors = [event.point.to_array(), event.normal.to_array()].map(|v| v.map(f64::to_bits));
    (event.seq, event.kind, event.a, event.b, event.group, event.row_in_group, numbers, vectors)
}

fn state_bits(state: &BodyState) -> impl PartialEq + std::fmt::Debug {
    let vectors = [state.position, state.velocity, state.acceleration];
    let turn = state
        .turn
        .map(|turn| (turn.orientation.to_array().map(f64::to_bits), turn.spin.to_array().map(f64::to_bits)));
    (vectors.map(|v| v.to_array().map(f64::to_bits)), turn, state.contact)
}
