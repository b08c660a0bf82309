//! From a run to its file, and from the file to the commands that make the run again.

use super::keys;
use super::{Checkpoint, EditsAt, RecordingError, RecordingFile, Steps, WriteRequest, Written};
use crate::record::command::{Goal, RunCommand};
use crate::record::moment::Moment;
use crate::record::run::Run;
use crate::scene::{Scene, write_atomically};

/// States along the way that a file has at most.
const MOST_CHECKPOINTS: usize = 2000;

/// The recording of a run as a file. `scene` are the bytes that it was loaded from.
pub(in crate::record) fn file_of(run: &Run, scene_name: &str, scene: &[u8]) -> RecordingFile {
    let recording = &run.recording;
    let method = run.simulation.method();
    let edits: Vec<EditsAt> =
        recording.edits().iter().map(|edits| EditsAt { at: edits.at, edits: edits.edits.clone() }).collect();
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
    let state = |(at, _, hash): &(Moment, usize, u64)| Checkpoint { at: *at, hash: format!("{hash:016x}") };
    let mut states: Vec<Checkpoint> = whole.iter().step_by(stride).map(state).collect();
    if run.at == recording.end && states.last().is_none_or(|last| last.at != run.at) {
        states.push(Checkpoint { at: run.at, hash: format!("{:016x}", run.simulation.hash()) });
    }
    states
}

impl RecordingFile {
    /// What makes the run again, after its scene is loaded and its method chosen.
    pub fn commands(&self, scene: &Scene) -> Result<Vec<RunCommand>, RecordingError> {
        let depends_on_dt = self.method()?.depends_on_dt();
        let steps = if depends_on_dt { self.steps.as_slice() } else { &[] };
        let usual = self.steps.last().map_or(super::USUAL_DT, |steps| steps.dt);
        let mut way = Way { ticks: ticks(steps), usual, commands: Vec::new() };
        let all = self.edits.iter().flat_map(|edits| edits.edits.iter().cloned());
        let mut edits = keys::with_keys_of(scene, &self.names, all)?.into_iter();
        for group in &self.edits {
            way.go_to(group.at);
            way.commands.push(RunCommand::Edit(edits.by_ref().take(group.edits.len()).collect()));
        }
        way.go_to(self.end);
        Ok(way.commands)
    }
}

/// Ends of the Δt with their lengths, by the same products as the run had.
fn ticks(steps: &[Steps]) -> std::vec::IntoIter<(f64, f64)> {
    let (mut origin, mut ticks) = (0.0, Vec::new());
    for Steps { dt, count } in steps {
        ticks.extend((1..=*count).map(|nth| (origin + nth as f64 * dt, *dt)));
        origin = ticks.last().map_or(origin, |(time, _)| *time);
    }
    ticks.into_iter()
}

/// Commands on the way through a run.
struct Way {
    /// Those not made yet, where the method depends on them.
    ticks: std::vec::IntoIter<(f64, f64)>,
    usual: f64,
    commands: Vec<RunCommand>,
}

impl Way {
    /// Adds what leads to a moment.
    fn go_to(&mut self, moment: Moment) {
        let is_before = |time: f64| time < moment.time || (time == moment.time && moment.is_over);
        while let Some((time, dt)) =
            self.ticks.as_slice().first().copied().filter(|(time, _)| is_before(*time))
        {
            self.ticks.next();
            match self.commands.last_mut() {
                Some(RunCommand::Step { dt: same, count }) if *same == dt && *count < u32::MAX => *count += 1,
                _ => self.commands.push(RunCommand::Step { dt, count: 1 }),
            }
            if time == moment.time {
                return;
            }
        }
        let dt = self.ticks.as_slice().first().map_or(self.usual, |(_, dt)| *dt);
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
