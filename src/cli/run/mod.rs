//! `polyscene run`: simulates a scene and writes states, events and a summary.

mod drive;
mod final_scene;
mod recorder;
mod summary;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use self::drive::{Ending, Stops};
use self::final_scene::FinalScene;
use self::recorder::Recorder;
use self::summary::Summary;
use super::limits::LimitArgs;
use super::output::{self, is_stdout};
use super::samples::SampleGrid;
use super::table::{RowArgs, Wanted};
use super::{CliError, input, interrupt, method, number};
use crate::record::Watch;
use crate::scene::{Document, FileStamp, Map, shown_path};
use crate::sim::{EventKind, Method, Simulation};

/// Simulate a scene from t = 0 and write states, events and a summary
///
/// All quantities are in SI units: metres, seconds, kilograms, joules. Δt only says when to look: events
/// and states are the same bits for every Δt, unless --method asks for one that steps by Δt. The TimeSpeed of
/// the file is for watching and scales nothing here. Without an output on standard output a summary for people
/// is printed. A run that --max-events, --max-wall or Ctrl-C stops writes the state it reached.
#[derive(Debug, Args)]
#[command(after_help = examples(), after_long_help = long_help())]
pub struct RunArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// Δt between samples in seconds; fractions such as 1/60 are fine. The method exact needs none: without
    /// it, only the start and the end are sampled
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    dt: Option<f64>,

    /// Model time at which to end, in seconds; at most 1e9
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    until: f64,

    /// Write the state after every N-th Δt (besides the first and the last)
    #[arg(long, value_name = "N", default_value_t = 1, requires = "dt", requires = "states", value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,

    /// How to step
    #[arg(long, default_value = Method::Exact.name(), value_parser = method::parser())]
    method: Method,

    /// Write states to this file, as JSON Lines or CSV; `-` is standard output
    #[arg(long, value_name = "FILE")]
    states: Option<PathBuf>,

    /// Write events to this file, as JSON Lines or CSV; `-` is standard output
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,

    /// Write the scene with the positions and velocities of the last state
    ///
    /// What --max-events, --max-wall or Ctrl-C stop is written too, but not the state of a fault. `-` is standard output.
    #[arg(long = "final", value_name = "FILE.xml")]
    final_scene: Option<PathBuf>,

    /// Let outputs replace files, and --final the scene itself
    #[arg(long)]
    force: bool,

    /// Print one JSON object that sums the run up to standard output
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    rows: RowArgs,

    #[command(flatten)]
    limits: LimitArgs,
}

pub(super) fn run(args: &RunArgs) -> Result<(), CliError> {
    if args.dt.is_none() && args.method.depends_on_dt() {
        let method = args.method.name();
        return Err(CliError::Usage(format!("--method {method} steps by Δt: give --dt, such as --dt 1/60")));
    }
    let grid = SampleGrid::new(args.dt, args.until).map_err(CliError::Usage)?;
    refuse_clashing_outputs(args)?;
    args.rows.check(args.states.as_deref(), args.events.as_deref(), "--states FILE or --events FILE")?;
    let final_scene = args.final_scene.as_deref().map(FinalScene::new);

    let watchdog = args.limits.watchdog();
    let name = input::display_name(&args.scene);
    let Started { mut sim, mut warnings, wanted, map, smallest_radius, document } = start(args, &name)?;
    let interrupt = interrupt::on_interrupt();
    final_scene.as_ref().map_or(Ok(()), FinalScene::check)?;
    let mut recorder = Recorder::create(args, &grid, wanted)?;
    let started = Instant::now();
    let stops = Stops { interrupt, watch: Watch::start(args.limits.limits()) };
    let ending = drive::drive(&mut sim, &grid, &mut recorder, &stops)?;
    let wall_s = started.elapsed().as_secs_f64();
    drop(watchdog);
    recorder.close()?;

    let overlaps = recorder.overlaps();
    let told =
        [summary::overflow_warning(&sim), summary::overlap_warning(overlaps, smallest_radius, args.method)];
    for warning in told.into_iter().flatten() {
        let line = format!("{name}: warning: {warning}");
        super::say(&line);
        warnings.push(line);
    }
    let summary = Summary::new(&sim, &grid, &ending, (overlaps.worst, &map), wall_s, &warnings);
    if args.json {
        summary.print_json()?;
    } else if !args.writes_to_stdout() {
        summary.print_for_people(&name)?;
    }
    if let (false, Some((target, document))) =
        (matches!(ending, Ending::Faulted(_)), final_scene.zip(document))
    {
        target.write(&document, &sim)?;
    }
    match ending {
        Ending::Finished => Ok(()),
        Ending::Exceeded(why) => Err(CliError::Stopped { time: sim.time(), why }),
        Ending::NobodyListens => Ok(()),
        Ending::Interrupted => Err(CliError::interrupted(&sim)),
        Ending::Faulted(fault) => Err(CliError::Fault(fault)),
    }
}

/// A simulation at its start, and what else a run needs of the scene.
struct Started {
    sim: Simulation,
    /// Said already.
    warnings: Vec<String>,
    wanted: Wanted,
    map: Map,
    /// m.
    smallest_radius: Option<f64>,
    /// Where the last state is written into it.
    document: Option<Document>,
}

