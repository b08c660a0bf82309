//! A scene at another time than its start, and its motion as samples: looked up in what a run has recorded, or simulated here,
//! event by event.

use glam::{DQuat, DVec3};
use rustc_hash::FxHashMap;

use super::error::ExportError;
use crate::record::RecordedMotion;
use crate::scene::{Document, Edit, EditError, NodeKey};
use crate::sim::{BodyRef, BodyState, Event, Progress, Rotation, Simulation, as_start};

/// Which part of a run is exported. Times in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    Start,
    At(f64),
    Motion(Frames),
}

/// Equally spaced times, and the last at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    pub from: f64,
    pub to: f64,
    /// Frames per model second.
    pub fps: f64,
}

/// A last frame nearer than this share of a frame to the one before is rounding, and joins it.
const SLIVER: f64 = 1e-6;

/// Samples of bodies: a gigabyte of text, and half of that in memory.
const MOST_SAMPLES: f64 = 1e7;

/// Events kept between frames, likewise; later ones are left out.
const MOST_CORNERS: usize = 2_000_000;

/// Predictions between two looks at whether to go on.
const PREDICTIONS: u32 = 256;

impl Frames {
    /// Why there is nothing to export, if so.
    pub fn refusal(&self) -> Option<String> {
        let Self { from, to, fps } = *self;
        if !(from.is_finite() && to.is_finite() && fps.is_finite()) {
            return Some("times and frames per second must be finite numbers".into());
        }
        if from < 0.0 || to <= from {
            return Some(format!(
                "the motion must end after it begins, which is not before 0: {from} s to {to} s"
            ));
        }
        if fps <= 0.0 {
            return Some("frames per second must be more than 0".into());
        }
        None
    }

    /// Whether so many bodies can be sampled so often.
    fn check(&self, bodies: usize) -> Result<(), ExportError> {
        if let Some(refusal) = self.refusal() {
            return Err(ExportError::Frames(refusal));
        }
        let count = self.count();
        if count * bodies as f64 > MOST_SAMPLES {
            return Err(ExportError::Frames(format!(
                "{count:.0} frames of {bodies} bodies are more than {MOST_SAMPLES:.0e} samples: take a shorter time or \
                 fewer frames per second"
            )));
        }
        Ok(())
    }

    fn count(&self) -> f64 {
        (self.to - self.from) * self.fps
    }

    fn whole(&self) -> f64 {
        (self.count() + SLIVER).floor()
    }

    /// The times that are equally spaced, by products, so that none drifts.
    pub fn even(&self) -> impl Iterator<Item = f64> {
        let Self { from, to, fps } = *self;
        (0..=self.whole() as u64).map(move |frame| (from + frame as f64 / fps).min(to))
    }

    /// All times.
    fn times(&self) -> Vec<f64> {
        let last = if self.count() - self.whole() > SLIVER { Some(self.to) } else { None };
        self.even().chain(last).collect()
    }
}

/// How the moving bodies move at rising times.
#[derive(Clone, Debug)]
pub struct Animation {
    pub frames: Frames,
    /// s.
    pub times: Vec<f64>,
    tracks: FxHashMap<NodeKey, Track>,
}

#[derive(Clone, Debug, Default)]
struct Track {
    /// One for each time.
    samples: Vec<Sample>,
    /// At events of this body, where its way has a corner.
    corners: Vec<Key>,
}

/// A body at one time: m, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub position: DVec3,
    pub velocity: DVec3,
    /// `None` where nothing rubs, and nobody knows how a ball is turned.
    pub turn: Option<Rotation>,
}

/// What a viewer draws straight lines between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// s.
    pub time: f64,
    /// m.
    pub position: DVec3,
    /// Unit quaternion, world from body; `None` where nothing rubs. Of q and −q, which are the same, the one nearer to the
    /// key before: between the two is the shorter turn.
    pub orientation: Option<DQuat>,
}

impl Animation {
    /// One sample for each time; `None` for a body that never moves.
    pub fn of(&self, key: NodeKey) -> Option<&[Sample]> {
        self.tracks.get(&key).map(|track| track.samples.as_slice())
    }

