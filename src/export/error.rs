//! Why a scene was not exported.

use crate::scene::EditError;

/// Why nothing was written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error("the scene has errors")]
    NoScene,
    #[error("{0}")]
    Edit(#[from] EditError),
    #[error("{0}")]
    Xml(#[from] std::io::Error),
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    #[error("{0} has no motion, only a start")]
    NoMotion(&'static str),
    #[error("{0}")]
    Frames(String),
    #[error("{0}")]
    Compile(String),
    #[error("the run stopped {0}")]
    Fault(String),
    #[error("stopped at t = {time} s of the simulation")]
    Cancelled { time: f64 },
    /// A number that the format has no place for.
    #[error("{0}")]
    Beyond(String),
    #[error("the file would be larger than 4 GiB, the most that the format allows")]
    TooLarge,
}
