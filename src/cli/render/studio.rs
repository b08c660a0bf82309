//! A simulation and the OpenGL that draws it, picture after picture.

use std::path::Path;
use std::sync::Arc;

use super::RenderArgs;
use super::picture::tiles;
use crate::cli::output::{self, is_stdout};
use crate::cli::{CliError, say};
use crate::record::{Exceeded, Frame, InlineRunner, RunCommand, RunState, Runner as _};
use crate::render::{Offscreen, RenderError, png, render_picture, write_png};
use crate::scene::Scene;
use crate::sim::Fault;

pub(super) struct Studio<'a> {
    args: &'a RenderArgs,
    scene: &'a Scene,
    runner: InlineRunner,
    offscreen: Option<Offscreen>,
    /// What a picture shows.
    pub frame: Arc<Frame>,
    /// What was said of pictures so far.
    notes: Vec<String>,
}

impl<'a> Studio<'a> {
    pub fn new(args: &'a RenderArgs, scene: &'a Scene) -> Self {
        let mut runner = InlineRunner::limited(args.limits.limits());
        runner.send(RunCommand::Method(args.method));
        runner.send(RunCommand::Tiles(true));
        runner.send(RunCommand::Load(Arc::new(scene.clone())));
        let frame = runner.frame();
        Self { args, scene, runner, offscreen: None, frame, notes: Vec::new() }
    }

    /// Simulates as long as `go_on`, which hears the model time reached, says so; says which limit was reached, if one was.
    pub fn go_on(
        &mut self,
        steps: Vec<RunCommand>,
        go_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Option<Exceeded>, CliError> {
        for step in steps {
            if !self.runner.send_while(step, go_on) {
                break;
            }
        }
        self.frame = self.runner.frame();
        match (self.frame.state, &self.frame.fault) {
            // The message begins with the time, which a fault tells of itself.
            (RunState::Faulted, Some(text)) => {
                let message = text.split_once(": ").map_or(&**text, |(_, message)| message);
                Err(CliError::Fault(Fault { time: self.frame.time, message: message.to_owned(), key: None }))
            }
            _ => Ok(self.runner.exceeded()),
        }
    }

    /// Draws what the simulation came to into a file or to standard output.
    pub fn draw(&mut self, path: &Path) -> Result<(), CliError> {
        let tiles = tiles(self.args, self.scene, &self.frame);
        for note in tiles.iter().flat_map(|tile| &tile.list.notes) {
            if !self.notes.contains(note) {
                say(note);
                self.notes.push(note.clone());
            }
        }
        let offscreen = match &mut self.offscreen {
            Some(offscreen) => offscreen,
            none => none.insert(Offscreen::new().map_err(|error| unusable(&error))?),
        };
        let [r, g, b, _] = self.args.theme().palette().map_box.0;
        let size = self.args.size;
        let picture =
            render_picture(offscreen, size, [r, g, b, 255], &tiles).map_err(|error| unusable(&error))?;
        let unwritable = |error| CliError::unwritable(path, &error);
        if is_stdout(path) {
            return output::print(&png(picture.as_raw(), size).map_err(unwritable)?);
        }
        write_png(path, picture.as_raw(), size).map_err(unwritable)
    }
}

fn unusable(error: &RenderError) -> CliError {
    CliError::Usage(error.to_string())
}
