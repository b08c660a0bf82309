//! `polyscene render`: pictures of a scene without a window, a display or a GPU.

mod names;
mod picture;
mod studio;
mod times;

use std::io::IsTerminal as _;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use self::names::Names;
use self::studio::Studio;
use super::interrupt::{self, Interrupt};
use super::limits::LimitArgs;
use super::output::{self, is_stdout};
use super::progress::Progress;
use super::{CliError, input, method, number};
use crate::render::check_png_name;
use crate::sim::Method;
use crate::view::{OVERLAYS, OverlaySet, Theme};

/// Draw a scene into a PNG file, or its motion into many
///
/// Needs neither a display nor a GPU: OpenGL runs in software through EGL. Shows the start, or the state
/// at `--at` with the contacts of the last Δt. With `--until` (or `--to`) it draws `--fps` pictures for each second
/// of model time into numbered files. A simulation that stops before `--at` on a numerical fault
/// gives no picture, tells why, and ends with exit code 3; one that --max-events or --max-wall stops gives that
/// of the time reached. Of a sequence the pictures before that are there.
#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct RenderArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// Picture to write; `-` is standard output. Of a sequence a folder, or a name with a place for the number of the
    /// picture such as frame-%05d.png, counted from 0
    #[arg(short, long, value_name = "OUT.png")]
    out: PathBuf,

    /// Let --out replace a file other than the scene
    #[arg(long)]
    force: bool,

    /// Model time to show, in seconds from 0 to 1e9
    #[arg(long, value_name = "S", value_parser = moment, allow_negative_numbers = true, default_value = "0",
          conflicts_with_all = ["from", "until", "fps"])]
    at: f64,

    /// Draw a sequence up to this time, in seconds
    #[arg(long, visible_alias = "to", value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    until: Option<f64>,

    /// When the sequence begins, in seconds; 0 unless given
    #[arg(long, value_name = "S", value_parser = moment, allow_negative_numbers = true, requires = "until")]
    from: Option<f64>,

    /// Pictures of the sequence for each second of model time; 30 unless given
    #[arg(long, value_name = "N", allow_negative_numbers = true, requires = "until")]
    fps: Option<f64>,

    /// Δt before the picture whose contacts are shown, in seconds; fractions such as 1/60 are fine. 1/60 unless given,
    /// in a sequence that does not step by it the time since the last picture
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    dt: Option<f64>,

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

pub(super) fn render(args: &RenderArgs) -> Result<(), CliError> {
    let times = times::of(args)?;
    let paths = paths(args, times.len())?;
    for path in &paths {
        output::refuse_bad("--out", path, ("the scene", &args.scene), args.force)?;
        check_png_name(path).map_err(|refusal| CliError::Usage(format!("--out {refusal}")))?;
    }
    let mut watchdog = args.limits.watchdog();
    let name = input::display_name(&args.scene);
    let examined = input::open(&args.scene, args.method)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    let (Some(scene), Some(_)) = (examined.document.scene(), examined.simulation) else {
        return Err(CliError::Scene(format!("{name} cannot be drawn: it has errors")));
    };
    let mut studio = Studio::new(args, scene);
    let (bar, stop) = (bar(args, times.len()), args.until.map(|_| interrupt::on_interrupt()));
    let is_interrupted = || stop.is_some_and(Interrupt::is_raised);
    // What goes before the first picture.
    let mut progress = Progress::new(times.first().copied().unwrap_or_default(), is_stdout(&args.out));
    for (nth, (time, path)) in times.iter().zip(&paths).enumerate() {
        let steps = match nth.checked_sub(1).and_then(|before| times.get(before)) {
            None => times::first(args, *time)?,
            Some(before) => times::next(args, *before, *time),
        };
        let exceeded = studio.go_on(steps, &mut |time| {
            progress.show(time, None);
            !is_interrupted()
        })?;
        progress.clear();
        if exceeded.is_some() || nth + 1 == times.len() {
            // What is left is drawing, which ends.
            watchdog.take();
        }
        let time = studio.frame.time;
        let stopped = |why| CliError::Stopped { time, why };
        match (exceeded, args.until) {
            (Some(why), Some(_)) if nth == 0 => return Err(CliError::Unwritten { time, why }),
            (Some(why), Some(_)) => return Err(stopped(why)),
            (Some(why), None) => return studio.draw(path).and(Err(stopped(why))),
            (None, _) if is_interrupted() && nth == 0 => return Err(CliError::Abandoned { time }),
            (None, _) if is_interrupted() => return Err(CliError::Interrupted { time }),
            (None, _) => studio.draw(path)?,
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

/// A file for each picture.
fn paths(args: &RenderArgs, count: usize) -> Result<Vec<PathBuf>, CliError> {
    let goes_to_stdout = is_stdout(&args.out);
    if args.until.is_some() {
        if goes_to_stdout {
            return Err(CliError::Usage("--out -: several pictures need a folder or numbered names".into()));
        }
        let names = Names::of(&args.out).map_err(|refusal| CliError::Usage(format!("--out: {refusal}")))?;
        return Ok((0..count).map(|number| names.at(number)).collect());
    }
    if goes_to_stdout && std::io::stdout().is_terminal() {
        let message = "--out -: a terminal cannot show a picture; give a file or a pipe";
        return Err(CliError::Usage(message.into()));
    }
    Ok(vec![args.out.clone()])
}

/// Of a sequence, on a terminal.
fn bar(args: &RenderArgs, count: usize) -> ProgressBar {
    if args.until.is_none() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:32} {pos} of {len} pictures, about {eta} left");
    ProgressBar::new(count as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

impl RenderArgs {
    fn theme(&self) -> Theme {
        match self.colors {
            Colors::Dark => Theme::Dark,
            Colors::Light => Theme::Light,
        }
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
         polyscene render scenes/thesis-appendix-2.xml -o box.png --at 2 --view top --overlays map,grid,tiles\n  \
         polyscene render scenes/bounce.xml -o frame-%05d.png --until 5 --fps 30 --view perspective\n\n\
         Overlays:\n",
    );
    for overlay in OVERLAYS {
        help.push_str(&format!("  {:<12}{}\n", overlay.id, overlay.help));
    }
    help
}
