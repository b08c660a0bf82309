//! Times the frames of a person who edits: selects one thing after another, drags one, drags all.

use std::fmt;
use std::time::Instant;

use egui::Context;
use glam::DVec3;

use super::app::App;
use crate::editor::{Action, Drag, Gesture, SessionCommand};
use crate::scene::NodeKey;
use crate::view::Pull;

/// Part of the map's side that a drag moves by from frame to frame.
const DRAG_STEP: f64 = 1e-3;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Task {
    Select,
    DragOne,
    DragAll,
}

const TASKS: [Task; 3] = [Task::Select, Task::DragOne, Task::DragAll];

/// Does each task for so many frames.
#[derive(Debug)]
pub(super) struct EditBench {
    frames: u32,
    /// Frames done, of all tasks.
    done: u32,
    last: Option<Instant>,
    drag: Option<Drag>,
    times: EditTimes,
}

/// Times from frame to frame, s; sorted once all are known.
#[derive(Clone, Debug, Default)]
pub struct EditTimes([Vec<f64>; TASKS.len()]);

impl EditBench {
    pub fn new(frames: u32) -> Self {
        Self { frames, done: 0, last: None, drag: None, times: EditTimes::default() }
    }

    pub fn has_begun(&self) -> bool {
        self.done > 0
    }

    /// Whether a hand would hold the button of the mouse now.
    pub fn is_dragging(&self) -> bool {
        self.drag.is_some()
    }

    /// The times of all frames.
    pub fn finish(mut self) -> EditTimes {
        self.times.0.iter_mut().for_each(|times| times.sort_by(f64::total_cmp));
        self.times
    }
}

impl App {
    /// What a person does in the next frame. Returns whether all is done.
    pub(super) fn bench_edits(&mut self, ctx: &Context, bench: &mut EditBench) -> bool {
        let now = Instant::now();
        let task = |frame: u32| TASKS.get((frame / bench.frames.max(1)) as usize).copied();
        if let (Some(last), Some(before)) =
            (bench.last.replace(now), bench.done.checked_sub(1).and_then(task))
        {
            bench.times.0[before as usize].push((now - last).as_secs_f64());
        }
        let Some(task) = task(bench.done) else { return true };
        let nth = bench.done % bench.frames;
        bench.done += 1;
        let keys: Vec<NodeKey> = self
            .session()
            .scene()
            .map(|scene| scene.bodies.iter().map(|body| body.key).collect())
            .unwrap_or_default();
        if keys.is_empty() {
            return true;
        }
        let one = keys[(nth as usize * 7919) % keys.len()];
        match task {
            Task::Select => drop(self.perform(Action::Select(vec![one]))),
            Task::DragOne if nth == 0 => self.take_hold(bench, vec![one]),
            Task::DragAll if nth == 0 => self.take_hold(bench, keys),
            Task::DragOne | Task::DragAll => self.pull(bench, nth),
        }
        if task != Task::Select && nth + 1 == bench.frames {
            bench.drag = None;
            self.perform(Action::EndGesture);
            self.perform(Action::Command(SessionCommand::Undo));
        }
        ctx.request_repaint();
        false
    }

    fn take_hold(&mut self, bench: &mut EditBench, keys: Vec<NodeKey>) {
        self.perform(Action::Select(keys));
        bench.drag = Drag::of_selection(self.session(), Gesture(u64::from(bench.done)));
    }

    fn pull(&mut self, bench: &EditBench, nth: u32) {
        let size = self.session().scene().map_or(1.0, |scene| scene.map.size.x);
        let offset = DVec3::X * (size * DRAG_STEP * f64::from(nth));
        if let Some(drag) = &bench.drag {
            let action = drag.pull(&Pull::Move(offset), DVec3::ZERO);
            self.perform(action);
        }
    }
}

impl fmt::Display for EditTimes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = ["selecting", "dragging one", "dragging all"];
        let lines = names.iter().zip(&self.0).map(|(name, times)| {
            let at = |share: f64| {
                let index = (times.len().saturating_sub(1) as f64 * share) as usize;
                1e3 * times.get(index).copied().unwrap_or_default()
            };
            format!(
                "{name}: median {:.1} ms, 95 % below {:.1} ms, longest {:.1} ms",
                at(0.5),
                at(0.95),
                at(1.0)
            )
        });
        f.write_str(&lines.collect::<Vec<_>>().join("; "))
    }
}