    /// Times, places and orientations between which straight lines are near the way of a body: the frames, and its events
    /// between them. Times are told apart as 32-bit numbers from the first frame on.
    pub fn keys(&self, key: NodeKey) -> Option<Vec<Key>> {
        let track = self.tracks.get(&key)?;
        let mut corners = track.corners.iter().copied().peekable();
        let since = |time: f64| (time - self.frames.from) as f32;
        let mut keys: Vec<Key> = Vec::with_capacity(self.times.len() + track.corners.len());
        for (time, sample) in self.times.iter().zip(&track.samples) {
            while let Some(corner) = corners.next_if(|corner| since(corner.time) < since(*time)) {
                if keys.last().is_none_or(|last| since(last.time) < since(corner.time)) {
                    keys.push(corner);
                }
            }
            let orientation = sample.turn.map(|turn| turn.orientation);
            keys.push(Key { time: *time, position: sample.position, orientation });
        }
        take_shorter_turns(&mut keys);
        Some(keys)
    }

    /// Whether a body has no event between the frames.
    pub fn is_smooth(&self, key: NodeKey) -> bool {
        self.tracks.get(&key).is_none_or(|track| track.corners.is_empty())
    }
}

fn take_shorter_turns(keys: &mut [Key]) {
    let mut before: Option<DQuat> = None;
    for orientation in keys.iter_mut().filter_map(|key| key.orientation.as_mut()) {
        if before.is_some_and(|before| before.dot(*orientation) < 0.0) {
            *orientation = -*orientation;
        }
        before = Some(*orientation);
    }
}

/// The document with the places and velocities of a simulation of it as its start.
pub fn with_state_of(document: &Document, sim: &Simulation) -> Result<Document, EditError> {
    let states = sim.dynamic_bodies().filter_map(|body| Some((sim.key(body), sim.state(body)?)));
    with_states(document, states)
}

fn with_states(
    document: &Document,
    states: impl Iterator<Item = (NodeKey, BodyState)>,
) -> Result<Document, EditError> {
    let changes = states.flat_map(|(key, state)| {
        let changes = as_start(state.position, state.velocity, state.turn);
        changes.map(move |change| Edit::Body { key, change })
    });
    Ok(document.apply(&Edit::All(changes.collect()))?.document)
}

impl Sample {
    fn of(state: &BodyState) -> Self {
        Self { position: state.position, velocity: state.velocity, turn: state.turn }
    }
}

impl Key {
    fn of(time: f64, state: &BodyState) -> Self {
        let orientation = state.turn.map(|turn| turn.orientation);
        Self { time, position: state.position, orientation }
    }
}

