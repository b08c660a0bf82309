//! One line of the states file and one of the events file.

use glam::DVec3;
use serde::Serialize;

use crate::record::{self, Column, Cost, EventLine, Who};
use crate::sim::{BodyRef, Event, Simulation};

/// Of one body at one time. Orientation and spin are there where bodies rub.
const STATE_COLUMNS: &[Column] = &[
    Column::new("t", "/t"),
    Column::new("id", "/id"),
    Column::new("x", "/x/0"),
    Column::new("y", "/x/1"),
    Column::new("z", "/x/2"),
    Column::new("vx", "/v/0"),
    Column::new("vy", "/v/1"),
    Column::new("vz", "/v/2"),
    Column::new("state", "/state"),
    Column::new("qx", "/q/0"),
    Column::new("qy", "/q/1"),
    Column::new("qz", "/q/2"),
    Column::new("qw", "/q/3"),
    Column::new("wx", "/w/0"),
    Column::new("wy", "/w/1"),
    Column::new("wz", "/w/2"),
];

static DT_INDEX: Column = Column::new("dt_index", "/dt_index");

pub fn state_columns() -> Vec<&'static Column> {
    STATE_COLUMNS.iter().collect()
}

/// Those that every row of an event has.
pub fn event_columns() -> Vec<&'static Column> {
    record::EVENT_COLUMNS.iter().chain([&DT_INDEX]).collect()
}

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
    #[serde(flatten)]
    event: EventLine<'a>,
    dt_index: u64,
    /// Where it is asked for.
    #[serde(flatten)]
    cost: Option<Cost>,
}

impl<'a> EventRow<'a> {
    /// Of an event of the `dt_index`-th Δt.
    pub fn new(event: &Event, bodies: (Who<'a>, Option<Who<'a>>), dt_index: u64, cost: Option<Cost>) -> Self {
        Self { event: EventLine::new(event, bodies.0, bodies.1), dt_index, cost }
    }
}

/// To a reader −0 is 0.
fn numbers(vector: DVec3) -> [f64; 3] {
    (vector + DVec3::ZERO).to_array()
}
