//! When pictures are taken, and how the simulation comes from one to the next.

use super::RenderArgs;
use crate::cli::CliError;
use crate::cli::samples::SampleGrid;
use crate::export::Frames;
use crate::record::RunCommand;

/// As films have, more or less.
const USUAL_FPS: f64 = 30.0;

/// s.
const USUAL_DT: f64 = 1.0 / 60.0;

/// Pictures that somebody waits for, an hour of film: more is a slip of the finger.
const MOST_PICTURES: f64 = 1e5;

/// Steps of a length that divides the time between two pictures but for this share of a step fill it.
const SLIVER: f64 = 1e-6;

/// Rising, s: one time, or those of a sequence.
pub(super) fn of(args: &RenderArgs) -> Result<Vec<f64>, CliError> {
    let Some(to) = args.until else { return Ok(vec![args.at]) };
    let frames = Frames { from: args.from.unwrap_or(0.0), to, fps: args.fps.unwrap_or(USUAL_FPS) };
    if let Some(refusal) = frames.refusal() {
        return Err(CliError::Usage(refusal));
    }
    let count = (to - frames.from) * frames.fps;
    if count > MOST_PICTURES {
        let text = format!(
            "{count:.2e} pictures are more than {MOST_PICTURES:.0e}: take a shorter time or a smaller --fps"
        );
        return Err(CliError::Usage(text));
    }
    Ok(frames.even().collect())
}

/// The commands that go to the first picture, the last of them the Δt whose contacts are shown.
pub(super) fn first(args: &RenderArgs, at: f64) -> Result<Vec<RunCommand>, CliError> {
    let dt = args.dt.unwrap_or(USUAL_DT);
    let last = dt.min(at);
    let mut parts = vec![(at - last, 1), (last, 1)];
    if args.method.depends_on_dt() && at > dt {
        let grid = SampleGrid::new(Some(dt), at).map_err(CliError::Usage)?;
        let whole = u32::try_from(grid.steps - 1).unwrap_or(u32::MAX);
        parts = vec![(dt, whole), (at - grid.time(grid.steps - 1), 1)];
    }
    Ok(steps(&parts))
}

/// The commands that go from one picture to the next. A method that steps by Δt keeps its steps and is looked at inside them
/// where they do not fit.
pub(super) fn next(args: &RenderArgs, from: f64, to: f64) -> Vec<RunCommand> {
    let between = to - from;
    if !args.method.depends_on_dt() {
        let last = args.dt.unwrap_or(between).min(between);
        return steps(&[(between - last, 1), (last, 1)]);
    }
    let dt = args.dt.unwrap_or(USUAL_DT);
    let count = between / dt;
    if (count - count.round()).abs() < SLIVER && count < f64::from(u32::MAX) {
        return steps(&[(dt, count.round() as u32)]);
    }
    vec![RunCommand::Seek { dt, time: to }]
}

fn steps(parts: &[(f64, u32)]) -> Vec<RunCommand> {
    let steps = parts.iter().filter(|(dt, count)| *dt > 0.0 && *count > 0);
    steps.map(|&(dt, count)| RunCommand::Step { dt, count }).collect()
}
