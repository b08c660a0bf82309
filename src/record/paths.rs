//! The ways of bodies around the moment shown, from their recorded motion: curves as they are, not lines between pictures.

use std::sync::Arc;

use glam::DVec3;

use super::ledger::EventRow;
use super::moment::Moment;
use super::run::Run;
use super::ways::{BodyPath, ImpactBody, PathSpan};
use crate::sim::{BodyRef, EventKind, Piece};

/// Bodies whose ways are given; of more the first.
const MOST_BODIES: usize = 300;
/// Places on all ways together; of more the nearest to the moment shown.
const MOST_PLACES: usize = 60_000;

/// The angle that a way turns by between two places, radians: below what is seen as a corner.
const TURN: f64 = 0.06;
const MOST_PER_PIECE: f64 = 64.0;

/// The ways of the bodies that are there at the moment shown.
pub(super) fn paths(run: &Run, span: PathSpan) -> Vec<BodyPath> {
    let now = run.cursor;
    let bodies: Vec<BodyRef> = run.simulation.dynamic_bodies().take(MOST_BODIES).collect();
    let most = MOST_PLACES / bodies.len().max(1);
    let path = |body: &BodyRef| {
        let mut past = places(run, *body, now.time - span.past.max(0.0), now.time);
        let mut future = places(run, *body, now.time, now.time + span.future.max(0.0));
        past.drain(..past.len().saturating_sub(most));
        future.truncate(most);
        BodyPath { key: run.simulation.key(*body), past, future }
    };
    bodies.iter().map(path).collect()
}

/// Places on a body's recorded way between two times.
fn places(run: &Run, body: BodyRef, from: f64, to: f64) -> Vec<DVec3> {
    let (from, to) = (from.max(run.recording.from().time), to.min(run.recording.end.time));
    let mut pieces = run.recording.pieces(body, from, to).peekable();
    let mut places = Vec::new();
    while let Some(piece) = pieces.next() {
        let end = pieces.peek().map_or(to, |next| next.start().min(to));
        let start = piece.start().max(from);
        if end >= start {
            add_places(piece, start, end, &mut places);
        }
    }
    places
}

/// Places that are closer where the way turns more.
fn add_places(piece: &Piece, start: f64, end: f64, places: &mut Vec<DVec3>) {
    let direction = |time: f64| piece.at(time).velocity.normalize_or_zero();
    let [first, middle, last] = [start, 0.5 * (start + end), end].map(direction);
    let turn = first.angle_between(middle) + middle.angle_between(last);
    let parts = if turn.is_finite() { (turn / TURN).clamp(1.0, MOST_PER_PIECE).ceil() } else { 1.0 };
    for nth in 0..=parts as u32 {
        let place = piece.position(start + (end - start) * f64::from(nth) / parts);
        if places.last() != Some(&place) {
            places.push(place);
        }
    }
}

/// Bodies of one impact that are shown.
const MOST_AT_IMPACT: usize = 64;

/// What the bodies of an event come with and leave with, while the moment right after it is shown.
pub(super) fn at_impact(run: &Run) -> Vec<ImpactBody> {
    let now = run.cursor;
    let ledger = &run.recording.ledger;
    // That bodies are stepped, or lie still from now on, throws none.
    let throws = |row: &&Arc<EventRow>| !matches!(row.event.kind, EventKind::Dense | EventKind::GroupRest);
    let Some(row) = run.event_shown().filter(throws) else { return Vec::new() };
    // The rows of an impact group are one impact.
    let (first, last) = row.rows();
    let mut bodies: Vec<BodyRef> = (first..=last)
        .filter_map(|number| ledger.get(number))
        .flat_map(|row| [Some(row.event.a), row.event.b].into_iter().flatten())
        .filter(|body| matches!(body, BodyRef::Dynamic(_)))
        .collect();
    bodies.sort_unstable();
    bodies.dedup();
    let before = Moment::after_all(first - 1, now.time);
    bodies.iter().take(MOST_AT_IMPACT).filter_map(|body| impact_body(run, *body, before)).collect()
}

fn impact_body(run: &Run, body: BodyRef, before: Moment) -> Option<ImpactBody> {
    let (now, recording) = (run.cursor, &run.recording);
    let (start, end) = run.grid.span()?;
    let piece = |moment: Moment| recording.at(moment).piece(body);
    let position = |time: f64| Some(piece(recording.moment_at(time))?.position(time));
    Some(ImpactBody {
        key: run.simulation.key(body),
        position: piece(now)?.position(now.time),
        before: piece(before)?.at(now.time).velocity,
        after: piece(now)?.at(now.time).velocity,
        at_start: position(start)?,
        at_end: if recording.knows(end) { position(end) } else { None },
    })
}
