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

    /// Write a picture of the window to this PNG file, then close it
    #[arg(long, value_name = "OUT.png", hide_short_help = true)]
    pub screenshot: Option<PathBuf>,

    /// Commands to carry out first, separated by commas, such as `step_forward*30,select:5853`
    #[arg(long = "do", value_name = "LIST", hide_short_help = true)]
    pub steps: Option<String>,

    /// Turn the first view for this many frames, tell how long they took, then close
    #[arg(long, value_name = "FRAMES", hide = true)]
    pub bench_orbit: Option<u32>,
}
