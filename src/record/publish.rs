//! Makes the frame that the rest of the program sees.

use std::sync::Arc;

use super::crossings::crossings;
use super::frame::{BodyFrame, ContactFrame, Frame, Lag, Recorded};
use super::ledger::EventRow;
use super::paths::{at_impact, paths};
use super::recorder::RunRecorder;
use super::run::Run;
use super::ways::PathSpan;
use crate::scene::NodeKey;
use crate::sim::{BodyRef, BodyState, Simulation};

/// Occupied tiles that a frame lists; an overlay that shows more would be a solid block.
const MAX_TILES: usize = 20_000;

/// Contacts of heaps that a frame lists, the strongest.
const MAX_CONTACTS: usize = 20_000;

/// Events of one Δt that a frame lists; of more the last.
const MAX_ROWS: u64 = 20_000;

/// What a runner measured with its clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pace {
    pub(super) step_wall_s: f64,
    pub(super) events_per_s: f64,
    pub(super) real_speed: f64,
    pub(super) lag: Option<Lag>,
}

pub(super) fn frame_of(recorder: &mut RunRecorder, revision: u64, command: u64, pace: Pace) -> Frame {
    let base = Frame {
        revision,
        command,
        written: recorder.written.clone(),
        motion: recorder.motion.clone(),
        state: recorder.state(),
        method: recorder.method,
        problems: recorder.problems.clone(),
        step_wall_s: pace.step_wall_s,
        events_per_s: pace.events_per_s,
        real_speed: pace.real_speed,
        lag: pace.lag,
        cancelled: recorder.run.as_ref().and_then(|run| recorder.cancelling.found(run)),
        seeks_cancelled: recorder.run.as_ref().is_some_and(|run| recorder.cancelling.is_due(run)),
        recorded: recorder.run.as_ref().map_or_else(Arc::default, |run| {
            let (bytes, can_bring_back) = (recorder.bytes(), recorder.can_bring_back());
            Arc::new(Recorded { bytes, can_bring_back, ..recorded(run) })
        }),
        ..Frame::default()
    };
    let (span, crossed, tiles) = (recorder.paths, recorder.crossings.clone(), recorder.tiles);
    match &mut recorder.run {
        None => base,
        Some(run) if run.is_settled() => {
            run.look_for_overlap();
            settled(looked_up(base, run, span, &crossed), run, tiles)
        }
        Some(run) => Frame { bodies: bodies_looked_up(run), ..looked_up(base, run, span, &crossed) },
    }
}

/// What the recording says of the moment shown.
fn looked_up(base: Frame, run: &Run, span: Option<PathSpan>, crossed: &[NodeKey]) -> Frame {
    let (events, events_truncated) = events(run);
    Frame {
        time: run.cursor.time,
        dt_index: run.grid.index(),
        step: run.grid.span(),
        open_step: run.grid.open,
        events,
        events_truncated,
        ledger: run.recording.ledger.clone(),
        at_impact: Arc::new(at_impact(run)),
        paths: span.map_or_else(Arc::default, |span| Arc::new(paths(run, span))),
        crossings: Arc::new(crossings(run, crossed)),
        event_count: run.cursor.event,
        edits_before: edits_before(run),
        largest_jump: run.drift.largest(run.cursor.event),
        worst_overlap: run.overlaps.worst(run.cursor),
        counters: run.simulation.counters(),
        plan: Arc::new(run.simulation.plan().clone()),
        can_step_back: run.can_step_back(),
        fault: run.fault_here().map(|fault| fault.why.clone()),
        refused: run.refused.clone(),
        message: run.message.clone(),
        ..base
    }
}

/// What the simulation adds once it stands there.
fn settled(frame: Frame, run: &Run, tiles: bool) -> Frame {
    let simulation = &run.simulation;
    let contacts = contacts(simulation);
    Frame {
        is_settled: true,
        bodies: bodies(simulation),
        stepped: simulation.stepped(),
        contacts_truncated: contacts.len() >= MAX_CONTACTS,
        contacts,
        energy: Some(simulation.energy()),
        momentum: Some(simulation.momentum()),
        tiling: if tiles { Arc::new(simulation.tiling(MAX_TILES)) } else { Arc::default() },
        ..frame
    }
}

fn edits_before(run: &Run) -> usize {
    run.recording.edits().iter().take_while(|edits| edits.at.is_not_after(run.cursor)).count()
}

fn recorded(run: &Run) -> Recorded {
    let recording = &run.recording;
    Recorded {
        from: recording.from().time,
        to: recording.end.time,
        bytes: run.bytes(),
        budget: recording.budget(),
        edits: recording.edits().iter().map(|edits| edits.at.time).collect(),
        divisions: recording.ticks.divisions(),
        can_bring_back: false,
    }
}

/// Events of the Δt around the moment shown, up to it; and whether older ones are left out.
fn events(run: &Run) -> (Vec<Arc<EventRow>>, bool) {
    let ledger = &run.recording.ledger;
    let Some((start, _)) = run.grid.span() else { return (Vec::new(), false) };
    let before = match run.recording.ticks.around(start).0 {
        Some(tick) if tick.at.time == start => tick.at.event,
        _ => ledger.number_until(start),
    };
    let count = run.cursor.event.saturating_sub(before);
    let first = run.cursor.event + 1 - count.min(MAX_ROWS);
    let rows = (first..=run.cursor.event).filter_map(|number| ledger.get(number)).cloned().collect();
    (rows, count > MAX_ROWS)
}

fn bodies(simulation: &Simulation) -> Vec<BodyFrame> {
    let states = simulation.dynamic_bodies().filter_map(|body| Some((body, simulation.state(body)?)));
    let frames =
        states.filter_map(|(body, state)| body_frame(simulation, body, &state, simulation.total_force(body)));
    all_of(simulation, frames)
}

/// Frames of all dynamic bodies, in no more memory than they take.
fn all_of(simulation: &Simulation, frames: impl Iterator<Item = BodyFrame>) -> Vec<BodyFrame> {
    let mut all = Vec::with_capacity(simulation.dynamic_count());
    all.extend(frames);
    all
}

/// The bodies that were there at the moment shown, with their recorded motion and the forces of then.
pub(super) fn bodies_looked_up(run: &Run) -> Vec<BodyFrame> {
    let time = run.cursor.time;
    let then = run.recording.keyframes.before(run.cursor).map(|key| key.snapshot.simulation());
    let simulation = then.unwrap_or(&run.simulation);
    let moment = run.recording.at(run.cursor);
    let pieces = simulation.dynamic_bodies().filter_map(|body| Some((body, moment.piece(body)?)));
    let frames = pieces.filter_map(|(body, piece)| {
        body_frame(simulation, body, &piece.at(time), simulation.force_on(body, piece, time))
    });
    all_of(simulation, frames)
}

fn body_frame(
    simulation: &Simulation,
    body: BodyRef,
    state: &BodyState,
    force: glam::DVec3,
) -> Option<BodyFrame> {
    Some(BodyFrame {
        key: simulation.key(body),
        position: state.position,
        velocity: state.velocity,
        acceleration: state.acceleration,
        force,
        kinetic: simulation.kinetic(body, state)?,
        contact: state.contact,
        turn: state.turn,
    })
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