/// Reads the scene and goes to its start; says what is wrong with it.
fn start(args: &RunArgs, name: &str) -> Result<Started, CliError> {
    let before = FileStamp::of(&args.scene);
    let document = input::read(&args.scene)?;
    let said = document.scene().map(|scene| (args.rows.wanted(scene), scene.map, scene.smallest_radius()));
    let (begun, kept) = if args.final_scene.is_some() {
        let input::Examined { document, simulation, problems } = input::examine(document, args.method);
        (input::Begun { simulation, problems }, Some(document))
    } else {
        (input::begin(document, &args.scene, &before, args.method), None)
    };
    let warnings = input::lines(name, &begun.problems);
    warnings.iter().for_each(super::say);
    let Some((sim, (wanted, map, smallest_radius))) = begun.simulation.zip(said) else {
        let errors = input::error_count(&begun.problems);
        return Err(CliError::Scene(format!("{name} cannot be simulated: {errors} error(s)")));
    };
    Ok(Started { sim, warnings, wanted: wanted?, map, smallest_radius, document: kept })
}

impl RunArgs {
    /// The output files with their options' names.
    fn outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        [("--states", &self.states), ("--events", &self.events), ("--final", &self.final_scene)]
            .into_iter()
            .filter_map(|(option, path)| Some((option, path.as_deref()?)))
    }

    fn writes_to_stdout(&self) -> bool {
        self.json || self.outputs().any(|(_, path)| is_stdout(path))
    }
}

/// Two outputs in one place, or an output over the scene itself, would spoil both.
fn refuse_clashing_outputs(args: &RunArgs) -> Result<(), CliError> {
    let json = args.json.then_some(("--json", Path::new("-")));
    let all: Vec<_> = json.into_iter().chain(args.outputs()).collect();
    output::refuse_shared(&all)?;
    for (option, path) in args.outputs() {
        // With --force the file is replaced in one go after it was read; rows would destroy it at once.
        let forced = option == "--final" && args.force;
        if !forced && output::overwrites(path, &args.scene) {
            let way_out = if option == "--final" { "; --force lets it" } else { "" };
            let text = format!("{option} would overwrite the scene {}{way_out}", shown_path(path));
            return Err(CliError::Usage(text));
        }
        output::refuse_taken(option, path, args.force)?;
    }
    Ok(())
}

fn examples() -> &'static str {
    "Examples:\n  \
     polyscene run scene.xml --dt 1/60 --until 60\n  \
     polyscene run scene.xml --until 10 --events - | head\n  \
     polyscene run scene.xml --until 10 --max-events 100000 --max-wall 60 --json\n  \
     polyscene run scene.xml --dt 0.01 --until 10 --every 100 --states states.jsonl --json\n  \
     polyscene run scene.xml --dt 1/60 --until 60 --method thesis --json\n  \
     polyscene run scene.xml --until 60 --events impacts.csv --kinds impact --bodies 7,Floor --columns t,a,b,impulse\n  \
     polyscene run scene.xml --dt 1 --until 5 --final after-5-s.xml"
}

fn long_help() -> String {
    let kinds: String =
        EventKind::ALL.iter().map(|kind| format!("  {:<14} {}\n", kind.name(), kind.meaning())).collect();
    format!("{ROWS}\n\nKinds of events:\n{kinds}\n{}", examples())
}

const ROWS: &str = "\
States, one row at t = 0, after every N-th Δt and at the end:
  {\"t\":0.5,\"bodies\":[{\"id\":\"7\",\"x\":[..],\"v\":[..],\"state\":\"flight\"}]}
  t in s, x in m, v in m/s; state is flight, rest, slide, roll or stepped
  where bodies rub: \"q\":[x,y,z,w], the unit quaternion that turns the body's axes to where they are, and
  \"w\":[..], the angular velocity in rad/s, about the axes of the map

Events, one row per contact:
  {\"seq\":1,\"t\":0.1,\"kind\":\"impact\",\"a\":\"7\",\"b\":\"9\",\"point\":[..],\"normal\":[..],
   \"impulse\":1.0,\"vn_before\":-2.0,\"vn_after\":2.0,\"group\":1,\"gap\":0.0,\"rounds\":0,\"dt_index\":12}
  a has the smaller UserID; b is null for an event of one body; where they have names, \"a_name\" and \"b_name\" follow
  point is on the surfaces, in m; normal is the unit vector from a to b
  impulse is in N·s; vn is the speed of b against a along normal, in m/s
  group numbers the impacts and collapses: the contacts of bodies that touch are resolved
  together and share it, one row each; it is 0 for other kinds
  gap is the distance of the surfaces where the search for the time of an impact ended, in m
  rounds says in how many rounds the contacts of its group were resolved, 0 for two bodies alone
  dt_index is the Δt, from 1
  with --costs, searches and dropped say what the core did since the event before
  dense and group_rest are about the bodies of one group, of which a has the smallest UserID;
  they say how many these are, \"bodies\":30, and share the group's number

As CSV (--rows csv, or a file that ends in .csv) vectors are columns: x, y, z, vx, vy, vz, qx … qw, wx, wy, wz of states,
one row for each body; point_x … normal_z of events.

Ids are UserIDs; the k-th body of a repeated UserID is called UserID#k.";
