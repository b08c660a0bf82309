//! `polyscene render`: a picture of a scene without a window, a display or a GPU.

use std::io::IsTerminal as _;
use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};

use super::limits::LimitArgs;
use super::output::{self, is_stdout};
use super::samples::SampleGrid;
use super::{CliError, input, method, number};
use crate::record::{Exceeded, Frame, InlineRunner, RunCommand, RunState, Runner as _};
use crate::render::{Offscreen, RenderError, Tile, png, render_picture, write_png};
use crate::scene::{Scene, check_writable, shown_path};
use crate::sim::{Fault, Method};
use crate::view::{
    Align, Camera, DrawList, Label, OVERLAYS, OverlaySet, Theme, VIEWS, ViewInput, ViewPreset, Viewport,
    build_draw_list, scene_bounds,
};

/// Draw a scene into a PNG file
///
/// Needs neither a display nor a GPU: OpenGL runs in software through EGL. Shows the start, or the state
/// at `--at` with the contacts of the last Δt. A simulation that stops before `--at` on a numerical fault
/// gives no picture, tells why, and ends with exit code 3; one that --max-events or --max-wall stops gives that
/// of the time reached.
#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct RenderArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// Picture to write; `-` is standard output
    #[arg(short, long, value_name = "OUT.png")]
    out: PathBuf,

    /// Model time to show, in seconds from 0 to 1e9
    #[arg(long, value_name = "S", value_parser = moment, allow_negative_numbers = true, default_value = "0")]
    at: f64,

    /// Δt before `--at` whose contacts are shown, in seconds; fractions such as 1/60 are fine
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "1/60")]
    dt: f64,

    /// How to step; the methods other than exact do it in steps of --dt
    #[arg(long, default_value = Method::Exact.name(), value_parser = method::parser())]
    method: Method,

    /// Size of the picture in pixels, at most 33 million of them
    #[arg(long, value_name = "WxH", value_parser = picture_size, default_value = "1600x1000")]
    size: [u32; 2],

    /// The four views side by side, or one of them
    #[arg(long, value_enum, default_value_t = View::Quad)]
    view: View,

    /// Overlays to show, separated by commas; `none` shows none [default: what suits the view]
    #[arg(long, value_name = "LIST", value_parser = overlays)]
    overlays: Option<OverlaySet>,

    /// Colours
    #[arg(long, value_enum, default_value_t = Colors::Dark)]
    colors: Colors,

    /// Size of text and lines
    #[arg(long, value_name = "FACTOR", value_parser = zoom, default_value = "1")]
    zoom: f64,

    #[command(flatten)]
    limits: LimitArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum View {
    Quad,
    Perspective,
    Top,
    Front,
    Right,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Colors {
    Dark,
    Light,
}

/// Pixels between the views of a quad picture.
const GAP: u32 = 2;

pub(super) fn render(args: &RenderArgs) -> Result<(), CliError> {
    let unwritable = |error| CliError::unwritable(&args.out, &error);
    if output::overwrites(&args.out, &args.scene) {
        return Err(CliError::Usage(format!("--out would overwrite the scene {}", shown_path(&args.out))));
    }
    if is_stdout(&args.out) && std::io::stdout().is_terminal() {
        return Err(CliError::Usage(
            "--out -: a terminal cannot show a picture; give a file or a pipe".into(),
        ));
    }
    let steps = steps(args)?;
    let watchdog = args.limits.watchdog();
    let name = input::display_name(&args.scene);
    let examined = input::open(&args.scene, args.method)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    let (Some(scene), Some(_)) = (examined.document.scene(), examined.simulation) else {
        return Err(CliError::Scene(format!("{name} cannot be drawn: it has errors")));
    };
    if !is_stdout(&args.out) {
        check_writable(&args.out).map_err(unwritable)?;
    }
    let (frame, exceeded) = frame_after(&steps, scene, args).map_err(CliError::Fault)?;
    drop(watchdog);

    let mut offscreen = Offscreen::new().map_err(|error| unusable(&error))?;
    let tiles = tiles(args, scene, &frame);
    for note in tiles.iter().flat_map(|tile| &tile.list.notes) {
        super::say(note);
    }
    let [r, g, b, _] = args.theme().palette().map_box.0;
    let picture = render_picture(&mut offscreen, args.size, [r, g, b, 255], &tiles)
        .map_err(|error| unusable(&error))?;
    if is_stdout(&args.out) {
        output::print(&png(picture.as_raw(), args.size).map_err(unwritable)?)?;
    } else {
        write_png(&args.out, picture.as_raw(), args.size).map_err(unwritable)?;
    }
    exceeded.map_or(Ok(()), |why| Err(CliError::Stopped { time: frame.time, why }))
}

fn unusable(error: &RenderError) -> CliError {
    CliError::Usage(error.to_string())
}

impl RenderArgs {
    fn theme(&self) -> Theme {
        match self.colors {
            Colors::Dark => Theme::Dark,
            Colors::Light => Theme::Light,
        }
    }
}

/// The views of the picture, each at its place.
fn tiles(args: &RenderArgs, scene: &Scene, frame: &Frame) -> Vec<Tile> {
    let [width, height] = args.size;
    if args.view == View::Quad {
        let half = |side: u32| ((side.saturating_sub(GAP)) / 2).max(1);
        let size = [half(width), half(height)];
        return VIEWS
            .iter()
            .zip([[0, 0], [1, 0], [0, 1], [1, 1]])
            .map(|(preset, [column, row])| Tile {
                list: list(args, preset, scene, frame, size),
                x: column * (width - size[0]),
                y: row * (height - size[1]),
            })
            .collect();
    }
    let one = VIEWS.iter().find(|preset| View::from_str(preset.id, false) == Ok(args.view));
    one.map(|preset| Tile { list: list(args, preset, scene, frame, args.size), x: 0, y: 0 })
        .into_iter()
        .collect()
}

fn list(args: &RenderArgs, preset: &ViewPreset, scene: &Scene, frame: &Frame, size: [u32; 2]) -> DrawList {
    let [width, height] = size.map(|side| f64::from(side) / args.zoom);
    let viewport = Viewport::new(width, height, args.zoom);
    let theme = args.theme();
    let mut input = ViewInput::new(scene, Camera::default(), viewport);
    // Around the start, so that pictures of different times can be laid over each other.
    input.camera = preset.camera(scene_bounds(&input, None), viewport.aspect());
    input.frame = Some(frame);
    input.overlays = args.overlays.unwrap_or_else(|| preset.overlay_set());
    input.theme = theme;
    let mut list = build_draw_list(&input);
    list.labels.push(Label {
        position: glam::Vec2::new(10.0, 7.0),
        text: format!("{} · t = {} s", preset.label, crate::view::number(frame.time, 6)),
        color: theme.palette().text,
        size: 13.0,
        align: Align::LeftTop,
        back: theme.palette().label_back,
    });
    list
}

/// The commands that go to `--at`, the last of them the Δt whose contacts are shown.
fn steps(args: &RenderArgs) -> Result<Vec<RunCommand>, CliError> {
    let RenderArgs { at, dt, method, .. } = *args;
    let last = dt.min(at);
    let mut parts = vec![(at - last, 1), (last, 1)];
    if method.depends_on_dt() && at > dt {
        let grid = SampleGrid::new(Some(dt), at).map_err(CliError::Usage)?;
        let whole = u32::try_from(grid.steps - 1).unwrap_or(u32::MAX);
        parts = vec![(dt, whole), (at - grid.time(grid.steps - 1), 1)];
    }
    let steps = parts.into_iter().filter(|(dt, count)| *dt > 0.0 && *count > 0);
    Ok(steps.map(|(dt, count)| RunCommand::Step { dt, count }).collect())
}

/// The simulation after the steps, or where a limit ended it.
fn frame_after(
    steps: &[RunCommand],
    scene: &Scene,
    args: &RenderArgs,
) -> Result<(Arc<Frame>, Option<Exceeded>), Fault> {
    let mut runner = InlineRunner::limited(args.limits.limits());
    runner.send(RunCommand::Method(args.method));
    runner.send(RunCommand::Load(Arc::new(scene.clone())));
    for step in steps {
        if runner.exceeded().is_none() {
            runner.send(step.clone());
        }
    }
    let frame = runner.frame();
    match (frame.state, &frame.fault) {
        // The message begins with the time, which a fault tells of itself.
        (RunState::Faulted, Some(text)) => {
            let message = text.split_once(": ").map_or(text.as_str(), |(_, message)| message);
            Err(Fault { time: frame.time, message: message.to_owned(), key: None })
        }
        _ => Ok((frame, runner.exceeded())),
    }
}

/// Pixels of a picture at most, 7680×4320 and a little: each takes about 16 bytes while it is drawn and packed.
const MOST_PIXELS: u64 = 1 << 25;

fn picture_size(text: &str) -> Result<[u32; 2], String> {
    let size = number::size(text)?;
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    if pixels > MOST_PIXELS {
        return Err(format!(
            "{pixels} pixels are too many for the memory: at most {MOST_PIXELS}, such as 7680x4320"
        ));
    }
    Ok(size)
}

/// Seconds; the start, which is no length of time, counts.
fn moment(text: &str) -> Result<f64, String> {
    let value = number::any_seconds(text)?;
    if value >= 0.0 { Ok(value) } else { Err("must be 0 or more".into()) }
}

fn zoom(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if (0.25..=8.0).contains(&value) => Ok(value),
        _ => Err("expected a factor from 0.25 to 8".into()),
    }
}

fn overlays(text: &str) -> Result<OverlaySet, String> {
    if text == "none" {
        return Ok(OverlaySet::NONE);
    }
    let ids: Vec<&str> = text.split(',').map(str::trim).filter(|id| !id.is_empty()).collect();
    match ids.iter().find(|id| OVERLAYS.iter().all(|overlay| overlay.id != **id)) {
        Some(unknown) => Err(format!("no overlay is called `{unknown}`; there are: {}", overlay_ids())),
        None => Ok(OverlaySet::from_ids(ids)),
    }
}

fn overlay_ids() -> String {
    OVERLAYS.iter().map(|overlay| overlay.id).collect::<Vec<_>>().join(", ")
}

fn after_help() -> String {
    let mut help = String::from(
        "Examples:\n  polyscene render scenes/orbit.xml -o orbit.png\n  \
         polyscene render scenes/thesis-appendix-2.xml -o box.png --at 2 --view top --overlays map,grid,tiles\n\n\
         Overlays:\n",
    );
    for overlay in OVERLAYS {
        help.push_str(&format!("  {:<12}{}\n", overlay.id, overlay.help));
    }
    help
}
