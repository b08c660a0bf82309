//! Makes the frame that the rest of the program sees.

use std::sync::Arc;

use super::recorder::RunRecorder;
use super::run::Run;
use super::{BodyFrame, ContactFrame, Frame, Lag};
use crate::sim::{BodyRef, Plan, Simulation};

/// Occupied tiles that a frame lists; an overlay that shows more would be a solid block.
const MAX_TILES: usize = 20_000;

/// Contacts of heaps that a frame lists, the strongest.
const MAX_CONTACTS: usize = 20_000;

/// What a runner measured with its clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pace {
    pub(super) step_wall_s: f64,
    pub(super) events_per_s: f64,
    pub(super) real_speed: f64,
    pub(super) lag: Option<Lag>,
}

pub(super) fn frame_of(recorder: &mut RunRecorder, revision: u64, pace: Pace) -> Frame {
    let base = Frame {
        revision,
        state: recorder.state(),
        method: recorder.method,
        problems: recorder.problems.clone(),
        step_wall_s: pace.step_wall_s,
        events_per_s: pace.events_per_s,
        real_speed: pace.real_speed,
        lag: pace.lag,
        ..Frame::default()
    };
    match &mut recorder.run {
        None => base,
        Some(run) => {
            run.look_for_overlap();
            with_run(base, run)
        }
    }
}

fn with_run(base: Frame, run: &Run) -> Frame {
    let simulation = &run.simulation;
    let plan: &Plan = simulation.plan();
    let contacts = contacts(simulation);
    Frame {
        time: simulation.time(),
        dt_index: run.grid.index(),
        step: run.grid.span(),
        open_step: run.grid.open,
        bodies: bodies(simulation),
        stepped: simulation.stepped(),
        contacts_truncated: contacts.len() >= MAX_CONTACTS,
        contacts,
        events: run.rows.list.iter().cloned().collect(),
        events_truncated: run.rows.truncated,
        event_count: run.last_event,
        energy: Some(simulation.energy()),
        momentum: Some(simulation.momentum()),
        largest_jump: run.drift.largest(),
        worst_overlap: run.worst_overlap,
        counters: simulation.counters(),
        plan: Arc::new(plan.clone()),
        tiling: Arc::new(simulation.tiling(MAX_TILES)),
        can_step_back: run.history.can_go_back(simulation),
        fault: run.message.clone(),
        ..base
    }
}

fn bodies(simulation: &Simulation) -> Vec<BodyFrame> {
    simulation
        .dynamic_bodies()
        .filter_map(|body| {
            let state = simulation.state(body)?;
            Some(BodyFrame {
                key: simulation.key(body),
                position: state.position,
                velocity: state.velocity,
                acceleration: state.acceleration,
                force: simulation.total_force(body),
                kinetic: simulation.kinetic(body)?,
                contact: state.contact,
                turn: state.turn,
            })
        })
        .collect()
}

fn contacts(simulation: &Simulation) -> Vec<ContactFrame> {
    let position = |body: BodyRef| simulation.state(body).map(|state| state.position);
    let contacts = simulation.contact_forces(MAX_CONTACTS).into_iter();
    contacts
        .map(|contact| ContactFrame {
            keys: [contact.a, contact.b].map(|body| simulation.key(body)),
            ends: [contact.a, contact.b].map(|body| position(body).unwrap_or(contact.point)),
            force: contact.force,
        })
        .collect()
}
