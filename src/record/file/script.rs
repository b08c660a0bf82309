//! From a run to its file, and from the file to the commands that make the run again.

use std::iter::Peekable;

use super::error::RecordingError;
use super::keys;
use super::{Checkpoint, EditsAt, RecordingFile, Steps, WriteRequest, Written};
use crate::record::command::{Goal, RunCommand};
use crate::record::moment::Moment;
use crate::record::run::Run;
use crate::scene::{Scene, write_atomically};
use crate::sim::SimEdit;

/// States along the way that a file has at most.
const MOST_CHECKPOINTS: usize = 2000;

/// The recording of a run as a file. `scene` are the bytes that it was loaded from.
pub(in crate::record) fn file_of(run: &Run, scene_name: &str, scene: &[u8]) -> RecordingFile {
    let recording = &run.recording;
    let method = run.simulation.method();
    let made = recording.edits().iter();
    let edits: Vec<EditsAt> =
        made.map(|edits| EditsAt { at: edits.at, edits: edits.edits.clone(), at_once: true }).collect();
    RecordingFile {
        names: keys::names(&run.scene, edits.iter().flat_map(|edits| &edits.edits)),
        edits,
        steps: recording.ticks.steps(),
        end: recording.end,
        checkpoints: checkpoints(run),
        ..RecordingFile::new(scene_name, scene, method)
    }
}

/// Writes the recording of a run.
pub(in crate::record) fn write(run: &Run, request: &WriteRequest) -> Written {
    let file = RecordingFile {
        bookmarks: request.bookmarks.clone(),
        ..file_of(run, &request.scene_name, &request.scene)
    };
    let bytes = file.to_bytes().map_err(|error| error.to_string());
    let written =
        bytes.and_then(|bytes| write_atomically(&request.path, &bytes).map_err(|error| error.to_string()));
    Written { path: request.path.clone(), problem: written.err() }
}

/// The keyframes, of very many some, and the end; only those with all edits of their moment.
fn checkpoints(run: &Run) -> Vec<Checkpoint> {
    let recording = &run.recording;
    let made = |at: Moment| recording.edits().partition_point(|edits| edits.at.is_not_after(at));
    let whole: Vec<_> = recording.keyframes.states().filter(|(at, edits, _)| made(*at) == *edits).collect();
    let stride = whole.len().div_ceil(MOST_CHECKPOINTS).max(1);
    let state = |(at, _, hash): &(Moment, usize, u64)| checkpoint(*at, *hash);
    let mut states: Vec<Checkpoint> = whole.iter().step_by(stride).map(state).collect();
    // The end too, from wherever the recording is saved.
    let head = recording.keyframes.head().map(|head| (head.at, head.hash));
    let end = head.or_else(|| (run.at == recording.end).then(|| (run.at, run.simulation.hash())));
    let is_new = |at: Moment| at == recording.end && states.last().is_none_or(|last| last.at != at);
    if let Some((at, hash)) = end.filter(|(at, _)| is_new(*at)) {
        states.push(checkpoint(at, hash));
    }
    states
}

fn checkpoint(at: Moment, hash: u64) -> Checkpoint {
    Checkpoint { at, hash: format!("{hash:016x}"), line: None }
}

impl RecordingFile {
    /// What makes the run again, after its scene is loaded and its method chosen.
    pub fn commands(&self, scene: &Scene) -> Result<Vec<RunCommand>, RecordingError> {
        let depends_on_dt = self.method()?.depends_on_dt();
        let steps = if depends_on_dt { self.steps.as_slice() } else { &[] };
        let usual = self.steps.last().map_or(super::USUAL_DT, |steps| steps.dt);
        let ticks: Ticks<'_> = Box::new(ticks(steps));
        let mut way = Way { ticks: ticks.peekable(), usual, commands: Vec::new() };
        let all = self.edits.iter().flat_map(|edits| edits.edits.iter().cloned());
        let mut edits = keys::with_keys_of(scene, &self.names, all)?.into_iter();
        for group in &self.edits {
            way.go_to(group.at);
            let group_edits: Vec<SimEdit> = edits.by_ref().take(group.edits.len()).collect();
            let together = if group.at_once { group_edits.len().max(1) } else { 1 };
            let commands = group_edits.chunks(together).map(|edits| RunCommand::Edit(edits.to_vec()));
            way.commands.extend(commands);
        }
        way.go_to(self.end);
        Ok(way.commands)
    }
}

/// Ends of the Δt with their lengths, by the same products as the run had.
fn ticks(steps: &[Steps]) -> impl Iterator<Item = (f64, f64)> {
    let mut origin = 0.0;
    steps.iter().flat_map(move |&Steps { dt, count }| {
        let from = origin;
        origin += count as f64 * dt;
        (1..=count).map(move |nth| (from + nth as f64 * dt, dt))
    })
}

type Ticks<'a> = Box<dyn Iterator<Item = (f64, f64)> + 'a>;

/// Commands on the way through a run.
struct Way<'a> {
    /// Those not made yet, where the method depends on them: made one by one, for a small file may claim many.
    ticks: Peekable<Ticks<'a>>,
    usual: f64,
    commands: Vec<RunCommand>,
}

impl Way<'_> {
    /// Adds what leads to a moment.
    fn go_to(&mut self, moment: Moment) {
        let is_before = |time: f64| time < moment.time || (time == moment.time && moment.is_over);
        while let Some((time, dt)) = self.ticks.next_if(|(time, _)| is_before(*time)) {
            match self.commands.last_mut() {
                Some(RunCommand::Step { dt: same, count }) if *same == dt && *count < u32::MAX => *count += 1,
                _ => self.commands.push(RunCommand::Step { dt, count: 1 }),
            }
            if time == moment.time {
                return;
            }
        }
        let dt = self.ticks.peek().map_or(self.usual, |(_, dt)| *dt);
        match moment {
            Moment { event, time, is_over: false } if event > 0 => {
                let goal = Goal::Event { number: event, time };
                self.commands.push(RunCommand::RunUntil { dt, goal });
            }
            Moment { time, .. } if time > 0.0 => self.commands.push(RunCommand::Seek { dt, time }),
            _ => {}
        }
    }
}