/// The document as a run of it was at the first frame, and how it moved from there.
pub(super) fn looked_up(
    document: &Document,
    motion: &RecordedMotion,
    frames: Frames,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<(Document, Animation), ExportError> {
    frames.check(motion.bodies().len())?;
    let (from, to) = motion.span();
    if frames.from < from || frames.to > to {
        return Err(ExportError::Frames(format!("the run is recorded from {from} s to {to} s only")));
    }
    let bodies: Vec<(BodyRef, NodeKey)> = motion.bodies().collect();
    let start =
        bodies.iter().enumerate().filter_map(|(nth, (_, key))| Some((*key, motion.state(nth, frames.from)?)));
    let start = with_states(document, start)?;
    let times = frames.times();
    let mut tracks = FxHashMap::default();
    for (nth, (_, key)) in bodies.iter().enumerate() {
        if !go_on(nth as f64 / bodies.len() as f64) {
            return Err(ExportError::Cancelled { time: frames.from });
        }
        let samples: Vec<Sample> =
            times.iter().filter_map(|time| Some(Sample::of(&motion.state(nth, *time)?))).collect();
        if samples.len() == times.len() {
            tracks.insert(*key, Track { samples, corners: Vec::new() });
        }
    }
    add_corners(motion, frames, &bodies, &mut tracks);
    Ok((start, Animation { frames, times, tracks }))
}

/// Where the ways have corners: at the events between the first frame and the last.
fn add_corners(
    motion: &RecordedMotion,
    frames: Frames,
    bodies: &[(BodyRef, NodeKey)],
    tracks: &mut FxHashMap<NodeKey, Track>,
) {
    let index: FxHashMap<BodyRef, usize> =
        bodies.iter().enumerate().map(|(nth, (body, _))| (*body, nth)).collect();
    let ledger = motion.ledger();
    let rows = ledger.iter_from(ledger.count_until(frames.from));
    let mut room = MOST_CORNERS;
    for row in rows.take_while(|row| row.event.time <= frames.to) {
        let event = &row.event;
        for nth in [Some(event.a), event.b].into_iter().flatten().filter_map(|body| index.get(&body)) {
            let track = bodies.get(*nth).and_then(|(_, key)| tracks.get_mut(key));
            if let (Some(track), Some(state), 1..) = (track, motion.state_after(*nth, event.seq), room) {
                room -= 1;
                track.corners.push(Key::of(event.time, &state));
            }
        }
    }
}

/// The document as it is at the time asked for, and its motion from there. `go_on` hears how much is done, from 0 to 1,
/// and how many events there were, and ends it by `false`.
pub(super) fn simulated(
    document: &Document,
    when: When,
    go_on: &mut dyn FnMut(f64, u64) -> bool,
) -> Result<(Document, Option<Animation>), ExportError> {
    let (from, frames) = match when {
        When::Start => return Ok((document.clone(), None)),
        When::At(time) => (time, None),
        When::Motion(frames) => (frames.from, Some(frames)),
    };
    if let Some(refusal) = frames.and_then(|frames| frames.refusal()) {
        return Err(ExportError::Frames(refusal));
    }
    let scene = document.scene().ok_or(ExportError::NoScene)?;
    let mut sim = Simulation::new(scene).map_err(|error| ExportError::Compile(error.to_string()))?;
    let end = frames.map_or(from, |frames| frames.to);
    let mut part = |sim: &Simulation, events| go_on(if end > 0.0 { sim.time() / end } else { 1.0 }, events);
    let mut events = 0;
    advance(&mut sim, from, &mut events, &mut part, &mut |_, _| {})?;
    let start = with_state_of(document, &sim)?;
    let motion = frames.map(|frames| record(&mut sim, frames, &mut events, &mut part)).transpose()?;
    Ok((start, motion))
}

fn record(
    sim: &mut Simulation,
    frames: Frames,
    events: &mut u64,
    go_on: &mut dyn FnMut(&Simulation, u64) -> bool,
) -> Result<Animation, ExportError> {
    let bodies: Vec<BodyRef> = sim.dynamic_bodies().collect();
    frames.check(bodies.len())?;
    let times = frames.times();
    let index: FxHashMap<BodyRef, usize> = bodies.iter().enumerate().map(|(at, body)| (*body, at)).collect();
    let mut tracks = vec![Track::default(); bodies.len()];
    let mut room = MOST_CORNERS;
    for time in &times {
        advance(sim, *time, events, go_on, &mut |sim, event| {
            for body in [Some(event.a), event.b].into_iter().flatten() {
                let place = index.get(&body).zip(sim.state(body));
                if let (Some((at, state)), 1..) = (place, room) {
                    room -= 1;
                    tracks[*at].corners.push(Key::of(event.time, &state));
                }
            }
        })?;
        for (track, body) in tracks.iter_mut().zip(&bodies) {
            if let Some(state) = sim.state(*body) {
                track.samples.push(Sample::of(&state));
            }
        }
    }
    let keys = bodies.iter().map(|body| sim.key(*body));
    let tracks = keys.zip(tracks).filter(|(_, track)| track.samples.len() == times.len()).collect();
    Ok(Animation { frames, times, tracks })
}

fn advance(
    sim: &mut Simulation,
    until: f64,
    events: &mut u64,
    go_on: &mut dyn FnMut(&Simulation, u64) -> bool,
    on_event: &mut dyn FnMut(&Simulation, &Event),
) -> Result<(), ExportError> {
    sim.begin(until);
    loop {
        match sim.work(PREDICTIONS) {
            Ok(Progress::Done) => return Ok(()),
            Ok(Progress::Event(event)) => {
                *events += 1;
                on_event(sim, &event);
            }
            Ok(Progress::Working) => {}
            Err(fault) => return Err(ExportError::Fault(fault.to_string())),
        }
        if !go_on(sim, *events) {
            return Err(ExportError::Cancelled { time: sim.time() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_at_products_and_the_last_at_the_end() {
        let times = |from, to, fps| Frames { from, to, fps }.times();
        assert_eq!(times(0.0, 1.0, 4.0), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(times(1.0, 1.6, 4.0), [1.0, 1.25, 1.5, 1.6]);
        assert_eq!(times(0.0, 0.1, 4.0), [0.0, 0.1]);
        let minute = times(0.0, 60.0, 60.0);
        assert_eq!((minute.len(), minute.last()), (3601, Some(&60.0)));
        assert_eq!(times(0.0, 0.3, 10.0).len(), 4, "three tenths are no whole number of tenths in binary");
    }
}
