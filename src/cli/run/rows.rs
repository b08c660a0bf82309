//! One line of the states file and one of the events file.

use glam::DVec3;
use serde::Serialize;

use crate::sim::{BodyRef, Event, EventKind, Simulation};

/// A column of CSV and where its value stands in the JSON of a row.
pub struct Column {
    pub name: &'static str,
    pub at: &'static str,
}

const fn column(name: &'static str, at: &'static str) -> Column {
    Column { name, at }
}

/// Of one body at one time.
pub const STATE_COLUMNS: &[Column] = &[
    column("t", "/t"),
    column("id", "/id"),
    column("x", "/x/0"),
    column("y", "/x/1"),
    column("z", "/x/2"),
    column("vx", "/v/0"),
    column("vy", "/v/1"),
    column("vz", "/v/2"),
    column("state", "/state"),
];

pub const EVENT_COLUMNS: &[Column] = &[
    column("seq", "/seq"),
    column("t", "/t"),
    column("kind", "/kind"),
    column("a", "/a"),
    column("b", "/b"),
    column("point_x", "/point/0"),
    column("point_y", "/point/1"),
    column("point_z", "/point/2"),
    column("normal_x", "/normal/0"),
    column("normal_y", "/normal/1"),
    column("normal_z", "/normal/2"),
    column("impulse", "/impulse"),
    column("vn_before", "/vn_before"),
    column("vn_after", "/vn_after"),
    column("group", "/group"),
    column("bodies", "/bodies"),
    column("dt_index", "/dt_index"),
];

/// All dynamic bodies at one time.
#[derive(Serialize)]
pub struct StateRow<'a> {
    t: f64,
    bodies: Vec<BodyRow<'a>>,
}

#[derive(Serialize)]
struct BodyRow<'a> {
    id: &'a str,
    x: [f64; 3],
    v: [f64; 3],
    /// Where bodies rub: the unit quaternion x, y, z, w, world from body, and the angular velocity, rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    q: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    w: Option<[f64; 3]>,
    state: &'static str,
}

impl<'a> StateRow<'a> {
    /// Of the bodies that `wanted` says.
    pub fn new(sim: &'a Simulation, wanted: impl Fn(BodyRef) -> bool) -> Self {
        let bodies = sim.dynamic_bodies().filter(|body| wanted(*body)).filter_map(|body| {
            let state = sim.state(body)?;
            Some(BodyRow {
                id: sim.label(body),
                x: numbers(state.position),
                v: numbers(state.velocity),
                q: state.turn.map(|turn| turn.orientation.to_array()),
                w: state.turn.map(|turn| numbers(turn.spin)),
                state: state.contact.name(),
            })
        });
        Self { t: sim.time(), bodies: bodies.collect() }
    }

    /// Each body with the time, for tables.
    pub fn bodies(&self) -> impl Iterator<Item = TimedBody<'_>> {
        self.bodies.iter().map(|body| TimedBody { t: self.t, body })
    }
}

/// One body at one time.
#[derive(Serialize)]
pub struct TimedBody<'a> {
    t: f64,
    #[serde(flatten)]
    body: &'a BodyRow<'a>,
}

/// One contact of one event.
#[derive(Serialize)]
pub struct EventRow<'a> {
    seq: u64,
    t: f64,
    kind: &'static str,
    a: &'a str,
    b: Option<&'a str>,
    point: [f64; 3],
    normal: [f64; 3],
    impulse: f64,
    vn_before: f64,
    vn_after: f64,
    group: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<u32>,
    dt_index: u64,
}

impl<'a> EventRow<'a> {
    pub fn new(sim: &'a Simulation, event: &Event, dt_index: u64) -> Self {
        Self {
            seq: event.seq,
            t: event.time,
            kind: event.kind.name(),
            a: sim.label(event.a),
            b: event.b.map(|b| sim.label(b)),
            point: numbers(event.point),
            normal: numbers(event.normal),
            impulse: event.impulse,
            vn_before: event.vn_before,
            vn_after: event.vn_after,
            group: event.group,
            bodies: is_about_many(event.kind).then_some(event.bodies),
            dt_index,
        }
    }
}

/// Whether a kind of event is about a whole group of bodies.
fn is_about_many(kind: EventKind) -> bool {
    matches!(kind, EventKind::Dense | EventKind::GroupRest)
}

/// To a reader −0 is 0.
fn numbers(vector: DVec3) -> [f64; 3] {
    (vector + DVec3::ZERO).to_array()
}
