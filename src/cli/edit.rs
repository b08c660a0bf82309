//! What the command line says about the editor's window. The window itself is not known here.

use std::path::PathBuf;

use clap::Args;

use super::number;

/// Options of the editor; those of scripts are not in the short help.
#[derive(Debug, Default, Args)]
pub struct EditArgs {
    /// Scene file to open in the editor
    pub scene: Option<PathBuf>,

    /// Size of the window in points
    #[arg(long, value_name = "WxH", value_parser = number::size)]
    pub window_size: Option<[u32; 2]>,

    /// Write a picture of the window to this PNG file, then close it; `-` is standard output. Exit code 1 when the
    /// scene cannot be opened or has errors
    #[arg(long, value_name = "OUT.png", hide_short_help = true)]
    pub screenshot: Option<PathBuf>,

    /// Steps to take first, separated by commas, such as `dt:1/60,step_forward*30,select:5853`
    ///
    /// A step is a command of the menus by its id (`step_forward`, `next_event`, `view_top`; docs/scripts.md lists them
    /// all), or select:NAME, overlay:ID, tab:problems, tab:accuracy, tab:events, tab:xml, dt:SECONDS, method:NAME, event:NUMBER (an
    /// event of the last Δt, from 0) or study. `*30` after it takes it 30 times. Each waits until the simulation has done
    /// the one before. A step that cannot be taken ends the program with exit code 2.
    #[arg(long = "do", value_name = "LIST", hide_short_help = true)]
    pub steps: Option<String>,

    /// Turn the first view for this many frames, report how long they took, then close
    #[arg(long, value_name = "FRAMES", hide = true)]
    pub bench_orbit: Option<u32>,

    /// Select bodies, drag one and drag all for this many frames each, report how long they took, then close
    #[arg(long, value_name = "FRAMES", hide = true)]
    pub bench_edit: Option<u32>,

    /// Show a run for this many frames paused, playing and scrolling through its ledger, report how long they took, then close
    #[arg(long, value_name = "FRAMES", hide = true)]
    pub bench_play: Option<u32>,
}
